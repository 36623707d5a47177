#include "robot/engine.h"

#include "robot/kinematics.h"

namespace hoap2_sim {
namespace {

// Creep of a loaded contact along the ground, per newton: regularises the friction
// rows of a flat sole, which are redundant otherwise.
constexpr double kContactSlip_m_Ns = 1e-6;
constexpr double kWorldCfm = 1e-10;
constexpr double kWorldErp = 0.2;

// Contact of a corner with the ground as a spring and a damper, solved implicitly:
// erp = h k / (h k + d), cfm = 1 / (h k + d).
dContact contact_of(const Contact &at, const hoap2_plant_params_t &params) {
  const double spring_Ns_m = kTick_s * params.contact_stiffness_N_m;
  const double row_Ns_m = spring_Ns_m + params.contact_damping_Ns_m;
  dContact contact = {};
  contact.surface.mode =
      dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactSlip1 | dContactSlip2;
  contact.surface.mu = params.friction_mu;
  contact.surface.soft_erp = spring_Ns_m / row_Ns_m;
  contact.surface.soft_cfm = 1.0 / row_Ns_m;
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

Vec3 inertia_times(int link, const Vec3 &v) {
  const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
  return {i[0] * v.x + i[3] * v.y + i[4] * v.z, i[3] * v.x + i[1] * v.y + i[5] * v.z,
          i[4] * v.x + i[5] * v.y + i[2] * v.z};
}

// The engine solves I(R) (w+ - w) = h tau with the axes R of the tick's start, while
// the angular momentum of its end is I(R+) w+, R+ = exp(h w+) R. The torque
//   tau = -(I(R+) - I(R)) w+ / h = -(exp(h w+) - 1) I(R) w+ / h
// makes up for it (in body axes, as exp(h w) leaves w alone). w+ is extrapolated from
// the last two ticks; the exponential is cut after its third term. ODE's own term,
// -w x I w at the tick's start, keeps a tumble's angular momentum ten times worse.
Vec3 gyroscopic_torque_W_Nm(const BodyState &body, int link) {
  const Mat3 axes_W = matrix(quat(body.quat_W));
  const Vec3 omega_next = turn_back(axes_W, 2.0 * vec(body.omega_W_rad_s) - vec(body.omega_before_W_rad_s));
  const Vec3 first = cross(omega_next, inertia_times(link, omega_next));
  const Vec3 second = (kTick_s / 2.0) * cross(omega_next, first);
  const Vec3 third = (kTick_s / 3.0) * cross(omega_next, second);
  return axes_W * (-1.0 * (first + second + third));
}

}  // namespace

Engine::~Engine() { destroy(); }

void Engine::destroy() {
  if (world_ == nullptr) return;
  dJointGroupDestroy(contact_group_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(jobs_);
  abandon();
}

void Engine::abandon() {
  world_ = nullptr;
  contact_group_ = nullptr;
  jobs_ = nullptr;
}

void Engine::build(const hoap2_plant_params_t &params) {
  destroy();
  world_ = dWorldCreate();
  jobs_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(jobs_), jobs_);
  contact_group_ = dJointGroupCreate(0);
  dWorldSetGravity(world_, 0.0, 0.0, -params.gravity_m_s2);
  dWorldSetCFM(world_, kWorldCfm);
  dWorldSetERP(world_, kWorldErp);
  dWorldSetAutoDisableFlag(world_, 0);
  add_bodies(params);
  add_hinges();
}

// The zero posture with the pelvis at the origin: all link frames are parallel to
// the world, so anchors and axes enter the hinges without a rounding of rotations.
void Engine::add_bodies(const hoap2_plant_params_t &params) {
  const double zero_rad[HOAP2_JOINTS] = {};
  LinkPose pose[HOAP2_LINKS];
  link_poses_in_pelvis(zero_rad, pose);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const hoap2_link_data_t &data = HOAP2_LINK[link];
    const double *const inertia = data.inertia_C_kgm2;
    body_[link] = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, data.mass_kg, 0.0, 0.0, 0.0, inertia[0], inertia[1], inertia[2], inertia[3],
                       inertia[4], inertia[5]);
    dBodySetMass(body_[link], &mass);
    dBodySetGyroscopicMode(body_[link], 0);  // gyroscopic_torque_W_Nm() instead
    dBodySetLinearDamping(body_[link], 0.0);
    dBodySetAngularDamping(body_[link], 0.0);
    const Vec3 com_W_m = pose[link].origin + link_com_L_m(params, link);
    dBodySetPosition(body_[link], com_W_m.x, com_W_m.y, com_W_m.z);
  }
}

void Engine::add_hinges() {
  const double zero_rad[HOAP2_JOINTS] = {};
  LinkPose pose[HOAP2_LINKS];
  link_poses_in_pelvis(zero_rad, pose);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const hoap2_joint_data_t &data = HOAP2_JOINT[j];
    const Vec3 anchor_W_m = pose[data.child_link].origin;
    const Vec3 axis_W = unit_axis(data.axis);
    hinge_[j] = dJointCreateHinge(world_, nullptr);
    dJointAttach(hinge_[j], body_[data.child_link], body_[data.parent_link]);
    dJointSetHingeAnchor(hinge_[j], anchor_W_m.x, anchor_W_m.y, anchor_W_m.z);
    dJointSetHingeAxis(hinge_[j], axis_W.x, axis_W.y, axis_W.z);
    dJointSetHingeParam(hinge_[j], dParamFMax, dInfinity);  // unbounded row; limits are in the drive's law
  }
}

void Engine::write(const State &state) {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &s = state.body[link];
    const dQuaternion quat_W = {s.quat_W[0], s.quat_W[1], s.quat_W[2], s.quat_W[3]};
    dBodySetPosition(body_[link], s.com_pos_W_m[0], s.com_pos_W_m[1], s.com_pos_W_m[2]);
    dBodySetQuaternion(body_[link], quat_W);
    dBodySetLinearVel(body_[link], s.com_vel_W_m_s[0], s.com_vel_W_m_s[1], s.com_vel_W_m_s[2]);
    dBodySetAngularVel(body_[link], s.omega_W_rad_s[0], s.omega_W_rad_s[1], s.omega_W_rad_s[2]);
    dBodySetForce(body_[link], 0.0, 0.0, 0.0);
    const Vec3 torque_W_Nm = gyroscopic_torque_W_Nm(s, link);
    dBodySetTorque(body_[link], torque_W_Nm.x, torque_W_Nm.y, torque_W_Nm.z);
  }
}

void Engine::add_force(int link, const double force_W_N[3], const double point_W_m[3]) {
  dBodyAddForceAtPos(body_[link], force_W_N[0], force_W_N[1], force_W_N[2], point_W_m[0], point_W_m[1],
                     point_W_m[2]);
}

// ODE's row reads J v+ = vel - cfm lambda with lambda the torque on the child link
// (its cfm is divided by h inside, as v+ = v + h M^-1 (f + J^T lambda)).
void Engine::set_motor(int joint, const MotorRow &row) {
  dJointSetHingeParam(hinge_[joint], dParamCFM, 1.0 / row.stiffness_Nms_rad);
  dJointSetHingeParam(hinge_[joint], dParamVel, row.target_rad_s);
}

void Engine::set_contacts(const ContactList &contacts, const hoap2_plant_params_t &params) {
  dJointGroupEmpty(contact_group_);
  for (int i = 0; i < contacts.count; ++i) {
    const dContact contact = contact_of(contacts.at[i], params);
    const dJointID joint = dJointCreateContact(world_, contact_group_, &contact);
    dJointAttach(joint, body_[contacts.at[i].link], nullptr);
    feedback_[i] = dJointFeedback{};
    dJointSetFeedback(joint, &feedback_[i]);
  }
}

void Engine::step() { dWorldStep(world_, kTick_s); }

void Engine::read(const State &before, State *state) const {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    BodyState &s = state->body[link];
    const dReal *const pos = dBodyGetPosition(body_[link]);
    const dReal *const quat_W = dBodyGetQuaternion(body_[link]);
    const dReal *const vel = dBodyGetLinearVel(body_[link]);
    const dReal *const omega = dBodyGetAngularVel(body_[link]);
    for (int i = 0; i < 3; ++i) {
      s.com_pos_W_m[i] = pos[i];
      s.com_vel_W_m_s[i] = vel[i];
      s.omega_before_W_rad_s[i] = before.body[link].omega_W_rad_s[i];
      s.omega_W_rad_s[i] = omega[i];
    }
    for (int i = 0; i < 4; ++i) s.quat_W[i] = quat_W[i];
  }
}

void Engine::row_rates(const double axis_W[HOAP2_JOINTS][3], double rate_rad_s[HOAP2_JOINTS]) const {
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const dReal *const child = dBodyGetAngularVel(body_[HOAP2_JOINT[j].child_link]);
    const dReal *const parent = dBodyGetAngularVel(body_[HOAP2_JOINT[j].parent_link]);
    rate_rad_s[j] = 0.0;
    for (int i = 0; i < 3; ++i) rate_rad_s[j] += axis_W[j][i] * (child[i] - parent[i]);
  }
}

void Engine::contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const {
  for (int k = 0; k < 3; ++k) {
    force_W_N[k] = feedback_[i].f1[k];
    moment_com_W_Nm[k] = feedback_[i].t1[k];
  }
}

}  // namespace hoap2_sim
