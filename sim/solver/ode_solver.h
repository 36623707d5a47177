// A tick by dWorldStep: hinges with one motor row each and contact joints, all rows solved
// by ODE's LCP. Slow, and the oracle of ArticulatedSolver.
#ifndef HOAP2_SIM_SOLVER_ODE_SOLVER_H
#define HOAP2_SIM_SOLVER_ODE_SOLVER_H

#include <ode/ode.h>

#include "solver/ode_bodies.h"
#include "solver/solver.h"

namespace hoap2_sim {

class OdeSolver : public TickSolver {
 public:
  explicit OdeSolver(const hoap2_plant_params_t &params);
  ~OdeSolver() override;
  void abandon() override;

  void begin(const TickProblem &problem) override;
  void solve(const MotorRow row[HOAP2_JOINTS], double rate_rad_s[HOAP2_JOINTS]) override;
  void finish(State *next) override;
  void contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const override;

 private:
  void add_hinges();
  void write_bodies();

  OdeBodies bodies_;
  TickProblem problem_;
  dJointGroupID contact_group_ = nullptr;
  dJointID hinge_[HOAP2_JOINTS] = {};
  dJointFeedback feedback_[kMaxContacts] = {};
};

}  // namespace hoap2_sim
#endif
