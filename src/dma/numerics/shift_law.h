/* Shift laws and their fit, in decades and kelvin. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SHIFT_LAW_H
#define WT_DMA_NUMERICS_SHIFT_LAW_H

#include "weartrack/dma.h"

#include <gsl/gsl_matrix.h>

/* Maximum number of unknowns: offset of the reference, main constant (C1 or activation energy),
 * energy below the joint, shift of an outlier, ln of the pole distance below the coldest
 * isotherm. A law has some of them. */
enum { LAW_MAX_UNKNOWNS = 5, LAW_SCRATCH = LAW_MAX_UNKNOWNS + 2 };
/* With fewer isotherms the law is Arrhenius, because an offset and two constants leave no degree
 * of freedom. */
enum { LAW_MIN_ISOTHERMS = 4 };

/* Number of temperature errors that are averaged: 4 mK, below any chamber, to 4 K, above any, in
 * factors of 2. */
enum { LAW_SPREADS = 11 };
double law_spread(size_t i);
/* Half width of the prior of the temperature error [K]. */
extern const double law_temperature_tolerance;

typedef struct law_shape {
    wt_law_kind kind;
    double reference; /* [K] */
    double joint;     /* joint of a joined law [K]: Arrhenius below, WLF above */
    long outlier;     /* index of an outlier isotherm; -1: none */
    double coldest;   /* the pole is below it [K] */
} law_shape;

/* Shifts to which a law is fitted. */
typedef struct law_data {
    size_t n;
    const double *temperature; /* [n] */
    double *log_a;             /* [n] */
    gsl_matrix *covariance;    /* [n * n] of log_a */
    double *slope;             /* [n] slope of the law [decade/K], set by law_select */
    double *scratch;           /* [n * LAW_SCRATCH] */
    double pole;               /* ln of the pole distance of the last fit; 0: none */
} law_data;

typedef struct law_fit {
    size_t n_unknowns;
    double unknown[LAW_MAX_UNKNOWNS];
    double covariance[LAW_MAX_UNKNOWNS][LAW_MAX_UNKNOWNS];
    double chi_square, log_det,
        log_det_design; /* log_det: of the covariance; log_det_design: of X'S^-1X */
} law_fit;

size_t law_unknowns(const law_shape *shape);
/* Returns the index of the unknown, or LAW_MAX_UNKNOWNS if the law has none. */
size_t law_outlier_index(const law_shape *shape);
size_t law_pole_index(const law_shape *shape);
/* Returns log10 a at a temperature without the offset, and its gradient; gradient may be NULL. */
double law_value(const law_shape *shape, const double *unknown, double temperature,
                 double *gradient);
/* Returns log10 a of the law for an isotherm, with the offset and the shift of an outlier. */
double law_isotherm_value(const law_data *data, const law_shape *shape, const double *unknown,
                          size_t i);
/* Returns the constants in their public form. */
wt_shift_law law_constants(const law_shape *shape, const double *unknown);

/* Chooses the law and its outlier by likelihood; sets data->slope. root: [n * n] scratch.
 * Returns WT_E_RANGE if the shifts do not fall with temperature. */
wt_status law_select(law_data *data, double reference, gsl_matrix *root, law_shape *chosen,
                     wt_error *err) WT_NODISCARD;
/* Computes the Cholesky factor (core/math/cholesky.h) of covariance + (spread * slope)^2. */
wt_status law_gls_covariance(const law_data *data, double spread, gsl_matrix *root,
                             wt_error *err) WT_NODISCARD;
/* Computes the design matrix x[n * law_unknowns]. */
void law_design(const law_data *data, const law_shape *shape, const double *unknown, gsl_matrix *x);
/* Fits the law; the search of its pole starts from that of the fit before. */
wt_status law_fit_gls(law_data *data, const law_shape *shape, const gsl_matrix *root, law_fit *fit,
                      wt_error *err) WT_NODISCARD;
double law_reml(const law_fit *fit);
/* Returns the prior density of a temperature error times the width of its grid cell. */
double law_spread_prior(const law_data *data, double spread);

#endif
