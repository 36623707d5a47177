#include "gait_cp/footprints.hpp"

#include "core/scalar_math.h"
#include "gait_cp/plane.hpp"
#include "hoap2/generated/robot_model.h"

namespace hoap2 {
namespace {

void offset_point(const double footprint[3], double ahead_m, double left_m, double point_m[2]) {
  const double c = hoap2_cos(footprint[2]);
  const double s = hoap2_sin(footprint[2]);
  point_m[0] = footprint[0] + c * ahead_m - s * left_m;
  point_m[1] = footprint[1] + s * ahead_m + c * left_m;
}

}  // namespace

void footprint_beside(const double centre[3], int foot, double step_width_m, double footprint[3]) {
  offset_point(centre, 0.0, 0.5 * side(foot) * step_width_m, footprint);
  footprint[2] = centre[2];
}

void advance_centre(const Advance& advance, int swing_foot, double centre[3]) {
  if (advance.in_place) return;
  const double left_m = advance.sideways_m * side(swing_foot) > 0.0 ? 2.0 * advance.sideways_m : 0.0;
  const double yaw_rad = advance.turn_rad * side(swing_foot) > 0.0 ? 2.0 * advance.turn_rad : 0.0;
  double mid[3] = {centre[0], centre[1], centre[2] + 0.5 * yaw_rad};
  offset_point(mid, advance.length_m, left_m, centre);
  centre[2] += yaw_rad;
}

void capture_point_over(const hoap2_params_t& params, const double footprint[3], int foot,
                        double point_m[2]) {
  offset_point(footprint, params.cp_offset_x_m, -side(foot) * params.cp_offset_inward_m, point_m);
}

void capture_point_between(const hoap2_params_t& params, const double right[3], const double left[3],
                           double point_m[2]) {
  const double middle[3] = {0.5 * (right[0] + left[0]), 0.5 * (right[1] + left[1]),
                            0.5 * (right[2] + left[2])};
  offset_point(middle, params.cp_offset_x_m, 0.0, point_m);
}

double sole_clearance(const double stance[3], int stance_foot, const double other[3]) {
  const double outward = -side(stance_foot);  // from the stance foot to the other one
  const double c = hoap2_cos(stance[2]);
  const double s = hoap2_sin(stance[2]);
  double least_m = 1e300;
  const double along_m[2] = {HOAP2_ANKLE_TO_TOE_M, -HOAP2_ANKLE_TO_HEEL_M};
  for (int i = 0; i < 2; ++i) {
    double corner[2];
    offset_point(other, along_m[i], -outward * HOAP2_SOLE_HALF_WIDTH_M, corner);
    const double lateral_m = -s * (corner[0] - stance[0]) + c * (corner[1] - stance[1]);
    const double clearance_m = outward * lateral_m - HOAP2_SOLE_HALF_WIDTH_M;
    if (clearance_m < least_m) least_m = clearance_m;
  }
  return least_m;
}

}  // namespace hoap2
