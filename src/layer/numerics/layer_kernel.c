/* Rates of formation, Qf(d) = int_d^inf Omega dz / Lambda, and of wear, Qw = k sigma0 v, and the
 * thickness at which one is a given multiple of the other. Omega is w / U_c.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_kernel.h"
#include "core/base/memory.h"
#include "core/base/shared_params.h"
#include "core/math/root.h"

#include <float.h>
#include <gsl/gsl_chebyshev.h>
#include <math.h>

/* Order for a function that is smooth over a factor of two: the last coefficients are rounding. */
enum { ORDER = 24 };

void feedback_rate_clear(feedback_rate *feedback)
{
    for (size_t i = 0; i < feedback->n; i++) {
        gsl_cheb_free(feedback->subinterval[i].value);
        gsl_cheb_free(feedback->subinterval[i].slope);
    }
    feedback->n = 0;
}

wt_status feedback_rate_create(feedback_formation_fn f, void *user, double first, double target,
                               feedback_rate *feedback, wt_error *err)
{
    gsl_function function = {f, user};
    *feedback = (feedback_rate){.target = target};
    for (double low = 0, high = fmin(first, target); low < target; high *= 2) {
        if (feedback->n == FEEDBACK_SUBINTERVALS)
            return wt_fail(err, WT_E_RANGE, "a layer is too thick beside the shortest wave");
        feedback_subinterval *p = &feedback->subinterval[feedback->n];
        *p = (feedback_subinterval){low, 2 * high > target ? target : high, gsl_cheb_alloc(ORDER),
                                    gsl_cheb_alloc(ORDER)};
        feedback->n++;
        if (p->value == NULL || p->slope == NULL)
            out_of_memory(sizeof(gsl_cheb_series));
        gsl_cheb_init(p->value, &function, p->low, p->high);
        gsl_cheb_calc_deriv(p->slope, p->value);
        low = p->high;
    }
    return WT_OK;
}

static const feedback_subinterval *find_subinterval(const feedback_rate *feedback, double thickness)
{
    size_t i = 0;
    while (i + 1 < feedback->n && thickness > feedback->subinterval[i].high)
        i++;
    return &feedback->subinterval[i];
}

static double feedback_rate_log(const feedback_rate *feedback, double thickness)
{
    return gsl_cheb_eval(find_subinterval(feedback, thickness)->value, thickness);
}

static double feedback_rate_slope(const feedback_rate *feedback, double thickness)
{
    return gsl_cheb_eval(find_subinterval(feedback, thickness)->slope, thickness);
}

wt_layer_parameters wt_layer_defaults(void)
{
    return (wt_layer_parameters){
        .critical_energy = (double)NAN,
        .damage = 1,
        .duty = 1,
        .severity_exponent = 1,
    };
}

static const wt_param rows[] = {
    LAYER_WEAR_RATE(wt_layer_parameters, NULL),
    LAYER_DUTY(wt_layer_parameters),
    {PARAM("damage", wt_layer_parameters, damage, WT_Q_NONE, ABOVE(0)), .flags = PARAM_ONLY_C,
     .help = "Lambda, at which the rubber counts as modified"},
    {PARAM("start-thickness", wt_layer_parameters, start_thickness, WT_Q_LENGTH, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "of the layer at time 0"},
    {PARAM("severity-power", wt_layer_parameters, severity_power, WT_Q_NONE, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "power at which the specific wear rate doubles, W/m^2"},
    {PARAM("severity-exponent", wt_layer_parameters, severity_exponent, WT_Q_NONE, ABOVE(0)),
     .flags = PARAM_ONLY_C, .help = "m of the severity power"},
    {PARAM("critical-energy", wt_layer_parameters, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .flags = PARAM_ONLY_C, .help = "energy per volume that modifies the rubber"},
    {PARAM("pressure", wt_layer_parameters, pressure, WT_Q_PRESSURE, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "nominal pressure"},
    {PARAM("velocity", wt_layer_parameters, velocity, WT_Q_VELOCITY, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "of sliding"},
};
PARAM_TABLE(wt_layer_params, wt_layer_parameters, rows, wt_layer_defaults, NO_PARTS)

double layer_wear_rate(const wt_layer_parameters *p, double power)
{
    return p->severity_power > 0
               ? p->specific_wear_rate * (1 + pow(power / p->severity_power, p->severity_exponent))
               : p->specific_wear_rate;
}

/* Factor from the relative error of the power to that of the wear: m x / (1 + x), x = (power /
 * E_c)^m. */
static double wear_power_sensitivity(const wt_layer_parameters *p, double power)
{
    if (!(p->severity_power > 0) || !(power > 0))
        return 0;
    return p->severity_exponent / (1 + pow(power / p->severity_power, -p->severity_exponent));
}

wt_status layer_rates_compute(const wt_energy_source *source, const wt_layer_parameters *parameters,
                              layer_rates *rates, wt_error *err)
{
    *rates = (layer_rates){0};
    if (parameters == NULL)
        return wt_fail(err, WT_E_ARG, "a layer needs its parameters");
    wt_status status = energy_check(source, err);
    if (status == WT_OK)
        status = param_check(wt_layer_params(), parameters, err);
    if (status != WT_OK)
        return status;
    const wt_layer_parameters *p = parameters;
    layer_rates r = {
        .source = source, .duty = p->duty, .skip_numerical_errors = p->skip_numerical_errors};
    if (!energy_wavenumber_range(source, &r.q_min, &r.q_max))
        r.q_min = 0;
    for (size_t i = 0; i < source->n; i++)
        r.power += source->power[i];
    r.log_power = r.power > 0 ? log(r.power) : 0;
    r.threshold = log(p->critical_energy) + log(p->damage);
    r.formation = p->duty * (r.power / p->critical_energy / p->damage);
    r.error = source->numerical_error;
    r.wear = p->duty * layer_wear_rate(p, r.power) * p->pressure * p->velocity;
    r.wear_error = wear_power_sensitivity(p, r.power) * source->numerical_error;
    /* the density of a wave is proportional to q, and its second derivative to q^3 */
    const double bends = r.power * r.q_max * r.q_max * r.q_max;
    if (!isfinite(r.formation) || !isfinite(r.wear) || !isfinite(bends)) {
        status = wt_fail(err, WT_E_RANGE, "formation or wear of a layer is faster than any number");
        wt_error_found(err, "formation %g m/s, wear %g m/s", r.formation, r.wear);
        wt_error_advice(err, "check the units: 1 mm^3/(N m) is 1e-9 m^2/N");
        return status;
    }
    r.log_ratio = r.formation == 0 ? -HUGE_VAL : log(r.formation / r.wear);
    if (r.formation > 0 && r.wear > 0 && isinf(r.log_ratio))
        r.log_ratio = log(r.formation) - log(r.wear);
    *rates = r;
    return WT_OK;
}

double layer_formation_rate(const layer_rates *rates, double thickness)
{
    if (rates->feedback != NULL)
        return exp(feedback_rate_log(rates->feedback, thickness));
    if (rates->formation == 0)
        return 0;
    const double fall = energy_log_tail(rates->source, thickness) - rates->log_power;
    const double lowest = -700; /* e^x does not underflow above this; a faster formation uses
                                   logarithms */
    return fall > lowest ? rates->formation * exp(fall) : exp(log(rates->formation) + fall);
}

double layer_decay_rate(const layer_rates *rates, double thickness)
{
    if (rates->feedback != NULL)
        return fabs(feedback_rate_slope(rates->feedback, thickness));
    if (rates->formation == 0)
        return 0;
    return exp(energy_log_density(rates->source, thickness) -
               energy_log_tail(rates->source, thickness));
}

/* ---- fixed point ----------------------------------------------------------------------------- */

typedef struct balance_root {
    const layer_rates *rates;
    double level; /* required ln(Qf / Qf(0)) */
} balance_root;

static double log_formation_excess(double depth, void *user)
{
    const balance_root *b = user;
    return energy_log_tail(b->rates->source, depth) - b->rates->log_power - b->level;
}

/* Displacement of the root due to this error of ln Qf. */
static double balance_root_error(balance_root *b, double root, double error)
{
    const double kappa = layer_decay_rate(b->rates, root);
    const double reach = fmax(kappa > 0 ? error / kappa : 0, 2 * DBL_EPSILON * root);
    return root_displacement(log_formation_excess, b, root, error, reach, DBL_MIN);
}

wt_status layer_fixed_point(const layer_rates *rates, double log_scale, wt_estimate *thickness,
                            wt_error *err)
{
    *thickness = (wt_estimate){.unit = "m"};
    double excess = rates->log_ratio - log_scale; /* ln(Qf(0) / (scale Qw)) */
    const double error = 8 * DBL_EPSILON * (1 + fabs(excess) + fabs(rates->log_power)) +
                         rates->error + rates->wear_error;
    const bool none = !(excess > 0);
    if (none && !rates->skip_numerical_errors) /* largest possible thickness within the error */
        excess += error;
    if (rates->skip_numerical_errors)
        thickness->numerical_error = (double)NAN;
    if (!(excess > 0))
        return WT_OK;
    if (isinf(excess)) {
        thickness->value = (double)INFINITY;
        return WT_OK;
    }
    balance_root b = {.rates = rates, .level = -excess};
    double high = excess / (2 * rates->q_min);
    while (log_formation_excess(high, &b) > 0)
        high *= 2;
    double root = 0;
    const wt_status status = root_find(log_formation_excess, &b, 0, high, 0, &root, err);
    if (status != WT_OK)
        return status;
    thickness->value = none ? 0 : root;
    if (!rates->skip_numerical_errors)
        thickness->numerical_error = none ? root : balance_root_error(&b, root, error);
    return WT_OK;
}
