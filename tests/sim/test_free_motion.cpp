// Free flight: momenta, energy, pushes, mechanical stops.
#include <gtest/gtest.h>

#include <tuple>

#include "drive/drive.h"
#include "push/push.h"
#include "rig.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

// Joints set going by random torques for 0.1 s (up to 1.2 rad/s), then left alone: a
// tumble in which every joint moves.
void set_tumbling(Rig *rig, std::uint64_t seed, double body_speed = 1.0) {
  std::uint64_t noise[4];
  noise_seed(noise, seed);
  for (int i = 0; i < 3; ++i) {
    rig->params.start_vel_W_m_s[i] = body_speed * (2.0 * noise_uniform(noise) - 1.0);
    rig->params.start_omega_W_rad_s[i] = body_speed * (4.0 * noise_uniform(noise) - 2.0);
  }
  rig->start();
  rig->mode_of_all(kDriveTorque);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    rig->inputs.tau_ff_Nm[j] = 12.0 * HOAP2_JOINT[j].armature_kgm2 * (2.0 * noise_uniform(noise) - 1.0);
  }
  rig->step(100);
  rig->mode_of_all(kDriveOff);
}

class FreeFall : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(FreeFall, KeepsBothMomenta) {
  Rig rig;
  rig.params.solver = std::get<1>(GetParam());
  rig.params.start_height_m = 50.0;
  rig.params.joint_friction_scale = 0.0;
  set_tumbling(&rig, static_cast<std::uint64_t>(std::get<0>(GetParam())));
  const Momentum before = momentum(rig.state());
  double fastest_joint_rad_s = 0.0;
  for (const double rate : rig.out().true_qd_rad_s)
    fastest_joint_rad_s = std::fmax(fastest_joint_rad_s, std::fabs(rate));
  EXPECT_GT(fastest_joint_rad_s, 0.5) << "the joints must move for this to mean anything";
  rig.step(2000);
  const Momentum after = momentum(rig.state());
  const Vec3 gained = after.linear_W_Ns - before.linear_W_Ns;
  EXPECT_NEAR(-kMg_N * 2.0, gained.z, 1e-4 * kMg_N * 2.0);
  EXPECT_NEAR(0.0, gained.x, 1e-4 * norm(before.linear_W_Ns));
  EXPECT_NEAR(0.0, gained.y, 1e-4 * norm(before.linear_W_Ns));
  const double turned =
      norm(after.angular_com_W_Nms - before.angular_com_W_Nms) / norm(before.angular_com_W_Nms);
  RecordProperty("angular_momentum_error", std::to_string(turned));
  // 1e-4 is what is asked for. The plant's gyroscopic torque keeps it five times better, and worse is a
  // fault.
  EXPECT_LT(turned, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Articulated, FreeFall,
                         ::testing::Combine(::testing::Range(1, 9),
                                            ::testing::Values(HOAP2_SOLVER_ARTICULATED)));
INSTANTIATE_TEST_SUITE_P(Ode, FreeFall,
                         ::testing::Combine(::testing::Range(1, 3), ::testing::Values(HOAP2_SOLVER_ODE)));

class FreeMotion : public WithEachSolver {};

// Kinetic energy after 0.1 s of moving joints over the one before it, the friction
// switched on in between.
double energy_kept(double joint_friction_scale) {
  Rig rig;
  rig.float_free();
  rig.params.start_posture_rad[HOAP2_J_WAIST_PITCH] = 0.5;  // away from its stops
  set_tumbling(&rig, 9, 0.0);
  State moving = rig.state();
  moving.params.joint_friction_scale = joint_friction_scale;
  EXPECT_EQ(0, rig.restore(moving));
  double energy_J = kinetic_energy_J(moving);
  for (int i = 0; i < 100; ++i) {
    rig.step();
    const double next_J = kinetic_energy_J(rig.state());
    EXPECT_LT(next_J, energy_J * (1.0 + 1e-4)) << "tick " << i;
    energy_J = next_J;
  }
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    EXPECT_GE(rig.out().true_q_rad[j], HOAP2_JOINT[j].limit_hard_rad[0]) << "a stop would store energy";
    EXPECT_LE(rig.out().true_q_rad[j], HOAP2_JOINT[j].limit_hard_rad[1]) << "a stop would store energy";
  }
  return energy_J / kinetic_energy_J(moving);
}

TEST_P(FreeMotion, EnergyIsKeptWithoutFrictionAndTakenByIt) {
  EXPECT_NEAR(1.0, energy_kept(0.0), 2e-3);
  EXPECT_LT(energy_kept(1.0), 0.9);
  EXPECT_LT(energy_kept(10.0), 1e-3);
}

TEST_P(FreeMotion, APushGivesItsImpulse) {
  Rig rig;
  rig.float_free();
  rig.params.push_link[2] = HOAP2_L_CHEST;
  rig.params.push_force_W_N[2][0] = 8.0;
  rig.params.push_force_W_N[2][1] = -5.0;
  rig.params.push_point_L_m[2][2] = 0.1;
  rig.params.push_start_s[2] = 0.05;
  rig.params.push_duration_s[2] = 0.1;
  rig.params.push_ramp_s[2] = 0.02;
  rig.start();
  rig.step(50);
  EXPECT_NEAR(0.0, rig.out().true_push_force_W_N[0], 1e-12);
  EXPECT_NEAR(0.0, norm(momentum(rig.state()).linear_W_Ns), 1e-9);
  rig.step(50);
  EXPECT_NEAR(8.0, rig.out().true_push_force_W_N[0], 1e-12);
  rig.step(100);
  EXPECT_NEAR(0.0, rig.out().true_push_force_W_N[0], 1e-12);
  const Momentum after = momentum(rig.state());
  // Each quintic ramp holds half of its rectangle.
  EXPECT_NEAR(8.0 * 0.08, after.linear_W_Ns.x, 1e-6);
  EXPECT_NEAR(-5.0 * 0.08, after.linear_W_Ns.y, 1e-6);
  EXPECT_NEAR(0.0, after.linear_W_Ns.z, 1e-6);
}

TEST_P(FreeMotion, APushTurnsAboutTheComByItsLever) {
  Rig rig;
  rig.float_free();
  rig.params.push_link[0] = HOAP2_L_CHEST;
  rig.params.push_force_W_N[0][0] = 10.0;
  rig.params.push_point_L_m[0][2] = 0.12;
  rig.params.push_duration_s[0] = 0.004;
  rig.start();
  const Vec3 lever =
      point_W_m(rig.state(), HOAP2_L_CHEST, Vec3{0.0, 0.0, 0.12}) - vec(rig.out().true_com_W_m);
  rig.step(10);
  const Vec3 expected = cross(lever, Vec3{0.04, 0.0, 0.0});
  const Vec3 actual = momentum(rig.state()).angular_com_W_Nms;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(expected[i], actual[i], 1e-3 * norm(expected)) << i;
}

// The operator's push does what a planned one does, and is added to it.
TEST_P(FreeMotion, APushFromOutsideActsWhileItIsHeld) {
  Rig planned, live;
  for (Rig *rig : {&planned, &live}) {
    rig->float_free();
    rig->params.push_link[1] = HOAP2_L_CHEST;
    rig->params.push_force_W_N[1][2] = 2.0;
    rig->params.push_duration_s[1] = 1.0;
  }
  planned.params.push_link[0] = HOAP2_L_HEAD;
  planned.params.push_force_W_N[0][0] = 6.0;
  planned.params.push_force_W_N[0][1] = -4.0;
  planned.params.push_point_L_m[0][2] = 0.05;
  planned.params.push_start_s[0] = 0.05;
  planned.params.push_duration_s[0] = 0.1;
  planned.start();
  live.start();
  live.inputs.push_now_link = HOAP2_L_HEAD;
  live.inputs.push_now_point_L_m[2] = 0.05;
  for (int tick = 0; tick < 200; ++tick) {
    const bool on = tick >= 50 && tick < 150;
    live.inputs.push_now_force_W_N[0] = on ? 6.0 : 0.0;
    live.inputs.push_now_force_W_N[1] = on ? -4.0 : 0.0;
    planned.step();
    live.step();
    ASSERT_EQ(on ? 6.0 : 0.0, live.out().true_push_force_W_N[0]) << tick;
    ASSERT_EQ(2.0, live.out().true_push_force_W_N[2]) << tick;
    for (int i = 0; i < 3; ++i)
      ASSERT_NEAR(planned.out().true_com_rate_W_m_s[i], live.out().true_com_rate_W_m_s[i], 1e-12) << tick;
  }
  const Momentum after = momentum(live.state());
  EXPECT_NEAR(6.0 * 0.1, after.linear_W_Ns.x, 1e-6);
  EXPECT_NEAR(-4.0 * 0.1, after.linear_W_Ns.y, 1e-6);
  EXPECT_NEAR(2.0 * 0.2, after.linear_W_Ns.z, 1e-6);
  EXPECT_GT(norm(after.angular_com_W_Nms), 1e-3);
}

TEST(PushProfile, IsSmoothAndEndsInTime) {
  EXPECT_EQ(0.0, push_profile(-1e-9, 0.1, 0.0));
  EXPECT_EQ(1.0, push_profile(0.0, 0.1, 0.0));
  EXPECT_EQ(0.0, push_profile(0.1, 0.1, 0.0));
  EXPECT_NEAR(0.5, push_profile(0.01, 0.1, 0.02), 1e-12);
  EXPECT_NEAR(0.5, push_profile(0.09, 0.1, 0.02), 1e-12);
  EXPECT_NEAR(1.0, push_profile(0.05, 0.1, 1.0), 1e-12) << "ramps longer than the push meet in its middle";
}

TEST_P(FreeMotion, StopsHoldTheJoints) {
  Rig rig;
  rig.float_free();
  rig.start();
  rig.mode_of_all(kDriveTorque);
  rig.inputs.tau_ff_Nm[HOAP2_J_R_KNEE] = -3.0;
  rig.inputs.tau_ff_Nm[HOAP2_J_L_ANKLE_ROLL] = 3.0;
  rig.step(1500);
  const hoap2_plant_outputs_t out = rig.out();
  EXPECT_NEAR(HOAP2_JOINT[HOAP2_J_R_KNEE].limit_hard_rad[0], out.true_q_rad[HOAP2_J_R_KNEE], 0.003);
  EXPECT_NEAR(HOAP2_JOINT[HOAP2_J_L_ANKLE_ROLL].limit_hard_rad[1], out.true_q_rad[HOAP2_J_L_ANKLE_ROLL],
              0.003);
}

INSTANTIATE_WITH_EACH_SOLVER(FreeMotion);

}  // namespace
}  // namespace hoap2_sim
