/* Compressed files of Digital Surf. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_SURF_H
#define WT_READ_SURF_H

#include "weartrack/read.h"

#define SURF_PLAIN "DIGITAL SURF"
#define SURF_PACKED "DSCOMPRESSED"

/* The same file with heights that are not compressed, which Gwyddion knows (2.62 does not know the
 * compressed). It has the name of the input and is closed by the caller. WT_E_CORRUPT,
 * WT_E_UNSUPPORTED of more than `most` bytes. */
wt_status surf_unpack(wt_input *input, size_t most, wt_log *log, wt_input **unpacked,
                      wt_error *err) WT_NODISCARD;

#endif
