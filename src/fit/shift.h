/* Time-temperature superposition inside the fit room: isotherms in logarithms, the pairwise start,
 * the joint fit. x = log10 w, y = log10 modulus; shifted: x + a, y + b.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_SHIFT_H
#define WT_FIT_SHIFT_H

#include "weartrack/fit.h"

enum { WT_STORAGE, WT_LOSS, WT_MODULI };

/* Fewest points of an isotherm, and of the overlap of two in each modulus. */
#define WT_SHIFT_MIN_POINTS 4

/* No instrument knows a modulus better than this (0.2 %): lower bound of the residual standard
 * deviation [decade], so that exact data do not make a flat curve decide. */
#define WT_SHIFT_NOISE_FLOOR 0.001

/* The usable points of one isotherm, rising in x. */
typedef struct wt_shift_curve {
    double temperature; /* [K] */
    size_t n;
    double *x;            /* [n] */
    double *y[WT_MODULI]; /* [n] */
    size_t n_left_out;    /* points with a modulus <= 0 */
    size_t sweep_index;   /* isotherm in the sweep */
} wt_shift_curve;

/* All isotherms in the order of rising temperature; owns one block of numbers. */
typedef struct wt_shift_set {
    size_t n;
    wt_shift_curve *curves;
    double *numbers;
    size_t n_points; /* of all curves */
} wt_shift_set;

/* Takes logarithms, sorts, leaves out points without one. WT_E_RANGE names an isotherm that has too
 * few positive points left, or temperatures that are not kelvin. */
wt_status wt_shift_set_new(const wt_sweep *sweep, wt_parselog *log, wt_shift_set *set,
                           wt_error *err) WT_NODISCARD;
void wt_shift_set_free(wt_shift_set *set);

/* Where curve s goes relative to curve p (as measured). */
typedef struct wt_shift_pair {
    bool found;                /* false: no overlap; the rest is then not set */
    double a, b;               /* s shifted by these lies on p */
    double rms;                /* of the overlap residual [decade] */
    double overlap[WT_MODULI]; /* shared range of ordinates, measured [decade] */
} wt_shift_pair;

/* Least squares of both moduli and both directions; b is projected out if free_b, else it is
 * fixed_b. */
wt_status wt_shift_pair_fit(const wt_shift_curve *p, const wt_shift_curve *s, bool free_b,
                            double fixed_b, wt_shift_pair *pair, wt_error *err) WT_NODISCARD;

/* The joint fit of the placed curves: one penalised cubic B-spline for each modulus in use,
 * projected out of the least squares; unknown are the shifts of all placed curves but the anchor.
 */
typedef struct wt_shift_joint {
    const wt_shift_set *set;
    const bool *placed;    /* [set->n] */
    size_t anchor;         /* shifts of this curve stay as they are */
    bool use[WT_MODULI];   /* moduli that take part */
    bool free_b;           /* vertical shifts are unknown, else they stay as they are */
    double *a, *b;         /* [set->n] start in, result out */
    double *covariance_a;  /* [n * n] out; 0 for the anchor and curves not placed */
    double *covariance_ab; /* [2n * 2n] of all a, then all b, out; or NULL */
    double *sigma_b;       /* [n] out */
    double *correlation;   /* [n] of a and b, out */
    double *slope_noise;   /* [n] share of noise in the squared slopes a curve is shifted by, out */
    double rms[WT_MODULI]; /* residual standard deviation [decade], out */
    double last_step;      /* largest change of an `a` in the last iteration, out */
    size_t *n_outliers;    /* [n] points beyond 3 robust standard deviations, out; or NULL */
} wt_shift_joint;

wt_status wt_shift_joint_fit(wt_shift_joint *joint, wt_error *err) WT_NODISCARD;

/* Do the shifts that E' alone and E'' alone ask for agree? Single-modulus fits from the joint
 * result, vertical shifts held. */
typedef struct wt_superposition {
    double largest;    /* |difference| of a between them [decade] over the determined curves */
    double normalised; /* rms of the differences over their standard errors */
    size_t n;          /* curves that could be compared */
    bool failed;
} wt_superposition;

wt_status wt_shift_superposition(const wt_shift_joint *joint, double floor,
                                 wt_superposition *result, wt_error *err) WT_NODISCARD;

#endif
