/* What the parts of the job of measured surfaces share. Internal to surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_SURFACE_H
#define WT_SURFACE_SURFACE_H

#include "job/inputs.h"
#include "surface/numerics/surface_analysis.h"

/* Heights less their form, thinned: a map (none of a profile), and a line of it. */
typedef struct surface_view {
    size_t nx, ny, n_line;
    double dx, dy, line_step; /* [m] */
    double *z, *line;         /* [ny * nx], [n_line] */
} surface_view;
void surface_view_clear(surface_view *view);
/* So that the maps of n_scans together are one picture. */
wt_status surface_view_make(const wt_height_map *map, wt_surface_form form, size_t n_scans,
                            surface_view *to, wt_error *err) WT_NODISCARD;

/* One height map or profile; heights are let go once its spectrum is known. */
typedef struct surface_scan {
    const char *name; /* of the file; borrowed */
    char image[64];
    wt_height_map map; /* z NULL */
    wt_surface_heights heights;
    double missing_share;
    wt_surface_spectrum spectrum;
    wt_surface_anisotropy directions;
    surface_view view; /* if heights are asked for */
} surface_scan;
wt_status surface_view_maps(const surface_scan *scans, size_t n, wt_table **table,
                            wt_error *err) WT_NODISCARD;
wt_status surface_view_profiles(const surface_scan *scans, size_t n, wt_table **table,
                                wt_error *err) WT_NODISCARD;

/* The knots of the spectrum that is told: those that were measured, and beyond them the law. */
typedef struct surface_knots {
    size_t n, n_measured; /* the last of these may be `cut` */
    bool cut;
    double *wavenumber, *density; /* [n] */
} surface_knots;
void surface_knots_clear(surface_knots *knots);

/* What the spectrum is as a whole. */
typedef struct surface_whole {
    wt_surface_spectrum spectrum;
    size_t n_maps, n_profiles;
    wt_surface_spectrum maps; /* of both, that of the height maps alone; else without bins */
    double profiles_from, profiles_to; /* then, what the profiles tell [rad/m] */
    wt_interval profiles_ratio;        /* C by them over that by the maps; NaN */
    wt_self_affine law;
    wt_surface_anisotropy directions, fourth; /* of orders 2 and 4 */
    surface_knots knots;
    double steep; /* where the rms slope reaches that of practice; NaN */
    bool steep_by_law;
    wt_estimate rms_height, rms_slope; /* of the knots */
    double extrapolated_share;         /* of the squared slope */
} surface_whole;
/* The spectra of the scans to one. */
wt_status surface_join_scans(const surface_scan *scans, size_t n, surface_whole *to,
                             wt_error *err) WT_NODISCARD;
/* What tells directions: the height maps, if there are any. */
const wt_surface_spectrum *surface_of_maps(const surface_whole *whole);
/* What profiles add to height maps; "" without either. */
void surface_print_profiles(const surface_whole *w, char *to, size_t size);
bool surface_profiles_disagree(const surface_whole *w);
/* Of the reliable bins, to the end that the job asks for. */
wt_status surface_end_find(const wt_topography_job *job, const wt_job *work, surface_whole *whole,
                           wt_error *err) WT_NODISCARD;
/* Correlation of the scatter of a bin with that of the next: a window ties modes to those of other
 * bins. */
double surface_tie_to_next(const wt_surface_spectrum *s, size_t bin);
/* Standard error of ln C of the law beyond what all of the spectrum has by its places. */
double surface_law_error(const surface_whole *w, double wavenumber);
/* Of scans of several sizes, what the places of one give a knot, and what those of all do,
 * likewise; the law beyond has that of the last bin. NaN: not known, or there is one size. */
double surface_knot_size(const wt_surface_spectrum *s, size_t knot, size_t size);
double surface_knot_places(const wt_surface_spectrum *s, size_t knot);
/* Is it more than scatter? */
bool surface_anisotropic(const wt_surface_anisotropy *directions);
/* rms slope at which rubber stops following a surface, by practice. */
extern const double surface_steep;

/* params: of the job, for the words of its choices. */
wt_status surface_tables_make(const wt_params *params, const wt_topography_job *job,
                              const surface_scan *scans, size_t n, const surface_whole *whole,
                              wt_topography_tables *tables, wt_error *err) WT_NODISCARD;

#endif
