/* Files of a report: embedded ones by name, others by path.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_REPORT_FILES_H
#define WT_REPORT_REPORT_FILES_H

#include "report/report_text.h"

/* Returns the text of an embedded file such as "page.css" or "paper.gp"; NULL if there is none of
 * that name. Static. */
const char *embedded_file_text(const char *name);
/* Appends a whole file of at most `limit` bytes. */
wt_status read_whole_file(const char *path, size_t limit, text_buffer *text,
                          wt_error *err) WT_NODISCARD;
/* Writes a file in a temporary folder. */
wt_status write_temporary_file(const char *path, const char *bytes, size_t length,
                               wt_error *err) WT_NODISCARD;
/* Writes a file that the user named: complete or not at all. It does not overwrite a file that was
 * read. */
wt_status write_user_file(const char *path, const text_buffer *text, wt_error *err) WT_NODISCARD;
/* Finds a built-in plot style by name. A case may only use these, as a style can run any command.
 */
wt_status find_built_in_style(const char *name, const char **text, wt_error *err) WT_NODISCARD;
/* Appends a plot style: a built-in one by name, NULL = "paper". A name with a slash or ending in
 * .gp is a file. */
wt_status read_style(const char *style, text_buffer *text, wt_error *err) WT_NODISCARD;
/* Words of the verdict of a curve (a wt_curve_verdict). */
const char *verdict_words(int verdict);
/* Appends a JSON object with the words of each verdict without a usable modulus. */
void append_verdict_words(text_buffer *to);

#endif
