#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "random_posture.hpp"
#include "robot/leg_ik.hpp"

namespace {

using namespace hoap2;
using hoap2_tests::JointAngles;
using hoap2_tests::RandomPosture;

const Vec3 kHip[2] = {Vec3(0.0, -0.039, 0.0), Vec3(0.0, 0.039, 0.0)};

Pose sole_of(const JointAngles& q_rad, int foot) {
  Kinematics kin;
  forward_kinematics(q_rad.data(), kin);
  return sole_pose_B(kin, foot);
}

Pose sole_of(const LegIkResult& result, int foot) {
  JointAngles q_rad{};
  std::copy(result.q_rad, result.q_rad + 6, q_rad.begin() + leg_first_joint(foot));
  return sole_of(q_rad, foot);
}

Pose level_sole(double x_m, double y_m, double z_m) {
  Pose sole;
  sole.p = Vec3(x_m, y_m, z_m);
  return sole;
}

void expect_usable(const LegIkResult& result, int foot) {
  for (int i = 0; i < 6; ++i) {
    const hoap2_joint_data_t& joint = HOAP2_JOINT[leg_first_joint(foot) + i];
    ASSERT_TRUE(std::isfinite(result.q_rad[i])) << "joint " << i;
    ASSERT_GE(result.q_rad[i], joint.limit_soft_rad[0]);
    ASSERT_LE(result.q_rad[i], joint.limit_soft_rad[1]);
  }
  ASSERT_TRUE(std::isfinite(result.excess_m));
}

TEST(LegIk, BothLegsAreBuiltAlike) {
  for (int i = 1; i < 6; ++i) {
    const hoap2_joint_data_t& right = HOAP2_JOINT[leg_first_joint(0) + i];
    const hoap2_joint_data_t& left = HOAP2_JOINT[leg_first_joint(1) + i];
    EXPECT_EQ(right.axis, left.axis);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(right.origin_parent_m[k], left.origin_parent_m[k]);
    }
  }
}

TEST(LegIk, InvertsTheForwardKinematicsEverywhereWithinTheLimits) {
  RandomPosture random(41);
  int solved = 0;
  for (int n = 0; n < 20000; ++n) {
    const JointAngles q_rad = random.joints();
    for (int foot = 0; foot < 2; ++foot) {
      const size_t first = static_cast<size_t>(leg_first_joint(foot));
      if (q_rad[first + 3] < 0.064) {
        continue;  // beyond the reach margin
      }
      LegIkResult result;
      leg_ik(foot, sole_of(q_rad, foot), result);
      ASSERT_EQ(result.status, LegIk::ok);
      ASSERT_EQ(result.excess_m, 0.0);
      const Pose expected = sole_of(q_rad, foot);
      const Pose found = sole_of(result, foot);
      ASSERT_LT((found.p - expected.p).norm(), 1e-14);
      ASSERT_LT((found.R - expected.R).norm(), 1e-14);
      // Where the hip-ankle line nears the ankle's roll axis the roll is ill-conditioned in the pose itself.
      const Pose ankle_to_hip = expected;
      const Vec3 hip_F = ankle_to_hip.R.transpose() * (kHip[foot] - expected.p) - Vec3(0.0, 0.0, 0.037);
      const double tolerance = 1e-12 * std::max(1.0, 0.01 / std::hypot(hip_F.y(), hip_F.z()));
      for (size_t i = 0; i < 6; ++i) {
        ASSERT_NEAR(result.q_rad[i], q_rad[first + i], tolerance) << "joint " << i << " of foot " << foot;
      }
      ++solved;
    }
  }
  EXPECT_GT(solved, 38000);
}

TEST(LegIk, BentToTheMarginWithoutLossOfDigits) {
  for (double knee_rad : {0.003, 0.01, 0.03, 0.07}) {
    JointAngles q_rad{};
    q_rad[HOAP2_J_R_HIP_PITCH] = -knee_rad / 2;
    q_rad[HOAP2_J_R_KNEE] = knee_rad;
    LegIkResult result;
    leg_ik(0, sole_of(q_rad, 0), result, 0.0);
    EXPECT_EQ(result.status, LegIk::ok);
    EXPECT_NEAR(result.q_rad[3], knee_rad, 1e-15 / knee_rad);
  }
}

TEST(LegIk, ReachBoundary) {
  for (int foot = 0; foot < 2; ++foot) {
    const double y = kHip[foot].y();
    const double deepest_m = -(0.2 + 0.037) + kLegReachMargin_m;
    LegIkResult result;
    leg_ik(foot, level_sole(0.0, y, deepest_m + 1e-9), result);
    EXPECT_EQ(result.status, LegIk::ok);
    leg_ik(foot, level_sole(0.0, y, deepest_m - 1e-6), result);
    EXPECT_EQ(result.status, LegIk::pulled_back);
    EXPECT_NEAR(result.excess_m, 1e-6, 1e-15);
    expect_usable(result, foot);
  }
}

TEST(LegIk, PulledBackStaysOnTheLineAndKeepsTheFootsOrientation) {
  RandomPosture random(42);
  int seen = 0;
  for (int n = 0; n < 2000; ++n) {
    const int foot = n % 2;
    Pose sole;
    sole.R = matrix_from_rpy(random.vector(0.15));
    sole.p = kHip[foot] + Vec3(random.uniform(-0.08, 0.08), random.uniform(-0.04, 0.04), -0.3);
    LegIkResult result;
    leg_ik(foot, sole, result);
    expect_usable(result, foot);
    if (result.status != LegIk::pulled_back) {
      continue;
    }
    ++seen;
    const Pose found = sole_of(result, foot);
    EXPECT_LT((found.R - sole.R).norm(), 1e-13);
    const Vec3 ankle = sole.p + sole.R.col(2) * 0.037 - kHip[foot];
    const Vec3 found_ankle = found.p + found.R.col(2) * 0.037 - kHip[foot];
    EXPECT_NEAR(found_ankle.norm(), 0.2 - kLegReachMargin_m, 1e-14);
    EXPECT_NEAR(ankle.norm() - found_ankle.norm(), result.excess_m, 1e-14);
    EXPECT_LT(found_ankle.cross(ankle).norm(), 1e-14);
  }
  EXPECT_GT(seen, 500);
}

TEST(LegIk, LimitsAreToldAndKept) {
  LegIkResult result;
  leg_ik(0, level_sole(0.0, -0.039, -0.037 - 0.05), result);  // needs a knee of 151 deg
  EXPECT_EQ(result.status, LegIk::joint_limit);
  expect_usable(result, 0);
  Pose turned = level_sole(0.0, -0.039, -0.22);
  turned.R = rot_z(0.6);  // the right foot turns inward by 30 deg only
  leg_ik(0, turned, result);
  EXPECT_EQ(result.status, LegIk::joint_limit);
  EXPECT_EQ(result.q_rad[0], HOAP2_JOINT[HOAP2_J_R_HIP_YAW].limit_soft_rad[1]);
  turned.p.y() = 0.039;  // the left foot outward by 90 deg
  leg_ik(1, turned, result);
  EXPECT_EQ(result.status, LegIk::ok);
}

TEST(LegIk, AlwaysFiniteAndWithinTheLimits) {
  RandomPosture random(43);
  for (double size : {0.0, 1e-300, 1e-12, 0.05, 0.3, 10.0, 1e9, 1e300}) {
    for (int n = 0; n < 500; ++n) {
      Pose sole = random.pose(size);
      if (n % 2 == 0) {
        sole.p += kHip[n % 4 / 2] - sole.R.col(2) * 0.037;  // around the ankle-at-the-hip point
      }
      LegIkResult result;
      leg_ik(n % 4 / 2, sole, result);
      expect_usable(result, n % 4 / 2);
    }
  }
}

TEST(LegIk, FiniteForMatricesThatAreNoRotations) {
  for (double entry : {0.0, 1e-320, 1.0, 1e200, std::numeric_limits<double>::max()}) {
    for (double position : {0.0, 1.0, std::numeric_limits<double>::max()}) {
      Pose sole;
      sole.R.setConstant(entry);
      sole.R(0, 1) = -entry;
      sole.p.setConstant(-position);
      LegIkResult result;
      leg_ik(1, sole, result);
      expect_usable(result, 1);
    }
  }
}

// The pelvis turns about the vertical while both feet stand: theory of the twist synergy of 7.6. With
// straight legs the exact joint angles are closed forms of the turn; the leg IK must find them.
TEST(LegIk, TwistOfThePelvisMatchesItsClosedForm) {
  const double d = 0.039;
  const double l = 0.2;
  for (double turn_rad : {-0.5, -0.2, -0.05, 0.05, 0.2, 0.5}) {
    for (int foot = 0; foot < 2; ++foot) {
      const double side = foot == 0 ? 1.0 : -1.0;
      const double pitch = side * std::asin(d * std::sin(turn_rad) / l);
      const double roll = -side * std::asin(d * (1.0 - std::cos(turn_rad)) / (l * std::cos(pitch)));
      const double height_m = l * std::cos(roll) * std::cos(pitch) + 0.037;
      Pose sole_W;  // origin of W: below the pelvis, on the floor
      sole_W.p = Vec3(0.0, -side * d, 0.0);
      Pose base_W;
      base_W.R = rot_z(turn_rad);
      base_W.p = Vec3(0.0, 0.0, height_m);
      LegIkResult result;
      leg_ik(foot, compose(inverse(base_W), sole_W), result, 0.0);
      EXPECT_NE(result.status, LegIk::joint_limit);
      EXPECT_NEAR(result.q_rad[0], -turn_rad, 1e-12);
      EXPECT_NEAR(result.q_rad[3], 0.0, 1e-6);
      EXPECT_NEAR(result.q_rad[1], roll, 1e-6);
      EXPECT_NEAR(result.q_rad[2], pitch, 1e-6);
      EXPECT_NEAR(result.q_rad[4], -pitch, 1e-6);
      EXPECT_NEAR(result.q_rad[5], -roll, 1e-6);
    }
  }
}

}  // namespace
