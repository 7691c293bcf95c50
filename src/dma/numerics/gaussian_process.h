/* A curve through scattered points: a parabola and a Gaussian process, averaged over length and
 * variance by restricted likelihood. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_GAUSSIAN_PROCESS_H
#define WT_DMA_NUMERICS_GAUSSIAN_PROCESS_H

#include "core/base/array.h"
#include "weartrack/core.h"

/* Coefficients of the parabola, maximum and minimum number of points. More points are merged,
 * because the time grows with the cube of their number. A mean of neighbours preserves all
 * features wider than the shortest length. The minimum is two more than the coefficients. */
enum { GP_PARABOLA_TERMS = 3, GP_MAX_POINTS = 48, GP_MIN_POINTS = 5 };

struct gp_hyperparameters;
typedef struct gaussian_process {
    arena memory;
    size_t n;
    double *x, *y, *count; /* [n] x from -1 to 1; count: number of merged points */
    double centre, half;
    size_t n_components;
    struct gp_hyperparameters *components;
} gaussian_process;

typedef enum gp_order { GP_VALUE, GP_SLOPE } gp_order;

/* Fits the curve. x is rising and n >= GP_MIN_POINTS. The caller frees s, also on
 * failure. */
wt_status gaussian_process_new(const double *x, const double *y, size_t n, gaussian_process *s,
                               wt_error *err) WT_NODISCARD;
void gaussian_process_free(gaussian_process *s);
double gaussian_process_mean(const gaussian_process *s, double x, gp_order order);
/* Returns the probability that the curve, or its slope, is below `limit` at x. */
double gaussian_process_probability_below(const gaussian_process *s, double x, gp_order order,
                                          double limit);
wt_interval gaussian_process_interval(const gaussian_process *s, double x);

/* A statistic of the slopes at rising positions, such as the intersection of two tangents. NaN:
 * undefined. */
typedef double gaussian_process_statistic(const double *x, const double *slope, size_t n);
/* Computes the interval of a statistic from the joint distribution of the slopes, to first
 * order. It is NaN if components with more than 5 % of the weight have no value. */
wt_interval gaussian_process_slope_interval(const gaussian_process *s, const double *x, size_t n,
                                            gaussian_process_statistic *statistic);

#endif
