// Mass, centre of mass and start pose of the plant's robot.
#include <gtest/gtest.h>

#include "rig.h"

namespace hoap2_sim {
namespace {

// CoM over the point midway between the soles, by rotation matrices from the table
// (the plant uses quaternions), with the right sole flat on the floor.
Vec3 com_from_table_m(const double q_rad[HOAP2_JOINTS]) {
  Vec3 origin[HOAP2_LINKS];
  Mat3 axes[HOAP2_LINKS];
  Vec3 sum;
  for (const int j : HOAP2_TREE_ORDER) {
    const hoap2_joint_data_t &joint = HOAP2_JOINT[j];
    origin[joint.child_link] =
        origin[joint.parent_link] + axes[joint.parent_link] * vec(joint.origin_parent_m);
    axes[joint.child_link] = axes[joint.parent_link] * rotation(joint.axis, q_rad[j]);
  }
  double mass_kg = 0.0;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    mass_kg += HOAP2_LINK[link].mass_kg;
    sum = sum + HOAP2_LINK[link].mass_kg * (origin[link] + axes[link] * vec(HOAP2_LINK[link].com_L_m));
  }
  const Vec3 below = {0.0, 0.0, -HOAP2_SOLE_BELOW_ANKLE_M};
  const int r = HOAP2_L_R_FOOT, l = HOAP2_L_L_FOOT;
  const Vec3 middle = 0.5 * (origin[r] + axes[r] * below + origin[l] + axes[l] * below);
  return turn_back(axes[r], (1.0 / mass_kg) * sum - middle);
}

void expect_near(const Vec3 &expected, const double actual[3], double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(expected[i], actual[i], tolerance) << "component " << i;
}

// Weighed by its inertia: a push of known impulse and the velocity it leaves.
TEST(Model, MassIsTheSumOfTheTable) {
  double mass_kg = 0.0;
  for (const hoap2_link_data_t &link : HOAP2_LINK) mass_kg += link.mass_kg;
  EXPECT_NEAR(HOAP2_TOTAL_MASS_KG, mass_kg, 1e-6) << "the published total is rounded";
  Rig rig;
  rig.float_free();
  rig.params.push_link[0] = HOAP2_L_PELVIS;
  rig.params.push_force_W_N[0][1] = 3.0;
  rig.params.push_duration_s[0] = 0.01;
  rig.start();
  rig.step(10);
  EXPECT_NEAR(mass_kg, 3.0 * 0.01 / rig.out().true_com_rate_W_m_s[1], 1e-9);
}

TEST(Model, ComOfThreePosturesAgreesWithTheSheetAndTheTable) {
  struct Case {
    std::initializer_list<std::pair<int, double>> joints_deg;
    Vec3 com_m;
  };
  const Case cases[] = {
      {{}, {0.010084, 0.000086, 0.276624}},
      {{{HOAP2_J_R_SHOULDER_PITCH, 90.0}, {HOAP2_J_L_SHOULDER_PITCH, 90.0}}, {-0.004206, 0.000086, 0.26717}},
      {{{HOAP2_J_R_HIP_PITCH, -30.0},
        {HOAP2_J_R_KNEE, 60.0},
        {HOAP2_J_R_ANKLE_PITCH, -30.0},
        {HOAP2_J_R_SHOULDER_PITCH, 100.0},
        {HOAP2_J_R_ELBOW, -30.0},
        {HOAP2_J_L_HIP_PITCH, -30.0},
        {HOAP2_J_L_KNEE, 60.0},
        {HOAP2_J_L_ANKLE_PITCH, -30.0},
        {HOAP2_J_L_SHOULDER_PITCH, 100.0},
        {HOAP2_J_L_ELBOW, -30.0}},
       {0.001472, 0.000086, 0.24605}}};
  for (const Case &c : cases) {
    Rig rig;
    rig.posture(c.joints_deg);
    rig.start();
    const hoap2_plant_outputs_t out = rig.out();
    expect_near(c.com_m, out.true_com_W_m, 1e-6);
    expect_near(com_from_table_m(rig.params.start_posture_rad), out.true_com_W_m, 1e-9);
    for (int j = 0; j < HOAP2_JOINTS; ++j)
      EXPECT_NEAR(rig.params.start_posture_rad[j], out.true_q_rad[j], 1e-12);
  }
}

TEST(Model, LeaningTrunkStillHasFlatSoles) {
  Rig rig;  // legs that sum to -2 degrees: the trunk leans forward by 2 degrees
  rig.posture({{HOAP2_J_R_HIP_PITCH, -20.0},
               {HOAP2_J_R_KNEE, 40.0},
               {HOAP2_J_R_ANKLE_PITCH, -22.0},
               {HOAP2_J_L_HIP_PITCH, -20.0},
               {HOAP2_J_L_KNEE, 40.0},
               {HOAP2_J_L_ANKLE_PITCH, -22.0}});
  rig.start();
  EXPECT_NEAR(2.0 * std::acos(-1.0) / 180.0, rig.out().true_chest_rpy_rad[1], 1e-9);
  EXPECT_NEAR(0.224824, rig.out().true_base_pos_W_m[2], 1e-6);
  for (const int foot : {0, 1}) EXPECT_NEAR(0.0, rig.out().true_foot_pos_W_m[foot][2], 1e-12);
  expect_near(com_from_table_m(rig.params.start_posture_rad), rig.out().true_com_W_m, 1e-9);
}

TEST(Model, ChestShiftMovesTheComByItsShareOfTheMass) {
  Rig plain, shifted;
  shifted.params.chest_com_shift_L_m[0] = 0.003;
  shifted.params.chest_com_shift_L_m[1] = -0.002;
  plain.start();
  shifted.start();
  const double share = HOAP2_LINK[HOAP2_L_CHEST].mass_kg / HOAP2_TOTAL_MASS_KG;
  const double lean_rad = plain.out().true_chest_rpy_rad[1];
  EXPECT_NEAR(0.003 * share * std::cos(lean_rad), shifted.out().true_com_W_m[0] - plain.out().true_com_W_m[0],
              1e-9);
  EXPECT_NEAR(-0.002 * share, shifted.out().true_com_W_m[1] - plain.out().true_com_W_m[1], 1e-9);
  // and the standing robot's CoP follows it
  plain.step(1500);
  shifted.step(1500);
  EXPECT_NEAR(-0.002 * share, shifted.out().true_cop_W_m[1] - plain.out().true_cop_W_m[1], 2e-5);
}

TEST(Model, StartsWhereAndHowItIsTold) {
  Rig rig;
  rig.params.start_pos_W_m[0] = 3.0;
  rig.params.start_pos_W_m[1] = -2.0;
  rig.params.start_yaw_W_rad = 1.1;
  rig.params.start_height_m = 0.3;
  rig.params.start_vel_W_m_s[1] = 0.5;
  rig.params.start_omega_W_rad_s[2] = 2.0;
  rig.start();
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_NEAR(3.0, 0.5 * (out.true_foot_pos_W_m[0][0] + out.true_foot_pos_W_m[1][0]), 1e-12);
  EXPECT_NEAR(-2.0, 0.5 * (out.true_foot_pos_W_m[0][1] + out.true_foot_pos_W_m[1][1]), 1e-12);
  EXPECT_NEAR(0.3, out.true_foot_pos_W_m[1][2], 1e-12);
  EXPECT_NEAR(1.1, out.true_foot_yaw_W_rad[0], 1e-12);
  EXPECT_NEAR(0.5, out.true_com_rate_W_m_s[1], 1e-12);
  for (const double rate : out.true_qd_rad_s) EXPECT_NEAR(0.0, rate, 1e-12);
  EXPECT_NEAR(2.0, out.true_base_omega_W_rad_s[2], 1e-12);
  const Vec3 arm = vec(out.true_base_pos_W_m) - vec(out.true_com_W_m);
  expect_near(Vec3{0.0, 0.5, 0.0} + cross(Vec3{0.0, 0.0, 2.0}, arm), out.true_base_vel_W_m_s, 1e-12);
}

TEST(Model, StandsAlignedWithATiltedFloor) {
  Rig rig;
  rig.params.floor_tilt_rad[0] = 0.05;
  rig.params.floor_tilt_rad[1] = -0.03;
  rig.start();
  const Mat3 floor_axes = rotation(0, 0.05) * rotation(1, -0.03);
  const State s = rig.state();
  for (const int link : kFootLink) EXPECT_NEAR(1.0, dot(floor_axes.cz, link_axes_W(s, link).cz), 1e-12);
  for (const int foot : {0, 1}) EXPECT_NEAR(0.0, dot(floor_axes.cz, sole_point_W_m(s, foot)), 1e-12);
}

}  // namespace
}  // namespace hoap2_sim
