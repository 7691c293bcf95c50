/* Starting gnuplot.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_GNUPLOT_H
#define WT_REPORT_GNUPLOT_H

#include "weartrack/base.h"

/* No picture of a report gets larger. */
#define GNUPLOT_PICTURE_LIMIT ((size_t)64 << 20)

typedef struct gnuplot_call {
    const char *program;          /* a name looked up in PATH, or a path */
    const char *folder;           /* where it runs */
    const char *const *arguments; /* up to NULL */
    size_t size;                  /* bytes that no file it writes gets beyond */
    double limit;                 /* seconds that one picture may take, for the words */
    const bool *late;             /* go_on has ended it because of that */
    bool (*go_on)(void *user);    /* asked all the while; false ends it at once */
    void *user;
} gnuplot_call;

/* Runs gnuplot without a shell, without standard input, without the user's settings, in the C
 * locale (core/system/subprocess.h). WT_E_TOOL if it cannot be started, fails or takes too long;
 * the error carries its words. */
wt_status gnuplot_run(const gnuplot_call *call, wt_error *err) WT_NODISCARD;

#endif
