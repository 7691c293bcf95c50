/* Parts of the job that compares predicted friction with records. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_VALIDATION_H
#define WT_RECORD_VALIDATION_H

#include "core/base/range_text.h"
#include "record/model_variant.h"
#include "study/case_override.h"
#include "weartrack/record.h"

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
/* Returns the variance of ln of the model discrepancy: 95 % of it are within the margin. */
double validation_discrepancy_variance(const validation *v);
/* Text such as "explains: ..." for a model variant of the ratio. */
typedef struct verdict_text {
    char text[256];
} verdict_text;
verdict_text model_variant_verdict(const validation *v, const model_variant *t);
/* Returns the requested range of measured over predicted: "0.833 to 1.2". */
range_text validation_requested_range(double margin);
/* Returns "explains", "does not" or "cannot say". */
const char *validation_verdict(agreement_verdict verdict);

mean_ratio mean_ratio_compute(const model_variant *t); /* row: freed by the caller */
/* Returns the 95 % interval of exp(value). */
wt_interval validation_factor(double value, double error, double df);

/* Returns the 95 % interval of a required shear stress, with its standard error. */
wt_interval required_shear_interval(double value, double error, double df);
/* Computes the required shear stress and the remaining difference with it. */
wt_status required_shear_compute(validation *v, wt_error *err) WT_NODISCARD;
void required_shear_set_keys(const validation *v, table_writer *t);
/* Sets the keys of the required largest wavenumber, all else as used. */
wt_status required_cutoff_set_keys(const validation *v, table_writer *t,
                                   wt_error *err) WT_NODISCARD;

/* Advice of the table "validation_sources": what narrows the interval most, and how to decide an
 * inconclusive verdict. */
typedef struct source_advice {
    char narrows[320], settles[320];
} source_advice;
/* Returns the name of a draw and the remedy that reduces its error. */
const char *draw_source_name(flow_draw draw, const char **remedy);
wt_status error_sources_tabulate(const validation *v, source_advice *advice, wt_table **table,
                                 wt_error *err) WT_NODISCARD;

/* Ranges of the numbers in the table "validation_choices", over all rows and over those that the
 * record selects. */
typedef struct choice_ranges {
    double all[CASE_QUANTITIES][2], kept[CASE_QUANTITIES][2]; /* NaN if unknown */
    char narrows[320];
} choice_ranges;
wt_status model_choices_tabulate(const validation *v, const table_view *what_if,
                                 choice_ranges *ranges, wt_table **table,
                                 wt_error *err) WT_NODISCARD;

#endif
