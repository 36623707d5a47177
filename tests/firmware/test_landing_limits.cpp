// Landing position control: what the walk's plan does with it, and its limits.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "gait_cp/footprints.hpp"
#include "gait_cp/support_polygon.hpp"
#include "gait_cp/walk_plan.hpp"
#include "random_posture.hpp"
#include "tilted_loop.hpp"

namespace {

using namespace hoap2_tests;

// ---- the plan

TEST(LandingControl, ThePlanStaysOrMovesWithTheFeet) {
  const auto lean = [](TiltedLoop& robot) { robot.target_rad[1] = -1.5 * kDeg; };
  for (int moves : {0, 1}) {
    hoap2_params_t params = lpc_params(12, 4);
    params.lpc_moves_cp = moves;
    TiltedLoop tilted(params);
    const std::vector<Step> steps = walk(tilted, lean);
    ASSERT_EQ(steps.size(), 17u);
    for (size_t j = 1; j + 1 < steps.size(); ++j) {
      double over[2];
      hoap2::capture_point_over(params, moves ? steps[j].land : steps[j].nominal, steps[j].swing_foot, over);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(steps[j].cp_eos_m[i], over[i], 1e-15) << "step " << j;
    }
    EXPECT_LT(steps[12].shift[0], -0.005);
  }
}

TEST(LandingControl, TheWalkEndsSideBySideAndOverTheFeetWhereTheyAre) {
  for (int moves : {0, 1}) {
    hoap2_params_t params = lpc_params(13, 3);
    params.lpc_moves_cp = moves;
    params.step_turn_rad = 0.02;
    TiltedLoop tilted(params);
    const std::vector<Step> steps = walk(tilted, [](TiltedLoop& robot) {
      robot.target_rad[0] = -2.0 * kDeg;
      robot.target_rad[1] = -1.5 * kDeg;
    });
    ASSERT_EQ(tilted.loop.out.walk_done, 1);
    const hoap2_outputs_t& out = tilted.loop.out;
    const double yaw = out.foot_ref_yaw_W_rad[0];
    double apart[2];
    along_across(yaw, out.foot_ref_W_m[1][0] - out.foot_ref_W_m[0][0],
                 out.foot_ref_W_m[1][1] - out.foot_ref_W_m[0][1], apart);
    EXPECT_NEAR(apart[0], 0.0, 1e-12);
    EXPECT_NEAR(apart[1], params.step_width_m, 1e-12);
    EXPECT_LT(steps.back().shift[0], -0.004);  // not where they would have stood
    EXPECT_GT(steps.back().shift[1], 0.008);
    double between[2];
    hoap2::capture_point_between(params, tilted.gait().foot[0], tilted.gait().foot[1], between);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(out.com_plan_W_m[i], between[i], 1e-3);
    for (int j = 0; j < HOAP2_JOINTS; ++j)  // the stance of the start
      EXPECT_NEAR(out.q_ref_rad[j], tilted.loop.state.stance_q_rad[j], 0.5 * kDeg) << "joint " << j;
  }
}

// ---- limits, under leans of any size and direction that change again and again

struct RoughCase {
  const char* name;
  double length_m;
  double width_m;
  double turn_rad;
  double step_time_s;
  int moves_cp;
  int cop_profile;
};

void PrintTo(const RoughCase& rough, std::ostream* os) { *os << rough.name; }

class RoughWalk : public testing::TestWithParam<RoughCase> {
 protected:
  RoughWalk() : params(lpc_params(30, 6)) {
    params.step_length_m = GetParam().length_m;
    params.step_width_m = GetParam().width_m;
    params.step_turn_rad = GetParam().turn_rad;
    params.step_time_s = GetParam().step_time_s;
    params.lpc_moves_cp = GetParam().moves_cp;
    params.cop_profile = GetParam().cop_profile;
    if (params.cop_profile == HOAP2_COP_PROFILE_RAMP) params.cp_offset_inward_m = 0.015;
  }

  hoap2_params_t params;
};

TEST_P(RoughWalk, FeetKeepTheirDistanceTheShiftItsLimitAndThePlanItsCapturePoint) {
  RandomPosture random(82);
  int at_spacing = 0;
  double largest_m[2] = {0.0, 0.0};
  for (int trial = 0; trial < 6; ++trial) {
    TiltedLoop tilted(params);
    ASSERT_EQ(tilted.loop.init_fault, 0);
    double lost_m = 0.0;
    const std::vector<Step> steps = walk(tilted, [&](TiltedLoop& robot) {
      const hoap2_gait_t& gait = robot.gait();
      if (gait.step_tick == gait.step_ticks - 1 && gait.swing_foot != 2)
        for (int i = 0; i < 2; ++i) {  // the capture point one tick before its time
          const double cp_m = gait.com_m[i] + gait.com_rate_m_s[i] / gait.omega_1_s;
          lost_m = std::max(lost_m, std::fabs(cp_m - gait.cp_eos_m[i]));
        }
      if (robot.loop.out.tick % 250 != 0) return;
      for (double& target_rad : robot.target_rad) target_rad = random.uniform(-8.0, 8.0) * kDeg;
    });
    ASSERT_EQ(steps.size(), 37u);
    for (size_t j = 1; j < steps.size(); ++j) {
      const Step& step = steps[j];
      const int stance = 1 - step.swing_foot;
      double apart[2];
      along_across(step.stance[2], step.land[0] - step.stance[0], step.land[1] - step.stance[1], apart);
      const double spacing_m = (step.swing_foot == 1 ? 1.0 : -1.0) * apart[1];
      ASSERT_GE(spacing_m, params.lpc_min_spacing_m - 1e-8) << "step " << j;
      ASSERT_GE(hoap2::sole_clearance(step.stance, stance, step.land), hoap2::kSoleClearance_m - 1e-8);
      at_spacing += spacing_m < params.lpc_min_spacing_m + 1e-6;
      for (int i = 0; i < 2; ++i) {
        ASSERT_LE(std::fabs(step.shift[i]), params.lpc_limit_m + (i == 1 ? 0.012 : 1e-12)) << "step " << j;
        largest_m[i] = std::max(largest_m[i], std::fabs(step.shift[i]));
      }
    }
    EXPECT_LT(lost_m, 2e-3) << "trial " << trial;  // 1 ms of the capture point's way is about 1 mm
    EXPECT_EQ(tilted.loop.out.walk_done, 1);
    EXPECT_EQ(tilted.loop.out.fault, 0) << "trial " << trial;
  }
  EXPECT_GE(at_spacing, 5);
  EXPECT_GT(largest_m[0], 0.012);
  EXPECT_GT(largest_m[1], 0.012);
}

// What the whole-body map asks for, before the drives' limits: no jump, and within the rates that a walk may
// ask for at its start; the CoP in the sole where it really stands.
TEST_P(RoughWalk, ReferencesAreContinuous) {
  RandomPosture random(83);
  TiltedLoop tilted(params);
  hoap2_gait_t last = tilted.gait();
  double fastest = 0.0;
  walk(tilted, [&](TiltedLoop& robot) {
    const hoap2_gait_t& gait = robot.gait();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double share =
          std::fabs(gait.q_ref_rad[j] - last.q_ref_rad[j]) / kTick / HOAP2_JOINT[j].velocity_limit_rad_s;
      fastest = std::max(fastest, share);
    }
    for (int foot = 0; foot < 2; ++foot)
      for (int i = 0; i < 3; ++i)
        EXPECT_LT(std::fabs(gait.feet.pos_O_m[foot][i] - last.feet.pos_O_m[foot][i]), 8e-4);
    if (gait.phase == HOAP2_PHASE_SINGLE_SUPPORT) {
      const hoap2::SupportPolygon sole =
          hoap2::sole_polygon(gait.foot[1 - gait.swing_foot], params.cop_margin_m);
      EXPECT_GE(hoap2::inside_distance(sole, {gait.cop_m[0], gait.cop_m[1]}), -1e-12);
    }
    last = gait;
    if (robot.loop.out.tick % 250 != 0) return;
    for (double& target_rad : robot.target_rad) target_rad = random.uniform(-8.0, 8.0) * kDeg;
  });
  EXPECT_LT(fastest, 1.35);  // 1.2 where the landing is chosen, and what its coarse look leaves out
  EXPECT_EQ(tilted.loop.out.walk_done, 1);
}

INSTANTIATE_TEST_SUITE_P(Ways, RoughWalk,
                         testing::Values(RoughCase{"forward", 0.015, 0.078, 0.0, 0.4, 0, 0},
                                         RoughCase{"moves_cp", 0.015, 0.078, 0.0, 0.4, 1, 0},
                                         RoughCase{"long_steps", 0.025, 0.078, 0.0, 0.45, 0, 0},
                                         RoughCase{"backward", -0.015, 0.078, 0.0, 0.4, 0, 0},
                                         RoughCase{"left_turn", 0.01, 0.078, 0.06, 0.5, 0, 0},
                                         RoughCase{"wide", 0.015, 0.088, 0.0, 0.5, 0, 0},
                                         RoughCase{"ramp", 0.015, 0.078, 0.0, 0.4, 0, 1}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

}  // namespace
