// The replayed soil against the plant's own, which a plant state holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hoap2_render/soil_replay.h"
#include "scenes.h"
#include "soil/soil.h"

namespace hoap2_sim {
namespace {

// The motion of a run as a log has it.
struct Motion {
  std::vector<double> pos_W_m, quat_W, q_rad;
  void add(const hoap2_plant_outputs_t &out) {
    pos_W_m.insert(pos_W_m.end(), out.true_base_pos_W_m, out.true_base_pos_W_m + 3);
    quat_W.insert(quat_W.end(), out.true_base_quat_W, out.true_base_quat_W + 4);
    q_rad.insert(q_rad.end(), out.true_q_rad, out.true_q_rad + HOAP2_JOINTS);
  }
  int64_t rows() const { return static_cast<int64_t>(pos_W_m.size() / 3); }
  int replay(hoap2_soil_replay_t *to, int64_t first, int64_t count) const {
    return hoap2_soil_replay_advance(to, count, pos_W_m.data() + 3 * first, quat_W.data() + 4 * first,
                                     q_rad.data() + HOAP2_JOINTS * first);
  }
};

// Far from the origin, turned, on a slope.
void place_anywhere(Rig *rig) {
  rig->params.ground = HOAP2_GROUND_SOIL;
  rig->params.start_pos_W_m[0] = 31.0;
  rig->params.start_pos_W_m[1] = -12.0;
  rig->params.start_yaw_W_rad = 0.7;
  rig->params.floor_tilt_rad[0] = 0.008;
  rig->params.floor_tilt_rad[1] = -0.006;
}

class Replay {
 public:
  explicit Replay(const hoap2_plant_params_t &params) : handle(hoap2_soil_replay_create(&params)) {
    EXPECT_NE(nullptr, handle) << hoap2_soil_replay_error(nullptr);
    hoap2_soil_replay_grid(handle, &grid);
    const auto cells = static_cast<size_t>(grid.nx) * static_cast<size_t>(grid.ny);
    height_m.resize(cells);
    change_m.resize(cells);
  }
  ~Replay() { hoap2_soil_replay_destroy(handle); }
  Replay(const Replay &) = delete;
  Replay &operator=(const Replay &) = delete;
  void read() { hoap2_soil_replay_surface(handle, height_m.data(), change_m.data()); }

  hoap2_soil_replay_t *handle;
  hoap2_soil_grid_t grid = {};
  std::vector<float> height_m, change_m;
};

// How far the replayed surface is from the plant's.
struct Difference {
  double worst_m = 0.0, mean_m = 0.0;  // mean over the cells that something changed
  double deepest_m = 0.0;
};

Difference compare(Rig *rig, Replay *replay) {
  std::vector<char> bytes(hoap2_plant_state_size(rig->plant()));
  hoap2_plant_get_state(rig->plant(), bytes.data());
  Soil soil;
  EXPECT_EQ("", soil.build(rig->params));
  std::vector<double> untouched_m;
  for (size_t i = 0; i < soil.field().size(); ++i) untouched_m.push_back(soil.field().cell(i).surface_m());
  EXPECT_EQ(sizeof(State) + soil.state_bytes(), bytes.size());
  EXPECT_EQ("", soil.restore(bytes.data() + sizeof(State)));
  replay->read();
  Difference found;
  int changed = 0;
  for (size_t i = 0; i < soil.field().size(); ++i) {
    const double plant_m = soil.field().cell(i).surface_m(), change_m = plant_m - untouched_m[i];
    const double off_m = std::fabs(plant_m - static_cast<double>(replay->height_m[i]));
    EXPECT_NEAR(change_m, static_cast<double>(replay->change_m[i]), off_m + 1e-8);
    found.worst_m = std::max(found.worst_m, off_m);
    found.deepest_m = std::max(found.deepest_m, -change_m);
    if (std::fabs(change_m) < 1e-7) continue;
    found.mean_m += off_m;
    ++changed;
  }
  found.mean_m /= std::max(1, changed);
  return found;
}

// Position references that shift the weight from foot to foot.
Motion shift_weight(Rig *rig, int ticks) {
  Motion motion;
  rig->start();
  motion.add(rig->out());
  for (int k = 0; k < ticks; ++k) {
    const double lean_rad = 0.06 * std::sin(0.008 * k);
    for (const int joint : {HOAP2_J_R_HIP_ROLL, HOAP2_J_L_HIP_ROLL}) {
      rig->inputs.q_ref_rad[joint] = rig->params.start_posture_rad[joint] + lean_rad;
    }
    rig->step();
    motion.add(rig->out());
  }
  return motion;
}

TEST(SoilReplay, StandingFeetLeaveWhatTheyLeaveInThePlant) {
  for (const int law : {HOAP2_SOIL_LAW_BEKKER, HOAP2_SOIL_LAW_RFT}) {
    Rig rig;
    place_anywhere(&rig);
    rig.params.start_height_m = 0.01;
    rig.params.soil_law = law;
    const Motion motion = shift_weight(&rig, 900);
    Replay replay(rig.params);
    ASSERT_EQ(0, motion.replay(replay.handle, 0, motion.rows()));
    const Difference found = compare(&rig, &replay);
    EXPECT_GT(found.deepest_m, 0.004);
    EXPECT_LT(found.worst_m, 20e-6);
    EXPECT_LT(found.mean_m, 2e-6);
  }
}

TEST(SoilReplay, AWalkLeavesTheSameTracks) {
  Rig rig;
  place_anywhere(&rig);
  rig.params.floor_tilt_rad[0] = rig.params.floor_tilt_rad[1] = 0.0;
  Walker walker(&rig);
  for (int i = 0; i < 2; ++i) walker.params.start_pos_W_m[i] = rig.params.start_pos_W_m[i];
  walker.params.start_yaw_W_rad = rig.params.start_yaw_W_rad;
  walker.start();
  Motion motion;
  motion.add(rig.out());
  for (int k = 0; k < 5000 && !HasFailure(); ++k) {
    walker.step();
    motion.add(rig.out());
  }
  EXPECT_GE(walker.outputs.step_index, 8);
  Replay replay(rig.params);
  ASSERT_EQ(0, motion.replay(replay.handle, 0, motion.rows()));
  const Difference found = compare(&rig, &replay);
  EXPECT_GT(found.deepest_m, 0.004);
  EXPECT_LT(found.worst_m, 50e-6);
  EXPECT_LT(found.mean_m, 2e-6);
}

TEST(SoilReplay, AFallenRobotLeavesItsMark) {
  Rig rig;
  place_anywhere(&rig);
  rig.params.start_omega_W_rad_s[1] = 2.5;
  rig.params.soil_roughness_m = 0.001;
  rig.params.soil_seed = 5;
  rig.start();
  rig.mode_of_all(kDriveOff);
  Motion motion;
  motion.add(rig.out());
  for (int k = 0; k < 1000; ++k) {
    rig.step();
    motion.add(rig.out());
  }
  EXPECT_GT(rig.out().other_contacts, 0);
  Replay replay(rig.params);
  ASSERT_EQ(0, motion.replay(replay.handle, 0, motion.rows()));
  const Difference found = compare(&rig, &replay);
  EXPECT_GT(found.deepest_m, 0.010);
  EXPECT_LT(found.worst_m, 1e-3);
  EXPECT_LT(found.mean_m, 5e-6);
}

TEST(SoilReplay, PiecesAndASecondPassGiveTheSameBytes) {
  Rig rig;
  place_anywhere(&rig);
  const Motion motion = shift_weight(&rig, 300);
  Replay whole(rig.params), pieces(rig.params);
  ASSERT_EQ(0, motion.replay(whole.handle, 0, motion.rows()));
  whole.read();
  for (int pass = 0; pass < 2; ++pass) {
    hoap2_soil_replay_restart(pieces.handle);
    pieces.read();
    for (const float change_m : pieces.change_m) ASSERT_EQ(0.0F, change_m);
    for (int64_t row = 0; row < motion.rows(); row += 7) {
      ASSERT_EQ(0, motion.replay(pieces.handle, row, std::min<int64_t>(7, motion.rows() - row)));
    }
    pieces.read();
    EXPECT_EQ(whole.height_m, pieces.height_m);
    EXPECT_EQ(whole.change_m, pieces.change_m);
  }
}

TEST(SoilReplay, ThePoolIsWhereItsParametersSay) {
  Rig rig;
  place_anywhere(&rig);
  rig.params.floor_tilt_rad[0] = rig.params.floor_tilt_rad[1] = 0.0;
  rig.params.start_height_m = 0.0;
  const Motion motion = shift_weight(&rig, 200);
  Replay replay(rig.params);
  ASSERT_EQ(0, motion.replay(replay.handle, 0, motion.rows()));
  replay.read();
  // The tracks are around the soles in the world.
  const hoap2_plant_outputs_t out = rig.out();
  const hoap2_soil_grid_t &grid = replay.grid;
  double nearest_m[2] = {1.0, 1.0};
  for (size_t i = 0; i < replay.change_m.size(); ++i) {
    if (replay.change_m[i] > -0.001F) continue;
    const auto nx = static_cast<size_t>(grid.nx);
    const double x_m = grid.low_x_m + (static_cast<double>(i % nx) + 0.5) * grid.cell_m;
    const double y_m = grid.low_y_m + (static_cast<double>(i / nx) + 0.5) * grid.cell_m;
    double apart_m[2] = {};
    for (int foot = 0; foot < 2; ++foot) {
      const double dx =
          grid.origin_W_m[0] + grid.axes_W[0] * x_m + grid.axes_W[1] * y_m - out.true_foot_pos_W_m[foot][0];
      const double dy =
          grid.origin_W_m[1] + grid.axes_W[3] * x_m + grid.axes_W[4] * y_m - out.true_foot_pos_W_m[foot][1];
      apart_m[foot] = std::hypot(dx, dy);
      nearest_m[foot] = std::min(nearest_m[foot], apart_m[foot]);
    }
    EXPECT_LT(std::min(apart_m[0], apart_m[1]), 0.075);
  }
  EXPECT_LT(nearest_m[0], 0.004);
  EXPECT_LT(nearest_m[1], 0.004);
}

TEST(SoilReplay, WhatCannotBeIsRefusedWithAReason) {
  hoap2_plant_params_t params;
  hoap2_plant_params_defaults(&params);
  params.soil_cell_m = 0.03;
  EXPECT_EQ(nullptr, hoap2_soil_replay_create(&params));
  EXPECT_NE(std::string::npos, std::string(hoap2_soil_replay_error(nullptr)).find("soil_cell_m"));

  Rig rig;
  place_anywhere(&rig);
  Motion motion = shift_weight(&rig, 60);
  Replay replay(rig.params);
  EXPECT_STREQ("", hoap2_soil_replay_error(nullptr));
  ASSERT_EQ(0, motion.replay(replay.handle, 0, motion.rows()));
  Motion away = motion;
  for (size_t i = 0; i < away.pos_W_m.size(); i += 3) away.pos_W_m[i] += 1.0;
  EXPECT_NE(0, away.replay(replay.handle, 0, away.rows()));
  EXPECT_NE(std::string::npos,
            std::string(hoap2_soil_replay_error(replay.handle)).find("left the soil pool"));
  replay.read();
  const std::vector<float> before = replay.height_m;
  EXPECT_NE(0, motion.replay(replay.handle, 0, motion.rows()));
  replay.read();
  EXPECT_EQ(before, replay.height_m);

  motion.q_rad[HOAP2_JOINTS + 3] = std::numeric_limits<double>::quiet_NaN();
  hoap2_soil_replay_restart(replay.handle);
  EXPECT_NE(0, motion.replay(replay.handle, 0, motion.rows()));
  EXPECT_STRNE("", hoap2_soil_replay_error(replay.handle));
}

}  // namespace
}  // namespace hoap2_sim
