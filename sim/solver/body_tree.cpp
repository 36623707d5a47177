#include "solver/body_tree.h"

#include <Eigen/Cholesky>

#include "robot/kinematics.h"
#include "solver/gyroscopic.h"
#include "soil/soil.h"

namespace hoap2_sim {
namespace {

struct TreeShape {
  int joint[HOAP2_LINKS];
  int parent[HOAP2_LINKS];
  int axis[HOAP2_LINKS];
};

constexpr int kPelvis = HOAP2_L_PELVIS;

TreeShape shape_of_robot() {
  TreeShape shape;
  shape.joint[kPelvis] = shape.parent[kPelvis] = -1;
  shape.axis[kPelvis] = 0;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const hoap2_joint_data_t &data = HOAP2_JOINT[j];
    shape.joint[data.child_link] = j;
    shape.parent[data.child_link] = data.parent_link;
    shape.axis[data.child_link] = data.axis;
  }
  return shape;
}

const TreeShape kShape = shape_of_robot();

Matrix3 eigen(const Mat3 &m) {
  Matrix3 out;
  out << m.cx.x, m.cy.x, m.cz.x, m.cx.y, m.cy.y, m.cz.y, m.cx.z, m.cy.z, m.cz.z;
  return out;
}

Matrix3 inertia_W(int link, const Matrix3 &axes) {
  const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
  Matrix3 inertia_L;
  inertia_L << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  const Matrix3 turned = axes * inertia_L;
  return turned * axes.transpose();
}

}  // namespace

int joint_above(int link) { return kShape.joint[link]; }
int parent_of(int link) { return kShape.parent[link]; }

void BodyTree::build(const hoap2_plant_params_t &params) {
  for (int i = 0; i < HOAP2_LINKS; ++i) {
    anchors_[i].child_com_L_m.setZero();
    anchors_[i].in_parent_L_m.setZero();
    if (i == kPelvis) continue;
    anchors_[i].child_com_L_m = hoap2_sim::eigen(link_com_L_m(params, i));
    Vec3 origin_m = vec(HOAP2_JOINT[kShape.joint[i]].origin_parent_m);
    // the pelvis' reference point is its CoM
    if (kShape.parent[i] == kPelvis) origin_m = origin_m - link_com_L_m(params, kPelvis);
    anchors_[i].in_parent_L_m = hoap2_sim::eigen(origin_m);
  }
}

void BodyTree::begin(const TickProblem &problem, const bool touched[HOAP2_LINKS]) {
  for (int i = 0; i < HOAP2_LINKS; ++i) link_[i].carries = touched[i];
  for (int i = HOAP2_LINKS - 1; i > 0; --i) {
    if (link_[i].carries) link_[kShape.parent[i]].carries = true;
  }
  link_[kPelvis].carries = true;
  carriers_ = 0;
  for (int i = 0; i < HOAP2_LINKS; ++i) {
    if (link_[i].carries) carrier_[carriers_++] = i;
    begin_link(problem, i);
    if (problem.soil != nullptr) add_soil(problem.soil[i], &link_[i]);
    if (i != kPelvis) begin_hinge(problem, i);
  }
}

// Inertia and momentum (with the impulse of gravity, gyroscopic torque and load) about
// the reference point: with d from there to the CoM, momentum l = m v_com + h F,
// a = I w + h tau + d x l, and the inertia [I - m [d][d], m [d]; -m [d], m].
void BodyTree::begin_link(const TickProblem &problem, int i) {
  Link &link = link_[i];
  const BodyState &body = problem.state->body[i];
  const LinkLoad &load = problem.load[i];
  const Matrix3 axes = eigen(problem.axes_W[i]);
  const double mass_kg = HOAP2_LINK[i].mass_kg;
  link.com_arm_W_m = axes * anchors_[i].child_com_L_m;
  link.reference_W_m = hoap2_sim::eigen(body.com_pos_W_m) - link.com_arm_W_m;
  const Vector3 &d = link.com_arm_W_m;
  const Matrix3 about_com = inertia_W(i, axes);
  Matrix3 mass_arm;
  mass_arm << 0.0, -d[2], d[1], d[2], 0.0, -d[0], -d[1], d[0], 0.0;
  mass_arm *= mass_kg;
  SpatialInertia &own = link.own_inertia;
  own.linear = mass_kg * Matrix3::Identity();
  own.coupling = mass_arm;
  own.angular = about_com - cross_right(mass_arm, d);
  Vector3 force_W_N = hoap2_sim::eigen(load.force_W_N);
  force_W_N[2] -= mass_kg * problem.state->params.gravity_m_s2;
  const Vec3 torque_W_Nm = load.torque_com_W_Nm + gyroscopic_torque_W_Nm(body, i, problem.axes_W[i]);
  link.own_momentum.linear = mass_kg * hoap2_sim::eigen(body.com_vel_W_m_s) + kTick_s * force_W_N;
  link.own_momentum.angular = about_com * hoap2_sim::eigen(body.omega_W_rad_s) +
                              kTick_s * hoap2_sim::eigen(torque_W_Nm) + d.cross(link.own_momentum.linear);
}

// The soil's wrench F0 - Z V+ about the CoM: h Z is added to the inertia, h F0 to the momentum.
void BodyTree::add_soil(const SoilLoad &soil, Link *link) {
  if (!soil.touches) return;
  SpatialInertia impedance;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      impedance.angular(r, c) = kTick_s * soil.angular[r][c];
      impedance.coupling(r, c) = kTick_s * soil.coupling[r][c];
      impedance.linear(r, c) = kTick_s * soil.linear[r][c];
    }
  }
  link->own_inertia += impedance.shifted(link->com_arm_W_m);
  const Vector3 impulse_W_Ns = kTick_s * eigen(soil.force_W_N);
  link->own_momentum.linear += impulse_W_Ns;
  link->own_momentum.angular +=
      kTick_s * eigen(soil.torque_com_W_Nm) + link->com_arm_W_m.cross(impulse_W_Ns);
}

// The hinge's rows ask for the velocity ERP / h times its error: of the anchors, and of
// the axes across the child's.
void BodyTree::begin_hinge(const TickProblem &problem, int i) {
  Link &link = link_[i];
  const int p = kShape.parent[i];
  const Mat3 &parent_axes = problem.axes_W[p];
  const Vec3 axis = problem.axes_W[i].column(kShape.axis[i]);
  const Vec3 axis_in_parent = parent_axes.column(kShape.axis[i]);
  link.axis_W = hoap2_sim::eigen(axis);
  link.from_parent_W_m = eigen(parent_axes) * anchors_[i].in_parent_L_m;
  link.shifted = !anchors_[i].in_parent_L_m.isZero(0.0);
  const Vector3 apart_W_m = link_[p].reference_W_m + link.from_parent_W_m - link.reference_W_m;
  constexpr double kFeedback = kHingeErp / kTick_s;
  link.bias.linear = kFeedback * apart_W_m;
  link.bias.angular = kFeedback * hoap2_sim::eigen(cross(axis, axis_in_parent));
}

// Takes the joint out of a link whose subtree is already in `inertia` and `momentum`:
// what is left is what the parent feels at the anchor.
void BodyTree::eliminate(Link *link, SpatialInertia *inertia, SpatialVector *momentum) {
  const Vector3 &s = link->axis_W;
  SpatialVector &u = link->reaction;
  u.angular = inertia->angular * s;
  u.linear = inertia->coupling.transpose() * s;
  link->pivot_inverse = 1.0 / (s.dot(u.angular) + link->motor_Ns);
  link->free_rate = link->motor_Ns * link->target_rad_s + s.dot(momentum->angular) -
                    u.angular.dot(link->bias.angular) - u.linear.dot(link->bias.linear);
  const SpatialVector of_bias = *inertia * link->bias;
  const double rate = link->free_rate * link->pivot_inverse;
  momentum->angular -= of_bias.angular + rate * u.angular;
  momentum->linear -= of_bias.linear + rate * u.linear;
  const Vector3 angular = link->pivot_inverse * u.angular, linear = link->pivot_inverse * u.linear;
  inertia->angular -= u.angular * angular.transpose();
  inertia->coupling -= u.angular * linear.transpose();
  inertia->linear -= u.linear * linear.transpose();
  if (!link->shifted) return;
  *inertia = inertia->shifted(link->from_parent_W_m);
  momentum->angular += link->from_parent_W_m.cross(momentum->linear);
}

void BodyTree::set_motors(const MotorRow row[HOAP2_JOINTS]) {
  for (int i = 0; i < HOAP2_LINKS; ++i) {
    Link &link = link_[i];
    link.base_inertia = link.own_inertia;
    link.base_momentum = link.own_momentum;
    if (i == kPelvis) continue;
    const MotorRow &motor = row[kShape.joint[i]];
    link.motor_Ns = kTick_s * motor.stiffness_Nms_rad;
    link.target_rad_s = motor.target_rad_s;
  }
  for (int i = HOAP2_LINKS - 1; i > 0; --i) {
    Link &link = link_[i];
    if (link.carries) continue;
    eliminate(&link, &link.base_inertia, &link.base_momentum);
    link_[kShape.parent[i]].base_inertia += link.base_inertia;
    link_[kShape.parent[i]].base_momentum += link.base_momentum;
  }
}

void BodyTree::clear_points() {
  for (int k = 0; k < carriers_; ++k) {
    Link &link = link_[carrier_[k]];
    link.inertia = link.base_inertia;
    link.momentum = link.base_momentum;
  }
}

void BodyTree::add_point(int i, const Vector3 &arm_W_m, const Matrix3 &k_W_Ns2_m,
                         const Vector3 &impulse_W_Ns) {
  link_[i].inertia.add_at(arm_W_m, k_W_Ns2_m);
  link_[i].momentum.angular += arm_W_m.cross(impulse_W_Ns);
  link_[i].momentum.linear += impulse_W_Ns;
}

void BodyTree::solve_root() {
  Link &root = link_[kPelvis];
  Eigen::Matrix<double, 6, 6> matrix;
  matrix << root.inertia.angular, root.inertia.coupling, root.inertia.coupling.transpose(),
      root.inertia.linear;
  Eigen::Matrix<double, 6, 1> momentum;
  momentum << root.momentum.angular, root.momentum.linear;
  const Eigen::Matrix<double, 6, 1> motion = matrix.llt().solve(momentum);
  root.motion = {motion.head<3>(), motion.tail<3>()};
}

void BodyTree::descend(int i) {
  Link &link = link_[i];
  const SpatialVector &parent = link_[kShape.parent[i]].motion;
  const Vector3 linear = parent.linear + parent.angular.cross(link.from_parent_W_m);
  link.rate_rad_s = link.pivot_inverse * (link.free_rate - link.reaction.angular.dot(parent.angular) -
                                          link.reaction.linear.dot(linear));
  link.motion.angular = parent.angular + link.bias.angular + link.rate_rad_s * link.axis_W;
  link.motion.linear = linear + link.bias.linear;
}

void BodyTree::solve_touched() {
  for (int k = carriers_ - 1; k > 0; --k) {
    Link &link = link_[carrier_[k]];
    Link &parent = link_[kShape.parent[carrier_[k]]];
    eliminate(&link, &link.inertia, &link.momentum);
    parent.inertia += link.inertia;
    parent.momentum += link.momentum;
  }
  solve_root();
  for (int k = 1; k < carriers_; ++k) descend(carrier_[k]);
}

void BodyTree::solve_rest() {
  for (int i = 1; i < HOAP2_LINKS; ++i) {
    if (!link_[i].carries) descend(i);
  }
}

Vector3 BodyTree::com_velocity_W_m_s(int i) const {
  const Link &link = link_[i];
  return link.motion.linear + link.motion.angular.cross(link.com_arm_W_m);
}

}  // namespace hoap2_sim
