/* Numbers as unevaluated sums hi + lo of two doubles, about 106 bits. T. J. Dekker, "A floating-point technique for
 * extending the available precision", Numer. Math. 18 (1971); D. E. Knuth, TAOCP 2, 4.2.2. */
#ifndef HOAP2_CORE_DOUBLE_DOUBLE_H
#define HOAP2_CORE_DOUBLE_DOUBLE_H

#include <stdint.h>
#include <string.h>

typedef struct {
  double hi, lo;
} hoap2_dd_t;

/* a + b exactly. */
static inline hoap2_dd_t hoap2_dd_sum(double a, double b) {
  const double s = a + b;
  const double part = s - a;
  const hoap2_dd_t exact = {s, (a - (s - part)) + (b - part)};
  return exact;
}

/* a * b exactly, while the product is far from overflow and underflow. */
static inline hoap2_dd_t hoap2_dd_product(double a, double b) {
  const double split = 134217729.0; /* 2^27 + 1 */
  const double sa = split * a, sb = split * b;
  const double a_hi = sa - (sa - a), b_hi = sb - (sb - b);
  const double a_lo = a - a_hi, b_lo = b - b_hi;
  const double p = a * b;
  const hoap2_dd_t exact = {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
  return exact;
}

static inline uint64_t hoap2_bits_of(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static inline double hoap2_of_bits(uint64_t bits) {
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* 2^exponent, exponent in -1022 .. 1023. */
static inline double hoap2_power_of_2(int exponent) { return hoap2_of_bits((uint64_t)(exponent + 1023) << 52); }

/* floor(log2 |x|) of a normal number; below -1022 for any other that is finite. */
static inline int hoap2_exponent_of(double x) { return (int)((hoap2_bits_of(x) >> 52) & 0x7ff) - 1023; }

#endif
