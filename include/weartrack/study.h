/* weartrack - study: comparison of track and bulk, cases side by side, what if, error budget,
 * error against run time.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_STUDY_H
#define WEARTRACK_STUDY_H

#include "weartrack/indentation.h"
#include "weartrack/layer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statistics of comparisons -------------------------------------------------------------- */

/* Comparison of the means of a further property of the curves (such as adhesion). */
typedef struct wt_mean_comparison {
    double mean[2];     /* mean of the spots; NaN: no values */
    double larger_p[2]; /* one-sided p value (Welch) that this group is larger than the other;
                                NaN with fewer than two spots in a group */
} wt_mean_comparison;
/* Compares the means of two groups. values: [n] one per curve; values that are not finite are
 * excluded. spots: [n], NULL: each curve is a unit. */
WT_API wt_mean_comparison wt_compare_means(const double *const values[2],
                                           const long *const spots[2], const size_t n[2]);
/* Returns the spot whose mean is farthest from those of the others, measured by their scatter. p:
 * its chance by that scatter times the number of spots; 1 with fewer than four. spots: [n], NULL if
 * each value is a spot. */
WT_API long wt_outlying_spot(const double *values, const long *spots, size_t n, double *p_value);
/* Returns the combined p value of two independent tests (Fisher 1932). If one is NaN, it returns
 * the other. */
WT_API double wt_combined_p_value(double a, double b);

/* Logarithm of a ratio with its error. */
typedef struct wt_log_ratio {
    double value, standard_error;
    double df; /* degrees of freedom of the error; NaN: normal */
} wt_log_ratio;
/* Difference a - b of two independent log ratios (Welch, Satterthwaite as in wt_compare).
 * Undetermined values are NaN. */
typedef struct wt_log_ratio_difference {
    double value, low, high; /* with its 95 % interval */
    double df;               /* NaN: normal error */
    double p;                /* two-sided, for no difference */
} wt_log_ratio_difference;
WT_API wt_log_ratio_difference wt_log_ratio_compare(const wt_log_ratio *a, const wt_log_ratio *b);
/* Chance of at least the scatter of n >= 2 values if one value is behind them: Welch's test
 * (Biometrika 38 (1951) 330) with the stated degrees of freedom, or chi-squared if all errors are
 * normal. */
WT_API double wt_log_ratio_test(const wt_log_ratio *of, size_t n);

/* Effect of tip wear: a curve of a pyramid or cone with another cap radius [m], fitted by the law
 * of the stated tip. depth [m]; bending: cantilever deflection at that depth [m]. Result: ln of the
 * fitted over the true modulus, and the root mean square residual over the largest force. */
typedef struct wt_tip_wear {
    double log_modulus, misfit;
} wt_tip_wear;
WT_API wt_status wt_tip_wear_fit(const wt_tip *stated, double radius, double depth, double bending,
                                 wt_tip_wear *fit, wt_error *err) WT_NODISCARD;

/* ---- groups of an indentation table --------------------------------------------------------- */

/* Reads a group from a table. A spot is a named one, else a file, or each position of the unnamed
 * ones with `spot_per_position`. */
WT_API wt_status wt_group_from_table(const wt_table *indentation, bool spot_per_position,
                                     wt_group_data *data, wt_error *err) WT_NODISCARD;
WT_API void wt_group_data_clear(wt_group_data *data);
/* Creates the table "modulus_groups", one row per indentation table. A group without an accepted
 * curve has a row with n = 0. */
WT_API wt_status wt_modulus_groups_table(const wt_table *const *indentation, size_t n,
                                         wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "modulus_budget": for each group the contributions of scatter and systematic
 * errors to the error of the modulus. NULL if no group states a systematic error. */
WT_API wt_status wt_modulus_budget_table(const wt_table *const *indentation, size_t n,
                                         wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- comparison of track and bulk ----------------------------------------------------------- */

/* Number of cantilevers for bulk and track. The errors of a shared one cancel in the ratio. */
typedef enum wt_cantilever_sharing {
    WT_CANTILEVERS_AUTO, /* one if the spring constants are equal */
    WT_CANTILEVERS_SHARED,
    WT_CANTILEVERS_SEPARATE
} wt_cantilever_sharing;

typedef struct wt_compare_job {
    const wt_table *bulk, *track; /* indentation tables */
    const wt_rubber *rubber;      /* for the DMA comparison; NULL (default) = none */
    wt_estimate temperature; /* of the indentation [K]; NaN = reference temperature of the rubber */
    wt_estimate track_temperature; /* NaN = the same for the track */
    wt_estimate temperature_slope; /* d ln E/dT [1/K]; NaN = that of the rubber */
    wt_cantilever_sharing cantilevers;
    double lever_error; /* relative standard error of a spring constant whose table states none;
                           default 0 = none */
    double sensitivity_error; /* relative standard error; default 0 = not stated */
    double tip_error;         /* relative error of the modulus by the tip; default 0 = not stated */
    double spot_scatter;      /* relative scatter between spots, for groups of one spot; default 0 =
                                 unknown */
    bool map_spots;   /* each position of a map is a spot; default false: a map is one spot */
    double margin;    /* irrelevant relative difference; default 0.2 */
    bool rates;       /* default true: table of the modulus against rate */
    bool groups_only; /* no comparison of the two groups */
    wt_estimate expected_thickness; /* independent thickness [m]; NaN (default): that of the theory,
                                       if any */
} wt_compare_job;
WT_API wt_compare_job wt_compare_job_defaults(void);
WT_API const wt_params *wt_compare_job_params(void);

typedef struct wt_compare_tables {
    wt_table *modulus_groups;
    wt_table *comparison;
    wt_table *modulus_rate;   /* NULL if rates are unknown or not requested */
    wt_table *dma_comparison; /* NULL without rubber or rates */
    wt_table *modulus_budget; /* NULL if no group states a systematic error */
} wt_compare_tables;
/* Compares bulk and track. One of them may be NULL: then there is no table "comparison". A group
 * without a usable curve has a row without numbers. WT_E_RANGE if a curve is in both groups. */
WT_API wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *work,
                                   wt_compare_tables *tables, wt_error *err) WT_NODISCARD;

/* Creates the table "track_layer": the thickness of a layer in the track from the curves alone,
 * compared with that of the job or, if it is NaN, that of `layer` (table "layer", or NULL). NULL if
 * the tables have no depth information and no thickness is stated. */
WT_API wt_status wt_track_layer_compute(const wt_compare_job *job, const wt_table *layer,
                                        const wt_job *work, wt_table **table,
                                        wt_error *err) WT_NODISCARD;

/* ---- results of cases side by side ---------------------------------------------------------- */

/* A result of wt_run_case, identified by the sample and condition of the case, or by `file` and "";
 * or a result of wt_indent_group or wt_ramp_compute, which is listed with the cases. */
typedef struct wt_collected_result {
    const wt_result *result;
    const char *file;
} wt_collected_result;

typedef struct wt_collect_job {
    double margin; /* irrelevant relative difference of modulus ratios; default 0.2 */
} wt_collect_job;
WT_API wt_collect_job wt_collect_job_defaults(void);
WT_API const wt_params *wt_collect_job_params(void);

/* Tables of these names. NULL: no case has data for it, or there is no pair. */
typedef struct wt_collection_tables {
    wt_table *collection, *collected_modulus, *collected_friction, *collected_ramp,
        *collected_force, *ratio_pairs;
} wt_collection_tables;
/* Compares cases. Modulus ratios of pairs count as independent. WT_E_EMPTY without a case or a
 * temperature sweep; WT_E_AMBIGUOUS for two cases of one sample and condition. */
WT_API wt_status wt_collection_compute(const wt_collected_result *cases, size_t n,
                                       const wt_collect_job *job, wt_collection_tables *tables,
                                       wt_error *err) WT_NODISCARD;

/* ---- what if -------------------------------------------------------------------------------- */

/* Creates the table "what_if", a one-at-a-time sensitivity: friction and layer at the reference
 * velocity, then with one model choice changed in each row, and the resulting change. Choices that
 * do not apply have no row; a row that cannot be computed has the reason. `layer` NULL: no
 * thickness of the layer; `observation` NULL: no friction with a layer. With both, the thickness is
 * that of `layer`. */
WT_API wt_status wt_model_sensitivity_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                              const wt_layer_observation *observation,
                                              const wt_job *work, wt_table **table,
                                              wt_error *err) WT_NODISCARD;

/* ---- error budget --------------------------------------------------------------------------- */

/* Creates the table "error_budget": the error of each number at the reference velocity by every
 * source alone (replicates with all others fixed), by the number of replicates, by numerical
 * errors, and by the model choices of `what_if` (may be NULL); with the time of each, if the cost
 * of `work` has times and includes `what_if`, and how to reduce it. `layer` and `observation` as
 * above.
 */
WT_API wt_status wt_error_budget_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                         const wt_layer_observation *observation,
                                         const wt_table *what_if, const wt_job *work,
                                         wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- error against run time ----------------------------------------------------------------- */

typedef struct wt_accuracy_job {
    size_t repeats; /* timing repetitions of each point; default 9 */
} wt_accuracy_job;
WT_API wt_accuracy_job wt_accuracy_job_defaults(void);
WT_API const wt_params *wt_accuracy_job_params(void);
/* Creates the table "work_precision" of a sliding contact at the reference velocity: friction and
 * layer for a sweep of the tolerance (reference 1e-13; textbook method for comparison), and
 * standard errors for a sweep of the number of replicates, each with its processor time on one
 * thread. Times are NaN if the cost of `work` has none. `layer` and `observation` as above. */
WT_API wt_status wt_case_precision_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                           const wt_layer_observation *observation,
                                           const wt_accuracy_job *job, const wt_job *work,
                                           wt_table **table, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
