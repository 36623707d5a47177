/* Rest-to-rest quintic: value and slopes 0 at 0; 1, 0, 0 at 1. */
#ifndef HOAP2_CORE_QUINTIC_H
#define HOAP2_CORE_QUINTIC_H

/* phase outside [0, 1] gives the end values. */
static inline double hoap2_quintic(double phase) {
  if (!(phase > 0.0)) return 0.0;
  if (phase >= 1.0) return 1.0;
  return phase * phase * phase * (10.0 + phase * (-15.0 + 6.0 * phase));
}

#endif
