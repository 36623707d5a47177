// Random parameters and random sensor readings: the controller refuses or copes, it never breaks.
#include <gtest/gtest.h>

#include <cstddef>

#include "ideal_robot.hpp"
#include "random_posture.hpp"

namespace {

using namespace hoap2_tests;

constexpr size_t kRealOutputs = offsetof(hoap2_outputs_t, drive_mode) / sizeof(double);

void expect_sound(const hoap2_outputs_t& out, const hoap2_outputs_t& last) {
  const double* values = reinterpret_cast<const double*>(&out);
  for (size_t i = 0; i < kRealOutputs; ++i) ASSERT_TRUE(std::isfinite(values[i])) << "output " << i;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    ASSERT_LE(std::fabs(out.q_ref_rad[j] - last.q_ref_rad[j]),
              HOAP2_JOINT[j].velocity_limit_rad_s * kTick * (1 + 1e-9))
        << "joint " << j;
  }
}

hoap2_params_t random_params(RandomPosture& random) {
  hoap2_params_t params = default_params();
  params.start_up_s = 0.3;
  params.calibrate_s = 0.1;
  params.hip_height_m = random.uniform(0.205, 0.232);
  params.step_length_m = random.uniform(-0.04, 0.04);
  params.step_width_m = random.uniform(0.07, 0.1);
  params.step_sideways_m = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : random.uniform(-0.015, 0.015);
  params.step_turn_rad = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : random.uniform(-0.12, 0.12);
  params.step_time_s = random.uniform(0.35, 1.0);
  params.ds_fraction = random.uniform(0.05, 0.2);
  params.lift_m = random.uniform(0.005, 0.03);
  params.cp_offset_inward_m = random.uniform(0.0, 0.02);
  params.first_swing_foot = random.uniform(0.0, 1.0) < 0.5 ? 0 : 1;
  params.cop_profile = random.uniform(0.0, 1.0) < 0.5 ? 0 : 1;
  params.cp_controller = static_cast<int32_t>(random.uniform(0.0, 2.999));
  params.steps_forward = static_cast<int32_t>(random.uniform(0.0, 6.999));
  params.steps_in_place = 2;
  return params;
}

TEST(RandomUse, AWalkIsRefusedAtTheStartOrTakenToItsEnd) {
  RandomPosture random(71);
  int walked = 0;
  int refused = 0;
  int clipped = 0;  // the feedback may take a walk on the brink to a joint limit, which is told
  for (int n = 0; n < 150; ++n) {
    hoap2_params_t params = random_params(random);
    params.landing_control = n % 2;
    params.lpc_moves_cp = n / 2 % 2;
    Loop loop(params);
    if (loop.init_fault != 0) {
      ASSERT_EQ(loop.out.mode, HOAP2_MODE_SAFE);
      ++refused;
      continue;
    }
    for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) {
      const hoap2_outputs_t last = loop.out;
      loop.tick();
      expect_sound(loop.out, last);
      if (HasFatalFailure()) FAIL() << "walk " << n;
    }
    EXPECT_EQ(loop.out.walk_done, 1) << "walk " << n;
    EXPECT_EQ(loop.out.fault & ~HOAP2_FAULT_JOINT_LIMIT, 0) << "walk " << n;
    clipped += loop.out.fault != 0;
    EXPECT_EQ(loop.out.steps_done, params.steps_forward + params.steps_in_place) << "walk " << n;
    ++walked;
  }
  EXPECT_GT(walked, 30);
  EXPECT_GT(refused, 10);
  EXPECT_LE(clipped, 2);
}

// Readings within what the watchdog lets pass, without any sense.
TEST(RandomUse, NonsenseFromTheSensorsStaysWithinTheLimits) {
  RandomPosture random(72);
  for (int controller = 0; controller < 3; ++controller) {
    hoap2_params_t params = default_params();
    params.start_up_s = 0.3;
    params.calibrate_s = 0.1;
    params.cp_controller = controller;
    params.landing_control = HOAP2_SWITCH_ON;
    params.lpc_moves_cp = controller % 2;
    Loop loop(params);
    for (int k = 0; k < 6000; ++k) {
      for (double& q_rad : loop.in.q_enc_rad) q_rad = random.uniform(-3.4, 3.4);
      for (double& rate : loop.in.gyro_S_rad_s) rate = random.uniform(-19.0, 19.0);
      for (double& accel : loop.in.accel_S_m_s2) accel = random.uniform(-190.0, 190.0);
      for (double& force_N : loop.in.cell_force_N) force_N = random.uniform(-900.0, 900.0);
      const hoap2_outputs_t last = loop.out;
      loop.tick();
      expect_sound(loop.out, last);
      if (HasFatalFailure()) FAIL() << "controller " << controller << ", tick " << k;
    }
  }
}

}  // namespace
