/* Parts of the job that holds the running-in of records against a growing layer. Internal to
 * record. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RUNNING_IN_VALIDATION_H
#define WT_RECORD_RUNNING_IN_VALIDATION_H

#include "record/layer_growth.h"
#include "record/numerics/agreement.h"
#include "record/recorded_friction.h"

/* Of the change of friction; what is then left of it an instrument hardly sees. */
#define RUNNING_IN_LEFT 0.05

/* What a run tells, of the values themselves and of every draw. */
typedef enum run_number {
    RUN_TIME_RATIO, /* ln of time measured over predicted; NaN: not told */
    RUN_MORE,       /* change of friction less the least that agrees, in friction */
    RUN_LESS,       /* the most that agrees less the change */
    RUN_RATIO,      /* change measured over predicted */
    RUN_PREDICTED,  /* ln of the time predicted [s] */
    RUN_MEASURED,   /* ln of the time measured [s] */
    RUN_WEAR,       /* ln of k asked for [m^2/N] */
    RUN_ENERGY,     /* ln of U_c asked for with it [J/m^3]; NaN: none */
    RUN_NUMBERS
} run_number;

typedef struct run_fit {
    const recorded *rec;
    const growth *growth; /* NULL: not predicted */
    running_in_curve_fit fit;
    double until;  /* that it was fitted up to [s] */
    double *value; /* [(1 + n_draws) * RUN_NUMBERS]; NULL: not compared */
    char note[256];
} run_fit;

/* The fits of one run; its note says why where there is none. */
wt_status run_fit_compute(run_fit *run, double margin, wt_error *err) WT_NODISCARD;
void run_fit_clear(run_fit *run);
/* It has a time that the record tells to both sides. */
bool run_fit_is_closed(const run_fit *run);
/* Whether the record tells this number of it. */
bool run_fit_determines(const run_fit *run, run_number number);
double run_fit_value(const run_fit *run, size_t k, run_number number);
/* Variance by the record alone, and what its draws scatter. */
double run_fit_own(const run_fit *run, run_number number);
double run_fit_spread(const run_fit *run, run_number number);
/* Of a time of which the record tells one end alone that end of its ln, 95 % with the error of the
 * prediction; NaN without that error. */
double run_fit_end(const run_fit *run, run_number number);

/* The level of a number over the runs that tell it, with both errors. */
typedef struct run_level {
    agreement fit; /* n 0: none tells it */
    double own, common;
} run_level;
wt_status run_level_make(const run_fit *runs, size_t n, run_number number, run_level *level,
                         wt_error *err) WT_NODISCARD;
wt_interval run_level_interval(const run_level *level);
void run_level_clear(run_level *level);

/* What all runs say together. */
typedef struct run_set {
    const run_fit *runs;
    size_t n;
    double margin;
    uint64_t seed; /* of the draws */
    bool has_shear;
    const char *without_errors; /* why the prediction has none; NULL */
    run_level level[RUN_NUMBERS];
} run_set;
/* The levels of all numbers. Where a record does not tell the time that others tell, those are the
 * ones that chance lets tell one, and their mean is off: the level is then what all records say
 * together of one time and one change over those predicted, or nothing, where they do not tell it
 * or a time and a change of each are likelier by COURSE_ODDS. */
wt_status run_set_levels(run_set *all, wt_error *err) WT_NODISCARD;
void run_set_clear(run_set *all);

typedef struct run_verdict {
    char verdict[600], settled_by[320];
} run_verdict;
run_verdict run_set_assess(const run_set *all);

/* Table "validation_course". */
wt_status running_in_course_table(const run_set *all, const char *verdict, wt_table **table,
                                  wt_error *err) WT_NODISCARD;

#endif
