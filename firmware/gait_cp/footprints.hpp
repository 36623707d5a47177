// Footprints of a walk: section 7.2.2 a.
//
// The walking centre advances by (L_x, sideways) and turns by L_theta a step; a foot lands beside it at half
// the step width. Sideways and turning advances are taken twice by the step of the foot on that side and not
// at all by the other one, so that the legs never cross and the toes never meet.
#ifndef HOAP2_GAIT_CP_FOOTPRINTS_HPP
#define HOAP2_GAIT_CP_FOOTPRINTS_HPP

#include "hoap2/generated/signals.h"

namespace hoap2 {

// The footprint of `foot` (0 right, 1 left) beside a centre (x, y, yaw).
void footprint_beside(const double centre[3], int foot, double step_width_m, double footprint[3]);

// L_x, the sideways advance and L_theta (left positive) of a step.
struct Advance {
  double length_m;
  double sideways_m;
  double turn_rad;
  bool in_place;  // none of them counts
};

// Moves the centre by one step of the swing foot.
void advance_centre(const Advance& advance, int swing_foot, double centre[3]);

// Where the capture point shall be over a single footprint: ahead of the ankle and inward by the offsets of
// the parameters (section 7.2.2 b).
void capture_point_over(const hoap2_params_t& params, const double footprint[3], int foot, double point_m[2]);

// The same over the middle of two footprints: ahead only.
void capture_point_between(const hoap2_params_t& params, const double right[3], const double left[3],
                           double point_m[2]);

// Clearance across between two soles side by side; below 0 they may overlap. Measured along the lateral axis
// of `stance` between the corner of the one and the edge of the other.
double sole_clearance(const double stance[3], int stance_foot, const double other[3]);

}  // namespace hoap2
#endif
