/* The laws of Kraus that the points of a strain sweep allow. Internal to dma.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_DMA_NUMERICS_KRAUS_REGION_H
#define WT_DMA_NUMERICS_KRAUS_REGION_H

#include "weartrack/fit.h"

typedef struct payne_points {
    size_t n;
    const double *log_strain, *storage, *loss;
} payne_points;

/* A plane: u = ln strain_c and v = ln exponent; the moduli of the law follow in closed form. */
typedef struct payne_box {
    double low[2], high[2];
} payne_box;

/* First and last level of a modulus: value = a + (b - a) shape; their errors for one of the points
 * being 1. */
typedef struct payne_levels {
    double a, b, a_error, b_error, rss;
} payne_levels;

payne_levels payne_storage_at(const payne_points *p, double u, double v);
payne_levels payne_loss_at(const payne_points *p, double u, double v);
double payne_flat(const payne_points *p); /* sum of squares about the mean of the storage moduli */

/* The best place in the plane, whatever the start. */
void payne_best(const payne_points *p, double *u, double *v);

/* The intervals of payne about its law, by where the sum of squares is above the least by no more
 * than t^2 times the square of the scatter; and the standard errors, by 1 for t^2. */
void payne_intervals(const payne_points *p, double t, wt_payne *payne);

#endif
