// Bad inputs: a defined safe response and a fault bit, never a reference that is not a number.
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

#include "ideal_robot.hpp"

extern "C" {
#include "core/outputs.h"
}

namespace {

using namespace hoap2_tests;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
// All real inputs lie in front of the integer ones.
// of the sensors; the requests behind them are no sensor values
constexpr size_t kRealInputs = offsetof(hoap2_inputs_t, step_length_request_m) / sizeof(double);
constexpr size_t kRealOutputs = offsetof(hoap2_outputs_t, drive_mode) / sizeof(double);

double& input(hoap2_inputs_t& in, size_t index) { return reinterpret_cast<double*>(&in)[index]; }

void expect_finite(const hoap2_outputs_t& out) {
  const double* values = reinterpret_cast<const double*>(&out);
  for (size_t i = 0; i < kRealOutputs; ++i) ASSERT_TRUE(std::isfinite(values[i])) << "output " << i;
}

hoap2_params_t short_walk() {
  hoap2_params_t params = default_params();
  params.steps_forward = 4;
  params.steps_in_place = 2;
  params.calibrate_s = 0.2;
  params.start_up_s = 0.3;
  return params;
}

// Runs on with the inputs spoiled by `spoil`, until the safe stop; checks every tick.
template <typename Spoil>
void expect_safe_stop(Loop& loop, int32_t fault, Spoil spoil) {
  bool crouched = false;
  for (int k = 0; k < 6000 && loop.out.mode != HOAP2_MODE_SAFE; ++k) {
    spoil(loop.in);
    double last_rad[HOAP2_JOINTS];
    std::copy(loop.out.q_ref_rad, loop.out.q_ref_rad + HOAP2_JOINTS, last_rad);
    loop.tick();
    expect_finite(loop.out);
    if (loop.out.mode == HOAP2_MODE_CROUCH) {
      crouched = true;
      for (int j = 0; j < HOAP2_JOINTS; ++j) {  // from where the references were, gently
        ASSERT_LT(std::fabs(loop.out.q_ref_rad[j] - last_rad[j]), 2.0 * kTick) << "joint " << j;
      }
    }
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      ASSERT_LE(std::fabs(loop.out.q_ref_rad[j] - last_rad[j]),
                HOAP2_JOINT[j].velocity_limit_rad_s * kTick * (1 + 1e-9));
    }
  }
  EXPECT_EQ(loop.out.mode, HOAP2_MODE_SAFE);
  EXPECT_TRUE(loop.out.fault & fault) << loop.out.fault;
  EXPECT_TRUE(crouched);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    EXPECT_NEAR(loop.out.q_ref_rad[j], loop.state.params.crouch_posture_rad[j], 0.01) << "joint " << j;
  }
}

class BadAtTick : public testing::TestWithParam<int> {};

TEST_P(BadAtTick, NotANumberInAnyInputLeadsToTheSafeStop) {
  Loop start(short_walk());
  while (start.out.tick < GetParam()) start.tick();
  for (size_t index = 0; index < kRealInputs; ++index) {
    Loop loop = start;
    expect_safe_stop(loop, HOAP2_FAULT_BAD_INPUT, [index](hoap2_inputs_t& in) { input(in, index) = kNaN; });
    if (HasFailure()) FAIL() << "input " << index;
  }
}

TEST_P(BadAtTick, StaleFramesLeadToTheSafeStop) {
  Loop loop(short_walk());
  while (loop.out.tick < GetParam()) loop.tick();
  const int32_t frozen = loop.in.sensor_tick;
  expect_safe_stop(loop, HOAP2_FAULT_STALE_INPUT, [frozen](hoap2_inputs_t& in) { in.sensor_tick = frozen; });
}

// first tick, start-up, calibration, shift, single support, settled stance
INSTANTIATE_TEST_SUITE_P(Modes, BadAtTick, testing::Values(0, 100, 400, 700, 1100, 4500));

TEST(ControllerFaults, InfinitiesAndAbsurdValuesAreBadToo) {
  Loop start(short_walk());
  while (start.out.tick < 1100) start.tick();
  for (double value : {kInf, -kInf, 1e300, -1e12}) {
    for (size_t index : {size_t{0}, size_t{24}, size_t{25}, size_t{28}, size_t{31}, kRealInputs - 1}) {
      Loop loop = start;
      expect_safe_stop(loop, HOAP2_FAULT_BAD_INPUT, [=](hoap2_inputs_t& in) { input(in, index) = value; });
    }
  }
}

TEST(ControllerFaults, AFewBadFramesAreBridged) {
  const hoap2_params_t params = short_walk();
  Loop loop(params);
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) {
    if (k % 50 < params.stale_limit_ticks) input(loop.in, static_cast<size_t>(k) % kRealInputs) = kNaN;
    loop.tick();
    expect_finite(loop.out);
  }
  EXPECT_EQ(loop.out.fault, 0);
  EXPECT_EQ(loop.out.walk_done, 1);
  EXPECT_EQ(loop.out.steps_done, 6);
}

TEST(ControllerFaults, AFaultIsNeverForgotten) {
  Loop loop(short_walk());
  while (loop.out.tick < 1100) loop.tick();
  for (int k = 0; k < 20; ++k) {
    loop.in.gyro_S_rad_s[1] = kNaN;
    loop.tick();
  }
  for (int k = 0; k < 6000; ++k) loop.tick();  // good again
  EXPECT_TRUE(loop.out.fault & HOAP2_FAULT_BAD_INPUT);
  EXPECT_EQ(loop.out.mode, HOAP2_MODE_SAFE);
  EXPECT_EQ(loop.out.walk_done, 0);
  EXPECT_LT(loop.out.steps_done, 6);
}

TEST(ControllerFaults, AFaultInMidStepLandsTheFootBeforeTheCrouch) {
  Loop loop(short_walk());
  for (int k = 0; k < 3000 && loop.out.phase != HOAP2_PHASE_SINGLE_SUPPORT; ++k) loop.tick();
  ASSERT_EQ(loop.out.phase, HOAP2_PHASE_SINGLE_SUPPORT);
  for (int k = 0; k < 100; ++k) loop.tick();
  while (loop.out.mode != HOAP2_MODE_CROUCH) {
    loop.in.accel_S_m_s2[0] = kNaN;
    loop.tick();
    ASSERT_LT(loop.out.tick, 6000);
  }
  EXPECT_EQ(loop.out.foot_ref_W_m[0][2], 0.0);
  EXPECT_EQ(loop.out.foot_ref_W_m[1][2], 0.0);
}

void expect_no_walk(const hoap2_params_t& params, int32_t fault) {
  Loop loop(params);
  EXPECT_TRUE(loop.init_fault & fault) << loop.init_fault;
  for (int k = 0; k < 3000; ++k) {
    loop.tick();
    ASSERT_EQ(loop.out.mode, HOAP2_MODE_SAFE);
    ASSERT_EQ(loop.out.phase, HOAP2_PHASE_STAND);
    ASSERT_EQ(loop.out.steps_done, 0);
    expect_finite(loop.out);
  }
  EXPECT_TRUE(loop.out.fault & fault);
}

TEST(ControllerFaults, AFootprintOutOfReachIsRefusedBeforeTheWalk) {
  hoap2_params_t params = default_params();
  params.step_length_m = 0.08;
  params.step_time_s = 2.0;
  params.hip_height_m = 0.23;  // nearly straight legs: nothing left for a long step
  expect_no_walk(params, HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH);
  params = default_params();
  params.step_width_m = 0.068;
  params.step_turn_rad = -0.2;  // the soles would meet
  params.step_time_s = 2.0;
  expect_no_walk(params, HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH);
}

TEST(ControllerFaults, AFasterSwingThanTheDrivesIsRefusedBeforeTheWalk) {
  hoap2_params_t params = default_params();
  params.step_time_s = 0.25;
  params.lift_m = 0.04;
  params.ds_fraction = 0.2;
  expect_no_walk(params, HOAP2_FAULT_JOINT_TOO_FAST);
}

TEST(ControllerFaults, ParametersThatDoNotGoTogetherAreRefused) {
  hoap2_params_t params = default_params();
  params.contact_off_N = params.contact_on_N + 1.0;
  expect_no_walk(params, HOAP2_FAULT_BAD_PARAMETER);
  params = default_params();
  params.tpcc_kx_1_s2 = params.tpcc_kp_1_s2;
  expect_no_walk(params, HOAP2_FAULT_BAD_PARAMETER);
  params = default_params();
  params.crouch_posture_rad[HOAP2_J_R_KNEE] = -0.5;
  expect_no_walk(params, HOAP2_FAULT_BAD_PARAMETER);
}

TEST(ControllerFaults, APostureBeyondTheLimitsNeverReachesTheDrives) {
  hoap2_params_t params = default_params();
  params.posture_rad[HOAP2_J_R_ELBOW] = 3.0;
  hoap2_state_t state;
  EXPECT_NE(hoap2_init(&state, &params), 0);
  hoap2_outputs_t out;
  hoap2_get_outputs(&state, &out);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    EXPECT_GE(out.q_ref_rad[j], HOAP2_JOINT[j].limit_soft_rad[0]) << "joint " << j;
    EXPECT_LE(out.q_ref_rad[j], HOAP2_JOINT[j].limit_soft_rad[1]) << "joint " << j;
  }
}

TEST(ControllerFaults, StartUpWaitsForTheFirstGoodFrame) {
  hoap2_params_t params = short_walk();
  params.posture_rad[HOAP2_J_R_ELBOW] = -1.0;
  Loop loop(params);
  for (int k = 0; k < 3; ++k) {
    loop.in.gyro_S_rad_s[0] = kNaN;
    loop.tick();
    EXPECT_EQ(loop.out.mode, HOAP2_MODE_START_UP);
    EXPECT_EQ(loop.out.q_ref_rad[HOAP2_J_R_ELBOW], -1.0);
  }
  loop.tick();
  EXPECT_EQ(loop.state.mode.mode_tick, 1);
  EXPECT_NEAR(loop.state.start_q_rad[HOAP2_J_R_ELBOW], -1.0, 1e-12);
}

// A leg that meets a joint limit in mid-walk is clipped by the inverse kinematics: the fault word must say
// so.
TEST(ControllerFaults, ALegAtItsJointLimitIsTold) {
  hoap2_state_t state;
  const hoap2_params_t params = short_walk();
  ASSERT_EQ(hoap2_init(&state, &params), 0);
  state.gait.joint_limit = 1;
  state.mode.mode = HOAP2_MODE_SAFE;  // the gait does not run: the flag stays as set
  hoap2_inputs_t in;
  hoap2_inputs_defaults(&in);
  hoap2_outputs_t out;
  hoap2_step(&state, &in, &out);
  EXPECT_TRUE(out.fault & HOAP2_FAULT_JOINT_LIMIT);
}

// Off the soles the pendulum may not run away: the CoM comes back over them, and the walk is not called done.
TEST(ControllerFaults, ALostCapturePointIsAFaultAndTheCoMComesBack) {
  hoap2_params_t params = short_walk();
  params.cp_controller = HOAP2_CP_CONTROLLER_PLAN;
  Loop loop(params);
  while (loop.out.steps_done < 5) loop.tick();
  loop.state.gait.com_rate_m_s[1] += 0.9;  // 0.15 m of capture point
  for (int k = 0; k < 2000; ++k) loop.tick();
  EXPECT_TRUE(loop.out.fault & HOAP2_FAULT_CAPTURE_POINT_LOST);
  EXPECT_EQ(loop.out.walk_done, 0);
  EXPECT_LT(std::fabs(loop.out.com_plan_W_m[1]), 0.075);
}

TEST(ReferenceLimits, RatesAnglesAndNumbers) {
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const hoap2_joint_data_t& joint = HOAP2_JOINT[j];
    const double step_rad = joint.velocity_limit_rad_s * kTick;
    const double middle_rad = 0.5 * (joint.limit_soft_rad[0] + joint.limit_soft_rad[1]);
    double last_rad[HOAP2_JOINTS];
    for (int i = 0; i < HOAP2_JOINTS; ++i) {
      last_rad[i] = 0.5 * (HOAP2_JOINT[i].limit_soft_rad[0] + HOAP2_JOINT[i].limit_soft_rad[1]);
    }
    const auto limited = [&](double from_rad, double wanted_rad, bool met) {
      double q_rad[HOAP2_JOINTS];
      std::copy(last_rad, last_rad + HOAP2_JOINTS, q_rad);
      last_rad[j] = from_rad;
      q_rad[j] = wanted_rad;
      EXPECT_EQ(hoap2_limit_references(last_rad, q_rad), met ? 1 : 0);
      return q_rad[j];
    };
    EXPECT_EQ(limited(middle_rad, middle_rad + 0.5 * step_rad, false), middle_rad + 0.5 * step_rad);
    EXPECT_NEAR(limited(middle_rad, middle_rad + 3.0 * step_rad, false), middle_rad + step_rad, 1e-15);
    EXPECT_NEAR(limited(middle_rad, middle_rad - 3.0 * step_rad, false), middle_rad - step_rad, 1e-15);
    EXPECT_EQ(limited(joint.limit_soft_rad[1], joint.limit_soft_rad[1] + 1e-4, true),
              joint.limit_soft_rad[1]);
    EXPECT_EQ(limited(joint.limit_soft_rad[0], joint.limit_soft_rad[0] - 1e-4, true),
              joint.limit_soft_rad[0]);
    EXPECT_EQ(limited(middle_rad, kNaN, false), middle_rad);
    EXPECT_EQ(limited(middle_rad, kInf, false), middle_rad);
  }
}

}  // namespace
