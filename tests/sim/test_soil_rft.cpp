// Resistive force theory: its coefficients, a sole pressed and dragged.
#include "soil/rft.h"
#include "soil_rig.h"

namespace hoap2_sim {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

class RftRig : public SoilRig {
 public:
  RftRig() { params.soil_law = HOAP2_SOIL_LAW_RFT; }
};

TEST(SoilRft, CoefficientsGiveTheKnownStresses) {
  EXPECT_NEAR(1.0, rft_stress(0.0, kHalfPi).vertical, 1e-12);  // 1 N/cm3 straight down
  EXPECT_NEAR(0.0, rft_stress(0.0, kHalfPi).horizontal, 1e-12);
  EXPECT_NEAR(0.375, rft_stress(0.0, 0.0).vertical, 1e-12);  // level plate dragged
  EXPECT_NEAR(0.136, rft_stress(0.0, 0.0).horizontal, 1e-12);
  EXPECT_NEAR(0.370, rft_stress(kHalfPi, 0.0).horizontal, 1e-12);  // upright plate pushed
  // A face that leans forward ploughs: more drag and more lift than one that trails.
  for (double tilt_rad = 0.1; tilt_rad < 1.5; tilt_rad += 0.1) {
    EXPECT_GT(rft_stress(tilt_rad, 0.0).horizontal, rft_stress(-tilt_rad, 0.0).horizontal);
    EXPECT_GT(rft_stress(tilt_rad, 0.0).vertical, rft_stress(-tilt_rad, 0.0).vertical);
  }
}

TEST(SoilRft, HasNoPreferredHeading) {
  const Mat3 tilt = rotation(1, 0.2);
  const RftShare one = rft_share(tilt.cz, {0.03, 0.0, -0.02});
  for (double yaw_rad = 0.0; yaw_rad < 6.3; yaw_rad += 0.37) {
    const Mat3 turn = rotation(2, yaw_rad);
    const RftShare other = rft_share(turn * tilt.cz, turn * Vec3{0.03, 0.0, -0.02});
    EXPECT_NEAR(one.normal, other.normal, 1e-12);
    EXPECT_NEAR(one.shear_ratio, other.shear_ratio, 1e-12);
  }
  const RftShare mirrored = rft_share(rotation(1, -0.2).cz, {-0.03, 0.0, -0.02});
  EXPECT_NEAR(one.normal, mirrored.normal, 1e-12);
  EXPECT_NEAR(1.0, rft_share({0.0, 0.0, 1.0}, Vec3{}).normal, 1e-12);
}

// No jump where the velocity vanishes.
TEST(SoilRft, IsSmoothAtRest) {
  for (const double lean_rad : {0.0, 0.1, 0.3}) {
    const Vec3 up = rotation(1, lean_rad).cz;
    const RftShare still = rft_share(up, Vec3{});
    for (double angle_rad = 0.0; angle_rad < 6.3; angle_rad += 0.1) {
      const Vec3 vel = {1e-6 * std::cos(angle_rad), 1e-6 * std::sin(angle_rad), 0.0};
      EXPECT_NEAR(still.normal, rft_share(up, vel).normal, 3e-3) << lean_rad << " " << angle_rad;
    }
  }
}

// 69 N, the robot on one sole: 8 mm at a scale of 1.4.
TEST(SoilRft, SinkageUnderOneSole) {
  RftRig rig;
  rig.build();
  rig.put_sole({0.2031, 0.0117, 0.0});
  double depth_m = 0.0, force_N = 0.0;
  while (force_N < 69.0 && depth_m < 0.02) {
    rig.move({0.0, 0.0, -0.01});
    ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    force_N = rig.wrench(Vec3{}).force_W_N.z;
    depth_m = -rig.sole_P_m().z;
    ASSERT_NEAR(1.4e6 * kSole_m2 * depth_m, force_N, 1e-6 * force_N);
  }
  EXPECT_NEAR(0.008, depth_m, 1e-4);
}

TEST(SoilRft, UnloadsStifflyAndRemembersItsRut) {
  RftRig rig;
  rig.params.soil_repose_rad = 1.4;
  rig.build();
  rig.put_sole({0.2031, 0.0117, 0.0});
  for (int i = 0; i < 500; ++i) rig.move({0.0, 0.0, -0.01});
  rig.move(Vec3{});
  const double held_N = 1.4e6 * kSole_m2 * 0.005;
  const auto force_at = [&](double depth_m) {
    rig.put_sole({0.2031, 0.0117, -depth_m});
    EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    return rig.wrench(Vec3{}).force_W_N.z;
  };
  EXPECT_NEAR(held_N, force_at(0.005), 1e-6 * held_N);
  EXPECT_NEAR(held_N - 1e8 * kSole_m2 * 3e-5, force_at(0.00497), 1e-6 * held_N);
  EXPECT_EQ(0.0, force_at(0.0045));
  EXPECT_NEAR(1.4e6 * kSole_m2 * 0.006, force_at(0.006), 1e-6 * held_N);
}

// A level sole dragged fast at a fixed depth: lift and drag are those of the sheet.
TEST(SoilRft, DragOfALevelSole) {
  for (const double yaw_rad : {0.0, 2.0}) {
    RftRig rig;
    rig.params.soil_heave = 0.0;
    rig.params.soil_shear_m = 0.001;
    rig.build();
    rig.put_sole({0.1, 0.0117, 0.0});
    for (int i = 0; i < 500; ++i) rig.move({0.0, 0.0, -0.01});
    const Vec3 vel = {0.4 * std::cos(yaw_rad), 0.4 * std::sin(yaw_rad), 0.0};
    for (int i = 0; i < 60; ++i) rig.move(vel);
    ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    const Vec3 force_N = rig.wrench(Vec3{}).force_W_N;
    const RftStress stress = rft_stress(0.0, std::atan(0.001 / 0.4));
    const double unit_N = 1.4e6 * kSole_m2 * 0.005;
    EXPECT_NEAR(stress.vertical * unit_N, force_N.z, 0.005 * unit_N);
    EXPECT_NEAR(-stress.horizontal * unit_N, force_N.x * std::cos(yaw_rad) + force_N.y * std::sin(yaw_rad),
                0.005 * unit_N);
    EXPECT_NEAR(0.0, force_N.x * std::sin(yaw_rad) - force_N.y * std::cos(yaw_rad), 0.002 * unit_N);
  }
}

// Pressed straight down with either tilt: mirrored loads.
TEST(SoilRft, TiltsMirror) {
  Vec3 force_N[2], moment_Nm[2];
  for (int side = 0; side < 2; ++side) {
    RftRig rig;
    rig.params.soil_cell_m = 0.0025;
    rig.build();
    const Mat3 axes = rotation(1, side == 0 ? 0.15 : -0.15);
    rig.put_sole({0.21, 0.0, 0.008}, axes);
    for (int i = 0; i < 150; ++i) rig.move({0.0, 0.0, -0.1});
    ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    const Wrench wrench = rig.wrench(Vec3{});
    force_N[side] = wrench.force_W_N;
    const Vec3 arm = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
    moment_Nm[side] = wrench.torque_W_Nm - cross(arm, wrench.force_W_N);
  }
  EXPECT_GT(force_N[0].z, 10.0);
  EXPECT_GT(std::fabs(force_N[0].x), 1.0);
  EXPECT_NEAR(force_N[0].z, force_N[1].z, 1e-6 * force_N[0].z);
  EXPECT_NEAR(force_N[0].x, -force_N[1].x, 1e-6 * force_N[0].z);
  EXPECT_NEAR(moment_Nm[0].y, -moment_Nm[1].y, 1e-6);
}

}  // namespace
}  // namespace hoap2_sim
