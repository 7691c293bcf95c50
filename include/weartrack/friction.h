/* weartrack - friction: contact area and hysteresis friction of rubber on a rough surface, with a
 * surface layer, softening with strain and flash temperature. Equations: Persson, J.
 * Chem. Phys. 115 (2001) 3840; Mokhtari, thesis, Univ. Twente 2015, with its misprints corrected.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FRICTION_H
#define WEARTRACK_FRICTION_H

#include "weartrack/dma.h"
#include "weartrack/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- a layer on the rubber ------------------------------------------------------------------ */

/* Frequency dependence of the ratio of two moduli: |ratio| ~ omega^exponent from `low` to `high`,
 * constant outside. */
typedef struct wt_ratio_slope {
    double exponent;    /* 0: constant ratio */
    double reference;   /* angular frequency of the stated ratio [rad/s] */
    double low, high;   /* [rad/s] */
    double temperature; /* temperature of these frequencies [K]; NaN: that of the material */
} wt_ratio_slope;

/* A soft or stiff surface layer bonded to the bulk. Its modulus is a constant ratio of the bulk
 * modulus, or a ratio that is a power of the frequency. Its stiffness at a wavenumber follows
 * Burmister (1943) for nu = 1/2, independent of the material's Poisson ratio, with the complex
 * moduli at each frequency. */
typedef struct wt_layer_state {
    double thickness;     /* [m], 0 = none */
    double modulus_ratio; /* E_layer / E_bulk, > 0 */
    wt_ratio_slope slope; /* frequency dependence of that ratio; all 0: constant */
} wt_layer_state;

/* ---- contact and friction ------------------------------------------------------------------- */

/* Flash temperature: Persson, J. Phys.: Condens. Matter 18 (2006) 7789. The heat of each length
 * scale warms the rubber for the lifetime of a macroscopic contact and shifts the moduli. */
typedef struct wt_flash {
    bool on;              /* default false */
    double contact_size;  /* size R of a macroscopic contact with lifetime R/v [m]; default 1 mm */
    double heat_capacity; /* rho c [J/(m^3 K)]; default 2.2e6, typical of rubber */
    double diffusivity;   /* D of heat [m^2/s]; default 1e-7, typical of rubber */
    double macroscopic;   /* P_m, area fraction of macroscopic contacts, (0, 1]; default 0.3 */
} wt_flash;
WT_API wt_flash wt_flash_defaults(void);

typedef struct wt_friction_options {
    double tolerance; /* requested relative numerical error; default 1e-10 */
    double gamma; /* S = gamma + (1 - gamma) P^2 in the friction integrand (Scaraggi and Persson, J.
                     Phys.: Condens. Matter 27 (2015) 105102); default 1 (Persson 2001) */
    wt_layer_state layer;         /* default none */
    unsigned threads;             /* for the velocities; 0 = one per processor; default 1 */
    bool skip_extrapolated_share; /* extrapolated_share is not computed (NaN); default false */
    struct angular_law *series; /* internal: angular law of the material, borrowed; default NULL */
    const wt_softening
        *softening;       /* borrowed while the workspace is created; NULL (default) = none */
    double strain_factor; /* strain over rms slope, > 0; default 1 */
    wt_flash flash;       /* default off */
    wt_shift_law shift;   /* shift law of the material for a flash temperature */
    double temperature;   /* ambient and material temperature for a flash temperature [K] */
} wt_friction_options;
WT_API wt_friction_options wt_friction_defaults(void);
WT_API const wt_params *wt_friction_params(void);

/* Friction at one velocity. numerical_error is an upper bound for the test against the tolerance,
 * not an estimate. The true error is typically some hundred times smaller and never exceeded it in
 * 39,000 random checks (tests/docs/accuracy.md). It is stated whether or not the tolerance is met.
 */
typedef struct wt_friction_point {
    double velocity;             /* [m/s] */
    wt_estimate stress_variance; /* G(q1) */
    wt_estimate area_ratio;      /* P(q1) = A/A0 */
    wt_estimate one_minus_area;  /* 1 - P without cancellation */
    wt_estimate hysteresis;      /* mu_hys */
    double extrapolated_share; /* share of mu_hys from frequencies outside the material's range, of
                                 a loss modulus that is constant over a turn of q v cos(phi) */
    size_t nodes;              /* wavenumber nodes of the final quadrature */
    bool meets_tolerance;      /* G, P and mu_hys each meet the relative tolerance */
    bool has_no_solution;      /* true if no flash temperature was found; the numbers are NaN */
    wt_estimate temperature;   /* temperature of the finest scale, T(q1) [K]; NaN without a flash
                                  temperature */
} wt_friction_point;

/* Values at one wavenumber: contact area at magnification q/q0, friction up to q, temperature. */
typedef struct wt_friction_node {
    double wavenumber;                              /* [rad/m] */
    double stress_variance, area_ratio, hysteresis; /* G, P and mu of wavenumbers up to this one */
    double numerical_error;                         /* numerical error of area_ratio */
    double hysteresis_error;                        /* numerical error of hysteresis */
    double temperature; /* temperature of this scale [K]; NaN without a flash temperature */
} wt_friction_node;

typedef struct wt_friction_workspace wt_friction_workspace;
/* Prepares material and roughness for many velocities. Both are borrowed and must outlive the
 * workspace. */
WT_API wt_status wt_friction_workspace_new(const wt_material *material,
                                           const wt_roughness *roughness,
                                           const wt_friction_options *options,
                                           wt_friction_workspace **workspace,
                                           wt_error *err) WT_NODISCARD;
WT_API void wt_friction_workspace_free(wt_friction_workspace *workspace);
/* Returns the strain at a wavenumber in [q0, q1]; NaN elsewhere or without strain softening. */
WT_API double wt_friction_strain(const wt_friction_workspace *workspace, double wavenumber);
/* Returns the wavenumbers [rad/m] at which the first and the last strain of the table are reached,
 * q1 if not reached, NaN without strain softening. */
WT_API void wt_friction_strain_range(const wt_friction_workspace *workspace, double range[2]);
/* Computes mu_hys, P and G at n velocities for a pressure [Pa] > 0. A negative velocity gives
 * negative friction. 0 is allowed if the law has closed angular integrals (Prony). points: [n],
 * undefined on failure. The result at a velocity depends neither on the other velocities nor on the
 * number of threads. WT_E_RANGE names pressure or velocity. One call at a time per workspace. */
WT_API wt_status wt_friction_compute(wt_friction_workspace *workspace, double pressure,
                                     const double *velocity, size_t n, wt_friction_point *points,
                                     wt_error *err) WT_NODISCARD;
/* Computes G, P and mu at n given increasing wavenumbers in [q0, q1]. nodes: [n]. */
WT_API wt_status wt_friction_profile(wt_friction_workspace *workspace, double pressure,
                                     double velocity, const double *wavenumber, size_t n,
                                     wt_friction_node *nodes, wt_error *err) WT_NODISCARD;
/* Returns |E_layer / E_bulk| of the layer of a workspace at an angular frequency > 0 [rad/s],
 * without flash temperature. */
WT_API double wt_friction_layer_ratio(const wt_friction_workspace *workspace, double omega);
/* Returns mu = mu_hys + tau_f (A/A0) / pressure with propagated errors; shear_stress tau_f [Pa]. */
WT_API wt_estimate wt_friction_total(wt_estimate hysteresis, wt_estimate area_ratio,
                                     wt_estimate shear_stress, double pressure);

/* ---- counter surface ------------------------------------------------------------------------ */

/* A counter surface with its stated or measured error. */
typedef struct wt_surface {
    bool self_affine;
    double q0, qr, q1, hurst; /* self-affine law; q0 and q1 truncate a spectrum (NaN = its ends) */
    wt_estimate c0;           /* [m^4]; for a spectrum: value 1, relative error of the densities */
    wt_power_spectrum spectrum; /* if not self-affine; 2-D */
    double *modes_error; /* [spectrum.n] standard errors of ln C by its modes; NULL: unknown */
    double *modes_correlation; /* [spectrum.n] correlation of the errors of adjacent points; NULL:
                                  none */
    double *law_error; /* [spectrum.n] fully correlated error of the law outside of the measured
                          range; NULL */
    /* [n_sizes * spectrum.n] For scans of several sizes: contributions to c0.standard_error of ln C
     * of the points by the positions of the widest scans, then of the next. Each size is drawn
     * independently. NULL: all points share the whole error. */
    size_t n_sizes;
    double *position_errors;
    double measured_limit; /* end of the measured range [rad/m]; the law continues it; 0: unknown */
    double steep_wavenumber;   /* wavenumber where the rms slope reaches 1.3 [rad/m]; 0: unknown or
                                  nowhere */
    bool has_position_scatter; /* true if the scatter between positions was measured, even if the
                                  error of c0 is 0 */
} wt_surface;
WT_API void wt_surface_clear(wt_surface *surface);
/* Opens a surface: "self-affine:q0=1e3rad/m,qr=5e3rad/m,q1=1e7rad/m,hurst=0.8,c0=1e-17m^4+-10%",
 * the path of a spectrum or height map, or a folder or pattern of several maps, which are
 * transformed as by wt_topography_compute. read NULL = defaults. */
WT_API wt_status wt_surface_open(const char *text, const wt_read_options *read, const wt_job *work,
                                 wt_surface *surface, wt_error *err) WT_NODISCARD;
/* Creates the roughness with all densities multiplied by `factor` > 0. It borrows nothing. */
WT_API wt_status wt_surface_roughness(const wt_surface *surface, double factor,
                                      wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_surface_table(const wt_surface *surface, wt_table **table,
                                  wt_error *err) WT_NODISCARD; /* Creates the table "roughness". */

/* ---- sliding contact ------------------------------------------------------------------------ */

/* Sliding contact: rubber on a counter surface under given conditions. */
typedef struct wt_sliding {
    const wt_rubber *rubber;   /* borrowed */
    const wt_surface *surface; /* borrowed */
    wt_estimate pressure;      /* [Pa] */
    wt_estimate temperature;   /* [K]; value NaN = reference temperature of the rubber */
    wt_estimate shear_stress;  /* of the real contact [Pa]; value NaN: unknown, no total friction */
    double gamma;              /* as in wt_friction_options; default 1 */
    const double *velocity;    /* [n_velocity] m/s, borrowed */
    size_t n_velocity;
    double reference_velocity; /* velocity of the answer and the layer [m/s]; NaN = middle of the
                                  list */
    const wt_strain_softening *strain_softening; /* borrowed; NULL = none */
    double strain_factor;                        /* as in wt_friction_options; default 1 */
    bool decades;   /* requests friction by decades of the wavenumber */
    wt_flash flash; /* as in wt_friction_options; `temperature` is then the ambient temperature */
} wt_sliding;
WT_API wt_sliding wt_sliding_defaults(void);
WT_API const wt_params *wt_sliding_params(void);

/* The modified layer on the surface of the track. */
typedef struct wt_layer_observation {
    wt_estimate thickness;     /* [m] */
    wt_estimate modulus_ratio; /* E_track / E_bulk */
    double modulus_ratio_df;   /* degrees of freedom of its error (Student's t); 0 = normal */
    wt_estimate ratio_slope;   /* d ln modulus_ratio / d ln omega; default 0: constant ratio */
    double ratio_frequency;    /* angular frequency of modulus_ratio [rad/s]; NaN: not stated */
    double ratio_lowest,
        ratio_highest; /* measured range; the ratio is constant outside [rad/s]; NaN: not stated */
    double ratio_temperature; /* temperature of these frequencies [K]; NaN: that of the sliding */
    bool by_rate;    /* in a case: the ratio depends on the rate as compared; default false */
    bool bulk_shear; /* tau_s = tau_bulk, without the modulus ratio; default false */
    double calibration_share; /* share of calibration (spring constants etc.), not spot scatter, in
                                 the variance of the ratio; default 0 */
} wt_layer_observation;
WT_API wt_layer_observation
wt_layer_observation_defaults(void); /* Returns an observation without a layer. */
WT_API const wt_params *wt_layer_observation_params(void);
/* Reads ratio, slope and frequencies from tables of `weartrack compare`: the ratio of all rates at
 * their mean frequency, and its slope over the frequencies of the rates. WT_E_MISSING with one
 * rate. */
WT_API wt_status wt_layer_observation_from_rates(const wt_table *comparison,
                                                 const wt_table *modulus_rate,
                                                 wt_layer_observation *observation,
                                                 wt_error *err) WT_NODISCARD;

typedef struct wt_friction_tables {
    wt_table *friction;
    double extrapolated_share; /* largest of all velocities */
} wt_friction_tables;

/* Computes hysteresis friction, contact area and total friction at every velocity. Standard errors
 * come from replicates: spectrum, shifts and law are drawn jointly from the posterior of the
 * isotherms, and pressure, temperature, shear stress and C0 from their stated errors. The key
 * `standard_error_includes` lists the sources. With a layer (NULL = none): for a bonded layer and
 * tau_s = tau_bulk x modulus ratio. */
WT_API wt_status wt_sliding_friction_compute(const wt_sliding *sliding,
                                             const wt_layer_observation *layer, const wt_job *work,
                                             wt_friction_tables *tables,
                                             wt_error *err) WT_NODISCARD;

/* Creates the table "contact_area": contact area and friction against magnification at the slowest,
 * the reference and the fastest velocity. */
WT_API wt_status wt_contact_area_compute(const wt_sliding *sliding, const wt_job *work,
                                         wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "softening": hysteresis friction and contact area with and without the strain
 * softening of `sliding`, and the shares from strains outside of its range. WT_E_ARG without strain
 * softening. */
WT_API wt_status wt_softened_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "flash_temperature": hysteresis friction, contact area and temperature at every
 * velocity with and without flash temperature, and for a second solution if there is one. WT_E_ARG
 * if it is not requested. */
WT_API wt_status wt_flash_temperature_compute(const wt_sliding *sliding, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "directions": hysteresis friction and contact area of a transversely isotropic
 * rubber at every velocity, with its factors on E' and E'' and with those on one of them or none.
 * WT_E_ARG if it has no directions. */
WT_API wt_status wt_transverse_isotropy_compute(const wt_sliding *sliding, const wt_job *work,
                                                wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "friction_decades": contributions of each decade of the wavenumber to
 * hysteresis friction and to shearing of bare rubber, at the slowest, the reference and the fastest
 * velocity. */
WT_API wt_status wt_friction_by_scale_compute(const wt_sliding *sliding, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
