// Rims, ruts and heaps: where displaced soil goes, and that none is lost.
#include "soil_rig.h"

namespace hoap2_sim {
namespace {

constexpr double kAll_m3 = 0.85 * 0.56 * 0.15;

// Steepest slope between neighbours, straight and across.
double steepest(const HeightField &field) {
  double steepest = 0.0;
  for (int iy = 0; iy + 1 < field.ny(); ++iy) {
    for (int ix = 1; ix + 1 < field.nx(); ++ix) {
      const double here_m = field.surface_m(ix, iy);
      const double straight_m = std::max(std::fabs(field.surface_m(ix + 1, iy) - here_m),
                                         std::fabs(field.surface_m(ix, iy + 1) - here_m));
      const double across_m = std::max(std::fabs(field.surface_m(ix + 1, iy + 1) - here_m),
                                       std::fabs(field.surface_m(ix - 1, iy + 1) - here_m));
      steepest = std::max(steepest, std::max(straight_m, across_m / std::sqrt(2.0)) / field.cell_m());
    }
  }
  return steepest;
}

void wait(SoilRig *rig, int ticks) {
  for (int i = 0; i < ticks; ++i) rig->move(Vec3{});
}

// Presses the right sole slowly to this depth and holds it.
void press(SoilRig *rig, const Vec3 &place_m, double depth_m) {
  rig->put_sole(place_m);
  for (int i = 0; i < 200; ++i) rig->move({0.0, 0.0, -depth_m / 0.2});
  wait(rig, 20);
}

TEST(SoilFlow, HeapComesDownToTheAngleOfRepose) {
  for (const double repose_rad : {0.35, 0.5585, 0.8}) {
    SoilRig rig;
    rig.params.soil_repose_rad = repose_rad;
    rig.params.soil_size_m[0] = rig.params.soil_size_m[1] = 0.4;
    rig.build();
    const HeightField &field = rig.soil.field();
    for (int iy = 0; iy < field.ny(); ++iy) {
      for (int ix = 0; ix < field.nx(); ++ix) {
        const double away_m = std::hypot(field.centre_x_m(ix) - 0.21, field.centre_y_m(iy) - 0.003);
        if (away_m < 0.04) rig.soil.set_level(ix, iy, 0.08 - 0.9 * away_m);
      }
    }
    const double volume_m3 = rig.soil.volume_m3();
    EXPECT_GT(steepest(field), 2.0);
    wait(&rig, 20000);
    EXPECT_NEAR(volume_m3, rig.soil.volume_m3(), 1e-14);
    EXPECT_LT(steepest(field), std::tan(repose_rad) + 0.002);
    EXPECT_GT(steepest(field), 0.98 * std::tan(repose_rad));
    // The same on all sides.
    const int cx = static_cast<int>((0.21 - field.low_x_m()) / 0.005);
    const int cy = static_cast<int>((0.003 - field.low_y_m()) / 0.005);
    double least_m = 1.0, most_m = 0.0;
    for (int k = 0; k < 8; ++k) {
      const double angle_rad = k * 0.7853981633974483;
      const int dx = static_cast<int>(std::lround(7.0 * std::cos(angle_rad)));
      const int dy = static_cast<int>(std::lround(7.0 * std::sin(angle_rad)));
      least_m = std::min(least_m, field.surface_m(cx + dx, cy + dy));
      most_m = std::max(most_m, field.surface_m(cx + dx, cy + dy));
    }
    EXPECT_LT(most_m - least_m, 0.18 * (field.surface_m(cx, cy) - least_m));
  }
}

TEST(SoilFlow, RimRisesAroundAFootprint) {
  for (const double heave : {0.0, 0.25, 1.0}) {
    SoilRig rig;
    rig.params.soil_heave = heave;
    rig.build();
    ASSERT_NEAR(kAll_m3, rig.soil.volume_m3(), 1e-15);
    press(&rig, {0.2031, 0.0117, 0.0}, 0.005);
    EXPECT_NEAR(kAll_m3, rig.soil.volume_m3(), 1e-14);
    const HeightField &field = rig.soil.field();
    double raised_m3 = 0.0, sunk_m3 = 0.0, highest_m = 0.0;
    for (std::size_t i = 0; i < field.size(); ++i) {
      const double height_m = field.cell(i).surface_m();
      (height_m > 0.0 ? raised_m3 : sunk_m3) += 25e-6 * height_m;
      highest_m = std::max(highest_m, height_m);
    }
    EXPECT_NEAR(-heave * sunk_m3, raised_m3, 1e-12);
    EXPECT_GT(-sunk_m3, 0.9 * 0.005 * kSole_m2);
    EXPECT_GE(highest_m, heave * 0.004);
    EXPECT_NEAR(0.005, rig.soil.mean_sinkage_m(0), 1e-9);
    EXPECT_EQ(0.0, rig.soil.mean_sinkage_m(1));
    // Lifted: the walls of the rut come down, nothing is lost.
    rig.put_sole({0.2031, 0.0117, 0.05});
    wait(&rig, 3000);
    EXPECT_LT(steepest(field), std::tan(rig.params.soil_repose_rad) + 0.002);
    EXPECT_NEAR(kAll_m3, rig.soil.volume_m3(), 1e-14);
    EXPECT_EQ(0.0, rig.soil.mean_sinkage_m(0));
  }
}

TEST(SoilFlow, LoadedGroundStays) {
  SoilRig rig;
  rig.params.soil_heave = 1.0;
  rig.build();
  press(&rig, {0.2031, 0.0117, 0.0}, 0.006);
  const Vec3 before_N = rig.wrench(Vec3{}).force_W_N;
  // A second sole throws its rim against the first.
  rig.put_sole({0.2031, 0.0117 + 0.068, 0.0}, Mat3{}, SoilRig::kLeft);
  for (int i = 0; i < 300; ++i) rig.move({0.0, 0.0, -0.04}, Vec3{}, SoilRig::kLeft);
  wait(&rig, 100);
  const Vec3 after_N = rig.wrench(Vec3{}).force_W_N;
  EXPECT_EQ(before_N.z, after_N.z);
  EXPECT_EQ(before_N.x, after_N.x);
  EXPECT_NEAR(kAll_m3, rig.soil.volume_m3(), 1e-14);
}

// A rut that is filled again is loose: it bears like fresh ground from its new surface on.
TEST(SoilFlow, FilledRutIsLoose) {
  PressureLaw law;
  SoilRig rig;
  law.build(rig.params);
  const Cell fresh = {0.0, 0.0, 0.0, law.stiffness_Pa_m(0.0)};
  Cell rut = law.pressed(fresh, 0.006, 1.0);
  const double bottom_m = rut.surface_m();
  law.lay(&rut, 0.002);
  EXPECT_NEAR(bottom_m + 0.002, rut.surface_m(), 1e-17);
  EXPECT_NEAR(0.004, rut.memory_m, 1e-4);
  law.lay(&rut, 0.003);
  EXPECT_NEAR(bottom_m + 0.005, rut.surface_m(), 1e-17);
  EXPECT_NEAR(0.001, rut.memory_m, 2e-4);  // less the rebound
  law.lay(&rut, 0.004);
  EXPECT_NEAR(bottom_m + 0.009, rut.surface_m(), 1e-17);
  EXPECT_EQ(0.0, rut.memory_m);
  EXPECT_NEAR(bottom_m + 0.009, rut.level_m, 1e-17);
  law.lay(&rut, -0.003);
  EXPECT_NEAR(bottom_m + 0.006, rut.surface_m(), 1e-17);
}

// Where a rim finds no place it waits.
TEST(SoilFlow, NarrowPoolKeepsTheRimPending) {
  SoilRig rig;
  rig.params.soil_heave = 1.0;
  rig.params.soil_size_m[0] = 0.1;
  rig.params.soil_size_m[1] = 0.065;
  rig.params.soil_centre_m[0] = 0.2;
  rig.build();
  const double volume_m3 = rig.soil.volume_m3();
  press(&rig, {0.2, 0.0, 0.0}, 0.005);
  EXPECT_NEAR(volume_m3, rig.soil.volume_m3(), 1e-15);
  EXPECT_LT(rig.soil.field().volume_m3(), volume_m3 - 1e-6);
}

TEST(SoilFlow, RoughnessHasItsSizeAndIsTheSameOnEveryMesh) {
  SoilRig rig, fine, other;
  rig.params.soil_roughness_m = fine.params.soil_roughness_m = other.params.soil_roughness_m = 0.0005;
  fine.params.soil_cell_m = 0.0025;
  other.params.soil_seed = 1;
  rig.build();
  fine.build();
  other.build();
  const HeightField &field = rig.soil.field();
  double sum = 0.0, square = 0.0, near = 0.0, far = 0.0, differs = 0.0, misses = 0.0;
  for (int iy = 0; iy + 4 < field.ny(); ++iy) {
    for (int ix = 0; ix + 16 < field.nx(); ++ix) {
      const double here_m = field.surface_m(ix, iy);
      sum += here_m;
      square += here_m * here_m;
      near += here_m * field.surface_m(ix + 4, iy);  // one correlation length
      far += here_m * field.surface_m(ix + 16, iy);
      differs += std::fabs(here_m - other.soil.field().surface_m(ix, iy));
      const HeightField &same = fine.soil.field();
      const double mean_m =
          0.25 * (same.surface_m(2 * ix, 2 * iy) + same.surface_m(2 * ix + 1, 2 * iy) +
                  same.surface_m(2 * ix, 2 * iy + 1) + same.surface_m(2 * ix + 1, 2 * iy + 1));
      misses = std::max(misses, std::fabs(mean_m - here_m));
    }
  }
  const double count = (field.ny() - 4.0) * (field.nx() - 16.0);
  EXPECT_NEAR(0.0005, std::sqrt(square / count), 2e-5);
  EXPECT_NEAR(0.0, sum / count, 2e-5);
  EXPECT_NEAR(std::exp(-1.0), near / square, 0.06);
  EXPECT_NEAR(0.0, far / square, 0.1);
  EXPECT_GT(differs / count, 2e-4);
  EXPECT_LT(misses, 1e-4);
  EXPECT_NEAR(kAll_m3, rig.soil.volume_m3(), 1e-14);
}

}  // namespace
}  // namespace hoap2_sim
