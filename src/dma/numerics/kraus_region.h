/* Confidence region of the law of Kraus for a strain sweep. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_KRAUS_REGION_H
#define WT_DMA_NUMERICS_KRAUS_REGION_H

#include "weartrack/dma.h"

typedef struct payne_points {
    size_t n;
    const double *log_strain, *storage, *loss;
} payne_points;

/* Box in the plane of u = ln strain_c and v = ln exponent. The moduli follow in closed form. */
typedef struct payne_box {
    double low[2], high[2];
} payne_box;

/* Levels of a modulus: value = a + (b - a) shape. The errors refer to a standard deviation of 1
 * for each point. */
typedef struct payne_levels {
    double a, b, a_error, b_error, rss;
} payne_levels;

payne_levels payne_storage_levels(const payne_points *p, double u, double v);
payne_levels payne_loss_levels(const payne_points *p, double u, double v);
double
payne_total_squares(const payne_points *p); /* sum of squares about the mean storage modulus */

/* Finds the global minimum of the sum of squares. */
void payne_best_fit(const payne_points *p, double *u, double *v);

/* Fills the intervals and standard errors of payne. The sum of squares exceeds its minimum by at
 * most t^2 (interval) or 1 (standard error) times the variance. */
void payne_intervals(const payne_points *p, double t, wt_payne *payne);

#endif
