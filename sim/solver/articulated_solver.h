// A tick in O(links): the robot's tree with its contacts, ODE integrates the free bodies.
// docs/solver.md has the derivation.
#ifndef HOAP2_SIM_SOLVER_ARTICULATED_SOLVER_H
#define HOAP2_SIM_SOLVER_ARTICULATED_SOLVER_H

#include "solver/body_tree.h"
#include "solver/contact_problem.h"
#include "solver/ode_bodies.h"
#include "solver/solver.h"

namespace hoap2_sim {

class ArticulatedSolver : public TickSolver {
 public:
  explicit ArticulatedSolver(const hoap2_plant_params_t &params);
  void abandon() override;

  void begin(const TickProblem &problem) override;
  void solve(const MotorRow row[HOAP2_JOINTS], double rate_rad_s[HOAP2_JOINTS]) override;
  void finish(State *next) override;
  void contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const override;

  const ContactEffort &effort() const { return contacts_.effort(); }

 private:
  TickProblem problem_;
  OdeBodies bodies_;
  BodyTree tree_;
  ContactProblem contacts_;
};

}  // namespace hoap2_sim
#endif
