// Events of the walk: what is decided when a step begins and ends.
#ifndef HOAP2_GAIT_CP_WALK_PLAN_HPP
#define HOAP2_GAIT_CP_WALK_PLAN_HPP

#include "gait_cp/footprints.hpp"
#include "gait_cp/gait_state.h"

namespace hoap2 {

constexpr double kTick_s = 1e-6 * HOAP2_TICK_US;
constexpr double kSoleClearance_m = 2e-3;  // least gap between the soles in a landing
constexpr double kRateTolerance = 1.2;     // joint rate of the plan against the limit

// Does step number `index` (from 1), still to be laid, end the walk? By the parameters or because the
// operator asks for it.
bool ends_walk(const hoap2_params_t& params, const hoap2_gait_t& gait, int32_t index);

// Advance of that step. Of a walk on request it is that of the step under way: what the legs can do of it.
Advance advance_of(const hoap2_params_t& params, const hoap2_gait_t& gait, int32_t index);

// The shift before the first lift: the capture point goes to the first stance foot (step index 0). The walk
// begins where the feet stand, side by side.
void begin_shift(const hoap2_params_t& params, hoap2_gait_t& gait);

// Step number step_index + 1: landing target, end-of-step capture point, CoP (7.9), clamp.
void begin_step(const hoap2_params_t& params, hoap2_gait_t& gait);

// Footprint, heading, end-of-step capture point and CoP of the step under way. False when the CoP had to be
// shifted into the sole.
bool lay_step(const hoap2_params_t& params, const Advance& advance, bool last, hoap2_gait_t& gait);

// The swing foot has landed.
void end_step(hoap2_gait_t& gait);

// After the last step: the CoP stays where the capture point is, and the CoM comes to rest there.
void begin_settling(const hoap2_params_t& params, hoap2_gait_t& gait);

// Length of the CoP ramp of the step under way: cop_ramp_s, but no longer than the double support the step
// begins with, because the CoP it leaves lies under the foot about to lift.
double ramp_s(const hoap2_params_t& params, const hoap2_gait_t& gait);

// Phase of the swing (0 lift-off, 1 touchdown, beyond on the floor) at a part of the step.
inline double swing_phase(const hoap2_params_t& params, double part) {
  return (part - params.ds_fraction) / (1.0 - 2.0 * params.ds_fraction);
}

// Duration of a step or of the shift in ticks.
int32_t step_ticks(double duration_s);

}  // namespace hoap2
#endif
