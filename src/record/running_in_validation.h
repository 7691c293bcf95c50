/* Parts of the job that compares the running-in of records with a growing layer. Internal to
 * record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RUNNING_IN_VALIDATION_H
#define WT_RECORD_RUNNING_IN_VALIDATION_H

#include "record/layer_growth.h"
#include "record/numerics/agreement.h"
#include "record/recorded_friction.h"

/* Remaining fraction of the change of friction at the settling time. An instrument hardly resolves
 * the remainder. */
#define RUNNING_IN_REMAINDER 0.05

/* Numbers of a run, for the nominal values and for every draw. */
typedef enum run_quantity {
    RUN_TIME_RATIO,  /* ln of measured over predicted time; NaN if undetermined */
    RUN_ABOVE_LOWER, /* change of friction less the smallest change that agrees */
    RUN_BELOW_UPPER, /* largest change of friction that agrees less the change */
    RUN_RATIO,       /* measured over predicted change */
    RUN_PREDICTED,   /* ln of the predicted time [s] */
    RUN_MEASURED,    /* ln of the measured time [s] */
    RUN_WEAR,        /* ln of the required k [m^2/N] */
    RUN_ENERGY,      /* ln of the required U_c [J/m^3]; NaN if there is none */
    RUN_QUANTITIES
} run_quantity;

typedef struct run_fit {
    const recorded_run *rec;
    const growth *growth; /* NULL if not predicted */
    running_in_curve_fit fit;
    double until;  /* end of the fitted part [s] */
    double *value; /* [(1 + n_draws) * RUN_QUANTITIES]; NULL if not compared */
    char note[256];
} run_fit;

/* Fits one run. Its note has the reason if there is no fit. The caller clears the run. */
void run_fit_compute(run_fit *run, double margin);
void run_fit_clear(run_fit *run);
/* True if the record determines both limits of the time. */
bool run_fit_is_closed(const run_fit *run);
/* True if the record determines this number. */
bool run_fit_determines(const run_fit *run, run_quantity number);
double run_fit_value(const run_fit *run, size_t k, run_quantity number);
/* Returns the variance due to the record alone. */
double run_fit_record_variance(const run_fit *run, run_quantity number);
double run_fit_prediction_deviation(const run_fit *run, run_quantity number);
/* Returns the only determined limit of ln of a time, 95 %, with the error of the prediction. NaN
 * without that error. */
double run_fit_bound(const run_fit *run, run_quantity number);

/* Mean of a number over the runs that determine it, with both errors. */
typedef struct run_level {
    agreement fit; /* n 0: no run determines it */
    double record_variance, common;
} run_level;
wt_status run_level_compute(const run_fit *runs, size_t n, run_quantity number, run_level *level,
                            wt_error *err) WT_NODISCARD;
wt_interval run_level_interval(const run_level *level);
void run_level_clear(run_level *level);

/* Numbers of all runs together. */
typedef struct run_set {
    const run_fit *runs;
    size_t n;
    double margin;
    uint64_t seed; /* of the random draws */
    bool has_shear;
    const char *skip_numerical_errors; /* reason why the prediction has no errors; NULL if it has */
    run_level level[RUN_QUANTITIES];
} run_set;
/* Computes the levels of all numbers. If a record does not determine the time, the other records
 * are a biased selection. The level then comes from a joint fit with one time and one change. It is
 * empty if the joint fit is undetermined, or if separate values are more probable by
 * RUNNING_IN_CURVE_MIN_ODDS. */
wt_status run_set_compute_levels(run_set *all, wt_error *err) WT_NODISCARD;
void run_set_clear(run_set *all);

typedef struct run_verdict {
    char verdict[600], settled_by[320];
} run_verdict;
run_verdict run_set_assess(const run_set *all);

/* Creates the table "validation_course". */
wt_status running_in_curve_tabulate(const run_set *all, const char *verdict, wt_table **table,
                                    wt_error *err) WT_NODISCARD;

#endif
