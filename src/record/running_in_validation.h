/* Parts of the job that compares the running-in of records with a growing layer. Internal to
 * record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RUNNING_IN_VALIDATION_H
#define WT_RECORD_RUNNING_IN_VALIDATION_H

#include "friction/replicates.h"
#include "record/measured_friction.h"
#include "record/numerics/agreement.h"
#include "record/numerics/running_in_curve.h"
#include "weartrack/layer.h"

/* ---- friction during the growth of a layer, for the nominal values and for their draws ------- */

/* Numbers of one draw that precede its friction in time. */
typedef enum growth_quantity {
    GROWTH_END,    /* friction at the steady-state thickness; first member because it is never
                      NaN */
    GROWTH_BARE,   /* friction without a layer */
    GROWTH_WEAR,   /* specific wear rate k [m^2/N] */
    GROWTH_ENERGY, /* critical energy U_c [J/m^3]; NaN if the closure has none */
    GROWTH_QUANTITIES
} growth_quantity;

typedef struct growth {
    size_t n, n_draws, stride;
    double log_first, log_step; /* of the n times [s] */
    double *value; /* [(1 + n_draws) * stride] the numbers, then friction at the times; nominal
                      values first; NaN for a draw without a solution */
    double *running_in_curve; /* [(1 + n_draws) * n] friction less final friction */
    flow_draw line[REPLICATES_MAX_DRAWS];
    size_t n_lines, n_bare; /* draws without a layer */
    char includes[256];     /* names of the drawn sources */
} growth;

/* Computes the growth. The caller clears it, also after a failure. Returns WT_E_RANGE if no layer
 * exists or if it grows without limit. */
wt_status growth_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                         const wt_layer_observation *observation, const measured_step *at,
                         const wt_job *work, growth *g, wt_error *err) WT_NODISCARD;
void growth_clear(growth *g);

/* Returns a number of the nominal values (k = 0) or of draw k - 1. */
double growth_quantity_value(const growth *g, size_t k, growth_quantity number);
running_in_curve growth_curve(const growth *g, size_t k);
/* Returns the friction coefficient at a time [s]. */
double growth_friction_at(const growth *g, size_t k, double time);
/* Returns the standard deviation of a function over the draws with a finite value. NaN if fewer
 * than two have one. */
typedef double growth_function(const growth *g, size_t k, double time);
double growth_standard_deviation(const growth *g, growth_function *of, double time);

/* ---- runs ---------------------------------------------------------------------------------------
 */

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
    double until;   /* end of the fitted part [s] */
    double *value;  /* [(1 + n_draws) * RUN_QUANTITIES]; NULL if not compared */
    bool ambiguous; /* a course within the errors of the prediction fits the record as well */
    char note[256];
} run_fit;
/* Share of the draws up to which an outcome of draws may be chance. */
#define RUN_LEAST_DOUBT 0.025

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
    stated_verdict outcome;
    char verdict[600], settled_by[320];
} run_verdict;
run_verdict run_set_assess(const run_set *all);

#endif
