/* The only door to functions whose bits differ between mathematical libraries.
 *
 * Each result is within 1 ulp of the true value and the same to the bit on every machine with IEEE 754 double
 * arithmetic, round to nearest, and no contraction of a*b+c (-ffp-contract=off). NaN in, NaN out. Nothing sets errno.
 */
#ifndef HOAP2_CORE_SCALAR_MATH_H
#define HOAP2_CORE_SCALAR_MATH_H

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Angles in rad, of any size; NaN for an infinite one. */
double hoap2_sin(double x);
double hoap2_cos(double x);
/* Angle of the point (x, y), in [-pi, pi]; signed zeros and infinities as in C's Annex F. */
double hoap2_atan2(double y, double x);
/* sqrt(x*x + y*y) without overflow on the way. */
double hoap2_hypot(double x, double y);
double hoap2_exp(double x);

/* IEEE 754 asks for the exact rounding here. */
static inline double hoap2_sqrt(double x) { return sqrt(x); }

#ifdef __cplusplus
}
#endif
#endif
