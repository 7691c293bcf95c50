/* Time-temperature superposition inside the fit room: isotherms in logarithms, the pairwise start,
 * the joint fit. x = log10 w, y = log10 modulus; shifted: x + a, y + b.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_SHIFT_H
#define WT_FIT_SHIFT_H

#include "base/pool.h"
#include "weartrack/fit.h"

enum { STORAGE, LOSS, MODULI };

/* Fewest points of an isotherm, and of the overlap of two in each modulus. */
#define SHIFT_MIN_POINTS 4

/* No instrument knows a modulus better than this (0.2 %): lower bound of the residual standard
 * deviation [decade], so that exact data do not make a flat curve decide. */
#define SHIFT_NOISE_FLOOR 0.001

/* The usable points of one isotherm, rising in x. */
typedef struct shift_curve {
    double temperature; /* [K] */
    size_t n;
    double *x;         /* [n] */
    double *y[MODULI]; /* [n] */
    size_t n_left_out; /* points with a modulus <= 0 */
} shift_curve;

/* All isotherms in the order of rising temperature. */
typedef struct shift_set {
    size_t n;
    shift_curve *curves;
    size_t n_points; /* of all curves */
} shift_set;

/* Takes logarithms, sorts, leaves out points without one. WT_E_RANGE names an isotherm that has too
 * few positive points left, or temperatures that are not kelvin. */
wt_status shift_set_new(const wt_sweep *sweep, wt_parselog *log, pool *memory, shift_set *set,
                        wt_error *err) WT_NODISCARD;

/* Where curve s goes relative to curve p (as measured). */
typedef struct shift_pair {
    bool found;             /* false: no overlap; the rest is then not set */
    double a, b;            /* s shifted by these lies on p */
    double rms;             /* of the overlap residual [decade] */
    double overlap[MODULI]; /* shared range of ordinates, measured [decade] */
} shift_pair;

/* Least squares of both moduli and both directions; b is projected out if free_b, else it is
 * fixed_b. */
wt_status shift_pair_fit(const shift_curve *p, const shift_curve *s, bool free_b, double fixed_b,
                         shift_pair *pair, wt_error *err) WT_NODISCARD;

/* The joint fit of the placed curves: one penalised cubic B-spline for each modulus in use,
 * projected out of the least squares; unknown are the shifts of all placed curves but the anchor.
 */
typedef struct shift_joint {
    const shift_set *set;
    const bool *placed;    /* [set->n] */
    size_t anchor;         /* shifts of this curve stay as they are */
    bool use[MODULI];      /* moduli that take part */
    bool free_b;           /* vertical shifts are unknown, else they stay as they are */
    double *a, *b;         /* [set->n] start in, result out */
    double *covariance_ab; /* [2n * 2n] of all a, then all b, out; 0 where they stay as they are */
    double *sigma_b;       /* [n] out */
    double *correlation;   /* [n] of a and b, out */
    double *slope_noise;   /* [n] share of noise in the squared slopes a curve is shifted by, out */
    double rms[MODULI];    /* residual standard deviation [decade], out */
    double last_step;      /* largest change of an `a` in the last iteration, out */
    size_t *n_outliers;    /* [n] points beyond 3 robust standard deviations, out; or NULL */
} shift_joint;

wt_status shift_joint_fit(shift_joint *joint, wt_error *err) WT_NODISCARD;

/* Do the shifts that E' alone and E'' alone ask for agree? Single-modulus fits from the joint
 * result, vertical shifts held. */
typedef struct superposition_check {
    double largest;    /* |difference| of a between them [decade] over the determined curves */
    double normalised; /* rms of the differences over their standard errors */
    size_t n;          /* curves that could be compared */
    bool failed;
} superposition_check;

wt_status shift_superposition(const shift_joint *joint, double floor, superposition_check *result,
                              wt_error *err) WT_NODISCARD;

#endif
