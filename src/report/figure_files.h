/* Files of a figure: data and script before drawing, pictures after it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_FIGURE_FILES_H
#define WT_REPORT_FIGURE_FILES_H

#include "report/page.h"
#include "report/report_files.h"
#include "weartrack/report.h"

/* Smallest width of figures with panels side by side [m]: the text width of a page. */
extern const double figure_text_width;

/* Returns the suffix of the i-th format, "svg", "pdf", "png", which is bit i of the options; NULL
 * past the last one. */
const char *figure_format_name(size_t i);
/* Parses "svg,pdf" for a parameter. */
wt_status figure_formats_read(const char *text, void *member, wt_error *err) WT_NODISCARD;
/* Checks that a font name is safe in scripts and on the page. */
wt_status figure_font_check(const void *member, wt_error *err) WT_NODISCARD;

/* Writes data and script and stores them in `figure`. */
wt_status figure_write(const report_folder *folder, const wt_report_options *options,
                       drawn_figure *figure, wt_error *err) WT_NODISCARD;
/* Reads the picture for the page and adds sizes to the pictures for a paper. */
wt_status figure_collect(const report_folder *folder, const wt_report_options *options,
                         drawn_figure *figure, wt_error *err) WT_NODISCARD;

#endif
