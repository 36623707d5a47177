// On the ground: statics, friction, blocks, falling.
#include <gtest/gtest.h>

#include "rig.h"

namespace hoap2_sim {
namespace {

class Stance : public WithEachSolver {};  // LongStance: with the default solver alone

TEST_P(Stance, FloorCarriesTheWeightWhereStaticsSays) {
  Rig rig;
  rig.start();
  rig.step(2000);
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_NEAR(kMg_N, out.true_foot_force_W_N[0][2] + out.true_foot_force_W_N[1][2], 1e-3 * kMg_N);
  EXPECT_NEAR(out.true_com_W_m[0], out.true_cop_W_m[0], 1e-5);
  EXPECT_NEAR(out.true_com_W_m[1], out.true_cop_W_m[1], 1e-5);
  EXPECT_NEAR(0.0, norm(vec(out.true_com_rate_W_m_s)), 1e-5);
  EXPECT_EQ(0, out.other_contacts);
  EXPECT_EQ(2000, out.plant_tick);
  // the moments of both feet, about their own sole points, tell the same CoP
  double moment_Nm = 0.0;
  for (int foot = 0; foot < 2; ++foot) {
    moment_Nm += out.true_foot_moment_W_Nm[foot][0] +
                 out.true_foot_pos_W_m[foot][1] * out.true_foot_force_W_N[foot][2] -
                 out.true_foot_pos_W_m[foot][2] * out.true_foot_force_W_N[foot][1];
  }
  EXPECT_NEAR(out.true_cop_W_m[1] * kMg_N, moment_Nm, 1e-3);
}

TEST_P(Stance, TiltedFloorHasTheCopBelowTheComAlongGravity) {
  Rig rig;
  rig.params.floor_tilt_rad[0] = 0.02;
  rig.params.floor_tilt_rad[1] = -0.03;
  rig.start();
  rig.step(3000);
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_NEAR(out.true_com_W_m[0], out.true_cop_W_m[0], 5e-5);
  EXPECT_NEAR(out.true_com_W_m[1], out.true_cop_W_m[1], 5e-5);
  Vec3 force = vec(out.true_foot_force_W_N[0]) + vec(out.true_foot_force_W_N[1]);
  EXPECT_NEAR(kMg_N, force.z, 1e-3 * kMg_N);
  EXPECT_NEAR(0.0, std::hypot(force.x, force.y), 1e-3 * kMg_N);
}

TEST_P(Stance, CopIsHeldInFlight) {
  Rig rig;
  rig.params.start_height_m = 1.0;
  rig.params.start_pos_W_m[0] = 4.0;
  rig.params.start_vel_W_m_s[0] = 1.0;
  rig.start();
  rig.step(100);
  EXPECT_NEAR(4.0, rig.out().true_cop_W_m[0], 1e-9);
  EXPECT_EQ(0.0, rig.out().true_foot_force_W_N[0][2]);
}

// Tilt 0.15 rad about x: tan = 0.1511. Down the slope the feet's y axis points.
// Mean acceleration from 0.2 s (the servos have sagged by then) to 0.5 s.
double slide_m_s2(double mu) {
  Rig rig;
  rig.params.floor_tilt_rad[0] = 0.15;
  rig.params.friction_mu = mu;
  rig.start();
  rig.step(200);
  const Vec3 before = vec(rig.out().true_com_rate_W_m_s);
  rig.step(300);
  return norm(vec(rig.out().true_com_rate_W_m_s) - before) / 0.3;
}

TEST_P(Stance, SlidesBelowTheFrictionAngleAndHoldsAboveIt) {
  EXPECT_LT(slide_m_s2(0.18), 5e-3);
  const double expected_m_s2 = 9.81 * (std::sin(0.15) - 0.12 * std::cos(0.15));
  EXPECT_NEAR(expected_m_s2, slide_m_s2(0.12), 0.02 * expected_m_s2);
}

TEST(LongStance, StandingDoesNotCreep) {
  Rig rig;
  rig.start();
  rig.step(1000);
  const Vec3 before = vec(rig.out().true_foot_pos_W_m[0]);
  rig.step(2000);
  EXPECT_LT(norm(vec(rig.out().true_foot_pos_W_m[0]) - before), 2e-5);
}

TEST_P(Stance, StandsOnABlock) {
  Rig rig;
  rig.params.block_count = 1;
  const double size_m[3] = {0.3, 0.4, 0.05};
  for (int i = 0; i < 3; ++i) rig.params.block_size_m[0][i] = size_m[i];
  rig.params.block_centre_W_m[0][2] = -0.005;  // its top is 20 mm above the floor
  rig.params.block_yaw_W_rad[0] = 0.3;
  rig.params.start_height_m = 0.02;
  rig.start();
  rig.step(1500);
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_NEAR(kMg_N, out.true_foot_force_W_N[0][2] + out.true_foot_force_W_N[1][2], 1e-3 * kMg_N);
  for (int foot = 0; foot < 2; ++foot) EXPECT_NEAR(0.02, out.true_foot_pos_W_m[foot][2], 5e-4);
  EXPECT_EQ(0, out.other_contacts);
}

TEST(LongStance, OneFootOnABlock) {
  Rig rig;
  rig.params.block_count = 1;
  const double size_m[3] = {0.2, 0.07, 0.02}, centre_m[3] = {0.0, -0.039, -0.006};  // top at 4 mm
  for (int i = 0; i < 3; ++i) {
    rig.params.block_size_m[0][i] = size_m[i];
    rig.params.block_centre_W_m[0][i] = centre_m[i];
  }
  rig.params.start_height_m = 0.004;
  rig.start();
  rig.step(4000);  // it rocks from foot to foot for a while
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_GT(out.true_foot_force_W_N[0][2], 5.0);
  EXPECT_GT(out.true_foot_force_W_N[1][2], 5.0);
  EXPECT_GT(out.true_foot_pos_W_m[0][2], 0.0035);
  EXPECT_LT(out.true_foot_pos_W_m[1][2], 0.0025);
  EXPECT_EQ(0, out.other_contacts);
}

TEST(LongStance, APushedRobotFallsAndLiesOnTheFloor) {
  Rig rig;
  rig.params.push_link[0] = HOAP2_L_CHEST;
  rig.params.push_force_W_N[0][0] = 40.0;
  rig.params.push_point_L_m[0][2] = 0.1;
  rig.params.push_start_s[0] = 0.1;
  rig.params.push_duration_s[0] = 0.3;
  rig.start();
  int contacts_max = 0;
  for (int i = 0; i < 4000; ++i) {
    rig.step();
    contacts_max = std::max(contacts_max, static_cast<int>(rig.out().other_contacts));
  }
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_GT(std::fabs(out.true_chest_rpy_rad[1]) + std::fabs(out.true_chest_rpy_rad[0]), 0.8);
  EXPECT_GT(contacts_max, 0);
  EXPECT_GT(out.other_contacts, 0);
  const State s = rig.state();
  for (const BodyState &body : s.body) EXPECT_GT(body.com_pos_W_m[2], 0.0);
  EXPECT_LT(norm(vec(out.true_com_rate_W_m_s)), 0.05);
}

INSTANTIATE_WITH_EACH_SOLVER(Stance);

}  // namespace
}  // namespace hoap2_sim
