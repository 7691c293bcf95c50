/* One prediction held against the record: with or without a layer, with a given shear stress or the
 * one that the record asks for (internal to record).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_MODEL_VARIANT_H
#define WT_RECORD_MODEL_VARIANT_H

#include "record/numerics/agreement.h"
#include "record/predicted_friction.h"

/* What is compared at a step, of the values themselves (k = 0) or of draw k - 1. */
typedef double model_variant_value(const void *user, size_t k, size_t step);

/* The difference at the steps, and where its error comes from. */
typedef struct model_variant {
    size_t n, n_lines;
    double *place, *value, *own; /* [n] as in agreement_data */
    double *common;              /* [n * n] the covariance by all draws */
    double *slope;               /* [n_lines * n] what one standard error of a drawn number does */
    double *rest;                /* [n * n] the covariance beside: the material */
    bool split;                  /* whether there are draws enough for the slopes; else 0 */
    agreement fit;
} model_variant;

/* `own`: [n] variances by the measurement, in the scale of the value. */
wt_status model_variant_make(const prediction *p, const measured *steps, model_variant_value *of,
                             const void *user, const double *own, uint64_t seed, size_t most_terms,
                             model_variant *t, wt_error *err) WT_NODISCARD;
void model_variant_clear(model_variant *t);
/* As the fit takes it. */
agreement_data model_variant_data(const model_variant *t);

/* ln of measured over predicted friction. `shear` [1 + n_draws]: that of the values and the draws.
 */
typedef struct ratio_of {
    const prediction *p;
    const measured *steps;
    const double *shear;
    bool layered;
} ratio_of;
double ratio_value(const void *user, size_t k, size_t step);
wt_status model_variant_of_ratio(const ratio_of *of, uint64_t seed, model_variant *t,
                                 wt_error *err) WT_NODISCARD;

/* The shear stress that each step asks for, as one number for all. */
wt_status model_variant_of_shear(const prediction *p, const measured *steps, bool layered,
                                 uint64_t seed, model_variant *t, wt_error *err) WT_NODISCARD;

/* Variance of the row of the fit at step i (`row` [n]) by each line, by the material, by the
 * measurement and by its scatter. */
typedef struct model_variant_parts {
    double line[REPLICATES_MOST], material, record, scatter, all;
} model_variant_parts;
model_variant_parts model_variant_variance(const model_variant *t, const double *row);

#endif
