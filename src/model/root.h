/* Internal to the library: roots of monotone functions.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_MODEL_ROOT_H
#define WT_MODEL_ROOT_H

#include "weartrack/base.h"

typedef double (*root_fn)(double x, void *user);

/* A root between low and high, where f has different signs, to within `close`; 0: to the last
 * digits. */
wt_status root_find(root_fn f, void *user, double low, double high, double close, double *root,
                    wt_error *err) WT_NODISCARD;

/* How far the root moves when f, which falls there, moves by `error`: found by going there, from
 * `reach` on and by `least` at least. */
double root_reach(root_fn f, void *user, double root, double error, double reach, double least);

#endif
