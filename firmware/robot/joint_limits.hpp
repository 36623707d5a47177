// Soft joint limits: one degree inside the stops.
#ifndef HOAP2_ROBOT_JOINT_LIMITS_HPP
#define HOAP2_ROBOT_JOINT_LIMITS_HPP

#include <stdint.h>

#include "hoap2/generated/robot_model.h"

namespace hoap2 {

// Angles beyond a limit by less than this are rounding, clipped without being counted.
constexpr double kLimitTolerance_rad = 1e-9;

// The angle within the soft limits of a joint; NaN becomes the lower limit. `clipped` is set (never
// cleared) when the angle was outside by more than the tolerance.
double clip_joint(int joint, double q_rad, bool& clipped);

// Clips all joints in place. Bit j of the answer: joint j was outside.
int32_t clip_to_soft_limits(double q_rad[HOAP2_JOINTS]);

}  // namespace hoap2
#endif
