/* Whether measured values agree with predicted ones: the logarithm of their ratio as a smooth curve
 * over the velocity, with what the measurement and the prediction leave open of it, against a
 * margin. Internal to record and to the job of the same name.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_AGREEMENT_H
#define WT_RECORD_NUMERICS_AGREEMENT_H

#include "weartrack/base.h"

#include <stdbool.h>
#include <stddef.h>

/* Steps of a measurement. */
typedef struct agreement_data {
    size_t n;
    const double *place;  /* [n] log10 of the velocity */
    const double *value;  /* [n] ln(measured/predicted), or another difference */
    const double *own;    /* [n] variance of each by the measurement alone */
    const double *common; /* [n * n] covariance by the prediction */
    double allowed;       /* variance that the theory may be off by, smooth over the velocity: of
                             the likelihood alone */
} agreement_data;

typedef enum agreement_verdict {
    AGREEMENT_OPEN, /* the intervals reach beyond the margin and do not leave it */
    AGREEMENT_YES,  /* all intervals of 95 % are within the margin */
    AGREEMENT_NO    /* somewhere the simultaneous interval of 95 % is beyond it */
} agreement_verdict;

/* The curve is a level, from three velocities on with a slope, from five on with a bend: half as
 * many terms as there are velocities, so that the scatter about it is known. */
enum { AGREEMENT_TERMS = 3 };

typedef struct agreement {
    size_t n, terms;
    double centre, span;                 /* of the places; the curve runs over (x-centre)/span */
    double coefficient[AGREEMENT_TERMS]; /* of 1, u, u^2 */
    double *weight;                      /* [terms * n] coefficient = weight . value */
    double *at;                          /* [terms * n] the terms at the steps */
    double scatter;                      /* variance of a step beside `own` */
    double scatter_df;                   /* that tell it */
    double *smooth, *error, *df;         /* [n] the curve at the steps; df: of its error */
    agreement_verdict verdict;
    size_t where; /* the step that decides it, or leaves it open */
} agreement;

/* Steps that are told apart by their velocity. */
#define AGREEMENT_APART 0.05 /* decades: a tribometer holds its velocity to 10 % */

/* Least squares by the errors of the measurement, and scatter between the steps beside them where
 * they scatter by more (Mandel and Paule); errors hold the covariance of the prediction.
 * most_terms: of the curve, 0: as the velocities allow. */
wt_status agreement_fit(const agreement_data *data, size_t most_terms, agreement *a,
                        wt_error *err) WT_NODISCARD;
/* Yes: at every step the interval of 95 % is within +- margin (an intersection of tests, which
 * needs no correction). No: at some step the curve is beyond it by the interval that holds for all
 * steps at once (Scheffe's, or Bonferroni's if that is shorter). */
void agreement_assess(agreement *a, double margin);
void agreement_clear(agreement *a);

/* Ends of the curve at step i: by the interval of 95 % there, or by that for all steps at once. */
void agreement_ends(const agreement *a, size_t i, bool at_once, double ends[2]);

/* The curve at step i is the sum of row[k] value[k]. row: [n]. */
void agreement_row(const agreement *a, size_t i, double *row);
/* Standard deviation that an interval of 95 % has so many of: Student's t, `df` INFINITY: normal.
 */
double agreement_quantile(double df);
/* Of a variance of which the part `scatter` has df degrees of freedom (Welch and Satterthwaite). */
double agreement_df(double variance, double scatter, double df);

/* What a theory is off by at velocities a decade apart is much the same, and much another at three:
 * relaxation spectra of filled rubber change over decades. */
#define AGREEMENT_LENGTH 1.0
/* ln of the normal likelihood of the values about 0 with covariance own + scatter + common + what
 * is allowed (Kennedy and O'Hagan 2001, J. R. Stat. Soc. B 63, 425), without which a record of a
 * per mille would weigh differences of the theory's shape that nobody claims it has right; NaN if
 * that is not positive. */
wt_status agreement_likelihood(const agreement_data *data, double scatter, double *likelihood,
                               wt_error *err) WT_NODISCARD;

/* x = (own + scatter + common + allowed)^-1 b; NaN if that is not positive. x, b: [n]. */
wt_status agreement_solve(const agreement_data *data, double scatter, const double *b, double *x,
                          wt_error *err) WT_NODISCARD;

#endif
