// A robot without dynamics that does what it is told, to close the controller's loop in tests: joints follow
// their references one tick late, the supporting feet lie flat where the gait puts them, the accelerometer
// shows gravity alone, and the force cells carry the weight at the commanded CoP.
#ifndef HOAP2_TESTS_IDEAL_ROBOT_HPP
#define HOAP2_TESTS_IDEAL_ROBOT_HPP

#include <algorithm>
#include <cmath>
#include <vector>

#include "hoap2/hoap2.h"
#include "hoap2/state.h"
#include "robot/kinematics.hpp"

namespace hoap2_tests {

constexpr double kGravity = 9.81;
constexpr double kTick = 1e-6 * HOAP2_TICK_US;

// Weight of one foot spread over its four cells so that their CoP is (x, y) in the foot frame; a CoP beyond
// the rectangle of the cells is read at its edge, as by the real ones.
inline void load_cells(double force_N, double x_m, double y_m, double cells_N[4]) {
  const double rear = HOAP2_CELL_POS_L_M[2][0];
  const double front = HOAP2_CELL_POS_L_M[0][0];
  const double right = HOAP2_CELL_POS_L_M[0][1];
  const double left = HOAP2_CELL_POS_L_M[1][1];
  const double ahead = std::clamp((x_m - rear) / (front - rear), 0.0, 1.0);
  const double aside = std::clamp((y_m - right) / (left - right), 0.0, 1.0);
  cells_N[0] = force_N * ahead * (1.0 - aside);
  cells_N[1] = force_N * ahead * aside;
  cells_N[2] = force_N * (1.0 - ahead) * (1.0 - aside);
  cells_N[3] = force_N * (1.0 - ahead) * aside;
}

class IdealRobot {
 public:
  // What the sensors show after the references of `out` have acted for a tick.
  hoap2_inputs_t sense(const hoap2_outputs_t& out) {
    hoap2_inputs_t in;
    hoap2_inputs_defaults(&in);
    std::copy(out.q_ref_rad, out.q_ref_rad + HOAP2_JOINTS, in.q_enc_rad);
    const int main_foot = out.stance_foot == 1 ? 1 : 0;
    hoap2::Kinematics kin;
    hoap2::forward_kinematics(in.q_enc_rad, kin);
    const hoap2::Vec3 up_B = hoap2::sole_pose_B(kin, main_foot).R.col(2);
    Eigen::Map<hoap2::Vec3>(in.accel_S_m_s2) = kGravity * (hoap2::chest_rot_B(kin).transpose() * up_B);
    cells(out, in.cell_force_N);
    in.sensor_tick = ++frame_;
    return in;
  }

 private:
  static void cells(const hoap2_outputs_t& out, double cell_force_N[8]) {
    const double weight_N = HOAP2_TOTAL_MASS_KG * kGravity;
    double share[2] = {0.0, 0.0};
    if (out.phase == HOAP2_PHASE_SINGLE_SUPPORT) {
      share[out.stance_foot] = 1.0;
    } else {
      const double across_x = out.foot_ref_W_m[1][0] - out.foot_ref_W_m[0][0];
      const double across_y = out.foot_ref_W_m[1][1] - out.foot_ref_W_m[0][1];
      const double along = (out.cop_ref_W_m[0] - out.foot_ref_W_m[0][0]) * across_x +
                           (out.cop_ref_W_m[1] - out.foot_ref_W_m[0][1]) * across_y;
      share[1] = std::clamp(along / (across_x * across_x + across_y * across_y), 0.0, 1.0);
      share[0] = 1.0 - share[1];
    }
    // every loaded foot has its CoP as far from its ankle as the net CoP is from the line between the ankles
    const double line_x = share[0] * out.foot_ref_W_m[0][0] + share[1] * out.foot_ref_W_m[1][0];
    const double line_y = share[0] * out.foot_ref_W_m[0][1] + share[1] * out.foot_ref_W_m[1][1];
    const double off_x = out.cop_ref_W_m[0] - line_x;
    const double off_y = out.cop_ref_W_m[1] - line_y;
    for (int foot = 0; foot < 2; ++foot) {
      const double c = std::cos(out.foot_ref_yaw_W_rad[foot]);
      const double s = std::sin(out.foot_ref_yaw_W_rad[foot]);
      load_cells(share[foot] * weight_N, c * off_x + s * off_y, -s * off_x + c * off_y,
                 cell_force_N + 4 * foot);
    }
  }

  int32_t frame_ = 0;
};

// A controller in the loop with the ideal robot.
class Loop {
 public:
  explicit Loop(const hoap2_params_t& params) {
    init_fault = hoap2_init(&state, &params);
    hoap2_get_outputs(&state, &out);
    in = robot.sense(out);
  }

  // One tick: the controller sees the inputs of the last one, as in a Jacobi exchange.
  void tick() {
    hoap2_outputs_t next;
    hoap2_step(&state, &in, &next);
    in = robot.sense(out);
    out = next;
  }

  bool finished() const { return out.walk_done || out.mode == HOAP2_MODE_SAFE; }

  hoap2_state_t state;
  hoap2_inputs_t in;
  hoap2_outputs_t out;
  IdealRobot robot;
  int32_t init_fault = 0;
};

inline hoap2_params_t default_params() {
  hoap2_params_t params;
  hoap2_params_defaults(&params);
  return params;
}

// Ticks that no walk of these parameters needs.
inline int tick_limit(const hoap2_params_t& params) {
  return static_cast<int>(1000.0 * (params.start_up_s + params.calibrate_s + params.start_shift_s + 3.0 +
                                    params.step_time_s * (params.steps_forward + params.steps_in_place)));
}

}  // namespace hoap2_tests
#endif
