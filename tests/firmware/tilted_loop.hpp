// A controller with landing position control, in the loop with a robot that walks as told while its attitude
// sensors show a tilt: the CoM is sensed away from its reference by as much as the tilt carries it over the
// foot.
#ifndef HOAP2_TESTS_TILTED_LOOP_HPP
#define HOAP2_TESTS_TILTED_LOOP_HPP

#include <gtest/gtest.h>

#include <vector>

#include "gait_cp/footprints.hpp"
#include "ideal_robot.hpp"

namespace hoap2_tests {

constexpr double kDeg = 3.14159265358979323846 / 180.0;

// The loop, with inertial sensors that show a chest turned by roll and pitch against where it is; the tilt
// moves to its target at 2 rad/s.
class TiltedLoop {
 public:
  explicit TiltedLoop(const hoap2_params_t& params) : loop(params) {}

  void tick() {
    loop.tick();
    double rate[2];
    for (int i = 0; i < 2; ++i) {
      const double step_rad = std::clamp(target_rad[i] - tilt_rad[i], -2.0 * kTick, 2.0 * kTick);
      tilt_rad[i] += step_rad;
      rate[i] = step_rad / kTick;
    }
    const hoap2::Mat3 turn = hoap2::rot_y(tilt_rad[1]) * hoap2::rot_x(tilt_rad[0]);
    const hoap2::Vec3 level = Eigen::Map<const hoap2::Vec3>(loop.in.accel_S_m_s2);
    Eigen::Map<hoap2::Vec3>(loop.in.accel_S_m_s2) = turn.transpose() * level;
    loop.in.gyro_S_rad_s[0] = rate[0];
    loop.in.gyro_S_rad_s[1] = rate[1] * std::cos(tilt_rad[0]);
    loop.in.gyro_S_rad_s[2] = -rate[1] * std::sin(tilt_rad[0]);
  }

  const hoap2_gait_t& gait() const { return loop.state.gait; }

  Loop loop;
  double target_rad[2] = {0.0, 0.0};  // roll, pitch; both are reached after the calibration only
  double tilt_rad[2] = {0.0, 0.0};
};

// What a step was, read when it has begun and again when it ends.
struct Step {
  int swing_foot;
  double nominal[3];  // worked out here from the parameters
  double land[3];
  double stance[3];
  double shift[2];    // land against nominal, along and across the nominal footprint
  double extreme[2];  // of the deviation while the step lasted, along and across
  double cp_eos_m[2];
};

inline void along_across(double yaw, double x, double y, double out[2]) {
  out[0] = std::cos(yaw) * x + std::sin(yaw) * y;
  out[1] = -std::sin(yaw) * x + std::cos(yaw) * y;
}

// Walks to the end; before each tick `tilt(loop)` may set the targets. steps[0] is the shift before the first
// step, seen from the walk's first direction.
template <typename Tilt>
std::vector<Step> walk(TiltedLoop& tilted, Tilt tilt) {
  const hoap2_params_t& params = tilted.loop.state.params;
  std::vector<Step> steps;
  double centre[3] = {0.0, 0.0, 0.0};
  int last_index = -1;
  for (int k = 0; k < tick_limit(params) && !tilted.loop.finished(); ++k) {
    if (tilted.loop.out.mode >= HOAP2_MODE_STAND) tilt(tilted);
    tilted.tick();
    const hoap2_gait_t& gait = tilted.gait();
    if (!gait.walking) continue;
    if (gait.swing_foot == 2 && gait.step_index > 0) continue;  // settling
    const double yaw_before = centre[2];
    if (gait.step_index == last_index) {
      double seen[2];
      along_across(steps.empty() ? yaw_before : steps.back().nominal[2], gait.com_deviation_m[0],
                   gait.com_deviation_m[1], seen);
      for (int i = 0; i < 2; ++i)
        if (std::fabs(seen[i]) > std::fabs(steps.back().extreme[i])) steps.back().extreme[i] = seen[i];
      continue;
    }
    if (gait.step_index > 0) {  // the tick that begins a step still observes for the one before
      double seen[2];
      along_across(steps.back().nominal[2], gait.com_deviation_m[0], gait.com_deviation_m[1], seen);
      for (int i = 0; i < 2; ++i)
        if (std::fabs(seen[i]) > std::fabs(steps.back().extreme[i])) steps.back().extreme[i] = seen[i];
    }
    last_index = gait.step_index;
    Step step = {};
    step.swing_foot = gait.swing_foot;
    if (gait.step_index > 0) {
      const bool in_place = gait.step_index > params.steps_forward;
      hoap2::advance_centre({params.step_length_m, params.step_sideways_m, params.step_turn_rad, in_place},
                            gait.swing_foot, centre);
      hoap2::footprint_beside(centre, gait.swing_foot, params.step_width_m, step.nominal);
      std::copy(gait.land, gait.land + 3, step.land);
      std::copy(gait.foot[1 - gait.swing_foot], gait.foot[1 - gait.swing_foot] + 3, step.stance);
      along_across(step.nominal[2], step.land[0] - step.nominal[0], step.land[1] - step.nominal[1],
                   step.shift);
      EXPECT_EQ(step.land[2], step.nominal[2]);
    }
    std::copy(gait.cp_eos_m, gait.cp_eos_m + 2, step.cp_eos_m);
    steps.push_back(step);
  }
  return steps;
}

inline hoap2_params_t lpc_params(int forward = 16, int in_place = 4) {
  hoap2_params_t params = default_params();
  params.start_up_s = 0.3;
  params.calibrate_s = 0.2;
  params.steps_forward = forward;
  params.steps_in_place = in_place;
  params.landing_control = HOAP2_SWITCH_ON;
  for (int i = 0; i < 2; ++i) {  // of the tests: a steady gain K_L / (1 - lambda) of 1.5
    params.lpc_gain[i] = 0.45;
    params.lpc_forget[i] = 0.7;
  }
  params.lpc_threshold_m[0] = 0.002;
  params.lpc_threshold_m[1] = 0.006;
  return params;
}

}  // namespace hoap2_tests
#endif
