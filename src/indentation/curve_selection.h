/* Selection of curves and their samples for the table "curves". Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CURVE_SELECTION_H
#define WT_INDENTATION_CURVE_SELECTION_H

#include "core/table/registry.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

typedef struct selected_sample {
    wt_segment_kind segment;
    double displacement, force, indentation, fitted_force;
} selected_sample;

typedef struct selected_curve {
    const char *file; /* borrowed from the list of files */
    size_t curve;
    double error;  /* relative error of the modulus */
    bool by_error; /* stored only while it is among the worst curves */
    selected_sample *sample;
    size_t n;
} selected_curve;

/* Curves that the option `--curves` requests. */
typedef struct curve_selection {
    bool median, rejected, all;
    size_t max_worst, n_worst;
    const char *const *terms; /* [n_terms] borrowed from the job; a term FILE:N names one curve */
    bool *matched;            /* [n_terms] true if a curve matched the term */
    size_t n_terms;
    selected_curve *curve; /* [n] in the order of the rows */
    size_t n;
} curve_selection;

/* Reads the selection terms of the job. The caller must call curve_selection_clear after a failure
 * too. */
wt_status curve_selection_begin(const wt_indent_job *job, curve_selection *selection,
                                wt_error *err) WT_NODISCARD;
/* Stores the samples of the curve of the next row if a term selects it. */
void curve_selection_add(curve_selection *selection, const flow_file *file,
                         const wt_force_curve *curve, const wt_indent_fit *fit,
                         const wt_contact_table *contact, const wt_indent_options *options);
/* Appends the curves to the table "curves" and creates the table if it is NULL. A named curve that
 * was not found is WT_E_NOT_FOUND. */
wt_status curve_selection_table(const curve_selection *selection, const char *group,
                                wt_table **table, wt_error *err) WT_NODISCARD;
void curve_selection_clear(curve_selection *selection);

#endif
