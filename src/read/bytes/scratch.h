/* Declares temporary files for data that are too large for memory. They have no name, are in the
 * folder of TMPDIR and disappear with the process.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_SCRATCH_H
#define WT_READ_SCRATCH_H

#include "weartrack/core.h"

/* Data up to this size stay in memory, and so does a file that is read in parts [byte]. */
#define SCRATCH_THRESHOLD ((size_t)4 * 1024 * 1024)

/* Opens a file in temporary_directory(); -1 if there is no such folder. The caller then uses
 * memory. */
int scratch_open(void);
/* Appends n bytes. `name` is the name of the input for messages. */
wt_status scratch_write(int file, const void *bytes, size_t n, const char *name, wt_error *err);

#endif
