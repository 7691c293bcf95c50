/* Gwyddion, the program, as a converter of height maps that have no reader here.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_GWYDDION_H
#define WT_READ_GWYDDION_H

#include "weartrack/read.h"

typedef struct gwyddion_limits {
    double time;      /* [s] from start to end */
    size_t cpu_time;  /* [s] */
    size_t file_size; /* [bytes] of each file it writes */
    size_t memory;    /* [bytes] of its data */
} gwyddion_limits;
extern const gwyddion_limits gwyddion_usual_limits;

/* Has Gwyddion write a copy of the bytes as .gwy, in a folder of its own, which is gone afterwards.
 * *converted has the name of the input and is closed by the caller; `version` becomes what the
 * program says of itself. WT_E_TOOL if it is not there, fails, takes too long or writes nothing. */
wt_status gwyddion_convert(wt_input *input, const gwyddion_limits *limits, wt_input **converted,
                           char version[64], wt_error *err) WT_NODISCARD;

#endif
