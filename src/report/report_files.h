/* Files of a report: those of the library by name, others by path, read and written.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_REPORT_FILES_H
#define WT_REPORT_REPORT_FILES_H

#include "report/report_text.h"

/* Text of "page.css", "paper.gp", ...; NULL if the library has none of that name. Static. */
const char *file_of_library(const char *name);
/* Appends a whole file of at most `limit` bytes. */
wt_status file_read(const char *path, size_t limit, text_buffer *text, wt_error *err) WT_NODISCARD;
/* Writes a file that is none of the user's yet, in a temporary folder. */
wt_status file_write(const char *path, const char *bytes, size_t length,
                     wt_error *err) WT_NODISCARD;
/* Writes a file that the user named: whole or not at all, and none that was read. */
wt_status file_put(const char *path, const text_buffer *text, wt_error *err) WT_NODISCARD;
/* A built-in plot style by name: all that a case may ask for, as a style can run any command. */
wt_status style_find(const char *name, const char **text, wt_error *err) WT_NODISCARD;
/* Appends a plot style: a built-in one by name, NULL = "paper"; anything with a slash or ending in
 * .gp is a file. */
wt_status file_style(const char *style, text_buffer *text, wt_error *err) WT_NODISCARD;

#endif
