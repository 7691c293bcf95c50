/* Files and folders that are not finished: named ".weartrack-PROCESS-RANDOM", beside what they will
 * be, so that the next run can tell what a killed one has left. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_TEMPORARY_H
#define WT_CORE_SYSTEM_TEMPORARY_H

#include "weartrack/base.h"

/* Where what is no part of an output goes: the folder that TMPDIR names, or /tmp; borrowed. */
const char *temporary_directory(void);
/* A new name in `folder`; it begins with a dot, so that no pattern picks it up. NULL with errno. */
char *temporary_name(const char *folder);
/* A new folder of such a name; *descriptor says that it is in use until it is closed. NULL with
 * errno. */
char *temporary_folder(const char *folder, int *descriptor);
/* Says of an open file that it is in use. */
void temporary_hold(int descriptor);
/* Removes a file, or a folder with all that is in it eight levels deep; links are not followed. */
void temporary_remove(const char *path);
/* Removes what processes that no longer live have left in `folder`. */
void temporary_sweep(const char *folder);

#endif
