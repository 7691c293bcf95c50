/* What all curves of a group share and its scatter does not show: spring constant, deflection
 * sensitivity, half-angle and radius of the tip. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CALIBRATION_ERRORS_H
#define WT_INDENTATION_CALIBRATION_ERRORS_H

#include "core/table/registry.h"
#include "indentation/numerics/curve.h"
#include "weartrack/flow.h"

/* Most curves of a group that are fitted anew. */
enum { COMMON_CURVES = 8 };

/* A branch as it was measured. */
typedef struct common_branch {
    double *height, *force, *time; /* [n], of one allocation, that of the height; time: or NULL */
    size_t n;
} common_branch;

typedef struct common_curve {
    common_branch branch[2]; /* approach, retract */
    double spring_constant;
    const wt_contact_table *contact; /* of the tip that it was fitted with; borrowed */
    bool own_tip;                    /* chosen for its file: the moved tips are not its */
} common_curve;

/* What an error does to the modulus, by curves that are fitted anew with the source moved. */
typedef struct calibration_errors {
    bool stated;                     /* else nothing is done */
    double error[WT_COMMON_SOURCES]; /* relative; NaN: not stated */
    double step[WT_COMMON_SOURCES];  /* of the logarithm of the source; 0: the tip has none */
    wt_contact_table *tip[WT_COMMON_SOURCES][2]; /* of moved tips, down and up */
    common_curve curve[COMMON_CURVES];
    double gain[COMMON_CURVES][WT_COMMON_SOURCES];
    size_t n, seen, stride;
} calibration_errors;

wt_status calibration_errors_begin(const wt_indent_job *job, calibration_errors *to,
                                   wt_error *err) WT_NODISCARD;
/* Fits of the workspace take the stated errors of the tip into account, as long as these are there.
 */
void calibration_errors_apply(const calibration_errors *of, wt_indent_workspace *workspace);
/* What a workspace was told, taken from it while a curve with a tip of its own is fitted. */
typedef struct cached_tips {
    tip_move moves[CURVE_TIP_MOVES], any_radius;
} cached_tips;
cached_tips calibration_errors_reset(wt_indent_workspace *workspace);
void calibration_errors_apply_cached(const cached_tips *told, wt_indent_workspace *workspace);
/* Keeps a copy of an accepted curve: of every so many of them. contact: of its tip, as long as the
 * errors are there; own_tip: that is not the one of the job. */
wt_status calibration_errors_store(calibration_errors *to, const wt_force_curve *curve,
                                   const wt_contact_table *contact, bool own_tip,
                                   wt_error *err) WT_NODISCARD;
/* Fits what is kept. workspaces: one for each of the threads. */
wt_status calibration_errors_fit(calibration_errors *to, const wt_indent_options *options,
                                 unsigned threads, wt_indent_workspace *const *workspaces,
                                 wt_error *err) WT_NODISCARD;
void calibration_errors_set_keys(const calibration_errors *of, table_writer *rows);
void calibration_errors_clear(calibration_errors *errors);

const char *calibration_source_text(wt_shared_law_source source);

/* NULL if no group states a common error. names: [n]; a group without curves has no row. */
wt_status modulus_budget_make(const wt_group_data *groups, const char *const *names, size_t n,
                              wt_table **table, wt_error *err) WT_NODISCARD;

#endif
