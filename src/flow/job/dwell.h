/* Means over the dwells of several curves. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_DWELL_H
#define WEARTRACK_FLOW_DWELL_H

#include "weartrack/flow.h"

/* At one frequency: of curves, or of files where there are three or more. The interval holds the
 * scatter and what all of them have in common, that of one curve its own error; NaN where no curve
 * is described. */
typedef struct dwell_mean {
    double angular_frequency;
    size_t n, n_units;
    wt_interval storage, loss;
} dwell_mean;

/* Of a table dwell_moduli, with rising frequency; *means to be freed. */
wt_status dwell_means(const wt_table *moduli, dwell_mean **means, size_t *n,
                      wt_error *err) WT_NODISCARD;

#endif
