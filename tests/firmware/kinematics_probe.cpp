// The robot's kinematics behind plain C functions, so that another language can hold them against an
// independent rigid-body library. Matrices are row-major.
#include <cstring>

#include "robot/kinematics.hpp"
#include "robot/leg_ik.hpp"

namespace {

template <typename Matrix>
void to_rows(const Matrix& matrix, double* rows) {
  for (int r = 0; r < matrix.rows(); ++r) {
    for (int c = 0; c < matrix.cols(); ++c) {
      rows[r * matrix.cols() + c] = matrix(r, c);
    }
  }
}

hoap2::Kinematics kinematics_of(const double* q_rad) {
  hoap2::Kinematics kin;
  hoap2::forward_kinematics(q_rad, kin);
  return kin;
}

}  // namespace

extern "C" {

void probe_link_poses(const double* q_rad, double* rotations, double* positions_m, double* com_m) {
  const hoap2::Kinematics kin = kinematics_of(q_rad);
  for (int i = 0; i < HOAP2_LINKS; ++i) {
    to_rows(kin.link_B[i].R, rotations + 9 * i);
    to_rows(kin.link_B[i].p, positions_m + 3 * i);
  }
  to_rows(kin.com_B, com_m);
}

void probe_sole_pose(const double* q_rad, int foot, double* rotation, double* position_m) {
  const hoap2::Pose sole = hoap2::sole_pose_B(kinematics_of(q_rad), foot);
  to_rows(sole.R, rotation);
  to_rows(sole.p, position_m);
}

void probe_com_jacobian(const double* q_rad, double* jacobian) {
  hoap2::ComJacobian result;
  hoap2::com_jacobian_B(kinematics_of(q_rad), result);
  to_rows(result, jacobian);
}

void probe_point_jacobian(const double* q_rad, int link, const double* point_L_m, double* jacobian) {
  const hoap2::Kinematics kin = kinematics_of(q_rad);
  const hoap2::Vec3 point_L = Eigen::Map<const hoap2::Vec3>(point_L_m);
  hoap2::PointJacobian result;
  hoap2::point_jacobian_B(kin, link, hoap2::transform(kin.link_B[link], point_L), result);
  to_rows(result, jacobian);
}

}  // extern "C"
