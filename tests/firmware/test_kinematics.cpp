#include <gtest/gtest.h>

#include <cmath>

#include "random_posture.hpp"

namespace {

using namespace hoap2;
using hoap2_tests::JointAngles;
using hoap2_tests::RandomPosture;

constexpr double kDeg = 3.14159265358979323846 / 180.0;

Kinematics kinematics_of(const JointAngles& q_rad) {
  Kinematics kin;
  forward_kinematics(q_rad.data(), kin);
  return kin;
}

// An independent, slow reading of the joint table: rot(axis, angle) as a full matrix, parents first.
Kinematics by_the_table(const JointAngles& q_rad) {
  Kinematics kin;
  for (int j : HOAP2_TREE_ORDER) {
    const hoap2_joint_data_t& joint = HOAP2_JOINT[j];
    const double angle = q_rad[static_cast<size_t>(j)];
    Pose step;
    step.R = joint.axis == 0 ? rot_x(angle) : joint.axis == 1 ? rot_y(angle) : rot_z(angle);
    step.p = Eigen::Map<const Vec3>(joint.origin_parent_m);
    kin.link_B[joint.child_link] = compose(kin.link_B[joint.parent_link], step);
  }
  Vec3 moment = Vec3::Zero();
  double mass_kg = 0.0;
  for (int i = 0; i < HOAP2_LINKS; ++i) {
    moment += HOAP2_LINK[i].mass_kg * transform(kin.link_B[i], Eigen::Map<const Vec3>(HOAP2_LINK[i].com_L_m));
    mass_kg += HOAP2_LINK[i].mass_kg;
  }
  kin.com_B = moment / mass_kg;
  return kin;
}

TEST(Kinematics, TreeOrderNamesEveryJointOnceParentsFirst) {
  std::array<bool, HOAP2_LINKS> placed{};
  placed[HOAP2_L_PELVIS] = true;
  for (int j : HOAP2_TREE_ORDER) {
    EXPECT_TRUE(placed[static_cast<size_t>(HOAP2_JOINT[j].parent_link)]);
    EXPECT_FALSE(placed[static_cast<size_t>(HOAP2_JOINT[j].child_link)]);
    placed[static_cast<size_t>(HOAP2_JOINT[j].child_link)] = true;
  }
  for (bool there : placed) {
    EXPECT_TRUE(there);
  }
}

TEST(Kinematics, EqualsTheJointTable) {
  RandomPosture random(21);
  for (int n = 0; n < 1000; ++n) {
    const JointAngles q_rad = random.joints();
    const Kinematics kin = kinematics_of(q_rad);
    const Kinematics expected = by_the_table(q_rad);
    for (int i = 0; i < HOAP2_LINKS; ++i) {
      ASSERT_LT((kin.link_B[i].R - expected.link_B[i].R).norm(), 1e-14) << "link " << i;
      ASSERT_LT((kin.link_B[i].p - expected.link_B[i].p).norm(), 1e-15) << "link " << i;
    }
    ASSERT_LT((kin.com_B - expected.com_B).norm(), 1e-15);
  }
}

TEST(Kinematics, ZeroPosture) {
  const Kinematics kin = kinematics_of(JointAngles{});
  for (const Pose& link : kin.link_B) {
    EXPECT_EQ(link.R, Mat3::Identity());
  }
  const Pose right = sole_pose_B(kin, 0);
  const Pose left = sole_pose_B(kin, 1);
  EXPECT_LT((right.p - Vec3(0.0, -0.039, -0.237)).norm(), 1e-15);
  EXPECT_LT((left.p - Vec3(0.0, 0.039, -0.237)).norm(), 1e-15);
  EXPECT_LT((kin.link_B[HOAP2_L_R_HAND].p - Vec3(0.201, -0.0995, 0.145)).norm(), 1e-15);  // arms point ahead
}

TEST(Kinematics, SignsOfTheJoints) {
  JointAngles q_rad{};
  q_rad[HOAP2_J_L_HIP_PITCH] = -30 * kDeg;  // thigh forward
  EXPECT_GT(kinematics_of(q_rad).link_B[HOAP2_L_L_SHANK].p.x(), 0.04);
  q_rad = {};
  q_rad[HOAP2_J_L_KNEE] = 30 * kDeg;  // flexion: ankle back
  EXPECT_LT(kinematics_of(q_rad).link_B[HOAP2_L_L_FOOT].p.x(), -0.04);
  q_rad = {};
  q_rad[HOAP2_J_R_SHOULDER_PITCH] = 90 * kDeg;  // arm down
  EXPECT_LT(kinematics_of(q_rad).link_B[HOAP2_L_R_HAND].p.z(), -0.05);
  q_rad = {};
  q_rad[HOAP2_J_WAIST_PITCH] = 30 * kDeg;  // chest forward
  EXPECT_GT(kinematics_of(q_rad).link_B[HOAP2_L_HEAD].p.x(), 0.05);
  EXPECT_LT(chest_rot_B(kinematics_of(q_rad))(2, 0), -0.4);
  q_rad = {};
  q_rad[HOAP2_J_L_HIP_YAW] = 30 * kDeg;  // toes to the left
  EXPECT_GT(sole_pose_B(kinematics_of(q_rad), 1).R(1, 0), 0.4);
}

TEST(Kinematics, ComJacobianEqualsCentralDifferences) {
  RandomPosture random(22);
  for (int n = 0; n < 100; ++n) {
    const JointAngles q_rad = random.joints();
    ComJacobian jacobian;
    com_jacobian_B(kinematics_of(q_rad), jacobian);
    const double h = 1e-5;
    for (size_t j = 0; j < q_rad.size(); ++j) {
      JointAngles plus = q_rad;
      JointAngles minus = q_rad;
      plus[j] += h;
      minus[j] -= h;
      const Vec3 rate = (kinematics_of(plus).com_B - kinematics_of(minus).com_B) / (2 * h);
      ASSERT_LT((jacobian.col(static_cast<int>(j)) - rate).norm(), 2e-10) << "joint " << j;
    }
  }
}

TEST(Kinematics, PointJacobianEqualsCentralDifferences) {
  RandomPosture random(23);
  for (int n = 0; n < 100; ++n) {
    const JointAngles q_rad = random.joints();
    const Kinematics kin = kinematics_of(q_rad);
    const int link = n % HOAP2_LINKS;
    const Vec3 point_L = random.vector(0.1);
    PointJacobian jacobian;
    point_jacobian_B(kin, link, transform(kin.link_B[link], point_L), jacobian);
    const double h = 1e-5;
    for (size_t j = 0; j < q_rad.size(); ++j) {
      JointAngles plus = q_rad;
      JointAngles minus = q_rad;
      plus[j] += h;
      minus[j] -= h;
      const Pose ahead = kinematics_of(plus).link_B[link];
      const Pose behind = kinematics_of(minus).link_B[link];
      const Vec3 velocity = (transform(ahead, point_L) - transform(behind, point_L)) / (2 * h);
      const Mat3 turn = (ahead.R - behind.R) * kin.link_B[link].R.transpose() / (2 * h);
      const Vec3 omega(turn(2, 1), turn(0, 2), turn(1, 0));
      ASSERT_LT((jacobian.col(static_cast<int>(j)).head<3>() - velocity).norm(), 1e-9) << "joint " << j;
      ASSERT_LT((jacobian.col(static_cast<int>(j)).tail<3>() - omega).norm(), 1e-9) << "joint " << j;
    }
  }
}

}  // namespace
