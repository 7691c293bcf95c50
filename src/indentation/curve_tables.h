/* Force curves as rows of tables. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CURVE_TABLES_H
#define WT_INDENTATION_CURVE_TABLES_H

#include "core/table/registry.h"
#include "weartrack/indentation.h"

/* Adds the results of one curve as a row. `deep` has its data on the modulus against depth. */
void flow_indentation_row_add(table_writer *t, const wt_indent_job *job, const char *file,
                              const char *spot, const wt_force_curve *curve,
                              const wt_indent_fit *fit, const wt_curve_residuals *deep);

/* Appends the whole curve (approach and retract) and its contact part with the fit to the curve
 * tables of `tables`. The function creates tables that are NULL. `options` are those of the fit. */
wt_status flow_curve_tables_add(wt_indent_tables *tables, const char *group, const char *file,
                                const wt_force_curve *curve, const wt_indent_fit *fit,
                                const wt_contact_table *contact, const wt_indent_options *options,
                                wt_error *err) WT_NODISCARD;

/* Appends the modulus against depth of a group. */
wt_status flow_depth_table_add(wt_indent_tables *tables, const char *group,
                               const wt_modulus_profile *depth, wt_error *err) WT_NODISCARD;
/* Computes the fitted forces of the n samples of the approach in contact. `delta` and the order are
 * those of wt_indent_plot_points. time (scratch), model: [n_points of the approach]. */
void fitted_forces(const wt_indent_fit *fit, const wt_indent_options *options,
                   const wt_contact_table *contact, const wt_segment *approach, const double *delta,
                   size_t n, double *time, double *model);

#endif
