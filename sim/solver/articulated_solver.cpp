#include "solver/articulated_solver.h"

namespace hoap2_sim {

ArticulatedSolver::ArticulatedSolver(const hoap2_plant_params_t &params) {
  bodies_.build(params);
  bodies_.set_free();
  tree_.build(params);
}

void ArticulatedSolver::abandon() { bodies_.abandon(); }

void ArticulatedSolver::begin(const TickProblem &problem) {
  problem_ = problem;
  contacts_.begin(problem);
  tree_.begin(problem, contacts_.touched());
}

void ArticulatedSolver::solve(const MotorRow row[HOAP2_JOINTS], double rate_rad_s[HOAP2_JOINTS]) {
  tree_.set_motors(row);
  contacts_.solve(&tree_);
  tree_.solve_rest();
  for (int j = 0; j < HOAP2_JOINTS; ++j) rate_rad_s[j] = tree_.rate_rad_s(HOAP2_JOINT[j].child_link);
}

void ArticulatedSolver::finish(State *next) {
  Vec3 vel_W_m_s[HOAP2_LINKS], omega_W_rad_s[HOAP2_LINKS];
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    vel_W_m_s[link] = plain(tree_.com_velocity_W_m_s(link));
    omega_W_rad_s[link] = plain(tree_.motion(link).angular);
  }
  bodies_.write(*problem_.state, vel_W_m_s, omega_W_rad_s);
  bodies_.step();
  bodies_.read(*problem_.state, next);
}

void ArticulatedSolver::contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const {
  const Contact &at = problem_.contacts->at[i];
  const Vec3 force = plain(contacts_.force_W_N(i));
  put(force, force_W_N);
  put(cross(vec(at.point_W_m) - vec(problem_.state->body[at.link].com_pos_W_m), force), moment_com_W_Nm);
}

}  // namespace hoap2_sim
