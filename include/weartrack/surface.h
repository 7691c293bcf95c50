/* weartrack - surface: height maps and profiles to a power spectrum; roughness as a law.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_SURFACE_H
#define WEARTRACK_SURFACE_H

#include "weartrack/job.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- roughness as a law --------------------------------------------------------------------- */

/* Isotropic 2-D power spectrum C(q) [m^4] on [q0, q1], 0 elsewhere. */
typedef struct wt_roughness wt_roughness;

typedef struct wt_roughness_law {
    const char *name; /* "self_affine", "table" */
    void (*density)(const wt_roughness *roughness, const double *q, size_t n, double *c);
    const double *(*breaks)(const wt_roughness *roughness, size_t *n); /* inside (q0, q1) */
    /* Returns int_q0^q k^m C dk for m = 1 or 3 in closed form; NULL: integrated numerically. */
    double (*moment)(const wt_roughness *roughness, int m, double q);
    void (*free)(wt_roughness *roughness);
    bool powers; /* C is a power of q between the breaks */
} wt_roughness_law;

struct wt_roughness {
    const wt_roughness_law *law;
    double q0, q1; /* [rad/m] */
    void *data;
};

/* Creates a self-affine law: C = c0 for q0 <= q <= qr, c0 (q/qr)^(-2(1+H)) for qr < q <= q1; -1 < H
 * <= 3. */
WT_API wt_status wt_roughness_self_affine(double q0, double qr, double q1, double hurst, double c0,
                                          wt_roughness **roughness, wt_error *err) WT_NODISCARD;
/* Creates a table law, log-log linear between n >= 2 increasing knots; q0, q1 = first and last
 * knot. */
WT_API wt_status wt_roughness_table(const double *q, const double *c, size_t n,
                                    wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API void wt_roughness_free(wt_roughness *roughness);
WT_API double wt_roughness_rms_height(const wt_roughness *roughness); /* [m] */
WT_API double wt_roughness_rms_slope(const wt_roughness *roughness);  /* 1 */
/* Returns int_q0^q k^m C dk for m = 1 or 3 and q from q0 to q1 [rad/m]. */
WT_API double wt_roughness_moment(const wt_roughness *roughness, int m, double q);

/* Returns the wavenumber [rad/m] at which the rms slope, from q0 on, reaches `slope`; NaN if it
 * does not. */
WT_API double wt_roughness_slope_wavenumber(const wt_roughness *roughness, double slope);

/* ---- heights, power spectra, their self-affine law ------------------------------------------ */

typedef enum wt_surface_window {
    WT_WINDOW_HANN,
    WT_WINDOW_WELCH,
    WT_WINDOW_NONE
} wt_surface_window;

typedef enum wt_surface_form { WT_FORM_MEAN, WT_FORM_PLANE, WT_FORM_QUADRATIC } wt_surface_form;

typedef struct wt_surface_options {
    wt_surface_form form; /* polynomial that is subtracted by least squares */
    wt_surface_window window;
    double tip_radius; /* [m]; NaN: unknown */
} wt_surface_options;
WT_API wt_surface_options wt_surface_options_defaults(void);

/* Height parameters after form removal: ISO 25178-2 (for a profile ISO 21920-2, where they are
 * called R) over the existing points. Slopes are forward differences of neighbours; Sdr uses the
 * two at a point. Other stencils give other slopes. */
typedef struct wt_surface_heights {
    size_t n, missing;
    double rms, mean_deviation, peak_to_valley; /* Sq, Sa, Sz [m] */
    double skewness, kurtosis;                  /* Ssk, Sku */
    double rms_slope, slope_x, slope_y;         /* Sdq and its components; for a profile along x */
    double area_excess;                         /* Sdr; NaN for a profile */
} wt_surface_heights;

enum { WT_SURFACE_SECTORS = 18 }; /* number of sectors in a half turn */
/* Bin of modes with wavenumbers between 10^((index - 1/2)/10) and 10^((index + 1/2)/10) rad/m. */
typedef struct wt_spectrum_bin {
    int index;
    double wavenumber, mean_wavenumber; /* geometric and arithmetic mean [rad/m] */
    double width;                       /* standard deviation of ln q of its modes */
    double density;                     /* mean density C [m^4] or C1 [m^3], two-sided */
    double deviation;                   /* standard deviation of a mode of a scan */
    size_t n;                           /* number of modes of the full plane or of both signs */
    size_t scans;                       /* number of scans of these modes */
    double freedom; /* degrees of freedom (chi-squared) of the mean; fewer than n, as a window
                       correlates neighbours */
    double shared_freedom; /* its part of the degrees of freedom of all bins, as modes of two bins
                              are correlated, too */
    double cosine, sine;   /* C(phi) = C (1 + cosine cos 2 phi + sine sin 2 phi + */
    double cosine_fourth, sine_fourth; /* the same for 4 phi), phi from x */
    /* Number of modes within half a sector of k pi / WT_SURFACE_SECTORS, and the sum of C of each
     * over the mean of all; none for profiles. */
    double sector_modes[WT_SURFACE_SECTORS], sector_sum[WT_SURFACE_SECTORS];
    double sector_tie; /* number of modes of a sector per independent mode */
    bool reliable;
} wt_spectrum_bin;

/* Power spectrum of a surface, with h_rms^2 = 2 pi int q C dq = 2 int_0^inf C1 dq; q = 2 pi /
 * wavelength. */
typedef struct wt_surface_spectrum {
    wt_spectrum_kind kind;
    size_t n;
    wt_spectrum_bin *bins;
    double from, to;     /* reliable range [rad/m] */
    const char *ends_by; /* "points" or "tip"; static */
    /* For several scans: place_scatter is the standard deviation of ln C between positions, equal
     * at all wavenumbers. place_reach is the value whose 1.96-fold is the half width of an
     * interval; it includes the uncertainty of few positions and the scatter of the modes.
     * place_error is the resulting standard error of the mean: by the scans of each bin, its square
     * averaged over the bins. NaN: unknown. */
    double place_scatter, place_reach, place_error;
    /* Scans of one size contribute equally to all bins and deviate in all bins together,
     * independent of other sizes. n_sizes: number of sizes, 0: not stored. place_part: [n_sizes]
     * per bin, the widest first: standard error of ln C due to one size, over place_reach. */
    size_t n_sizes;
    double *place_part;
} wt_surface_spectrum;
WT_API void wt_surface_spectrum_clear(wt_surface_spectrum *spectrum);

/* Computes height parameters and spectrum: form removal, missing heights filled as a membrane,
 * window, discrete Fourier transform, means over bins. Conventions: Jacobs, Junge, Pastewka, Surf.
 * Topogr. 5 (2017) 013001, but C = C2D / (2 pi)^2 and C1 = C1D / (2 pi). A map of one row gives C1.
 * The range ends at four points per wave, or where the curvature of peaks reaches half that of the
 * tip (Sanner et al., Appl. Surf. Sci. Adv. 7 (2022) 100190). WT_E_RANGE: too many heights are
 * missing; WT_E_EMPTY: too few points, or all heights are equal. */
WT_API wt_status wt_surface_analyse(const wt_height_map *map, const wt_surface_options *options,
                                    wt_surface_heights *heights, wt_surface_spectrum *spectrum,
                                    wt_error *err) WT_NODISCARD;
/* Combines spectra of one kind: means of ln C over the reliable bins, weighted by their modes and
 * corrected for the bias of a mean of logarithms. WT_E_EMPTY: no bin is reliable. */
WT_API wt_status wt_surface_combine(const wt_surface_spectrum *const *spectra, size_t n,
                                    wt_surface_spectrum *joined, wt_error *err) WT_NODISCARD;
/* Converts C1 of an isotropic surface to C; the slope at the end is extrapolated. Bins that the
 * scatter makes negative, or that are uncertain by more than a factor of two, are excluded.
 * WT_E_RANGE: the end is too flat, or there are too few profiles. */
WT_API wt_status wt_surface_invert(const wt_surface_spectrum *profile, wt_surface_spectrum *surface,
                                   wt_error *err) WT_NODISCARD;
/* Converts C1 [m^3] at wavenumbers [rad/m] to C [m^4], [n], without errors. WT_E_RANGE as above,
 * and where C would not be positive. */
WT_API wt_status wt_surface_from_profile(const double *wavenumber, const double *c1, size_t n,
                                         double *c, wt_error *err) WT_NODISCARD;
/* Returns the density of a bin with its error, including the known scatter between positions. The
 * standard error, and those of c0 and roll_off below, is that of the logarithm times the value. */
WT_API wt_interval wt_surface_density(const wt_surface_spectrum *spectrum, size_t bin);

/* Anisotropy of a spectrum: C(phi) = C (1 + amplitude cos order (phi - direction)), mean over the
 * modes of all reliable bins. Standard errors from the scatter of the modes. */
typedef struct wt_surface_anisotropy {
    double amplitude, direction; /* direction of a maximum, [rad] from x, -pi/order to pi/order */
    double amplitude_error, direction_error;
    double p_value; /* p value of the amplitude for scatter alone */
} wt_surface_anisotropy;
/* order: 2 or 4. NaN for profiles. */
WT_API wt_surface_anisotropy wt_surface_anisotropy_fit(const wt_surface_spectrum *spectrum,
                                                       unsigned order);
/* Returns C within half a sector of sector pi / WT_SURFACE_SECTORS from x over that of all
 * directions: mean over the modes of all reliable bins. *modes is their number. NaN without any. */
WT_API wt_interval wt_surface_sector(const wt_surface_spectrum *spectrum, size_t sector,
                                     double *modes);

/* Self-affine law: C = c0 up to roll_off, c0 (q / roll_off)^(-2 (1 + hurst)) above it. */
typedef struct wt_self_affine {
    bool found;
    bool rolls_off; /* false: roll_off is the first wavenumber, without an error */
    wt_interval c0, roll_off, hurst;
    double covariance[3][3];       /* of ln c0, ln roll_off, hurst, including the next */
    double place_covariance[3][3]; /* contribution of the scatter between positions */
    double misfit; /* chi-squared over its degrees of freedom; above 1 it widens the errors */
    size_t n;      /* number of bins */
} wt_self_affine;
/* Fits the law by weighted least squares in ln C over the reliable bins. */
WT_API wt_self_affine wt_self_affine_fit(const wt_surface_spectrum *spectrum);
/* Returns C [m^4] of the law at a wavenumber, NaN if it was not found. The second function returns
 * the standard error of its logarithm (half width of the 95 % interval over 1.96), with or without
 * the contribution of positions. */
WT_API double wt_self_affine_density(const wt_self_affine *law, double wavenumber);
WT_API double wt_self_affine_log_error(const wt_self_affine *law, double wavenumber, bool places);

/* ---- measured surfaces ---------------------------------------------------------------------- */

typedef struct wt_topography_job {
    const wt_file_set *sets; /* height maps and profiles of one surface */
    size_t n_sets;
    wt_surface_options options;
    const char *image; /* part of the name of the image; NULL = first height image */
    double end;        /* last wavenumber [rad/m]; NaN = that of the reliable range */
    double end_slope;  /* ends the spectrum at this rms slope instead; NaN = none */
    enum wt_scan_lines {
        WT_SCAN_LINES_MEND, /* offsets of rows and scars are found and removed */
        WT_SCAN_LINES_KEEP  /* they are found and named */
    } scan_lines;
    bool heights; /* also computes the tables height_map and height_profile */
} wt_topography_job;
WT_API wt_topography_job wt_topography_job_defaults(void);
WT_API const wt_params *wt_topography_job_params(void);
typedef struct wt_topography_tables {
    wt_table *power_spectrum, *surfaces;
    wt_table *place_errors;     /* NULL for scans of one size */
    wt_table *angular_spectrum; /* NULL for profiles */
    wt_table *height_map,
        *height_profile; /* NULL unless requested; height_map NULL also for profiles */
} wt_topography_tables;
/* Computes the power spectrum of a surface. Scans of several sizes are stitched, several positions
 * averaged, profiles inverted. If end or end_slope requires it, the self-affine law extends the
 * reliable range. WT_E_EMPTY if no file has heights or no wavenumber is reliable, WT_E_RANGE if the
 * requested end cannot be reached. */
WT_API wt_status wt_topography_compute(const wt_topography_job *job, const wt_job *work,
                                       wt_topography_tables *tables, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
