/* Position of a height image under a tip, and the change there between two images.
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
/* Height at a position in pixels by fifth-degree polynomials through six pixels in each direction.
 * The result is NaN if one of them is unknown. */
double spot_interpolate_height(const wt_height_map *field, double i, double j);
/* Solves n symmetric equations from their lower triangle in place. m becomes its Cholesky factor.
 * Returns false if the matrix is singular. */
enum { SPOT_UNKNOWNS = 3 };
bool spot_solve(size_t n, double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double v[SPOT_UNKNOWNS]);

/* ---- alignment of two images: image_alignment.c ---------------------------------------------- */

/* Shift between two images: position p of the first is p + shift in the second. The shift is linear
 * in the position, as for a steady drift. The members apply at p = (at_x, at_y). */
typedef struct spot_shift {
    double x, y, x_error, y_error; /* at the position [m] */
    double gradient[2][2];         /* gradient of the shifts in x and y, along x and y */
    double at_x, at_y;             /* position */
    double overlap;         /* share of the pixels of the first image that the second covers */
    size_t blocks, degrees; /* image blocks that determine the shift; degrees of freedom */
    bool found;             /* the blocks agree within half a pixel */
} spot_shift;
/* Finds the shift from the heights outside of the disc at the position. Both images must have equal
 * pixels. The search covers all shifts with an overlap of a quarter of the smaller image. */
spot_shift spot_align(const wt_height_map *before, const wt_height_map *after, double x, double y,
                      double radius);
/* Resamples an image from the same first pixel on. The caller frees z. */
wt_height_map spot_resample(const wt_height_map *field, double dx, double dy);
/* Computes after(p + shift) - before(p) at each pixel of `before`; NaN if not known. */
void spot_difference(const wt_height_map *before, const wt_height_map *after,
                     const spot_shift *shift, double *difference);

/* ---- depressions ----------------------------------------------------------------------------- */

/* Depth of a difference below lines that join its rows from two to four radii on both sides. A row
 * is one scan line. */
typedef struct spot_depression {
    double depth, volume; /* mean within the radius [m], within two radii [m^3] */
} spot_depression;
/* Measures a depression. The result is NaN if the difference does not cover it. */
spot_depression spot_measure_depression(const wt_height_map *difference, double x, double y,
                                        double radius);

#endif
