/* Inside the comparison job: the two groups with their rates, what is known of their ratio beside
 * the difference, the rows and the verdict. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COMPARE_H
#define WT_STUDY_COMPARE_H

#include "weartrack/flow.h"

#include "core/table/registry.h"

extern const char *const compare_group_name[2];

/* In the place of a bin: a curve whose rate is not known; the curves of all bins. */
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
    bool by_rate;   /* both groups know rates: they are compared by them */
    bool by_factor; /* what is compared is not the modulus but the factor on the spectrum */
    size_t *bin[2]; /* [n]; COMPARE_NO_BIN = rate unknown */
    size_t n_bins;
    double *low, *high;     /* [n_bins] smallest and largest rate */
    rate_point *point[2];   /* [n_bins] */
    double *modulus, *rate; /* scratch for a part of a group, one after the other */
    long *spot, *rate_class;
} compare_pair;

wt_status compare_make_bins(compare_pair *p, wt_error *err) WT_NODISCARD;
void compare_pair_clear(compare_pair *p);
/* The part of a group that lies in a bin, copied to scratch from `offset` on, with moduli or
 * factors. */
wt_group compare_part(const compare_pair *p, int g, size_t bin, size_t offset, bool factors);

/* What ln(E_track / E_bulk) holds beside the difference. */
typedef struct comparison_inputs {
    wt_estimate offset;
    double shown; /* of it: by loss and bent baselines, which the curves show */
    bool two_levers;
    bool lever_not_stated;      /* two, and the error of a spring constant is not known */
    bool temperature_not_known; /* they differ, and nothing says what that does */
    bool loss_not_known;        /* curves lose work, and what that does to a modulus nothing says */
    bool rates_by_dma;          /* the curves do not say what their rates do; the DMA does */
    char out_of_reach[160];     /* a temperature to which no law takes the DMA, which was asked */
    double temperature[2];      /* [K]; NaN = not known */
    char includes[256];         /* in words: what the interval has beside the scatter */
    char lacks[160];            /* what belongs into it, and its size is not known */
    char cancels[128];          /* and what it loses, but for what the gains differ by */
} comparison_inputs;

wt_status comparison_find_inputs(const compare_pair *p, const wt_compare_job *job,
                                 const wt_job *work, bool rates_by_dma, comparison_inputs *known,
                                 wt_error *err) WT_NODISCARD;

/* Where a modulus is asked of the material. */
typedef struct condition {
    double temperature, frequency;
} condition;

/* ln |E*| at one condition, or of the second over the first, with its error by draws; NaN if the
 * material states none. */
wt_status compare_material(const wt_rubber *rubber, const condition *at, int n, const wt_job *work,
                           wt_estimate *value, wt_error *err) WT_NODISCARD;

/* What a standard error of the temperature makes of ln |E*|: half of what lies between both ends of
 * it; 0 if none is stated, NaN where no law takes the DMA there. */
wt_status compare_temperature_error(const wt_rubber *rubber, condition at, double error,
                                    const wt_job *work, double *relative,
                                    wt_error *err) WT_NODISCARD;

static inline const char *compare_missing_inputs(bool material, bool temperature)
{
    return material && temperature ? "material, temperature"
           : material              ? "material"
                                   : "temperature";
}

/* The temperature of a group with its error: its own, that of the bulk, that of the DMA. */
wt_estimate compare_temperature(const wt_compare_job *job, int group);

/* One row of "comparison" before Holm's correction is known. */
typedef struct compare_row {
    double low, high; /* rate; NaN = all */
    size_t n[2];
    bool valid;
    wt_comparison c;
    double holm;
} compare_row;

/* What else than the rubber would make the ratio. */
typedef struct unstated_errors {
    double log_ratio, least; /* what is to be explained, and what of it takes the answer away */
    char would_explain[640]; /* in words: what each cause would have to be */
    char plausible[480];     /* those that may well be so, "" = none */
    double lower, higher; /* by how much they may make ln(ratio) differ from that of the rubber */
    char settled_by[400]; /* and what would show */
} unstated_errors;
wt_status compare_find_unsaid(const compare_pair *p, const wt_compare_job *job, const wt_job *work,
                              const compare_row *row, unstated_errors *unsaid,
                              wt_error *err) WT_NODISCARD;
/* Of ln |E*| of the DMA against temperature, at the mean frequency of the bulk [1/K]; 0 where that
 * or the DMA are not known there. */
wt_status compare_temperature_slope(const compare_pair *p, const wt_compare_job *job,
                                    const wt_job *work, double *slope, wt_error *err) WT_NODISCARD;

/* The answer to "does the track differ?", and what would give one. */
typedef struct compare_verdict {
    char differs[640], settled_by[480];
    bool twisted; /* the ratio depends on the rate */
    bool silent;  /* there is no ratio to be told */
} compare_verdict;

/* `row` is that of all rates, `rates` those of one each. */
compare_verdict compare_assess(const compare_pair *p, const wt_compare_job *job,
                               const comparison_inputs *known, const unstated_errors *unsaid,
                               const compare_row *row, const compare_row *rates, size_t n_rates);

/* Both groups of a job, with their rates. */
wt_status compare_read(const wt_compare_job *job, compare_pair *p, wt_error *err) WT_NODISCARD;

/* ln of the ratio of what was fitted, by all rates, with its error by scatter, calibration and
 * temperature, without what the contact law misses; degrees of freedom of the error, infinite: it
 * is normal. NaN where the comparison does not tell it. */
wt_status compare_as_fitted(const wt_compare_job *job, const wt_job *work, wt_estimate *log_ratio,
                            double *df, wt_error *err) WT_NODISCARD;

wt_status compare_make_table(compare_pair *p, const wt_compare_job *job, const wt_job *work,
                             wt_table **table, wt_error *err) WT_NODISCARD;

#endif
