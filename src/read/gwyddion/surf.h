/* Declares the unpacking of compressed Digital Surf files.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_SURF_H
#define WT_READ_SURF_H

#include "weartrack/read.h"

#define SURF_PLAIN "DIGITAL SURF"
#define SURF_PACKED "DSCOMPRESSED"

/* Returns the file with plain heights, since Gwyddion 2.62 cannot read compressed ones. It has the
 * name of the input; the caller closes it. WT_E_CORRUPT; WT_E_UNSUPPORTED if the heights exceed the
 * size limit. */
wt_status surf_unpack(wt_input *input, size_t max_size, wt_log *log, wt_input **unpacked,
                      wt_error *err) WT_NODISCARD;

#endif
