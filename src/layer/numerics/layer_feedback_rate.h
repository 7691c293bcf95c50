/* Rate of formation under a layer with feedback, between the bare surface and a balance. Internal
 * to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_FEEDBACK_RATE_H
#define WT_LAYER_NUMERICS_LAYER_FEEDBACK_RATE_H

#include "layer/numerics/layer_kernel.h"

typedef struct feedback_subinterval {
    double low, high;
    struct gsl_cheb_series_struct *value, *slope; /* of ln Qf */
} feedback_subinterval;

/* Each subinterval is as long as all before it: a layer is never 2^64 times as thick as the
 * shortest wave. */
enum { FEEDBACK_SUBINTERVALS = 64 };
typedef struct feedback_rate {
    double target; /* final thickness [m] */
    size_t n;
    feedback_subinterval subinterval[FEEDBACK_SUBINTERVALS];
} feedback_rate;

/* ln Qf under a layer of this thickness. */
typedef double (*feedback_formation_fn)(double thickness, void *user);
/* Creates subintervals from 0 to the target; the first has the length `first`. The caller clears
 * the rate, also on failure. */
wt_status feedback_rate_create(feedback_formation_fn f, void *user, double first, double target,
                               feedback_rate *feedback, wt_error *err) WT_NODISCARD;
void feedback_rate_clear(feedback_rate *feedback);
double feedback_rate_log(const feedback_rate *feedback, double thickness);
double feedback_rate_slope(const feedback_rate *feedback, double thickness);

#endif
