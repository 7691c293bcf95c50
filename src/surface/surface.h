/* Internal interface of the surface job: scans, combined spectrum and tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_SURFACE_H
#define WT_SURFACE_SURFACE_H

#include "job/inputs.h"
#include "surface/numerics/surface_analysis.h"

/* Heights without their form, thinned for a figure: a map (absent for a profile) and one line. */
typedef struct surface_view {
    size_t nx, ny, n_line;
    double dx, dy, line_step; /* [m] */
    double *z, *line;         /* [ny * nx], [n_line] */
} surface_view;

/* One height map or profile. The heights are freed after its spectrum is computed. */
typedef struct surface_scan {
    const char *name; /* name of the file; borrowed */
    char image[64];
    wt_height_map map; /* z is NULL */
    wt_surface_heights heights;
    double missing_share;
    wt_surface_spectrum spectrum;
    wt_surface_anisotropy directions;
    surface_view view; /* set if heights are requested */
} surface_scan;

/* Knots of the reported spectrum: measured ones, then those of the law. */
typedef struct surface_knots {
    size_t n, n_measured; /* the last measured knot may be interpolated (`cut`) */
    bool cut;
    double *wavenumber, *density; /* [n] */
} surface_knots;
void surface_knots_clear(surface_knots *knots);

/* The combined spectrum of all scans with its results. */
typedef struct surface_result {
    wt_surface_spectrum spectrum;
    size_t n_maps, n_profiles;
    wt_surface_spectrum
        maps; /* spectrum of the height maps if there are both kinds; otherwise without bins */
    double profiles_from, profiles_to; /* range of the profiles in that case [rad/m] */
    wt_interval profiles_ratio;        /* ratio of C from profiles to C from maps; NaN: unknown */
    wt_self_affine law;
    wt_surface_anisotropy directions, fourth; /* orders 2 and 4 */
    surface_knots knots;
    double steep; /* wavenumber at which the rms slope reaches surface_steep_slope [rad/m]; NaN:
                     none */
    bool steep_by_law;
    wt_estimate rms_height, rms_slope; /* roughness of the knots */
    double extrapolated_share;         /* extrapolated share of the squared slope */
} surface_result;
/* Combines the spectra of the scans. */
wt_status surface_join_scans(const surface_scan *scans, size_t n, surface_result *to,
                             wt_error *err) WT_NODISCARD;
/* Returns the spectrum that contains directions: that of the height maps, if there are any. */
const wt_surface_spectrum *surface_directional_spectrum(const surface_result *whole);
/* Describes the contribution of profiles to height maps, or "" without either. */
void surface_describe_profiles(const surface_result *w, char *to, size_t size);
bool surface_profiles_disagree(const surface_result *w);
/* Sets the knots up to the end that the job requests, and the roughness parameters. */
wt_status surface_find_cutoff(const wt_topography_job *job, const wt_job *work,
                              surface_result *whole, wt_error *err) WT_NODISCARD;
/* Returns the correlation of the scatter of a bin with that of the next. A window correlates
 * modes of neighbouring bins. */
double surface_next_bin_correlation(const wt_surface_spectrum *s, size_t bin);
/* Returns the standard error of ln C of the law, without the place error that the whole spectrum
 * shares. */
double surface_law_error(const surface_result *w, double wavenumber);
/* Standard error of ln C of a knot due to the places of one scan size. The law has the error of
 * the last bin. NaN if unknown or with one size. */
double surface_knot_size_error(const wt_surface_spectrum *s, size_t knot, size_t size);
/* The same due to the places of all sizes. */
double surface_knot_position_error(const wt_surface_spectrum *s, size_t knot);

#endif
