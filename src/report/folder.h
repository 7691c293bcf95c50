/* The folder of a report, or its page alone: built under a temporary name, put into its place when
 * it is whole.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FOLDER_H
#define WT_REPORT_FOLDER_H

#include "weartrack/base.h"

/* How index.html says that weartrack wrote it; the version may follow. */
#define REPORT_MARK "<meta name=\"generator\" content=\"weartrack"

/* Whether what goes to a place is one file, the page. */
bool place_is_page(const char *place);

typedef struct report_folder report_folder;
/* Makes a new folder with an empty folder "plots" in it; a path that ends in .html is to have the
 * page alone. WT_E_IO if something else than an older report or an empty folder is at `path`,
 * WT_E_ARG if a file of that report was read; nothing is touched then. */
wt_status folder_open(const char *path, report_folder **folder, wt_error *err) WT_NODISCARD;
const char *folder_plots(const report_folder *folder); /* "plots" in it; borrowed */
/* Writes a file; `name` is relative to the folder. */
wt_status folder_write(const report_folder *folder, const char *name, const char *bytes,
                       size_t length, wt_error *err) WT_NODISCARD;
/* Puts it into its place, of a page alone that; the files of a report that is there are replaced
 * one by one, everything else stays. Frees `folder`, also on failure. */
wt_status folder_commit(report_folder *folder, wt_error *err) WT_NODISCARD;
void folder_discard(report_folder *folder); /* removes it, frees; NULL ok */

#endif
