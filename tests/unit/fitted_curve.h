/* Fit of synthetic curves: a curve and a workspace for all tests of a program.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_FITTED_CURVE_H
#define WT_TESTS_FITTED_CURVE_H

#include "assert_near.h"
#include "synthetic_curve.h"

#include "weartrack/indentation.h"

static curve_data data;
static wt_indent_workspace *workspace;

static inline int make_workspace(void **state)
{
    (void)state;
    return (workspace = wt_indent_workspace_new()) == NULL;
}

static inline int free_workspace(void **state)
{
    (void)state;
    wt_indent_workspace_free(workspace);
    return 0;
}

static inline wt_contact_table *table_of(const curve_truth *t)
{
    wt_contact_table *table = NULL;
    assert_int_equal(wt_contact_table_new(&t->tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    return table;
}

/* Fits `data` with the options. */
static inline wt_indent_fit fit_with(const curve_truth *t, const wt_indent_options *options)
{
    wt_contact_table *table = table_of(t);
    wt_indent_fit fit;
    wt_error err = WT_ERROR_INIT;
    if (wt_indent_fit_curve(table, options, data.height, data.force, data.time, t->n,
                            t->spring_constant, workspace, &fit, &err) != WT_OK)
        fail_msg("%s", err.message);
    wt_contact_table_free(table);
    return fit;
}

/* Many curves without noise; the lack of fit is not tested. */
static inline wt_indent_options every_curve(void)
{
    wt_indent_options options = wt_indent_defaults();
    options.misfit_p_threshold = 0;
    return options;
}

static inline void assert_accepted(const wt_indent_fit *fit)
{
    if (fit->verdict != WT_CURVE_ACCEPTED)
        fail_msg("%s: %s", wt_curve_verdict_id(fit->verdict), fit->reason);
}

#endif
