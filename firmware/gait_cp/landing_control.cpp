#include "gait_cp/landing_control.hpp"

#include "core/scalar_math.h"
#include "gait_cp/capture_point.hpp"
#include "gait_cp/footprints.hpp"
#include "gait_cp/leg_look.hpp"
#include "gait_cp/plane.hpp"
#include "gait_cp/walk_plan.hpp"
#include "hoap2/generated/robot_model.h"

namespace hoap2 {
namespace {

// How long after the reference the sensors show the CoM of a robot that walks undisturbed (least rms
// deviation on the hard floor): the servo's 5 ms (no velocity feed-forward), link and sensors, and the sway
// of the body.
constexpr double kSensedLate_s = 0.016;
constexpr double kNonsense_m = 0.2;     // a larger deviation is no measurement
constexpr double kTooNear_m = 1e-9;     // spacing short by less is rounding
constexpr double kSpareReach_m = 3e-3;  // of a leg's reach

double least(double a, double b) { return a < b ? a : b; }
double clip(double value, double low, double high) {
  return value < low ? low : (value > high ? high : value);
}

void shifted(const double footprint[3], const double shift[2], double out[3]) {
  to_ground(footprint[2], shift, out);
  out[0] += footprint[0];
  out[1] += footprint[1];
  out[2] = footprint[2];
}

struct Box {
  double low[2];
  double high[2];
};

void clip_to(const Box& box, double shift[2]) {
  for (int i = 0; i < 2; ++i) shift[i] = clip(shift[i], box.low[i], box.high[i]);
}

// The CoP that the step after this one needs, by (7.9) or its ramp form. last_after: that step ends the walk.
void cop_after(const hoap2_params_t& params, const hoap2_gait_t& gait, bool last_after, double cop_m[2]) {
  const int after = 1 - gait.swing_foot;  // the foot that swings then
  double centre[3] = {gait.centre[0], gait.centre[1], gait.centre[2]};
  double print[3];
  double eos_m[2];
  advance_centre(advance_of(params, gait, gait.step_index + 1), after, centre);
  footprint_beside(centre, after, params.step_width_m, print);
  if (last_after)
    capture_point_between(params, after == 0 ? print : gait.land_nominal,
                          after == 1 ? print : gait.land_nominal, eos_m);
  else
    capture_point_over(params, print, after, eos_m);
  const double ramp = ramp_s(params, gait);
  for (int i = 0; i < 2; ++i) {
    cop_m[i] = params.cop_profile == HOAP2_COP_PROFILE_RAMP
                   ? cop_for_ramp(eos_m[i], gait.cp_eos_m[i], gait.cop_step_m[i], gait.omega_1_s,
                                  params.step_time_s, ramp)
                   : cop_for_capture_point(eos_m[i], gait.cp_eos_m[i],
                                           hoap2_exp(gait.omega_1_s * params.step_time_s));
  }
}

// How far the landing may be shifted: by the parameter's limit and, where the capture point's plan does not
// move along, only so far that the sole still holds the CoP the plan needs there. A CoP held back by the edge
// of the sole throws the capture point off by e^(omega T) times as much, which no later step makes good.
// Across, the nearer edge counts for both ways: the foot that follows must be able to keep its distance.
Box room_for_shift(const hoap2_params_t& params, const hoap2_gait_t& gait, bool last_after) {
  const double limit_m = params.lpc_limit_m;
  Box box = {{-limit_m, -limit_m}, {limit_m, limit_m}};
  if (params.lpc_moves_cp) return box;
  double cop_m[2];
  double over[2];  // that CoP over the nominal footprint
  cop_after(params, gait, last_after, cop_m);
  const double from_print[2] = {cop_m[0] - gait.land_nominal[0], cop_m[1] - gait.land_nominal[1]};
  from_ground(gait.land_nominal[2], from_print, over);
  // The walk's last capture point follows the feet, and the CoP gives way to the other side.
  const double growth = hoap2_exp(gait.omega_1_s * params.step_time_s);
  const double share = last_after ? 1.0 - 1.0 / growth : 1.0;
  const double ahead_m = share * (over[0] + HOAP2_ANKLE_TO_HEEL_M - params.cop_margin_m);
  const double behind_m = share * (over[0] - HOAP2_ANKLE_TO_TOE_M + params.cop_margin_m);
  const double aside_m = share * (HOAP2_SOLE_HALF_WIDTH_M - params.cop_margin_m - absolute(over[1]));
  box.high[0] = clip(ahead_m, 0.0, limit_m);
  box.low[0] = clip(behind_m, -limit_m, 0.0);
  box.high[1] = clip(aside_m, 0.0, limit_m);
  box.low[1] = -box.high[1];
  return box;
}

// Moves the shift outward until the ankles are lpc_min_spacing_m apart, across the standing foot, and the
// soles do not come nearer than any walk may have them.
void keep_spacing(const hoap2_params_t& params, const hoap2_gait_t& gait, double shift[2]) {
  const int stance = 1 - gait.swing_foot;
  const double* foot = gait.foot[stance];
  double land[3];
  shifted(gait.land_nominal, shift, land);
  const double apart[2] = {land[0] - foot[0], land[1] - foot[1]};
  double seen[2];
  from_ground(foot[2], apart, seen);
  const double outward = side(gait.swing_foot);
  const double spare_m = least(outward * seen[1] - params.lpc_min_spacing_m,
                               sole_clearance(foot, stance, land) - kSoleClearance_m);
  if (spare_m < -kTooNear_m) shift[1] -= outward * spare_m / hoap2_cos(land[2] - foot[2]);
}

// Can the legs do a landing with this shift? Looked at where a swing is hardest. Two steps later the foot is
// lifted again from where it landed: that swing is like the present one with the shift at its beginning too,
// unless the CoM has followed the feet by then.
bool legs_can(const hoap2_params_t& params, const hoap2_gait_t& gait, const double shift[2]) {
  const SwingParts at = swing_parts(params);
  const double* foot = gait.foot[gait.swing_foot];
  const double* own = gait.foot_shift_m[gait.swing_foot];
  const double* others = gait.foot_shift_m[1 - gait.swing_foot];
  const double print[3] = {foot[0] - own[0], foot[1] - own[1], foot[2]};
  Swing now;
  Swing later;
  shifted(gait.land_nominal, shift, now.to);
  shifted(gait.land_nominal, shift, later.to);
  shifted(print, shift, later.from);
  for (int i = 0; i < 3; ++i) now.from[i] = foot[i];
  Look look = {{gait.cop_step_m[0], gait.cop_step_m[1]}, {0.0, 0.0}, kSpareReach_m, kRateTolerance};
  Look look_later = look;
  for (int i = 0; i < 2; ++i) {
    const double all_m = now.to[i] - gait.land_nominal[i];
    look.mean_shift[i] = 0.5 * (all_m - own[i]);
    look_later.mean_shift[i] = all_m - 0.5 * (own[i] + others[i]);
  }
  double q_rad[6];
  if (!swing_leg(params, gait, look, now, 1.0, q_rad) ||
      !swing_leg_in_time(params, gait, look, now, at.bends) ||
      !swing_leg_in_time(params, gait, look, now, at.stretches))
    return false;
  return params.lpc_moves_cp || (swing_leg(params, gait, look_later, later, at.lifts, q_rad) &&
                                 swing_leg_in_time(params, gait, look_later, later, at.bends));
}

// Draws a shift that the legs cannot do towards the one the foot stands with, with which the swing is the
// nominal one.
void draw_into_reach(const hoap2_params_t& params, const hoap2_gait_t& gait, const Box& box,
                     double shift[2]) {
  if (legs_can(params, gait, shift)) return;
  const double wanted[2] = {shift[0], shift[1]};
  double own[2];
  from_ground(gait.land_nominal[2], gait.foot_shift_m[gait.swing_foot], own);
  clip_to(box, own);
  double low = 0.0;
  double high = 1.0;
  for (int halving = 0; halving < 4; ++halving) {
    const double middle = 0.5 * (low + high);
    for (int i = 0; i < 2; ++i) shift[i] = own[i] + middle * (wanted[i] - own[i]);
    keep_spacing(params, gait, shift);
    (legs_can(params, gait, shift) ? low : high) = middle;
  }
  for (int i = 0; i < 2; ++i) shift[i] = own[i] + low * (wanted[i] - own[i]);
  keep_spacing(params, gait, shift);
}

}  // namespace

void landing_control_reset(double heading_rad, hoap2_gait_t& gait) {
  gait.lpc_axes_rad = heading_rad;
  for (int i = 0; i < 2; ++i) {
    gait.lpc_extreme_m[i] = gait.lpc_shift_m[i] = gait.land_shift_m[i] = 0.0;
    gait.foot_shift_m[0][i] = gait.foot_shift_m[1][i] = 0.0;
  }
}

void observe_deviation(const hoap2_params_t& params, const hoap2_sense_t& sense, hoap2_gait_t& gait) {
  for (int i = 0; i < 2; ++i) {
    const double reference_m = gait.com_m[i] + gait.tpcc_m[i];
    gait.com_late_m[i] += kTick_s / (kSensedLate_s + kTick_s) * (reference_m - gait.com_late_m[i]);
    gait.com_deviation_m[i] =
        gait.feedback ? clip(sense.com_O_m[i] - gait.com_late_m[i], -kNonsense_m, kNonsense_m) : 0.0;
  }
  if (!gait.walking || !params.landing_control) return;
  double deviation[2];
  from_ground(gait.lpc_axes_rad, gait.com_deviation_m, deviation);
  for (int i = 0; i < 2; ++i)
    if (absolute(deviation[i]) > absolute(gait.lpc_extreme_m[i])) gait.lpc_extreme_m[i] = deviation[i];
}

double next_shift(double extreme_m, double shift_m, double threshold_m, double gain, double forget) {
  const double counted_m = absolute(extreme_m) > threshold_m ? extreme_m : 0.0;
  return gain * counted_m + forget * shift_m;
}

void shift_landing(const hoap2_params_t& params, bool last, hoap2_gait_t& gait) {
  const bool last_after = ends_walk(params, gait, gait.step_index + 1);
  gait.lpc_axes_rad = gait.land_nominal[2];
  double shift[2];
  for (int i = 0; i < 2; ++i) {
    shift[i] = next_shift(gait.lpc_extreme_m[i], gait.lpc_shift_m[i], params.lpc_threshold_m[i],
                          params.lpc_gain[i], params.lpc_forget[i]);
    gait.lpc_extreme_m[i] = 0.0;
  }
  if (last) {  // side by side with the foot that stands, wherever that is
    from_ground(gait.land_nominal[2], gait.foot_shift_m[1 - gait.swing_foot], shift);
  } else {
    const Box box = room_for_shift(params, gait, last_after);
    clip_to(box, shift);
    keep_spacing(params, gait, shift);
    draw_into_reach(params, gait, box, shift);
  }
  shifted(gait.land_nominal, shift, gait.land);
  for (int i = 0; i < 2; ++i) {
    gait.lpc_shift_m[i] = shift[i];
    gait.land_shift_m[i] = gait.land[i] - gait.land_nominal[i];
  }
}

}  // namespace hoap2
