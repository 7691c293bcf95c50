/* Parts of the job that compares predicted friction with records. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_VALIDATION_H
#define WT_RECORD_VALIDATION_H

#include "core/base/array.h"
#include "core/base/number.h"
#include "friction/replicates.h"
#include "record/measured_friction.h"
#include "record/numerics/agreement.h"
#include "study/case_override.h"
#include "weartrack/record.h"

/* ---- friction predicted at the steps, for the nominal values and for their draws ------------ */

/* Friction is hysteresis + tau_f x friction_per_shear. */
typedef enum prediction_part {
    PART_HYSTERESIS,
    PART_BY_SHEAR, /* [1/Pa] */
    PART_HYSTERESIS_LAYER,
    PART_BY_SHEAR_LAYER,
    PARTS
} prediction_part;

typedef struct prediction {
    size_t n, n_draws; /* steps; draws, of which the first n_lines numbers are drawn */
    bool layered;
    double *part;  /* [(1 + n_draws) * PARTS * n] nominal values first */
    double *shear; /* [1 + n_draws] tau_f [Pa]; NaN if not stated */
    flow_draw line[REPLICATES_MAX_DRAWS];
    size_t n_lines;
    double zero_loss_range[2]; /* range where the loss modulus of the layer is set to 0; NaN if
                             nowhere */
} prediction;

/* Predicts friction. A NULL observation means no layer. Without `draws` only nominal values are
 * computed. The caller clears `p`, also after a failure. */
wt_status predict_friction(const wt_sliding *sliding, const wt_layer_observation *observation,
                           const measured *steps, const wt_job *work, bool draws, prediction *p,
                           wt_error *err) WT_NODISCARD;
void prediction_clear(prediction *p);

/* Returns a component of the nominal values (k = 0) or of draw k - 1. */
double prediction_part_value(const prediction *p, size_t k, prediction_part part, size_t step);
/* hysteresis + shear x friction_per_shear. */
double prediction_total(const prediction *p, size_t k, bool layered, size_t step, double shear);

/* ---- one prediction compared with the record: with or without a layer, with a stated shear
 * stress or with the required one -------------------------------------------------------------- */

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
    arena memory; /* of the arrays */
} model_variant;

/* Evaluates and fits a model variant. The argument before the seed holds [n] variances of the
 * measurement, in the scale of the value. The caller clears `t`, also after a failure. */
wt_status model_variant_fit(const prediction *p, const measured *steps, model_variant_value *of,
                            const void *user, const double *measurement_variance, uint64_t seed,
                            size_t most_terms, model_variant *t, wt_error *err) WT_NODISCARD;
void model_variant_clear(model_variant *t);

/* ln(measured/predicted) friction. shear: [1 + n_draws] shear stress of the nominal values and of
 * the draws [Pa]. */
typedef struct ratio_inputs {
    const prediction *p;
    const measured *steps;
    const double *shear;
    bool layered;
} ratio_inputs;
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

/* ---- job --------------------------------------------------------------------------------------
 */

/* Mean of the fit over all steps. */
typedef struct mean_ratio {
    double *row; /* [n] mean = row . value */
    double value, error, df;
} mean_ratio;

typedef struct validation {
    const wt_validation_job *job;
    const wt_job *work;
    const wt_layer_observation *layer_observation; /* NULL without a layer of finite thickness */
    case_variant used;
    measured steps;
    prediction p;
    bool has_shear, layered; /* true if the tested prediction has the layer */
    model_variant ratio[2];  /* without and with the layer; n 0 if absent */
    mean_ratio mean;         /* of the tested variant */
    model_variant shear;     /* required shear stress of each step [Pa] */
    wt_interval needed;
    double *needed_shear; /* [1 + n_draws] required shear stress of the draws [Pa] */
    model_variant shape;  /* ratio with the required shear stress */
} validation;

/* Returns ln of the factor within which measured and predicted friction agree. */
double validation_margin(const validation *v);
/* Text such as "yes: ..." for a model variant of the ratio. */
typedef struct verdict_text {
    char text[256];
} verdict_text;
verdict_text model_variant_verdict(const validation *v, const model_variant *t);
/* Returns the requested range of measured over predicted: "0.833 to 1.2". */
range_text validation_requested_range(double margin);

mean_ratio mean_ratio_compute(const model_variant *t); /* row: freed by the caller */
/* Returns the 95 % interval of exp(value). */
wt_interval validation_factor(double value, double error, double df);

/* Advice of the table "validation_sources": what narrows the interval most, and how to decide an
 * inconclusive verdict. */
typedef struct source_advice {
    char narrows[320], settles[320];
} source_advice;
wt_status error_sources_tabulate(const validation *v, source_advice *advice, wt_table **table,
                                 wt_error *err) WT_NODISCARD;

#endif
