// Whole walks in the loop with the ideal robot.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "gait_cp/support_polygon.hpp"
#include "ideal_robot.hpp"

namespace {

using namespace hoap2_tests;

struct WalkCase {
  const char* name;
  double length_m;
  double width_m;
  double sideways_m;
  double turn_rad;
  double step_time_s;
  int first_swing_foot;
  int cop_profile;
  int cp_controller;
};

void PrintTo(const WalkCase& walk, std::ostream* os) { *os << walk.name; }

hoap2_params_t params_of(const WalkCase& walk) {
  hoap2_params_t params = default_params();
  params.step_length_m = walk.length_m;
  params.step_width_m = walk.width_m;
  params.step_sideways_m = walk.sideways_m;
  params.step_turn_rad = walk.turn_rad;
  params.step_time_s = walk.step_time_s;
  params.first_swing_foot = walk.first_swing_foot;
  params.cop_profile = walk.cop_profile;
  params.cp_controller = walk.cp_controller;
  params.steps_forward = 10;
  params.steps_in_place = 3;
  return params;
}

class Walk : public testing::TestWithParam<WalkCase> {};

TEST_P(Walk, TakesAllStepsAndEndsSideBySide) {
  const hoap2_params_t params = params_of(GetParam());
  Loop loop(params);
  ASSERT_EQ(loop.init_fault, 0);
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) loop.tick();
  EXPECT_EQ(loop.out.walk_done, 1);
  EXPECT_EQ(loop.out.fault, 0);
  EXPECT_EQ(loop.out.steps_done, params.steps_forward + params.steps_in_place);
  EXPECT_EQ(loop.out.phase, HOAP2_PHASE_STAND);
  EXPECT_EQ(loop.out.stance_foot, 2);
  const double yaw = loop.out.foot_ref_yaw_W_rad[0];
  EXPECT_NEAR(loop.out.foot_ref_yaw_W_rad[1], yaw, 1e-12);
  const double dx = loop.out.foot_ref_W_m[1][0] - loop.out.foot_ref_W_m[0][0];
  const double dy = loop.out.foot_ref_W_m[1][1] - loop.out.foot_ref_W_m[0][1];
  EXPECT_NEAR(std::cos(yaw) * dx + std::sin(yaw) * dy, 0.0, 1e-12);
  EXPECT_NEAR(-std::sin(yaw) * dx + std::cos(yaw) * dy, params.step_width_m, 1e-12);
  EXPECT_EQ(loop.out.foot_ref_W_m[0][2], 0.0);
  EXPECT_EQ(loop.out.foot_ref_W_m[1][2], 0.0);
  // The walk went where it was sent: ten steps, of which every other turns or shifts twice.
  EXPECT_NEAR(yaw, 10 * params.step_turn_rad, 1e-9);
  if (params.step_turn_rad == 0.0) {
    EXPECT_NEAR(0.5 * (loop.out.foot_ref_W_m[0][0] + loop.out.foot_ref_W_m[1][0]), 10 * params.step_length_m,
                1e-9);
    EXPECT_NEAR(0.5 * (loop.out.foot_ref_W_m[0][1] + loop.out.foot_ref_W_m[1][1]),
                10 * params.step_sideways_m, 1e-9);
  }
}

TEST_P(Walk, ReferencesAreContinuousAndWithinTheLimits) {
  const hoap2_params_t params = params_of(GetParam());
  Loop loop(params);
  hoap2_outputs_t last = loop.out;
  double foot_step_m = 0.0;
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) {
    loop.tick();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double q_rad = loop.out.q_ref_rad[j];
      ASSERT_LE(std::fabs(q_rad - last.q_ref_rad[j]),
                HOAP2_JOINT[j].velocity_limit_rad_s * kTick * (1 + 1e-9))
          << "joint " << j << ", tick " << k;
      ASSERT_GE(q_rad, HOAP2_JOINT[j].limit_soft_rad[0]);
      ASSERT_LE(q_rad, HOAP2_JOINT[j].limit_soft_rad[1]);
    }
    for (int foot = 0; foot < 2; ++foot) {
      for (int i = 0; i < 3; ++i) {
        foot_step_m =
            std::max(foot_step_m, std::fabs(loop.out.foot_ref_W_m[foot][i] - last.foot_ref_W_m[foot][i]));
      }
    }
    for (int i = 0; i < 2; ++i) ASSERT_NEAR(loop.out.com_plan_W_m[i], last.com_plan_W_m[i], 5e-4);
    last = loop.out;
  }
  EXPECT_LT(foot_step_m, 1e-3);
}

// The joint references realise the plan: feet and CoM where the outputs say they are.
TEST_P(Walk, JointsRealiseCoMAndFeet) {
  const hoap2_params_t params = params_of(GetParam());
  Loop loop(params);
  int limited = 0;
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) {
    loop.tick();
    if (loop.out.mode == HOAP2_MODE_START_UP) continue;
    hoap2::Kinematics kin;
    hoap2::forward_kinematics(loop.out.q_ref_rad, kin);
    const hoap2::Pose sole_B[2] = {hoap2::sole_pose_B(kin, 0), hoap2::sole_pose_B(kin, 1)};
    const int stance = loop.out.stance_foot == 1 ? 1 : 0;
    const hoap2::Mat3 R_W_B =
        hoap2::rot_z(loop.out.foot_ref_yaw_W_rad[stance]) * sole_B[stance].R.transpose();
    const hoap2::Vec3 stance_W = Eigen::Map<const hoap2::Vec3>(loop.out.foot_ref_W_m[stance]);
    const hoap2::Vec3 com_W = stance_W + R_W_B * (kin.com_B - sole_B[stance].p);
    const hoap2::Vec3 other_W = stance_W + R_W_B * (sole_B[1 - stance].p - sole_B[stance].p);
    const hoap2::Vec3 other_ref_W = Eigen::Map<const hoap2::Vec3>(loop.out.foot_ref_W_m[1 - stance]);
    const bool close =
        (com_W - Eigen::Map<const hoap2::Vec3>(loop.out.com_ref_W_m)).head<2>().norm() < 1e-4 &&
        (other_W - other_ref_W).norm() < 1e-4;
    if (!close) ++limited;
    ASSERT_LT((com_W - Eigen::Map<const hoap2::Vec3>(loop.out.com_ref_W_m)).head<2>().norm(), 2e-3)
        << "tick " << k;
    ASSERT_LT((other_W - other_ref_W).norm(), 3e-3) << "tick " << k;
  }
  EXPECT_LT(limited, 400);  // only where the rate limiter rounds off the knee of the swing leg
}

// (7.9) and the clamp: in single support the desired CoP lies in the sole, shrunk by its margin, and is held
// over the step; without a clamp the capture point arrives at its end-of-step place.
TEST_P(Walk, CoPStaysInTheSoleAndTheCapturePointArrives) {
  const hoap2_params_t params = params_of(GetParam());
  Loop loop(params);
  int arrivals = 0;
  double worst_m = 0.0;
  hoap2_outputs_t last = loop.out;
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) {
    const double rate[2] = {loop.state.gait.com_rate_m_s[0], loop.state.gait.com_rate_m_s[1]};
    loop.tick();
    if (loop.out.phase == HOAP2_PHASE_SINGLE_SUPPORT) {
      const int stance = loop.out.stance_foot;
      const double footprint[3] = {loop.out.foot_ref_W_m[stance][0], loop.out.foot_ref_W_m[stance][1],
                                   loop.out.foot_ref_yaw_W_rad[stance]};
      const hoap2::SupportPolygon sole = hoap2::sole_polygon(footprint, params.cop_margin_m);
      const hoap2::Point2 cop = {loop.out.cop_ref_W_m[0], loop.out.cop_ref_W_m[1]};
      ASSERT_GE(hoap2::inside_distance(sole, cop), -1e-12) << "tick " << k;
    }
    if (loop.out.phase != HOAP2_PHASE_STAND && loop.out.steps_done == last.steps_done &&
        loop.out.step_index == last.step_index) {
      for (int i = 0; i < 2; ++i) {  // the feedback laws keep to the plan's capture point, (7.10), too
        const double cp =
            loop.out.com_plan_W_m[i] + loop.state.gait.com_rate_m_s[i] / loop.state.gait.omega_1_s;
        ASSERT_NEAR(loop.out.cp_ref_W_m[i], cp,
                    params.cp_controller == HOAP2_CP_CONTROLLER_PLAN ? 1e-9 : 0.02)
            << "tick " << k;
      }
    }
    if (loop.out.steps_done == last.steps_done + 1 && params.cp_controller == HOAP2_CP_CONTROLLER_PLAN) {
      // the state before this tick is one tick short of the end of the step; its own CoP carries it there
      const double omega = loop.state.gait.omega_1_s;
      for (int i = 0; i < 2; ++i) {
        const double cp = last.com_plan_W_m[i] + rate[i] / omega;
        const double arrived = last.cop_ref_W_m[i] + std::exp(omega * kTick) * (cp - last.cop_ref_W_m[i]);
        worst_m = std::max(worst_m, std::fabs(arrived - last.cp_eos_W_m[i]));
      }
      ++arrivals;
    }
    last = loop.out;
  }
  if (params.cp_controller == HOAP2_CP_CONTROLLER_PLAN) {
    EXPECT_EQ(arrivals, params.steps_forward + params.steps_in_place);
    // the ramp is played as a staircase of ticks, a little beside its closed form
    EXPECT_LT(worst_m, params.cop_profile == HOAP2_COP_PROFILE_RAMP ? 2e-5 : 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Walk,
                         testing::Values(WalkCase{"forward", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 0, 0},
                                         WalkCase{"backward", -0.015, 0.078, 0.0, 0.0, 0.4, 1, 0, 0},
                                         WalkCase{"in_place", 0.0, 0.078, 0.0, 0.0, 0.4, 0, 0, 0},
                                         WalkCase{"left_turn", 0.01, 0.078, 0.0, 0.06, 0.5, 1, 0, 0},
                                         WalkCase{"right_turn", 0.01, 0.078, 0.0, -0.06, 0.5, 0, 0, 0},
                                         WalkCase{"sideways_left", 0.0, 0.078, 0.008, 0.0, 0.5, 1, 0, 0},
                                         WalkCase{"sideways_right", 0.0, 0.078, -0.008, 0.0, 0.5, 0, 0, 0},
                                         WalkCase{"wide", 0.015, 0.09, 0.0, 0.0, 0.5, 0, 0, 0},
                                         WalkCase{"ramp", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 1, 0},
                                         WalkCase{"cps", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 0, 1},
                                         WalkCase{"cpt", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 0, 2},
                                         WalkCase{"cps_ramp", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 1, 1},
                                         WalkCase{"cpt_ramp", 0.015, 0.078, 0.0, 0.0, 0.4, 0, 1, 2}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

TEST(WalkOfTheBook, ThirtySixStepsOf15Millimetres) {
  const hoap2_params_t params = default_params();
  Loop loop(params);
  ASSERT_EQ(loop.init_fault, 0);
  for (int k = 0; k < tick_limit(params) && !loop.finished(); ++k) loop.tick();
  EXPECT_EQ(loop.out.steps_done, 36);
  EXPECT_EQ(loop.out.walk_done, 1);
  EXPECT_EQ(loop.out.fault, 0);
  EXPECT_NEAR(loop.out.foot_ref_W_m[0][0], 0.42, 1e-12);
  EXPECT_NEAR(loop.out.foot_ref_W_m[1][0], 0.42, 1e-12);
  EXPECT_NEAR(loop.out.com_plan_W_m[0], 0.42 + params.cp_offset_x_m, 2e-3);
  EXPECT_NEAR(loop.out.com_plan_W_m[1], 0.0, 2e-3);
}

TEST(WalkOfTheBook, StandingBehaviourStands) {
  hoap2_params_t params = default_params();
  params.behaviour = HOAP2_BEHAVIOUR_STAND;
  Loop loop(params);
  for (int k = 0; k < 8000; ++k) {
    loop.tick();
    ASSERT_NE(loop.out.mode, HOAP2_MODE_WALK);
    ASSERT_EQ(loop.out.step_index, 0);
  }
  EXPECT_EQ(loop.out.mode, HOAP2_MODE_STAND);
  EXPECT_EQ(loop.out.walk_done, 1);
}

}  // namespace
