#include "solver/ode_solver.h"

#include "robot/kinematics.h"
#include "solver/gyroscopic.h"

namespace hoap2_sim {
namespace {

constexpr double kWorldCfm = 1e-10;

dContact contact_of(const Contact &at, const hoap2_plant_params_t &params) {
  const ContactRow row = contact_row(params);
  dContact contact = {};
  contact.surface.mode =
      dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactSlip1 | dContactSlip2;
  contact.surface.mu = params.friction_mu;
  contact.surface.soft_erp = row.erp;
  contact.surface.soft_cfm = row.compliance_m_Ns;
  contact.surface.slip1 = kContactSlip_m_Ns;
  contact.surface.slip2 = kContactSlip_m_Ns;
  for (int i = 0; i < 3; ++i) {
    contact.geom.pos[i] = at.point_W_m[i];
    contact.geom.normal[i] = at.normal_W[i];
    contact.fdir1[i] = at.along_W[i];
  }
  contact.geom.depth = at.depth_m;
  return contact;
}

}  // namespace

OdeSolver::OdeSolver(const hoap2_plant_params_t &params) {
  bodies_.build(params);
  contact_group_ = dJointGroupCreate(0);
  dWorldSetGravity(bodies_.world(), 0.0, 0.0, -params.gravity_m_s2);
  dWorldSetCFM(bodies_.world(), kWorldCfm);
  dWorldSetERP(bodies_.world(), kHingeErp);
  add_hinges();
}

OdeSolver::~OdeSolver() {
  if (contact_group_ != nullptr) dJointGroupDestroy(contact_group_);
}

void OdeSolver::abandon() {
  contact_group_ = nullptr;
  bodies_.abandon();
}

void OdeSolver::add_hinges() {
  Vec3 origin_m[HOAP2_LINKS];
  zero_posture_origins(origin_m);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const hoap2_joint_data_t &data = HOAP2_JOINT[j];
    const Vec3 anchor_W_m = origin_m[data.child_link];
    const Vec3 axis_W = unit_axis(data.axis);
    hinge_[j] = dJointCreateHinge(bodies_.world(), nullptr);
    dJointAttach(hinge_[j], bodies_.body(data.child_link), bodies_.body(data.parent_link));
    dJointSetHingeAnchor(hinge_[j], anchor_W_m.x, anchor_W_m.y, anchor_W_m.z);
    dJointSetHingeAxis(hinge_[j], axis_W.x, axis_W.y, axis_W.z);
    dJointSetHingeParam(hinge_[j], dParamFMax, dInfinity);  // unbounded row; limits are in the drive's law
  }
}

void OdeSolver::begin(const TickProblem &problem) {
  problem_ = problem;
  dJointGroupEmpty(contact_group_);
  const ContactList &contacts = *problem.contacts;
  for (int i = 0; i < contacts.count; ++i) {
    const dContact contact = contact_of(contacts.at[i], problem.state->params);
    const dJointID joint = dJointCreateContact(bodies_.world(), contact_group_, &contact);
    dJointAttach(joint, bodies_.body(contacts.at[i].link), nullptr);
    feedback_[i] = dJointFeedback{};
    dJointSetFeedback(joint, &feedback_[i]);
  }
}

void OdeSolver::write_bodies() {
  Vec3 vel_W_m_s[HOAP2_LINKS], omega_W_rad_s[HOAP2_LINKS];
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    vel_W_m_s[link] = vec(problem_.state->body[link].com_vel_W_m_s);
    omega_W_rad_s[link] = vec(problem_.state->body[link].omega_W_rad_s);
  }
  bodies_.write(*problem_.state, vel_W_m_s, omega_W_rad_s);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const LinkLoad &load = problem_.load[link];
    const Vec3 torque_W_Nm = load.torque_com_W_Nm +
                             gyroscopic_torque_W_Nm(problem_.state->body[link], link, problem_.axes_W[link]);
    dBodyAddForce(bodies_.body(link), load.force_W_N.x, load.force_W_N.y, load.force_W_N.z);
    dBodyAddTorque(bodies_.body(link), torque_W_Nm.x, torque_W_Nm.y, torque_W_Nm.z);
  }
}

// ODE's row reads J v+ = vel - cfm lambda with lambda the torque on the child link
// (its cfm is divided by h inside, as v+ = v + h M^-1 (f + J^T lambda)).
void OdeSolver::solve(const MotorRow row[HOAP2_JOINTS], double rate_rad_s[HOAP2_JOINTS]) {
  write_bodies();
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    dJointSetHingeParam(hinge_[j], dParamCFM, 1.0 / row[j].stiffness_Nms_rad);
    dJointSetHingeParam(hinge_[j], dParamVel, row[j].target_rad_s);
  }
  bodies_.step();
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const hoap2_joint_data_t &data = HOAP2_JOINT[j];
    const dReal *const child = dBodyGetAngularVel(bodies_.body(data.child_link));
    const dReal *const parent = dBodyGetAngularVel(bodies_.body(data.parent_link));
    rate_rad_s[j] = dot(problem_.axes_W[data.child_link].column(data.axis), vec(child) - vec(parent));
  }
}

void OdeSolver::finish(State *next) { bodies_.read(*problem_.state, next); }

void OdeSolver::contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const {
  for (int k = 0; k < 3; ++k) {
    force_W_N[k] = feedback_[i].f1[k];
    moment_com_W_Nm[k] = feedback_[i].t1[k];
  }
}

}  // namespace hoap2_sim
