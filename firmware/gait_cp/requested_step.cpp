#include "gait_cp/requested_step.hpp"

#include "core/scalar_math.h"
#include "gait_cp/capture_point.hpp"
#include "gait_cp/footprints.hpp"
#include "gait_cp/leg_look.hpp"
#include "gait_cp/plane.hpp"
#include "gait_cp/swing.hpp"
#include "gait_cp/walk_plan.hpp"

namespace hoap2 {
namespace {

constexpr int kHalvings = 4;
constexpr double kSpareReach_m = 4e-3;
constexpr double kRequestRateTolerance = 1.15;  // below kRateTolerance, as the look is coarse

Advance share_of_request(const hoap2_gait_t& gait, double share) {
  const double* step = gait.request.step;
  return {share * step[0], share * step[1], share * step[2], false};
}

// The CoP that, held over the whole step, leads the capture point where the plan leads it. With a ramp the
// CoP that the plan comes to is another one.
void held_cop(const hoap2_gait_t& gait, double cop_m[2]) {
  const double growth = hoap2_exp(gait.omega_1_s * gait.step_ticks * kTick_s);
  for (int i = 0; i < 2; ++i) cop_m[i] = cop_for_capture_point(gait.cp_eos_m[i], gait.cp_start_m[i], growth);
}

// The swing foot at a part of the step, and what a look at the legs there assumes.
Look look_at(const hoap2_params_t& params, const hoap2_gait_t& gait, double part) {
  Look look = {{0.0, 0.0}, {0.0, 0.0}, kSpareReach_m, kRequestRateTolerance};
  held_cop(gait, look.cop_m);
  const double* lifted = gait.foot[gait.swing_foot];
  double pose[4];
  double com_m[2];
  swing_foot(lifted, gait.land, params.lift_m, swing_phase(params, part), pose);
  com_at(gait, look.cop_m, part, com_m);
  for (int i = 0; i < 2; ++i) look.mean_shift[i] = 0.5 * (pose[i] - lifted[i]) - (com_m[i] - gait.com_m[i]);
  return look;
}

// Both legs at a part of the step, and with `rates` the swing leg's joint rates.
bool legs_reach(const hoap2_params_t& params, const hoap2_gait_t& gait, double part, bool rates) {
  const Look look = look_at(params, gait, part);
  const double* lifted = gait.foot[gait.swing_foot];
  const double* stands = gait.foot[1 - gait.swing_foot];
  const Swing swing = {{lifted[0], lifted[1], lifted[2]}, {gait.land[0], gait.land[1], gait.land[2]}};
  const double stance_pose[4] = {stands[0], stands[1], 0.0, stands[2]};
  double q_rad[6];
  return leg_at(params, gait, look, 1 - gait.swing_foot, stance_pose, part, q_rad) &&
         (rates ? swing_leg_in_time(params, gait, look, swing, part)
                : swing_leg(params, gait, look, swing, part, q_rad));
}

// The step under way, where its swing is hardest.
bool step_reaches(const hoap2_params_t& params, const hoap2_gait_t& gait) {
  const SwingParts at = swing_parts(params);
  return legs_reach(params, gait, at.lifts, false) && legs_reach(params, gait, at.bends, true) &&
         legs_reach(params, gait, at.stretches, true) && legs_reach(params, gait, 1.0 - at.lifts, false) &&
         legs_reach(params, gait, 1.0, false);
}

// The walk when the step under way has been made as planned: the other foot is next.
hoap2_gait_t after_step(const hoap2_params_t& params, const hoap2_gait_t& gait) {
  hoap2_gait_t next = gait;
  const double growth = hoap2_exp(gait.omega_1_s * gait.step_ticks * kTick_s);
  const Look look = look_at(params, gait, 1.0);
  double in_pelvis[2];
  from_ground(gait.heading_to_rad, look.mean_shift, in_pelvis);
  for (int i = 0; i < 2; ++i) {
    pendulum_after(look.cop_m[i], gait.omega_1_s, 0.5 * (growth + 1.0 / growth),
                   0.5 * (growth - 1.0 / growth), next.com_m[i], next.com_rate_m_s[i]);
    next.cop_m[i] = gait.cop_step_m[i];
    next.com_over_base_B_m[i] += gait.com_by_legs * in_pelvis[i];
  }
  next.heading_rad = gait.heading_to_rad;
  end_step(next);
  next.swing_foot = 1 - gait.swing_foot;
  return next;
}

// After the step the walk can end, and the next step of the same kind can lift off: where legs trail most.
bool next_reaches(const hoap2_params_t& params, const hoap2_gait_t& gait, const Advance& advance) {
  const hoap2_gait_t after = after_step(params, gait);
  hoap2_gait_t closing = after;
  lay_step(params, {0.0, 0.0, 0.0, true}, true, closing);
  if (!step_reaches(params, closing)) return false;
  hoap2_gait_t next = after;
  lay_step(params, advance, false, next);
  return legs_reach(params, next, swing_parts(params).lifts, false);
}

// The walk as if no landing had been shifted by (7.14): that control sees itself that its shifts stay in
// reach of the legs and keep the feet apart. Where the CoM follows the shifted feet, it is the walk as it is.
hoap2_gait_t without_shifts(const hoap2_params_t& params, const hoap2_gait_t& gait) {
  hoap2_gait_t plain = gait;
  if (!params.landing_control || params.lpc_moves_cp) return plain;
  double mean_m[2];
  double in_pelvis[2];
  for (int i = 0; i < 2; ++i) {
    for (int foot = 0; foot < 2; ++foot) plain.foot[foot][i] -= gait.foot_shift_m[foot][i];
    mean_m[i] = 0.5 * (gait.foot_shift_m[0][i] + gait.foot_shift_m[1][i]);
  }
  from_ground(gait.heading_rad, mean_m, in_pelvis);
  for (int i = 0; i < 2; ++i) plain.com_over_base_B_m[i] -= gait.com_by_legs * in_pelvis[i];
  return plain;
}

bool in_reach(const hoap2_params_t& params, const hoap2_gait_t& shifted, const Advance& advance) {
  const hoap2_gait_t gait = without_shifts(params, shifted);
  const int stance = 1 - gait.swing_foot;
  return sole_clearance(gait.foot[stance], stance, gait.land) >= kSoleClearance_m &&
         step_reaches(params, gait) && next_reaches(params, gait, advance);
}

// Lays the step with a share of the request, from the centre it began with.
bool try_share(const hoap2_params_t& params, const double centre[3], double share, hoap2_gait_t& gait) {
  const Advance advance = share_of_request(gait, share);
  for (int i = 0; i < 3; ++i) gait.centre[i] = centre[i];
  return lay_step(params, advance, false, gait) && in_reach(params, gait, advance);
}

}  // namespace

void lay_requested_step(const hoap2_params_t& params, hoap2_gait_t& gait) {
  const double centre[3] = {gait.centre[0], gait.centre[1], gait.centre[2]};
  if (try_share(params, centre, 1.0, gait)) return;
  double low = 0.0;
  double high = 1.0;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle = 0.5 * (low + high);
    (try_share(params, centre, middle, gait) ? low : high) = middle;
  }
  (void)try_share(params, centre, low, gait);
  gait.drawn_in = gait.request.step[0] != 0.0 || gait.request.step[1] != 0.0 || gait.request.step[2] != 0.0;
}

}  // namespace hoap2
