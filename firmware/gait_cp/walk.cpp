#include <string.h>

#include "core/quintic.h"
#include "core/scalar_math.h"
#include "gait_cp/capture_point.hpp"
#include "gait_cp/footprints.hpp"
#include "gait_cp/gait_cp.h"
#include "gait_cp/landing_control.hpp"
#include "gait_cp/support_polygon.hpp"
#include "gait_cp/swing.hpp"
#include "gait_cp/tpcc.hpp"
#include "gait_cp/walk_plan.hpp"
#include "robot/body_map.hpp"

namespace hoap2 {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr int kReachSteps = 8;  // a step's geometry repeats after two steps
constexpr int kInPlaceSteps = 4;
constexpr double kReachExcess_m = 2e-4;  // draw-back of a leg that counts as out of reach

double clip(double value, double limit) { return value < -limit ? -limit : (value > limit ? limit : value); }

double step_time_s(const hoap2_gait_t& gait) { return gait.step_tick * kTick_s; }

// The capture point for the feedback laws: that of the CoM reference plus the low-passed deviation of the
// sensed one. The sensed point alone would close the laws' gain e^(omega dT) / (e^(omega dT) - 1) around the
// servo's lightly damped lateral mode; the reference answers at once, the deviation (tilt, push) at the
// filter's pace.
void track_capture_point(const hoap2_params_t& params, const hoap2_sense_t& sense, hoap2_gait_t& gait) {
  for (int i = 0; i < 2; ++i) {
    const double reference_m =
        gait.com_m[i] + gait.tpcc_m[i] + (gait.com_rate_m_s[i] + gait.tpcc_rate_m_s[i]) / gait.omega_1_s;
    const double raw_m =
        gait.feedback ? clip(sense.cp_O_m[i] - reference_m, params.cp_deviation_limit_m) : 0.0;
    gait.cp_deviation_m[i] += kTick_s / (params.cp_filter_s + kTick_s) * (raw_m - gait.cp_deviation_m[i]);
  }
}

// Share of the CoP ramp done after a time of the step; 1 without a ramp.
double ramp_share(const hoap2_params_t& params, const hoap2_gait_t& gait, double time_s) {
  if (params.cop_profile != HOAP2_COP_PROFILE_RAMP) return 1.0;
  const double done = time_s / ramp_s(params, gait);
  return done < 1.0 ? done : 1.0;
}

double ramped(const hoap2_gait_t& gait, int axis, double share) {
  return gait.cop_from_m[axis] + share * (gait.cop_step_m[axis] - gait.cop_from_m[axis]);
}

// Where the CoP may be: both soles in a double support without a swing foot and while a ramp leads from one
// foot to the other, else the sole of the stance foot.
SupportPolygon base_of_support(const hoap2_params_t& params, const hoap2_gait_t& gait) {
  if (gait.swing_foot == 2 || ramp_share(params, gait, step_time_s(gait)) < 1.0)
    return hull_of_soles(gait.foot[0], gait.foot[1], params.cop_margin_m);
  return sole_polygon(gait.foot[1 - gait.swing_foot], params.cop_margin_m);
}

// (7.11): horizon to the end of the step, floored because the law is singular there.
// (7.12): horizon of one control period, towards (7.10) at its end with the CoP of the plan held; so on the
// plan it is the CoP of the plan, along a ramp too.
void controlled_cop(const hoap2_params_t& params, const double plan_cop_m[2], hoap2_gait_t& gait) {
  const bool cps = params.cp_controller == HOAP2_CP_CONTROLLER_CPS;
  const double left_s = (gait.step_ticks - gait.step_tick) * kTick_s;
  const double horizon_s =
      cps ? (left_s > params.cps_min_dt_s ? left_s : params.cps_min_dt_s) : params.cpt_dt_s;
  const double growth = hoap2_exp(gait.omega_1_s * horizon_s);
  double cp[2];
  double cop[2];
  double target[2];
  for (int i = 0; i < 2; ++i) {
    cp[i] = gait.com_m[i] + gait.com_rate_m_s[i] / gait.omega_1_s + gait.cp_deviation_m[i];
    target[i] = cps ? gait.cp_eos_m[i] : capture_point_after(gait.cp_ref_m[i], plan_cop_m[i], growth);
    cop[i] = cop_for_capture_point(target[i], cp[i], growth);
  }
  const SupportPolygon polygon = base_of_support(params, gait);
  const Point2 inside = clamp_cop(polygon, {cop[0], cop[1]}, {cp[0], cp[1]}, {target[0], target[1]});
  gait.cop_m[0] = inside.x;
  gait.cop_m[1] = inside.y;
}

// The CoP of the plan over the tick to come: the mean of the ramp.
void planned_cop(const hoap2_params_t& params, const hoap2_gait_t& gait, double cop_m[2]) {
  const double share = ramp_share(params, gait, step_time_s(gait) + 0.5 * kTick_s);
  for (int i = 0; i < 2; ++i) cop_m[i] = ramped(gait, i, share);
}

// One tick of the pendulum: (7.13) and (7.10), composed tick by tick (exact for a CoP held over the tick).
// Under feedback the robot is where it is sensed to be, deviation away from the reference, and so is the
// pendulum that falls away from the CoP: the reference moves as if the CoP were shifted back by as much.
void pendulum_tick(bool controlled, const double plan_cop_m[2], hoap2_gait_t& gait) {
  for (int i = 0; i < 2; ++i) {
    const double cop_m = controlled ? gait.cop_m[i] - gait.cp_deviation_m[i] : gait.cop_m[i];
    pendulum_after(cop_m, gait.omega_1_s, gait.cosh_tick, gait.sinh_tick, gait.com_m[i],
                   gait.com_rate_m_s[i]);
    gait.cp_ref_m[i] = capture_point_after(gait.cp_ref_m[i], plan_cop_m[i], gait.exp_tick);
  }
}

void stand_still(hoap2_gait_t& gait) {
  for (int i = 0; i < 2; ++i) {
    gait.cop_m[i] = gait.cop_step_m[i] = gait.com_m[i];
    gait.com_rate_m_s[i] = 0.0;
    gait.cp_ref_m[i] = gait.cp_eos_m[i] = gait.com_m[i];
  }
  gait.phase = HOAP2_PHASE_STAND;
}

// What follows when a step, the shift or the settling has run its time.
void next_event(const hoap2_params_t& params, hoap2_gait_t& gait) {
  const bool settling = gait.swing_foot == 2 && gait.step_index > 0;
  if (settling) {
    gait.walking = 0;
    gait.walk_done = gait.closing && !gait.cp_lost;
    stand_still(gait);
    return;
  }
  if (gait.swing_foot != 2) end_step(gait);
  if (gait.closing || gait.stop_requested) {
    if (gait.step_index == 0) gait.step_index = 1;  // stopped before the first lift
    begin_settling(params, gait);
  } else {
    begin_step(params, gait);
  }
}

// Feet of this tick: phase, swing foot, heading.
void place_feet(const hoap2_params_t& params, hoap2_gait_t& gait) {
  double phase = 0.0;
  if (gait.swing_foot != 2) {
    const double along = static_cast<double>(gait.step_tick) / gait.step_ticks;
    phase = swing_phase(params, along);
    gait.phase = phase > 0.0 && phase < 1.0 ? HOAP2_PHASE_SINGLE_SUPPORT : HOAP2_PHASE_DOUBLE_SUPPORT;
    gait.heading_rad =
        gait.heading_from_rad + hoap2_quintic(along) * (gait.heading_to_rad - gait.heading_from_rad);
  }
  for (int foot = 0; foot < 2; ++foot) {
    const bool swings = foot == gait.swing_foot;
    double pose[4] = {gait.foot[foot][0], gait.foot[foot][1], 0.0, gait.foot[foot][2]};
    if (swings) swing_foot(gait.foot[foot], gait.land, params.lift_m, phase, pose);
    for (int i = 0; i < 3; ++i) gait.feet.pos_O_m[foot][i] = pose[i];
    gait.feet.yaw_O_rad[foot] = pose[3];
    gait.feet.support[foot] = !(swings && gait.phase == HOAP2_PHASE_SINGLE_SUPPORT);
  }
}

void map_to_joints(const hoap2_params_t& params, int passes, hoap2_gait_t& gait) {
  BodyTarget target;
  for (int i = 0; i < 2; ++i) target.com_O_m[i] = gait.com_m[i] + gait.tpcc_m[i];
  target.hip_height_m = params.hip_height_m;
  target.heading_rad = gait.heading_rad;
  for (int foot = 0; foot < 2; ++foot) {
    for (int i = 0; i < 3; ++i) target.foot_O_m[foot][i] = gait.feet.pos_O_m[foot][i];
    target.foot_yaw_rad[foot] = gait.feet.yaw_O_rad[foot];
  }
  const BodyMapResult result = body_map(target, passes, gait.com_over_base_B_m, gait.q_ref_rad);
  gait.pulled_back = result.excess_m > kReachExcess_m;
  gait.joint_limit = result.joint_limit;
}

// Standing with both feet moved ahead under the CoM, for landing position control: its legs trail or lead.
void find_com_by_legs(const hoap2_params_t& params, hoap2_gait_t& gait) {
  constexpr double kAhead_m = 0.01;
  hoap2_gait_t trial = gait;
  for (int foot = 0; foot < 2; ++foot) trial.foot[foot][0] += kAhead_m;
  place_feet(params, trial);
  map_to_joints(params, 30, trial);
  gait.com_by_legs = (trial.com_over_base_B_m[0] - gait.com_over_base_B_m[0]) / kAhead_m;
}

// What a tick of a trial walk shows to be impossible.
int32_t trial_fault(const hoap2_gait_t& trial, const double q_last_rad[HOAP2_SIZE_JOINT]) {
  if (trial.pulled_back || trial.joint_limit) return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
  if (trial.cp_lost) return HOAP2_FAULT_CAPTURE_POINT_LOST;
  if (trial.swing_foot != 2) {
    const int stance = 1 - trial.swing_foot;
    if (sole_clearance(trial.foot[stance], stance, trial.land) < kSoleClearance_m)
      return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
    // Nothing is sensed in a trial: a shift means that the walk is narrower than the shift may make it.
    if (trial.land_shift_m[0] != 0.0 || trial.land_shift_m[1] != 0.0)
      return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
  }
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) {
    const double rate_rad_s = (trial.q_ref_rad[i] - q_last_rad[i]) / kTick_s;
    const double limit_rad_s = kRateTolerance * HOAP2_JOINT[i].velocity_limit_rad_s;
    if (rate_rad_s > limit_rad_s || rate_rad_s < -limit_rad_s) return HOAP2_FAULT_JOINT_TOO_FAST;
  }
  return 0;
}

// Walks `trial` from standing in open loop, for so many steps and a settling; returns what is impossible.
int32_t try_walk(const hoap2_params_t& params, int steps, hoap2_gait_t& trial) {
  hoap2_sense_t blind;
  memset(&blind, 0, sizeof blind);
  trial.feedback = 0;
  hoap2_gait_start(&params, &trial);
  const int32_t ticks = step_ticks(4.0 / trial.omega_1_s) + step_ticks(params.start_shift_s) +
                        steps * step_ticks(params.step_time_s);
  int32_t fault = 0;
  for (int32_t tick = 0; tick < ticks && trial.walking; ++tick) {
    double q_last_rad[HOAP2_SIZE_JOINT];
    memcpy(q_last_rad, trial.q_ref_rad, sizeof q_last_rad);
    hoap2_gait_step(&params, &blind, &trial);
    fault |= trial_fault(trial, q_last_rad);
    // A knee that nears the straight leg is too fast before it is out of reach: the cause is told alone.
    if (fault & HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH) return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
  }
  return fault;
}

}  // namespace
}  // namespace hoap2

extern "C" {

void hoap2_gait_reset(const hoap2_params_t* params, hoap2_gait_t* gait) {
  memset(gait, 0, sizeof *gait);
  for (int foot = 0; foot < 2; ++foot)
    hoap2::footprint_beside(gait->centre, foot, HOAP2_STEP_WIDTH_M, gait->foot[foot]);
  hoap2::capture_point_between(*params, gait->foot[0], gait->foot[1], gait->com_m);
  gait->swing_foot = 2;
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) gait->q_ref_rad[i] = params->posture_rad[i];
  hoap2::stand_still(*gait);
  hoap2::place_feet(*params, *gait);
  hoap2::map_to_joints(*params, 30, *gait);
  const double com_height_m = params->hip_height_m + gait->com_over_base_B_m[2];
  gait->omega_1_s = hoap2_sqrt(hoap2::kGravity_m_s2 / com_height_m);
  gait->exp_tick = hoap2_exp(gait->omega_1_s * hoap2::kTick_s);
  gait->cosh_tick = 0.5 * (gait->exp_tick + 1.0 / gait->exp_tick);
  gait->sinh_tick = 0.5 * (gait->exp_tick - 1.0 / gait->exp_tick);
  hoap2::stand_still(*gait);
  hoap2::find_com_by_legs(*params, *gait);
  for (int i = 0; i < 2; ++i) gait->com_late_m[i] = gait->com_m[i];
}

int32_t hoap2_gait_check_reach(const hoap2_params_t* params, const hoap2_gait_t* gait) {
  if (gait->pulled_back || gait->joint_limit) return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
  if (params->behaviour != HOAP2_BEHAVIOUR_WALK_CP) return 0;
  hoap2_gait_t trial = *gait;
  return hoap2::try_walk(*params, hoap2::kReachSteps, trial);
}

int32_t hoap2_gait_check_in_place(const hoap2_params_t* params, const hoap2_gait_t* gait) {
  if (gait->pulled_back || gait->joint_limit) return HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH;
  hoap2_gait_t trial = *gait;
  trial.request = {{0.0, 0.0, 0.0}, HOAP2_WALK_REQUEST_WALK};
  return hoap2::try_walk(*params, hoap2::kInPlaceSteps, trial);
}

void hoap2_gait_start(const hoap2_params_t* params, hoap2_gait_t* gait) {
  const bool planned = gait->request.walk != HOAP2_WALK_REQUEST_WALK;
  if (planned && params->steps_forward + params->steps_in_place <= 0) {
    gait->walk_done = 1;
    return;
  }
  hoap2::begin_shift(*params, *gait);
}

void hoap2_gait_step(const hoap2_params_t* params, const hoap2_sense_t* sense, hoap2_gait_t* gait) {
  hoap2::track_capture_point(*params, *sense, *gait);
  hoap2::observe_deviation(*params, *sense, *gait);
  if (gait->walking) {
    const bool controlled = params->cp_controller != HOAP2_CP_CONTROLLER_PLAN;
    double plan_cop_m[2];
    hoap2::planned_cop(*params, *gait, plan_cop_m);
    if (controlled)
      hoap2::controlled_cop(*params, plan_cop_m, *gait);
    else
      memcpy(gait->cop_m, plan_cop_m, sizeof plan_cop_m);
    hoap2::pendulum_tick(controlled, plan_cop_m, *gait);
    ++gait->step_tick;
    if (gait->step_tick >= gait->step_ticks) hoap2::next_event(*params, *gait);
  }
  hoap2::place_feet(*params, *gait);
  hoap2::tpcc_step(*params, sense->cop_O_m, gait->feedback != 0, *gait);
  hoap2::map_to_joints(*params, 2, *gait);
}

}  // extern "C"
