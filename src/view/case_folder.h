/* Files in the folder of a case. No name with a folder, no symbolic link and no special file is
 * opened, so that a request cannot reach anything else.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_CASE_FOLDER_H
#define WT_VIEW_CASE_FOLDER_H

#include "report/report_text.h"

typedef struct case_folder {
    char *path;     /* absolute */
    int descriptor; /* open folder, -1: none */
} case_folder;

wt_status case_folder_open(const char *path, case_folder *folder, wt_error *err) WT_NODISCARD;
void case_folder_close(case_folder *folder);
/* True for a plain file name: not hidden, no option, and without '/' and
 * control characters. */
bool case_folder_is_name(const char *name);
/* Reads a file of at most `limit` bytes. *exists is false, and the text empty, if there is none. */
wt_status case_folder_read(const case_folder *folder, const char *name, size_t limit, bool *exists,
                           text_buffer *text, wt_error *err) WT_NODISCARD;
/* Writes a new file. It fails if there is anything of this name. */
wt_status case_folder_add(const case_folder *folder, const char *name, const char *bytes,
                          size_t length, wt_error *err) WT_NODISCARD;
/* Replaces a file, which is complete at every moment. */
wt_status case_folder_write(const case_folder *folder, const char *name, const char *bytes,
                            size_t length, wt_error *err) WT_NODISCARD;

#endif
