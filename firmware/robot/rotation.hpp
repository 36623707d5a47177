// Vectors, rotations and rigid poses of fixed size.
//
// A rotation R_AB turns coordinates of frame B into coordinates of frame A; a Pose of B in A maps
// points by p_A = R p_B + p. Angles in rad, right-handed, positive about the positive axis.
#ifndef HOAP2_ROBOT_ROTATION_HPP
#define HOAP2_ROBOT_ROTATION_HPP

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/scalar_math.h"
#include "hoap2/generated/robot_model.h"

namespace hoap2 {

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using VecJ = Eigen::Matrix<double, HOAP2_JOINTS, 1>;

struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

// Pose of C in A from the pose of B in A and the pose of C in B.
inline Pose compose(const Pose& A_B, const Pose& B_C) {
  Pose A_C;
  A_C.R.noalias() = A_B.R * B_C.R;
  A_C.p.noalias() = A_B.R * B_C.p + A_B.p;
  return A_C;
}

inline Pose inverse(const Pose& A_B) {
  Pose B_A;
  B_A.R = A_B.R.transpose();
  B_A.p.noalias() = -(B_A.R * A_B.p);
  return B_A;
}

inline Vec3 transform(const Pose& A_B, const Vec3& point_B) { return A_B.R * point_B + A_B.p; }

Mat3 rot_x(double angle_rad);
Mat3 rot_y(double angle_rad);
Mat3 rot_z(double angle_rad);

// a x b = skew(a) b
Mat3 skew(const Vec3& a);

// R = rot_z(yaw) rot_y(pitch) rot_x(roll); the vector is (roll, pitch, yaw).
Mat3 matrix_from_rpy(const Vec3& rpy_rad);
// Pitch in [-pi/2, pi/2]. At pitch = +-pi/2, where only yaw -+ roll is defined, roll is 0.
Vec3 rpy_from_matrix(const Mat3& R);

// Quaternion (w, x, y, z); any length but 0 is accepted, 0 gives the identity.
Mat3 matrix_from_quat(const Vec4& quat_wxyz);
// Unit length, w >= 0.
Vec4 quat_from_matrix(const Mat3& R);

// The angle's value in (-pi, pi]; angles beyond some turns lose digits, none loops.
double wrap_angle(double angle_rad);

}  // namespace hoap2
#endif
