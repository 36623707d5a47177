// The controller as a value: determinism, cloning, start pose, parameters.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "ideal_robot.hpp"

namespace {

using namespace hoap2_tests;

hoap2_params_t short_walk() {
  hoap2_params_t params = default_params();
  params.steps_forward = 4;
  params.steps_in_place = 2;
  params.step_turn_rad = 0.05;
  return params;
}

bool same_bytes(const hoap2_outputs_t& a, const hoap2_outputs_t& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(ControllerState, SizeIsTold) { EXPECT_EQ(hoap2_state_size(), sizeof(hoap2_state_t)); }

TEST(ControllerState, TwoRunsGiveTheSameBytes) {
  Loop first(short_walk());
  Loop second(short_walk());
  ASSERT_EQ(first.init_fault, 0);
  for (int k = 0; k < tick_limit(short_walk()); ++k) {
    first.tick();
    second.tick();
    ASSERT_TRUE(same_bytes(first.out, second.out)) << "tick " << k;
  }
  EXPECT_EQ(first.out.walk_done, 1);
}

TEST(ControllerState, InitDoesNotDependOnWhatWasInTheMemory) {
  const hoap2_params_t params = short_walk();
  hoap2_state_t a;
  hoap2_state_t b;
  std::memset(&a, 0x00, sizeof a);
  std::memset(&b, 0xA5, sizeof b);
  hoap2_init(&a, &params);
  hoap2_init(&b, &params);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST(ControllerState, ACopyOfTheBytesContinuesBitForBit) {
  const hoap2_params_t params = short_walk();
  Loop loop(params);
  for (int copy_at : {1, 700, 2500, 3300}) {
    while (loop.out.tick < copy_at) loop.tick();
    Loop clone(params);
    std::memcpy(&clone.state, &loop.state, sizeof loop.state);
    clone.in = loop.in;
    clone.out = loop.out;
    clone.robot = loop.robot;
    Loop original = loop;
    for (int k = 0; k < 1500; ++k) {
      original.tick();
      clone.tick();
      ASSERT_TRUE(same_bytes(original.out, clone.out)) << "copied at " << copy_at << ", tick " << k;
    }
    ASSERT_EQ(std::memcmp(&original.state, &clone.state, sizeof clone.state), 0);
  }
}

// A state is hashed and compared as bytes, so what lies between the members of a caller's structs stays
// outside.
TEST(ControllerState, PaddingOfTheCallersStructsStaysOutside) {
  hoap2_state_t states[2];
  for (int which = 0; which < 2; ++which) {
    const int dirt = which == 0 ? 0x00 : 0xA5;
    hoap2_params_t params;
    std::memset(&params, dirt, sizeof params);
    hoap2_params_defaults(&params);
    ASSERT_EQ(hoap2_init(&states[which], &params), 0);
    hoap2_inputs_t in;
    hoap2_outputs_t out;
    std::memset(&in, dirt, sizeof in);
    hoap2_inputs_defaults(&in);
    for (int32_t k = 0; k < 3; ++k) {
      in.sensor_tick = k;
      hoap2_step(&states[which], &in, &out);
    }
  }
  EXPECT_EQ(std::memcmp(&states[0], &states[1], sizeof states[0]), 0);
}

TEST(ControllerState, TheLastOutputsCanBeReadAgain) {
  Loop loop(short_walk());
  for (int k = 0; k < 2500; ++k) loop.tick();
  hoap2_outputs_t again;
  hoap2_get_outputs(&loop.state, &again);
  EXPECT_TRUE(same_bytes(loop.out, again));
}

// The inputs of a walk at the origin, replayed into a controller that starts elsewhere.
TEST(ControllerState, StartPoseDoesNotTouchTheJoints) {
  hoap2_params_t params = short_walk();
  Loop here(params);
  params.start_pos_W_m[0] = 1000.0;
  params.start_pos_W_m[1] = -500.0;
  params.start_yaw_W_rad = 130.0 * 3.14159265358979323846 / 180.0;
  hoap2_state_t there;
  ASSERT_EQ(hoap2_init(&there, &params), 0);
  const double c = std::cos(params.start_yaw_W_rad);
  const double s = std::sin(params.start_yaw_W_rad);
  for (int k = 0; k < tick_limit(params); ++k) {
    const hoap2_inputs_t in = here.in;
    here.tick();
    hoap2_outputs_t out;
    hoap2_step(&there, &in, &out);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      ASSERT_NEAR(out.q_ref_rad[j], here.out.q_ref_rad[j], 1e-9) << "joint " << j << ", tick " << k;
    }
    const double* com = here.out.com_plan_W_m;
    ASSERT_NEAR(out.com_plan_W_m[0], 1000.0 + c * com[0] - s * com[1], 1e-9);
    ASSERT_NEAR(out.com_plan_W_m[1], -500.0 + s * com[0] + c * com[1], 1e-9);
    ASSERT_NEAR(out.foot_ref_yaw_W_rad[0], params.start_yaw_W_rad + here.out.foot_ref_yaw_W_rad[0], 1e-12);
  }
  EXPECT_EQ(here.out.walk_done, 1);
}

void expect_refused(const hoap2_params_t& params) {
  hoap2_state_t state;
  EXPECT_TRUE(hoap2_init(&state, &params) & HOAP2_FAULT_BAD_PARAMETER);
  hoap2_inputs_t in;
  hoap2_inputs_defaults(&in);
  hoap2_outputs_t out;
  for (int k = 0; k < 3000; ++k) {
    in.sensor_tick = k;
    hoap2_step(&state, &in, &out);
    ASSERT_EQ(out.mode, HOAP2_MODE_SAFE);
    ASSERT_TRUE(out.fault & HOAP2_FAULT_BAD_PARAMETER);
    for (double q_rad : out.q_ref_rad) ASSERT_TRUE(std::isfinite(q_rad));
  }
}

TEST(ControllerState, ParametersOutOfRangeAreRefused) {
  hoap2_params_t params = default_params();
  params.step_time_s = 0.0;
  expect_refused(params);
  params = default_params();
  params.step_length_m = std::numeric_limits<double>::quiet_NaN();
  expect_refused(params);
  params = default_params();
  params.posture_rad[7] = std::numeric_limits<double>::infinity();
  expect_refused(params);
  params = default_params();
  params.behaviour = 99;
  expect_refused(params);
  params = default_params();
  params.steps_forward = -1;
  expect_refused(params);
}

TEST(ControllerState, TuningChangesTunableParametersOnlyAndRefusesBadOnes) {
  Loop loop(short_walk());
  hoap2_params_t wanted = loop.state.params;
  wanted.tpcc_kp_1_s2 = 11.0;
  wanted.step_length_m = 0.03;
  EXPECT_EQ(hoap2_tune(&loop.state, &wanted), 0);
  EXPECT_EQ(loop.state.params.tpcc_kp_1_s2, 11.0);
  EXPECT_EQ(loop.state.params.step_length_m, short_walk().step_length_m);
  wanted.tpcc_kp_1_s2 = 12.0;
  wanted.tpcc_kv_1_s = -1.0;
  EXPECT_GT(hoap2_tune(&loop.state, &wanted), 0);
  EXPECT_EQ(loop.state.params.tpcc_kp_1_s2, 11.0);
}

TEST(ControllerState, TuningTakesArraysAndRefusesWhatDoesNotGoTogether) {
  Loop loop(short_walk());
  hoap2_params_t wanted = loop.state.params;
  wanted.lpc_gain[1] = 0.31;
  wanted.cp_filter_s = 0.2;
  wanted.cp_offset_inward_m = 0.013;
  wanted.step_time_s = 0.7;
  ASSERT_EQ(hoap2_tune(&loop.state, &wanted), 0);
  hoap2_params_t expected = short_walk();
  expected.lpc_gain[1] = 0.31;
  expected.cp_filter_s = 0.2;
  expected.cp_offset_inward_m = 0.013;
  EXPECT_EQ(std::memcmp(&loop.state.params, &expected, HOAP2_PARAMS_BYTES), 0);
  wanted.lpc_gain[1] = 0.5;
  wanted.tpcc_kx_1_s2 = wanted.tpcc_kp_1_s2;  // the compliance would run to its limit
  EXPECT_EQ(hoap2_tune(&loop.state, &wanted), -1);
  wanted.tpcc_kx_1_s2 = expected.tpcc_kx_1_s2;
  wanted.contact_off_N = wanted.contact_on_N + 1.0;
  EXPECT_EQ(hoap2_tune(&loop.state, &wanted), -1);
  wanted.contact_off_N = expected.contact_off_N;
  wanted.lpc_gain[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hoap2_tune(&loop.state, &wanted), 1);
  EXPECT_EQ(std::memcmp(&loop.state.params, &expected, HOAP2_PARAMS_BYTES), 0);
}

}  // namespace
