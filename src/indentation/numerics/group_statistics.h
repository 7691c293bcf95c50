/* Comparison of two groups of moduli: values of their units and tests. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_NUMERICS_GROUP_STATISTICS_H
#define WT_INDENTATION_NUMERICS_GROUP_STATISTICS_H

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "weartrack/indentation.h"

typedef struct compare_units {
    double *value[2]; /* [n] ln E of the units of bulk and track at one rate */
    size_t n[2], curves[2];
    wt_rate_matching rate_matching;
    bool apart;            /* the groups have no rate in common */
    bool known;            /* the values are at one rate */
    double shift_variance; /* variance of the difference due to the slope within the spots */
    double slope, slope_error,
        slope_df; /* slope of ln E against ln rate within the spots; NaN if not known */
    double between_error, between_df; /* error of the difference, for WT_RATES_BETWEEN */
    double interaction_p;             /* p value of equal slopes in both groups; NaN if not known */
} compare_units;

/* Smallest number of spots that determine their scatter, for a comparison with a single spot. */
enum { COMPARE_MIN_SPOTS = 3 };

/* Standard error of the difference of two means, one of which has two units or more. `shift` adds
 * an error and `known` a normal variance. */
t_error compare_welch(moments a, moments b, t_error shift, double known);
void compare_ranks(const compare_units *units, arena *memory, wt_comparison *result);

#endif
