/* Declares the reader of the data fields of a .gwy file. SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_GWY_H
#define WT_READ_GWY_H

#include "weartrack/read.h"

/* Reads the images like wt_images_read. With `masks_are_missing` the file is a conversion, and
 * masked points were not measured and become NaN. Otherwise a mask may mark anything. */
wt_status gwy_read(wt_input *input, bool masks_are_missing, wt_log *log, wt_image **images,
                   size_t *n_images, wt_error *err) WT_NODISCARD;

#endif
