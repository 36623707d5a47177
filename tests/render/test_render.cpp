// The renderer through its C interface: what is in the picture, and where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "picture.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa itself keeps about 200 bytes of every context it has destroyed.
extern "C" const char *__lsan_default_suppressions() { return "leak:libOSMesa"; }  // NOLINT
#endif

namespace {

using namespace render_test;

double resident_mb() {
  std::FILE *file = std::fopen("/proc/self/statm", "r");
  long total = 0, resident = 0;
  const int read = std::fscanf(file, "%ld %ld", &total, &resident);
  std::fclose(file);
  return read == 2 ? static_cast<double>(resident) * 4096.0 / 1e6 : 0.0;
}

TEST(Render, RobotStandsInTheMiddleOfThePicture) {
  Camera camera;
  const hoap2_scene_t scene = standing();
  const Picture picture = camera.draw(scene), empty = backdrop(camera, scene);
  int robot = 0, outside = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      if (!differ(picture.at(column, row), empty.at(column, row), 4)) continue;
      ++robot;
      if (std::abs(column - kWidth / 2) > 70) ++outside;
    }
  }
  // 0.5 m of 0.71 m picture height; a body of about 0.25 m width that fills somewhat more than half of it
  EXPECT_GT(robot, 5000);
  EXPECT_LT(robot, 16000);
  EXPECT_EQ(outside, 0);
}

TEST(Render, HeadAndSolesAreAtTheirHeights) {
  Camera camera;
  hoap2_scene_t scene = standing();
  scene.camera_elevation_rad = 0.0;
  scene.camera_distance_m = 2.0;
  const Picture picture = camera.draw(scene), empty = backdrop(camera, scene);
  int top = kHeight, bottom = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      if (!differ(picture.at(column, row), empty.at(column, row), 4)) continue;
      top = std::min(top, row);
      bottom = std::max(bottom, row);
    }
  }
  const double head_W_m[3] = {0.0, 0.0, 0.5}, sole_W_m[3] = {HOAP2_ANKLE_TO_TOE_M, 0.0, 0.0};
  double column = 0.0, head_row = 0.0, sole_row = 0.0;
  predict(scene, head_W_m, &column, &head_row);
  predict(scene, sole_W_m, &column, &sole_row);
  EXPECT_NEAR(top, head_row, 3.0);
  EXPECT_NEAR(bottom, sole_row, 3.0);
}

TEST(Render, MarksAreWhereTheProjectionSays) {
  Camera camera(4);
  hoap2_scene_t scene = standing();
  scene.camera_elevation_rad = 0.5;
  const double cop_W_m[3] = {0.15, 0.08, 0.0};
  scene.cop_W_m[0] = cop_W_m[0];
  scene.cop_W_m[1] = cop_W_m[1];
  const Picture without = camera.draw(scene);
  scene.show = HOAP2_SHOW_COP;
  const Picture with = camera.draw(scene);
  double column_sum = 0.0, row_sum = 0.0, count = 0.0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Pixel p = with.at(column, row);
      if (!differ(p, without.at(column, row), 30) || p.r < p.g + 60) continue;
      column_sum += column + 0.5;
      row_sum += row + 0.5;
      ++count;
    }
  }
  double column = 0.0, row = 0.0;
  predict(scene, cop_W_m, &column, &row);
  ASSERT_GT(count, 4.0);
  EXPECT_NEAR(column_sum / count, column, 0.7);
  EXPECT_NEAR(row_sum / count, row, 0.7);
  double told[3];
  ASSERT_EQ(hoap2_render_project(camera.handle, &scene, cop_W_m, told), 0);
  EXPECT_NEAR(told[0], column, 0.01);
  EXPECT_NEAR(told[1], row, 0.01);
}

TEST(Render, ComShinesThroughTheTrunk) {
  Camera camera;
  hoap2_scene_t scene = standing();
  const Picture without = camera.draw(scene);
  scene.show = HOAP2_SHOW_COM;
  const Picture with = camera.draw(scene);
  double column = 0.0, row = 0.0;
  predict(scene, scene.com_W_m, &column, &row);
  int changed = 0;
  for (int r = -3; r <= 3; ++r) {
    for (int c = -3; c <= 3; ++c) {
      const int x = static_cast<int>(column) + c, y = static_cast<int>(row) + r;
      if (differ(with.at(x, y), without.at(x, y), 10)) ++changed;
    }
  }
  EXPECT_GT(changed, 20);
}

TEST(Render, SameSceneGivesTheSameBytes) {
  hoap2_scene_t scene = standing();
  scene.show = HOAP2_SHOW_ALL;
  scene.camera_azimuth_rad = 0.7;
  Camera first(4), second(4);
  const Picture a = first.draw(scene), b = first.draw(scene), c = second.draw(scene);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.rgb, c.rgb);
}

TEST(Render, SymmetricPostureHasASymmetricSilhouette) {
  Camera camera;
  const hoap2_scene_t scene = standing();
  const Picture picture = camera.draw(scene), empty = backdrop(camera, scene);
  int robot = 0, one_sided = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth / 2; ++column) {
      const int mirrored = kWidth - 1 - column;
      const bool left = differ(picture.at(column, row), empty.at(column, row), 4);
      const bool right = differ(picture.at(mirrored, row), empty.at(mirrored, row), 4);
      robot += (left ? 1 : 0) + (right ? 1 : 0);
      if (left != right) ++one_sided;
    }
  }
  ASSERT_GT(robot, 5000);
  EXPECT_LT(one_sided, robot / 60);
}

TEST(Render, ShadowDarkensTheFloorAndOnlyDarkens) {
  Camera camera;
  hoap2_scene_t scene = standing();
  scene.camera_elevation_rad = 0.4;
  const Picture sun = camera.draw(scene);
  scene.show = HOAP2_SHOW_SHADOW;
  const Picture shaded = camera.draw(scene);
  hoap2_scene_t elsewhere = standing();
  elsewhere.camera_elevation_rad = 0.4;
  const Picture empty = backdrop(camera, elsewhere);
  int darker_floor = 0, brighter = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Pixel lit = sun.at(column, row), dark = shaded.at(column, row);
      if (dark.g > lit.g + 1) ++brighter;
      if (!differ(lit, empty.at(column, row), 0) && lit.g - dark.g > 35) ++darker_floor;
    }
  }
  EXPECT_GT(darker_floor, 800);
  EXPECT_EQ(brighter, 0);
}

TEST(Render, FarFromTheOriginNothingChanges) {
  Camera camera;
  hoap2_scene_t near = standing();
  near.show = HOAP2_SHOW_ALL;
  near.camera_azimuth_rad = 0.6;
  hoap2_scene_t far = near;
  for (double *p : {far.base_pos_W_m, far.com_W_m, far.cop_W_m, far.cp_W_m, far.camera_target_W_m}) {
    p[0] += 1000.0;
    p[1] -= 500.0;
  }
  const Picture a = camera.draw(near), b = camera.draw(far);
  int changed = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column)
      changed += differ(a.at(column, row), b.at(column, row), 2) ? 1 : 0;
  }
  EXPECT_LT(changed, 20);
}

TEST(Render, BlocksAndTiltAreSeen) {
  Camera camera;
  hoap2_scene_t scene = standing();
  const Picture flat = camera.draw(scene);
  hoap2_scene_t with_block = scene;
  with_block.block_count = 1;
  with_block.block_centre_W_m[0][0] = 0.3;
  for (double &side : with_block.block_size_m[0]) side = 0.1;
  hoap2_scene_t tilted = scene;
  tilted.floor_tilt_rad[0] = 0.1;
  for (const hoap2_scene_t &other : {with_block, tilted}) {
    const Picture picture = camera.draw(other);
    int changed = 0;
    for (size_t i = 0; i < picture.rgb.size(); ++i)
      changed += std::abs(picture.rgb[i] - flat.rgb[i]) > 4 ? 1 : 0;
    EXPECT_GT(changed, 3000);
  }
}

TEST(Render, SizesOutOfRangeAreRefusedWithAReason) {
  const int sizes[][3] = {{0, 100, 1},    {100, -5, 1}, {1000000, 100, 1},
                          {100, 5000, 4}, {8, 8, 1},    {100, 100, 3}};
  for (const auto &size : sizes) {
    EXPECT_EQ(hoap2_render_create(size[0], size[1], size[2]), nullptr);
    EXPECT_FALSE(std::string(hoap2_render_error(nullptr)).empty());
  }
  Camera good;
  ASSERT_NE(good.handle, nullptr);
  EXPECT_STREQ(hoap2_render_error(nullptr), "");
}

TEST(Render, BadScenesAreRefusedWithAReason) {
  Camera camera;
  std::vector<hoap2_scene_t> bad(6, standing());
  bad[0].q_rad[3] = std::numeric_limits<double>::quiet_NaN();
  bad[1].base_pos_W_m[0] = std::numeric_limits<double>::infinity();
  bad[2].camera_distance_m = 0.0;
  bad[3].footprint_count = HOAP2_RENDER_MAX_FOOTPRINTS + 1;
  bad[4].block_count = -1;
  bad[5].block_count = 1;  // of no size
  std::vector<uint8_t> rgb(3 * kWidth * kHeight, 7);
  for (const hoap2_scene_t &scene : bad) {
    EXPECT_NE(hoap2_render_draw(camera.handle, &scene, rgb.data()), 0);
    EXPECT_STRNE(hoap2_render_error(camera.handle), "");
  }
  EXPECT_TRUE(std::all_of(rgb.begin(), rgb.end(), [](uint8_t v) { return v == 7; }));
  // Marks without a value are left out, the picture is drawn.
  hoap2_scene_t unknown = standing();
  unknown.show = HOAP2_SHOW_ALL;
  unknown.com_W_m[0] = unknown.cop_W_m[0] = unknown.cp_W_m[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hoap2_render_draw(camera.handle, &unknown, rgb.data()), 0);
}

TEST(Render, DrawsFromAnotherThread) {
  Camera camera;
  const hoap2_scene_t scene = standing();
  const Picture here = camera.draw(scene);
  Picture there;
  std::thread([&] { there = camera.draw(scene); }).join();
  EXPECT_EQ(here.rgb, there.rgb);
}

TEST(Render, ManyLivesLeaveNoMemoryBehind) {
  const hoap2_scene_t scene = standing();
  const auto live = [&](int times) {
    for (int i = 0; i < times; ++i) {
      Camera camera;
      camera.draw(scene);
    }
  };
  live(5);
  const double before_mb = resident_mb();
  live(25);
#ifdef __SANITIZE_ADDRESS__
  const double allowed_mb = 300.0;  // freed memory stays in the sanitizer's quarantine; it finds leaks itself
#else
  const double allowed_mb = 25.0;
#endif
  EXPECT_LT(resident_mb() - before_mb, allowed_mb);
}

}  // namespace
