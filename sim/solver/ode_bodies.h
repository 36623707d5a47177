// The 26 bodies of the robot in an ODE world of their own: poses, velocities, and one
// step of ODE's integration. Nothing is kept between ticks.
#ifndef HOAP2_SIM_SOLVER_ODE_BODIES_H
#define HOAP2_SIM_SOLVER_ODE_BODIES_H

#include <ode/ode.h>

#include "geometry.h"
#include "plant_state.h"

namespace hoap2_sim {

class OdeBodies {
 public:
  OdeBodies() = default;
  ~OdeBodies();
  OdeBodies(const OdeBodies &) = delete;
  OdeBodies &operator=(const OdeBodies &) = delete;

  // Bodies in the zero posture with the pelvis at the origin: all link frames are parallel to
  // the world, so anchors and axes enter the hinges without a rounding of rotations.
  void build(const hoap2_plant_params_t &params);
  // Lets dWorldStep integrate the bodies without forces, as one island.
  void set_free();
  void abandon();

  dWorldID world() const { return world_; }
  dBodyID body(int link) const { return body_[link]; }

  // Poses of the state with the given velocities; forces are cleared.
  void write(const State &state, const Vec3 vel_W_m_s[HOAP2_LINKS], const Vec3 omega_W_rad_s[HOAP2_LINKS]);
  void step();
  // Poses and velocities after step(), from the state before it.
  void read(const State &before, State *next) const;

 private:
  dWorldID world_ = nullptr;
  // The job list of dWorldStep. ODE's default is one for all worlds of the process, without
  // a lock: two instances stepped at the same time would take each other's jobs.
  dThreadingImplementationID jobs_ = nullptr;
  dBodyID body_[HOAP2_LINKS] = {};
};

// Poses of the links in the zero posture, the pelvis at the origin.
void zero_posture_origins(Vec3 origin_m[HOAP2_LINKS]);

}  // namespace hoap2_sim
#endif
