// Walking on request: start, stop, another step in mid-walk, and requests that cannot be met.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "gait_cp/footprints.hpp"
#include "gait_cp/gait_cp.h"
#include "gait_cp/walk_plan.hpp"
#include "ideal_robot.hpp"
#include "random_posture.hpp"

namespace {

using namespace hoap2_tests;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// A controller with the ideal robot and somebody who asks.
class Asked : public Loop {
 public:
  explicit Asked(const hoap2_params_t& params) : Loop(params) {}

  void ask(int32_t walk, double length_m = 0.0, double sideways_m = 0.0, double turn_rad = 0.0) {
    walk_ = walk;
    step_[0] = length_m;
    step_[1] = sideways_m;
    step_[2] = turn_rad;
  }

  void tick() {
    in.walk_request = walk_;
    in.step_length_request_m = step_[0];
    in.step_sideways_request_m = step_[1];
    in.step_turn_request_rad = step_[2];
    Loop::tick();
  }

  // Until the step of this number is under way; false when it does not come.
  bool until_step(int32_t index) {
    for (int k = 0; k < 20000 && out.step_index != index; ++k) tick();
    return out.step_index == index;
  }

  bool until_standing() {
    for (int k = 0; k < 20000; ++k) {
      tick();
      if (out.mode == HOAP2_MODE_STAND && out.phase == HOAP2_PHASE_STAND) return true;
    }
    return false;
  }

  void ticks(int count) {
    for (int k = 0; k < count; ++k) tick();
  }

 private:
  int32_t walk_ = HOAP2_WALK_REQUEST_AS_PLANNED;
  double step_[3] = {0.0, 0.0, 0.0};
};

hoap2_params_t standing() {
  hoap2_params_t params = default_params();
  params.behaviour = HOAP2_BEHAVIOUR_STAND;
  return params;
}

// Place of the one foot seen from the other, in its axes, and the turn between them.
void left_seen_from_right(const hoap2_outputs_t& out, double seen[3]) {
  const double yaw = out.foot_ref_yaw_W_rad[0];
  const double dx = out.foot_ref_W_m[1][0] - out.foot_ref_W_m[0][0];
  const double dy = out.foot_ref_W_m[1][1] - out.foot_ref_W_m[0][1];
  seen[0] = std::cos(yaw) * dx + std::sin(yaw) * dy;
  seen[1] = -std::sin(yaw) * dx + std::cos(yaw) * dy;
  seen[2] = out.foot_ref_yaw_W_rad[1] - yaw;
}

void expect_side_by_side(const hoap2_outputs_t& out, double width_m) {
  double seen[3];
  left_seen_from_right(out, seen);
  EXPECT_NEAR(seen[0], 0.0, 1e-12);
  EXPECT_NEAR(seen[1], width_m, 1e-12);
  EXPECT_NEAR(seen[2], 0.0, 1e-12);
}

double middle_x_m(const hoap2_outputs_t& out) {
  return 0.5 * (out.foot_ref_W_m[0][0] + out.foot_ref_W_m[1][0]);
}
double middle_y_m(const hoap2_outputs_t& out) {
  return 0.5 * (out.foot_ref_W_m[0][1] + out.foot_ref_W_m[1][1]);
}

// ---- as planned

TEST(Requests, AsPlannedTheRequestedStepsDoNotCount) {
  hoap2_params_t params = default_params();
  params.steps_forward = 4;
  params.steps_in_place = 2;
  Asked plain(params);
  Asked asked(params);
  asked.ask(HOAP2_WALK_REQUEST_AS_PLANNED, 0.03, kNaN, kInf);
  for (int k = 0; k < tick_limit(params); ++k) {
    plain.tick();
    asked.tick();
    ASSERT_EQ(std::memcmp(&plain.out, &asked.out, sizeof plain.out), 0) << "tick " << k;
  }
  EXPECT_EQ(asked.out.walk_done, 1);
  EXPECT_EQ(asked.out.request_state, HOAP2_REQUEST_STATE_NONE);
}

// ---- stop and start

TEST(Requests, StopEndsThePlannedWalkSideBySideWithTheNextStep) {
  for (int at = 0; at < 3; ++at) {  // early, in the middle, late in a step
    Asked robot(default_params());
    ASSERT_TRUE(robot.until_step(7));
    robot.ticks(10 + 180 * at);
    robot.ask(HOAP2_WALK_REQUEST_STOP);
    robot.tick();
    EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_WAITING);
    ASSERT_TRUE(robot.until_standing());
    EXPECT_EQ(robot.out.steps_done, 8);
    EXPECT_EQ(robot.out.walk_done, 1);
    EXPECT_EQ(robot.out.fault, 0);
    EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_TAKEN);
    EXPECT_NEAR(middle_x_m(robot.out), 7 * default_params().step_length_m, 1e-12);
    expect_side_by_side(robot.out, default_params().step_width_m);
    for (int j = 0; j < HOAP2_JOINTS; ++j)  // the stance of the start
      EXPECT_NEAR(robot.out.q_ref_rad[j], robot.state.stance_q_rad[j], 0.01) << "joint " << j;
  }
}

TEST(Requests, StopBeforeTheFirstLiftTakesOneStepInPlace) {
  Asked robot(default_params());
  while (robot.out.mode != HOAP2_MODE_WALK) robot.tick();
  robot.ask(HOAP2_WALK_REQUEST_STOP);
  ASSERT_TRUE(robot.until_standing());
  EXPECT_EQ(robot.out.steps_done, 1);
  EXPECT_NEAR(middle_x_m(robot.out), 0.0, 1e-12);
  expect_side_by_side(robot.out, default_params().step_width_m);
}

TEST(Requests, StopFromTheBeginningNeverWalks) {
  Asked robot(default_params());
  robot.ask(HOAP2_WALK_REQUEST_STOP);
  for (int k = 0; k < 5000; ++k) {
    robot.tick();
    ASSERT_NE(robot.out.mode, HOAP2_MODE_WALK);
  }
  EXPECT_EQ(robot.out.mode, HOAP2_MODE_STAND);
}

TEST(Requests, AStopTakenBackBeforeTheNextStepChangesNothing) {
  hoap2_params_t params = default_params();
  params.steps_forward = 6;
  params.steps_in_place = 2;
  Asked robot(params);
  ASSERT_TRUE(robot.until_step(3));
  robot.ticks(50);
  robot.ask(HOAP2_WALK_REQUEST_STOP);
  robot.ticks(200);
  robot.ask(HOAP2_WALK_REQUEST_AS_PLANNED);
  ASSERT_TRUE(robot.until_standing());
  EXPECT_EQ(robot.out.steps_done, 8);
}

TEST(Requests, StartsFromStandingGoesOnUntilStopAndStartsAgain) {
  hoap2_params_t params = standing();
  Asked robot(params);
  robot.ticks(3000);
  ASSERT_EQ(robot.out.mode, HOAP2_MODE_STAND);
  double way_m = 0.0;
  for (int walk = 0; walk < 3; ++walk) {
    robot.ask(HOAP2_WALK_REQUEST_WALK, 0.02);
    ASSERT_TRUE(robot.until_step(1)) << "walk " << walk;
    ASSERT_TRUE(robot.until_step(45)) << "walk " << walk;  // more than any plan of the parameters
    robot.tick();
    EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_TAKEN);
    EXPECT_EQ(robot.out.step_advance_m_rad[0], 0.02);
    robot.ask(HOAP2_WALK_REQUEST_STOP);
    ASSERT_TRUE(robot.until_standing());
    way_m += 45 * 0.02;
    EXPECT_EQ(robot.out.steps_done, 46);
    EXPECT_EQ(robot.out.walk_done, 1);
    EXPECT_EQ(robot.out.fault, 0);
    EXPECT_NEAR(middle_x_m(robot.out), way_m, 1e-9);
    EXPECT_NEAR(middle_y_m(robot.out), 0.0, 1e-9);
    expect_side_by_side(robot.out, params.step_width_m);
    robot.ticks(100 * walk);
  }
}

TEST(Requests, AWalkOnRequestEndsWhenTheRequestIsTakenBack) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  ASSERT_TRUE(robot.until_step(6));
  robot.ask(HOAP2_WALK_REQUEST_AS_PLANNED);
  ASSERT_TRUE(robot.until_standing());
  EXPECT_EQ(robot.out.steps_done, 7);
  expect_side_by_side(robot.out, standing().step_width_m);
  robot.ticks(3000);
  EXPECT_EQ(robot.out.mode, HOAP2_MODE_STAND);
}

TEST(Requests, APlannedWalkCanBeTakenOver) {
  hoap2_params_t params = default_params();
  params.steps_forward = 4;
  params.steps_in_place = 2;
  Asked robot(params);
  ASSERT_TRUE(robot.until_step(3));
  robot.ask(HOAP2_WALK_REQUEST_WALK, -0.01);
  ASSERT_TRUE(robot.until_step(20));
  robot.ask(HOAP2_WALK_REQUEST_STOP);
  ASSERT_TRUE(robot.until_standing());
  EXPECT_NEAR(middle_x_m(robot.out), 3 * params.step_length_m - 17 * 0.01, 1e-9);
}

TEST(Requests, AStartThatIsAskedForWhileTheWalkEndsComesAfterIt) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  ASSERT_TRUE(robot.until_step(3));
  robot.ask(HOAP2_WALK_REQUEST_STOP);
  ASSERT_TRUE(robot.until_step(4));
  robot.ticks(5);
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  robot.tick();
  EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_WAITING);
  bool stood = false;
  for (int k = 0; k < 3000 && !(stood && robot.out.step_index == 2); ++k) {
    robot.tick();
    stood = stood || robot.out.mode == HOAP2_MODE_STAND;
  }
  EXPECT_TRUE(stood);
  EXPECT_EQ(robot.out.step_index, 2);
  EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_TAKEN);
}

// Landing position control leaves the feet beside their nominal footprints: the next walk begins where they are.
TEST(Requests, AWalkBeginsWhereTheFeetStand) {
  const hoap2_params_t params = standing();
  hoap2_gait_t gait;
  hoap2_gait_reset(&params, &gait);
  for (int foot = 0; foot < 2; ++foot) {
    gait.foot[foot][0] -= 0.012;
    gait.foot[foot][1] += 0.005;
  }
  gait.com_m[0] -= 0.012;
  gait.com_m[1] += 0.005;
  gait.request = {{0.0, 0.0, 0.0}, HOAP2_WALK_REQUEST_WALK};
  const hoap2_gait_t stood = gait;
  hoap2_sense_t blind;
  std::memset(&blind, 0, sizeof blind);
  hoap2_gait_start(&params, &gait);
  while (gait.step_index < 3) hoap2_gait_step(&params, &blind, &gait);
  for (int foot = 0; foot < 2; ++foot)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(gait.foot[foot][i], stood.foot[foot][i], 1e-12);
  EXPECT_EQ(gait.drawn_in, 0);
}

// ---- another step in mid-walk

TEST(Requests, AnotherStepCountsFromTheNextFootprintOn) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  ASSERT_TRUE(robot.until_step(5));
  robot.ticks(3);
  const double before[3] = {robot.out.footprint_W_m_rad[0], robot.out.footprint_W_m_rad[1],
                            robot.out.footprint_W_m_rad[2]};
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.025);
  robot.ticks(390);
  ASSERT_EQ(robot.out.step_index, 5);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(robot.out.footprint_W_m_rad[i], before[i]);
  ASSERT_TRUE(robot.until_step(6));
  EXPECT_NEAR(robot.out.footprint_W_m_rad[0], before[0] + 0.025, 1e-12);
  ASSERT_TRUE(robot.until_step(7));
  EXPECT_NEAR(robot.out.footprint_W_m_rad[0], before[0] + 0.050, 1e-12);
}

struct Way {
  const char* name;
  double length_m;
  double sideways_m;
  double turn_rad;
};

void PrintTo(const Way& way, std::ostream* os) { *os << way.name; }

class RequestedWay : public testing::TestWithParam<Way> {};

TEST_P(RequestedWay, IsWalked) {
  const Way& way = GetParam();
  hoap2_params_t params = standing();
  params.step_time_s = 0.5;
  for (int first : {0, 1}) {
    params.first_swing_foot = first;
    Asked robot(params);
    robot.ask(HOAP2_WALK_REQUEST_WALK, way.length_m, way.sideways_m, way.turn_rad);
    ASSERT_TRUE(robot.until_step(20));
    EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_TAKEN);
    robot.ask(HOAP2_WALK_REQUEST_STOP);
    ASSERT_TRUE(robot.until_standing());
    EXPECT_EQ(robot.out.fault, 0);
    EXPECT_EQ(robot.out.steps_done, 21);
    EXPECT_NEAR(robot.out.foot_ref_yaw_W_rad[0], 20 * way.turn_rad, 1e-9);
    if (way.turn_rad == 0.0) {
      EXPECT_NEAR(middle_x_m(robot.out), 20 * way.length_m, 1e-9);
      EXPECT_NEAR(middle_y_m(robot.out), 20 * way.sideways_m, 1e-9);
    }
    expect_side_by_side(robot.out, params.step_width_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Requests, RequestedWay,
                         testing::Values(Way{"forward", 0.02, 0.0, 0.0}, Way{"backward", -0.02, 0.0, 0.0},
                                         Way{"left", 0.0, 0.008, 0.0}, Way{"right", 0.0, -0.008, 0.0},
                                         Way{"turn_left", 0.0, 0.0, 0.06}, Way{"turn_right", 0.0, 0.0, -0.06},
                                         Way{"diagonal", 0.012, -0.006, 0.0}, Way{"curve", 0.01, 0.0, 0.05},
                                         Way{"in_place", 0.0, 0.0, 0.0}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

// ---- what cannot be met

TEST(Requests, BeyondItsRangeAStepIsLimited) {
  Asked at_limit(standing());
  Asked beyond(standing());
  at_limit.ask(HOAP2_WALK_REQUEST_WALK, HOAP2_STEP_LENGTH_REQUEST_M_HIGH);
  beyond.ask(HOAP2_WALK_REQUEST_WALK, 5.0);
  for (int k = 0; k < 6000; ++k) {
    at_limit.tick();
    beyond.tick();
    ASSERT_EQ(std::memcmp(at_limit.out.q_ref_rad, beyond.out.q_ref_rad, sizeof beyond.out.q_ref_rad), 0);
  }
  EXPECT_EQ(beyond.out.request_state, HOAP2_REQUEST_STATE_LIMITED);
  EXPECT_GT(beyond.out.steps_done, 5);
}

TEST(Requests, WhatIsNoRequestIsRefusedAndTheLastOneHolds) {
  struct Bad {
    int32_t walk;
    double step[3];
  };
  const Bad cases[] = {{HOAP2_WALK_REQUEST_WALK, {kNaN, 0.0, 0.0}},
                       {HOAP2_WALK_REQUEST_WALK, {0.01, kInf, 0.0}},
                       {HOAP2_WALK_REQUEST_WALK, {0.01, 0.0, -kInf}},
                       {7, {0.01, 0.0, 0.0}},
                       {-1, {0.01, 0.0, 0.0}},
                       {std::numeric_limits<int32_t>::min(), {kNaN, kNaN, kNaN}}};
  for (const Bad& bad : cases) {
    Asked robot(standing());
    robot.ask(HOAP2_WALK_REQUEST_WALK, 0.02);
    Asked twin = robot;
    ASSERT_TRUE(robot.until_step(4));
    ASSERT_TRUE(twin.until_step(4));
    robot.ask(bad.walk, bad.step[0], bad.step[1], bad.step[2]);
    for (int k = 0; k < 2000; ++k) {
      robot.tick();
      twin.tick();
      ASSERT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_REFUSED);
      ASSERT_EQ(std::memcmp(robot.out.q_ref_rad, twin.out.q_ref_rad, sizeof twin.out.q_ref_rad), 0);
    }
    EXPECT_EQ(robot.out.fault, 0);
    EXPECT_GT(robot.out.steps_done, 7);
  }
}

TEST(Requests, ABadRequestFromStandingStartsNothing) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, kNaN);
  robot.ticks(5000);
  EXPECT_EQ(robot.out.mode, HOAP2_MODE_STAND);
  EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_REFUSED);
}

TEST(Requests, NoWalkWhereStepsInPlaceAreImpossible) {
  hoap2_params_t params = standing();
  params.hip_height_m = 0.2364;  // straight legs: standing is possible, lifting a foot at once is not
  params.lift_m = 0.04;
  params.step_time_s = 0.25;
  Asked robot(params);
  ASSERT_EQ(robot.init_fault, 0);
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  robot.ticks(4000);
  EXPECT_EQ(robot.out.mode, HOAP2_MODE_STAND);
  EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_REFUSED);
  EXPECT_EQ(robot.out.fault, 0);
}

TEST(Requests, AfterAFaultNobodyWalks) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.01);
  ASSERT_TRUE(robot.until_step(4));
  for (int k = 0; k < 6000; ++k) {
    robot.in.q_enc_rad[3] = kNaN;
    robot.tick();
  }
  EXPECT_EQ(robot.out.mode, HOAP2_MODE_SAFE);
  EXPECT_EQ(robot.out.steps_done, 4);
  EXPECT_EQ(robot.out.request_state, HOAP2_REQUEST_STATE_REFUSED);
}

TEST(Requests, ACopyOfTheStateContinuesBitForBit) {
  Asked robot(standing());
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.02, 0.005, 0.03);
  ASSERT_TRUE(robot.until_step(3));
  robot.ticks(123);
  Asked clone(standing());
  std::memcpy(&clone.state, &robot.state, sizeof robot.state);
  clone.in = robot.in;
  clone.out = robot.out;
  clone.robot = robot.robot;
  robot.ask(HOAP2_WALK_REQUEST_WALK, 0.08, -0.03, 0.25);
  clone.ask(HOAP2_WALK_REQUEST_WALK, 0.08, -0.03, 0.25);
  for (int k = 0; k < 3000; ++k) {
    robot.tick();
    clone.tick();
    ASSERT_EQ(std::memcmp(&robot.out, &clone.out, sizeof clone.out), 0) << "tick " << k;
  }
  EXPECT_EQ(std::memcmp(&robot.state, &clone.state, sizeof clone.state), 0);
}

// ---- whatever is asked for, at any time, the walk stays one that the legs can do

struct Rough {
  const char* name;
  double step_time_s;
  double width_m;
  int landing_control;
  int cop_profile;
  int cp_controller;
};

void PrintTo(const Rough& rough, std::ostream* os) { *os << rough.name; }

class RoughRequests : public testing::TestWithParam<Rough> {};

TEST_P(RoughRequests, StayWithinReachAndRates) {
  hoap2_params_t params = standing();
  params.start_up_s = 0.3;
  params.calibrate_s = 0.1;
  params.step_time_s = GetParam().step_time_s;
  params.step_width_m = GetParam().width_m;
  params.landing_control = GetParam().landing_control;
  params.cop_profile = GetParam().cop_profile;
  params.cp_controller = GetParam().cp_controller;
  if (params.cop_profile == HOAP2_COP_PROFILE_RAMP) params.cp_offset_inward_m = 0.015;
  RandomPosture random(91);
  Asked robot(params);
  ASSERT_EQ(robot.init_fault, 0);
  ASSERT_EQ(robot.state.gait.in_place_fault, 0);
  double fastest = 0.0;
  int limited = 0;
  int taken = 0;
  for (int k = 0; k < 60000; ++k) {
    if (k % 1700 == 0) {
      const bool walk = random.uniform(0.0, 1.0) < 0.9;
      const double size = random.uniform(0.0, 1.0) < 0.5 ? 1.0 : 0.3;
      robot.ask(walk ? HOAP2_WALK_REQUEST_WALK : HOAP2_WALK_REQUEST_STOP, size * random.uniform(-0.1, 0.1),
                size * random.uniform(-0.04, 0.04), size * random.uniform(-0.3, 0.3));
    }
    const hoap2_gait_t before = robot.state.gait;
    robot.tick();
    const hoap2_gait_t& gait = robot.state.gait;
    ASSERT_EQ(robot.out.fault, 0) << "tick " << k;
    if (gait.step_index != before.step_index && gait.swing_foot != 2) {
      const int stance = 1 - gait.swing_foot;
      ASSERT_GE(hoap2::sole_clearance(gait.foot[stance], stance, gait.land), hoap2::kSoleClearance_m - 1e-8);
      limited += gait.drawn_in;
      taken += gait.on_request && !gait.drawn_in;
    }
    if (before.step_tick == before.step_ticks - 1 && before.swing_foot != 2 && before.walking)
      for (int i = 0; i < 2; ++i) {
        const double cp_m = before.com_m[i] + before.com_rate_m_s[i] / before.omega_1_s;
        ASSERT_NEAR(cp_m, before.cp_eos_m[i], 0.01) << "tick " << k;
      }
    if (robot.out.mode != HOAP2_MODE_WALK && robot.out.mode != HOAP2_MODE_STAND) continue;
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double rate_rad_s = std::fabs(gait.q_ref_rad[j] - before.q_ref_rad[j]) / kTick;
      fastest = std::max(fastest, rate_rad_s / HOAP2_JOINT[j].velocity_limit_rad_s);
    }
  }
  EXPECT_LE(fastest, 1.05 * hoap2::kRateTolerance);
  EXPECT_GT(limited, 10);
  EXPECT_GT(taken, 10);
}

INSTANTIATE_TEST_SUITE_P(Requests, RoughRequests,
                         testing::Values(Rough{"book", 0.4, 0.078, 0, 0, 0},
                                         Rough{"slow", 1.0, 0.078, 0, 0, 0},
                                         Rough{"quick", 0.35, 0.078, 0, 0, 0},
                                         Rough{"wide", 0.5, 0.1, 0, 0, 0}, Rough{"ramp", 0.4, 0.078, 0, 1, 0},
                                         Rough{"cps", 0.4, 0.078, 0, 0, 1}, Rough{"cpt", 0.4, 0.078, 0, 0, 2},
                                         Rough{"lpc", 0.4, 0.078, 1, 0, 0}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

// What the legs can do is known exactly by the walk's check at the start, which plays the walk. The look
// before each requested step is coarse: it must neither let much more through nor give much away.
TEST(Requests, TheLookAheadAgreesWithTheCheckAtTheStart) {
  struct Case {
    double step_time_s;
    int profile;
    int axis;
    double largest;
  };
  const Case cases[] = {{0.4, 0, 0, 0.08},  {0.4, 0, 0, -0.08}, {0.4, 0, 1, 0.03}, {0.4, 0, 2, -0.25},
                        {0.35, 0, 0, 0.08}, {0.6, 0, 0, -0.08}, {1.0, 0, 0, 0.08}, {1.0, 0, 1, 0.03},
                        {0.4, 1, 0, 0.08},  {0.4, 1, 2, 0.25}};
  for (const Case& way : cases) {
    hoap2_params_t params = default_params();
    params.start_up_s = 0.3;
    params.calibrate_s = 0.1;
    params.step_time_s = way.step_time_s;
    params.cop_profile = way.profile;
    if (way.profile == HOAP2_COP_PROFILE_RAMP) params.cp_offset_inward_m = 0.015;
    params.step_length_m = 0.0;
    double* const value = way.axis == 0   ? &params.step_length_m
                          : way.axis == 1 ? &params.step_sideways_m
                                          : &params.step_turn_rad;
    double low = 0.0;
    double high = 1.0;
    for (int halving = 0; halving < 7; ++halving) {
      const double middle = 0.5 * (low + high);
      *value = middle * way.largest;
      hoap2_state_t state;
      (hoap2_init(&state, &params) == 0 ? low : high) = middle;
    }
    *value = 0.0;
    params.behaviour = HOAP2_BEHAVIOUR_STAND;
    for (double share : {0.8, 1.2}) {
      Asked robot(params);
      double step[3] = {0.0, 0.0, 0.0};
      step[way.axis] = share * low * way.largest;
      if (std::fabs(step[way.axis]) > std::fabs(way.largest)) continue;
      robot.ask(HOAP2_WALK_REQUEST_WALK, step[0], step[1], step[2]);
      int drawn_in = 0;
      while (robot.out.step_index < 6) {
        robot.tick();
        drawn_in |= robot.state.gait.drawn_in;
      }
      EXPECT_EQ(drawn_in, share > 1.0)
          << "step " << way.step_time_s << " s, axis " << way.axis << ", " << step[way.axis] << ", " << share
          << " of the most, ramp " << way.profile;
    }
  }
}

}  // namespace
