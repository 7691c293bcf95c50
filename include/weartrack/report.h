/* weartrack - report room: from a result to one page, or a folder with page, data, scripts and
 * pictures.
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
    unsigned figures;     /* pictures for a paper, of wt_figure_formats; 0: those of the page */
    double width;         /* of a figure [m], those with panels beside each other are 0.17 m wide at
                             least; NaN, the default: that of the style */
    const char *language; /* of figures and page: "en", the default, "de", "fr", "nl" */
    const char *font;     /* of all type in figures; NULL, the default: that of the style */
} wt_report_options;

typedef enum wt_figure_formats {
    WT_FIGURE_SVG = 1, /* as large as asked for; the page's has no size of its own */
    WT_FIGURE_PDF = 2,
    WT_FIGURE_PNG = 4 /* 600 dots in an inch */
} wt_figure_formats;

WT_API wt_report_options wt_report_defaults(void);
WT_API const wt_params *wt_report_params(void);

/* Whether wt_report_write could begin: the style is known and the folder may be made or replaced.
 * For use before long work; nothing is left behind. Options NULL: the defaults. */
WT_API wt_status wt_report_check(const char *folder, const wt_report_options *options,
                                 wt_error *err) WT_NODISCARD;

/* Whether this computer has a font, by fc-match of Fontconfig, through which gnuplot finds it for
 * PDF and PNG. If not, the name of the one that stands in goes into `instead`, cut to its size.
 * True of NULL and where fc-match cannot be asked. */
WT_API bool wt_report_has_font(const char *font, char *instead, size_t size);

/* The page of a report written to a place: that itself if its name ends in .html and it is no
 * folder, else index.html in it. New, NULL without memory. */
WT_API char *wt_report_page(const char *place) WT_NODISCARD;

/* Writes FOLDER/index.html, which needs no other file, FOLDER/plots/NAME.tsv, NAME.gp, NAME.svg and
 * the style file, for every figure whose tables are in the result; of a FOLDER that ends in .html
 * the page alone, under that name. A new folder appears whole or not at all; the files of an older
 * report are replaced one by one when all is drawn, and others in it stay. WT_E_TOOL if gnuplot is
 * missing, fails or takes too long (the message carries its words). `progress` is asked while
 * gnuplot runs, too. */
WT_API wt_status wt_report_write(const wt_result *result, const char *folder,
                                 const wt_report_options *options, const wt_progress *progress,
                                 wt_error *err) WT_NODISCARD;

/* Whether a result has curves for the two below: WT_E_EMPTY if not, with what makes them. */
WT_API wt_status wt_report_check_curves(const wt_result *result, wt_error *err) WT_NODISCARD;

/* One self-contained page, the file `path`, to go through the curves of all groups of a result with
 * their fits, which hands back what is chosen by hand for wt_indent_job.choices. WT_E_EMPTY if the
 * result has no table "curves"; WT_E_TOOL if the library was built without dygraphs, which draws on
 * it. */
WT_API wt_status wt_curve_browser_write(const wt_result *result, const char *path,
                                        bool with_provenance, wt_error *err) WT_NODISCARD;

/* Force curves of all groups as a PDF of sheets of A4, twelve on each, with fit, verdict and
 * reason; refused ones first, then doubtful ones. Of the options those that say how to draw; NULL:
 * the defaults. WT_E_EMPTY if the result has no table "curves", WT_E_TOOL as wt_report_write.
 * `progress` is told sheets. */
WT_API wt_status wt_sheets_write(const wt_result *result, const char *path,
                                 const wt_report_options *options, const wt_progress *progress,
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
