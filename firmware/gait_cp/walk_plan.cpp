#include "gait_cp/walk_plan.hpp"

#include "core/scalar_math.h"
#include "gait_cp/capture_point.hpp"
#include "gait_cp/footprints.hpp"
#include "gait_cp/landing_control.hpp"
#include "gait_cp/requested_step.hpp"
#include "gait_cp/support_polygon.hpp"

namespace hoap2 {
namespace {

// A capture point farther than this outside both soles at the end of a walk is a fault, not rounding or
// margin.
constexpr double kCapturePointLost_m = 0.01;

int other(int foot) { return 1 - foot; }

// (7.8), (7.9) or its ramp form, and the clamp of 7.2.2 d. False when that had to act.
bool plan_cop(const hoap2_params_t& params, const SupportPolygon& polygon, double duration_s,
              hoap2_gait_t& gait) {
  const bool ramp = params.cop_profile == HOAP2_COP_PROFILE_RAMP;
  const double growth = hoap2_exp(gait.omega_1_s * duration_s);
  double cop[2];
  double line_start[2];
  for (int i = 0; i < 2; ++i) {
    gait.cp_start_m[i] = gait.com_m[i] + gait.com_rate_m_s[i] / gait.omega_1_s;
    gait.cp_ref_m[i] = gait.cp_start_m[i];
    gait.cop_from_m[i] = gait.cop_m[i];
    line_start[i] = gait.cp_start_m[i];
    cop[i] = cop_for_capture_point(gait.cp_eos_m[i], gait.cp_start_m[i], growth);
    if (ramp) {
      const double length_s = ramp_s(params, gait);
      line_start[i] =
          line_start_for_ramp(gait.cp_start_m[i], gait.cop_m[i], gait.omega_1_s, duration_s, length_s);
      cop[i] = cop_for_ramp(gait.cp_eos_m[i], gait.cp_start_m[i], gait.cop_m[i], gait.omega_1_s, duration_s,
                            length_s);
    }
  }
  const Point2 inside = clamp_cop(polygon, {cop[0], cop[1]}, {line_start[0], line_start[1]},
                                  {gait.cp_eos_m[0], gait.cp_eos_m[1]});
  gait.cop_step_m[0] = inside.x;
  gait.cop_step_m[1] = inside.y;
  return inside.x == cop[0] && inside.y == cop[1];
}

// Capture point at the end of the step, over the landing foot or at last between the feet, and the CoP.
bool plan_step(const hoap2_params_t& params, bool last, hoap2_gait_t& gait) {
  const int swing = gait.swing_foot;
  const int stance = other(swing);
  if (last) {
    const double* right = swing == 0 ? gait.land : gait.foot[0];
    const double* left = swing == 1 ? gait.land : gait.foot[1];
    capture_point_between(params, right, left, gait.cp_eos_m);
  } else {
    capture_point_over(params, gait.land, swing, gait.cp_eos_m);
  }
  return plan_cop(params, sole_polygon(gait.foot[stance], params.cop_margin_m), params.step_time_s, gait);
}

// The operator wants no further step of this walk, or none any more.
bool stop_asked(const hoap2_gait_t& gait) {
  const int32_t asked = gait.request.walk;
  return asked == HOAP2_WALK_REQUEST_STOP || (gait.on_request && asked != HOAP2_WALK_REQUEST_WALK);
}

}  // namespace

double ramp_s(const hoap2_params_t& params, const hoap2_gait_t& gait) {
  if (gait.swing_foot == 2) return params.cop_ramp_s;
  const double double_support_s = params.ds_fraction * gait.step_ticks * kTick_s;
  return params.cop_ramp_s < double_support_s ? params.cop_ramp_s : double_support_s;
}

bool ends_walk(const hoap2_params_t& params, const hoap2_gait_t& gait, int32_t index) {
  return stop_asked(gait) || (!gait.on_request && index == params.steps_forward + params.steps_in_place);
}

Advance advance_of(const hoap2_params_t& params, const hoap2_gait_t& gait, int32_t index) {
  if (stop_asked(gait)) return {0.0, 0.0, 0.0, true};
  if (gait.on_request) return {gait.advance[0], gait.advance[1], gait.advance[2], false};
  return {params.step_length_m, params.step_sideways_m, params.step_turn_rad, index > params.steps_forward};
}

int32_t step_ticks(double duration_s) { return static_cast<int32_t>(duration_s / kTick_s + 0.5); }

void begin_shift(const hoap2_params_t& params, hoap2_gait_t& gait) {
  const int stance = other(params.first_swing_foot);
  for (int i = 0; i < 3; ++i) gait.centre[i] = 0.5 * (gait.foot[0][i] + gait.foot[1][i]);
  for (int i = 0; i < 3; ++i) gait.advance[i] = 0.0;
  gait.on_request = gait.request.walk == HOAP2_WALK_REQUEST_WALK;
  gait.drawn_in = 0;
  gait.closing = 0;
  gait.walking = 1;
  gait.walk_done = 0;
  gait.step_index = 0;
  gait.steps_done = 0;
  gait.step_tick = 0;
  gait.step_ticks = step_ticks(params.start_shift_s);
  gait.swing_foot = 2;
  gait.phase = HOAP2_PHASE_DOUBLE_SUPPORT;
  capture_point_over(params, gait.foot[stance], stance, gait.cp_eos_m);
  for (int i = 0; i < 3; ++i) gait.land[i] = gait.land_nominal[i] = gait.foot[params.first_swing_foot][i];
  landing_control_reset(gait.centre[2], gait);
  plan_cop(params, hull_of_soles(gait.foot[0], gait.foot[1], params.cop_margin_m), params.start_shift_s,
           gait);
}

bool lay_step(const hoap2_params_t& params, const Advance& advance, bool last, hoap2_gait_t& gait) {
  const int stance = other(gait.swing_foot);
  advance_centre(advance, gait.swing_foot, gait.centre);
  footprint_beside(gait.centre, gait.swing_foot, params.step_width_m, gait.land_nominal);
  for (int i = 0; i < 3; ++i) gait.land[i] = gait.land_nominal[i];
  gait.heading_from_rad = gait.heading_rad;
  gait.heading_to_rad = 0.5 * (gait.foot[stance][2] + gait.land[2]);
  gait.advance[0] = advance.in_place ? 0.0 : advance.length_m;
  gait.advance[1] = advance.in_place ? 0.0 : advance.sideways_m;
  gait.advance[2] = advance.in_place ? 0.0 : advance.turn_rad;
  return plan_step(params, last, gait);
}

void begin_step(const hoap2_params_t& params, hoap2_gait_t& gait) {
  gait.swing_foot = gait.step_index == 0 ? params.first_swing_foot : other(gait.swing_foot);
  if (gait.request.walk == HOAP2_WALK_REQUEST_WALK) gait.on_request = 1;
  ++gait.step_index;
  gait.step_tick = 0;
  gait.step_ticks = step_ticks(params.step_time_s);
  const bool last = ends_walk(params, gait, gait.step_index);
  gait.closing = last;
  gait.drawn_in = 0;
  if (gait.on_request && !last)
    lay_requested_step(params, gait);
  else
    lay_step(params, advance_of(params, gait, gait.step_index), last, gait);
  if (!params.landing_control) return;
  shift_landing(params, last, gait);
  // The plan goes on as if no landing were shifted, but ends over the middle of the feet as they stand.
  if (params.lpc_moves_cp || last) plan_step(params, last, gait);
}

void end_step(hoap2_gait_t& gait) {
  for (int i = 0; i < 3; ++i) gait.foot[gait.swing_foot][i] = gait.land[i];
  for (int i = 0; i < 2; ++i) gait.foot_shift_m[gait.swing_foot][i] = gait.land_shift_m[i];
  ++gait.steps_done;
}

void begin_settling(const hoap2_params_t& params, hoap2_gait_t& gait) {
  gait.step_tick = 0;
  gait.step_ticks = step_ticks(4.0 / gait.omega_1_s);
  gait.phase = HOAP2_PHASE_DOUBLE_SUPPORT;
  const SupportPolygon polygon = hull_of_soles(gait.foot[0], gait.foot[1], params.cop_margin_m);
  const Point2 cp = {gait.com_m[0] + gait.com_rate_m_s[0] / gait.omega_1_s,
                     gait.com_m[1] + gait.com_rate_m_s[1] / gait.omega_1_s};
  const Point2 inside = clamp_cop(polygon, cp, cp, cp);
  for (int i = 0; i < 2; ++i) {
    gait.cp_start_m[i] = gait.cp_ref_m[i] = i == 0 ? cp.x : cp.y;
    gait.cop_step_m[i] = gait.cop_from_m[i] = gait.cp_eos_m[i] = i == 0 ? inside.x : inside.y;
  }
  // Outside the soles the pendulum would fall away from the clamped CoP: the reference gives up the part of
  // its rate that carries the capture point out.
  if (inside_distance(polygon, cp) < -kCapturePointLost_m) {
    gait.cp_lost = 1;
    gait.step_ticks *= 2;  // the CoM has farther to come
  }
  if (inside_distance(polygon, cp) < 0.0) {
    gait.com_rate_m_s[0] = gait.omega_1_s * (inside.x - gait.com_m[0]);
    gait.com_rate_m_s[1] = gait.omega_1_s * (inside.y - gait.com_m[1]);
  }
  gait.swing_foot = 2;
}

}  // namespace hoap2
