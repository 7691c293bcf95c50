/* Two groups of moduli: the values of their units, and the tests of these. Internal to fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_COMPARE_H
#define WEARTRACK_FIT_COMPARE_H

#include "base/pool.h"
#include "weartrack/fit.h"

typedef struct compare_units {
    double *value[2]; /* [n] ln E of the units of bulk and track, at one rate */
    size_t n[2], curves[2];
    wt_rates_by rates_by;
    bool apart;                          /* no rate in common */
    bool known;                          /* the values are at one rate */
    double shift_variance;               /* of the difference, by the slope within the spots */
    double slope, slope_error, slope_df; /* that slope; NaN if not known */
    double between_error, between_df;    /* of the difference, with WT_RATES_BETWEEN */
    double interaction_p;                /* of one slope in both groups; NaN if not known */
} compare_units;

wt_status compare_units_make(const wt_group *const groups[2], bool by_spot, pool *memory,
                             compare_units *units, wt_error *err) WT_NODISCARD;

typedef struct moments {
    double n, mean, variance; /* ddof 1; NaN for n < 2 */
} moments;

/* A standard error and its degrees of freedom, as Student's t has them. */
typedef struct t_error {
    double error, df;
} t_error;

moments compare_moments(const double *x, size_t n);
double compare_t_of_normal(double z, double df); /* beyond it lies as much of the law */
double compare_quantile(double df);              /* 97.5 % of Student's t */
/* Of the difference of two means, each of two units or more; `shift` adds to it, and `known` as a
 * normal variance. */
t_error compare_welch(moments a, moments b, t_error shift, double known);
t_error compare_sum(t_error part, double known);
wt_status compare_ranks(const compare_units *units, pool *memory, wt_comparison *result,
                        wt_error *err) WT_NODISCARD;

#endif
