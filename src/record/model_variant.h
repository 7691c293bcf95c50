/* One prediction compared with the record: with or without a layer, with a stated shear stress or
 * with the required one. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_MODEL_VARIANT_H
#define WT_RECORD_MODEL_VARIANT_H

#include "record/numerics/agreement.h"
#include "record/predicted_friction.h"

/* Returns the compared quantity at a step, for the nominal values (k = 0) or for draw k - 1. */
typedef double model_variant_value(const void *user, size_t k, size_t step);

/* Differences at the steps with the components of their error. */
typedef struct model_variant {
    size_t n, n_lines;
    double *log_velocity, *value, *measurement_variance; /* [n] as in agreement_data */
    double *prediction_covariance;                       /* [n * n] covariance by all draws */
    double *slope; /* [n_lines * n] effect of one standard error of a drawn number */
    double *rest;  /* [n * n] remaining covariance: the material */
    bool split;    /* true if the draws suffice for the slopes; else the slopes are
                      0 */
    agreement fit;
} model_variant;

/* Evaluates and fits a model variant. The argument before the seed holds [n] variances of the
 * measurement, in the scale of the value. The caller clears `t`, also after a failure. */
wt_status model_variant_fit(const prediction *p, const measured *steps, model_variant_value *of,
                            const void *user, const double *measurement_variance, uint64_t seed,
                            size_t most_terms, model_variant *t, wt_error *err) WT_NODISCARD;
void model_variant_clear(model_variant *t);
/* Returns the input of the fit; its arrays are borrowed from `t`. */
agreement_data model_variant_agreement_data(const model_variant *t);

/* ln(measured/predicted) friction. shear: [1 + n_draws] shear stress of the nominal values and of
 * the draws [Pa]. */
typedef struct ratio_inputs {
    const prediction *p;
    const measured *steps;
    const double *shear;
    bool layered;
} ratio_inputs;
double ratio_log_value(const void *user, size_t k, size_t step);
wt_status model_variant_fit_ratio(const ratio_inputs *of, uint64_t seed, model_variant *t,
                                  wt_error *err) WT_NODISCARD;

/* Fits one shear stress that all steps require in common. */
wt_status model_variant_fit_shear(const prediction *p, const measured *steps, bool layered,
                                  uint64_t seed, model_variant *t, wt_error *err) WT_NODISCARD;

/* Components of the variance of a weighted sum (weights `row`: [n]) by draw, material, measurement
 * and scatter. */
typedef struct variance_components {
    double line[REPLICATES_MAX_DRAWS], material, record, scatter, all;
} variance_components;
variance_components model_variant_components(const model_variant *t, const double *row);

#endif
