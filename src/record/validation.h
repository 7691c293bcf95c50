/* Parts of the job that holds predicted friction against records. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_VALIDATION_H
#define WT_RECORD_VALIDATION_H

#include "core/base/range_text.h"
#include "record/model_variant.h"
#include "study/case_override.h"

/* The mean of the fit over all steps. */
typedef struct mean_ratio {
    double *row; /* [n] mean = row . value */
    double value, error, df;
} mean_ratio;

typedef struct validation {
    const wt_validation_job *job;
    const wt_job *work;
    const wt_layer_observation *known; /* NULL: no layer, or none of finite thickness */
    setting used;
    measured steps;
    prediction p;
    bool has_shear, layered; /* what is judged has the layer */
    model_variant ratio[2];  /* without, with the layer; n 0: none */
    mean_ratio mean;         /* of the judged one */
    model_variant shear;     /* the shear stress that each step asks for; likewise */
    wt_interval needed;
    double *needed_shear; /* [1 + n_draws] the same of the draws */
    model_variant shape;  /* with it */
} validation;

/* ln of the factor within which measured and predicted friction agree. */
double validation_margin(const validation *v);
/* The variance of ln of what the theory may be off by: 95 % of it are within the margin. */
double validation_allowed(const validation *v);
/* "explains: ...", of a trial of the ratio. */
typedef struct verdict_text {
    char text[256];
} verdict_text;
verdict_text model_variant_verdict(const validation *v, const model_variant *t);
/* What measured over predicted shall be within: "0.833 to 1.2". */
range_text validation_requested_range(double margin);
/* "explains", "does not", "cannot say" */
const char *validation_verdict(agreement_verdict verdict);

wt_status mean_ratio_make(const model_variant *t, mean_ratio *mean, wt_error *err) WT_NODISCARD;
/* Interval of 95 % of exp(value). */
wt_interval validation_factor(double value, double error, double df);

/* That of 95 % of a shear stress that is asked for, with the error of its value. */
wt_interval required_shear_interval(double value, double error, double df);
/* The shear stress that the record asks for, and what is left with it. */
wt_status required_shear_make(validation *v, wt_error *err) WT_NODISCARD;
void required_shear_set_keys(const validation *v, table_writer *t);
/* The largest wavenumber that it asks for, all else as used. */
wt_status cutoff_set_keys(const validation *v, table_writer *t, wt_error *err) WT_NODISCARD;

/* Table "validation_sources"; `advice`: what would narrow the answer most, and what would settle it
 * where it is open. */
typedef struct source_advice {
    char narrows[320], settles[320];
} source_advice;
/* The words of a number that is drawn, and of what makes its error smaller. */
const char *source_of_draw(flow_draw draw, const char **remedy);
wt_status sources_make(const validation *v, source_advice *advice, wt_table **table,
                       wt_error *err) WT_NODISCARD;

/* Table "validation_choices", and the ranges of the numbers over all rows and over those that the
 * record leaves. */
typedef struct choice_ranges {
    double all[SETTING_NUMBERS][2], kept[SETTING_NUMBERS][2]; /* NaN: not known */
    char narrows[320];
} choice_ranges;
wt_status choices_make(const validation *v, const table_view *what_if, choice_ranges *ranges,
                       wt_table **table, wt_error *err) WT_NODISCARD;

#endif
