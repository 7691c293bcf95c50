/* Manual overrides for files and curves. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_MANUAL_OVERRIDES_H
#define WT_INDENTATION_MANUAL_OVERRIDES_H

#include "core/table/registry.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

typedef enum choice_kind {
    CHOICE_EXCLUDE,
    CHOICE_CONTACT_POINT,
    CHOICE_BASELINE_FROM,
    CHOICE_BASELINE_TO,
    CHOICE_SPRING_CONSTANT,
    CHOICE_SENSITIVITY,
    CHOICE_TIP,
    CHOICE_KINDS
} choice_kind;

/* Values of an override. Its kind determines the valid member. */
typedef struct choice_values {
    double contact_point, baseline_from, baseline_to, spring_constant, sensitivity;
    wt_tip tip;
} choice_values;

typedef struct manual_override {
    choice_kind kind;
    size_t row;
    const char *file, *value, *note; /* borrowed from the table */
    double curve;                    /* NaN: the whole file */
    choice_values values;
    wt_contact_table *contact; /* contact table of its tip; owned */
    const flow_file *of;       /* set by manual_overrides_bind */
    size_t n_curves;           /* curves to which it was applied */
} manual_override;

/* List of overrides; empty if the job names no file. */
typedef struct manual_overrides {
    const char *path, *group; /* borrowed from the job */
    wt_result *tables;
    manual_override *choice;
    size_t n;
} manual_overrides;

/* Reads the overrides for the group of the job. The caller must call manual_overrides_clear after a
 * failure too. */
wt_status manual_overrides_read(const wt_indent_job *job, const wt_job *work,
                                manual_overrides *choices, wt_error *err) WT_NODISCARD;
/* Finds the file of each override. The error is WT_E_NOT_FOUND without a match and WT_E_ARG with
 * several. */
wt_status manual_overrides_bind(manual_overrides *choices, const flow_files *files,
                                wt_error *err) WT_NODISCARD;

/* Applies the overrides of a file to `read`. Without an override `contact` and `tip` do not change.
 */
void manual_overrides_apply_file(const manual_overrides *choices, const flow_file *file,
                                 wt_read_options *read, const wt_contact_table **contact,
                                 const wt_tip **tip);
/* Overrides of one curve; NaN and NULL if there are none. */
typedef struct curve_choice {
    double contact_point, baseline_from, baseline_to;
    const manual_override *exclude;
} curve_choice;
/* Returns the overrides of a curve and counts the curve. */
curve_choice manual_overrides_curve_choice(manual_overrides *choices, const flow_file *file,
                                           size_t curve);
/* Applies the overrides to the fit of the curve: verdict and reason. */
void manual_overrides_apply_fit(const curve_choice *choice, wt_indent_fit *fit);

/* Appends the applied overrides to the table "choices" and creates the table if it is NULL. An
 * override without a curve is WT_E_NOT_FOUND. */
wt_status manual_overrides_table(const manual_overrides *choices, const wt_job *work,
                                 wt_table **table, wt_error *err) WT_NODISCARD;
void manual_overrides_clear(manual_overrides *choices);

#endif
