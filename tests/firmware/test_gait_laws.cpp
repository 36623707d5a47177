// The laws of section 7.2 one by one: capture point, pendulum, support polygon, footprints, swing,
// compliance.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "gait_cp/capture_point.hpp"
#include "gait_cp/footprints.hpp"
#include "gait_cp/support_polygon.hpp"
#include "gait_cp/swing.hpp"
#include "gait_cp/tpcc.hpp"
#include "hoap2/generated/robot_model.h"
#include "random_posture.hpp"

namespace {

using namespace hoap2;
using hoap2_tests::RandomPosture;

constexpr double kOmega = 6.17;

TEST(CapturePoint, TheCoPOfTheLawBringsItHome) {
  RandomPosture random(51);
  for (int n = 0; n < 1000; ++n) {
    const double cp = random.uniform(-0.1, 0.1);
    const double wanted = random.uniform(-0.1, 0.1);
    const double growth = std::exp(kOmega * random.uniform(0.01, 1.0));
    const double cop = cop_for_capture_point(wanted, cp, growth);
    ASSERT_NEAR(capture_point_after(cp, cop, growth), wanted, 1e-12);
  }
}

TEST(CapturePoint, NumbersOfTheBooksWalk) {
  // theory of an even gait: the CoP lies the step's advance / (e^(omega T) - 1) behind the stance ankle
  const double growth = std::exp(std::sqrt(9.81 / 0.27) * 0.4);
  EXPECT_NEAR(cop_for_capture_point(0.015, 0.0, growth), -1.5e-3, 0.1e-3);
}

// (7.13) solves (5.11); its capture point moves as (7.10).
TEST(Pendulum, ClosedFormEqualsTheDifferentialEquation) {
  const double cop = 0.02;
  double com = 0.01;
  double rate = 0.05;
  double com_exact = com;
  double rate_exact = rate;
  const double T = 0.4;
  pendulum_after(cop, kOmega, std::cosh(kOmega * T), std::sinh(kOmega * T), com_exact, rate_exact);
  const int count = 400000;
  const double h = T / count;
  for (int i = 0; i < count; ++i) {  // midpoint rule
    const double mid = com + 0.5 * h * rate;
    const double mid_rate = rate + 0.5 * h * kOmega * kOmega * (com - cop);
    com += h * mid_rate;
    rate += h * kOmega * kOmega * (mid - cop);
  }
  EXPECT_NEAR(com_exact, com, 1e-10);
  EXPECT_NEAR(rate_exact, rate, 1e-9);
  EXPECT_NEAR(com_exact + rate_exact / kOmega,
              capture_point_after(0.01 + 0.05 / kOmega, cop, std::exp(kOmega * T)), 1e-14);
}

TEST(CapturePoint, TheRampEndsWhereItShall) {
  const double T = 0.4;
  const double cp = 0.012;
  const double cop_from = -0.03;
  const double wanted = 0.07;
  for (double ramp_s : {0.001, 0.02, 0.08, 0.2}) {
    const double cop_to = cop_for_ramp(wanted, cp, cop_from, kOmega, T, ramp_s);
    double now = cp;
    const int count = 200000;
    const double h = T / count;
    for (int i = 0; i < count; ++i) {
      const double share = std::min(1.0, (i + 0.5) * h / ramp_s);
      now = capture_point_after(now, cop_from + share * (cop_to - cop_from), std::exp(kOmega * h));
    }
    EXPECT_NEAR(now, wanted, 1e-6) << "ramp " << ramp_s;
    const double start = line_start_for_ramp(cp, cop_from, kOmega, T, ramp_s);
    EXPECT_NEAR(cop_for_ramp(start, cp, cop_from, kOmega, T, ramp_s), start, 1e-13);  // its own fixed point
  }
  EXPECT_NEAR(cop_for_ramp(wanted, cp, cop_from, kOmega, T, 1e-7),
              cop_for_capture_point(wanted, cp, std::exp(kOmega * T)), 1e-7);
}

TEST(SupportPolygon, SoleAndDistance) {
  const double footprint[3] = {0.1, 0.2, 0.0};
  const SupportPolygon sole = sole_polygon(footprint, 0.004);
  EXPECT_NEAR(inside_distance(sole, {0.1, 0.2}), 0.0275, 1e-15);
  EXPECT_NEAR(inside_distance(sole, {0.1 + 0.054, 0.2}), 0.0, 1e-15);
  EXPECT_NEAR(inside_distance(sole, {0.1 - 0.036, 0.2}), 0.0, 1e-15);
  EXPECT_NEAR(inside_distance(sole, {0.1, 0.2 + 0.0315}), -0.004, 1e-15);
}

TEST(SupportPolygon, HullHoldsBothSolesAndIsConvex) {
  RandomPosture random(52);
  for (int n = 0; n < 2000; ++n) {
    const bool aligned = n % 4 == 0;  // collinear corners
    const double a[3] = {0.0, 0.0, aligned ? 0.0 : random.uniform(-3, 3)};
    const double b[3] = {aligned && n % 8 == 0 ? 0.0 : random.uniform(-0.1, 0.1), random.uniform(0.05, 0.15),
                         aligned ? 0.0 : random.uniform(-3, 3)};
    const SupportPolygon hull = hull_of_soles(a, b, 0.003);
    ASSERT_GE(hull.count, 4);
    ASSERT_LE(hull.count, 8);
    for (const double* footprint : {a, b}) {
      const SupportPolygon sole = sole_polygon(footprint, 0.003);
      for (int i = 0; i < sole.count; ++i) ASSERT_GE(inside_distance(hull, sole.vertex_m[i]), -1e-12);
    }
    for (int i = 0; i < hull.count; ++i) {
      const Point2& p = hull.vertex_m[i];
      const Point2& q = hull.vertex_m[(i + 1) % hull.count];
      const Point2& r = hull.vertex_m[(i + 2) % hull.count];
      ASSERT_GE((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x), -1e-15);
    }
  }
}

// Soles side by side at any heading: corners in one line but for rounding, where a wrap loses its way easily.
TEST(SupportPolygon, HullOfParallelSolesAtAnyHeading) {
  RandomPosture random(54);
  for (int n = 0; n < 300000; ++n) {
    const double yaw = random.uniform(-3.2, 3.2);
    const double ahead = n % 2 == 0 ? 0.0 : random.uniform(-0.05, 0.05);
    const double centre[3] = {random.uniform(-2, 2), random.uniform(-2, 2), yaw};
    double right[3];
    double left[3];
    footprint_beside(centre, 0, 0.078, right);
    const double forward[3] = {centre[0] + ahead * std::cos(yaw), centre[1] + ahead * std::sin(yaw), yaw};
    footprint_beside(forward, 1, 0.078, left);
    const SupportPolygon hull = hull_of_soles(right, left, 0.004);
    const Point2 middle = {0.5 * (right[0] + left[0]), 0.5 * (right[1] + left[1])};
    // the rear edges are the nearest: 36 mm behind the ankles, a little more or less along the slanted sides
    const double expected = 0.036 * 0.078 / std::hypot(0.078, ahead);
    ASSERT_GT(inside_distance(hull, middle), std::min(0.9 * expected, 0.02))
        << "yaw " << yaw << " ahead " << ahead;
    for (const double* footprint : {right, left}) {
      const SupportPolygon sole = sole_polygon(footprint, 0.004);
      for (int i = 0; i < sole.count; ++i) ASSERT_GE(inside_distance(hull, sole.vertex_m[i]), -1e-8);
    }
  }
}

TEST(SupportPolygon, ClampKeepsToTheLineOfTheCapturePoint) {
  RandomPosture random(53);
  int on_line = 0;
  int at_vertex = 0;
  for (int n = 0; n < 5000; ++n) {
    const double footprint[3] = {0.0, 0.0, random.uniform(-1, 1)};
    const SupportPolygon sole = sole_polygon(footprint, 0.004);
    const Point2 start = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    const Point2 eos = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    const double t = random.uniform(-2.0, 0.5);
    const Point2 cop = {start.x + t * (eos.x - start.x), start.y + t * (eos.y - start.y)};
    const Point2 inside = clamp_cop(sole, cop, start, eos);
    ASSERT_GE(inside_distance(sole, inside), -1e-12);
    if (inside_distance(sole, cop) >= 0.0) {
      ASSERT_EQ(inside.x, cop.x);
      ASSERT_EQ(inside.y, cop.y);
      continue;
    }
    const double off = (inside.x - start.x) * (eos.y - start.y) - (inside.y - start.y) * (eos.x - start.x);
    if (std::fabs(off) < 1e-12) {
      ASSERT_LT(std::fabs(inside_distance(sole, inside)), 1e-9);  // the first boundary point, not the inside
      ++on_line;
    } else {
      double nearest = 1.0;
      for (int i = 0; i < sole.count; ++i) {
        nearest = std::min(nearest, std::hypot(inside.x - sole.vertex_m[i].x, inside.y - sole.vertex_m[i].y));
      }
      ASSERT_LT(nearest, 1e-15);
      ++at_vertex;
    }
  }
  EXPECT_GT(on_line, 500);
  EXPECT_GT(at_vertex, 500);
}

TEST(Footprints, SideBySideAndTheirClearance) {
  const double centre[3] = {1.0, 2.0, 0.6};
  double right[3];
  double left[3];
  footprint_beside(centre, 0, 0.078, right);
  footprint_beside(centre, 1, 0.078, left);
  EXPECT_NEAR(std::hypot(left[0] - right[0], left[1] - right[1]), 0.078, 1e-15);
  EXPECT_LT(left[0], right[0]);  // heading 0.6: left is behind in x
  EXPECT_NEAR(sole_clearance(right, 0, left), 0.015, 1e-12);
  EXPECT_NEAR(sole_clearance(left, 1, right), 0.015, 1e-12);
  double toe_in[3] = {left[0], left[1], left[2] - 0.3};
  EXPECT_LT(sole_clearance(right, 0, toe_in), 0.0);
}

TEST(Footprints, EndOfStepCapturePointLiesInwardAndAhead) {
  hoap2_params_t params;
  hoap2_params_defaults(&params);
  const double at[3] = {0.0, 0.0, 0.0};
  double point[2];
  capture_point_over(params, at, 0, point);
  EXPECT_NEAR(point[0], params.cp_offset_x_m, 1e-15);
  EXPECT_NEAR(point[1], params.cp_offset_inward_m, 1e-15);  // right foot: inward is to the left
  capture_point_over(params, at, 1, point);
  EXPECT_NEAR(point[1], -params.cp_offset_inward_m, 1e-15);
}

TEST(Swing, StartsAndEndsAtRestOnTheFloorWithItsApexBetween) {
  const double from[3] = {0.0, -0.039, 0.0};
  const double to[3] = {0.03, -0.035, 0.2};
  double at[4];
  double highest_m = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    swing_foot(from, to, 0.018, i / 1000.0, at);
    highest_m = std::max(highest_m, at[2]);
    ASSERT_GE(at[2], 0.0);
  }
  EXPECT_NEAR(highest_m, 0.018, 1e-12);
  for (double phase : {-0.5, 0.0}) {
    swing_foot(from, to, 0.018, phase, at);
    EXPECT_EQ(at[0], from[0]);
    EXPECT_EQ(at[2], 0.0);
  }
  for (double phase : {1.0, 1.7}) {
    swing_foot(from, to, 0.018, phase, at);
    EXPECT_EQ(at[1], to[1]);
    EXPECT_EQ(at[2], 0.0);
    EXPECT_EQ(at[3], to[2]);
  }
  for (double end : {0.0, 1.0}) {  // rate and acceleration vanish: cubic departure
    double near_end[4];
    swing_foot(from, to, 0.018, std::fabs(end - 1e-3), near_end);
    swing_foot(from, to, 0.018, end, at);
    for (int i = 0; i < 4; ++i) EXPECT_LT(std::fabs(near_end[i] - at[i]), 2e-9);
  }
}

class Tpcc : public testing::Test {
 protected:
  Tpcc() {
    hoap2_params_defaults(&params);
    std::memset(&gait, 0, sizeof gait);
  }

  void run(double seconds, double error_x_m, bool feedback) {
    const double cop[2] = {gait.cop_m[0] + error_x_m, gait.cop_m[1]};
    for (int k = 0; k < static_cast<int>(1000 * seconds); ++k) tpcc_step(params, cop, feedback, gait);
  }

  hoap2_params_t params;
  hoap2_gait_t gait;
};

TEST_F(Tpcc, YieldsInTheDirectionOfTheErrorAndSpringsBack) {
  run(5.0, 0.01, true);
  EXPECT_NEAR(gait.tpcc_m[0], params.tpcc_kp_1_s2 * 0.01 / params.tpcc_kx_1_s2, 1e-6);
  EXPECT_NEAR(gait.tpcc_m[1], 0.0, 1e-15);
  run(5.0, 0.0, true);
  EXPECT_NEAR(gait.tpcc_m[0], 0.0, 1e-6);
}

TEST_F(Tpcc, WithoutFeedbackTheShiftDecays) {
  run(1.0, 0.01, true);
  const double before_m = gait.tpcc_m[0];
  ASSERT_GT(before_m, 1e-4);
  run(3.0, 0.01, false);
  EXPECT_LT(std::fabs(gait.tpcc_m[0]), 1e-3 * before_m);
}

TEST_F(Tpcc, ErrorAndShiftAreBounded) {
  run(5.0, 10.0, true);
  EXPECT_NEAR(gait.tpcc_m[0],
              std::min(params.tpcc_shift_limit_m,
                       params.tpcc_kp_1_s2 * params.tpcc_error_limit_m / params.tpcc_kx_1_s2),
              1e-6);
  params.tpcc_kp_1_s2 = 100.0;
  params.tpcc_kx_1_s2 = 10.0;
  for (int k = 0; k < 5000; ++k) {
    run(0.001, -10.0, true);
    ASSERT_GE(gait.tpcc_m[0], -params.tpcc_shift_limit_m);
  }
  EXPECT_EQ(gait.tpcc_m[0], -params.tpcc_shift_limit_m);
}

}  // namespace
