/* Parts of the comparison job: the two groups with their rates, the known contributions to their
 * ratio, the rows and the verdict. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COMPARE_H
#define WT_STUDY_COMPARE_H

#include "core/base/array.h"
#include "core/table/registry.h"
#include "core/table/result_value.h"
#include "weartrack/study.h"

extern const char *const compare_group_name[2];

/* Values in place of the index of a bin: an unknown rate (of a curve), and all bins (of a
 * selection). */
#define COMPARE_NO_BIN SIZE_MAX
#define COMPARE_ALL_BINS SIZE_MAX

/* Geometric means over the curves of one bin of one group. */
typedef struct rate_point {
    size_t n;
    double rate, frequency;
    wt_group_summary summary;
} rate_point;

/* The two groups with the bin of every curve. */
typedef struct compare_pair {
    wt_group_data data[2];
    bool present[2];
    bool by_rate;   /* both groups have rates, which are compared separately */
    bool by_factor; /* the factors on the spectrum are compared instead of the moduli */
    size_t *bin[2]; /* [n]; COMPARE_NO_BIN for an unknown rate */
    size_t n_bins;
    double *low, *high;     /* [n_bins] smallest and largest rate [m/s] */
    rate_point *point[2];   /* [n_bins] */
    double *modulus, *rate; /* scratch for selected curves, bulk before track */
    long *spot, *rate_class;
    arena memory; /* of these arrays */
} compare_pair;

void compare_pair_clear(compare_pair *p);
/* Copies the curves of a bin to scratch from `offset` on, with moduli or factors. */
wt_group compare_select_curves(const compare_pair *p, int g, size_t bin, size_t offset,
                               bool factors);

/* Known contributions to ln(E_track / E_bulk) other than the difference of the rubber. */
typedef struct comparison_inputs {
    wt_estimate offset;
    double loss_and_curvature_error; /* error by hysteresis loss and baseline curvature, as measured
                                        on the curves */
    bool has_two_cantilevers;
    bool lacks_spring_constant_error; /* two cantilevers, and the error of a spring constant is
                                         unknown */
    bool lacks_temperature_effect;    /* the temperatures differ, with an unknown effect */
    bool lacks_loss_effect;           /* the curves have a hysteresis loss with an unknown effect on
                                      the modulus */
    bool lacks_second_range;          /* no curve of a group was fitted in a second range */
    bool rates_by_dma; /* the DMA corrects for different rates, as the curves cannot */
    char unreachable_temperature[160]; /* requested temperature that no shift law reaches */
    double temperature[2];             /* [K]; NaN if unknown */
    char includes[400];                /* errors in the interval besides the scatter */
    char lacks[160];                   /* errors of unknown size that are missing */
    char cancels[256];                 /* errors that cancel except for different gains */
} comparison_inputs;

wt_status comparison_find_inputs(const compare_pair *p, const wt_compare_job *job,
                                 const wt_job *work, bool rates_by_dma, comparison_inputs *inputs,
                                 wt_error *err) WT_NODISCARD;

/* Mean of the finite values; NaN without one. */
double compare_mean(const double *values, size_t n);

/* Temperature [K] and angular frequency [rad/s] of a modulus. */
typedef struct material_state {
    double temperature, frequency;
} material_state;

/* Returns ln |E*| at one condition, or of the second over the first, with its error by draws. The
 * error is NaN if the material states none. */
wt_status compare_material(const wt_rubber *rubber, const material_state *at, int n,
                           const wt_job *work, wt_estimate *value, wt_error *err) WT_NODISCARD;

/* Returns the error of ln |E*| due to the error of the temperature: half the difference between its
 * limits. 0 if no error is stated; NaN if no shift law reaches a limit. */
wt_status compare_temperature_error(const wt_rubber *rubber, material_state at, double error,
                                    const wt_job *work, double *relative,
                                    wt_error *err) WT_NODISCARD;

static inline const char *compare_missing_errors(bool material, bool temperature)
{
    return material && temperature ? "material, temperature"
           : material              ? "material"
                                   : "temperature";
}

/* Returns the temperature of a group with its error: stated for the group, else that of the bulk,
 * else that of the DMA. */
wt_estimate compare_temperature(const wt_compare_job *job, int group);

/* One row of "comparison" before Holm's correction. */
typedef struct compare_row {
    double low, high; /* rate [m/s]; NaN for all rates */
    size_t n[2];
    bool valid;
    wt_comparison c;
    double holm;
} compare_row;

/* Causes other than the rubber that would produce the ratio. */
typedef struct unstated_errors {
    double log_ratio, smallest_to_explain; /* ln of the ratio to be explained, and the smallest part
                                              of it that would change the verdict */
    char would_explain[640];               /* required size of each cause */
    char plausible[480];                   /* causes of plausible size; "" if none */
    double lower, higher;                  /* limits of their effect on ln(ratio) */
    char settled_by[400];                  /* how to decide */
} unstated_errors;
wt_status compare_find_unstated_errors(const compare_pair *p, const wt_compare_job *job,
                                       const wt_job *work, const compare_row *row,
                                       unstated_errors *unstated, wt_error *err) WT_NODISCARD;
/* Returns d ln |E*| / dT of the DMA [1/K] at the mean frequency of the bulk. 0 if unknown. */
wt_status compare_temperature_slope(const compare_pair *p, const wt_compare_job *job,
                                    const wt_job *work, double *slope, wt_error *err) WT_NODISCARD;
/* Returns ln of the modulus of a group over |E*| of the DMA, with the errors that its calibration
 * does not cause. NaN if unknown. */
wt_status compare_group_with_dma(const compare_pair *p, int group, const wt_compare_job *job,
                                 const wt_job *work, wt_estimate *log_ratio,
                                 wt_error *err) WT_NODISCARD;

/* Range of the ratio over the choices of the fit, which are made alike for both groups, and the
 * choice with the largest effect. NaN and NULL if no choice has an effect beyond the noise. */
typedef struct ratio_choices {
    double low, high;
    const char *widest, *remedy;
} ratio_choices;

/* Verdict on the difference between track and bulk, and how to decide it. */
typedef struct compare_verdict {
    stated_verdict verdict;
    char reason[628], settled_by[480];
    bool depends_on_rate; /* the ratio depends on the rate */
    bool is_unreportable; /* no ratio can be reported */
    ratio_choices choices;
} compare_verdict;

/* Assesses the difference. `row` has all rates; `rates` has one row per rate. */
compare_verdict compare_assess(const compare_pair *p, const wt_compare_job *job,
                               const comparison_inputs *inputs, const unstated_errors *unstated,
                               const compare_row *row, const compare_row *rates, size_t n_rates);

/* Reads both groups of a job with their rates. The caller clears `p`, also after a failure. */
wt_status compare_read_groups(const wt_compare_job *job, compare_pair *p,
                              wt_error *err) WT_NODISCARD;

/* Returns ln of the ratio as fitted over all rates. Its error includes scatter, calibration and
 * temperature, but not the lack of fit. Infinite degrees of freedom mean a normal error. NaN if the
 * comparison does not determine it. */
wt_status compare_fitted_ratio(const wt_compare_job *job, const wt_job *work,
                               wt_estimate *log_ratio, double *df, wt_error *err) WT_NODISCARD;

wt_status compare_tabulate(compare_pair *p, const wt_compare_job *job, const wt_job *work,
                           wt_table **table, wt_error *err) WT_NODISCARD;

/* Results of one case; the texts are borrowed from its result. */
typedef struct collected_case {
    const char *sample, *condition, *file;
    const wt_result *result;
    result_value_tables tables;
    wt_log_ratio ratio; /* of the moduli; NaN if unknown */
} collected_case;

/* Creates the table "ratio_pairs"; NULL if no two cases share a sample or a condition. */
wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err) WT_NODISCARD;

#endif
