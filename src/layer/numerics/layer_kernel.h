/* Formation and wear at constant load. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_KERNEL_H
#define WT_LAYER_NUMERICS_LAYER_KERNEL_H

#include "layer/numerics/energy_density_kernel.h"

typedef struct feedback_subinterval {
    double low, high;
    struct gsl_cheb_series_struct *value, *slope; /* of ln Qf */
} feedback_subinterval;

/* Each subinterval is as long as all before it: a layer is never 2^64 times as thick as the
 * shortest wave. */
enum { FEEDBACK_SUBINTERVALS = 64 };

typedef struct feedback_rate {
    double target; /* final thickness [m] */
    size_t n;
    feedback_subinterval subinterval[FEEDBACK_SUBINTERVALS];
} feedback_rate;

/* ln Qf under a layer of this thickness. */
typedef double (*feedback_formation_fn)(double thickness, void *user);

/* Qf(d) = formation exp(log_tail(d) - log_power), Qw = wear; R = Qf(0)/Qw. */
typedef struct layer_rates {
    const wt_energy_source *source;
    const struct feedback_rate *feedback; /* formation with feedback; NULL if as on the bulk */
    double q_min, q_max; /* range of the terms with power [rad/m]; 0 without power */
    double formation;    /* Qf(0) [m/s], duty included */
    double wear;         /* [m/s], duty included */
    double power;        /* power per area [W/m^2] */
    double log_power;    /* ln of the tail at the surface; 0 without power */
    double log_ratio;    /* ln R; -infinity without power, +infinity without wear */
    double threshold;    /* ln(U_c Lambda) */
    double error;        /* relative error of a tail */
    double wear_error;   /* relative error of the wear if it depends on the power;
                            else 0 */
    double duty;
    bool skip_numerical_errors;
} layer_rates;

wt_status layer_rates_compute(const wt_energy_source *source, const wt_layer_parameters *parameters,
                              layer_rates *rates, wt_error *err) WT_NODISCARD;
/* Specific wear rate k with the effect of the power [m^2/N]. */
double layer_wear_rate(const wt_layer_parameters *parameters, double power);
double layer_formation_rate(const layer_rates *rates, double thickness); /* Qf */
/* Local decay rate of Qf, w / int w [1/m]. */
double layer_decay_rate(const layer_rates *rates, double thickness);
/* Thickness at which Qf = scale Qw, with its numerical error; 0 if Qf(0) is below. */
wt_status layer_fixed_point(const layer_rates *rates, double log_scale, wt_estimate *thickness,
                            wt_error *err) WT_NODISCARD;

/* Damage transport: the deepest position with int Omega dt >= Lambda at `time`; 0 before
 * incubation. The search begins at the thickness of an earlier time, or at 0. */
wt_status layer_damage_depth(const layer_rates *rates, double time, double earlier,
                             wt_estimate *thickness, wt_error *err) WT_NODISCARD;
/* First time at which any position at this depth or below is modified; NaN if never. */
wt_status layer_damage_time(const layer_rates *rates, bool with_wear, wt_estimate depth,
                            wt_estimate *time, wt_error *err) WT_NODISCARD;
/* Returns WT_E_RANGE with the invalid time. */
wt_status layer_times_check(const double *time, size_t n, wt_error *err) WT_NODISCARD;
typedef struct layer_instant {
    double time;
    wt_layer_point *point;
} layer_instant;

/* Rate balance: sets the thickness, but no other member, of the points at n rising times. */
wt_status layer_integrate_thickness(const layer_rates *rates, double start, const layer_instant *at,
                                    size_t n, wt_error *err) WT_NODISCARD;
/* Sets the thickness of the points at n times in any order, by damage transport or by the rate
 * balance. */
wt_status layer_history_sorted(const layer_rates *rates, double start, bool transport,
                               const double *time, size_t n, wt_layer_point *points,
                               wt_error *err) WT_NODISCARD;
/* Rate balance: time from one thickness to another on the path to the balance or to the bare
 * surface; infinite if it is not on the path. */
wt_status layer_integrate_time(const layer_rates *rates, double start, wt_estimate goal,
                               wt_estimate *time, wt_error *err) WT_NODISCARD;
/* Creates subintervals from 0 to the target; the first has the length `first`. The caller clears
 * the rate, also on failure. */
wt_status feedback_rate_create(feedback_formation_fn f, void *user, double first, double target,
                               feedback_rate *feedback, wt_error *err) WT_NODISCARD;
void feedback_rate_clear(feedback_rate *feedback);

#endif
