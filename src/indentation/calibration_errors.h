/* Systematic errors that all curves of a group share and that their scatter does not show: spring
 * constant, deflection sensitivity, half-angle and radius of the tip, linearity of piezo and
 * detector, thickness of the sample. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CALIBRATION_ERRORS_H
#define WT_INDENTATION_CALIBRATION_ERRORS_H

#include "core/table/registry.h"
#include "indentation/numerics/curve.h"
#include "weartrack/indentation.h"

/* Largest number of curves of a group that are fitted again, and the number if each error is an
 * assumed one, whose effect need not be known as well. */
enum { COMMON_CURVES = 8, ASSUMED_CURVES = 3 };

/* Copy of one branch as measured. */
typedef struct common_branch {
    double *height, *force,
        *time; /* [n] in one allocation that `height` owns; `time` may be NULL */
    size_t n;
} common_branch;

typedef struct common_curve {
    common_branch branch[2]; /* approach, retract */
    double spring_constant, sensitivity_gain;
    double baseline_offset, max_force; /* [N] */
    const wt_contact_table *contact;   /* table of the tip of the fit; borrowed */
    bool without_adhesion;             /* the law of its fit, which a shifted source keeps */
} common_curve;

/* Effect of each error source on the modulus, from curves that are fitted again with a shifted
 * source. */
typedef struct calibration_errors {
    bool active;                           /* if false, nothing is computed */
    bool stated;                           /* an error is stated */
    double error[WT_SYSTEMATIC_SOURCES];   /* relative; NaN if not stated */
    double assumed[WT_SYSTEMATIC_SOURCES]; /* relative, if none is stated; else NaN */
    double step[WT_SYSTEMATIC_SOURCES];    /* step of ln(source); 0 if the tip lacks this size */
    wt_contact_table *tip[WT_SYSTEMATIC_SOURCES][2]; /* tables of the tips shifted down and up;
                                                        of the thickness: assumed and thick */
    common_curve curve[COMMON_CURVES];
    double gain[COMMON_CURVES][WT_SYSTEMATIC_SOURCES];
    double deepest;   /* largest indentation of the stored curves [m] */
    double thickness; /* assumed thickness of the sample [m] */
    size_t n, n_offered, stride;
} calibration_errors;

const char *calibration_source_text(wt_systematic_source source);
void calibration_errors_begin(const wt_indent_job *job, calibration_errors *to);
/* Stores a copy of every n-th accepted curve. `contact` is the table of its tip and must outlive
 * the errors. */
void calibration_errors_store(calibration_errors *to, const wt_force_curve *curve,
                              const wt_indent_fit *fit, const wt_contact_table *contact);
/* Fits the stored curves. `tip` is that of the job; `workspaces` has one workspace for each thread.
 */
wt_status calibration_errors_fit(calibration_errors *to, const wt_tip *tip,
                                 const wt_indent_options *options, unsigned threads,
                                 wt_indent_workspace *const *workspaces,
                                 wt_error *err) WT_NODISCARD;
/* Sets the keys of the errors and of their effects. */
void calibration_errors_set_keys(const calibration_errors *of, table_writer *rows);
void calibration_errors_clear(calibration_errors *errors);

/* Summarises a group. Its interval includes the scatter of the spots and the errors that all curves
 * share; it is NaN if one of them is unknown. */
wt_status modulus_budget_interval(const wt_group_data *group, wt_group_summary *summary,
                                  wt_error *err) WT_NODISCARD;
/* Creates the table modulus_budget. The table is NULL if no group has a systematic error. names:
 * [n]; a group without curves has no row. */
wt_status modulus_budget_create(const wt_group_data *groups, const char *const *names, size_t n,
                                wt_table **table, wt_error *err) WT_NODISCARD;

#endif
