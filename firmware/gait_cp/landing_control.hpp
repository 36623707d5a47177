// Landing position control: section 7.3.1, (7.14).
//
// What the landing is shifted by is kept along and across the walk's present direction, which is that of the
// nominal footprint of the step under way; so a walk that turns takes its shift along.
#ifndef HOAP2_GAIT_CP_LANDING_CONTROL_HPP
#define HOAP2_GAIT_CP_LANDING_CONTROL_HPP

#include "gait_cp/gait_state.h"

namespace hoap2 {

// Forgets everything: a walk begins in the direction heading_rad.
void landing_control_reset(double heading_rad, hoap2_gait_t& gait);

// One tick: the deviation of the sensed CoM from its reference, and the extreme of the step under way.
void observe_deviation(const hoap2_params_t& params, const hoap2_sense_t& sense, hoap2_gait_t& gait);

// (7.14): shift of the next step from the extreme deviation during this one and the shift of this one; both
// of one axis, along or across. Below the threshold a deviation counts as none.
double next_shift(double extreme_m, double shift_m, double threshold_m, double gain, double forget);

// When a step has been planned: moves its landing from the nominal footprint (gait.land_nominal) to the
// shifted one (gait.land). last: the step that brings the feet side by side.
void shift_landing(const hoap2_params_t& params, bool last, hoap2_gait_t& gait);

}  // namespace hoap2
#endif
