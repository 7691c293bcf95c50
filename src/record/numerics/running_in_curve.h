/* A predicted course of friction in a series of cycles: how much slower or faster it runs there,
 * and how much more or less friction changes. Internal to record and to the job of the same name.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H
#define WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H

#include "record/numerics/autocorrelation.h"
#include "weartrack/base.h"

/* Friction less that in the end, at times in equal ratios; before the first of them it is as there,
 * behind the last as in the end. */
typedef struct course {
    size_t n;
    double log_first, log_step; /* of the times [s] */
    const double *value;        /* [n] */
} course;
double running_in_curve_at(const course *c, double log_time);
/* The largest change that is left at any time. */
double running_in_curve_height(const course *c);
/* The last time at which `share` of that is left; NaN: the times do not hold it. */
double running_in_curve_settled(const course *c, double share);

/* Means over equal numbers of cycles. */
typedef struct running_in_series {
    size_t n;
    double begin;     /* of the first; 0 unless what was before it is not known */
    double *end;      /* [n] from the start on; each begins where the one before ends */
    double *friction; /* [n] */
} running_in_series;
wt_status running_in_series_new(size_t n, running_in_series *s, wt_error *err) WT_NODISCARD;
void running_in_series_clear(running_in_series *s);

typedef struct running_in_curve_pair {
    const running_in_series *series;
    const course *course; /* predicted for it */
} running_in_curve_pair;

/* friction = level + ratio x course(time / factor), with slow and white scatter of one law from end
 * to end; likelihood averaged over laws and, but for the factor itself, over factors. Several
 * series have factor and ratio in common, and a level and a law each. */
#define COURSE_ODDS 20 /* as of the running-in: one false alarm in twenty at most */
typedef struct running_in_curve_fit {
    bool seen;         /* odds above COURSE_ODDS to 1 over a constant */
    double log_odds;   /* ln of them */
    double log_factor; /* mean; NaN unless seen */
    double error;      /* standard deviation */
    double low, high;  /* 95 %; NaN: the series does not tell that end */
    double ratio, ratio_error;
    double level;    /* of the likeliest, in the first series */
    double scatter;  /* likewise, the variance of the means about it */
    scatter_law law; /* likewise */
} running_in_curve_fit;

/* `expected`: standard deviation of the logarithm of the factor about 1 before the series is seen,
 * which tells the ratio where no course is seen. WT_E_RANGE of fewer than COURSE_FEWEST means. */
enum { COURSE_FEWEST = 16 };
wt_status running_in_curve_fit_make(const running_in_curve_pair *of, size_t n, double settled_share,
                                    double expected, running_in_curve_fit *fit,
                                    wt_error *err) WT_NODISCARD;
/* The likeliest factor and ratio of another course by one law, the factor sought within `within`
 * about `around`, or held there if that is 0. */
typedef struct running_in_optimum {
    double log_factor, ratio, level;
} running_in_optimum;
running_in_optimum running_in_optimum_find(const running_in_series *s, const course *c,
                                           scatter_law law, double around, double within);

#endif
