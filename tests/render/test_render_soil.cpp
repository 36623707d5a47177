// Soil in the pictures: where it is, what it hides, how it is coloured; and its mesh.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "picture.h"
#include "soil_tiles.h"

namespace {

using namespace render_test;

struct Pool {
  hoap2_soil_grid_t grid = {};
  std::vector<float> height_m, change_m;

  explicit Pool(int nx = 80, int ny = 60, double cell_m = 0.01) {
    grid.axes_W[0] = grid.axes_W[4] = grid.axes_W[8] = 1.0;
    grid.nx = nx;
    grid.ny = ny;
    grid.cell_m = cell_m;
    grid.low_x_m = -0.5 * nx * cell_m;
    grid.low_y_m = -0.5 * ny * cell_m;
    grid.depth_m = 0.15;
    height_m.assign(static_cast<size_t>(nx) * static_cast<size_t>(ny), 0.0F);
    change_m = height_m;
  }
  size_t index(int ix, int iy) const {
    return static_cast<size_t>(iy) * static_cast<size_t>(grid.nx) + static_cast<size_t>(ix);
  }
  void press(int ix, int iy, int half, float change, float height) {
    for (int y = iy - half; y <= iy + half; ++y) {
      for (int x = ix - half; x <= ix + half; ++x) {
        change_m[index(x, y)] = change;
        height_m[index(x, y)] = height;
      }
    }
  }
  // Turned about z by yaw after a slope about x, somewhere else.
  void turn(double yaw_rad, double slope_rad, double x_m, double y_m) {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad), k = std::cos(slope_rad),
                 t = std::sin(slope_rad);
    const double axes[9] = {c, -s, 0.0, k * s, k * c, -t, t * s, t * c, k};
    std::copy(axes, axes + 9, grid.axes_W);
    grid.origin_W_m[0] = x_m;
    grid.origin_W_m[1] = y_m;
  }
  void to_world(double x, double y, double z, double p_W_m[3]) const {
    for (int row = 0; row < 3; ++row) {
      const double *const r = grid.axes_W + 3 * row;
      p_W_m[row] = grid.origin_W_m[row] + r[0] * x + r[1] * y + r[2] * z;
    }
  }
  int show(Camera &camera, double full_scale_m = 0.01) const {
    return hoap2_render_set_soil(camera.handle, &grid, height_m.data(), change_m.data(), full_scale_m);
  }
};

// From above at a slant, the robot out of the way.
hoap2_scene_t over(const Pool &pool) {
  hoap2_scene_t scene = standing();
  for (int i = 0; i < 3; ++i) scene.camera_target_W_m[i] = pool.grid.origin_W_m[i];
  scene.base_pos_W_m[0] += 30.0 + pool.grid.origin_W_m[0];
  scene.floor_origin_W_m[0] = pool.grid.origin_W_m[0];
  scene.floor_origin_W_m[1] = pool.grid.origin_W_m[1];
  scene.camera_elevation_rad = 0.7;
  scene.camera_azimuth_rad = 0.4;
  scene.camera_distance_m = 1.6;
  scene.show = HOAP2_SHOW_SINKAGE | HOAP2_SHOW_SHADOW;
  return scene;
}

TEST(RenderSoil, APressedSpotIsWhereTheProjectionSays) {
  const struct {
    double yaw_rad, slope_rad, x_m, y_m;
    float height_m;
  } cases[] = {{0.0, 0.0, 0.0, 0.0, 0.0F}, {0.0, 0.0, 0.0, 0.0, -0.04F}, {0.8, 0.1, 41.3, -17.6, -0.02F}};
  for (const auto &at : cases) {
    Pool pool;
    pool.turn(at.yaw_rad, at.slope_rad, at.x_m, at.y_m);
    // Without tint the ground around is the same; so the difference is the spot.
    std::fill(pool.height_m.begin(), pool.height_m.end(), at.height_m);
    Camera camera(4);
    hoap2_scene_t scene = over(pool);
    scene.floor_tilt_rad[0] = at.slope_rad;
    ASSERT_EQ(0, pool.show(camera)) << hoap2_render_error(camera.handle);
    const Picture without = camera.draw(scene);
    pool.press(50, 24, 1, -0.01F, at.height_m);
    ASSERT_EQ(0, pool.show(camera));
    const Picture with = camera.draw(scene);
    double sum = 0.0, column_sum = 0.0, row_sum = 0.0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const double darker = without.at(column, row).r - with.at(column, row).r;
        sum += darker;
        column_sum += darker * (column + 0.5);
        row_sum += darker * (row + 0.5);
      }
    }
    ASSERT_GT(sum, 1000.0);
    double point_W_m[3], told[3];
    pool.to_world(pool.grid.low_x_m + 0.505, pool.grid.low_y_m + 0.245, static_cast<double>(at.height_m),
                  point_W_m);
    ASSERT_EQ(0, hoap2_render_project(camera.handle, &scene, point_W_m, told));
    EXPECT_NEAR(column_sum / sum, told[0], 0.7);
    EXPECT_NEAR(row_sum / sum, told[1], 0.7);
  }
}

TEST(RenderSoil, ReplacesTheFloorInsideTheWallsAndOnlyThere) {
  Pool pool;
  Camera camera(4);
  const hoap2_scene_t scene = over(pool);
  const Picture floor = camera.draw(scene);
  ASSERT_EQ(0, pool.show(camera));
  const Picture soil = camera.draw(scene);
  int inside = 0, outside = 0;
  for (double x = -0.8; x <= 0.8; x += 0.02) {
    for (double y = -0.7; y <= 0.7; y += 0.02) {
      const double point_W_m[3] = {x, y, 0.0};
      double told[3];
      ASSERT_EQ(0, hoap2_render_project(camera.handle, &scene, point_W_m, told));
      const int column = static_cast<int>(told[0]), row = static_cast<int>(told[1]);
      if (column < 0 || column >= kWidth || row < 0 || row >= kHeight) continue;
      const Pixel was = floor.at(column, row), is = soil.at(column, row);
      if (std::abs(x) < 0.38 && std::abs(y) < 0.28) {
        ++inside;
        EXPECT_GT(is.r, is.b + 25) << x << " " << y;  // sand, not the grey of the floor
      } else if (std::abs(x) > 0.43 || std::abs(y) > 0.33) {
        ++outside;
        EXPECT_FALSE(differ(was, is, 2)) << x << " " << y;
      }
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
  ASSERT_EQ(0, hoap2_render_set_soil(camera.handle, nullptr, nullptr, nullptr, 1.0));
  EXPECT_EQ(floor.rgb, camera.draw(scene).rgb);
  ASSERT_EQ(0, pool.show(camera));
  EXPECT_EQ(soil.rgb, camera.draw(scene).rgb);
}

TEST(RenderSoil, ColoursRunFromDarkToLightAndCanBeSwitchedOff) {
  Camera camera;
  int before = -1;
  for (const float change_m : {-0.01F, -0.005F, -0.002F, 0.0F, 0.0005F, 0.002F}) {
    Pool pool;
    std::fill(pool.change_m.begin(), pool.change_m.end(), change_m);
    hoap2_scene_t scene = over(pool);
    ASSERT_EQ(0, pool.show(camera));
    const Picture picture = camera.draw(scene);
    int brightness = 0;
    for (int row = 100; row < 140; ++row) {
      for (int column = 140; column < 180; ++column) {
        const Pixel p = picture.at(column, row);
        brightness += p.r + p.g + p.b;
      }
    }
    EXPECT_GT(brightness, before + 1600 * 12) << change_m;
    before = brightness;
    // Twice the scale: half the colour.
    Pool half = pool;
    for (float &change : half.change_m) change *= 2.0F;
    ASSERT_EQ(0, half.show(camera, 0.02));
    EXPECT_EQ(picture.rgb, camera.draw(scene).rgb);
    scene.show = HOAP2_SHOW_SHADOW;
    const Picture plain = camera.draw(scene);
    Pool untouched;
    ASSERT_EQ(0, untouched.show(camera));
    EXPECT_EQ(plain.rgb, camera.draw(scene).rgb);
  }
}

TEST(RenderSoil, HidesWhatIsBelowItAndTakesTheShadow) {
  Pool pool;
  Camera camera;
  hoap2_scene_t scene = standing();
  scene.camera_target_W_m[2] = 0.02;
  scene.camera_distance_m = 0.7;
  scene.camera_elevation_rad = 0.3;
  scene.base_pos_W_m[2] -= 0.02;
  // Dark pixels of the rubber soles: with a floor of sand at 0 they vanish, in a rut of 25 mm they show.
  const auto dark = [&](const Picture &picture) {
    int count = 0;
    for (int row = kHeight / 3; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const Pixel p = picture.at(column, row);
        count += p.r < 60 && p.g < 60 && p.b < 60 ? 1 : 0;
      }
    }
    return count;
  };
  ASSERT_EQ(0, pool.show(camera));
  const int hidden = dark(camera.draw(scene));
  std::fill(pool.height_m.begin(), pool.height_m.end(), -0.025F);
  ASSERT_EQ(0, pool.show(camera));
  EXPECT_GT(dark(camera.draw(scene)), hidden + 200);

  std::fill(pool.height_m.begin(), pool.height_m.end(), -0.020F);
  ASSERT_EQ(0, pool.show(camera));
  const Picture bare = camera.draw(scene);
  scene.show = HOAP2_SHOW_SHADOW;
  const Picture shadow = camera.draw(scene);
  int darker = 0;
  for (int row = kHeight / 2; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      darker += shadow.at(column, row).r < bare.at(column, row).r - 30 ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 1500);
}

TEST(RenderSoil, AMarkLiesOnTheSoil) {
  Pool pool;
  std::fill(pool.height_m.begin(), pool.height_m.end(), 0.03F);
  Camera camera(4);
  hoap2_scene_t scene = over(pool);
  ASSERT_EQ(0, pool.show(camera));
  const Picture without = camera.draw(scene);
  scene.cop_W_m[0] = 0.1;
  scene.cop_W_m[1] = -0.05;
  scene.show |= HOAP2_SHOW_COP;
  const Picture with = camera.draw(scene);
  double count = 0.0, column_sum = 0.0, row_sum = 0.0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Pixel p = with.at(column, row);
      if (!differ(p, without.at(column, row), 40) || p.r < p.g + 60) continue;
      column_sum += column + 0.5;
      row_sum += row + 0.5;
      ++count;
    }
  }
  ASSERT_GT(count, 4.0);
  const double point_W_m[3] = {0.1, -0.05, 0.03};
  double told[3];
  ASSERT_EQ(0, hoap2_render_project(camera.handle, &scene, point_W_m, told));
  EXPECT_NEAR(column_sum / count, told[0], 0.8);
  EXPECT_NEAR(row_sum / count, told[1], 0.8);
}

TEST(RenderSoil, BadSoilIsRefusedAndTheOldOneStays) {
  Camera camera;
  const Pool good;
  const hoap2_scene_t scene = over(good);
  ASSERT_EQ(0, good.show(camera));
  const Picture before = camera.draw(scene);
  std::vector<Pool> bad(6);
  bad[0].grid.nx = 0;
  bad[1].grid.cell_m = 0.0;
  bad[2].grid.origin_W_m[1] = std::numeric_limits<double>::infinity();
  bad[3].height_m[77] = std::numeric_limits<float>::quiet_NaN();
  bad[4].change_m[77] = std::numeric_limits<float>::infinity();
  bad[5].grid.ny = 1 << 30;
  for (const Pool &pool : bad) {
    EXPECT_NE(0, pool.show(camera));
    EXPECT_STRNE("", hoap2_render_error(camera.handle));
  }
  EXPECT_NE(0, good.show(camera, 0.0));
  EXPECT_EQ(before.rgb, camera.draw(scene).rgb);
}

// Twice the area of a triangle as seen from above, and its height above a point in it.
float twice_area(const hoap2::Vec3 &a, const hoap2::Vec3 &b, const hoap2::Vec3 &c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

TEST(RenderSoil, TheMeshCoversThePoolOnceAndKeepsItsShape) {
  Pool pool(83, 57, 0.005);
  for (int iy = 20; iy < 32; ++iy) {
    for (int ix = 30; ix < 60; ++ix)
      pool.height_m[pool.index(ix, iy)] = -0.006F - 0.0003F * static_cast<float>(ix % 3);
  }
  pool.height_m[pool.index(82, 56)] = 0.004F;  // in a corner
  hoap2::SoilSurface surface;
  surface.set(pool.grid, pool.height_m.data(), pool.change_m.data(), 0.01);
  const hoap2::SoilMesh mesh = soil_mesh(surface);
  const size_t sheet = surface.vertices().size();
  double ground = 0.0, below = 0.0;
  int triangles = 0;
  for (size_t k = 0; k < mesh.indices.size(); k += 3) {
    const hoap2::Vec3 &a = mesh.vertices[mesh.indices[k]].pos, &b = mesh.vertices[mesh.indices[k + 1]].pos;
    const hoap2::Vec3 &c = mesh.vertices[mesh.indices[k + 2]].pos;
    const float area = twice_area(a, b, c);
    EXPECT_GT(area, 0.0F);
    const bool is_ground = mesh.indices[k] < sheet;
    (is_ground ? ground : below) += 0.5 * static_cast<double>(area);
    triangles += is_ground ? 1 : 0;
    // Every vertex of the full grid in this triangle is as high as the triangle there; the sheet is below.
    for (const hoap2::SoilVertex &vertex : surface.vertices()) {
      const float u = twice_area(a, vertex.pos, c) / area, v = twice_area(a, b, vertex.pos) / area;
      if (u < 0.0F || v < 0.0F || u + v > 1.0F) continue;
      const float height = a.z + u * (b.z - a.z) + v * (c.z - a.z);
      if (is_ground) {
        EXPECT_NEAR(height, vertex.pos.z, 0.00031F);
      } else {
        EXPECT_LT(height, vertex.pos.z - 0.0002F);
      }
    }
  }
  const double whole = 83 * 0.005 * 57 * 0.005;
  EXPECT_NEAR(ground, whole, 1e-5 * whole);
  EXPECT_NEAR(below, whole, 1e-5 * whole);
  EXPECT_GT(triangles, 400);
  EXPECT_LT(triangles, 2500);  // of 2 x 84 x 58
}

TEST(RenderSoil, ChangedHeightsLookLikeAFreshStart) {
  Pool pool;
  Camera changed, fresh;
  const hoap2_scene_t scene = over(pool);
  ASSERT_EQ(0, pool.show(changed));
  changed.draw(scene);
  pool.press(40, 30, 5, -0.006F, -0.006F);
  ASSERT_EQ(0, pool.show(changed));
  pool.press(20, 12, 3, 0.002F, 0.002F);
  ASSERT_EQ(0, pool.show(changed));
  ASSERT_EQ(0, pool.show(fresh));
  EXPECT_EQ(changed.draw(scene).rgb, fresh.draw(scene).rgb);
}

}  // namespace
