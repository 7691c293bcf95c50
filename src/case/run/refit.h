/* Computes a case again after a change of it, with what has not changed kept in memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_RUN_REFIT_H
#define WT_CASE_RUN_REFIT_H

#include "weartrack/case.h"

typedef struct case_refit case_refit;
case_refit *case_refit_new(const wt_formats *formats); /* borrows the formats */
void case_refit_free(case_refit *refit);               /* accepts NULL */
/* Forgets all that is kept, for example after a change of data files. */
void case_refit_forget(case_refit *refit);

typedef struct refit_curve {
    const char *group; /* "bulk" or "track" */
    const char *file;  /* as in the column of the table */
    size_t curve;
    /* Another value of an option of wt_indent_params, such as "baseline-to"; "": none. It takes
     * precedence over the manual overrides. */
    const char *option, *value;
} refit_curve;

/* Fits one curve. `tables` receives its row and its samples. The text of the case is the one of
 * `path`, saved or not. */
wt_status case_refit_curve(case_refit *refit, const char *xml, size_t length, const char *path,
                           const refit_curve *which, wt_log *log, wt_indent_tables *tables,
                           wt_error *err) WT_NODISCARD;
/* Runs the text of a case for these tables (names separated by blanks) as wt_run_case does. The
 * rubber and the surface are kept until their sections or files change. */
wt_status case_refit_run(case_refit *refit, const char *xml, size_t length, const char *path,
                         const char *tables, const wt_run_options *options, wt_result **result,
                         wt_error *err) WT_NODISCARD;

#endif
