/* Runs gnuplot.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_GNUPLOT_H
#define WT_REPORT_GNUPLOT_H

#include "weartrack/core.h"

/* Largest size of a picture of a report [byte]. */
#define GNUPLOT_PICTURE_LIMIT ((size_t)64 << 20)

/* Longest name of a font. Names are shorter, and gnuplot 5.4 aborts at one of a thousand letters.
 */
enum { FONT_NAME_LIMIT = 127 };

typedef struct gnuplot_call {
    const char *program;          /* a name looked up in PATH, or a path */
    const char *folder;           /* working folder */
    const char *const *arguments; /* ends with NULL */
    size_t size;                  /* largest size of a written file [byte] */
    double limit;                 /* time limit of one picture [s], for the message */
    const bool *timed_out;        /* go_on has ended it because of the time limit */
    bool (*go_on)(void *user);    /* called repeatedly; false ends gnuplot */
    void *user;
} gnuplot_call;

/* Runs gnuplot without a shell, standard input or user settings, in the C locale
 * (core/system/subprocess.h). WT_E_TOOL if it cannot be started, fails or exceeds the time limit;
 * the error has its message. */
wt_status gnuplot_run(const gnuplot_call *call, wt_error *err) WT_NODISCARD;

#endif
