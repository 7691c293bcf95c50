/* weartrack - layer: the modified layer: energy density with depth, formation, wear, balance and
 * thickness; identification of its constants. Equations: Mokhtari, thesis, Univ. Twente 2015, with
 * its misprints corrected.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_LAYER_H
#define WEARTRACK_LAYER_H

#include "weartrack/friction.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- energy density with depth -------------------------------------------------------------- */

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

/* ---- balance and growth --------------------------------------------------------------------- */

/* Parameters of the layer. The rubber at a depth is modified where int Omega dt >= damage. */
typedef struct wt_layer_parameters {
    double critical_energy;    /* U_c [J/m^3], > 0 */
    double damage;             /* Lambda, > 0; default 1 */
    double specific_wear_rate; /* k [m^2/N], >= 0 */
    double pressure;           /* [Pa] */
    double velocity;           /* [m/s] */
    double start_thickness;    /* [m] */
    double duty;               /* share of the time in contact, (0, 1]; default 1 */
    bool incubation; /* damage transport (exact, with incubation) instead of the rate balance */
    bool skip_numerical_errors; /* skips numerical errors that cost more than the number itself, and
                                   the formation rate of a history (NaN); a thickness in time is
                                   then good to 1e-7 */
    bool balance_only;          /* skips the incubation time of a steady state (NaN) */
} wt_layer_parameters;
WT_API wt_layer_parameters wt_layer_defaults(void);
WT_API const wt_params *wt_layer_params(void);

typedef enum wt_layer_regime {
    WT_LAYER_NONE, /* formation never exceeds wear */
    WT_LAYER_THIN, /* 1 < R < e: sensitive to the wear rate */
    WT_LAYER_THICK /* R >= e */
} wt_layer_regime;
#define WT_LAYER_REGIME_LIST(X)                                                                    \
    X(WT_LAYER_NONE, "none") X(WT_LAYER_THIN, "thin") X(WT_LAYER_THICK, "thick")

typedef struct wt_layer_steady_state {
    double surface_power;               /* J0 [W/m^2] */
    double formation_rate_zero;         /* Qf(0) [m/s] */
    double wear_rate;                   /* Qw [m/s] */
    double ratio;                       /* R = Qf(0)/Qw, infinite without wear */
    double critical_specific_wear_rate; /* critical k* [m^2/N] */
    double ratio_error;    /* relative numerical error of ratio and k*, and of a calibrated critical
                              energy */
    wt_estimate thickness; /* steady-state thickness delta_total [m]; infinite without wear */
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
 * With `incubation` the thickness is that of the deepest modified point, as a profile that peaks
 * below the surface begins as a buried band. A start thickness is then old layer that wears off
 * from the top. */
WT_API wt_status wt_layer_history(const wt_energy_source *source,
                                  const wt_layer_parameters *parameters, const double *time,
                                  size_t n, wt_layer_point *points, wt_error *err) WT_NODISCARD;
/* Computes the time at which a growing layer reaches a thickness; NaN if never, or if it is not
 * thinner before. The numerical error of the thickness is propagated. */
WT_API wt_status wt_layer_growth_time(const wt_energy_source *source,
                                      const wt_layer_parameters *parameters, wt_estimate thickness,
                                      wt_estimate *time, wt_error *err) WT_NODISCARD;

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

/* ---- identification of a layer -------------------------------------------------------------- */

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

/* ---- layer of a sliding contact ------------------------------------------------------------- */

/* Energy that modifies the rubber: hysteresis below the surface, shearing of the real contact, or
 * both. The depth profile of shearing is assumed to be that of hysteresis. */
typedef enum wt_layer_energy { WT_LAYER_HYSTERESIS, WT_LAYER_SHEAR, WT_LAYER_BOTH } wt_layer_energy;

typedef struct wt_layer_job {
    wt_estimate critical_energy;    /* U_c [J/m^3]; value NaN: calibrated from observed_thickness */
    wt_estimate observed_thickness; /* [m]; value NaN = not observed */
    wt_estimate specific_wear_rate; /* k [m^2/N] */
    double duty;                    /* share of the time in contact; default 1 */
    bool incubation;                /* as in wt_layer_parameters; default true: exact */
    wt_depth_profile profile;
    double local_friction; /* m of the incompressible profile */
    const double *time;    /* [n_time] s; NULL: chosen around the time scales */
    size_t n_time;
    double velocity;        /* velocity of the wear [m/s]; NaN = reference velocity */
    wt_layer_energy energy; /* default hysteresis */
} wt_layer_job;
WT_API wt_layer_job wt_layer_job_defaults(void);
WT_API const wt_params *wt_layer_job_params(void);
/* Checks the values and their combination: exactly one of critical energy and observed thickness;
 * the latter needs a wear rate. */
WT_API wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err) WT_NODISCARD;

typedef struct wt_layer_tables {
    wt_table *layer;
    wt_estimate thickness; /* steady-state thickness [m]; infinite without wear */
    wt_layer_steady_state balance;
} wt_layer_tables;

/* Computes the thickness of the layer at the reference velocity. Standard errors from the
 * replicates of the friction and the stated errors of k and U_c (or of the observed thickness). */
WT_API wt_status wt_layer_thickness_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                            const wt_job *work, wt_layer_tables *tables,
                                            wt_error *err) WT_NODISCARD;

/* Creates the table "energy_density": energy density against depth at the velocity of the layer. */
WT_API wt_status wt_energy_density_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                           const wt_job *work, wt_table **table,
                                           wt_error *err) WT_NODISCARD;

/* ---- identification from measurements ------------------------------------------------------- */

typedef struct wt_identify_job {
    wt_estimate observed_thickness; /* steady-state thickness [m] */
    wt_estimate specific_wear_rate; /* k [m^2/N]; value NaN: not measured */
    wt_estimate running_in_time;    /* [s] from unmodified rubber; value NaN: not measured */
    double running_in_share;        /* share of the thickness at that time; default 0.95 */
    double duty;                    /* as in wt_layer_job */
    double wear_low, wear_high;     /* k in the literature [m^2/N] */
    double energy_low, energy_high; /* U_c in the literature [J/m^3] */
} wt_identify_job;
WT_API wt_identify_job wt_identify_job_defaults(void);
WT_API const wt_params *wt_identify_job_params(void);
/* Creates the table "identification": U_c and k from the thickness with the wear rate, with the
 * running-in time by either closure, and their range from the thickness alone; 95 % intervals and
 * correlation from the replicates and the stated errors. */
WT_API wt_status wt_identification_compute(const wt_sliding *sliding, const wt_identify_job *job,
                                           const wt_job *work, wt_table **table,
                                           wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
