/* Position of a height image under a tip.
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_HEIGHT_IMAGE_H
#define WT_INDENTATION_NUMERICS_HEIGHT_IMAGE_H

#include "weartrack/core.h"

#include <stdbool.h>
#include <stddef.h>

/* Smallest number of pixels of a disc: four for each parameter of a plane. */
enum { SPOT_MIN_PIXELS = 12 };

/* Least-squares plane over a disc, and the residual heights. */
typedef struct spot_plane {
    double height, slope_x, slope_y; /* height at the centre */
    double rms;                      /* root mean square with n - 3 degrees of freedom */
    size_t n, missing;               /* numbers of pixels */
} spot_plane;

/* Fits a plane. The result is NaN with fewer than SPOT_MIN_PIXELS. */
spot_plane spot_plane_fit(const wt_height_map *field, double x, double y, double radius);
/* True if a disc lies inside the image with enough pixels, at most a tenth of them missing. */
bool spot_disc_is_covered(const wt_height_map *field, double x, double y, double radius);

#endif
