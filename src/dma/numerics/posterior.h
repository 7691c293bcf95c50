/* What the isotherms say about spectrum, shifts and law together: a mixture of normal
 * distributions, over the widths of the vertical shift and the spread of the temperatures. Internal
 * to the fit room. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_POSTERIOR_H
#define WT_DMA_NUMERICS_POSTERIOR_H

#include "dma/numerics/shift_law.h"
#include "dma/numerics/vertical_shift.h"

enum { POSTERIOR_CELLS = 12 }; /* widths of geometry times those of departure in master_fit.c */

/* One fit of the spectrum, for one width of the vertical shift. */
typedef struct posterior_cell {
    double *value;          /* [n_unknowns] */
    gsl_matrix *covariance; /* [n_unknowns^2]; NULL: it weighs nothing */
    gsl_matrix *root;       /* Cholesky factor of its inverse, or NULL */
    double *smooth;         /* [n_curves^2] smooth part of b at the isotherms; NULL: b itself */
    double noise[MODULI], smoothness;
    double geometry, departure; /* widths of the vertical shift */
    double log_weight, weight;  /* without the law */
    bool settled;               /* the fit ended by itself */
} posterior_cell;

/* The same with a law and a spread of the temperatures. */
typedef struct posterior_part {
    const posterior_cell *cell;
    double spread, weight;
    law_fit law;
    gsl_vector *pull;    /* [n_curves] S^-1 (law - log a) */
    gsl_matrix *inner;   /* [n_curves^2] what the law takes from the covariance */
    gsl_matrix *outer;   /* [n_curves * LAW_MOST] S^-1 X cov(law) */
    gsl_matrix *inverse; /* [n_curves^2] S^-1 */
} posterior_part;

struct wt_posterior {
    arena memory;
    spectrum frame;      /* the spectrum: terms, columns, data */
    double *temperature; /* [n_curves] */
    double *mean_b;      /* [n_curves] prior of ln b */
    double *slope;       /* [n_curves] of the law */
    double *scratch;     /* [7 n_curves + 4 n_linear] */
    double *with_all;    /* [3 n_curves + n_linear] scratch */
    char no_law[256];    /* why there is none */
    size_t *curve;       /* [isotherms of the sweep] in the spectrum */
    double *closed_form; /* [isotherms of the sweep] log10 a of ISO 18437-6, against the anchor */
    double *measured_factor; /* [points of the master curve] tan delta, NaN: not measured */
    wt_shift_by by;
    double *doubt; /* [n_curves] error of the shifts beside that of the fit [decade], or NULL */
    gsl_matrix *doubts;      /* [n_curves^2] its covariance as the law takes it */
    gsl_matrix *doubts_root; /* factor of it */
    double anchor_a;         /* log10 a of the anchor against the reference temperature */
    law_shape shape;
    law_data data;
    size_t n_cells, n_parts;
    posterior_cell cells[POSTERIOR_CELLS];
    posterior_part *parts;
    double step_left; /* of a cell, by one more [standard errors] */
};

wt_posterior *posterior_new(void); /* NULL when out of memory */
void posterior_free(wt_posterior *p);
/* Keeps what the frame has been fitted to. */
wt_status posterior_keep(wt_posterior *p, wt_vertical_shift kind, const vertical *v,
                         double log_weight, wt_error *err) WT_NODISCARD;
/* What weighs most without the law. */
const posterior_cell *posterior_best(const wt_posterior *p);
/* Puts the frame back to what was kept; its prior is set. */
void posterior_restore(wt_posterior *p, const posterior_cell *cell);
/* Weighs the cells, chooses the law and weighs its parts; without one no_law says why. */
wt_status posterior_close(wt_posterior *p, double reference, wt_error *err) WT_NODISCARD;
/* Column of the unknown a of a curve; false for the anchor. */
bool posterior_column(const wt_posterior *p, size_t curve, size_t *column);

wt_interval posterior_a(const wt_posterior *p, size_t curve);    /* decades, as measured */
double posterior_fit_error(const wt_posterior *p, size_t curve); /* of that, without doubts */
wt_interval posterior_a_to_reference(const wt_posterior *p, size_t curve);
wt_interval posterior_b(const wt_posterior *p, size_t curve);
/* What log a moves by with log b, along the valley of equally good fits. */
double posterior_tie(const wt_posterior *p, size_t curve);
wt_interval posterior_law(const wt_posterior *p, double temperature);
wt_interval posterior_slope(const wt_posterior *p, double temperature); /* decade/K */
wt_interval posterior_constant(const wt_posterior *p, size_t unknown);
/* ln E', ln E'' and ln tan delta at ln w and the reference temperature. */
enum { LOSS_FACTOR = MODULI, WITH_LOSS_FACTOR };
/* `measured`: what a step shows in the place of E', and nothing else, if one was measured. */
void posterior_moduli(const wt_posterior *p, double x, bool measured,
                      wt_interval modulus[WITH_LOSS_FACTOR]);
/* ln of the equilibrium modulus, wherever the spectrum ends. */
wt_interval posterior_equilibrium(const wt_posterior *p);
/* Where it does in a draw. */
size_t posterior_place(uint64_t seed, size_t index);
/* ln of the spectrum at the time that a term has by the mean offset of the law; slope: d ln/d ln
 * tau. */
wt_interval posterior_term(const wt_posterior *p, size_t term, double slope);
/* Means over the mixture: of all unknowns, of those of the law. */
void posterior_mean(const wt_posterior *p, double *value);
void posterior_mean_law(const wt_posterior *p, double unknown[LAW_MOST]);
/* log10 b of the material at the isotherms: what is smooth in the shifts of the isotherms. */
void posterior_smooth_b(const wt_posterior *p, const posterior_cell *cell, const double *value,
                        double *log_b);
/* One draw of the whole: unknowns of the spectrum [n_unknowns] and of the law, b of the material at
 * the isotherms. The same seed and index give the same, whatever ran before. */
wt_status posterior_draw(const wt_posterior *p, uint64_t seed, size_t index, double *value,
                         double unknown[LAW_MOST], double *log_b, wt_error *err) WT_NODISCARD;

#endif
