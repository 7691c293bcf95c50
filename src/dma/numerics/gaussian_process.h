/* A curve through scattered points: a parabola and a smooth departure from it (a Gaussian process),
 * averaged over how smooth and how large by restricted likelihood. Internal to the fit room.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_GAUSSIAN_PROCESS_H
#define WT_DMA_NUMERICS_GAUSSIAN_PROCESS_H

#include "core/base/arena.h"
#include "weartrack/fit.h"

/* Coefficients of the parabola; points that the fit is made of, others are joined to so many (for
 * the time goes with the cube of them; a mean of neighbours loses nothing that is as wide as the
 * shortest length); fewest, two more than coefficients. */
enum { SMOOTH_PARABOLA = 3, SMOOTH_POINTS = 48, SMOOTH_LEAST = 5 };

struct gp_hyperparameters;
typedef struct gaussian_process {
    arena memory;
    size_t n;
    double *x, *y, *count; /* [n] x from -1 to 1; how many points were joined */
    double centre, half;
    size_t n_ways;
    struct gp_hyperparameters *ways;
} gaussian_process;

typedef enum smooth_order { SMOOTH_VALUE, SMOOTH_SLOPE } smooth_order;

/* x rising, n >= SMOOTH_LEAST; `parabola`: no departure from it. */
wt_status gaussian_process_new(const double *x, const double *y, size_t n, bool parabola,
                               gaussian_process *s, wt_error *err) WT_NODISCARD;
void gaussian_process_free(gaussian_process *s);
double gaussian_process_mean(const gaussian_process *s, double x, smooth_order order);
/* Probability that the curve, or its slope, is below `limit` at x. */
double smooth_below(const gaussian_process *s, double x, smooth_order order, double limit);
wt_interval gaussian_process_interval(const gaussian_process *s, double x);

/* A number that the slopes at rising places make, such as where two tangents meet; NaN: none. */
typedef double gaussian_process_number(const double *x, const double *slope, size_t n);
/* Its interval, by the slopes that the points allow together, to first order in how they depart
 * from their mean; NaN where more than one of twenty of the curves, by weight, have none. */
wt_status smooth_of_slopes(const gaussian_process *s, const double *x, size_t n,
                           gaussian_process_number *number, wt_interval *interval,
                           wt_error *err) WT_NODISCARD;

#endif
