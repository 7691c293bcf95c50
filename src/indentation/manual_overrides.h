/* What was chosen by hand for files and curves. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_MANUAL_OVERRIDES_H
#define WT_INDENTATION_MANUAL_OVERRIDES_H

#include "core/table/registry.h"
#include "job/inputs.h"

typedef enum choice_kind {
    CHOICE_EXCLUDE,
    CHOICE_CONTACT_POINT,
    CHOICE_SPRING_CONSTANT,
    CHOICE_SENSITIVITY,
    CHOICE_TIP,
    CHOICE_KINDS
} choice_kind;

/* The values of a choice, of which its kind says one. */
typedef struct choice_values {
    double contact_point, spring_constant, sensitivity;
    wt_tip tip;
} choice_values;

typedef struct manual_override {
    choice_kind kind;
    size_t row;
    const char *file, *value, *note; /* borrowed from the table */
    double curve;                    /* NaN: all of the file */
    choice_values values;
    wt_contact_table *contact; /* of its tip */
    const flow_file *of;       /* after manual_overrides_bind */
    size_t n_curves;           /* that it was applied to */
} manual_override;

/* Empty without a file. */
typedef struct manual_overrides {
    const char *path, *group; /* borrowed from the job */
    wt_result *tables;
    manual_override *choice;
    size_t n;
} manual_overrides;

/* The choices for the group of the job. manual_overrides_clear also after a failure. */
wt_status manual_overrides_read(const wt_indent_job *job, const wt_job *work,
                                manual_overrides *choices, wt_error *err) WT_NODISCARD;
/* Finds the file of each: WT_E_NOT_FOUND if there is none, or several. */
wt_status manual_overrides_bind(manual_overrides *choices, const flow_files *files,
                                wt_error *err) WT_NODISCARD;

/* What is chosen for a file, on top of what is there; contact and tip stay if none is. */
void manual_overrides_of_file(const manual_overrides *choices, const flow_file *file,
                              wt_read_options *read, const wt_contact_table **contact,
                              const wt_tip **tip);
/* What is chosen for a curve; NaN and NULL: nothing. */
typedef struct curve_choice {
    double contact_point;
    const manual_override *exclude;
} curve_choice;
/* Counts the curve. */
curve_choice manual_overrides_of_curve(manual_overrides *choices, const flow_file *file,
                                       size_t curve);
/* What it makes of the fit of the curve: verdict and reason. */
void manual_overrides_check(const curve_choice *choice, wt_indent_fit *fit);

/* Appends what was applied to the table "choices", which is made if it is NULL; one that met no
 * curve is WT_E_NOT_FOUND. */
wt_status manual_overrides_table(const manual_overrides *choices, const wt_job *work,
                                 wt_table **table, wt_error *err) WT_NODISCARD;
void manual_overrides_clear(manual_overrides *choices);

#endif
