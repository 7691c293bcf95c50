/* Rates of formation, Qf(d) = int_d^inf w dz / (Lambda U_c), and of wear, Qw = k sigma0 v, and the
 * thickness at which one is a given multiple of the other.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/layer.h"
#include "kernel/params.h"

#include "model/root.h"

#include <float.h>
#include <math.h>

wt_layer_parameters wt_layer_defaults(void)
{
    return (wt_layer_parameters){.damage = 1, .duty = 1};
}

static const wt_param rows[] = {
    LAYER_ROWS(wt_layer_parameters, 0),
    {PARAM("critical-energy", wt_layer_parameters, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .flags = PARAM_ONLY_C, .help = "energy per volume that modifies the rubber"},
    {PARAM("pressure", wt_layer_parameters, pressure, WT_Q_PRESSURE, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "nominal pressure"},
    {PARAM("velocity", wt_layer_parameters, velocity, WT_Q_VELOCITY, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "of sliding"},
};
PARAM_TABLE(wt_layer_params, wt_layer_parameters, rows, wt_layer_defaults, NO_PARTS)

wt_status layer_rates_make(const wt_energy_source *source, const wt_layer_parameters *parameters,
                           layer_rates *rates, wt_error *err)
{
    if (parameters == NULL)
        return wt_fail(err, WT_E_ARG, "a layer needs its parameters");
    wt_status status = energy_check(source, err);
    if (status == WT_OK)
        status = param_check(wt_layer_params(), parameters, err);
    if (status != WT_OK)
        return status;
    const wt_layer_parameters *p = parameters;
    layer_rates r = {.source = source, .duty = p->duty, .without_errors = p->without_errors};
    if (!energy_range(source, &r.q_min, &r.q_max))
        r.q_min = 0;
    for (size_t i = 0; i < source->n; i++)
        r.power += source->power[i];
    r.log_power = r.power > 0 ? log(r.power) : 0;
    r.threshold = log(p->critical_energy) + log(p->damage);
    r.formation = p->duty * (r.power / p->critical_energy / p->damage);
    r.wear = p->duty * p->specific_wear_rate * p->pressure * p->velocity;
    /* of a wave the density goes with q, and its bends with the cube */
    const double bends = r.power * r.q_max * r.q_max * r.q_max;
    if (!isfinite(r.formation) || !isfinite(r.wear) || !isfinite(bends)) {
        wt_fail(err, WT_E_RANGE, "formation or wear of a layer is faster than any number");
        wt_error_found(err, "formation %g m/s, wear %g m/s", r.formation, r.wear);
        wt_error_advice(err, "check the units: 1 mm^3/(N m) is 1e-9 m^2/N");
        return WT_E_RANGE;
    }
    r.log_ratio = r.formation == 0 ? -HUGE_VAL : log(r.formation / r.wear);
    if (r.formation > 0 && r.wear > 0 && isinf(r.log_ratio))
        r.log_ratio = log(r.formation) - log(r.wear);
    *rates = r;
    return WT_OK;
}

double layer_formation(const layer_rates *rates, double thickness)
{
    if (rates->formation == 0)
        return 0;
    const double fall = energy_log_tail(rates->source, thickness) - rates->log_power;
    const double lowest = -700; /* e^x of it is a number; of a fast formation there is more */
    return fall > lowest ? rates->formation * exp(fall) : exp(log(rates->formation) + fall);
}

double layer_decay(const layer_rates *rates, double thickness)
{
    if (rates->formation == 0)
        return 0;
    return exp(energy_log_density(rates->source, thickness) -
               energy_log_tail(rates->source, thickness));
}

/* ---- fixed point ----------------------------------------------------------------------------- */

typedef struct balance_root {
    const layer_rates *rates;
    double level; /* ln(Qf / Qf(0)) wanted */
} balance_root;

static double balance_function(double depth, void *user)
{
    const balance_root *b = user;
    return energy_log_tail(b->rates->source, depth) - b->rates->log_power - b->level;
}

/* How far the root moves when the logarithm of Qf moves by `error`. */
static double root_error(balance_root *b, double root, double error)
{
    const double kappa = layer_decay(b->rates, root);
    const double reach = fmax(kappa > 0 ? error / kappa : 0, 2 * DBL_EPSILON * root);
    return root_reach(balance_function, b, root, error, reach, DBL_MIN);
}

wt_status layer_fixed_point(const layer_rates *rates, double log_scale, wt_estimate *thickness,
                            wt_error *err)
{
    *thickness = (wt_estimate){.unit = "m"};
    double excess = rates->log_ratio - log_scale; /* ln(Qf(0) / (scale Qw)) */
    const double error = 8 * DBL_EPSILON * (1 + fabs(excess) + fabs(rates->log_power)) +
                         rates->source->numerical_error;
    const bool none = !(excess > 0);
    if (none && !rates->without_errors) /* how thick it might be all the same */
        excess += error;
    if (rates->without_errors)
        thickness->numerical_error = (double)NAN;
    if (!(excess > 0))
        return WT_OK;
    if (isinf(excess)) {
        thickness->value = (double)INFINITY;
        return WT_OK;
    }
    balance_root b = {.rates = rates, .level = -excess};
    double high = excess / (2 * rates->q_min);
    while (balance_function(high, &b) > 0)
        high *= 2;
    double root = 0;
    const wt_status status = root_find(balance_function, &b, 0, high, 0, &root, err);
    if (status != WT_OK)
        return status;
    thickness->value = none ? 0 : root;
    if (!rates->without_errors)
        thickness->numerical_error = none ? root : root_error(&b, root, error);
    return WT_OK;
}
