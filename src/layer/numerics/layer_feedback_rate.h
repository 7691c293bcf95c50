/* Internal to the kernel room: the rate of formation under a layer that acts back on it, between
 * the bare surface and a balance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_FEEDBACK_RATE_H
#define WT_LAYER_NUMERICS_LAYER_FEEDBACK_RATE_H

#include "layer/numerics/layer_kernel.h"

typedef struct own_panel {
    double low, high;
    struct gsl_cheb_series_struct *value, *slope; /* of ln Qf */
} own_panel;

/* Each is as long as all before it: no layer is 2^64 times as thick as the shortest wave. */
enum { OWN_PANELS = 64 };
typedef struct feedback_rate {
    double target; /* where the motion ends [m] */
    size_t n;
    own_panel panel[OWN_PANELS];
} feedback_rate;

/* ln Qf at a thickness under itself. */
typedef double (*own_fn)(double thickness, void *user);
/* Panels from 0 to the target, of which the first is as long as `first`. */
wt_status feedback_rate_make(own_fn f, void *user, double first, double target, feedback_rate *own,
                             wt_error *err) WT_NODISCARD;
void feedback_rate_clear(feedback_rate *own);
double feedback_rate_log(const feedback_rate *own, double thickness);
double feedback_rate_slope(const feedback_rate *own, double thickness);

#endif
