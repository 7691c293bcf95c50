/* Inside the fit room: a place of a height image under a tip, and what changed there between two
 * images.
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_HEIGHT_IMAGE_H
#define WT_INDENTATION_NUMERICS_HEIGHT_IMAGE_H

#include "weartrack/data.h"

#include <stdbool.h>
#include <stddef.h>

/* Fewest pixels that a disc is described by: four for each constant of a plane. */
enum { SPOT_LEAST_PIXELS = 12 };

/* A plane by least squares over a disc, and what is left of the heights. */
typedef struct spot_plane {
    double height, slope_x, slope_y; /* height at the centre */
    double rms;                      /* with the three numbers of the plane taken off */
    size_t n, missing;               /* pixels */
} spot_plane;

/* NaN with fewer than SPOT_LEAST_PIXELS. */
spot_plane spot_plane_fit(const wt_height_map *field, double x, double y, double radius);
/* Is a disc inside of the image, with enough pixels and no more than a tenth of them missing? */
bool spot_covers(const wt_height_map *field, double x, double y, double radius);
/* Height at a place in pixels by polynomials of the fifth degree through six pixels each way; NaN
 * where they are not all known. */
double spot_between(const wt_height_map *field, double i, double j);
/* Solves n symmetric equations, of which the lower triangle is read, in place: m becomes its factor
 * of Cholesky. False if they do not tell all. */
enum { SPOT_UNKNOWNS = 3 };
bool spot_solve(size_t n, double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double v[SPOT_UNKNOWNS]);

/* ---- how two images lie beside one another: spot_align.c ------------------------------------- */

/* What is at p in the first is at p + shift in the second. The shift changes evenly over the image,
 * as steady drift makes it: here at p = (x, y). */
typedef struct spot_shift {
    double x, y, x_error, y_error; /* at the place [m] */
    double gradient[2][2];         /* of the shifts in x and y, along x and y */
    double at_x, at_y;             /* the place */
    double overlap;                /* share of the pixels of the first that are in the second */
    size_t blocks, degrees;        /* parts of the image that tell the shift; of freedom */
    bool found;                    /* they agree within half a pixel */
} spot_shift;
/* By the heights, without the disc about the place; both images have pixels of one size. Looks at
 * all shifts at which a quarter of the smaller image lies in the other. WT_E_MEMORY. */
wt_status spot_align(const wt_height_map *before, const wt_height_map *after, double x, double y,
                     double radius, spot_shift *shift, wt_error *err) WT_NODISCARD;
/* The image with pixels of another size, from the same first pixel on; z is to be freed. */
wt_status spot_resample(const wt_height_map *field, double dx, double dy, wt_height_map *to,
                        wt_error *err) WT_NODISCARD;
/* after(p + shift) - before(p) at each pixel of `before`, NaN where it is not known. */
void spot_difference(const wt_height_map *before, const wt_height_map *after,
                     const spot_shift *shift, double *difference);

/* ---- dents ----------------------------------------------------------------------------------- */

/* How far a difference lies below the lines that join its rows from two to four radii on the left
 * with the same on the right: rows are what was scanned at one go. */
typedef struct spot_depression {
    double depth, volume; /* mean within the radius [m], within two of them [m^3] */
} spot_depression;
/* NaN where the difference does not cover it. WT_E_MEMORY. */
wt_status spot_depression_at(const wt_height_map *difference, double x, double y, double radius,
                             spot_depression *dent, wt_error *err) WT_NODISCARD;

#endif
