#include "gait_cp/leg_look.hpp"

#include "core/quintic.h"
#include "gait_cp/capture_point.hpp"
#include "gait_cp/plane.hpp"
#include "gait_cp/swing.hpp"
#include "gait_cp/walk_plan.hpp"
#include "hoap2/generated/robot_model.h"
#include "robot/leg_ik.hpp"

namespace hoap2 {

SwingParts swing_parts(const hoap2_params_t& params) {
  const double lifts = params.ds_fraction;
  const double bends = lifts + 0.25 * (1.0 - 2.0 * lifts);
  return {lifts, bends, 1.0 - bends};
}

void com_at(const hoap2_gait_t& gait, const double cop_m[2], double part, double com_m[2]) {
  const double growth = hoap2_exp(gait.omega_1_s * part * gait.step_ticks * kTick_s);
  for (int i = 0; i < 2; ++i) {
    com_m[i] = gait.com_m[i];
    double rate_m_s = gait.com_rate_m_s[i];
    pendulum_after(cop_m[i], gait.omega_1_s, 0.5 * (growth + 1.0 / growth), 0.5 * (growth - 1.0 / growth),
                   com_m[i], rate_m_s);
  }
}

bool leg_at(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look, int foot,
            const double pose[4], double part, double q_rad[6]) {
  const double heading_rad =
      gait.heading_from_rad + hoap2_quintic(part) * (gait.heading_to_rad - gait.heading_from_rad);
  double com_m[2];
  com_at(gait, look.cop_m, part, com_m);
  double com_over_base[2];
  to_ground(heading_rad, gait.com_over_base_B_m, com_over_base);
  double from_base[2];
  for (int i = 0; i < 2; ++i) {
    const double legs_m = gait.com_by_legs * look.mean_shift[i];
    from_base[i] = pose[i] - (com_m[i] + gait.tpcc_m[i] - com_over_base[i] - legs_m);
  }
  double seen[2];
  from_ground(heading_rad, from_base, seen);
  Pose sole_B;
  sole_B.R = rot_z(pose[3] - heading_rad);
  sole_B.p = Vec3(seen[0], seen[1], pose[2] - params.hip_height_m);
  LegIkResult leg;
  leg_ik(foot, sole_B, leg, look.reach_m);
  for (int i = 0; i < 6; ++i) q_rad[i] = leg.q_rad[i];
  return leg.excess_m <= 0.0 && leg.status != LegIk::joint_limit;
}

bool swing_leg(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look, const Swing& swing,
               double part, double q_rad[6]) {
  double pose[4];
  swing_foot(swing.from, swing.to, params.lift_m, swing_phase(params, part), pose);
  return leg_at(params, gait, look, gait.swing_foot, pose, part, q_rad);
}

bool swing_leg_in_time(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look,
                       const Swing& swing, double part) {
  double q_rad[6];
  double later_rad[6];
  const double ticks = 2.0;
  if (!swing_leg(params, gait, look, swing, part, q_rad) ||
      !swing_leg(params, gait, look, swing, part + ticks / gait.step_ticks, later_rad))
    return false;
  for (int i = 0; i < 6; ++i) {
    const double limit_rad_s =
        look.rate_tolerance * HOAP2_JOINT[leg_first_joint(gait.swing_foot) + i].velocity_limit_rad_s;
    if (absolute(later_rad[i] - q_rad[i]) > limit_rad_s * ticks * kTick_s) return false;
  }
  return true;
}

}  // namespace hoap2
