/* Inside the indentation job: what is said of all curves together, and of the job itself.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_INDENT_H
#define WT_INDENTATION_INDENT_H

#include "core/table/registry.h"
#include "job/inputs.h"

/* The contact function of a tip over all depths that curves have, of 10 pm to 0.1 mm. */
wt_status indent_contact_table(const wt_tip *tip, wt_contact_table **table,
                               wt_error *err) WT_NODISCARD;

/* What moduli are shifted by, where they are. */
typedef struct indent_shifts {
    double sum;
    size_t n;
} indent_shifts;

/* The curves with a modulus. */
typedef struct indent_summary {
    size_t n;
    indent_shifts bend, loss, loss_error, misfit; /* relative to the modulus */
    size_t n_misfit;                              /* that show one */
    size_t n_unknown;                  /* that lose what their moduli are not known to hold */
    double deepest;                    /* largest indentation [m] */
    double (*misfits)[WT_CURVE_WAVES]; /* [n_misfits] of those that have one */
    size_t n_misfits;
    double (*contacts)[WT_CONTACT_ESTIMATORS]; /* [n] by other estimators; NULL: not asked for */
} indent_summary;
wt_status indent_summary_add(indent_summary *to, const wt_indent_fit *fit,
                             const wt_indent_options *options, wt_error *err);
void indent_summary_clear(indent_summary *together);
/* What curves of such a depth cannot show, with what would, in words. */
void indent_systematic_errors(const wt_indent_job *job, double depth, char *text, size_t size);
/* Says what moves all moduli alike, so that their scatter does not show it, tests the mean residual
 * and says where other estimators see contact. */
wt_status indent_summary_report(const indent_summary *together, const wt_indent_job *job,
                                const wt_job *work, table_writer *rows, wt_error *err);

/* Whether it loses work, and nothing says what that does to its modulus. */
bool indent_loss_is_unknown(const wt_indent_fit *fit);

/* The curves for the modulus against depth, also those that one modulus does not describe. */
typedef struct indent_depths {
    wt_depth_curve *curve; /* [n] */
    size_t n;
    long n_spots;
    const char *last_spot; /* borrowed */
} indent_depths;
/* What a curve tells of depth, if it is asked; false, and all of it NaN: nothing. */
bool indent_depth_curve(const wt_indent_fit *fit, const wt_force_curve *curve, bool asked,
                        wt_depth_curve *to);
wt_status indent_depths_add(indent_depths *to, const wt_depth_curve *curve, const char *spot,
                            wt_error *err);
/* Table "modulus_depth", if there are such curves. */
wt_status indent_depths_table(const indent_depths *depths, const wt_indent_job *job,
                              const wt_contact_table *contact, wt_indent_tables *tables,
                              wt_error *err);
void indent_depths_clear(indent_depths *depths);

/* Of a wt_estimate, for records: its error is below it. */
wt_status indent_error_check(const void *estimate, wt_error *err);
/* A tip in words, for records; what is known of the sample stays. */
wt_status indent_read_tip(const char *text, void *tip, wt_error *err);
wt_status indent_check_tip(const void *tip, wt_error *err);
/* The parameters, and what they say together. */
wt_status indent_job_check(const wt_indent_job *job, wt_error *err);
/* The limits of the fit in words; false if there are none. */
bool indent_range_text(const wt_indent_options *options, char *text, size_t size);

#endif
