/* The indentation table: its columns, in one place for the job that writes it and those that read
 * it. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_INDENTATION_H
#define WEARTRACK_FLOW_INDENTATION_H

#include "weartrack/flow.h"

/* One fitted (or refused) curve of a batch. */
typedef struct flow_indentation {
    size_t curve; /* number in its file */
    double x, y;
    const char *file;
    const char *spot;
    double equivalent_frequency; /* [rad/s], NaN if unknown */
    wt_indent_fit fit;
} flow_indentation;

wt_status flow_indentation_table(const char *group, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_indentation_add(wt_table *table, const flow_indentation *row,
                               wt_error *err) WT_NODISCARD;

/* Appends the whole curve (approach and retract) and its indentation branch with the fit to the
 * curve tables of `tables`, which are made if they are NULL. */
wt_status flow_curve_tables_add(wt_indent_tables *tables, const char *group, const char *file,
                                const wt_force_curve *curve, const wt_indent_fit *fit,
                                const wt_contact_table *contact, double poisson_ratio,
                                wt_error *err) WT_NODISCARD;

#endif
