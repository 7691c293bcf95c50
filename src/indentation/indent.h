/* Combined results of all curves of a group, and checks of the job. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_INDENT_H
#define WT_INDENTATION_INDENT_H

#include "core/table/registry.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

/* Creates the contact table of a tip for depths from 10 pm to 0.1 mm. */
wt_status indent_contact_table(const wt_tip *tip, wt_contact_table **table,
                               wt_error *err) WT_NODISCARD;

/* Sum over the shifts of the moduli that are not zero. */
typedef struct indent_shift_sum {
    double sum;
    size_t n;
} indent_shift_sum;

/* Sums over the curves with a modulus. */
typedef struct indent_summary {
    size_t n;
    indent_shift_sum bend, loss, loss_error, left_out; /* relative to the modulus */
    /* Changes with the range of the fit, times their weights, and the sums of the weights. A weight
     * is one over the variance by noise. */
    double range_sum[WT_FIT_RANGES], range_weight[WT_FIT_RANGES];
    size_t n_unknown_loss;              /* curves with a loss of unknown effect on the modulus */
    double variance;                    /* sum of the relative variances of the moduli */
    double max_depth;                   /* largest indentation [m] */
    double (*misfits)[WT_MISFIT_TERMS]; /* [n_misfits] cosines of curves that have them */
    size_t n_misfits;
} indent_summary;

void indent_summary_add(indent_summary *to, const wt_indent_fit *fit,
                        const wt_indent_options *options);
void indent_summary_clear(indent_summary *summary);
/* Relative error that the misfit of the law gives to all moduli: the largest mean change of the
 * modulus with a range of the fit, without its noise, and the pulls that the fits left out. A
 * change below the noise of the most precise range is not excluded, so that the error is at least
 * that noise. NaN if no curve was fitted in a second range. */
double indent_summary_range_error(const indent_summary *summary);
/* Mean relative change of the modulus with one range of the fit, and its error by noise; NaN if no
 * curve has enough samples in the range. */
wt_estimate indent_summary_range_shift(const indent_summary *summary, int range);
/* Reports the shifts that all moduli share and tests the mean residual. */
void indent_summary_report(const indent_summary *summary, const wt_indent_job *job,
                           const wt_job *work, table_writer *rows);

/* Curves for the modulus against depth, including curves that one modulus does not describe. */
typedef struct indent_depths {
    wt_curve_residuals *curve; /* [n] */
    size_t n;
    long n_spots;
    const char *last_spot; /* borrowed */
} indent_depths;

/* Collects the data of a curve on the modulus against depth. Returns false and sets all members to
 * NaN if there are none or `asked` is false. */
bool indent_depth_curve(const wt_indent_fit *fit, const wt_force_curve *curve, bool asked,
                        wt_curve_residuals *to);
void indent_depths_add(indent_depths *to, const wt_curve_residuals *curve, const char *spot);
/* Adds the table "modulus_depth" if there are such curves. */
wt_status indent_depths_table(const indent_depths *depths, const wt_indent_job *job,
                              const wt_contact_table *contact, wt_indent_tables *tables,
                              wt_error *err);
void indent_depths_clear(indent_depths *depths);
/* Parameter check of a wt_estimate: the standard error must be below the value. */
wt_status indent_error_check(const void *estimate, wt_error *err);
/* Parses a tip for the parameter table. The thickness and the bond of the sample do not change. */
wt_status indent_read_tip(const char *text, void *tip, wt_error *err);
wt_status indent_check_tip(const void *tip, wt_error *err);
/* Writes the tip as keys of the indentation table, and reads it. Returns false for a table of
 * several tips, or without a valid tip. */
void indent_set_tip_keys(const wt_tip *tip, table_writer *rows);
bool indent_tip_from_table(const table_view *indentation, wt_tip *tip);
/* True if the law of a thin sample that is bonded to its base holds. */
bool indent_is_incompressible(const wt_indent_options *options);
/* Checks the parameters and their combinations. */
wt_status indent_job_check(const wt_indent_job *job, wt_error *err);
/* Describes the limits of the fit. Returns false if there are none. */
bool indent_range_text(const wt_indent_options *options, char *text, size_t size);

#endif
