#include "hoap2_render/soil_replay.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "robot/kinematics.h"
#include "soil/soil.h"

struct hoap2_soil_replay {
  hoap2_plant_params_t params;
  hoap2_sim::Soil soil;
  std::vector<float> untouched_m;
  std::unique_ptr<hoap2_sim::State> state, next;  // too large for a stack frame
  bool has_start = false, has_ended = false;
  std::string error;
};

namespace {

using namespace hoap2_sim;

thread_local std::string g_create_error;  // there is no replay yet that could hold it

// Links where a row of the log has them.
void pose_bodies(const hoap2_plant_params_t &params, const double base_pos_W_m[3],
                 const double base_quat_W[4], const double q_rad[HOAP2_JOINTS], State *state) {
  LinkPose pose[HOAP2_LINKS];
  link_poses_in_pelvis(q_rad, pose);
  const Quat base = normalised(quat(base_quat_W));
  const Mat3 base_axes_W = matrix(base);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const Vec3 com_P_m = pose[link].origin + matrix(pose[link].quat) * link_com_L_m(params, link);
    const Quat turned = normalised(base * pose[link].quat);
    BodyState &body = state->body[link];
    put(vec(base_pos_W_m) + base_axes_W * com_P_m, body.com_pos_W_m);
    const double values[4] = {turned.w, turned.x, turned.y, turned.z};
    std::copy(values, values + 4, body.quat_W);
  }
}

// The velocities that led from one row to the next: the plant moves poses by the velocities after the tick.
void find_velocities(const State &before, State *now) {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &from = before.body[link];
    BodyState &to = now->body[link];
    put((1.0 / kTick_s) * (vec(to.com_pos_W_m) - vec(from.com_pos_W_m)), to.com_vel_W_m_s);
    const Quat turn = quat(to.quat_W) * conj(quat(from.quat_W));
    const Vec3 axis = {turn.x, turn.y, turn.z};
    const double sine = norm(axis), angle_rad = 2.0 * std::atan2(sine, std::fabs(turn.w));
    const double rate_1_s = (turn.w < 0.0 ? -1.0 : 1.0) * (sine > 0.0 ? angle_rad / sine : 2.0) / kTick_s;
    put(rate_1_s * axis, to.omega_W_rad_s);
  }
}

void restart(hoap2_soil_replay_t &replay) {
  replay.soil.start();
  replay.has_start = replay.has_ended = false;
  replay.error.clear();
}

void move_to_next(hoap2_soil_replay_t &replay) {
  Mat3 axes_W[HOAP2_LINKS];
  SoilLoad load[HOAP2_LINKS];
  all_link_axes_W(*replay.state, axes_W);
  replay.error = replay.soil.find_loads(*replay.state, axes_W, load);
  replay.has_ended = !replay.error.empty();
  if (replay.has_ended) return;
  all_link_axes_W(*replay.next, axes_W);
  replay.soil.commit(*replay.next, axes_W);
  std::swap(replay.state, replay.next);
}

bool is_finite(const double *values, int count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

}  // namespace

extern "C" {

hoap2_soil_replay_t *hoap2_soil_replay_create(const hoap2_plant_params_t *params) {
  g_create_error.clear();
  try {
    auto replay = std::make_unique<hoap2_soil_replay>();
    replay->params = *params;
    const std::string fault = replay->soil.build(*params);
    if (!fault.empty()) throw std::runtime_error(fault);
    replay->state = std::make_unique<State>();
    replay->next = std::make_unique<State>();
    replay->state->params = replay->next->params = *params;
    restart(*replay);
    const HeightField &field = replay->soil.field();
    for (std::size_t i = 0; i < field.size(); ++i) {
      replay->untouched_m.push_back(static_cast<float>(field.cell(i).surface_m()));
    }
    return replay.release();
  } catch (const std::exception &problem) {
    g_create_error = problem.what();
    return nullptr;
  }
}

void hoap2_soil_replay_destroy(hoap2_soil_replay_t *replay) { delete replay; }

void hoap2_soil_replay_restart(hoap2_soil_replay_t *replay) { restart(*replay); }

int hoap2_soil_replay_advance(hoap2_soil_replay_t *replay, int64_t count, const double *base_pos_W_m,
                              const double *base_quat_W, const double *q_rad) {
  for (int64_t row = 0; row < count && !replay->has_ended; ++row) {
    const double *const pos_W_m = base_pos_W_m + 3 * row, *const quat_W = base_quat_W + 4 * row;
    const double *const angles_rad = q_rad + HOAP2_JOINTS * row;
    if (!is_finite(pos_W_m, 3) || !is_finite(quat_W, 4) || !is_finite(angles_rad, HOAP2_JOINTS)) {
      replay->error = "the motion is not finite";
      replay->has_ended = true;
      break;
    }
    pose_bodies(replay->params, pos_W_m, quat_W, angles_rad, replay->next.get());
    if (replay->has_start) {
      find_velocities(*replay->state, replay->next.get());
      move_to_next(*replay);
    } else {
      std::swap(replay->state, replay->next);
      find_velocities(*replay->state, replay->state.get());
      replay->has_start = true;
    }
  }
  return replay->has_ended ? 1 : 0;
}

void hoap2_soil_replay_grid(const hoap2_soil_replay_t *replay, hoap2_soil_grid_t *grid) {
  const HeightField &field = replay->soil.field();
  const PoolFrame pool = pool_frame(replay->params);
  put(pool.origin_W_m, grid->origin_W_m);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) grid->axes_W[3 * row + column] = pool.axes_W.column(column)[row];
  }
  grid->low_x_m = field.low_x_m();
  grid->low_y_m = field.low_y_m();
  grid->cell_m = field.cell_m();
  grid->depth_m = field.depth_m();
  grid->nx = field.nx();
  grid->ny = field.ny();
}

void hoap2_soil_replay_surface(const hoap2_soil_replay_t *replay, float *height_m, float *change_m) {
  const HeightField &field = replay->soil.field();
  for (std::size_t i = 0; i < field.size(); ++i) {
    height_m[i] = static_cast<float>(field.cell(i).surface_m());
    change_m[i] = height_m[i] - replay->untouched_m[i];
  }
}

const char *hoap2_soil_replay_error(const hoap2_soil_replay_t *replay) {
  return replay != nullptr ? replay->error.c_str() : g_create_error.c_str();
}

size_t hoap2_soil_replay_params_size(void) { return sizeof(hoap2_plant_params_t); }

size_t hoap2_soil_replay_grid_size(void) { return sizeof(hoap2_soil_grid_t); }

}  // extern "C"
