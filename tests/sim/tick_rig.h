// One tick from a given state by either solver, with a look at what the plant keeps to
// itself: contact points and their forces, motor rows, how hard the tick was. It repeats
// Plant::solve() without pushes; test_solver_tick.cpp holds the two together.
#ifndef HOAP2_TESTS_SIM_TICK_RIG_H
#define HOAP2_TESTS_SIM_TICK_RIG_H

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "drive/drive.h"
#include "ode_runtime.h"
#include "rig.h"
#include "solver/articulated_solver.h"
#include "solver/ode_solver.h"
#include "terrain/contact.h"

namespace hoap2_sim {

// The same instant under another solver or friction law.
inline State with(State state, int solver, int friction_law) {
  state.params.solver = solver;
  state.params.friction_law = friction_law;
  return state;
}

class TickRig {
 public:
  explicit TickRig(const hoap2_plant_params_t &params) {
    use_ode_on_this_thread();
    ground_.build(params);
    if (params.solver == HOAP2_SOLVER_ODE) {
      solver_ = std::make_unique<OdeSolver>(params);
    } else {
      auto articulated = std::make_unique<ArticulatedSolver>(params);
      articulated_ = articulated.get();
      solver_ = std::move(articulated);
    }
  }

  // From `state`, whose parameters must be those of the constructor.
  void run(const State &state, const hoap2_plant_inputs_t &inputs) {
    before = next = state;
    hardest = ContactEffort{};
    solves = 0;
    all_link_axes_W(before, axes_W);
    for (int j = 0; j < HOAP2_JOINTS; ++j) drive_[j].begin(before, inputs, j);
    ground_.find_contacts(before, axes_W, &contacts);
    for (LinkLoad &l : load) l = LinkLoad{};
    try {
      solve_tick();
    } catch (const OdeFailure &failure) {
      solver_->abandon();
      throw std::runtime_error(std::string("the engine gave up: ") + failure.what());
    }
    Mat3 next_axes_W[HOAP2_LINKS];
    all_link_axes_W(next, next_axes_W);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      next.drive[j] =
          drive_[j].finish(joint_angle_rad(next, j), joint_rate_rad_s(next, next_axes_W, j), rate_rad_s[j]);
    }
    ++next.tick;
  }
  // Goes on from the last tick's result.
  void run_on(const hoap2_plant_inputs_t &inputs) {
    const State state = next;
    run(state, inputs);
  }

  Vec3 force_W_N(int contact) const {
    double force[3], moment[3];
    solver_->contact_load(contact, force, moment);
    return vec(force);
  }
  Vec3 moment_com_W_Nm(int contact) const {
    double force[3], moment[3];
    solver_->contact_load(contact, force, moment);
    return vec(moment);
  }
  Vec3 total_force_W_N() const {
    Vec3 sum;
    for (int i = 0; i < contacts.count; ++i) sum = sum + force_W_N(i);
    return sum;
  }
  // Contact force and moment about the CoM on one link.
  void link_load(int link, Vec3 *force, Vec3 *moment) const {
    *force = *moment = Vec3{};
    for (int i = 0; i < contacts.count; ++i) {
      if (contacts.at[i].link != link) continue;
      *force = *force + force_W_N(i);
      *moment = *moment + moment_com_W_Nm(i);
    }
  }
  // Velocity of a contact's point after the tick, the link as it was at its start.
  Vec3 velocity_W_m_s(int contact) const {
    const Contact &at = contacts.at[contact];
    const BodyState &after = next.body[at.link];
    return vec(after.com_vel_W_m_s) +
           cross(vec(after.omega_W_rad_s), vec(at.point_W_m) - vec(before.body[at.link].com_pos_W_m));
  }

  // Of the last tick.
  State before = {}, next = {};
  Mat3 axes_W[HOAP2_LINKS];
  LinkLoad load[HOAP2_LINKS];
  ContactList contacts;
  MotorRow row[HOAP2_JOINTS];
  double rate_rad_s[HOAP2_JOINTS];
  ContactEffort hardest;  // of its solves (articulated solver)
  int solves = 0;

 private:
  void solve_tick() {
    solver_->begin({&before, axes_W, load, &contacts});
    while (true) {
      for (int j = 0; j < HOAP2_JOINTS; ++j) row[j] = drive_[j].row();
      solver_->solve(row, rate_rad_s);
      ++solves;
      note_effort();
      if (solves == 8 || !correct_saturation()) break;
    }
    solver_->finish(&next);
  }
  void note_effort() {
    if (articulated_ == nullptr) return;
    const ContactEffort &effort = articulated_->effort();
    hardest.sweeps = std::max(hardest.sweeps, effort.sweeps);
    hardest.bound_updates = std::max(hardest.bound_updates, effort.bound_updates);
    hardest.force_error_N = std::fmax(hardest.force_error_N, effort.force_error_N);
  }
  bool correct_saturation() {
    bool changed = false;
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const int wanted = drive_[j].wanted_saturation(rate_rad_s[j]);
      if (wanted == drive_[j].saturation()) continue;
      if (solves > 1 && drive_[j].saturation() != 0) continue;
      drive_[j].saturate(wanted);
      changed = true;
    }
    return changed;
  }

  std::unique_ptr<TickSolver> solver_;
  const ArticulatedSolver *articulated_ = nullptr;
  Ground ground_;
  Drive drive_[HOAP2_JOINTS];
};

}  // namespace hoap2_sim
#endif
