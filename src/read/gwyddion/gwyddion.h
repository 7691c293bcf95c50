/* Declares the program Gwyddion as a converter of height maps without a reader in this program.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_GWYDDION_H
#define WT_READ_GWYDDION_H

#include "weartrack/read.h"

typedef struct gwyddion_limits {
    double time;      /* wall-clock time [s] */
    size_t cpu_time;  /* [s] */
    size_t file_size; /* size of each written file [byte] */
    size_t memory;    /* memory for data [byte] */
} gwyddion_limits;
extern const gwyddion_limits gwyddion_default_limits;

/* Converts a copy of the bytes to .gwy in a temporary folder, which is removed afterwards.
 * *converted has the name of the input; the caller closes it. `version` is the version text of the
 * program. WT_E_TOOL if it is missing, fails, exceeds a limit or writes nothing. */
wt_status gwyddion_convert(wt_input *input, const gwyddion_limits *limits, wt_input **converted,
                           char version[64], wt_error *err) WT_NODISCARD;
/* Returns the file with plain heights, since Gwyddion 2.62 cannot read compressed ones. It has the
 * name of the input; the caller closes it. WT_E_CORRUPT; WT_E_UNSUPPORTED if the heights exceed the
 * size limit. */
wt_status surf_unpack(wt_input *input, size_t max_size, wt_log *log, wt_input **unpacked,
                      wt_error *err) WT_NODISCARD;

#endif
