/* weartrack - report: writes a result as one page, or as a folder with page, data, scripts and
 * figures.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_REPORT_H
#define WEARTRACK_REPORT_H

#include "weartrack/core.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wt_report_options {
    const char *style; /* name of a built-in plot style, or path of a gnuplot script, which can run
                          any command; default "paper" */
    const char *gnuplot;  /* program; default "gnuplot" */
    bool with_provenance; /* version, command line and times on the page; default true */
    double gnuplot_time;  /* time limit for drawing one figure [s]; default 120 */
    unsigned figures;     /* pictures for a paper, WT_FIGURE_* flags; 0: only those of the page */
    double width; /* width of a figure [m]; figures with panels side by side have at least 0.17 m;
                     NaN (default): that of the style */
    const char *font;   /* font of the figures; NULL (default): that of the style */
    const char *figure; /* name of the only figure, see wt_figure_get; NULL (default): all */
} wt_report_options;

typedef enum wt_figure_formats {
    WT_FIGURE_SVG = 1, /* with a fixed size, unlike the picture of the page */
    WT_FIGURE_PDF = 2,
    WT_FIGURE_PNG = 4 /* 600 dpi */
} wt_figure_formats;

WT_API wt_report_options wt_report_defaults(void);
WT_API const wt_params *wt_report_params(void);

/* Checks before a long computation that wt_report_write can begin: the style exists and the folder
 * may be created or replaced. It leaves no files. options NULL = defaults. */
WT_API wt_status wt_report_check(const char *folder, const wt_report_options *options,
                                 wt_error *err) WT_NODISCARD;

/* Returns true if this computer has the font. It asks fc-match of Fontconfig, which gnuplot uses
 * for PDF and PNG. If the font is missing, `instead` receives the name of the substitute, truncated
 * to `size`. True for NULL and if fc-match does not run. */
WT_API bool wt_report_font_is_available(const char *font, char *instead, size_t size);

/* Returns the path of the page of a report: `place` itself if it ends in .html and is not a folder,
 * else index.html in it. New string, NULL when out of memory. */
WT_API char *wt_report_page_path(const char *place) WT_NODISCARD;
/* True if the page of a place is one that weartrack wrote; without provenance it cannot be told. */
WT_API bool wt_report_is_at(const char *place);

/* Writes FOLDER/index.html, which is self-contained, and for each figure whose tables are in the
 * result FOLDER/plots/NAME.tsv, NAME.gp and NAME.svg, and the style file. If FOLDER ends in .html,
 * only the page is written under that name. A new folder appears complete or not at all. Files of
 * an older report are replaced one by one after all figures are drawn; other files are not touched.
 * WT_E_TOOL if gnuplot is missing, fails or exceeds the time limit (the error has its message).
 * `progress` is also called while gnuplot runs. */
WT_API wt_status wt_report_write(const wt_result *result, const char *folder,
                                 const wt_report_options *options, const wt_progress *progress,
                                 wt_error *err) WT_NODISCARD;

/* Information on the figures of the library, in the order of the page. */
typedef struct wt_figure_info {
    const char *name; /* "force_displacement" */
    const char *title;
    const char *table; /* table of the figure; drawn if the result has it with at least one row */
    const char *other_tables; /* further tables that it uses, separated by blanks; "" */
} wt_figure_info;
WT_API size_t wt_figure_count(void);
WT_API wt_figure_info wt_figure_get(size_t i); /* All members are NULL past the last figure. */

#ifdef __cplusplus
}
#endif
#endif
