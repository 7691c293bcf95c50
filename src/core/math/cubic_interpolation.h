/* Akima interpolation of points. Internal to math.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CUBIC_INTERPOLATION_H
#define WT_CORE_MATH_CUBIC_INTERPOLATION_H

#include <stddef.h>

/* Smallest number of points. Akima's curve does not oscillate next to a step. */
enum { AKIMA_POINTS_MIN = 5 };
typedef struct curve curve;

/* Creates a curve through n points with increasing x; NULL when out of memory. */
curve *akima_curve_new(const double *x, const double *y, size_t n);
/* Returns the value at x, which is between the first and the last point. */
double akima_curve_value(const curve *c, double x);
void akima_curve_free(curve *c);

#endif
