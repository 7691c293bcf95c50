/* What is too large for memory on its way into an input: kept in a file without a name, in the
 * folder that TMPDIR names, which goes with the program. SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_SCRATCH_H
#define WT_READ_SCRATCH_H

#include "weartrack/read.h"

/* What is no larger stays in memory, and so does a file that parts are asked of. */
#define SCRATCH_ABOVE ((size_t)4 * 1024 * 1024)

/* In temporary_directory(); -1 where there is no such folder: then memory must do. */
int scratch_open(void);
/* `name` is that of the input. */
wt_status scratch_write(int file, const void *bytes, size_t n, const char *name, wt_error *err);

#endif
