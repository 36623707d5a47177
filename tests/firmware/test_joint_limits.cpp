#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "random_posture.hpp"
#include "robot/joint_limits.hpp"

namespace {

using namespace hoap2;
using hoap2_tests::JointAngles;
using hoap2_tests::RandomPosture;

TEST(JointLimits, AnglesInsideStayUntouched) {
  RandomPosture random(31);
  for (int n = 0; n < 1000; ++n) {
    const JointAngles before = random.joints();
    JointAngles q_rad = before;
    ASSERT_EQ(clip_to_soft_limits(q_rad.data()), 0);
    ASSERT_EQ(q_rad, before);
  }
}

TEST(JointLimits, EveryJointIsClippedAtBothEndsAndNamedByItsBit) {
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    for (int end = 0; end < 2; ++end) {
      JointAngles q_rad;
      for (size_t i = 0; i < q_rad.size(); ++i) {
        q_rad[i] = 0.5 * (HOAP2_JOINT[i].limit_soft_rad[0] + HOAP2_JOINT[i].limit_soft_rad[1]);
      }
      const double limit = HOAP2_JOINT[j].limit_soft_rad[end];
      q_rad[static_cast<size_t>(j)] = limit + (end == 0 ? -1e-6 : 1e-6);
      EXPECT_EQ(clip_to_soft_limits(q_rad.data()), 1 << j);
      EXPECT_EQ(q_rad[static_cast<size_t>(j)], limit);
    }
  }
}

TEST(JointLimits, RoundingAtTheLimitIsClippedWithoutAReport) {
  JointAngles q_rad{};
  q_rad[HOAP2_J_R_KNEE] = -1e-12;
  EXPECT_EQ(clip_to_soft_limits(q_rad.data()), 0);
  EXPECT_EQ(q_rad[HOAP2_J_R_KNEE], 0.0);
}

TEST(JointLimits, NotANumberAndInfinityAreCaught) {
  JointAngles q_rad{};
  q_rad[HOAP2_J_L_KNEE] = std::numeric_limits<double>::quiet_NaN();
  q_rad[HOAP2_J_R_KNEE] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(clip_to_soft_limits(q_rad.data()), (1 << HOAP2_J_L_KNEE) | (1 << HOAP2_J_R_KNEE));
  EXPECT_EQ(q_rad[HOAP2_J_L_KNEE], HOAP2_JOINT[HOAP2_J_L_KNEE].limit_soft_rad[0]);
  EXPECT_EQ(q_rad[HOAP2_J_R_KNEE], HOAP2_JOINT[HOAP2_J_R_KNEE].limit_soft_rad[1]);
}

}  // namespace
