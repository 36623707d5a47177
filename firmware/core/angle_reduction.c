#include "core/angle_reduction.h"

#include <math.h>

enum { LIMBS = 6, LIMB_BITS = 32, WINDOW_BITS = LIMBS * LIMB_BITS, TABLE_LIMBS = 38 };

/* 2/pi, binary digits behind the point. */
static const uint32_t kTwoOverPi[TABLE_LIMBS] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};

/* pi/2 in parts of 33 bits and the rest: their products with a quadrant number of 20 bits are exact. */
static const double kPart1 = 0x1.921fb544p+0, kPart2 = 0x1.0b4611a6p-34, kPart3 = 0x1.3198a2ep-69;
static const double kPart4 = 0x1.b839a252049c1p-104;
static const double kHalfPi_hi = 0x1.921fb54442d18p+0, kHalfPi_lo = 0x1.1a62633145c07p-54;
static const double kTwoOverPi_1 = 0x1.45f306dc9c883p-1;
static const double kNear = 1647099.0; /* about 2^20 quarter turns */

/* Subtract the multiple of pi/2 part by part; the parts cancel without any rounding. */
static hoap2_dd_t reduce_near(double x, int *quadrant) {
  const double turns = floor(x * kTwoOverPi_1 + 0.5);
  const double first = x - turns * kPart1;
  const hoap2_dd_t second = hoap2_dd_sum(first, -(turns * kPart2));
  const hoap2_dd_t third = hoap2_dd_sum(second.hi, -(turns * kPart3));
  *quadrant = (int)((int64_t)turns & 3);
  return hoap2_dd_sum(third.hi, third.lo + second.lo - turns * kPart4);
}

/* 32 digits of 2/pi from digit `from` on; there are zeros before the point. */
static uint32_t digits(int from) {
  const int limb = from >= 0 ? from / LIMB_BITS : -((LIMB_BITS - 1 - from) / LIMB_BITS);
  const int shift = from - LIMB_BITS * limb;
  const uint64_t left = limb >= 0 && limb < TABLE_LIMBS ? kTwoOverPi[limb] : 0;
  const uint64_t right = limb + 1 >= 0 && limb + 1 < TABLE_LIMBS ? kTwoOverPi[limb + 1] : 0;
  return (uint32_t)((((left << LIMB_BITS) | right) << shift) >> LIMB_BITS);
}

/* fraction (of 4 quadrants, most significant limb first) = mantissa * 2^exponent * 2/pi, mod 4. */
static void multiply(uint64_t mantissa, int exponent, uint32_t fraction[LIMBS]) {
  const uint64_t factor[2] = {mantissa & 0xffffffffu, mantissa >> LIMB_BITS};
  uint32_t window[LIMBS];
  for (int i = 0; i < LIMBS; ++i) {
    window[i] = digits(exponent - 2 + LIMB_BITS * i);
    fraction[i] = 0;
  }
  for (int f = 0; f < 2; ++f) {
    uint64_t carry = 0;
    for (int i = LIMBS - 1; i - f >= 0; --i) {
      const uint64_t sum = factor[f] * window[i] + fraction[i - f] + carry;
      fraction[i - f] = (uint32_t)sum;
      carry = sum >> LIMB_BITS;
    }
  }
}

/* The fraction without its quadrant, in -1/2 .. 1/2 of one, as hi + lo. */
static hoap2_dd_t part_of_quadrant(uint32_t fraction[LIMBS], int *quadrant) {
  *quadrant = (int)(fraction[0] >> 30);
  const int upper_half = (fraction[0] >> 29) & 1;
  if (upper_half) { /* one quadrant on, the part that is missing to it: the negative of all digits */
    *quadrant = (*quadrant + 1) & 3;
    uint64_t carry = 1;
    for (int i = LIMBS - 1; i >= 0; --i) {
      carry += (uint32_t)~fraction[i];
      fraction[i] = (uint32_t)carry;
      carry >>= LIMB_BITS;
    }
  }
  fraction[0] &= 0x3fffffffu;
  /* Limbs that differ by 32 digits do not overlap, so these sums lose nothing that counts. */
  hoap2_dd_t sum = {0.0, 0.0};
  for (int i = LIMBS - 1; i >= 0; --i) {
    const hoap2_dd_t next = hoap2_dd_sum(fraction[i] * hoap2_power_of_2(2 - LIMB_BITS * (i + 1)), sum.hi);
    sum = hoap2_dd_sum(next.hi, next.lo + sum.lo);
  }
  if (upper_half) {
    sum.hi = -sum.hi;
    sum.lo = -sum.lo;
  }
  return sum;
}

/* M. H. Payne and R. N. Hanek, "Radian reduction for trigonometric functions", SIGNUM 18 (1983): of the digits of 2/pi
 * only those are multiplied that decide the place within the turn. */
static hoap2_dd_t reduce_far(double x, int *quadrant) {
  const uint64_t bits = hoap2_bits_of(x);
  const uint64_t mantissa = (bits & 0xfffffffffffffu) | 0x10000000000000u;
  uint32_t fraction[LIMBS];
  multiply(mantissa, hoap2_exponent_of(x) - 52, fraction);
  hoap2_dd_t part = part_of_quadrant(fraction, quadrant);
  hoap2_dd_t angle = hoap2_dd_product(part.hi, kHalfPi_hi);
  angle.lo += part.hi * kHalfPi_lo + part.lo * kHalfPi_hi;
  angle = hoap2_dd_sum(angle.hi, angle.lo);
  if (bits >> 63) {
    angle.hi = -angle.hi;
    angle.lo = -angle.lo;
    *quadrant = -*quadrant & 3;
  }
  return angle;
}

hoap2_dd_t hoap2_reduce_angle(double x, int *quadrant) {
  return x < kNear && x > -kNear ? reduce_near(x, quadrant) : reduce_far(x, quadrant);
}
