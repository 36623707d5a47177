// All contact points of a tick on the robot's tree, solved to convergence.
#ifndef HOAP2_SIM_SOLVER_CONTACT_PROBLEM_H
#define HOAP2_SIM_SOLVER_CONTACT_PROBLEM_H

#include "solver/body_tree.h"
#include "solver/bound_iteration.h"
#include "solver/contact_law.h"
#include "solver/solver.h"

namespace hoap2_sim {

// How hard a tick was; for tests and profiles.
struct ContactEffort {
  int sweeps = 0;              // of the tree
  int bound_updates = 0;       // of the friction bounds
  double force_error_N = 0.0;  // largest difference between law and answer that is left
};

class ContactProblem {
 public:
  // Takes the contact points of a tick, and which links they touch.
  void begin(const TickProblem &problem);
  const bool *touched() const { return touched_; }

  // Velocities of the tree's touched links such that each contact's force is that of its
  // law at its velocity after the tick.
  void solve(BodyTree *tree);

  Vector3 force_W_N(int i) const { return row_[i].axes_W * row_[i].force_N; }
  const ContactEffort &effort() const { return effort_; }

 private:
  struct Row {
    int link;
    Vector3 point_W_m, arm_W_m;
    Matrix3 axes_W;  // columns: normal, along, across
    ContactLaw law;
    double friction;
    Vector3 guess_m_s;       // velocity before the tick
    Vector3 velocity_m_s;    // of the present iterate
    Vector3 force_N;         // that made it, in the tree's linear answer
    Matrix3 stiffness_Ns_m;  // of the law's tangent there
    Vector3 next_velocity_m_s, next_force_N;
  };

  void guess_bounds();
  void set_bounds(double friction_scale);
  static bool binds(const Row &row);
  double bound_error_N() const;
  double force_error_N() const;
  void sweep(BodyTree *tree);
  double slope_at(double step) const;
  double line_search() const;
  void accept(double step);
  bool converge(BodyTree *tree);
  void solve_cone(BodyTree *tree);
  void solve_ode_pyramid(BodyTree *tree);

  int count_ = 0;
  bool pyramid_ = false;
  bool touched_[HOAP2_LINKS] = {};
  ContactEffort effort_;
  BoundIteration bounds_;
  Row row_[kMaxContacts];
};

}  // namespace hoap2_sim
#endif
