// Swing foot: quintics in x, y, yaw; two quintics up and down in z.
#ifndef HOAP2_GAIT_CP_SWING_HPP
#define HOAP2_GAIT_CP_SWING_HPP

#include "core/quintic.h"

namespace hoap2 {

// phase 0 at lift-off, 1 at touchdown. from and to: x (m), y (m), yaw (rad). out: x, y, z (m), yaw (rad).
inline void swing_foot(const double from[3], const double to[3], double apex_m, double phase, double out[4]) {
  const double s = hoap2_quintic(phase);
  out[0] = from[0] + s * (to[0] - from[0]);
  out[1] = from[1] + s * (to[1] - from[1]);
  out[3] = from[2] + s * (to[2] - from[2]);
  out[2] = apex_m * (phase < 0.5 ? hoap2_quintic(2.0 * phase) : hoap2_quintic(2.0 - 2.0 * phase));
}

}  // namespace hoap2
#endif
