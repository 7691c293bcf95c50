/* The files of a figure: data and script before it is drawn, pictures behind that.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FIGURE_FILES_H
#define WT_REPORT_FIGURE_FILES_H

#include "report/folder.h"
#include "report/page.h"
#include "weartrack/report.h"

/* Ending of the i-th format, "svg", "pdf", "png", which is bit i of the options; NULL past the last
 * one. */
const char *figure_format(size_t i);
/* Reads "svg,pdf", for a record. */
wt_status figure_formats_read(const char *text, void *member, wt_error *err) WT_NODISCARD;
/* Whether a name can be that of a font: it stands in scripts and on the page. */
wt_status figure_font_check(const void *member, wt_error *err) WT_NODISCARD;

/* Has a script, behind the style, write numbers as the language does. */
void figure_decimals(text_buffer *script, const language *l);
/* Appends the data of a figure: its sections, as gnuplot's `index` counts them. */
wt_status figure_data(const figure_drawing *d, text_buffer *to, wt_error *err) WT_NODISCARD;
/* Writes data and script, and keeps them. */
wt_status figure_write(const report_folder *folder, const wt_report_options *options,
                       drawn_figure *figure, wt_error *err) WT_NODISCARD;
/* Reads the picture for the page and makes those for a paper say how large they are. */
wt_status figure_take(const report_folder *folder, const wt_report_options *options,
                      drawn_figure *figure, wt_error *err) WT_NODISCARD;

#endif
