/* Force of a fit along a curve. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_FITTED_FORCE_H
#define WT_INDENTATION_FITTED_FORCE_H

#include "weartrack/indentation.h"

/* Computes the fitted forces of the n samples of the approach in contact. `delta` and the order are
 * those of wt_indent_plot_points. time (scratch), model: [n_points of the approach]. */
void fitted_forces(const wt_indent_fit *fit, const wt_indent_options *options,
                   const wt_contact_table *contact, const wt_segment *approach, const double *delta,
                   size_t n, double *time, double *model);

#endif
