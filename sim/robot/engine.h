// The robot in ODE: 26 bodies, 25 hinges with one motor row each, contact joints.
// The engine keeps nothing between ticks: write() sets every body from the state.
#ifndef HOAP2_SIM_ROBOT_ENGINE_H
#define HOAP2_SIM_ROBOT_ENGINE_H

#include <ode/ode.h>

#include "plant_state.h"
#include "terrain/contact.h"

namespace hoap2_sim {

// Row of a joint: torque on the link = stiffness_Nms_rad * (target_rad_s - rate after the tick).
struct MotorRow {
  double stiffness_Nms_rad;
  double target_rad_s;
};

class Engine {
 public:
  Engine() = default;
  ~Engine();
  Engine(const Engine &) = delete;
  Engine &operator=(const Engine &) = delete;

  // Builds the world for these parameters (masses); drops the old one.
  void build(const hoap2_plant_params_t &params);
  bool built() const { return world_ != nullptr; }
  // Forgets a world that an OdeFailure left half-way. Its memory is lost on purpose:
  // freeing it could run into the same failure.
  void abandon();

  // Poses, velocities and gyroscopic torques of all bodies; other forces are cleared.
  void write(const State &state);
  void add_force(int link, const double force_W_N[3], const double point_W_m[3]);
  void set_motor(int joint, const MotorRow &row);
  void set_contacts(const ContactList &contacts, const hoap2_plant_params_t &params);
  void step();
  // Poses and velocities after step(), from the state before it.
  void read(const State &before, State *state) const;
  // Rate of each joint after step(), along the axis that the step's motor row used.
  void row_rates(const double axis_W[HOAP2_JOINTS][3], double rate_rad_s[HOAP2_JOINTS]) const;
  // Force of contact i on its link, and moment about the link's CoM.
  void contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const;

 private:
  void destroy();
  void add_bodies(const hoap2_plant_params_t &params);
  void add_hinges();

  dWorldID world_ = nullptr;
  // The job list of dWorldStep. ODE's default is one for all worlds of the process, without
  // a lock: two instances stepped at the same time would take each other's jobs.
  dThreadingImplementationID jobs_ = nullptr;
  dJointGroupID contact_group_ = nullptr;
  dBodyID body_[HOAP2_LINKS] = {};
  dJointID hinge_[HOAP2_JOINTS] = {};
  dJointFeedback feedback_[kMaxContacts] = {};
};

}  // namespace hoap2_sim
#endif
