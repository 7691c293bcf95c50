/* weartrack - kernel room: Persson contact and hysteresis friction; energy density with depth,
 * formation, wear, balance and thickness of the modified layer. Equations: Persson, J. Chem. Phys.
 * 115 (2001) 3840; Mokhtari, thesis, Univ. Twente 2015, with its misprints corrected.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_KERNEL_H
#define WEARTRACK_KERNEL_H

#include "weartrack/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- contact and friction -------------------------------------------------------------------- */

/* A soft (or stiff) bonded surface layer on the bulk: E_layer = ratio E_bulk at every frequency, or
 * by a power of the frequency, or by a material of its own. Its stiffness at a wavenumber is that
 * of Burmister (1943) for nu = 1/2, whatever the material says; of complex moduli at each
 * frequency. */
typedef struct wt_layer_state {
    double thickness;       /* [m], 0 = none */
    double modulus_ratio;   /* E_layer / E_bulk, > 0 */
    wt_ratio_slope slope;   /* of that ratio; all 0: it is the same at every frequency */
    const wt_material *own; /* the layer's material, borrowed, instead of a ratio; NULL */
    wt_shift_law own_law;   /* by which a flash temperature shifts that; none: that of the bulk */
} wt_layer_state;

/* How the moduli soften with strain (Payne effect; Lorenz, Oh, Nam, Jeon and Persson, J. Chem.
 * Phys. 142 (2015) 194701): E' becomes f E', E'' becomes g E''. f and g are linear in ln strain
 * between n >= 1 points and constant outside; the strain at a wavenumber is strain_factor times the
 * rms slope of the roughness up to there. Of a transversely isotropic rubber it is the modulus that
 * its surface feels. */
typedef struct wt_softening {
    size_t n;
    double *strain;  /* [n] amplitude, 1 = 100 %, > 0 and rising */
    double *storage; /* [n] f, from 1e-3 to 1e3 */
    double *loss;    /* [n] g, likewise */
} wt_softening;

/* WT_E_ARG or WT_E_RANGE naming the point that is wrong. */
WT_API wt_status wt_softening_check(const wt_softening *softening, wt_error *err) WT_NODISCARD;

/* Roughness that is not the same in all directions, such as that of grinding: its power spectrum is
 *   C(q, phi) = C(q) [1 + sum_k amplitude[k] cos(2 (k + 1) (phi - angle[k]))],
 * phi from the velocity and turning with the side force. All 0: the same in all directions. */
enum { WT_ANISOTROPY_ORDERS = 4 };
typedef struct wt_anisotropy {
    double amplitude[WT_ANISOTROPY_ORDERS]; /* of orders 2, 4, 6, 8 */
    double angle[WT_ANISOTROPY_ORDERS];     /* of a maximum of each from the velocity [rad] */
} wt_anisotropy;
/* WT_E_RANGE unless it is finite and nowhere negative. */
WT_API wt_status wt_anisotropy_check(const wt_anisotropy *anisotropy, wt_error *err) WT_NODISCARD;
/* C(q, phi) / C(q) at an angle from the velocity [rad]. */
WT_API double wt_anisotropy_density(const wt_anisotropy *anisotropy, double angle);
/* Contact area in partial contact, where Persson 2001 finds too little of it: Yang and Persson, J.
 * Phys.: Condens. Matter 20 (2008) 215214; Wang and Mueser, Tribol. Lett. 65 (2017) 103; Xu et al.
 * 2024. */
typedef enum wt_area_law { WT_AREA_PERSSON, WT_AREA_YP08, WT_AREA_WM17, WT_AREA_XU24 } wt_area_law;

/* Flash temperature: Persson, J. Phys.: Condens. Matter 18 (2006) 7789. The heat of every length
 * scale warms the rubber there for as long as a macroscopic contact lasts; the moduli shift by it.
 */
typedef struct wt_flash {
    bool on;              /* default false */
    double contact_size;  /* R of a macroscopic contact, which lasts R/v [m]; default 1 mm */
    double heat_capacity; /* rho c [J/(m^3 K)]; default 2.2e6, typical of rubber */
    double diffusivity;   /* D of heat [m^2/s]; default 1e-7, typical of rubber */
    double macroscopic;   /* P_m, share of the area in macroscopic contacts, (0, 1]; default 0.3 */
    bool clipped;         /* P/P_m is 1 at most: heat is not where the contact is larger */
} wt_flash;
WT_API wt_flash wt_flash_defaults(void);

typedef struct wt_friction_options {
    double tolerance; /* relative numerical error asked for; default 1e-10 */
    double gamma; /* S = gamma + (1 - gamma) P^2 in the friction integrand (Scaraggi and Persson,
                     J. Phys.: Condens. Matter 27 (2015) 105102); 1 = Persson 2001 */
    wt_layer_state layer; /* default none */
    unsigned threads;     /* over velocities; 0 = one per processor; default 1 */
    bool without_share;   /* the extrapolated share is not asked for, and NaN; default false */
    struct angular_law *series; /* of the library: that of the material, borrowed; default NULL */
    const wt_softening *softening; /* borrowed while the workspace is made; NULL (default) = none */
    double strain_factor;          /* of the softening, > 0; default 1 */
    wt_anisotropy anisotropy;      /* of the roughness; default none */
    wt_area_law area_law;          /* default that of Persson */
    wt_flash flash;                /* default off */
    wt_shift_law shift;            /* of the material, for a flash temperature */
    double temperature; /* of the surroundings, which is that of the material [K]; likewise */
} wt_friction_options;
WT_API wt_friction_options wt_friction_defaults(void);
WT_API const wt_params *wt_friction_params(void);

/* Another solution at a velocity. */
typedef struct wt_friction_branch {
    double hysteresis, area_ratio, temperature;
} wt_friction_branch;

/* At one velocity. numerical_error is a bound that tells whether the tolerance is met, and no
 * estimate: the true error is some hundreds of times smaller as a rule, and was larger in none of
 * 39,000 checks of drawn scenes (tests/docs/accuracy.md). It is stated whether or not the
 * tolerance was met. */
typedef struct wt_friction_point {
    double velocity;             /* [m/s] */
    wt_estimate stress_variance; /* G(q1) */
    wt_estimate area_ratio;      /* P(q1) = A/A0 */
    wt_estimate one_minus_area;  /* 1 - P without cancellation */
    wt_estimate hysteresis;      /* mu_hys */
    double extrapolated_share; /* share of mu_hys from frequencies outside the material's range: the
                                  angle is cut where q v cos(phi) leaves it; good to 1e-5 */
    size_t nodes;              /* q nodes of the rules that sufficed */
    bool reached;              /* G, P and mu_hys meet the tolerance, relative to each */
    wt_estimate side; /* mu_side of anisotropic roughness: the force on the rubber is -pressure
                         (mu_hys x + mu_side y), x along the velocity, y at +90 deg from it */
    bool unsettled;   /* no temperature was found, and the numbers are NaN */
    wt_estimate temperature; /* of the finest scale, T(q1) [K]; NaN without a flash temperature */
    wt_friction_branch
        hot; /* a second solution: the contact stays hot if it was; NaN: there is none */
} wt_friction_point;

/* Per wavenumber: contact area against magnification q/q0, running friction, dissipated power. */
typedef struct wt_friction_node {
    double wavenumber;                              /* [rad/m] */
    double stress_variance, area_ratio, hysteresis; /* G, P and mu up to here */
    double numerical_error;                         /* of area_ratio */
    double hysteresis_error;                        /* numerical, of hysteresis */
    double temperature; /* T of this scale [K]; NaN without a flash temperature */
} wt_friction_node;

typedef struct wt_friction_workspace wt_friction_workspace;
/* Prepares material and roughness (borrowed, must live longer): set-up once, many velocities. */
WT_API wt_status wt_friction_workspace_new(const wt_material *material,
                                           const wt_roughness *roughness,
                                           const wt_friction_options *options,
                                           wt_friction_workspace **workspace,
                                           wt_error *err) WT_NODISCARD;
WT_API void wt_friction_workspace_free(wt_friction_workspace *workspace);
/* Strain at a wavenumber in [q0, q1]; NaN elsewhere or without a softening. */
WT_API double wt_friction_strain(const wt_friction_workspace *workspace, double wavenumber);
/* Wavenumbers at which the first and the last strain of the table are met, q1 where they are not;
 * NaN without a softening. */
WT_API void wt_friction_strained(const wt_friction_workspace *workspace, double range[2]);
/* mu_hys, P, G at n velocities; pressure [Pa] > 0. A negative velocity gives negative friction; 0
 * is allowed where the law has closed angular integrals (Prony). points: [n], undefined on failure.
 * What comes of a velocity depends neither on those beside it nor on the number of threads.
 * WT_E_RANGE names pressure or velocity. One call at a time per workspace. */
WT_API wt_status wt_friction_compute(wt_friction_workspace *workspace, double pressure,
                                     const double *velocity, size_t n, wt_friction_point *points,
                                     wt_error *err) WT_NODISCARD;
/* G, P and mu at n given rising wavenumbers in [q0, q1]. nodes: [n]. */
WT_API wt_status wt_friction_profile(wt_friction_workspace *workspace, double pressure,
                                     double velocity, const double *wavenumber, size_t n,
                                     wt_friction_node *nodes, wt_error *err) WT_NODISCARD;
/* By how many percent mu_hys changes with one percent of each. That of the pressure is that of the
 * modulus with the other sign where there is no flash temperature. */
typedef struct wt_friction_sensitivity {
    double modulus, density, pressure; /* density: at the strains of a softening as they are */
    double cutoff; /* q1; the temperatures, if there are any, stay as they are */
} wt_friction_sensitivity;
WT_API wt_status wt_friction_sensitivities(wt_friction_workspace *workspace, double pressure,
                                           double velocity, wt_friction_sensitivity *sensitivity,
                                           wt_error *err) WT_NODISCARD;
/* |E_layer / E_bulk| of the layer of a workspace at an angular frequency > 0, without flash
 * temperature. */
WT_API double wt_friction_layer_ratio(const wt_friction_workspace *workspace, double omega);
/* mu = mu_hys + tau_f (A/A0) / pressure with errors carried through; shear_stress is an estimate
 * [Pa]. */
WT_API wt_estimate wt_friction_total(wt_estimate hysteresis, wt_estimate area_ratio,
                                     wt_estimate shear_stress, double pressure);

/* ---- modified layer ------------------------------------------------------------------------ */

/* Depth profile of the energy density, theory W2: w(z) = sum_i power[i] g(z; q[i]). */
typedef enum wt_depth_profile {
    WT_PROFILE_PERSSON,       /* 2 q exp(-2 q z): J. Phys.: Condens. Matter 18 (2006) 7789 */
    WT_PROFILE_INCOMPRESSIBLE /* Mohr radius squared in a half-space with nu = 1/2 under a cosine of
                                 pressure and of shear, local friction m */
} wt_depth_profile;

/* A source of energy: power per nominal area at a set of wavenumbers (one for a single
 * exponential). */
typedef struct wt_energy_source {
    wt_depth_profile profile;
    double local_friction; /* m of the incompressible profile */
    size_t n;
    double *wavenumber;     /* [n] rad/m */
    double *power;          /* [n] W/m^2 */
    double numerical_error; /* relative, of wt_energy_tail at any depth; 0 = exact */
} wt_energy_source;
WT_API void wt_energy_source_clear(wt_energy_source *source);
/* From the hysteresis integrand at one velocity: J_i = j(q_i) dq_i, sum = mu_hys sigma0 v. */
WT_API wt_status wt_energy_source_friction(wt_friction_workspace *workspace, double pressure,
                                           double velocity, wt_energy_source *source,
                                           wt_error *err) WT_NODISCARD;
WT_API double wt_energy_density(const wt_energy_source *source, double depth); /* w [W/m^3] */
WT_API double wt_energy_tail(const wt_energy_source *source,
                             double depth); /* int_z^inf w [W/m^2] */

/* What turns energy into damage. Both are rebuilt from what Mokhtari 2015 and Persson say of them.
 */
typedef enum wt_layer_closure {
    WT_CLOSURE_ENERGY,   /* Omega = w / critical_energy */
    WT_CLOSURE_ACTIVATED /* Omega = A exp(-max(0, barrier - V_a e) / kB T) in contact */
} wt_layer_closure;
/* A of the activated closure: kB T over the reduced or the plain constant of Planck. */
typedef enum wt_attempt_frequency { WT_ATTEMPT_HBAR, WT_ATTEMPT_H } wt_attempt_frequency;

/* Bonds that stress helps over a barrier. e is the energy of a wave in contact for the time that it
 * takes to pass, 1/(q v): sum_i power[i] g(z; q[i]) / (q[i] v area_ratio). */
typedef struct wt_activation {
    double barrier;               /* of a bond without load [J], > 0 */
    double volume;                /* V_a [m^3], > 0 */
    wt_attempt_frequency attempt; /* default hbar */
    double temperature;           /* [K], > 0 */
    double area_ratio;            /* A/A0, (0, 1]; default 1 */
    bool ageing; /* the unloaded rate counts as damage, too; default false; of a layer only with
                    `incubation`, and then at every depth: it has no balance */
} wt_activation;
/* Unloaded rate A exp(-barrier / kB T) [1/s]; NaN for values that are none. */
WT_API double wt_activation_background(const wt_activation *parameters);
/* The smallest barrier at a temperature whose unloaded rate is not above `rate` [J]. */
WT_API double wt_activation_least_barrier(double temperature, wt_attempt_frequency attempt,
                                          double rate);
/* The highest temperature at which a barrier has that rate [K]. */
WT_API double wt_activation_most_temperature(double barrier, wt_attempt_frequency attempt,
                                             double rate);

/* The rubber at a depth is modified where int Omega dt >= damage. */
typedef struct wt_layer_parameters {
    double critical_energy;    /* U_c [J/m^3], > 0; of the energy closure */
    double damage;             /* Lambda, > 0; default 1 */
    double specific_wear_rate; /* k [m^2/N], >= 0 */
    double pressure;           /* [Pa] */
    double velocity;           /* [m/s] */
    double start_thickness;    /* [m] */
    double duty;               /* share of the time in contact, (0, 1]; default 1 */
    bool incubation;     /* damage transport (exact, with incubation) instead of the rate balance */
    bool without_errors; /* no numerical error that costs more than its number: NaN */
    bool balance_only;   /* of a balance no incubation time: NaN */
    double severity_power;    /* k (1 + (power / this)^exponent), [W/m^2]; 0 = constant k */
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

typedef struct wt_layer_balance {
    double surface_power;               /* J0 [W/m^2] */
    double formation_rate_zero;         /* Qf(0) [m/s] */
    double wear_rate;                   /* Qw [m/s] */
    double ratio;                       /* R = Qf(0)/Qw, infinity without wear or with ageing */
    double critical_specific_wear_rate; /* k* [m^2/N], of the k before the severity */
    double ratio_error; /* relative numerical error of both, and of a calibrated critical energy */
    wt_estimate thickness;       /* delta_total [m]; infinity likewise */
    double eigenvalue;           /* of the balance [1/s]; 0 if there is none or no wear */
    wt_estimate relaxation_time; /* 1/(kappa Qw), kappa = w / int w there; infinity without wear */
    wt_estimate incubation_time; /* until any depth is modified, with wear if `incubation`, else as
                                    if there were none; NaN if never */
    wt_estimate removal_time; /* of the start thickness where there is no layer; NaN where there is
                                 one, infinity if never (R = 1) */
    wt_layer_regime regime;
} wt_layer_balance;

WT_API wt_status wt_layer_balance_compute(const wt_energy_source *source,
                                          const wt_layer_parameters *parameters,
                                          wt_layer_balance *balance, wt_error *err) WT_NODISCARD;

typedef struct wt_layer_point {
    double time;           /* [s] */
    wt_estimate thickness; /* [m], >= 0 */
    double formation_rate; /* Qf(delta) [m/s] */
    double wear_rate;      /* [m/s] */
} wt_layer_point;
/* Thickness at n times (any order, >= 0) at constant load; points: [n]. With the rate balance a
 * load that changes in steps is a chain of calls, each from where the last one ended; with damage
 * transport it is wt_layer_sections. With `incubation` the thickness is
 * that of the deepest modified place (a profile that peaks below the surface begins as a buried
 * band), and a start thickness is old layer that is worn off from the top. */
WT_API wt_status wt_layer_history(const wt_energy_source *source,
                                  const wt_layer_parameters *parameters, const double *time,
                                  size_t n, wt_layer_point *points, wt_error *err) WT_NODISCARD;
/* When a growing layer gets to a thickness; NaN if it never does, or is not thinner before. The
 * numerical error of the thickness is carried on. */
WT_API wt_status wt_layer_time(const wt_energy_source *source,
                               const wt_layer_parameters *parameters, wt_estimate thickness,
                               wt_estimate *time, wt_error *err) WT_NODISCARD;
/* One load of a history. */
typedef struct wt_layer_stage {
    const wt_energy_source *source; /* borrowed */
    wt_layer_parameters parameters; /* `incubation` does not matter; the start thickness is that of
                                       the first stage */
    double duration;                /* [s], >= 0 */
} wt_layer_stage;

/* Modified rubber between two depths below the surface. */
typedef struct wt_layer_band {
    wt_estimate upper, lower; /* [m] */
} wt_layer_band;

/* The modified rubber at a time. */
enum { WT_LAYER_BANDS = 8 };
typedef struct wt_layer_section {
    double time, worn; /* [s], depth worn off until then [m] */
    size_t n;          /* bands; more than WT_LAYER_BANDS: only the deepest are there */
    wt_layer_band band[WT_LAYER_BANDS]; /* the deepest first */
} wt_layer_section;
/* Exact damage transport through any loads that follow one another: the state is the damage at
 * every depth, so that a load that is cut in two changes nothing. Times from the beginning of the
 * first stage on, in any order; the last stage goes on for ever. sections: [n]. */
WT_API wt_status wt_layer_sections(const wt_layer_stage *stages, size_t n_stages,
                                   const double *time, size_t n, wt_layer_section *sections,
                                   wt_error *err) WT_NODISCARD;
/* Damage over that which modifies the rubber, at a depth below the surface at a time. */
WT_API wt_status wt_layer_damage(const wt_layer_stage *stages, size_t n_stages, double time,
                                 double depth, double *damage, wt_error *err) WT_NODISCARD;

/* How the bands come about and go. */
typedef enum wt_layer_event_kind {
    WT_LAYER_BAND_ONSET,      /* below the surface */
    WT_LAYER_SURFACE_ONSET,   /* at the surface */
    WT_LAYER_SURFACE_REACHED, /* by a band from below */
    WT_LAYER_BANDS_MERGE,
    WT_LAYER_WORN_OFF /* a band, down to its lower edge */
} wt_layer_event_kind;
typedef struct wt_layer_event {
    wt_layer_event_kind kind;
    double time, depth; /* [s], [m] */
} wt_layer_event;
/* The events at constant load, in order, and how many they are; events: [most], of which the first
 * are given. Two that come within 1 % of the time, of which one undoes the other, are not seen. */
WT_API wt_status wt_layer_events(const wt_energy_source *source,
                                 const wt_layer_parameters *parameters, wt_layer_event *events,
                                 size_t most, size_t *n, wt_error *err) WT_NODISCARD;
/* The same of loads in turn, of which the last one lasts for ever, on rubber that is bare at first:
 * events within 4 % of the time since a load began may undo each other unseen. And the first of
 * them alone, whose time is NaN if nothing is ever modified. */
WT_API wt_status wt_layer_stage_events(const wt_layer_stage *stages, size_t n_stages,
                                       wt_layer_event *events, size_t most, size_t *n,
                                       wt_error *err) WT_NODISCARD;
WT_API wt_status wt_layer_first_event(const wt_layer_stage *stages, size_t n_stages,
                                      wt_layer_event *event, wt_error *err) WT_NODISCARD;

/* Shear stress of the real contact on a layer: that of the bulk times (E_layer / E_bulk)^exponent,
 * reached at once or over a thickness, and what it takes to open the cracks at the rims of the
 * contacts. Rebuilt from what Mokhtari 2015 lists. */
typedef struct wt_layer_shear {
    double exponent; /* default 1 */
    double reach;    /* thickness at which 1 - 1/e of the change is there [m]; 0 (default): any */
    double crack_energy; /* G to open a crack [J/m^2], also without a layer; default 0: none */
    double spacing;      /* of the asperities in contact, 1/sqrt(eta) [m]; NaN unless G = 0 */
} wt_layer_shear;
WT_API wt_layer_shear wt_layer_shear_defaults(void);
/* bulk: of the bulk's real contact without cracks [Pa]; area_ratio: A/A0 with this layer. */
WT_API double wt_layer_shear_stress(const wt_layer_shear *shear, double bulk, wt_layer_state layer,
                                    double area_ratio);

/* A layer that acts back on the energy that makes it: what modifies the rubber under a layer of a
 * thickness. The source is then the caller's, to be cleared. */
typedef wt_status (*wt_layer_energy_fn)(double thickness, void *user, wt_energy_source *source,
                                        wt_layer_parameters *parameters, wt_error *err);

/* A thickness at which formation under it equals wear. 0: the bare surface, where formation does
 * not exceed wear; unstable: a threshold thinner than any layer, which then grows. */
typedef struct wt_layer_root {
    double thickness;  /* [m] */
    bool stable;       /* a layer near it comes back to it */
    double map_slope;  /* of the balance thickness with the energy under a layer against the
                          thickness of that; below 1 it is stable; NaN of the bare surface */
    double eigenvalue; /* [1/s]; likewise */
} wt_layer_root;

/* Where two roots meet as the wear rate changes. */
typedef struct wt_layer_fold {
    double thickness, specific_wear_rate; /* [m], [m^2/N] */
    bool maximum;                         /* the pair is gone above that wear rate, else below it */
} wt_layer_fold;

enum { WT_LAYER_ROOTS = 8 };
typedef struct wt_layer_loop {
    size_t n_roots, n_folds;
    wt_layer_root root[WT_LAYER_ROOTS]; /* the thinnest first */
    wt_layer_fold fold[WT_LAYER_ROOTS];
    double low, high; /* between which it was looked for [m] */
    double ratio;     /* R of the bare surface */
} wt_layer_loop;
/* All roots between two thicknesses, of a grid of `grid` values of constant ratio: two that are
 * closer than a step of it are not seen. */
WT_API wt_status wt_layer_loop_find(wt_layer_energy_fn energy, void *user, double low, double high,
                                    size_t grid, wt_layer_loop *loop, wt_error *err) WT_NODISCARD;
/* By the rate balance, from a bare surface to the lowest stable root; as wt_layer_history. */
WT_API wt_status wt_layer_loop_history(wt_layer_energy_fn energy, void *user,
                                       const wt_layer_loop *loop, const double *time, size_t n,
                                       wt_layer_point *points, wt_error *err) WT_NODISCARD;

/* Single exponential in closed form (theory T3): thickness after t from delta0; NaN for a negative
 * or infinite argument. */
WT_API double wt_layer_exponential(double start_thickness, double kappa, double formation_rate_zero,
                                   double wear_rate, double time);
/* U_c that makes `thickness` the balance of this source, of any profile: Qf(d) = Qw (theory B3).
 * The critical energy of the parameters does not matter, nor the duty, which cancels. */
WT_API double wt_layer_calibrate(const wt_energy_source *source,
                                 const wt_layer_parameters *parameters, double thickness);

/* ---- identification of a layer --------------------------------------------------------------- */

typedef struct wt_layer_identified {
    double critical_energy;    /* U_c [J/m^3] */
    double specific_wear_rate; /* k [m^2/N] */
    double ratio;              /* R = Qf(0)/Qw */
} wt_layer_identified;
/* U_c of a layer of this thickness at balance under a wear rate. Of the parameters pressure,
 * velocity and damage matter. WT_E_RANGE if there can be none. */
WT_API wt_status wt_layer_identify_wear(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters, double thickness,
                                        double specific_wear_rate, wt_layer_identified *found,
                                        wt_error *err) WT_NODISCARD;
/* U_c and k of a layer of this thickness at balance that took `time` from bare rubber to a share of
 * it: by the rate balance, or with `incubation` by damage transport to its deepest edge. The duty
 * matters, too. */
WT_API wt_status wt_layer_identify_time(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters, double thickness,
                                        double time, double share, wt_layer_identified *found,
                                        wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
