/* Scatter of a series that is partly slow: an autoregression of first order beside white scatter,
 * of equal steps. What a series does not tell of the two is averaged over. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_AUTOCORRELATION_H
#define WT_RECORD_NUMERICS_AUTOCORRELATION_H

#include <stdbool.h>
#include <stddef.h>

/* Squares of a point are at least those of the last of four digits, with which files are written:
 * of the standard deviation of a series. */
#define SCATTER_DIGITS 1e-4

/* One law of unit variance. */
typedef struct scatter_law {
    double memory; /* autocorrelation of the slow part over one step */
    double share;  /* of the variance that is slow */
} scatter_law;

/* What the laws are for. Under a change that is sought they reach to a quarter of the series,
 * beyond which they are the change itself. In the error of a mean all counts that the series does
 * not tell from it: they reach to its whole length. */
typedef enum scatter_use { SCATTER_UNDER_CHANGE, SCATTER_OF_MEAN } scatter_use;

/* The laws of a series of n points. Lengths go from half a step, below which slow scatter is white,
 * to the longest in equal ratios; shares stand closer at the ends, where a little white or slow
 * scatter changes much. */
enum { SCATTER_LENGTHS = 16, SCATTER_SHARES = 10 };
enum { SCATTER_LAWS = SCATTER_LENGTHS * SCATTER_SHARES };
scatter_law scatter_law_of(scatter_use use, size_t i, size_t n);
/* ln of how likely it is taken to be before a series is seen, each length as likely. White scatter,
 * which is one law whatever the length, has half or more: where each place of the grid weighs the
 * same it has a tenth, and shares of a few hundredths over much of the series, which no series can
 * refute, make the error of the mean of white scatter a third too large. So small shares have
 * little in the error of a mean. Nearly all slow has little, too: a part as long as the series
 * beside a little white scatter fits as well as half and half with a shorter one, and its error is
 * twice as large. */
double scatter_prior(scatter_use use, size_t i);

/* Sums of generalised least squares over points taken one after the other, from either end: V is
 * the covariance of unit variance, the columns of X are 1 and the number of the point. */
typedef struct scatter_sums {
    scatter_law law;
    double variance;   /* of the slow part as predicted */
    double state[3];   /* prediction of: 1, number, y */
    double log_det;    /* of V */
    double product[6]; /* 1 V 1, 1 V t, t V t, 1 V y, t V y, y V y, V for its inverse */
    size_t n;
} scatter_sums;
scatter_sums scatter_begin(scatter_law law);
void scatter_add(scatter_sums *s, double y);
/* The same with another column than the number of the point, which is of order 1. */
void scatter_add_column(scatter_sums *s, double column, double y);

/* Of the points so far about a constant, or about a line with `line`: the squares left, and the
 * coefficient asked for (the constant, or the slope) with its variance by unit variance. */
typedef struct scatter_fit {
    double squares, log_information; /* ln of the determinant of X V X */
    double coefficient, variance;
} scatter_fit;
scatter_fit scatter_solve(const scatter_sums *s, bool line);
/* ln of the likelihood, averaged over the coefficients and the variance; `least` is what the
 * squares of a point are at least: the digits of the numbers. */
double scatter_likelihood(const scatter_sums *s, bool line, double least);
/* The same about a constant and the other column. */
double scatter_profile_likelihood(const scatter_sums *s, double least);
/* Variance of the plain mean of n points by unit variance. */
double scatter_of_mean(scatter_law law, size_t n);

/* A series of more points is judged by the means of so many equal parts of it, which bounds the
 * work; what does not fill a part is left out in front. */
enum { SCATTER_MOST = 4000 };
typedef struct scatter_parts {
    const double *y;        /* [n] */
    size_t n, length, rest; /* points in a part; left out */
} scatter_parts;
/* `room` is what is to be freed, NULL where the series stands for itself; false without memory. */
bool scatter_parts_of(const double *y, size_t n, scatter_parts *parts, double **room);

/* ln (exp a + exp b), of which either may be of nothing, -INFINITY. */
double log_add(double a, double b);

/* Laws of Student's t, weighed: of what several laws of the scatter say, each about a constant and
 * about a line. */
enum { MIXTURE_MOST = 2 * SCATTER_LAWS };
typedef struct t_mixture {
    size_t n;
    double df[MIXTURE_MOST], log_weight[MIXTURE_MOST], centre[MIXTURE_MOST], scale[MIXTURE_MOST];
} t_mixture;
void mixture_add(t_mixture *m, double log_weight, double df, double centre, double scale);
/* Weights become those of a sum of 1. */
void mixture_normalise(t_mixture *m);
double mixture_mean(const t_mixture *m);
double mixture_quantile(const t_mixture *m, double p);

#endif
