/* Joint posterior distribution of spectrum, shifts and law: a mixture of normal distributions
 * over the widths of the vertical shift and the temperature error. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_POSTERIOR_H
#define WT_DMA_NUMERICS_POSTERIOR_H

#include "dma/numerics/shift_law.h"
#include "dma/numerics/spectrum.h"

/* A distribution of a mixture: normal, or Student's t with `freedom`. */
typedef struct mixture_component {
    double weight, mean, deviation;
} mixture_component;
/* Returns the probability of values up to x. The weights must sum to 1. An infinite freedom means
 * normal distributions. */
double mixture_probability(const mixture_component *part, size_t n, double freedom, double x);
/* Returns the mean, the 95 % limits and the corresponding standard error. */
wt_interval student_mixture_interval(const mixture_component *part, size_t n, double freedom);
wt_interval mixture_interval(const mixture_component *part, size_t n);
/* Returns the interval of x + by, and of a rising function of x. */
wt_interval interval_offset(wt_interval x, double by);
wt_interval interval_map(wt_interval x, double (*f)(double));

/* Number of geometry widths times departure widths in master_widths.c. */
enum { POSTERIOR_CELLS = 12 };

/* One fit of the spectrum for one width of the vertical shift. */
typedef struct posterior_cell {
    double *value;           /* [n_unknowns] */
    bordered_matrix factor;  /* of the inverse of the covariance; empty: negligible weight */
    gsl_matrix *through;     /* [border * n_curves] the covariance of two log a is the product of
                                their columns */
    double *block;           /* [BLOCK_DIAGONAL n_curves] covariance of a and b of each curve */
    gsl_matrix *smooth_part; /* [n_curves * components] of the smooth part of b at the isotherms;
                           NULL: b without smoothing */
    size_t n_smooth;
    double noise[MODULI], smoothness;
    double geometry, departure; /* widths of the vertical shift */
    double log_weight, weight;  /* weight without the law */
    bool has_converged;         /* the fit converged */
} posterior_cell;

/* A cell combined with a law and a temperature error. */
typedef struct posterior_component {
    const posterior_cell *cell;
    double spread, weight;
    law_fit law;
    gsl_vector *pull;   /* [n_curves] S^-1 (law - log a); NULL: there is no law */
    gsl_matrix *root;   /* [n_curves^2] Cholesky factor of S */
    gsl_matrix *design; /* [n_curves * unknowns] S^-1 X */
} posterior_component;

struct wt_posterior {
    arena memory;
    spectrum frame;          /* the spectrum: terms, columns, data */
    double *temperature;     /* [n_curves] */
    double *mean_b;          /* [n_curves] prior of ln b */
    double *slope;           /* [n_curves] slope of the law */
    double *scratch;         /* [9 n_curves + 4 n_shared] */
    double *border, *side;   /* [n_shared + SPECTRUM_MAX_SMOOTH], [BLOCK_SIDE n_curves] scratch */
    char no_law_reason[256]; /* reason why there is no law */
    size_t *curve;           /* [isotherms of the sweep] index in the spectrum */
    double *closed_form; /* [isotherms of the sweep] log10 a of ISO 18437-6, against the anchor */
    double *measured_factor; /* [points of the master curve] tan delta, NaN: not measured */
    wt_shift_quantity by;
    double *extra_error;          /* [n_curves] additional error of the shifts [decade], or NULL */
    gsl_matrix *extra_covariance; /* [n_curves^2] its covariance for the law */
    gsl_matrix *extra_covariance_root; /* Cholesky factor of that covariance */
    double anchor_a;                   /* log10 a of the anchor against the reference temperature */
    double reference_a; /* log10 a of the reference against the anchor, if no law gives it */
    law_shape shape;
    law_data data;
    size_t n_cells, n_components;
    posterior_cell cells[POSTERIOR_CELLS];
    posterior_component *components;
    double step_left; /* largest remaining step of a cell [standard errors] */
};

void posterior_free(wt_posterior *p);
/* Stores the present fit of the frame as a cell. */
wt_status posterior_store(wt_posterior *p, wt_vertical_shift kind, const vertical *v,
                          double log_weight, wt_error *err);
/* Computes the inverse factor of the block of a curve times its shift. */
void posterior_unit_shift(const posterior_cell *cell, size_t curve, double x[BLOCK_SIDE]);
/* Returns the cell with the largest weight without the law. */
const posterior_cell *posterior_best(const wt_posterior *p);
/* Restores the frame from a cell; its prior must be set. */
void posterior_restore(wt_posterior *p, const posterior_cell *cell);
/* Weighs the cells, chooses the law and weighs the components. Without a law, no_law_reason has the
 * reason. */
wt_status posterior_finish(wt_posterior *p, double reference, wt_error *err) WT_NODISCARD;
/* Return ln a and ln b of a curve with these unknowns. */
double posterior_shift(const wt_posterior *p, const double *value, size_t curve);
double posterior_vertical_shift(const wt_posterior *p, const double *value, size_t curve);

/* A curve, or a place between a curve and the next: log a of the place is that of the line between
 * them at `share` of the way, minus `law`. */
typedef struct posterior_place {
    size_t cold, warm;
    double share;
    double law;      /* the law on that line, minus the law at the place [decade] */
    double variance; /* of the place, beyond that of the curves [decade^2] */
} posterior_place;
posterior_place posterior_at_curve(size_t curve);
/* Returns the place of a temperature between curve `cold` and the next. There must be a law whose
 * reference is that temperature. */
posterior_place posterior_between(const wt_posterior *p, size_t cold, double temperature);
/* Factors a covariance. The row of a value without a variance, as the reference, is 0. */
void posterior_root(const gsl_matrix *covariance, gsl_matrix *root);
/* Shift of a curve against a place, in decades. */
wt_interval posterior_a(const wt_posterior *p, size_t curve, const posterior_place *to);
double posterior_fit_error(const wt_posterior *p,
                           size_t curve); /* standard error without the additional error */
/* Shift of a place against the reference of the law. */
wt_interval posterior_a_to_law(const wt_posterior *p, const posterior_place *place);
wt_interval posterior_b(const wt_posterior *p, size_t curve);
wt_interval posterior_law(const wt_posterior *p, double temperature);
wt_interval posterior_slope(const wt_posterior *p, double temperature); /* decade/K */
/* Error of the instrument in the unit of instrument_deviation; NaN without such unknowns. */
wt_interval posterior_instrument(const wt_posterior *p, instrument_error which);
wt_interval posterior_constant(const wt_posterior *p, size_t unknown);
/* Quantities of posterior_moduli: ln E', ln E'' and ln tan delta at ln w and the reference
 * temperature. */
enum { LOSS_FACTOR = MODULI, WITH_LOSS_FACTOR };
/* `measured`: computes the step response in place of E', if a step was measured. */
void posterior_moduli(const wt_posterior *p, double x, bool measured,
                      wt_interval modulus[WITH_LOSS_FACTOR]);
/* ln of the equilibrium modulus, averaged over the end of the spectrum. */
wt_interval posterior_equilibrium(const wt_posterior *p);
/* Returns the index of the end of the spectrum in a draw. */
size_t posterior_end_index(uint64_t seed, size_t index);
/* Returns the normal deviate of the temperature of the sample in a draw. */
double posterior_temperature_draw(uint64_t seed, size_t index);
/* ln of the spectrum at the time of a term with the mean offset of the law; slope: d ln/d ln
 * tau. */
wt_interval posterior_term(const wt_posterior *p, size_t term, double slope);
/* Means over the mixture: all unknowns, and those of the law. */
void posterior_mean(const wt_posterior *p, double *value);
void posterior_mean_law(const wt_posterior *p, double unknown[LAW_MAX_UNKNOWNS]);
/* log10 b of the material at the isotherms: the smooth part of the shifts. */
void posterior_smooth_b(const wt_posterior *p, const posterior_cell *cell, const double *value,
                        double *log_b);
/* One joint draw: unknowns of the spectrum [n_unknowns] and of the law, and b of the material at
 * the isotherms. The draw depends on seed and index only. */
void posterior_draw(const wt_posterior *p, uint64_t seed, size_t index, double *value,
                    double unknown[LAW_MAX_UNKNOWNS], double *log_b);

#endif
