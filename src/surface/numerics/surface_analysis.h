/* Internal interface: from heights to a power spectrum, and the combination of spectra.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_NUMERICS_SURFACE_ANALYSIS_H
#define WT_SURFACE_NUMERICS_SURFACE_ANALYSIS_H

#include "weartrack/surface.h"
#include <gsl/gsl_integration.h>

/* Chi-squared over its degrees of freedom above which a self-affine law describes a spectrum badly:
 * with three of them, scatter alone exceeds it in a tenth of the cases. */
enum { SELF_AFFINE_BAD = 2 };

/* ---- heights: heights.c ---------------------------------------------------------------------- */

/* Terms: 1; x, y; x^2, x y, y^2, with x and y from -1 to 1 over the points. */
enum { FORM_TERMS = 6 };
/* Subtracts the polynomial of that degree, fitted to the finite heights by least squares. A
 * profile has terms in x only. `coefficients` of the terms above, 0 if absent. Returns
 * WT_E_EMPTY with fewer heights than terms. */
wt_status surface_remove_form(double *z, size_t nx, size_t ny, unsigned degree,
                              double coefficients[FORM_TERMS], wt_error *err) WT_NODISCARD;
/* Fills missing heights by the membrane over their neighbours: the five-point Laplace equation
 * with zero slope across the edges. */
wt_status surface_fill_missing(double *z, size_t nx, size_t ny, wt_error *err) WT_NODISCARD;
/* Computes the parameters of the heights without their form. */
void surface_height_statistics(const wt_height_map *map, wt_surface_heights *to);
/* Returns a wavenumber [rad/m]. Its wavelength is the shortest second difference that stays
 * below half the curvature of the tip. It is 0 if none does. radius [m]. */
double surface_tip_limit(const wt_height_map *map, double radius);

/* ---- artefacts of a scanner: heights.c ------------------------------------------------------- */

/* What was found in a map of at least 16 rows of 16 points. */
typedef struct scan_line_faults {
    size_t scars;   /* parts of single rows that stand out, where the tip lost the surface */
    double offsets; /* standard deviation of the random offsets of the rows [m]; 0: none */
    bool suspected; /* rows differ more than columns do, which offsets or a texture explain */
} scan_line_faults;
/* Finds scars and random offsets of rows; z: the heights of the map, to be changed. With `mend`,
 * scars are replaced by the mean of the adjacent rows, and if there are offsets, each row loses its
 * mean and the map is levelled. */
scan_line_faults surface_scan_lines(double *z, wt_height_map *map, bool mend);

/* ---- spectra: surface_transform.c ------------------------------------------------------------ */

/* Ten bins per decade; bin k contains the modes of 10^((k - 1/2)/10) <= q / reference < 10^((k +
 * 1/2)/10). Modes outside [low, high] are skipped. */
typedef struct surface_bins {
    double reference, low, high; /* [rad/m] */
} surface_bins;
/* Computes C(q) [m^4] of the heights, or C1(q) [m^3] of their rows if `lines`. The caller frees
 * the arrays of `to`. */
wt_status surface_transform(const wt_height_map *map, wt_surface_window window, bool lines,
                            const surface_bins *bins, wt_surface_spectrum *to,
                            wt_error *err) WT_NODISCARD;

/* ---- scatter of a spectrum: spectrum_stitching.c --------------------------------------------- */

/* Mean bias and variance of ln of a mean of exponential variables with `freedom` degrees of
 * freedom, and the degrees of freedom for a given variance. */
double surface_log_bias(double freedom);
double surface_log_variance(double freedom);
double surface_variance_freedom(double variance);
/* Returns ln C of a bin without the mean bias. */
double surface_bin_log_density(const wt_spectrum_bin *bin);
/* Returns the bin of this index if it is reliable, otherwise NULL. */
const wt_spectrum_bin *surface_reliable_bin(const wt_surface_spectrum *s, int index);
/* Standard error of ln C of a bin due to the places of one size, or of all sizes, divided by
 * place_reach. Without stored weights all scans count equally. */
double surface_position_weight(const wt_surface_spectrum *s, size_t bin, size_t size);
double surface_total_position_weight(const wt_surface_spectrum *s, size_t bin);

/* ---- C from C1: surface_profile.c ------------------------------------------------------------ */

/* Returns C(q) = -(1/pi) int_q^inf C1'(k) / sqrt(k^2 - q^2) dk for log-log linear C1 between n
 * >= 2 knots. Above the last knot the last slope continues (`extrapolate`) or C1 is 0. NaN below
 * the first knot, or if a continued slope is not below -1. */
double surface_invert_profile(const double *q, const double *c1, size_t n, bool extrapolate,
                              double at, const gsl_integration_glfixed_table *rule);
/* Creates the quadrature rule for it. Free with gsl_integration_glfixed_table_free(). */
gsl_integration_glfixed_table *surface_inversion_rule(void);

#endif
