/* Time-temperature superposition inside the fit room: isotherms in logarithms, and where two lie to
 * each other. x = log10 w, y = log10 modulus; shifted: x + a, y + b.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_ISOTHERM_H
#define WT_DMA_NUMERICS_ISOTHERM_H

#include "core/base/arena.h"
#include "weartrack/fit.h"

enum { STORAGE, LOSS, MODULI };

/* Fewest points of an isotherm, and of the overlap of two in each modulus: one more than what
 * places it, its shifts and its slope, so that something is left over. */
#define SHIFT_MIN_POINTS 4

/* The usable points of one isotherm, rising in x. */
typedef struct shift_curve {
    double temperature; /* [K] */
    size_t n;
    double *x;         /* [n] */
    double *y[MODULI]; /* [n] */
    size_t n_left_out; /* points with a modulus <= 0 */
    size_t n_together; /* measured points, if neighbours became one; else 0 */
    bool given;        /* its shift is not fitted */
    double given_a;    /* its difference to another given one counts [decade] */
    bool held;         /* so is its vertical shift */
    double given_b;    /* it [decade] */
} shift_curve;

/* All isotherms in the order of rising temperature. */
typedef struct shift_set {
    wt_shift_by by; /* never MODULI if a modulus is missing */
    wt_loading loading;
    bool used[MODULI]; /* by tan delta alone it stands in the place of LOSS */
    size_t n;
    shift_curve *curves;
    size_t n_points; /* of all curves */
} shift_set;

/* Takes logarithms of what is asked for, sorts, leaves out points without one. WT_E_RANGE names an
 * isotherm that has too few positive points left, or temperatures that are not kelvin; WT_E_MISSING
 * for a modulus that was not measured. */
wt_status shift_set_new(const wt_sweep *sweep, wt_shift_by by, wt_log *log, arena *memory,
                        shift_set *set, wt_error *err) WT_NODISCARD;

/* By how much the modulus changes along a curve, storage if it is used [decade]. */
double shift_change(const shift_set *set, size_t curve);

/* Where curve s goes relative to curve p (as measured): by least squares of the moduli used and
 * both directions; b is projected out if free_b, else it is given. False: no overlap. */
bool shift_pair_fit(const shift_set *set, size_t p, size_t s, bool free_b, double *a, double *b);

#endif
