/* weartrack - kernel: Persson contact and hysteresis friction; energy density with depth,
 * formation, wear and thickness of the modified layer. Equations: Persson, J. Chem. Phys. 115
 * (2001) 3840; Mokhtari, thesis, Univ. Twente 2015, with its misprints corrected.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_KERNEL_H
#define WEARTRACK_KERNEL_H

#include "weartrack/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- contact and friction -------------------------------------------------------------------- */

/* A soft or stiff surface layer bonded to the bulk. Its modulus is a constant ratio of the bulk
 * modulus, a ratio that is a power of the frequency, or that of its own material. Its stiffness at
 * a wavenumber follows Burmister (1943) for nu = 1/2, independent of the material's Poisson ratio,
 * with the complex moduli at each frequency. */
typedef struct wt_layer_state {
    double thickness;       /* [m], 0 = none */
    double modulus_ratio;   /* E_layer / E_bulk, > 0 */
    wt_ratio_slope slope;   /* frequency dependence of that ratio; all 0: constant */
    const wt_material *own; /* material of the layer, borrowed, replaces the ratio; NULL = none */
    wt_shift_law material_law; /* shift law of that material for a flash temperature; WT_LAW_NONE:
                             that of the bulk */
} wt_layer_state;

/* Strain softening of the moduli (Payne effect; Lorenz, Oh, Nam, Jeon and Persson, J. Chem. Phys.
 * 142 (2015) 194701). E' becomes f E' and E'' becomes g E''. f and g are linear in ln strain
 * between n >= 1 points and constant outside. The strain at a wavenumber is strain_factor times the
 * rms slope of the roughness up to it. In a transversely isotropic rubber the factors apply to the
 * effective surface modulus. */
typedef struct wt_softening {
    size_t n;
    double *strain;  /* [n] amplitude, 1 = 100 %, > 0 and rising */
    double *storage; /* [n] f, from 1e-3 to 1e3 */
    double *loss;    /* [n] g, from 1e-3 to 1e3 */
} wt_softening;

/* Checks a softening table. WT_E_ARG or WT_E_RANGE names the invalid point. */
WT_API wt_status wt_softening_check(const wt_softening *softening, wt_error *err) WT_NODISCARD;

/* Anisotropic roughness, such as that of a ground surface. Its power spectrum is
 *   C(q, phi) = C(q) [1 + sum_k amplitude[k] cos(2 (k + 1) (phi - angle[k]))],
 * with phi from the velocity, positive in the sense of the lateral force. All 0: isotropic. */
enum { WT_ANISOTROPY_ORDERS = 4 };
typedef struct wt_anisotropy {
    double amplitude[WT_ANISOTROPY_ORDERS]; /* of orders 2, 4, 6, 8 */
    double angle[WT_ANISOTROPY_ORDERS]; /* direction of a maximum of each order, from the velocity
                                           [rad] */
} wt_anisotropy;
/* WT_E_RANGE unless the spectrum is finite and nowhere negative. */
WT_API wt_status wt_anisotropy_check(const wt_anisotropy *anisotropy, wt_error *err) WT_NODISCARD;
/* Returns C(q, phi) / C(q) at an angle from the velocity [rad]. */
WT_API double wt_anisotropy_density(const wt_anisotropy *anisotropy, double angle);
/* Law of the contact area in partial contact. Persson 2001 underestimates the area there;
 * corrections: Yang and Persson, J. Phys.: Condens. Matter 20 (2008) 215214; Wang and Mueser,
 * Tribol. Lett. 65 (2017) 103; Xu et al. 2024. */
typedef enum wt_area_law { WT_AREA_PERSSON, WT_AREA_YP08, WT_AREA_WM17, WT_AREA_XU24 } wt_area_law;

/* Flash temperature: Persson, J. Phys.: Condens. Matter 18 (2006) 7789. The heat of each length
 * scale warms the rubber for the lifetime of a macroscopic contact and shifts the moduli. */
typedef struct wt_flash {
    bool on;              /* default false */
    double contact_size;  /* size R of a macroscopic contact with lifetime R/v [m]; default 1 mm */
    double heat_capacity; /* rho c [J/(m^3 K)]; default 2.2e6, typical of rubber */
    double diffusivity;   /* D of heat [m^2/s]; default 1e-7, typical of rubber */
    double macroscopic;   /* P_m, area fraction of macroscopic contacts, (0, 1]; default 0.3 */
    bool clipped;         /* limits P/P_m to 1 */
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
        *softening;           /* borrowed while the workspace is created; NULL (default) = none */
    double strain_factor;     /* strain over rms slope, > 0; default 1 */
    wt_anisotropy anisotropy; /* of the roughness; default none */
    wt_area_law area_law;     /* default WT_AREA_PERSSON */
    wt_flash flash;           /* default off */
    wt_shift_law shift;       /* shift law of the material for a flash temperature */
    double temperature;       /* ambient and material temperature for a flash temperature [K] */
} wt_friction_options;
WT_API wt_friction_options wt_friction_defaults(void);
WT_API const wt_params *wt_friction_params(void);

/* A second solution at a velocity. */
typedef struct wt_friction_branch {
    double hysteresis, area_ratio, temperature;
} wt_friction_branch;

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
    double
        extrapolated_share; /* share of mu_hys from frequencies outside the material's range, where
                               the angle integral is truncated at q v cos(phi); accurate to 1e-5 */
    size_t nodes;           /* wavenumber nodes of the final quadrature */
    bool reached;           /* G, P and mu_hys each meet the relative tolerance */
    wt_estimate
        side; /* lateral coefficient mu_side for anisotropic roughness; the shear stress on the
                 rubber is -pressure (mu_hys x + mu_side y), x along the velocity, y at +90 deg */
    bool unsettled;          /* no flash temperature was found; the numbers are NaN */
    wt_estimate temperature; /* temperature of the finest scale, T(q1) [K]; NaN without a flash
                                temperature */
    wt_friction_branch
        hot; /* second solution, in which a hot contact stays hot; NaN if there is none */
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
/* Logarithmic derivatives of mu_hys. Without a flash temperature, that of the pressure is the
 * negative of that of the modulus. */
typedef struct wt_friction_sensitivity {
    double modulus, density, pressure; /* density: at unchanged strains of the softening */
    double cutoff;                     /* of q1, at unchanged temperatures */
} wt_friction_sensitivity;
WT_API wt_status wt_friction_sensitivities(wt_friction_workspace *workspace, double pressure,
                                           double velocity, wt_friction_sensitivity *sensitivity,
                                           wt_error *err) WT_NODISCARD;
/* Returns |E_layer / E_bulk| of the layer of a workspace at an angular frequency > 0 [rad/s],
 * without flash temperature. */
WT_API double wt_friction_layer_ratio(const wt_friction_workspace *workspace, double omega);
/* Returns mu = mu_hys + tau_f (A/A0) / pressure with propagated errors; shear_stress tau_f [Pa]. */
WT_API wt_estimate wt_friction_total(wt_estimate hysteresis, wt_estimate area_ratio,
                                     wt_estimate shear_stress, double pressure);

/* ---- modified layer ------------------------------------------------------------------------ */

/* Depth profile of the energy density, theory W2: w(z) = sum_i power[i] g(z; q[i]). */
typedef enum wt_depth_profile {
    WT_PROFILE_PERSSON,       /* 2 q exp(-2 q z): J. Phys.: Condens. Matter 18 (2006) 7789 */
    WT_PROFILE_INCOMPRESSIBLE /* Mohr radius squared in a half-space with nu = 1/2 under a cosine of
                                 pressure and of shear, local friction m */
} wt_depth_profile;

/* An energy source: power per nominal area at n wavenumbers (one for a single exponential). */
typedef struct wt_energy_source {
    wt_depth_profile profile;
    double local_friction; /* coefficient m of the incompressible profile */
    size_t n;
    double *wavenumber;     /* [n] rad/m */
    double *power;          /* [n] W/m^2 */
    double numerical_error; /* relative error of wt_energy_tail at any depth; 0 = exact */
} wt_energy_source;
WT_API void wt_energy_source_clear(wt_energy_source *source);
/* Computes the source from the hysteresis integrand at one velocity: J_i = j(q_i) dq_i, sum =
 * mu_hys sigma0 v. Clear it with wt_energy_source_clear. */
WT_API wt_status wt_energy_source_from_friction(wt_friction_workspace *workspace, double pressure,
                                                double velocity, wt_energy_source *source,
                                                wt_error *err) WT_NODISCARD;
WT_API double wt_energy_density(const wt_energy_source *source, double depth); /* w [W/m^3] */
WT_API double wt_energy_tail(const wt_energy_source *source,
                             double depth); /* int_z^inf w [W/m^2] */

/* Damage law. Both are reconstructed from the descriptions of Mokhtari 2015 and Persson. */
typedef enum wt_layer_closure {
    WT_CLOSURE_ENERGY,   /* Omega = w / critical_energy */
    WT_CLOSURE_ACTIVATED /* Omega = A exp(-max(0, barrier - V_a e) / kB T) in contact */
} wt_layer_closure;
/* Attempt frequency A of the activated closure: kB T over the reduced or the plain Planck constant.
 */
typedef enum wt_attempt_frequency { WT_ATTEMPT_HBAR, WT_ATTEMPT_H } wt_attempt_frequency;

/* Stress-activated bond rupture. e is the energy of a wave in contact during its passage 1/(q v):
 * sum_i power[i] g(z; q[i]) / (q[i] v area_ratio). */
typedef struct wt_activation {
    double barrier;               /* barrier of an unloaded bond [J], > 0 */
    double volume;                /* V_a [m^3], > 0 */
    wt_attempt_frequency attempt; /* default hbar */
    double temperature;           /* [K], > 0 */
    double area_ratio;            /* A/A0, (0, 1]; default 1 */
    bool ageing; /* the unloaded rate also counts as damage; default false. A layer needs
                    `incubation` with it, and then all depths age: there is no steady state */
} wt_activation;
/* Returns the unloaded rate A exp(-barrier / kB T) [1/s]; NaN for invalid parameters. */
WT_API double wt_activation_unloaded_rate(const wt_activation *parameters);
/* Returns the smallest barrier [J] whose unloaded rate at a temperature does not exceed `rate`
 * [1/s]. */
WT_API double wt_activation_min_barrier(double temperature, wt_attempt_frequency attempt,
                                        double rate);
/* Returns the highest temperature [K] at which the unloaded rate of a barrier does not exceed
 * `rate` [1/s]. */
WT_API double wt_activation_max_temperature(double barrier, wt_attempt_frequency attempt,
                                            double rate);

/* Parameters of the layer. The rubber at a depth is modified where int Omega dt >= damage. */
typedef struct wt_layer_parameters {
    double critical_energy;    /* U_c of the energy closure [J/m^3], > 0 */
    double damage;             /* Lambda, > 0; default 1 */
    double specific_wear_rate; /* k [m^2/N], >= 0 */
    double pressure;           /* [Pa] */
    double velocity;           /* [m/s] */
    double start_thickness;    /* [m] */
    double duty;               /* share of the time in contact, (0, 1]; default 1 */
    bool incubation; /* damage transport (exact, with incubation) instead of the rate balance */
    bool skip_numerical_errors; /* skips numerical errors that cost more than the number itself
                                   (NaN) */
    bool balance_only;          /* skips the incubation time of a steady state (NaN) */
    double severity_power; /* severity: k (1 + (power / severity_power)^severity_exponent) [W/m^2];
                              0 = constant k */
    double severity_exponent; /* > 0; default 1 */
    wt_layer_closure closure; /* default energy */
    wt_activation activation;
} wt_layer_parameters;
WT_API wt_layer_parameters wt_layer_defaults(void);
WT_API const wt_params *wt_layer_params(void);

typedef enum wt_layer_regime {
    WT_LAYER_NONE, /* formation never exceeds wear */
    WT_LAYER_THIN, /* 1 < R < e: sensitive to the wear rate */
    WT_LAYER_THICK /* R >= e */
} wt_layer_regime;

typedef struct wt_layer_steady_state {
    double surface_power;               /* J0 [W/m^2] */
    double formation_rate_zero;         /* Qf(0) [m/s] */
    double wear_rate;                   /* Qw [m/s] */
    double ratio;                       /* R = Qf(0)/Qw, infinite without wear or with ageing */
    double critical_specific_wear_rate; /* critical k*, before the severity factor [m^2/N] */
    double ratio_error;    /* relative numerical error of ratio and k*, and of a calibrated critical
                              energy */
    wt_estimate thickness; /* steady-state thickness delta_total [m]; infinite without wear or with
                              ageing */
    double eigenvalue;     /* of the linearised balance [1/s]; 0 without a steady state or wear */
    wt_estimate
        relaxation_time; /* 1/(kappa Qw), kappa = w / int w at that depth; infinite without wear */
    wt_estimate incubation_time; /* time until any depth is modified, with wear if `incubation`,
                                    else without; NaN if never */
    wt_estimate removal_time;    /* time to remove the start thickness if there is no steady state,
                                    infinite if never (R = 1); NaN if there is one */
    wt_layer_regime regime;
} wt_layer_steady_state;

WT_API wt_status wt_layer_steady_state_compute(const wt_energy_source *source,
                                               const wt_layer_parameters *parameters,
                                               wt_layer_steady_state *balance,
                                               wt_error *err) WT_NODISCARD;

typedef struct wt_layer_point {
    double time;           /* [s] */
    wt_estimate thickness; /* [m], >= 0 */
    double formation_rate; /* Qf(delta) [m/s] */
    double wear_rate;      /* [m/s] */
} wt_layer_point;
/* Computes the thickness at n times (any order, >= 0) at constant load; points: [n].
 * With the rate balance, call it once for each load, starting from the last thickness; with damage
 * transport use wt_layer_sections. With `incubation` the thickness is that of the deepest modified
 * point, as a profile that peaks below the surface begins as a buried band. A start thickness is
 * then old layer that wears off from the top. */
WT_API wt_status wt_layer_history(const wt_energy_source *source,
                                  const wt_layer_parameters *parameters, const double *time,
                                  size_t n, wt_layer_point *points, wt_error *err) WT_NODISCARD;
/* Computes the time at which a growing layer reaches a thickness; NaN if never, or if it is not
 * thinner before. The numerical error of the thickness is propagated. */
WT_API wt_status wt_layer_growth_time(const wt_energy_source *source,
                                      const wt_layer_parameters *parameters, wt_estimate thickness,
                                      wt_estimate *time, wt_error *err) WT_NODISCARD;
/* One load of a load history. */
typedef struct wt_layer_load {
    const wt_energy_source *source; /* borrowed */
    wt_layer_parameters
        parameters;  /* `incubation` is ignored; start_thickness is that of the first load */
    double duration; /* [s], >= 0 */
} wt_layer_load;

/* Modified rubber between two depths below the surface. */
typedef struct wt_layer_band {
    wt_estimate upper, lower; /* [m] */
} wt_layer_band;

/* Maximum number of modified bands in a wt_layer_section. */
enum { WT_LAYER_MAX_BANDS = 8 };
typedef struct wt_layer_section {
    double time, worn; /* time [s]; depth worn off so far [m] */
    size_t n; /* number of bands; if more than WT_LAYER_MAX_BANDS, only the deepest are stored */
    wt_layer_band band[WT_LAYER_MAX_BANDS]; /* deepest first */
} wt_layer_section;
/* Computes exact damage transport under successive loads. The state is the damage at every depth,
 * so that splitting a load changes nothing. Times [s] count from the start of the first load, in
 * any order; the last load continues for ever. sections: [n]. */
WT_API wt_status wt_layer_sections(const wt_layer_load *stages, size_t n_stages, const double *time,
                                   size_t n, wt_layer_section *sections,
                                   wt_error *err) WT_NODISCARD;
/* Computes the damage relative to the modification threshold at a depth below the surface at a
 * time. */
WT_API wt_status wt_layer_damage(const wt_layer_load *stages, size_t n_stages, double time,
                                 double depth, double *damage, wt_error *err) WT_NODISCARD;

/* Events in the life of modified bands. */
typedef enum wt_layer_event_kind {
    WT_LAYER_BAND_ONSET,      /* a band forms below the surface */
    WT_LAYER_SURFACE_ONSET,   /* a band forms at the surface */
    WT_LAYER_SURFACE_REACHED, /* a buried band reaches the surface */
    WT_LAYER_BANDS_MERGE,
    WT_LAYER_WORN_OFF /* a band is worn off down to its lower edge */
} wt_layer_event_kind;
typedef struct wt_layer_event {
    wt_layer_event_kind kind;
    double time, depth; /* [s], [m] */
} wt_layer_event;
/* Computes the events at constant load in order. events: [most] receives the first ones; *n is
 * their total number. Two events within 1 % of the time that cancel each other are not detected. */
WT_API wt_status wt_layer_events(const wt_energy_source *source,
                                 const wt_layer_parameters *parameters, wt_layer_event *events,
                                 size_t most, size_t *n, wt_error *err) WT_NODISCARD;
/* Variant for successive loads on initially unmodified rubber; the last load continues for ever.
 * Events within 4 % of the time since a load began may cancel undetected. wt_layer_first_event
 * returns only the first; its time is NaN if nothing is ever modified. */
WT_API wt_status wt_layer_load_events(const wt_layer_load *stages, size_t n_stages,
                                      wt_layer_event *events, size_t most, size_t *n,
                                      wt_error *err) WT_NODISCARD;
WT_API wt_status wt_layer_first_event(const wt_layer_load *stages, size_t n_stages,
                                      wt_layer_event *event, wt_error *err) WT_NODISCARD;

/* Shear stress of the real contact on a layer: that of the bulk times (E_layer / E_bulk)^exponent,
 * constant or approached with the thickness, plus the stress to open cracks at the rims of the
 * contacts. Reconstructed from the list in Mokhtari 2015. */
typedef struct wt_layer_shear {
    double exponent;     /* default 1 */
    double reach;        /* thickness for 1 - 1/e of the change [m]; 0 (default): full change at any
                            thickness */
    double crack_energy; /* crack opening energy G [J/m^2], also without a layer; default 0 */
    double spacing;      /* distance of asperities in contact, 1/sqrt(eta) [m]; NaN unless G = 0 */
} wt_layer_shear;
WT_API wt_layer_shear wt_layer_shear_defaults(void);
/* Returns the shear stress [Pa]. bulk: stress of the bulk's real contact without cracks [Pa];
 * area_ratio: A/A0 with this layer. */
WT_API double wt_layer_shear_stress(const wt_layer_shear *shear, double bulk, wt_layer_state layer,
                                    double area_ratio);

/* Callback for a layer with feedback on its energy: computes the energy source and the parameters
 * under a layer of a thickness [m]. The caller clears the source. */
typedef wt_status (*wt_layer_energy_fn)(double thickness, void *user, wt_energy_source *source,
                                        wt_layer_parameters *parameters, wt_error *err);

/* A thickness at which formation under the layer equals wear. 0: bare surface where formation does
 * not exceed wear. An unstable root is the threshold thickness for growth. */
typedef struct wt_layer_root {
    double thickness;  /* [m] */
    bool stable;       /* the thickness returns to it after a small perturbation */
    double map_slope;  /* slope of the steady-state thickness (for the energy under a layer) against
                          the thickness of that layer; stable below 1; NaN for the bare surface */
    double eigenvalue; /* [1/s]; NaN for the bare surface */
} wt_layer_root;

/* Fold: two roots merge as the wear rate changes. */
typedef struct wt_layer_fold {
    double thickness, specific_wear_rate; /* [m], [m^2/N] */
    bool maximum; /* the pair vanishes above that wear rate, else below it */
} wt_layer_fold;

enum { WT_LAYER_MAX_ROOTS = 8 };
typedef struct wt_layer_feedback {
    size_t n_roots, n_folds;
    wt_layer_root root[WT_LAYER_MAX_ROOTS]; /* thinnest first */
    wt_layer_fold fold[WT_LAYER_MAX_ROOTS];
    double low, high; /* search interval [m] */
    double ratio;     /* R of the bare surface */
} wt_layer_feedback;
/* Finds the roots between two thicknesses [m] on a grid of `grid` values of constant ratio. Two
 * roots closer than one step are not detected. */
WT_API wt_status wt_layer_feedback_solve(wt_layer_energy_fn energy, void *user, double low,
                                         double high, size_t grid, wt_layer_feedback *loop,
                                         wt_error *err) WT_NODISCARD;
/* Computes the thickness by the rate balance from the bare surface to the lowest stable root, as
 * wt_layer_history. */
WT_API wt_status wt_layer_feedback_history(wt_layer_energy_fn energy, void *user,
                                           const wt_layer_feedback *loop, const double *time,
                                           size_t n, wt_layer_point *points,
                                           wt_error *err) WT_NODISCARD;

/* Returns the thickness [m] after a time from start_thickness for a single exponential, in closed
 * form (theory T3). NaN for a negative or infinite argument. */
WT_API double wt_layer_exponential_thickness(double start_thickness, double kappa,
                                             double formation_rate_zero, double wear_rate,
                                             double time);
/* Returns the critical energy U_c [J/m^3] for which `thickness` is the steady state of this source,
 * with any profile: Qf(d) = Qw (theory B3). The critical energy and the duty of the parameters have
 * no effect. */
WT_API double wt_layer_calibrate(const wt_energy_source *source,
                                 const wt_layer_parameters *parameters, double thickness);

/* ---- identification of a layer --------------------------------------------------------------- */

typedef struct wt_identified_constants {
    double critical_energy;    /* U_c [J/m^3] */
    double specific_wear_rate; /* k [m^2/N] */
    double ratio;              /* R = Qf(0)/Qw */
} wt_identified_constants;
/* Computes U_c of a layer of this steady-state thickness for a known wear rate. Pressure, velocity
 * and damage of the parameters are used. WT_E_RANGE if there is no such U_c. */
WT_API wt_status wt_layer_identify_wear(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters, double thickness,
                                        double specific_wear_rate, wt_identified_constants *found,
                                        wt_error *err) WT_NODISCARD;
/* Computes U_c and k of a layer of this steady-state thickness that took `time` from unmodified
 * rubber to `share` of it. The rate balance is used, or with `incubation` damage transport to the
 * deepest edge. The duty is used, too. */
WT_API wt_status wt_layer_identify_time(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters, double thickness,
                                        double time, double share, wt_identified_constants *found,
                                        wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
