/* Rate of formation under a layer with feedback, between the bare surface and a balance. Internal
 * to layer.
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

/* Each subinterval is as long as all before it: a layer is never 2^64 times as thick as the
 * shortest wave. */
enum { OWN_PANELS = 64 };
typedef struct feedback_rate {
    double target; /* final thickness [m] */
    size_t n;
    own_panel panel[OWN_PANELS];
} feedback_rate;

/* ln Qf under a layer of this thickness. */
typedef double (*own_fn)(double thickness, void *user);
/* Creates subintervals from 0 to the target; the first has the length `first`. The caller clears
 * the rate, also on failure. */
wt_status feedback_rate_make(own_fn f, void *user, double first, double target, feedback_rate *own,
                             wt_error *err) WT_NODISCARD;
void feedback_rate_clear(feedback_rate *own);
double feedback_rate_log(const feedback_rate *own, double thickness);
double feedback_rate_slope(const feedback_rate *own, double thickness);

#endif
