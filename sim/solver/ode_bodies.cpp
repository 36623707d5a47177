#include "solver/ode_bodies.h"

#include "robot/kinematics.h"

namespace hoap2_sim {

void zero_posture_origins(Vec3 origin_m[HOAP2_LINKS]) {
  const double zero_rad[HOAP2_JOINTS] = {};
  LinkPose pose[HOAP2_LINKS];
  link_poses_in_pelvis(zero_rad, pose);
  for (int link = 0; link < HOAP2_LINKS; ++link) origin_m[link] = pose[link].origin;
}

OdeBodies::~OdeBodies() {
  if (world_ == nullptr) return;
  dWorldDestroy(world_);
  dThreadingFreeImplementation(jobs_);
}

void OdeBodies::abandon() {
  world_ = nullptr;
  jobs_ = nullptr;
}

void OdeBodies::build(const hoap2_plant_params_t &params) {
  world_ = dWorldCreate();
  jobs_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(jobs_), jobs_);
  dWorldSetAutoDisableFlag(world_, 0);
  Vec3 origin_m[HOAP2_LINKS];
  zero_posture_origins(origin_m);
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
    const Vec3 com_W_m = origin_m[link] + link_com_L_m(params, link);
    dBodySetPosition(body_[link], com_W_m.x, com_W_m.y, com_W_m.z);
  }
}

// dWorldStep handles each body without joints as an island with its own overhead. Null
// joints have no rows: they only make one island of all.
void OdeBodies::set_free() {
  dWorldSetGravity(world_, 0.0, 0.0, 0.0);
  for (int link = 1; link < HOAP2_LINKS; ++link) {
    dJointAttach(dJointCreateNull(world_, nullptr), body_[link - 1], body_[link]);
  }
}

void OdeBodies::write(const State &state, const Vec3 vel_W_m_s[HOAP2_LINKS],
                      const Vec3 omega_W_rad_s[HOAP2_LINKS]) {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &s = state.body[link];
    const dQuaternion quat_W = {s.quat_W[0], s.quat_W[1], s.quat_W[2], s.quat_W[3]};
    const Vec3 &vel = vel_W_m_s[link], &omega = omega_W_rad_s[link];
    dBodySetPosition(body_[link], s.com_pos_W_m[0], s.com_pos_W_m[1], s.com_pos_W_m[2]);
    dBodySetQuaternion(body_[link], quat_W);
    dBodySetLinearVel(body_[link], vel.x, vel.y, vel.z);
    dBodySetAngularVel(body_[link], omega.x, omega.y, omega.z);
    dBodySetForce(body_[link], 0.0, 0.0, 0.0);
    dBodySetTorque(body_[link], 0.0, 0.0, 0.0);
  }
}

void OdeBodies::step() { dWorldStep(world_, kTick_s); }

void OdeBodies::read(const State &before, State *next) const {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    BodyState &s = next->body[link];
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

}  // namespace hoap2_sim
