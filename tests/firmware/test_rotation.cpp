#include <gtest/gtest.h>

#include <cmath>

#include "random_posture.hpp"

namespace {

using namespace hoap2;
using hoap2_tests::RandomPosture;

constexpr double kPi = 3.14159265358979323846;

double difference(const Mat3& a, const Mat3& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Rotation, ElementaryTurnsAreRightHanded) {
  EXPECT_LT((rot_x(kPi / 2) * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((rot_y(kPi / 2) * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((rot_z(kPi / 2) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Rotation, QuaternionRoundTrip) {
  RandomPosture random(11);
  for (int i = 0; i < 5000; ++i) {
    const Mat3 R = random.rotation();
    const Vec4 quat = quat_from_matrix(R);
    ASSERT_NEAR(quat.norm(), 1.0, 1e-14);
    ASSERT_GE(quat(0), 0.0);
    ASSERT_LT(difference(matrix_from_quat(quat), R), 1e-14);
  }
}

TEST(Rotation, QuaternionOfHalfTurnsAndTheirNeighbours) {
  for (int axis = 0; axis < 3; ++axis) {
    for (double offset_rad : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
      const double angle_rad = kPi + offset_rad;
      const Mat3 R = axis == 0 ? rot_x(angle_rad) : axis == 1 ? rot_y(angle_rad) : rot_z(angle_rad);
      EXPECT_LT(difference(matrix_from_quat(quat_from_matrix(R)), R), 1e-14);
    }
  }
}

TEST(Rotation, QuaternionComponentsAreOrderedWxyz) {
  const Vec4 quat = quat_from_matrix(rot_y(0.4));
  EXPECT_NEAR(quat(0), std::cos(0.2), 1e-15);
  EXPECT_NEAR(quat(2), std::sin(0.2), 1e-15);
  EXPECT_EQ(matrix_from_quat(Vec4::Zero()), Mat3::Identity());
}

TEST(Rotation, RollPitchYawRoundTripAndOrder) {
  RandomPosture random(12);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 rpy_rad(random.uniform(-kPi, kPi), random.uniform(-1.5, 1.5), random.uniform(-kPi, kPi));
    const Mat3 R = matrix_from_rpy(rpy_rad);
    ASSERT_LT(difference(R, rot_z(rpy_rad.z()) * rot_y(rpy_rad.y()) * rot_x(rpy_rad.x())), 1e-15);
    ASSERT_LT((rpy_from_matrix(R) - rpy_rad).norm(), 1e-12);
  }
}

TEST(Rotation, RollPitchYawAtTheSingularityGivesTheSameRotation) {
  for (double sign : {-1.0, 1.0}) {
    const Mat3 R = rot_z(0.7) * rot_y(sign * kPi / 2) * rot_x(0.3);
    EXPECT_LT(difference(matrix_from_rpy(rpy_from_matrix(R)), R), 1e-9);
  }
}

TEST(Rotation, ComposeAndInverse) {
  RandomPosture random(13);
  for (int i = 0; i < 1000; ++i) {
    const Pose A_B = random.pose(2.0);
    const Pose B_C = random.pose(2.0);
    const Vec3 point_C = random.vector(3.0);
    const Pose A_C = compose(A_B, B_C);
    ASSERT_LT((transform(A_C, point_C) - transform(A_B, transform(B_C, point_C))).norm(), 1e-13);
    const Pose identity = compose(A_B, inverse(A_B));
    ASSERT_LT(difference(identity.R, Mat3::Identity()), 1e-14);
    ASSERT_LT(identity.p.norm(), 1e-14);
  }
}

TEST(Rotation, SkewIsTheCrossProduct) {
  const Vec3 a(1.0, -2.0, 3.0);
  const Vec3 b(0.5, 4.0, -1.0);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Rotation, WrapAngle) {
  EXPECT_EQ(wrap_angle(1.0), 1.0);
  EXPECT_NEAR(wrap_angle(2 * kPi + 1.0), 1.0, 1e-14);
  EXPECT_NEAR(wrap_angle(-kPi - 0.5), kPi - 0.5, 1e-14);
  EXPECT_EQ(wrap_angle(kPi), kPi);
}

}  // namespace
