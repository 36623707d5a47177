// The plant's C interface and its tick.
#include "hoap2_plant/plant.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "checks.h"
#include "drive/drive.h"
#include "ode_runtime.h"
#include "push/push.h"
#include "robot/kinematics.h"
#include "sensors/sensors.h"
#include "soil/soil.h"
#include "solver/articulated_solver.h"
#include "solver/ode_solver.h"
#include "terrain/contact.h"
#include "truth/foot_wrench.h"
#include "truth/truth.h"

namespace hoap2_sim {

// Torque limits make a tick's equations piecewise linear; it is solved again with
// other rows at their limits until they agree with its result, at most this often.
constexpr int kMaxSolves = 8;

class Plant {
 public:
  int init(const hoap2_plant_params_t &params);
  int step(const hoap2_plant_inputs_t &inputs);
  std::size_t state_size() const { return sizeof(State) + (on_soil() ? soil_.state_bytes() : 0); }
  void save(void *bytes) const;
  int restore(const void *bytes, std::size_t size);
  const State &state() const { return state_; }
  const char *error() const { return error_; }

 private:
  int fail(const std::string &text);
  bool on_soil() const { return soil_built_ && state_.params.ground == HOAP2_GROUND_SOIL; }
  int build_world();
  int build_soil();
  void give_up_world();
  std::string restore_soil(const void *bytes, std::size_t size);
  void apply_push(int link, const double force_W_N[3], const double point_L_m[3], LinkLoad load[HOAP2_LINKS],
                  State *next) const;
  void apply_pushes(const hoap2_plant_inputs_t &inputs, LinkLoad load[HOAP2_LINKS], State *next) const;
  int solve(const hoap2_plant_inputs_t &inputs, State *next);
  bool correct_saturation(const double rate_rad_s[HOAP2_JOINTS], bool may_release);

  State state_ = {};
  Mat3 axes_W_[HOAP2_LINKS];       // of state_
  Mat3 next_axes_W_[HOAP2_LINKS];  // of the tick being made
  std::unique_ptr<TickSolver> solver_;
  Ground ground_;
  ContactList contacts_;
  Soil soil_;
  bool soil_built_ = false;
  SoilLoad soil_load_[HOAP2_LINKS];
  Drive drive_[HOAP2_JOINTS];
  char error_[256] = "";
};

int Plant::fail(const std::string &text) {
  std::strncpy(error_, text.c_str(), sizeof error_ - 1);
  error_[sizeof error_ - 1] = '\0';
  return 1;
}

int Plant::build_world() {
  try {
    if (state_.params.solver == HOAP2_SOLVER_ODE) {
      solver_ = std::make_unique<OdeSolver>(state_.params);
    } else {
      solver_ = std::make_unique<ArticulatedSolver>(state_.params);
    }
    ground_.build(state_.params);
  } catch (const OdeFailure &failure) {
    give_up_world();
    return fail(failure.what());
  }
  return 0;
}

int Plant::build_soil() {
  soil_built_ = false;
  if (state_.params.ground != HOAP2_GROUND_SOIL) return 0;
  const std::string fault = soil_.build(state_.params);
  if (!fault.empty()) {
    solver_.reset();
    return fail(fault);
  }
  soil_built_ = true;
  soil_.start();
  return 0;
}

void Plant::give_up_world() {
  if (solver_ != nullptr) solver_->abandon();
  solver_.reset();
}

int Plant::init(const hoap2_plant_params_t &params) {
  const std::string fault = fault_of_params(params);
  if (!fault.empty()) return fail(fault);
  std::memset(static_cast<void *>(&state_), 0, sizeof state_);
  state_.magic = kStateMagic;
  state_.version = kStateVersion;
  state_.size = sizeof(State);
  // Up to the end of the last member: padding stays zero, equal states have equal bytes.
  constexpr std::size_t kUsed = offsetof(hoap2_plant_params_t, push_link) + sizeof params.push_link;
  std::memcpy(&state_.params, &params, kUsed);
  place_robot(&state_);
  all_link_axes_W(state_, axes_W_);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const double q_rad = joint_angle_rad(state_, j), rate_rad_s = joint_rate_rad_s(state_, axes_W_, j);
    state_.drive[j] = {q_rad, rate_rad_s, q_rad, rate_rad_s, rate_rad_s, 0.0};
  }
  for (int k = 0; k < 2; ++k) {  // before the first contact: midway between the soles
    state_.cop_W_m[k] = 0.5 * (sole_point_W_m(state_, 0)[k] + sole_point_W_m(state_, 1)[k]);
  }
  sensors_start(&state_);
  error_[0] = '\0';
  if (build_world() != 0 || build_soil() != 0) return 1;
  state_.size = static_cast<std::uint32_t>(state_size());
  return 0;
}

void Plant::save(void *bytes) const {
  std::memcpy(bytes, &state_, sizeof state_);
  if (on_soil()) soil_.save(static_cast<char *>(bytes) + sizeof state_);
}

int Plant::restore(const void *bytes, std::size_t size) {
  if (size < sizeof(State)) return fail("the block is not a state of this plant: too short");
  State saved;
  std::memcpy(&saved, bytes, sizeof saved);
  if (saved.magic != kStateMagic || saved.version != kStateVersion || saved.size != size) {
    return fail("the block is not a plant state of this version");
  }
  // The block may come from a file: nothing of it is believed that could break the engine.
  const std::string fault = fault_of_params(saved.params) + fault_of_bodies(saved) + fault_of_memory(saved);
  if (!fault.empty()) return fail("the saved state is damaged: " + fault);
  const bool same_world =
      solver_ != nullptr && std::memcmp(&saved.params, &state_.params, sizeof saved.params) == 0;
  std::vector<char> kept(state_size());
  save(kept.data());
  const bool was_built = solver_ != nullptr;
  state_ = saved;
  const char *const soil = static_cast<const char *>(bytes) + sizeof saved;
  if (!same_world && (build_world() != 0 || build_soil() != 0)) return 1;
  const std::string bad_soil = restore_soil(soil, size - sizeof saved);
  if (!bad_soil.empty()) {
    if (was_built) restore(kept.data(), kept.size());
    return fail("the saved state is damaged: " + bad_soil);
  }
  all_link_axes_W(state_, axes_W_);
  error_[0] = '\0';
  return 0;
}

std::string Plant::restore_soil(const void *bytes, std::size_t size) {
  if (size != state_size() - sizeof(State)) return "the soil has another size";
  return on_soil() ? soil_.restore(bytes) : "";
}

void Plant::apply_push(int link, const double force_W_N[3], const double point_L_m[3],
                       LinkLoad load[HOAP2_LINKS], State *next) const {
  const Vec3 force = vec(force_W_N);
  if (dot(force, force) == 0.0) return;
  const Vec3 arm_W_m = point_W_m(state_, link, vec(point_L_m)) - vec(state_.body[link].com_pos_W_m);
  load[link].force_W_N = load[link].force_W_N + force;
  load[link].torque_com_W_Nm = load[link].torque_com_W_Nm + cross(arm_W_m, force);
  put(vec(next->push_force_W_N) + force, next->push_force_W_N);
}

void Plant::apply_pushes(const hoap2_plant_inputs_t &inputs, LinkLoad load[HOAP2_LINKS], State *next) const {
  put(Vec3{}, next->push_force_W_N);
  for (int i = 0; i < kPushes; ++i) {
    double force_W_N[3];
    push_force(state_.params, state_.tick, i, force_W_N);
    apply_push(state_.params.push_link[i], force_W_N, state_.params.push_point_L_m[i], load, next);
  }
  apply_push(inputs.push_now_link, inputs.push_now_force_W_N, inputs.push_now_point_L_m, load, next);
}

// Puts rows at their torque limits, or (first time) releases them, as the rates ask
// for. True when something changed.
bool Plant::correct_saturation(const double rate_rad_s[HOAP2_JOINTS], bool may_release) {
  bool changed = false;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const int wanted = drive_[j].wanted_saturation(rate_rad_s[j]);
    if (wanted == drive_[j].saturation()) continue;
    if (!may_release && drive_[j].saturation() != 0) continue;
    drive_[j].saturate(wanted);
    changed = true;
  }
  return changed;
}

// Non-zero: the soil cannot carry on (error() says why).
int Plant::solve(const hoap2_plant_inputs_t &inputs, State *next) {
  LinkLoad load[HOAP2_LINKS];
  MotorRow row[HOAP2_JOINTS];
  double rate_rad_s[HOAP2_JOINTS];
  for (int j = 0; j < HOAP2_JOINTS; ++j) drive_[j].begin(state_, inputs, j);
  ground_.find_contacts(state_, axes_W_, &contacts_);
  apply_pushes(inputs, load, next);
  if (on_soil()) {
    const std::string fault = soil_.find_loads(state_, axes_W_, soil_load_);
    if (!fault.empty()) return fail(fault);
  }
  solver_->begin({&state_, axes_W_, load, &contacts_, on_soil() ? soil_load_ : nullptr});
  for (int solves = 1; solves <= kMaxSolves; ++solves) {
    for (int j = 0; j < HOAP2_JOINTS; ++j) row[j] = drive_[j].row();
    solver_->solve(row, rate_rad_s);
    if (solves == kMaxSolves || !correct_saturation(rate_rad_s, solves == 1)) break;
  }
  solver_->finish(next);
  all_link_axes_W(*next, next_axes_W_);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    next->drive[j] =
        drive_[j].finish(joint_angle_rad(*next, j), joint_rate_rad_s(*next, next_axes_W_, j), rate_rad_s[j]);
  }
  return 0;
}

int Plant::step(const hoap2_plant_inputs_t &inputs) {
  if (solver_ == nullptr) return fail("step before init");
  const std::string fault = fault_of_inputs(inputs);
  if (!fault.empty()) return fail(fault);
  use_ode_on_this_thread();
  State next = state_;
  try {
    if (solve(inputs, &next) != 0) return 1;
  } catch (const OdeFailure &failure) {
    give_up_world();
    build_world();
    return fail(failure.what());
  }
  const std::string diverged = fault_of_bodies(next);
  if (!diverged.empty()) return fail(diverged);
  gather_foot_wrenches(state_, contacts_, *solver_, on_soil() ? soil_load_ : nullptr, &next);
  if (on_soil()) {
    soil_.commit(next, next_axes_W_);
    for (int foot = 0; foot < 2; ++foot) next.sinkage_m[foot] = soil_.mean_sinkage_m(foot);
  }
  update_cop(&next);
  sensors_measure(&next);
  ++next.tick;
  state_ = next;
  std::copy(next_axes_W_, next_axes_W_ + HOAP2_LINKS, axes_W_);
  error_[0] = '\0';
  return 0;
}

}  // namespace hoap2_sim

struct hoap2_plant {
  hoap2_sim::Plant plant;
};

#define HOAP2_EXPORT __attribute__((visibility("default")))

extern "C" {

HOAP2_EXPORT hoap2_plant_t *hoap2_plant_create(void) {
  hoap2_sim::use_ode_on_this_thread();
  return new (std::nothrow) hoap2_plant;
}

HOAP2_EXPORT void hoap2_plant_destroy(hoap2_plant_t *plant) {
  hoap2_sim::use_ode_on_this_thread();
  delete plant;
}

HOAP2_EXPORT int hoap2_plant_init(hoap2_plant_t *plant, const hoap2_plant_params_t *params) {
  hoap2_sim::use_ode_on_this_thread();
  return plant->plant.init(*params);
}

HOAP2_EXPORT int hoap2_plant_step(hoap2_plant_t *plant, const hoap2_plant_inputs_t *inputs) {
  return plant->plant.step(*inputs);
}

HOAP2_EXPORT void hoap2_plant_get_outputs(const hoap2_plant_t *plant, hoap2_plant_outputs_t *outputs) {
  hoap2_sim::fill_outputs(plant->plant.state(), outputs);
}

HOAP2_EXPORT size_t hoap2_plant_state_size(const hoap2_plant_t *plant) { return plant->plant.state_size(); }

HOAP2_EXPORT void hoap2_plant_get_state(const hoap2_plant_t *plant, void *state) { plant->plant.save(state); }

HOAP2_EXPORT int hoap2_plant_set_state(hoap2_plant_t *plant, const void *state, size_t size) {
  hoap2_sim::use_ode_on_this_thread();
  return plant->plant.restore(state, size);
}

HOAP2_EXPORT const char *hoap2_plant_error(const hoap2_plant_t *plant) { return plant->plant.error(); }

}  // extern "C"
