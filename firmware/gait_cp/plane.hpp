// Small helpers for points of the ground.
#ifndef HOAP2_GAIT_CP_PLANE_HPP
#define HOAP2_GAIT_CP_PLANE_HPP

#include "core/scalar_math.h"

namespace hoap2 {

inline double absolute(double value) { return value < 0.0 ? -value : value; }

// +1 for the left foot, -1 for the right: the side on which a foot stands.
inline double side(int foot) { return foot == 1 ? 1.0 : -1.0; }

// A vector given along and across a direction, in the axes of the ground.
inline void to_ground(const double axes_rad, const double along_across[2], double ground[2]) {
  const double c = hoap2_cos(axes_rad);
  const double s = hoap2_sin(axes_rad);
  ground[0] = c * along_across[0] - s * along_across[1];
  ground[1] = s * along_across[0] + c * along_across[1];
}

// The other way.
inline void from_ground(const double axes_rad, const double ground[2], double along_across[2]) {
  const double c = hoap2_cos(axes_rad);
  const double s = hoap2_sin(axes_rad);
  along_across[0] = c * ground[0] + s * ground[1];
  along_across[1] = -s * ground[0] + c * ground[1];
}

}  // namespace hoap2
#endif
