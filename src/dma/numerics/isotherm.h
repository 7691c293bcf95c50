/* Isotherms as logarithms, and the shift between two of them. x = log10 w, y = log10 modulus;
 * shifted: x + a, y + b. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_ISOTHERM_H
#define WT_DMA_NUMERICS_ISOTHERM_H

#include "core/base/array.h"
#include "weartrack/dma.h"

enum { STORAGE, LOSS, MODULI };

/* Minimum number of points of an isotherm, and of an overlap in each modulus. It is one more
 * than shift, vertical shift and slope require. */
#define SHIFT_MIN_POINTS 4

/* Usable points of one isotherm, rising in x. */
typedef struct shift_curve {
    double temperature; /* [K] */
    size_t n;
    double *x;           /* [n] */
    double *y[MODULI];   /* [n] */
    size_t n_skipped;    /* points with a modulus <= 0 */
    size_t n_merged;     /* measured points if neighbours were merged; otherwise 0 */
    bool is_shift_fixed; /* the horizontal shift is stated and not fitted */
    wt_shift_origin origin;
    double fixed_log_a; /* stated log10 a; only differences to other stated shifts count [decade] */
    bool is_vertical_fixed; /* the vertical shift is stated, too */
    double fixed_log_b;     /* stated log10 b [decade] */
    bool is_loss_excluded;  /* E'' is off and not fitted */
    bool has_no_moduli;     /* too few points have a positive modulus: it cannot be kept */
    char exclusion[128]; /* what is left out and why: the isotherm, with n = 0, or its E''; or "" */
} shift_curve;

/* All isotherms by rising temperature. */
typedef struct shift_set {
    wt_shift_quantity quantity; /* not WT_SHIFT_MODULI if a modulus is missing */
    bool without_instrument;    /* errors of the instrument are not fitted */
    wt_loading loading;
    bool used[MODULI]; /* fitted quantities; tan delta takes the place of LOSS */
    size_t n;
    shift_curve *curves;
    size_t n_points; /* points of all curves */
} shift_set;

/* Takes logarithms of the requested quantities, sorts the points and skips points without
 * logarithms. Returns WT_E_RANGE with the isotherm that has too few positive points or a
 * temperature that is not in kelvin. Returns WT_E_MISSING if a modulus was not measured.
 * `memory` owns the arrays. */
wt_status shift_set_new(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                        arena *memory, shift_set *set, wt_error *err) WT_NODISCARD;

/* Returns the change of the modulus along a curve, of E' if it is used [decade]. */
double curve_modulus_change(const shift_set *set, size_t curve);

/* Places each isotherm on its placed neighbours, outwards from the anchor; a, b: [set->n]
 * decades. */
void spectrum_find_initial_shifts(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                                  const double *physical, bool *placed, double *a, double *b);
/* Restricts `placed` to isotherms that are connected to the anchor by shared frequencies.
 * overlap: the smallest shared range on the path [decade], infinite for the anchor. Returns
 * their number. */
size_t spectrum_select_connected(const shift_set *set, size_t anchor, const double *a, bool *placed,
                                 double *overlap);

#endif
