/* Internal to the kernel room: a smooth curve through points.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_MATH_CUBIC_INTERPOLATION_H
#define WT_CORE_MATH_CUBIC_INTERPOLATION_H

#include <stddef.h>

/* Akima's curve, which does not swing beside a step; it needs so many points. */
enum { CURVE_LEAST_POINTS = 5 };
typedef struct curve curve;

/* x rises. NULL when out of memory. */
curve *curve_new(const double *x, const double *y, size_t n);
/* Between the first x and the last. */
double curve_at(const curve *c, double x);
void curve_free(curve *c);

#endif
