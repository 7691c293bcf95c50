/* Fits single curves of a case as its run does, with the material of the run kept in memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_RUN_REFIT_H
#define WT_CASE_RUN_REFIT_H

#include "weartrack/case.h"

typedef struct case_refit case_refit;
case_refit *case_refit_new(const wt_formats *formats); /* borrows the formats */
void case_refit_free(case_refit *refit);               /* accepts NULL */
/* Forgets the material, for example after a change of the DMA files. */
void case_refit_forget(case_refit *refit);

typedef struct refit_curve {
    const char *group; /* "bulk" or "track" */
    const char *file;  /* as in the column of the table */
    size_t curve;
    double contact_point; /* [m]; NaN: that of the manual overrides, else fitted */
} refit_curve;

/* Fits one curve. `tables` receives its row and its samples. The text of the case is the one of
 * `path`, saved or not. */
wt_status case_refit_curve(case_refit *refit, const char *xml, size_t length, const char *path,
                           const refit_curve *which, wt_log *log, wt_indent_tables *tables,
                           wt_error *err) WT_NODISCARD;

#endif
