/* x = quadrant pi/2 + angle, |angle| <= pi/4 (a little more by rounding), for any finite x. */
#ifndef HOAP2_CORE_ANGLE_REDUCTION_H
#define HOAP2_CORE_ANGLE_REDUCTION_H

#include "core/double_double.h"

/* Returns the angle; *quadrant is 0 .. 3. */
hoap2_dd_t hoap2_reduce_angle(double x, int *quadrant);

#endif
