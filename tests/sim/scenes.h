// Places and motions for the solver tests: the robot turned, thrown, on blocks, swinging
// its joints, or walking under the firmware.
#ifndef HOAP2_TESTS_SIM_SCENES_H
#define HOAP2_TESTS_SIM_SCENES_H

#include <memory>
#include <vector>

#include "drive/drive.h"
#include "hoap2/hoap2.h"
#include "rig.h"
#include "sensors/noise.h"
#include "terrain/floor.h"

namespace hoap2_sim {

// Random numbers of a seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) { noise_seed(noise_, seed); }
  double between(double low, double high) { return low + (high - low) * noise_uniform(noise_); }
  Quat turn() {
    double q[4], unused;
    noise_normal_pair(noise_, &q[0], &q[1]);
    noise_normal_pair(noise_, &q[2], &q[3]);
    noise_normal_pair(noise_, &unused, &unused);
    return normalised({q[0], q[1], q[2], q[3]});
  }

 private:
  std::uint64_t noise_[4];
};

// Turns the whole robot, velocities included, about a point.
inline void turn_robot(State *s, const Quat &by, const Vec3 &about_W_m) {
  const Mat3 m = matrix(by);
  for (BodyState &body : s->body) {
    put(about_W_m + m * (vec(body.com_pos_W_m) - about_W_m), body.com_pos_W_m);
    for (double *const v : {body.com_vel_W_m_s, body.omega_W_rad_s, body.omega_before_W_rad_s}) {
      put(m * vec(v), v);
    }
    const Quat q = normalised(by * quat(body.quat_W));
    const double values[4] = {q.w, q.x, q.y, q.z};
    std::memcpy(body.quat_W, values, sizeof values);
  }
}

inline void shift_robot(State *s, const Vec3 &by_m) {
  for (BodyState &body : s->body) put(vec(body.com_pos_W_m) + by_m, body.com_pos_W_m);
}

// Height of the lowest corner of all links' boxes (of one link's box) above the floor plane.
inline double lowest_corner_m(const State &s, int only = -1) {
  const Floor floor(s.params);
  double lowest_m = 1e9;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    if (only >= 0 && link != only) continue;
    const double(&low)[3] = HOAP2_LINK[link].box_min_L_m, (&high)[3] = HOAP2_LINK[link].box_max_L_m;
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner_L_m = {(c & 1) != 0 ? high[0] : low[0], (c & 2) != 0 ? high[1] : low[1],
                               (c & 4) != 0 ? high[2] : low[2]};
      lowest_m = std::fmin(lowest_m, floor.height_m(point_W_m(s, link, corner_L_m)));
    }
  }
  return lowest_m;
}

inline double potential_energy_J(const State &s) {
  double energy_J = 0.0;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    energy_J += HOAP2_LINK[link].mass_kg * s.params.gravity_m_s2 * s.body[link].com_pos_W_m[2];
  }
  return energy_J;
}

// How far the two halves of the worst hinge are apart, and how far its axes.
struct HingeError {
  double anchors_m = 0.0, axes_rad = 0.0;
};
inline HingeError hinge_error(const State &s) {
  HingeError worst;
  for (const hoap2_joint_data_t &joint : HOAP2_JOINT) {
    const Vec3 apart =
        point_W_m(s, joint.child_link, Vec3{}) - point_W_m(s, joint.parent_link, vec(joint.origin_parent_m));
    const Vec3 turned = cross(link_axes_W(s, joint.child_link).column(joint.axis),
                              link_axes_W(s, joint.parent_link).column(joint.axis));
    worst.anchors_m = std::fmax(worst.anchors_m, norm(apart));
    worst.axes_rad = std::fmax(worst.axes_rad, norm(turned));
  }
  return worst;
}

// Adds a block whose top is at a height; the block reaches 0.1 m below it.
inline void add_block(hoap2_plant_params_t *params, double x_m, double y_m, double size_x_m, double size_y_m,
                      double top_m, double yaw_rad = 0.0) {
  const int b = params->block_count++;
  const double size_m[3] = {size_x_m, size_y_m, 0.1}, centre_m[3] = {x_m, y_m, top_m - 0.05};
  for (int i = 0; i < 3; ++i) {
    params->block_size_m[b][i] = size_m[i];
    params->block_centre_W_m[b][i] = centre_m[i];
  }
  params->block_yaw_W_rad[b] = yaw_rad;
}

// A random posture within the soft limits, turned at random and thrown from `height_m`.
inline void thrown(Rig *rig, std::uint64_t seed, double height_m) {
  Dice dice(seed);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    rig->params.start_posture_rad[j] =
        dice.between(HOAP2_JOINT[j].limit_soft_rad[0], HOAP2_JOINT[j].limit_soft_rad[1]);
  }
  for (int i = 0; i < 3; ++i) {
    rig->params.start_vel_W_m_s[i] = dice.between(-1.0, 1.0);
    rig->params.start_omega_W_rad_s[i] = dice.between(-5.0, 5.0);
  }
  rig->start();
  State s = rig->state();
  turn_robot(&s, dice.turn(), vec(s.body[HOAP2_L_PELVIS].com_pos_W_m));
  shift_robot(&s, Vec3{0.0, 0.0, height_m - lowest_corner_m(s)});
  ASSERT_EQ(0, rig->restore(s));
}

// Position references that swing every joint about the middle of its range, each at its own
// frequency, up to a joint rate; they fade in from the start posture.
class Swing {
 public:
  Swing(std::uint64_t seed, double rate_rad_s, double range_share = 0.8) {
    Dice dice(seed);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double(&soft_rad)[2] = HOAP2_JOINT[j].limit_soft_rad;
      Wave &w = wave_[j];
      w.omega_rad_s = dice.between(3.0, 12.0);
      w.phase_rad = dice.between(0.0, 6.28);
      w.middle_rad = 0.5 * (soft_rad[0] + soft_rad[1]);
      w.size_rad = std::fmin(0.5 * range_share * (soft_rad[1] - soft_rad[0]), rate_rad_s / w.omega_rad_s);
    }
  }
  void set(Rig *rig, int tick) const {
    const double t_s = kTick_s * tick, share = std::fmin(1.0, t_s / 0.3);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const Wave &w = wave_[j];
      const double swung_rad = w.middle_rad + w.size_rad * std::sin(w.omega_rad_s * t_s + w.phase_rad);
      rig->inputs.q_ref_rad[j] = (1.0 - share) * rig->params.start_posture_rad[j] + share * swung_rad;
    }
  }

 private:
  struct Wave {
    double omega_rad_s, phase_rad, middle_rad, size_rad;
  };
  Wave wave_[HOAP2_JOINTS];
};

// The firmware's capture point walk in closed loop with a rig (both step with the values of
// the tick's beginning).
class Walker {
 public:
  explicit Walker(Rig *rig) : rig_(rig), state_((hoap2_state_size() + 7) / 8) {
    hoap2_params_defaults(&params);
    params.behaviour = HOAP2_BEHAVIOUR_WALK_CP;
    params.calibrate_s = 0.1;
  }
  void start() {
    rig_->start();
    ASSERT_EQ(0, hoap2_init(self(), &params));
    hoap2_get_outputs(self(), &outputs);
  }
  void step() {
    command();
    rig_->step();
  }
  // The controller's tick: sets the rig's inputs for its next one.
  void command() {
    const hoap2_plant_outputs_t sensed = rig_->out();
    hoap2_inputs_t inputs = {};
    std::memcpy(inputs.q_enc_rad, sensed.q_enc_rad, sizeof inputs.q_enc_rad);
    std::memcpy(inputs.gyro_S_rad_s, sensed.gyro_S_rad_s, sizeof inputs.gyro_S_rad_s);
    std::memcpy(inputs.accel_S_m_s2, sensed.accel_S_m_s2, sizeof inputs.accel_S_m_s2);
    std::memcpy(inputs.cell_force_N, sensed.cell_force_N, sizeof inputs.cell_force_N);
    inputs.sensor_tick = sensed.sensor_tick;
    take_commands();
    hoap2_step(self(), &inputs, &outputs);
  }

  hoap2_params_t params = {};
  hoap2_outputs_t outputs = {};

 private:
  hoap2_state_t *self() { return reinterpret_cast<hoap2_state_t *>(state_.data()); }
  void take_commands() {
    hoap2_plant_inputs_t &to = rig_->inputs;
    std::memcpy(to.q_ref_rad, outputs.q_ref_rad, sizeof to.q_ref_rad);
    std::memcpy(to.qd_ref_rad_s, outputs.qd_ref_rad_s, sizeof to.qd_ref_rad_s);
    std::memcpy(to.tau_ff_Nm, outputs.tau_ff_Nm, sizeof to.tau_ff_Nm);
    std::memcpy(to.kp_Nm_rad, outputs.kp_Nm_rad, sizeof to.kp_Nm_rad);
    std::memcpy(to.kd_Nms_rad, outputs.kd_Nms_rad, sizeof to.kd_Nms_rad);
    std::memcpy(to.drive_mode, outputs.drive_mode, sizeof to.drive_mode);
  }

  Rig *rig_;
  std::vector<double> state_;
};

}  // namespace hoap2_sim
#endif
