/* Internal to the library: roots of monotone functions, and the place of a maximum.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_MATH_ROOT_H
#define WT_CORE_MATH_ROOT_H

#include "weartrack/base.h"

#include <stdbool.h>

typedef double (*root_fn)(double x, void *user);

/* A root between low and high, where f has different signs, to within `close`; 0: to the last
 * digits. */
wt_status root_find(root_fn f, void *user, double low, double high, double close, double *root,
                    wt_error *err) WT_NODISCARD;

/* What holds below a place and not above it. */
typedef bool (*root_below)(double x, void *user);
/* Brings both ends to that place by halves, until they are no farther apart than `close` of the
 * larger one or `most` times; never closer than neighbouring numbers. For what jumps, or has no
 * value on one side; where a function is smooth, root_find is quicker. */
void root_halve(root_below below, void *user, double *low, double *high, double close, int most);

/* The place of the one maximum between low and high by so many golden sections, each of which
 * leaves 0.618 of the range (J. Kiefer, Proc. Am. Math. Soc. 4 (1953) 502). */
double root_maximum(root_fn f, void *user, double low, double high, int sections);

/* How far the root moves when f, which falls there, moves by `error`: found by going there, from
 * `reach` on and by `least` at least. */
double root_reach(root_fn f, void *user, double root, double error, double reach, double least);

#endif
