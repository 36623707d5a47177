/* The only door to transcendental functions, so that they can be made portable to the bit in one place. */
#ifndef HOAP2_CORE_SCALAR_MATH_H
#define HOAP2_CORE_SCALAR_MATH_H

#include <math.h>

static inline double hoap2_sin(double x) { return sin(x); }
static inline double hoap2_cos(double x) { return cos(x); }
static inline double hoap2_tan(double x) { return tan(x); }
static inline double hoap2_asin(double x) { return asin(x); }
static inline double hoap2_acos(double x) { return acos(x); }
static inline double hoap2_atan2(double y, double x) { return atan2(y, x); }
static inline double hoap2_sqrt(double x) { return sqrt(x); }
static inline double hoap2_hypot(double x, double y) { return hypot(x, y); }
static inline double hoap2_exp(double x) { return exp(x); }
static inline double hoap2_log(double x) { return log(x); }

#endif
