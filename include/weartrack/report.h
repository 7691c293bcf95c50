/* weartrack - report room: from a result to one folder with data, scripts, pictures and a page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_REPORT_H
#define WEARTRACK_REPORT_H

#include "weartrack/data.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wt_report_options {
    const char *style;   /* name of a built-in plot style, or path of one, a gnuplot script that can
                            run any command; default "paper" */
    const char *gnuplot; /* program; default "gnuplot" */
    bool with_provenance; /* version, command line and times on the page; default true */
    double gnuplot_time;  /* the longest that one figure may take to draw [s]; default 120 */
    unsigned threads;     /* figures drawn at a time; 0 = one per processor */
} wt_report_options;
WT_API wt_report_options wt_report_defaults(void);
WT_API const wt_params *wt_report_params(void);

/* Whether wt_report_write could begin: the style is known and the folder may be made or replaced.
 * For use before long work; nothing is left behind. Options NULL: the defaults. */
WT_API wt_status wt_report_check(const char *folder, const wt_report_options *options,
                                 wt_error *err) WT_NODISCARD;

/* Writes FOLDER/index.html (self-contained), FOLDER/plots/NAME.tsv, NAME.gp, NAME.svg and the style
 * file, for every figure whose tables are in the result. A new folder appears whole or not at all;
 * the files of an older report are replaced one by one when all is drawn, and others in it stay.
 * WT_E_TOOL if gnuplot is missing, fails or takes too long (the message carries its words).
 * `progress` is asked while gnuplot runs, too. */
WT_API wt_status wt_report_write(const wt_result *result, const char *folder,
                                 const wt_report_options *options, const wt_progress *progress,
                                 wt_error *err) WT_NODISCARD;

/* One self-contained page, the file `path`, to go through the curves of all groups of a result with
 * their fits, which hands back what is chosen by hand for wt_indent_job.choices. WT_E_EMPTY if the
 * result has no table "curves"; WT_E_TOOL if the library was built without dygraphs, which draws on
 * it. */
WT_API wt_status wt_browse_write(const wt_result *result, const char *path, bool with_provenance,
                                 wt_error *err) WT_NODISCARD;

/* The figures this library knows, in the order of the page. */
typedef struct wt_figure_info {
    const char *name; /* "force_displacement" */
    const char *title;
    const char *table;  /* it is drawn if a result has this table with a row at least */
    const char *beside; /* other tables that it shows something of, parted by blanks; "" */
} wt_figure_info;
WT_API size_t wt_figure_count(void);
WT_API wt_figure_info wt_figure_get(size_t i); /* all NULL past the last one */

#ifdef __cplusplus
}
#endif
#endif
