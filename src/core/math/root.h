/* Roots and maxima of functions of one variable. Internal to the library. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_MATH_ROOT_H
#define WT_CORE_MATH_ROOT_H

#include "weartrack/core.h"

typedef double (*root_fn)(double x, void *user);

/* Finds a root between low and high, where f has different signs, to within `close`; 0: to the last
 * digits. */
wt_status root_find(root_fn f, void *user, double low, double high, double close, double *root,
                    wt_error *err) WT_NODISCARD;

/* Condition that holds below a position and not above it. */
typedef bool (*root_predicate)(double x, void *user);
/* Bisects the interval that contains this position. It stops when the width is below `close` times
 * the larger limit, after `most` steps, or at neighbouring numbers. It is meant for functions with
 * jumps or without a value on one side. For smooth functions root_find is faster. */
void root_bisect(root_predicate below, void *user, double *low, double *high, double close,
                 int most);

/* Returns the position of the single maximum between low and high after `sections` golden sections.
 * Each leaves 0.618 of the range (J. Kiefer, Proc. Am. Math. Soc. 4 (1953) 502). */
double root_maximum(root_fn f, void *user, double low, double high, int sections);

/* Returns the displacement of the root when f, which decreases there, changes by `error`. The
 * search starts at the distance `reach`, with steps of at least `least`. */
double root_displacement(root_fn f, void *user, double root, double error, double reach,
                         double least);

#endif
