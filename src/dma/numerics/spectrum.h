/* One relaxation spectrum for all isotherms: model, fit and errors. Logarithms are natural: x =
 * ln w, y = ln modulus. A shifted isotherm lies at x + a, and the measured value is ln E(x + a)
 * - b. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SPECTRUM_H
#define WT_DMA_NUMERICS_SPECTRUM_H

#include "core/base/array.h"
#include "dma/numerics/bordered_matrix.h"
#include "dma/numerics/isotherm.h"
#include <gsl/gsl_matrix.h>

/* Prior of the vertical shifts: normal about `mean` with the precision P - P S S' P. P is the
 * precision of each shift, S their smooth part. Without P the shifts are free except for fixed
 * ones. */
typedef struct spectrum_prior {
    bool held;               /* the vertical shifts are fixed at `mean` */
    const double *mean;      /* [n_curves] */
    double *precision;       /* [n_curves] P, or NULL: free, with the anchor fixed */
    gsl_matrix *smooth_part; /* [n_curves * n_smooth] S */
    size_t n_smooth;         /* 0: no smooth part */
    double *at;              /* [n_smooth] scratch */
    double log_det;          /* ln determinant of the covariance */
} spectrum_prior;

/* Maximum number of smooth components (spectrum_prior.c). It is exact to rounding over a range
 * of a thousand kelvin. */
enum { SPECTRUM_MAX_SMOOTH = 64 };

/* Prior of the second differences beyond an end of the measured range. */
typedef struct spectrum_extrapolation {
    double weight[3], mean, precision;
} spectrum_extrapolation;

/* Retardation times of a spectrum (spectrum_step.c), cached while its terms are unchanged. */
typedef struct spectrum_modes {
    bool known;
    double *terms;          /* [n_linear] terms of the cached values */
    double instantaneous;   /* instantaneous modulus */
    size_t n;               /* relevant terms, slow ones first */
    size_t *index;          /* [n] index of the term */
    double *modulus, *rate; /* [n] */
    double *root;           /* [n] inverse retardation time */
    double *slope, *bend;   /* [n] derivative of the transform there times root; second derivative
                               over the first */
    double *decay;          /* [n] scratch */
    double *share;          /* [n * n] root / (rate - root), root by root */
} spectrum_modes;

/* Errors of the instrument that all isotherms share (instrument_errors.c): a phase lag in
 * proportion to the frequency, the inertia of the moving parts, and the compliance of frame and
 * clamps, which is the last unknown because it is not fitted. */
typedef enum instrument_error {
    PHASE_LAG,
    INERTIA,
    FRAME_COMPLIANCE,
    INSTRUMENT_ERRORS
} instrument_error;

typedef struct spectrum {
    arena memory;          /* owner of all arrays below */
    wt_loading loading;    /* for a step, x is ln of 1/t, and STORAGE has E(t) or 1/J(t) */
    spectrum_modes *modes; /* retardation times, for creep only */
    /* data: the included curves, point by point */
    size_t n_curves, n;
    size_t *first;          /* [n_curves + 1] first point of a curve */
    double *x;              /* [n] */
    double *y[MODULI];      /* [n] */
    double *weight[MODULI]; /* [n] 0: excluded; 1, or less during the search for outliers */
    size_t anchor;          /* index of the anchor; its horizontal shift is 0 */
    size_t level_curve;     /* curve to which free vertical shifts refer; at first the anchor */
    bool used[MODULI];      /* fitted moduli; the other one has weight 0 */
    bool *lossless;         /* [n_curves] E'' of the curve is not fitted */
    bool ratio;             /* LOSS has tan delta: no level, no vertical shift */
    bool *given;            /* [n_curves] true if the horizontal shift is fixed */
    double *given_a;        /* [n_curves] its fixed value */
    double *given_b;        /* [n_curves] stated vertical shift, NaN: none */

    /* unknowns: ln of the terms, ln of the equilibrium modulus, instrument, a, b */
    size_t n_terms, n_linear; /* number of terms; the same plus the equilibrium modulus */
    size_t n_shared;          /* the same plus the errors of the instrument */
    double instrument[INSTRUMENT_ERRORS]; /* prior standard deviation, the unit of each unknown:
                                             [s], [Pa s^2], [1/Pa] */
    size_t n_fast;                        /* terms faster than the measured range */
    size_t n_measured;                    /* terms faster than its slow end */
    double log_tau, step;                 /* ln of the first relaxation time; step of ln time */
    double *time;                         /* [n_terms] relaxation times relative to the first */
    bool liquid;                          /* no equilibrium modulus */
    size_t n_unknowns;
    double *value;             /* [n_unknowns] */
    long *column_a, *column_b; /* [n_curves] index of the unknown of a curve, -1: fixed */
    double equilibrium_mean,
        equilibrium_spread; /* prior of the logarithm of the equilibrium modulus */
    double level; /* for tan delta: undetermined mean of ln of the terms, fixed to 1 standard
                     deviation */
    const spectrum_prior *prior;

    /* noise and smoothness */
    double noise[MODULI];
    double *kappa;                    /* [n_curves] noise factor of an isotherm */
    double *spread[MODULI];           /* [n] noise factor of a point */
    double *bend;                     /* [n_terms] weight of a second difference */
    size_t bend_first, bend_end;      /* range of the second differences with the measured prior */
    spectrum_extrapolation beyond[2]; /* priors on the fast and the slow side */
    double smoothness;                /* standard deviation of the second differences */
    double rho;                       /* correlation of neighbouring points */

    bool settled;       /* the last fit converged */
    size_t evaluations; /* number of evaluations so far */
    /* last evaluation: whitened rows, curve by curve; E' of a point, then E'' */
    double *residual[MODULI]; /* [n] */
    double *row[MODULI];      /* [n * (n_shared + 2)] d/d terms and instrument, d/da, d/db */
    double objective;
    /* Border: terms, then one unknown for each column of prior->smooth, with 1 on the diagonal
     * and -P S at the side. Eliminating these gives the equations with the prior. Blocks: a and
     * b. */
    bordered_matrix normal[MODULI];  /* J'J of the rows of a modulus, the present or earlier ones */
    double *normal_residual[MODULI]; /* [n] residuals of those rows */
    size_t normal_unknowns;          /* number of unknowns then, 0: no products */
    bool may_reuse;                  /* products of earlier rows may serve */
    double *right[MODULI];           /* [n_unknowns] J'r of the same rows */
    bordered_matrix precision;       /* normal / noise^2 + priors */
    bordered_matrix factor;          /* Cholesky factor of the precision */
    bordered_matrix covariance;      /* elements of the inverse at the non-zero positions */
    gsl_matrix *scratch;
    double *border, *side; /* scratch of a solve */
    gsl_vector *gradient;
    double
        rounding; /* relative addition to the diagonal that makes the precision positive definite */
    bool inverted;          /* factor and covariance are those of the precision */
    double log_det;         /* ln determinant of the precision */
    double criterion;       /* -2 ln evidence */
    double freedom[MODULI]; /* effective number of parameters of a modulus */

    double *term;                    /* [n_linear] */
    double *copy;                    /* [n] scratch */
    double *previous_weight[MODULI]; /* [n] previous weights */
    gsl_vector *direction;
    double *candidate;
    double *kept_value; /* [n_unknowns] a fit to return to */
    double kept_noise[MODULI], kept_smooth, kept_rho;
} spectrum;

/* Creates a spectrum of the curves in `use`, with start shifts a and b [decade]. `margin` limits
 * the extension beyond the measured range [decade], at least 1. The caller frees s. */
wt_status spectrum_new(const shift_set *set, const bool *use, size_t anchor, const double *a,
                       const double *b, double terms_per_decade, double margin, bool liquid,
                       spectrum *s, wt_error *err) WT_NODISCARD;
/* Starts from the terms of a fitted spectrum of the same anchor. Slower terms are added to the
 * equilibrium modulus. */
void spectrum_start_from(spectrum *s, const spectrum *fitted);
void spectrum_free(spectrum *s);
/* Sets the prior of b and the unknowns; the present shifts are unchanged. */
void spectrum_set_prior(spectrum *s, const spectrum_prior *prior);
/* Returns true if a modulus of a curve is fitted. */
bool spectrum_is_fitted(const spectrum *s, size_t curve, int q);
double spectrum_a(const spectrum *s, size_t curve);
double spectrum_b(const spectrum *s, size_t curve);
double spectrum_trial_b(const spectrum *s, const double *value, size_t curve);

/* Computes ln E' and ln E'' at x and their derivatives; slope: by x. gradient [n_linear]: by ln
 * of the terms, or NULL. */
void spectrum_moduli(const spectrum *s, const double *term, double x, double log_modulus[MODULI],
                     double slope[MODULI], double *const gradient[MODULI]);
/* Variant of `spectrum_moduli` for the measured quantity: the step response in STORAGE, with LOSS
 * 0. */
void spectrum_measured_moduli(const spectrum *s, const double *term, double x,
                              double log_modulus[MODULI], double slope[MODULI],
                              double *const gradient[MODULI]);
/* spectrum_step.c: computes ln E(t) or ln 1/J(t) at x = -ln t, depending on `loading`, and its
 * slope by x. Unless NULL, gradient gets the derivatives by ln of the terms [n_linear]. */
void spectrum_step_response(const spectrum *s, const double *term, double x, double *log_modulus,
                            double *slope, double *gradient);
void spectrum_modes_new(spectrum *s);
void spectrum_terms(const spectrum *s, const double *value, double *term); /* [n_linear] */

/* ---- instrument_errors.c */
/* Prior standard deviations: [rad] at the highest frequency; share of E' where inertia takes most;
 * [1/Pa]. */
extern const double instrument_deviation[INSTRUMENT_ERRORS];
/* Returns their number for a set. Moduli of a step, or one quantity alone, have none. */
size_t instrument_unknowns(const shift_set *set);
/* Sets the units of the unknowns from the data. */
void instrument_set_priors(spectrum *s);
static inline size_t instrument_count(const spectrum *s)
{
    return s->n_shared - s->n_linear;
}
/* Computes ln E' and ln E'' of a point without the errors of the instrument, and their derivatives
 * by these unknowns. */
void instrument_correct(const spectrum *s, const double *unknown, size_t k,
                        double log_modulus[MODULI], double by[MODULI][INSTRUMENT_ERRORS]);

/* ---- spectrum_model.c: rows, normal equations, priors */
void spectrum_evaluate(spectrum *s, const double *value, bool with_rows);
/* Subtracts the prediction by the previous point from the values of a curve, v[points * width],
 * and scales the rest. */
void spectrum_whiten(const spectrum *s, size_t curve, int q, double *v, size_t width);
double spectrum_log_det_correlation(const spectrum *s);
void spectrum_normal(spectrum *s);
/* Copies unknowns to the border and the side of a bordered matrix, and back. */
void spectrum_split(const spectrum *s, const double *y, double *border, double *side);
void spectrum_join(const spectrum *s, const double *border, const double *side, double *x);
double spectrum_variance(const spectrum *s, size_t curve); /* variance of a fitted a */
/* Returns the factor on the ln residual of a point; 0: excluded. */
double spectrum_weight(const spectrum *s, size_t k, int q);
double spectrum_squares(const spectrum *s, int q); /* sum of squares of the whitened residuals */
/* The slow end of a spectrum is unknown. It has equal probability at SPECTRUM_ENDS positions
 * from the first decade beyond the measured range on. The terms from spectrum_end_term() on belong
 * to the equilibrium modulus. */
enum { SPECTRUM_ENDS = 6 };
size_t spectrum_end_term(const spectrum *s, size_t place);

/* ---- spectrum_prior.c */
/* Assembles precision and gradient for the present noise and smoothness. */
void spectrum_assemble(spectrum *s);
/* Returns the objective of the last evaluated residuals. */
double spectrum_objective(const spectrum *s, const double *value);
double spectrum_roughness(const spectrum *s,
                          const double *value);     /* weighted squares of the second differences */
double spectrum_roughness_trace(const spectrum *s); /* contribution of the covariance to them */
double spectrum_prior_log_det(const spectrum *s);
/* Prior of the vertical shifts. */
typedef struct vertical {
    double reference_temperature, expansion; /* [K], [1/K] */
    double geometry, departure;              /* standard deviations [decade] */
    double *mean;                            /* [n] owned by the caller */
    spectrum_prior prior_storage;            /* arrays of the prior; one prior at a time */
    double *left;                            /* [n] scratch */
    gsl_matrix *root;                        /* scratch */
} vertical;
/* Returns ln b of rubber elasticity. */
double vertical_physical(const vertical *v, double temperature);
/* Allocates the arrays for n curves. */
void vertical_alloc(arena *memory, size_t n, vertical *v);
/* Fills the prior of the curves of a spectrum, which borrows `mean` and the arrays. Free shifts
 * fix only the level curve, with the clamping error; without a geometry error it is exact. */
wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err) WT_NODISCARD;

/* ---- spectrum_fit.c: Levenberg-Marquardt with noise and smoothness by Fellner-Schall */
typedef enum spectrum_mode {
    SPECTRUM_NOISE,  /* noise and smoothness are estimated */
    SPECTRUM_ROUGH,  /* the same with an accuracy that suffices to find outliers */
    SPECTRUM_ROBUST, /* the same with the weights of a Student distribution */
    SPECTRUM_TRIAL   /* noise and smoothness are fixed; suffices to compare the noise */
} spectrum_mode;
wt_status spectrum_fit(spectrum *s, spectrum_mode mode, wt_error *err) WT_NODISCARD;
/* Forms and factors the equations of the present unknowns, of no earlier rows. */
wt_status spectrum_refresh(spectrum *s, wt_error *err) WT_NODISCARD;
/* Takes the next step in the residuals alone, to first order, after a refresh. */
void spectrum_step_residuals(spectrum *s);
/* Returns the least objective that a step from the present unknowns can reach, by a parabola. */
double spectrum_expected_objective(spectrum *s);
/* Keeps the present fit, and returns to the kept one, which has the same unknowns. The equations
 * stay those of the last fit. */
void spectrum_keep(spectrum *s);
void spectrum_return(spectrum *s);
/* Chooses the correlation along the isotherms by the criterion, after a fit without one. */
wt_status spectrum_choose_rho(spectrum *s, wt_error *err) WT_NODISCARD;
/* Gain of -2 ln likelihood at which a fit ends. Its root is the remaining step in standard
 * errors, 3 %. */
#define SPECTRUM_MIN_GAIN 1e-3
/* Returns the largest change of any unknown by one more Newton step, in standard errors, after a
 * fit. */
double spectrum_step_left(const spectrum *s);
/* Adds the prior error of the frame compliance to factor and covariance of a fit: the terms respond
 * to it, and the shifts do not, as a spring in series changes all isotherms alike (a "considered"
 * parameter: Schmidt, Adv. Control Syst. 3 (1966) 293). The next fit is again without it. */
wt_status spectrum_consider_compliance(spectrum *s, wt_error *err);

/* ---- spectrum_noise.c */
/* Updates noise and smoothness by a share of the requested change unless that is less than
 * `enough`. Returns the largest relative change requested. */
double spectrum_noise_update(spectrum *s, double share, double enough);
void spectrum_criterion(spectrum *s);
/* Sets the weights of a Student distribution, also in the rows of independent points. */
void spectrum_student_weights(spectrum *s);
/* Updates the weights of the second differences from their neighbourhood, because a transition
 * is more curved than a plateau. Beyond the slow end no weight exceeds 1. */
void spectrum_update_curvature(spectrum *s);
/* Excludes outliers and restores points that are none. Returns the number of changes. */
size_t spectrum_outliers(spectrum *s);

/* Prior weight of equal noise factors, in points: half of the 16 values of an isotherm with
 * eight frequencies. It is a prior standard deviation of ln of a factor of 1/sqrt(2 * 8) = 0.25. */
#define SPECTRUM_KAPPA_PRIOR_POINTS 8.0
/* Noise about a separate polynomial of each isotherm, so that a misfit of the spectrum does not
 * count as noise. */
enum { SPECTRUM_SHAPES = 2 };
typedef struct spectrum_isotherm_noise {
    double rho;
    double
        shape[SPECTRUM_SHAPES]; /* line and parabola of ln noise along an isotherm, from -1 to 1 */
    double uncertainty;         /* variance of ln of the noise variance at low frequency */
} spectrum_isotherm_noise;
/* Estimates that noise. It sets the noise factors of the isotherms only. */
spectrum_isotherm_noise spectrum_estimate_noise(spectrum *s);
/* Computes the rms residual of each modulus [ln], and the rms residual about a polynomial of
 * each isotherm, for independent points. */
void spectrum_measure_misfit(spectrum *s, double all[MODULI], double within[MODULI]);
/* Sets the noise factors of the points from isotherm and position; shape NULL: isotherm alone. */
void spectrum_set_point_noise(spectrum *s, const double shape[SPECTRUM_SHAPES]);

/* ---- superposition.c: test if one spectrum with shifts describes the isotherms */
typedef struct lack_of_fit {
    double p;      /* p value of one spectrum from both tests, with the noise as estimated */
    double p_sure; /* the same with the uncertainty of the noise */
    double misfit_low, misfit_high;  /* relative misfit, 95 % limits: the larger of the two tests */
    double factor, factor_error, kk; /* ln of a common factor on E'', its error and p value */
    double p_beyond;                 /* p_sure of the isotherm columns without that factor */
    double beyond;                   /* share of their explained squares without that factor */
    double
        parted; /* separation of slow and fast times as a share of the shift, without that factor */
} lack_of_fit;

/* Tests a fit with free vertical shifts; uncertainty: that of its noise (spectrum_isotherm_noise).
 */
lack_of_fit superposition_test(const spectrum *s, double uncertainty);

#endif
