/* Files and folder of a report: embedded files by name, others by path.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_REPORT_FILES_H
#define WT_REPORT_REPORT_FILES_H

#include "report/report_tables.h"
#include "report/report_text.h"
#include "weartrack/core.h"

/* Returns the text of an embedded file such as "page.css" or "paper.gp"; NULL if there is none of
 * that name. Static. */
const char *embedded_file_text(const char *name);
/* Appends a whole file of at most `limit` bytes. */
wt_status read_whole_file(const char *path, size_t limit, text_buffer *text,
                          wt_error *err) WT_NODISCARD;
/* Finds a built-in plot style by name. A case may only use these, as a style can run any command.
 */
wt_status find_built_in_style(const char *name, const char **text, wt_error *err) WT_NODISCARD;
/* Appends a plot style: a built-in one by name, NULL = "paper". A name with a slash or ending in
 * .gp is a file. */
wt_status read_style(const char *style, text_buffer *text, wt_error *err) WT_NODISCARD;

/* Mark of weartrack in index.html; the version may follow. */
#define REPORT_MARK "<meta name=\"generator\" content=\"weartrack"

/* True if the report at a path is one file, the page. */
bool path_is_page(const char *place);

typedef struct report_folder report_folder;
/* Creates a temporary folder with an empty folder "plots". A path that ends in .html receives only
 * the page. WT_E_IO if `path` is neither an older report nor an empty folder, WT_E_ARG if a file of
 * that report was read; nothing is changed then. */
wt_status folder_open(const char *path, report_folder **folder, wt_error *err) WT_NODISCARD;
const char *folder_plots_path(const report_folder *folder); /* "plots" in it; borrowed */
/* Writes a file; `name` is relative to the folder. */
wt_status folder_write(const report_folder *folder, const char *name, const char *bytes,
                       size_t length, wt_error *err) WT_NODISCARD;
/* Moves the report, or the page alone, to its final path. Files of an existing report are replaced
 * one by one, everything else stays. Frees `folder`, also on failure. */
wt_status folder_commit(report_folder *folder, wt_error *err) WT_NODISCARD;
void folder_discard(
    report_folder *folder); /* Removes the temporary folder and frees. Accepts NULL. */

#endif
