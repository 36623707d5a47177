// Forward kinematics, centre of mass and Jacobians, all in the pelvis frame B.
//
// B lies midway between the hip centres, x forward, y left, z up. Link frames sit on the joint of their
// link and are parallel to B in the zero posture. Jacobians are geometric with the pelvis held still;
// columns follow the joint order, rows are linear first.
#ifndef HOAP2_ROBOT_KINEMATICS_HPP
#define HOAP2_ROBOT_KINEMATICS_HPP

#include "robot/rotation.hpp"

namespace hoap2 {

using ComJacobian = Eigen::Matrix<double, 3, HOAP2_JOINTS>;
using PointJacobian = Eigen::Matrix<double, 6, HOAP2_JOINTS>;

struct Kinematics {
  Pose link_B[HOAP2_LINKS];
  Vec3 com_B = Vec3::Zero();
};

// All link frames and the CoM of the whole robot.
void forward_kinematics(const double q_rad[HOAP2_JOINTS], Kinematics& kin);

// The sole frame of a foot (0 right, 1 left): at the sole point under the ankle, parallel to the foot link.
Pose sole_pose_B(const Kinematics& kin, int foot);

// Orientation of the chest, where the IMU sits, against the pelvis.
inline const Mat3& chest_rot_B(const Kinematics& kin) { return kin.link_B[HOAP2_L_CHEST].R; }

// com rate = J * joint rates
void com_jacobian_B(const Kinematics& kin, ComJacobian& jacobian);

// (velocity of the point that is fixed to `link` and now at point_B; angular velocity of the link)
void point_jacobian_B(const Kinematics& kin, int link, const Vec3& point_B, PointJacobian& jacobian);

}  // namespace hoap2
#endif
