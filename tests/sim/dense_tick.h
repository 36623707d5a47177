// The equations of a tick written down for all bodies at once (docs/solver.md, "The equations"):
// 156 velocities, 125 hinge rows, motor rows, forces at points. Knows nothing of trees.
#ifndef HOAP2_TESTS_SIM_DENSE_TICK_H
#define HOAP2_TESTS_SIM_DENSE_TICK_H

#include <Eigen/Dense>
#include <vector>

#include "tick_rig.h"

namespace hoap2_sim {

class DenseTick {
 public:
  // The tick that the rig has just run, with the motor rows of its last solve.
  explicit DenseTick(const TickRig &tick) : tick_(tick) {
    for (int link = 0; link < HOAP2_LINKS; ++link) add_body(link);
    for (int j = 0; j < HOAP2_JOINTS; ++j) add_joint(j);
    factors_.compute(matrix_);
  }

  // Velocities after the tick (per link: of the CoM, angular) when these forces act at the contact points.
  Eigen::VectorXd velocities(const std::vector<Vec3> &force_W_N) const {
    Eigen::VectorXd right = right_;
    for (std::size_t i = 0; i < force_W_N.size(); ++i) {
      const Contact &at = tick_.contacts.at[i];
      const Vec3 arm_W_m = vec(at.point_W_m) - vec(tick_.before.body[at.link].com_pos_W_m);
      right.segment<3>(6 * at.link) += kTick_s * eigen(force_W_N[i]);
      right.segment<3>(6 * at.link + 3) += kTick_s * eigen(cross(arm_W_m, force_W_N[i]));
    }
    return factors_.solve(right).head(kBodyRows);
  }

 private:
  static constexpr int kBodyRows = 6 * HOAP2_LINKS, kRows = kBodyRows + 5 * HOAP2_JOINTS;

  static Matrix3 matrix3(const Mat3 &m) {
    Matrix3 out;
    out.col(0) = eigen(m.cx);
    out.col(1) = eigen(m.cy);
    out.col(2) = eigen(m.cz);
    return out;
  }
  static Matrix3 skew(const Vector3 &v) {
    Matrix3 m;
    m << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
    return m;
  }

  // M V+ = M V + h F; the gyroscopic torque is -(exp(h [w]) - 1) I w / h in body axes with w
  // extrapolated, the series cut after its third term.
  void add_body(int link) {
    const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
    Matrix3 inertia_L;
    inertia_L << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
    const BodyState &body = tick_.before.body[link];
    const Matrix3 axes = matrix3(tick_.axes_W[link]), inertia_W = axes * inertia_L * axes.transpose();
    const Vector3 w = eigen(body.omega_W_rad_s);
    const Vector3 w_next = axes.transpose() * (2.0 * w - eigen(body.omega_before_W_rad_s));
    const Matrix3 turn = kTick_s * skew(w_next);
    const Matrix3 turned = turn + turn * turn / 2.0 + turn * turn * turn / 6.0;
    const Vector3 gyroscopic_Nms = -axes * (turned * (inertia_L * w_next));
    const double mass_kg = HOAP2_LINK[link].mass_kg;
    matrix_.block<3, 3>(6 * link, 6 * link) = mass_kg * Matrix3::Identity();
    matrix_.block<3, 3>(6 * link + 3, 6 * link + 3) = inertia_W;
    right_.segment<3>(6 * link) = mass_kg * eigen(body.com_vel_W_m_s);
    right_[6 * link + 2] -= kTick_s * mass_kg * tick_.before.params.gravity_m_s2;
    right_.segment<3>(6 * link + 3) = inertia_W * w + gyroscopic_Nms;
  }

  void add_joint(int j) {
    const hoap2_joint_data_t &joint = HOAP2_JOINT[j];
    const int c = joint.child_link, p = joint.parent_link;
    const Vector3 axis = eigen(tick_.axes_W[c].column(joint.axis));
    const Vector3 anchor_c = eigen(point_W_m(tick_.before, c, Vec3{}));
    const Vector3 anchor_p = eigen(point_W_m(tick_.before, p, vec(joint.origin_parent_m)));
    const Vector3 arm_c = anchor_c - eigen(tick_.before.body[c].com_pos_W_m);
    const Vector3 arm_p = anchor_p - eigen(tick_.before.body[p].com_pos_W_m);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(5, kBodyRows);
    row.block<3, 3>(0, 6 * c) = Matrix3::Identity();
    row.block<3, 3>(0, 6 * c + 3) = -skew(arm_c);
    row.block<3, 3>(0, 6 * p) = -Matrix3::Identity();
    row.block<3, 3>(0, 6 * p + 3) = skew(arm_p);
    const Vector3 across_1 = axis.unitOrthogonal(), across_2 = axis.cross(across_1);
    row.block<1, 3>(3, 6 * c + 3) = across_1.transpose();
    row.block<1, 3>(4, 6 * c + 3) = across_2.transpose();
    row.block<1, 3>(3, 6 * p + 3) = -across_1.transpose();
    row.block<1, 3>(4, 6 * p + 3) = -across_2.transpose();
    const Vector3 turned = axis.cross(eigen(tick_.axes_W[p].column(joint.axis)));
    Eigen::Matrix<double, 5, 1> error;
    error << anchor_p - anchor_c, across_1.dot(turned), across_2.dot(turned);
    const int at = kBodyRows + 5 * j;
    matrix_.middleRows(at, 5).leftCols(kBodyRows) = row;
    matrix_.middleCols(at, 5).topRows(kBodyRows) = row.transpose();
    right_.segment<5>(at) = 0.2 / kTick_s * error;
    // motor: torque D (target - a . (w - w')) on the child, its opposite on the parent
    Eigen::RowVectorXd motor = Eigen::RowVectorXd::Zero(kBodyRows);
    motor.segment<3>(6 * c + 3) = axis.transpose();
    motor.segment<3>(6 * p + 3) = -axis.transpose();
    const double motor_Ns = kTick_s * tick_.row[j].stiffness_Nms_rad;
    matrix_.topLeftCorner(kBodyRows, kBodyRows) += motor_Ns * motor.transpose() * motor;
    right_.head(kBodyRows) += motor_Ns * tick_.row[j].target_rad_s * motor.transpose();
  }

  const TickRig &tick_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(kRows, kRows);
  Eigen::VectorXd right_ = Eigen::VectorXd::Zero(kRows);
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace hoap2_sim
#endif
