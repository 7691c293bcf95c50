/* Autocorrelated scatter of an equidistant series: a first-order autoregression plus white scatter.
 * Undetermined parameters are averaged over. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_AUTOCORRELATION_H
#define WT_RECORD_NUMERICS_AUTOCORRELATION_H

#include <stdbool.h>
#include <stddef.h>

/* Lower bound of the residual of a point, relative to the standard deviation of the series: the
 * last of four written digits. */
#define SCATTER_RESOLUTION 1e-4

/* One law of unit variance. */
typedef struct scatter_law {
    double memory; /* autocorrelation of the slow part over one step */
    double share;  /* share of the variance that is slow */
} scatter_law;

/* Purpose of the laws. In the search for a change their length is limited to a quarter of the
 * series: longer correlations are the change itself. For the error of a mean they reach the whole
 * length. */
typedef enum scatter_purpose { SCATTER_FOR_CHANGE, SCATTER_FOR_MEAN } scatter_purpose;

/* Laws of a series of n points. The lengths go from half a step (shorter scatter is white) to the
 * longest in equal ratios. The shares are denser near 0 and 1. */
enum { SCATTER_LENGTHS = 16, SCATTER_SHARES = 10 };
enum { SCATTER_LAWS = SCATTER_LENGTHS * SCATTER_SHARES };
scatter_law scatter_law_at(scatter_purpose use, size_t i, size_t n);
/* ln of the prior probability of a law. All lengths are equally probable. White scatter is one law
 * for all lengths and has a weight of one half or more. Equal weights of all grid points would give
 * it 10 %. Small slow shares over most of the series cannot be refuted and would make the error of
 * the mean 1/3 too large. Small shares therefore have little weight for a mean. Nearly all slow has
 * little weight, too: it fits as well as equal parts with a shorter length, and its error is twice
 * as large. */
double scatter_prior(scatter_purpose use, size_t i);

/* Sums of generalised least squares over successive points, from either end. V is the covariance of
 * unit variance. The columns of X are 1 and the number of the point. */
typedef struct scatter_sums {
    scatter_law law;
    double variance;   /* predicted variance of the slow part */
    double state[3];   /* predictions of 1, number and y */
    double log_det;    /* ln of the determinant of V */
    double product[6]; /* 1 V 1, 1 V t, t V t, 1 V y, t V y, y V y, with the inverse of V */
    size_t n;
    double set_at; /* variance of the three behind, which soon stays the same */
    double gain, weight, log_spread;
} scatter_sums;
scatter_sums scatter_begin(scatter_law law);
void scatter_add(scatter_sums *s, double y);
/* Variant with another second column than the number of the point, of order 1. */
void scatter_add_column(scatter_sums *s, double column, double y);

/* Fit of a constant, or of a line with `line`: residual squares and the requested coefficient
 * (constant or slope) with its variance per unit variance. */
typedef struct scatter_fit {
    double squares, log_information; /* ln of the determinant of X V X */
    double coefficient, variance;
} scatter_fit;
scatter_fit scatter_solve(const scatter_sums *s, bool line);
/* ln of the likelihood, integrated over the coefficients and the variance. `least`: lower bound of
 * the squared residual of a point, due to written digits. */
double scatter_likelihood(const scatter_sums *s, bool line, double least);
/* Variant with a constant and the other column. */
double scatter_profile_likelihood(const scatter_sums *s, double least);
/* Variance of the plain mean of n points per unit variance. */
double scatter_mean_variance(scatter_law law, size_t n);

/* Variance of the points about their mean, whatever their law. */
double scatter_total_variance(const double *y, size_t n);

/* Longer series are replaced by means of equal batches, which bounds the work. Points that do not
 * fill a batch are skipped at the start. */
enum { SCATTER_MAX_BATCHES = 4000 };
typedef struct scatter_batches {
    const double *y;        /* [n] */
    size_t n, length, rest; /* points in a batch; points skipped */
} scatter_batches;
/* *room is freed by the caller; NULL if the series is used directly. */
scatter_batches scatter_batch(const double *y, size_t n, double **room);

/* ln(exp a + exp b). Either may be -INFINITY. */
double log_add(double a, double b);

/* Weighted mixture of Student's t distributions: several laws of the scatter, each about a constant
 * and about a line. */
enum { MIXTURE_MAX_TERMS = 2 * SCATTER_LAWS };
typedef struct t_mixture {
    size_t n;
    double df[MIXTURE_MAX_TERMS], log_weight[MIXTURE_MAX_TERMS], centre[MIXTURE_MAX_TERMS],
        scale[MIXTURE_MAX_TERMS];
} t_mixture;
void mixture_add(t_mixture *m, double log_weight, double df, double centre, double scale);
/* Scales the weights to a sum of 1. */
void mixture_normalise(t_mixture *m);
double mixture_mean(const t_mixture *m);
double mixture_quantile(const t_mixture *m, double p);

#endif
