/* Laws of the shift factors and how well the isotherms know them (internal to the fit room).
 * Decades and kelvin. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SHIFT_LAW_H
#define WT_DMA_NUMERICS_SHIFT_LAW_H

#include "weartrack/fit.h"

#include <gsl/gsl_matrix.h>

/* Unknowns of a law: the offset of the reference isotherm, the main factor (C1, or the activation
 * energy), the activation energy below the joint, the shift of an odd isotherm, ln of the distance
 * of the pole below the coldest isotherm. Not every law has all. */
enum { LAW_MOST = 5 };
/* With fewer isotherms a law is Arrhenius because more cannot be asked: an offset and two constants
 * leave nothing over of three. */
enum { LAW_LEAST_TOLD = 4 };

/* Standard deviations of the temperature of an isotherm that are averaged over: from 4 mK, which
 * no chamber holds, by factors of 2 to 4 K, which none is off by. */
enum { LAW_SPREADS = 11 };
double law_spread(size_t i);
/* What temperatures are believed to [K]. */
extern const double law_believed;

/* The pole of WLF lies so far below the coldest isotherm [K]: closer, no rubber is measured, for
 * the pole is 51.6 K below the glass transition (Williams, Landel and Ferry 1955); farther, the law
 * is a straight line, which bends by 1 % over 100 K. */
#define POLE_NEAREST 2.0
#define POLE_FARTHEST 1e4
/* A pole whose distance is known to less than this (error of its ln, a factor 50 to either side at
 * 95 %) bends nothing that is seen: constants and draws of such a law would mean nothing, and it
 * counts as impossible. */
#define POLE_ERROR 2.0

typedef struct law_shape {
    wt_law_kind kind;
    double reference; /* [K] */
    double joint;     /* Arrhenius below it [K]; used by the joined law */
    long odd;         /* an isotherm whose temperature is not believed, -1: none */
    double coldest;   /* the pole is below it [K] */
} law_shape;

/* The shifts a law is asked to describe. */
typedef struct law_data {
    size_t n;
    const double *temperature; /* [n] */
    double *log_a;             /* [n] */
    gsl_matrix *covariance;    /* [n * n] of log_a */
    double *slope;             /* [n] of the law [decade/K], found by law_choose */
    double *scratch;           /* [n * (LAW_MOST + 2)] */
} law_data;

typedef struct law_fit {
    size_t n_unknowns;
    double unknown[LAW_MOST];
    double covariance[LAW_MOST][LAW_MOST];
    double chi_square, log_det, log_det_design; /* of the covariance; of X'S^-1X */
} law_fit;

size_t law_unknowns(const law_shape *shape);
/* Index of the unknown, or LAW_MOST if the law has none. */
size_t law_odd_index(const law_shape *shape);
size_t law_pole_index(const law_shape *shape);
/* log10 a at a temperature without the offset, and by the unknowns; gradient may be NULL. */
double law_at(const law_shape *shape, const double *unknown, double temperature, double *gradient);
/* log10 a that the law has for an isotherm, with the offset and what is odd about it. */
double law_of_isotherm(const law_data *data, const law_shape *shape, const double *unknown,
                       size_t i);
/* The constants as they are reported. */
wt_shift_law law_constants(const law_shape *shape, const double *unknown);

/* Chooses the law, and the isotherm that does not belong to it, by likelihood; sets data->slope.
 * root: [n * n] scratch. WT_E_RANGE if the shifts do not fall with temperature. */
wt_status law_choose(law_data *data, double reference, gsl_matrix *root, law_shape *chosen,
                     wt_error *err) WT_NODISCARD;
/* Factor (core/math/cholesky_dense.h) of covariance + (spread * slope)^2. */
wt_status law_gls_covariance(const law_data *data, double spread, gsl_matrix *root,
                             wt_error *err) WT_NODISCARD;
/* How the shifts depend on the unknowns: x[n * law_unknowns]. */
void law_design(const law_data *data, const law_shape *shape, const double *unknown, gsl_matrix *x);
wt_status law_fit_with(const law_data *data, const law_shape *shape, const gsl_matrix *root,
                       law_fit *fit, wt_error *err) WT_NODISCARD;
double law_reml(const law_fit *fit);
/* Times the width of its cell in the grid of spreads. */
double law_spread_prior(const law_data *data, double spread);

#endif
