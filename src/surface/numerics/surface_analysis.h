/* Inside the fit room: the steps from heights to a power spectrum, and from spectra to one.
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_SURFACE_NUMERICS_SURFACE_ANALYSIS_H
#define WT_SURFACE_NUMERICS_SURFACE_ANALYSIS_H

#include "weartrack/fit.h"

#include <gsl/gsl_integration.h>

/* ---- heights: surface_form.c, surface_fill.c --------------------------------------------------
 */

/* 1; x, y; x^2, x y, y^2, with x and y from -1 to 1 over the points. */
enum { FORM_TERMS = 6 };
/* Takes the polynomial of that degree off, which is fitted to the finite heights by least squares;
 * of a profile that in x alone. `coefficients` of the terms above, 0 where there is none.
 * WT_E_EMPTY with fewer heights than terms. */
wt_status surface_form_remove(double *z, size_t nx, size_t ny, unsigned degree,
                              double coefficients[FORM_TERMS], wt_error *err) WT_NODISCARD;
/* Fills missing heights by the membrane over their neighbours: the five-point Laplace equation,
 * without a slope across the edges. */
wt_status surface_fill(double *z, size_t nx, size_t ny, wt_error *err) WT_NODISCARD;

/* ---- spectra: surface_transform.c -------------------------------------------------------------
 */

/* Bins are ten to a decade; bin k holds the modes of 10^((k - 1/2)/10) <= q / reference
 * < 10^((k + 1/2)/10). Modes outside [low, high] are left out. */
typedef struct surface_bins {
    double reference, low, high; /* [rad/m] */
} surface_bins;
/* C(q) of the heights, C1(q) of their rows if `lines`; the arrays of `to` are made. */
wt_status surface_transform(const wt_height_map *map, wt_surface_window window, bool lines,
                            const surface_bins *bins, wt_surface_spectrum *to,
                            wt_error *err) WT_NODISCARD;

/* ---- the scatter of a mean of exponential variables: surface_scatter.c -------------------------
 */

/* ln of a mean with so many degrees of freedom: what it is off ln of the truth in the mean, and its
 * variance; the freedom of a variance. */
double surface_log_bias(double freedom);
double surface_log_variance(double freedom);
double surface_freedom_of(double variance);
/* The interval of the truth behind a mean. */
wt_interval surface_interval(double mean, double freedom);

/* ---- places: surface_places.c -----------------------------------------------------------------
 */

/* Finds the sizes, and what they have, from the parts of the scans in each bin of `to`, [n_scans]
 * for each. */
wt_status surface_places_take(const double *weights, size_t n_scans, wt_surface_spectrum *to,
                              wt_error *err) WT_NODISCARD;
/* Standard error of ln C of a bin by the places of one size, over place_reach; and by
 * all. Where they are not kept all scans count alike. */
double surface_places_of(const wt_surface_spectrum *s, size_t bin, size_t size);
double surface_places_part(const wt_surface_spectrum *s, size_t bin);

/* ---- C of C1: surface_invert.c ------------------------------------------------------------------
 */

/* C(q) = -(1/pi) int_q^inf C1'(k) / sqrt(k^2 - q^2) dk of log-log linear C1 between n >= 2 knots,
 * above which its last slope goes on (`goes_on`) or it is 0. NaN below the first knot, and if the
 * last slope is not steeper than -1 where it goes on. */
double surface_invert(const double *q, const double *c1, size_t n, bool goes_on, double at,
                      const gsl_integration_glfixed_table *rule);
enum { INVERSION_POINTS = 10 }; /* of the rule; surface_invert.c has the reason */

#endif
