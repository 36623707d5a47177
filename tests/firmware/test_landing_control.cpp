// Landing position control, (7.14): the law, alone and in the walk, and what the plan does with it.
#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>

#include "gait_cp/landing_control.hpp"
#include "random_posture.hpp"
#include "tilted_loop.hpp"

namespace {

using namespace hoap2_tests;

// ---- the law alone

TEST(LandingLaw, ByHand) {
  using hoap2::next_shift;
  // threshold 2 mm, K_L 0.5, lambda 0.8; deviations 3, -1.9, -4, 0 mm
  double shift_m = 0.0;
  const double extreme_mm[] = {3.0, -1.9, -4.0, 0.0, 2.0, 2.1};
  const double expected_mm[] = {1.5, 1.2, -1.04, -0.832, -0.6656, 0.51752};
  for (int j = 0; j < 6; ++j) {
    shift_m = next_shift(1e-3 * extreme_mm[j], shift_m, 2e-3, 0.5, 0.8);
    EXPECT_NEAR(shift_m, 1e-3 * expected_mm[j], 1e-15) << "step " << j;
  }
}

TEST(LandingLaw, ASteadyDeviationSettlesAtTheSteadyGain) {
  double shift_m = 0.0;
  for (int j = 0; j < 200; ++j) shift_m = hoap2::next_shift(-0.004, shift_m, 0.002, 0.45, 0.7);
  EXPECT_NEAR(shift_m, -0.004 * 0.45 / (1.0 - 0.7), 1e-15);
}

// ---- in the walk

TEST(LandingControl, NothingIsShiftedOnARobotThatFollows) {
  for (int kind = 0; kind < 4; ++kind) {
    hoap2_params_t params = lpc_params();
    params.step_time_s = 0.5;
    if (kind == 1) params.step_turn_rad = 0.06;
    if (kind == 2) params.step_sideways_m = 0.008;
    if (kind == 3) params.cp_controller = HOAP2_CP_CONTROLLER_CPS;
    TiltedLoop on(params);
    params.landing_control = HOAP2_SWITCH_OFF;
    Loop off(params);
    while (!on.loop.finished() && on.loop.out.tick < tick_limit(params)) {
      on.tick();
      off.tick();
      for (int j = 0; j < HOAP2_JOINTS; ++j)  // to the bit
        ASSERT_EQ(on.loop.out.q_ref_rad[j], off.out.q_ref_rad[j]) << "kind " << kind << " joint " << j;
      ASSERT_EQ(on.loop.out.landing_shift_W_m[0], 0.0);
      ASSERT_EQ(on.loop.out.landing_shift_W_m[1], 0.0);
    }
    EXPECT_EQ(on.loop.out.walk_done, 1);
  }
}

TEST(LandingControl, SwitchedOffNoDeviationMovesAFoot) {
  hoap2_params_t params = lpc_params();
  params.landing_control = HOAP2_SWITCH_OFF;
  params.step_turn_rad = 0.03;
  TiltedLoop tilted(params);
  params.lpc_gain[0] = params.lpc_gain[1] = 2.0;
  params.lpc_threshold_m[0] = params.lpc_threshold_m[1] = 0.0;
  params.lpc_moves_cp = HOAP2_SWITCH_ON;
  TiltedLoop other(params);
  const auto lean = [](TiltedLoop& robot) {
    robot.target_rad[0] = 3 * kDeg;
    robot.target_rad[1] = -4 * kDeg;
  };
  const std::vector<Step> steps = walk(tilted, lean);
  walk(other, lean);
  ASSERT_EQ(steps.size(), 21u);
  for (size_t j = 1; j < steps.size(); ++j) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(steps[j].land[i], steps[j].nominal[i]) << "step " << j;
    EXPECT_GT(std::fabs(steps[j].extreme[0]), 0.01);  // there was something to react to
  }
  for (int j = 0; j < HOAP2_JOINTS; ++j) EXPECT_EQ(tilted.loop.out.q_ref_rad[j], other.loop.out.q_ref_rad[j]);
}

// The CoM of a robot that leans by theta about its foot lies z_C sin(theta) off: back when it leans back.
TEST(LandingControl, ALeanIsSensedAsTheCoMBesideItsReference) {
  TiltedLoop tilted(lpc_params());
  walk(tilted, [](TiltedLoop& robot) {
    robot.target_rad[0] = 1.0 * kDeg;
    robot.target_rad[1] = -2.0 * kDeg;
  });
  const double height_m = tilted.loop.out.com_ref_W_m[2];
  EXPECT_NEAR(tilted.loop.out.com_deviation_W_m[0], height_m * std::sin(-2.0 * kDeg), 1e-4);
  EXPECT_NEAR(tilted.loop.out.com_deviation_W_m[1], -height_m * std::sin(1.0 * kDeg), 1e-4);
}

TEST(LandingControl, ALeanBackMovesTheLandingsBack) {
  for (double sign : {-1.0, 1.0}) {
    TiltedLoop tilted(lpc_params(24, 4));
    const std::vector<Step> steps =
        walk(tilted, [sign](TiltedLoop& robot) { robot.target_rad[1] = sign * 1.5 * kDeg; });
    ASSERT_EQ(steps.size(), 29u);
    // the steady gain of (7.14); the reference is delayed by more than this robot, which adds up to 0.9 mm
    const double deviation_m = sign * 0.2575 * std::sin(1.5 * kDeg);
    EXPECT_NEAR(steps[20].shift[0], 1.5 * deviation_m, 1.5 * 9e-4);
    EXPECT_LT(std::fabs(steps[20].shift[1]), 1e-4);
    for (size_t j = 2; j < steps.size(); ++j) EXPECT_GT(sign * steps[j].shift[0], 0.0) << "step " << j;
    EXPECT_EQ(tilted.loop.out.walk_done, 1);
    EXPECT_EQ(tilted.loop.out.fault, 0);
  }
}

TEST(LandingControl, ALeanAsideMovesBothFeetThatWay) {
  for (double sign : {-1.0, 1.0}) {
    TiltedLoop tilted(lpc_params(24, 4));
    const std::vector<Step> steps =
        walk(tilted, [sign](TiltedLoop& robot) { robot.target_rad[0] = sign * 2.0 * kDeg; });
    const double deviation_m = -sign * 0.2575 * std::sin(2.0 * kDeg);  // +roll leans to the right
    for (size_t j = 15; j < 23; ++j)
      EXPECT_NEAR(steps[j].shift[1], 1.5 * deviation_m, 1.5 * 2.5e-3) << "step " << j;
    EXPECT_EQ(tilted.loop.out.fault, 0);
  }
}

// (7.14) from the deviation that the controller states, tick by tick, at every step of walks of all kinds.
// Small deviations, so that no limit has a say.
struct LawCase {
  const char* name;
  double turn_rad;
  double sideways_m;
  int moves_cp;
};

void PrintTo(const LawCase& law, std::ostream* os) { *os << law.name; }

class LandingLawInTheWalk : public testing::TestWithParam<LawCase> {};

TEST_P(LandingLawInTheWalk, HoldsAtEveryStep) {
  hoap2_params_t params = lpc_params(20, 4);
  params.step_time_s = 0.5;
  params.step_turn_rad = GetParam().turn_rad;
  params.step_sideways_m = GetParam().sideways_m;
  params.lpc_moves_cp = GetParam().moves_cp;
  params.lpc_gain[1] = 0.3;
  params.lpc_forget[1] = 0.5;
  params.step_width_m = 0.085;
  RandomPosture random(84);
  TiltedLoop tilted(params);
  const std::vector<Step> steps = walk(tilted, [&random](TiltedLoop& robot) {
    if (robot.loop.out.tick % 300 != 0) return;
    robot.target_rad[0] = random.uniform(-2.2, 2.2) * kDeg;
    robot.target_rad[1] = random.uniform(-1.0, 1.0) * kDeg;
  });
  ASSERT_EQ(steps.size(), 25u);
  double shift[2] = {0.0, 0.0};
  int acted[2] = {0, 0};
  int ignored[2] = {0, 0};
  for (size_t j = 1; j + 1 < steps.size(); ++j) {  // the last step has its own rule
    for (int i = 0; i < 2; ++i) {
      const double extreme_m = steps[j - 1].extreme[i];
      const bool counts = std::fabs(extreme_m) > params.lpc_threshold_m[i];
      ++(counts ? acted : ignored)[i];
      shift[i] = params.lpc_gain[i] * (counts ? extreme_m : 0.0) + params.lpc_forget[i] * shift[i];
      ASSERT_NEAR(steps[j].shift[i], shift[i], 1e-12) << "step " << j << " axis " << i;
    }
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_GE(acted[i], 5);
    EXPECT_GE(ignored[i], 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, LandingLawInTheWalk,
                         testing::Values(LawCase{"forward", 0.0, 0.0, 0}, LawCase{"moves_cp", 0.0, 0.0, 1},
                                         LawCase{"left_turn", 0.06, 0.0, 0},
                                         LawCase{"sideways", 0.0, -0.008, 0}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

// What is remembered is the shift that was made: after a limit it decays at once.
TEST(LandingControl, ALimitedShiftDecaysFromItsLimit) {
  hoap2_params_t params = lpc_params(24, 4);
  params.lpc_limit_m = 0.005;
  TiltedLoop tilted(params);
  int straight_at = 0;
  const std::vector<Step> steps = walk(tilted, [&straight_at](TiltedLoop& robot) {
    const bool lean = robot.gait().step_index < 10;
    if (!lean && straight_at == 0) straight_at = robot.gait().step_index;
    robot.target_rad[1] = lean ? -3.0 * kDeg : 0.0;
  });
  ASSERT_EQ(straight_at, 10);
  for (size_t j = 3; j <= 11; ++j) EXPECT_NEAR(steps[j].shift[0], -0.005, 1e-15) << "step " << j;
  for (size_t j = 12; j <= 20; ++j)
    EXPECT_NEAR(steps[j].shift[0], 0.7 * steps[j - 1].shift[0], 1e-15) << "step " << j;
}

// The reference is the one that the torso compliance has moved: following it is no deviation.
TEST(LandingControl, TheComplianceIsNoDeviation) {
  TiltedLoop tilted(lpc_params(24, 4));
  double yielded_m = 0.0;
  const std::vector<Step> steps = walk(tilted, [&yielded_m](TiltedLoop& robot) {
    hoap2_inputs_t& in = robot.loop.in;
    for (int foot = 0; foot < 2; ++foot) {  // all the load on the front cells
      for (int cell = 0; cell < 2; ++cell) {
        in.cell_force_N[4 * foot + cell] += in.cell_force_N[4 * foot + 2 + cell];
        in.cell_force_N[4 * foot + 2 + cell] = 0.0;
      }
    }
    yielded_m = std::max(yielded_m, robot.gait().tpcc_m[0]);
  });
  EXPECT_GT(yielded_m, 0.004);
  for (const Step& step : steps) EXPECT_LT(std::fabs(step.extreme[0]), 1.5e-3);
}

// A lean in the robot's own axes gives the same shift in the walk's axes, wherever the walk has turned to.
TEST(LandingControl, TheShiftTurnsWithTheWalk) {
  hoap2_params_t params = lpc_params(24, 4);
  params.step_time_s = 0.5;
  params.step_turn_rad = 0.06;
  const auto lean = [](TiltedLoop& robot) { robot.target_rad[1] = -1.5 * kDeg; };
  TiltedLoop turning(params);
  const std::vector<Step> steps = walk(turning, lean);
  EXPECT_GT(steps[24].nominal[2], 1.3);  // by 80 deg
  EXPECT_NEAR(steps[24].shift[0], -0.2575 * std::sin(1.5 * kDeg) * 1.5, 6e-4);
  EXPECT_NEAR(steps[24].shift[1], 0.0, 6e-4);
}

TEST(LandingControl, TheStartPoseTurnsTheOutputsOnly) {
  hoap2_params_t params = lpc_params(12, 4);
  params.step_turn_rad = 0.04;
  TiltedLoop here(params);
  here.target_rad[0] = -1.0 * kDeg;  // before the calibration too: it is how the robot stands
  here.target_rad[1] = -1.0 * kDeg;
  params.start_pos_W_m[0] = -2000.0;
  params.start_pos_W_m[1] = 700.0;
  params.start_yaw_W_rad = 2.2;
  hoap2_state_t there;
  ASSERT_EQ(hoap2_init(&there, &params), 0);
  const double c = std::cos(2.2);
  const double s = std::sin(2.2);
  double largest_m = 0.0;
  for (int k = 0; k < tick_limit(params); ++k) {
    const hoap2_inputs_t in = here.loop.in;
    here.tick();
    hoap2_outputs_t out;
    hoap2_step(&there, &in, &out);
    for (int j = 0; j < HOAP2_JOINTS; ++j)
      ASSERT_NEAR(out.q_ref_rad[j], here.loop.out.q_ref_rad[j], 1e-9) << "joint " << j << ", tick " << k;
    for (const auto signal : {&hoap2_outputs_t::com_deviation_W_m, &hoap2_outputs_t::landing_shift_W_m}) {
      const double* at_O = here.loop.out.*signal;
      ASSERT_NEAR((out.*signal)[0], c * at_O[0] - s * at_O[1], 1e-9);
      ASSERT_NEAR((out.*signal)[1], s * at_O[0] + c * at_O[1], 1e-9);
    }
    largest_m = std::max(largest_m, std::fabs(here.loop.out.landing_shift_W_m[0]));
  }
  EXPECT_GT(largest_m, 0.003);
}

TEST(LandingControl, AWalkNarrowerThanTheSpacingIsRefused) {
  hoap2_params_t params = lpc_params();
  params.lpc_min_spacing_m = 0.08;
  hoap2_state_t state;
  EXPECT_TRUE(hoap2_init(&state, &params) & HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH);
  params.landing_control = HOAP2_SWITCH_OFF;
  EXPECT_EQ(hoap2_init(&state, &params), 0);
}

// After a fault nothing sensed counts: the deviation of a dead sensor moves no foot.
TEST(LandingControl, AfterAFaultTheWalkEndsOnTheFeetItHas) {
  TiltedLoop tilted(lpc_params());
  tilted.target_rad[1] = 0.0;
  while (tilted.loop.out.steps_done < 5) tilted.tick();
  const double shift_m = tilted.loop.out.landing_shift_W_m[0];
  for (int k = 0; k < 4000 && tilted.loop.out.mode != HOAP2_MODE_SAFE; ++k) {
    tilted.loop.in.accel_S_m_s2[0] = std::numeric_limits<double>::quiet_NaN();
    for (double& q_rad : tilted.loop.in.q_enc_rad) q_rad = 1.0;
    tilted.tick();
    ASSERT_EQ(tilted.loop.out.landing_shift_W_m[0], shift_m);
    if (tilted.loop.out.mode < HOAP2_MODE_HOLD) continue;
    for (double value : tilted.loop.out.com_deviation_W_m) ASSERT_EQ(value, 0.0);
  }
  EXPECT_EQ(tilted.loop.out.mode, HOAP2_MODE_SAFE);
}

}  // namespace
