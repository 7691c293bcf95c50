/* Agreement of measured and predicted values. The logarithm of their ratio is fitted by a smooth
 * curve over the velocity, whose intervals are compared with a margin. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_AGREEMENT_H
#define WT_RECORD_NUMERICS_AGREEMENT_H

#include "core/base/array.h"
#include "weartrack/core.h"

#include <stdbool.h>
#include <stddef.h>

/* Steps of a measurement, with variances and covariances of the compared value. */
typedef struct agreement_data {
    size_t n;
    const double *log_velocity;          /* [n] log10 of the velocity */
    const double *value;                 /* [n] ln(measured/predicted), or another difference */
    const double *measurement_variance;  /* [n] variance due to the measurement alone */
    const double *prediction_covariance; /* [n * n] covariance due to the prediction */
} agreement_data;

typedef enum agreement_verdict {
    AGREEMENT_INCONCLUSIVE, /* the intervals reach beyond the margin but not entirely */
    AGREEMENT_YES,          /* all 95 % intervals are within the margin */
    AGREEMENT_NO            /* a simultaneous 95 % interval is entirely beyond the margin */
} agreement_verdict;

/* The curve is a constant, a line from three velocities on, and a parabola from five on. The number
 * of terms is at most half the number of velocities, so that the scatter is determined. */
enum { AGREEMENT_TERMS = 3 };

typedef struct agreement {
    size_t n, terms;
    double centre, span;                 /* centre and half range of the logarithms of the
                                            velocity; u = (x - centre)/span */
    double coefficient[AGREEMENT_TERMS]; /* of 1, u and u^2 */
    double *weight;                      /* [terms * n] coefficient = weight . value */
    double *at;                          /* [terms * n] terms at the steps */
    double scatter;                      /* variance between steps in excess of the measurement
                                            variance */
    double scatter_df;                   /* its degrees of freedom */
    double *fitted_value, *error, *df;   /* [n] curve at the steps, its standard error and
                                      degrees of freedom */
    agreement_verdict verdict;
    size_t deciding_step; /* step that decides the verdict */
    arena memory;         /* of the arrays */
} agreement;

/* Smallest separation of distinct velocities. */
#define AGREEMENT_MIN_SEPARATION 0.05 /* [decade] a tribometer controls its velocity to 10 % */

/* Fits by least squares, weighted by the errors of the measurement. Excess scatter between the
 * steps is added (Mandel and Paule). The standard errors include the covariance of the prediction.
 * most_terms: limit of the curve; 0: as many as the velocities allow. */
wt_status agreement_fit(const agreement_data *data, size_t most_terms, agreement *a,
                        wt_error *err) WT_NODISCARD;
/* Yes: at every step the 95 % interval is within the margin (intersection-union test, without a
 * correction). No: at some step the curve is beyond the margin by the simultaneous interval
 * (Scheffe or Bonferroni, the shorter one). */
void agreement_assess(agreement *a, double margin);
void agreement_clear(agreement *a);

/* Returns the limits of the curve at step i: pointwise 95 %, or simultaneous for all steps. */
void agreement_interval(const agreement *a, size_t i, bool at_once, double ends[2]);

/* Returns the weights of the curve at step i, which is the sum of row[k] value[k]. row: [n]. */
void agreement_weights(const agreement *a, size_t i, double *row);
/* Half width of a 95 % interval in standard errors: Student's t, or normal if `df` is INFINITY. */
double agreement_quantile(double df);
/* Degrees of freedom of a variance whose part `scatter` has df degrees of freedom (Welch and
 * Satterthwaite). */
double agreement_df(double variance, double scatter, double df);

#endif
