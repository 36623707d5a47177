// Swing foot: quintics in x, y, yaw; one symmetric sextic in z.
#ifndef HOAP2_GAIT_CP_SWING_HPP
#define HOAP2_GAIT_CP_SWING_HPP

#include "core/quintic.h"

namespace hoap2 {

// phase 0 at lift-off, 1 at touchdown. from and to: x (m), y (m), yaw (rad). out: x, y, z (m), yaw (rad).
// The sextic 64 u^3 (1-u)^3 starts and ends with rate and acceleration zero like a pair of quintics, with 9 %
// less peak rate: the knee has little to spare below its velocity limit.
inline void swing_foot(const double from[3], const double to[3], double apex_m, double phase, double out[4]) {
  const double s = hoap2_quintic(phase);
  out[0] = from[0] + s * (to[0] - from[0]);
  out[1] = from[1] + s * (to[1] - from[1]);
  out[3] = from[2] + s * (to[2] - from[2]);
  const double u = phase > 0.0 && phase < 1.0 ? 4.0 * phase * (1.0 - phase) : 0.0;
  out[2] = apex_m * u * u * u;
}

}  // namespace hoap2
#endif
