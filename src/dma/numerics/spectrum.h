/* One relaxation spectrum behind all isotherms: the model, its fit and its errors. Internal to the
 * fit room. Inside, logarithms are natural: x = ln w, y = ln modulus; a shifted isotherm lies at
 * x + a, and what was measured is ln E(x + a) - b.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SPECTRUM_H
#define WT_DMA_NUMERICS_SPECTRUM_H

#include "core/base/arena.h"
#include "dma/numerics/bordered_matrix.h"
#include "dma/numerics/isotherm.h"

#include <gsl/gsl_matrix.h>

/* Prior of the vertical shifts: normal about `mean` with the precision P - P S S' P, where P is
 * that of each by itself and S what is smooth in them; without one they are free but for those that
 * are held. */
typedef struct spectrum_prior {
    bool held;          /* the vertical shifts are `mean` */
    const double *mean; /* [n_curves] */
    double *precision;  /* [n_curves] P, or NULL: free, the anchor held */
    gsl_matrix *smooth; /* [n_curves * n_smooth] S */
    size_t n_smooth;    /* 0: nothing is */
    double *at;         /* [n_smooth] scratch */
    double log_det;     /* of the covariance */
} spectrum_prior;

/* Of shifts the more is smooth the wider their departure reaches (vertical_shift.c): so many
 * numbers tell it to rounding over a thousand kelvin. */
enum { SPECTRUM_MOST_SMOOTH = 64 };

/* Second differences beyond an end of the measured range: their law is given. */
typedef struct spectrum_beyond {
    double weight[3], mean, precision;
} spectrum_beyond;

/* Retardation times of a spectrum (spectrum_step.c), kept while its terms are the same. */
typedef struct spectrum_modes {
    bool known;
    double *of;             /* [n_linear] terms they are for */
    double instantaneous;   /* modulus */
    size_t n;               /* terms that count, slow ones first */
    size_t *index;          /* [n] of a term */
    double *modulus, *rate; /* [n] */
    double *root;           /* [n] one over a retardation time */
    double *slope, *bend;   /* [n] of the transform there, times root and over the slope */
    double *decay;          /* [n] scratch */
    double *share;          /* [n * n] root / (rate - root), root by root */
} spectrum_modes;

typedef struct spectrum {
    arena memory;       /* of all below */
    wt_loading loading; /* of a step x is ln of 1/t, and E(t) or 1/J(t) in the place of STORAGE */
    spectrum_modes *modes; /* of creep */
    /* data: the curves that take part, point by point */
    size_t n_curves, n;
    size_t *first;          /* [n_curves + 1] first point of a curve */
    double *x;              /* [n] */
    double *y[MODULI];      /* [n] */
    double *weight[MODULI]; /* [n] 0: left out; 1, or less while outliers are looked for */
    size_t anchor;          /* its horizontal shift is 0 */
    bool used[MODULI];      /* the other one has weight 0 */
    bool ratio;             /* in the place of LOSS is tan delta: no level, no vertical shift */
    bool *given;            /* [n_curves] the horizontal shift is not fitted */
    double *given_a;        /* [n_curves] it */
    double *given_b;        /* [n_curves] the vertical shift, NaN: not given */

    /* unknowns: ln of the terms, ln of the equilibrium modulus, a, b */
    size_t n_terms, n_linear; /* terms; with the equilibrium modulus */
    size_t n_fast;            /* terms before the fast end of the measured range */
    size_t n_measured;        /* and before the slow one */
    double log_tau, step;     /* ln of the first relaxation time and between them */
    double *time;             /* [n_terms] relaxation times, of the first one */
    bool liquid;              /* no equilibrium modulus */
    size_t n_unknowns;
    double *value;                               /* [n_unknowns] */
    long *column_a, *column_b;                   /* [n_curves] unknown of a curve, -1: held */
    double equilibrium_mean, equilibrium_spread; /* prior of its logarithm */
    double level; /* of ratio: mean of ln of the terms, which nothing tells, to 1 */
    const spectrum_prior *prior;

    /* noise and smoothness */
    double noise[MODULI];
    double *kappa;               /* [n_curves] factor on the noise of an isotherm */
    double *spread[MODULI];      /* [n] the same of a point */
    double *bend;                /* [n_terms] weight of a second difference */
    size_t bend_first, bend_end; /* those that are as in the measured range */
    spectrum_beyond beyond[2];   /* before and behind them */
    double smooth;               /* standard deviation of the second differences */
    double smooth_move;          /* its last step, ln */
    double rho;                  /* correlation of neighbouring points */

    bool settled;       /* the last fit ended by itself */
    size_t evaluations; /* so far */
    /* of the last evaluation: whitened rows, curve by curve; E' of a point, then E'' */
    double *residual[MODULI]; /* [n] */
    double *row[MODULI];      /* [n * (n_linear + 2)] d/d terms, d/da, d/db */
    double objective;
    /* Border: terms, and behind them one for each column of prior->smooth: with 1 on the diagonal
     * and -P S beside it, the equations without it are those of the prior. Blocks: a and b. */
    bordered normal[MODULI]; /* J'J of the rows of a modulus */
    bordered precision;      /* normal / noise^2 + priors */
    bordered factor;         /* of it */
    bordered covariance;     /* of its inverse what lies where it is not 0 */
    gsl_matrix *scratch;
    double *border, *side; /* of a vector */
    gsl_vector *gradient;
    double rounding;        /* of a diagonal, that the precision was given to be positive */
    double log_det;         /* of the precision */
    double criterion;       /* -2 ln evidence */
    double freedom[MODULI]; /* effective parameters of a modulus */

    double *term;        /* [n_linear] */
    double *copy;        /* [n] scratch */
    double *was[MODULI]; /* [n] weights before */
    gsl_vector *direction;
    double *trial;
} spectrum;

/* Of the curves in `use`, with shifts (decades) to start from. */
wt_status spectrum_new(const shift_set *set, const bool *use, size_t anchor, const double *a,
                       const double *b, double terms_per_decade, bool liquid, spectrum *s,
                       wt_error *err) WT_NODISCARD;
void spectrum_free(spectrum *s);
/* Sets the prior of b and with it the unknowns; shifts stay where they are. */
void spectrum_set_prior(spectrum *s, const spectrum_prior *prior);
double spectrum_a(const spectrum *s, size_t curve);
double spectrum_b(const spectrum *s, size_t curve);
double spectrum_b_of(const spectrum *s, const double *value, size_t curve);

/* ln E', ln E'' at x of the spectrum, and their derivatives; slope: by x. gradient: [n_linear]. */
void spectrum_at(const spectrum *s, const double *term, double x, double log_modulus[MODULI],
                 double slope[MODULI], double *const gradient[MODULI]);
/* The same of what was measured: LOSS is 0 after a step. */
void spectrum_measured_at(const spectrum *s, const double *term, double x,
                          double log_modulus[MODULI], double slope[MODULI],
                          double *const gradient[MODULI]);
/* ---- spectrum_step.c: ln E(t) or ln 1/J(t) at x = -ln t, as `loading` says, its slope by x and,
 * unless NULL, its derivatives by ln of the terms [n_linear] */
void spectrum_step_at(const spectrum *s, const double *term, double x, double *log_modulus,
                      double *slope, double *gradient);
void spectrum_modes_new(spectrum *s);
void spectrum_terms(const spectrum *s, const double *value, double *term); /* [n_linear] */

/* ---- spectrum_model.c: rows, normal equations, priors */
void spectrum_evaluate(spectrum *s, const double *value, bool with_rows);
/* Takes from the values of the points of a curve, v[points * width], what the neighbour before
 * foretells. */
void spectrum_whiten(const spectrum *s, size_t curve, int q, double *v, size_t width);
double spectrum_log_det_correlation(const spectrum *s);
void spectrum_normal(spectrum *s);
/* x = covariance times y, of unknowns; they may be the same. */
void spectrum_solve(const spectrum *s, const double *y, double *x);
/* All of the precision [n_unknowns^2]. */
void spectrum_precision(const spectrum *s, gsl_matrix *precision);
double spectrum_variance(const spectrum *s, size_t curve); /* of a, that is fitted */
/* What a residual in ln of a point is multiplied by; 0: left out. */
double spectrum_weight(const spectrum *s, size_t k, int q);
double spectrum_squares(const spectrum *s, int q); /* of the whitened residuals */

/* ---- spectrum_ends.c */
/* How far the terms go beyond the measured range [decade]. */
extern const double spectrum_fast_margin, spectrum_slow_margin;
void spectrum_set_bends(spectrum *s);
/* Where a spectrum ends that is slower than what was measured is open: at any of so many places,
 * from the first decade behind the measured range on, alike. The terms from spectrum_end() on are
 * then part of the equilibrium modulus. */
enum { SPECTRUM_ENDS = 6 };
size_t spectrum_end(const spectrum *s, size_t place);

/* ---- spectrum_prior.c */
/* precision and gradient for the present noise and smoothness. */
void spectrum_assemble(spectrum *s);
/* Of the residuals evaluated last. */
double spectrum_objective(const spectrum *s, const double *value);
double spectrum_roughness(const spectrum *s, const double *value); /* squared second differences */
double spectrum_roughness_trace(const spectrum *s); /* what the covariance adds to them */
double spectrum_prior_log_det(const spectrum *s);

/* ---- spectrum_fit.c: Levenberg-Marquardt with noise and smoothness by Fellner-Schall */
typedef enum spectrum_mode {
    SPECTRUM_NOISE,  /* noise and smoothness are estimated */
    SPECTRUM_ROUGH,  /* the same, good enough to look for outliers */
    SPECTRUM_ROBUST, /* the same, with the weights of a Student distribution */
    SPECTRUM_HELD,   /* noise and smoothness are held */
    SPECTRUM_TRIAL   /* the same, good enough to see whether much less is left */
} spectrum_mode;
wt_status spectrum_fit(spectrum *s, spectrum_mode mode, wt_error *err) WT_NODISCARD;
/* Of -2 ln likelihood by a step: its root is what it still moves in standard errors, 3 %. */
#define SPECTRUM_LEAST_GAIN 1e-3
/* What a step of Newton's method would still move any of the unknowns by, in standard errors, at
 * most; after a fit. */
double spectrum_step_left(const spectrum *s);

/* ---- spectrum_noise.c */
/* Of both moduli and the smoothness, by this share of what they ask for; the largest relative
 * change that they ask for. */
double spectrum_noise_update(spectrum *s, double share);
void spectrum_criterion(spectrum *s);
void spectrum_student_weights(spectrum *s);
/* A transition bends more than a plateau: weights of the second differences by what is near. Beyond
 * the slow end none is held more than elsewhere: how it goes on there is open. */
void spectrum_bends(spectrum *s);
/* Leaves out single points far off and takes back those that are not; how many changed. */
size_t spectrum_outliers(spectrum *s);

/* Noise of an isotherm is estimated with as much belief that it is that of all as so many points
 * would give: half of the 16 values that an isotherm of eight frequencies has, so that it is
 * believed twice as much as the others. Chosen; a loud one of five times the noise is seen with 4
 * and with 16, too. */
#define SPECTRUM_KAPPA_BELIEF 8.0

/* ---- spectrum_correlation.c */
/* Correlation along the isotherms by the criterion. */
wt_status spectrum_choose_rho(spectrum *s, wt_error *err) WT_NODISCARD;
/* Noise by what is left of each isotherm about a curve of its own: a spectrum that does not fit is
 * no noise. */
enum { SPECTRUM_SHAPES = 2 };
typedef struct spectrum_within {
    double rho;
    double shape[SPECTRUM_SHAPES]; /* of ln noise along an isotherm, from -1 to 1: line, parabola */
    double uncertainty; /* variance of ln of the variance that slow waves of such noise have */
} spectrum_within;
/* Sets the factors of the isotherms, and leaves the rest to the caller. */
wt_status spectrum_noise_within(spectrum *s, spectrum_within *within, wt_error *err) WT_NODISCARD;
/* What the moduli are off, in ln, and what of it a polynomial of each isotherm leaves; points are
 * taken as independent. */
wt_status spectrum_misses(spectrum *s, double all[MODULI], double within[MODULI],
                          wt_error *err) WT_NODISCARD;
/* Factors of the points: of their isotherm, and by their place on it. */
void spectrum_spread(spectrum *s, const double shape[SPECTRUM_SHAPES]);

#endif
