/* The folder of a report: built beside its place, put there when it is whole.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FOLDER_H
#define WT_REPORT_FOLDER_H

#include "weartrack/base.h"

/* How index.html says that weartrack wrote it; the version may follow. */
#define WT_REPORT_MARK "<meta name=\"generator\" content=\"weartrack"

typedef struct wt_folder wt_folder;
/* Makes a new folder with an empty folder "plots" in it, beside `path`. WT_E_IO if something else
 * than an older report or an empty folder is at `path`; nothing is touched then. */
wt_status wt_folder_open(const char *path, wt_folder **folder, wt_error *err) WT_NODISCARD;
const char *wt_folder_plots(const wt_folder *folder); /* "plots" in it; borrowed */
/* Writes a file; `name` is relative to the folder. */
wt_status wt_folder_write(const wt_folder *folder, const char *name, const char *bytes,
                          size_t length, wt_error *err) WT_NODISCARD;
/* Puts it into its place and removes what was there; frees `folder`, also on failure. */
wt_status wt_folder_commit(wt_folder *folder, wt_error *err) WT_NODISCARD;
void wt_folder_discard(wt_folder *folder); /* removes it, frees; NULL ok */

#endif
