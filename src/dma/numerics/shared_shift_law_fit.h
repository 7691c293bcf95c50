/* One shift law for several samples: fit (shared_shift_law_fit.c) and model
 * (shared_shift_law_model.c). Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SHARED_SHIFT_LAW_FIT_H
#define WT_DMA_NUMERICS_SHARED_SHIFT_LAW_FIT_H

#include "core/base/array.h"
#include "dma/numerics/shift_law.h"

/* Unknowns that a shift of one sample depends on: its offset, the main constant, ln of the pole
 * distance, and the displacement of its law. */
enum { OFFSET, MAIN, POLE, MOVED, LOCAL };
#define NO_INDEX SIZE_MAX

/* Shifts of one sample, without the outlier of its law. */
typedef struct law_member {
    size_t sample, n, first; /* first: row among all shifts */
    double *temperature, *log_a, *slope;
    gsl_matrix *covariance;
    gsl_matrix *root[LAW_SPREADS];
    double reference, coldest; /* of the law of this sample */
    double main_constant, distance;
} law_member;

typedef struct law_samples {
    arena memory;
    wt_shared_law_mode sharing;
    wt_law_kind kind;
    double reference, coldest; /* of the shared law */
    law_member *members;       /* [n_members] */
    size_t n_members, n;       /* n: number of all shifts */
} law_samples;

/* One law for all samples, or a separate law for each. */
typedef struct law_model {
    bool separate;
    size_t n_unknowns;
} law_model;

typedef struct solution {
    double *unknown;        /* [n_unknowns] */
    gsl_matrix *covariance; /* [n_unknowns^2] */
    double chi_square, reml, weight;
    bool good;
} solution;

bool shared_law_has_pole(const law_samples *c);
law_model shared_law_model(const law_samples *c, bool separate);
/* Fills the indices of the unknowns of a sample; NO_INDEX if absent. */
void shared_law_indices(const law_samples *c, const law_model *m, size_t k, size_t place[LOCAL]);
/* Returns the law of a sample at a temperature [K] without its offset, and the derivatives by
 * its unknowns. NaN at and below the pole. */
double shared_law_value(const law_samples *c, const law_model *model, size_t k,
                        const double *unknown, double temperature, double by[LOCAL]);

/* Fills the constants and the displacements of the samples. */
void shared_law_fill(const law_samples *c, const solution shared[LAW_SPREADS],
                     wt_shared_shift_law *common);
/* Returns the p value of the hypothesis of one law, averaged over the temperature errors of the
 * separate laws. */
double shared_law_p_value(const law_samples *c, const solution shared[LAW_SPREADS],
                          const solution separate[LAW_SPREADS]);
/* Fills the result for isotherm i of sample k. */
void shared_law_fill_point(const law_samples *c, size_t k, size_t i,
                           const solution shared[LAW_SPREADS], const solution separate[LAW_SPREADS],
                           bool compared, wt_shared_law_point *point);

#endif
