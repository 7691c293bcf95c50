/* One law of the shift factors for several samples: what common_law.c fits and common_law_model.c
 * has as a model and says of it (internal to the fit room). SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SHARED_SHIFT_LAW_FIT_H
#define WT_DMA_NUMERICS_SHARED_SHIFT_LAW_FIT_H

#include "core/base/arena.h"
#include "dma/numerics/shift_law.h"

/* What a shift of one sample hangs on: its offset, the main constant, ln of the distance of the
 * pole, and how far its law is moved. */
enum { OFFSET, MAIN, POLE, MOVED, LOCAL };
#define NO_PLACE SIZE_MAX

/* Shifts of one sample, without the isotherm that does not belong to its law. */
typedef struct law_member {
    size_t sample, n, first; /* first: row among all */
    double *temperature, *log_a, *slope;
    gsl_matrix *covariance;
    gsl_matrix *root[LAW_SPREADS];
    double reference, coldest; /* of its own law */
    double main_constant, distance;
} law_member;

typedef struct law_samples {
    arena memory;
    wt_common how;
    wt_law_kind kind;
    double reference, coldest; /* of the common law */
    law_member *members;       /* [n_members] */
    size_t n_members, n;       /* n: shifts of all */
} law_samples;

/* A law for all, or one for each. */
typedef struct law_model {
    bool own;
    size_t n_unknowns;
} law_model;

typedef struct solution {
    double *unknown;        /* [n_unknowns] */
    gsl_matrix *covariance; /* [n_unknowns^2] */
    double chi_square, reml, weight;
    bool good;
} solution;

bool common_has_pole(const law_samples *c);
law_model common_model(const law_samples *c, bool own);
/* Where the unknowns of a sample are; NO_PLACE that it does not have. */
void common_places(const law_samples *c, const law_model *m, size_t k, size_t place[LOCAL]);
/* The law of a sample at a temperature, without its offset, with derivatives by its unknowns; NaN
 * at the pole and below. */
double common_value(const law_samples *c, const law_model *model, size_t k, const double *unknown,
                    double temperature, double by[LOCAL]);

/* Constants, and how far samples are moved. */
void common_fill_law(const law_samples *c, const solution one[LAW_SPREADS],
                     wt_shared_shift_law *common);
/* Chance that samples of one law differ so much: by the spreads that their own laws leave. */
double common_chance(const law_samples *c, const solution one[LAW_SPREADS],
                     const solution own[LAW_SPREADS]);
/* Isotherm i of sample k. */
void common_fill_point(const law_samples *c, size_t k, size_t i, const solution one[LAW_SPREADS],
                       const solution own[LAW_SPREADS], bool compared, wt_shared_law_point *point);

#endif
