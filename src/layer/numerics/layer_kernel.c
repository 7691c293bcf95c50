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
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>

wt_layer_parameters wt_layer_defaults(void)
{
    return (wt_layer_parameters){
        .critical_energy = (double)NAN,
        .damage = 1,
        .duty = 1,
    };
}

static const wt_param rows[] = {
    LAYER_WEAR_RATE(wt_layer_parameters, NULL),
    LAYER_DUTY(wt_layer_parameters),
    {PARAM("damage", wt_layer_parameters, damage, WT_Q_NONE, ABOVE(0)), .flags = PARAM_ONLY_C,
     .help = "Lambda, at which the rubber counts as modified"},
    {PARAM("start-thickness", wt_layer_parameters, start_thickness, WT_Q_LENGTH, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "of the layer at time 0"},
    {PARAM("critical-energy", wt_layer_parameters, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .flags = PARAM_ONLY_C, .help = "energy per volume that modifies the rubber"},
    {PARAM("pressure", wt_layer_parameters, pressure, WT_Q_PRESSURE, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "nominal pressure"},
    {PARAM("velocity", wt_layer_parameters, velocity, WT_Q_VELOCITY, AT_LEAST(0)),
     .flags = PARAM_ONLY_C, .help = "of sliding"},
};
PARAM_TABLE(wt_layer_params, wt_layer_parameters, rows, wt_layer_defaults, NO_PARTS)

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
    r.wear = p->duty * p->specific_wear_rate * p->pressure * p->velocity;
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
    if (rates->formation == 0)
        return 0;
    const double fall = energy_log_tail(rates->source, thickness) - rates->log_power;
    const double lowest = -700; /* e^x does not underflow above this; a faster formation uses
                                   logarithms */
    return fall > lowest ? rates->formation * exp(fall) : exp(log(rates->formation) + fall);
}

double layer_decay_rate(const layer_rates *rates, double thickness)
{
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
    const double error =
        8 * DBL_EPSILON * (1 + fabs(excess) + fabs(rates->log_power)) + rates->error;
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

/* ---- damage transport --------------------------------------------------------------------------
 */

/* Damage transport, D_t = Qw D_z + Omega. The solution is exact at constant load for any profile.
 * The damage at depth z is the integral along the path of the material from z + Qw t: D(z, t) =
 * [int_z^(z + Qw t) w dz] / (U_c k sigma0 v), or w(z) t / U_c without wear. The layer reaches to
 * the deepest z with D = Lambda. A profile with its maximum below the surface first forms a buried
 * band, and several waves can form several bands.
 *
 * The search uses bounds: each wave has a bounded second derivative on any depth interval. An
 * interval is left only if D cannot reach the level in it, or if D is monotonic there. No band is
 * missed, however thin.
 */

/* Smallest depth interval relative to the depth. A maximum inside exceeds the ends by the square of
 * it, which is below rounding. */
static const double min_relative_interval = 1e-9;

/* Depth interval [m]. */
typedef struct depth_interval {
    double low, high;
} depth_interval;

/* Damage at a time. */
typedef struct damage {
    const layer_rates *rates;
    bool worn;
    double time;
    double worn_depth; /* depth worn off until `time` [m] */
    double level;      /* required ln(D / Lambda) */
} damage;

static damage damage_create(const layer_rates *rates, bool with_wear)
{
    return (damage){.rates = rates, .worn = with_wear && rates->wear > 0};
}

static void damage_set_time(damage *d, double time)
{
    d->time = time;
    d->worn_depth = d->worn ? d->rates->wear * time : 0;
}

/* ln of the factor from the integral or density of the energy to D / Lambda. */
static double damage_scale(const damage *d)
{
    const layer_rates *r = d->rates;
    const double share = d->worn ? -log(r->wear / r->duty) : log(r->duty * d->time);
    return share - r->threshold;
}

/* ln(D / Lambda) minus the level; `user` is a damage. */
static double damage_excess(double depth, void *user)
{
    const damage *d = user;
    const double energy = d->worn ? energy_log_integral(d->rates->source, depth, d->worn_depth)
                                  : energy_log_density(d->rates->source, depth);
    return energy + damage_scale(d) - d->level;
}

/* Relative error of D, from the energy and from the logarithms. */
static double damage_error(const layer_rates *rates)
{
    return rates->error + 16 * DBL_EPSILON * (1 + fabs(rates->threshold));
}

/* Searches upwards from the lower end of `range`, where D is below the level. With `best` NULL it
 * stops at the first interval where D is below the level at the lower end and not below at the
 * upper; false if there is none. Otherwise it searches the whole range for the depth *best of the
 * largest D, and sets the level to it. */
static bool damage_find_rise(damage *d, depth_interval range, depth_interval *crossing,
                             double *best)
{
    const double floor = 1e-12 / d->rates->q_max;
    double high = range.high, length = 0.5 * high;
    bool halved = false;
    while (high > range.low) {
        const double low = fmax(high - length, range.low);
        length = high - low;
        /* D with its slope and a bound of its second derivative over the interval */
        const energy_expansion c =
            energy_expand(d->rates->source, d->rates->q_min, low, d->worn_depth, length);
        const double excess = c.log_scale + damage_scale(d) - d->level;
        const double here = log(c.value) + excess;
        const double most =
            log(c.value + length * (fmax(0, c.slope) + 0.5 * length * c.curvature)) + excess;
        const bool turns = fabs(c.slope) < length * c.curvature;
        if (turns && !(most <= DBL_EPSILON) && length > fmax(floor, min_relative_interval * high)) {
            length *= 0.5;
            halved = true;
            continue;
        }
        if (best != NULL && here > 0) {
            *best = low;
            d->level += here;
        } else if (best == NULL && here >= 0) {
            *crossing = (depth_interval){low, high};
            return true;
        }
        high = low;
        length *= halved ? 1 : 2; /* twice this length was just rejected */
        halved = false;
    }
    return false;
}

/* Returns the depth at or below `from` with the largest D, and sets the level to it. */
static double damage_peak(damage *d, double from)
{
    const double end = fmax(from, energy_monotonic_depth(d->rates->source));
    double depth = end;
    d->level = 0;
    d->level = damage_excess(end, d);
    (void)damage_find_rise(d, (depth_interval){from, end}, NULL, &depth);
    return depth;
}

/* Finds the deepest position in a range at which D equals the level; NaN if there is none. D must
 * be below the level at the lower end. */
static wt_status damage_deepest_edge(damage *d, depth_interval range, double level, double *edge,
                                     wt_error *err)
{
    depth_interval s;
    *edge = (double)NAN;
    d->level = level;
    if (!damage_find_rise(d, range, &s, NULL))
        return WT_OK;
    const bool deeper = damage_excess(s.high, d) >= 0; /* rounding of the interval limit */
    *edge = deeper ? s.high : s.low;
    return !deeper && damage_excess(s.low, d) > 0
               ? root_find(damage_excess, d, s.low, s.high, 0, edge, err)
               : WT_OK;
}

/* Displacement of the edge, including to other bands, due to the error of D. `most` is its largest
 * possible depth. */
static wt_status edge_error(damage *d, double edge, double most, double error, double *reach,
                            wt_error *err)
{
    double least = 0;
    const wt_status status = damage_deepest_edge(d, (depth_interval){0, edge}, error, &least, err);
    *reach = fmax(most - edge, edge - (isnan(least) ? 0 : least)) + 4 * DBL_EPSILON * edge;
    return status;
}

/* Relative length of the last Newton step. The error left is its square in a draw, which is far
 * below 1e-7; other numbers have no digits beyond it. */
static const double drawn_step = 1e-5, last_step = 2 * DBL_EPSILON;

/* Returns the edge at or below `depth` for the profile `persson`. ln D is convex there, so that the
 * steps of Newton's method rise to the edge and do not pass it. */
static double newton_edge(const damage *d, double depth)
{
    wt_energy_source terms = *d->rates->source;
    terms.power = wt_alloc(terms.n, sizeof *terms.power);
    energy_surface_terms(d->rates->source, d->worn_depth, terms.power);
    const double close = d->rates->skip_numerical_errors ? drawn_step : last_step;
    double step = (double)INFINITY;
    while (step > close * depth) {
        double logarithm[ENERGY_PROFILE_VALUES]; /* of the tail, which is D, and of its slope */
        energy_log_profiles(&terms, depth, logarithm);
        step =
            fmax(0, logarithm[0] + damage_scale(d) - d->level) * exp(logarithm[0] - logarithm[1]);
        depth += step;
    }
    free(terms.power);
    return depth;
}

/* Thickness for the profile `persson`: a single edge that only moves deeper. */
static void persson_thickness(damage *d, double error, double earlier, wt_estimate *thickness)
{
    const bool none = !(earlier > 0) && damage_excess(0, d) < 0;
    if (d->rates->skip_numerical_errors)
        thickness->numerical_error = (double)NAN;
    if (none && d->rates->skip_numerical_errors)
        return;
    if (none) /* a layer may exist within the error */
        d->level = -error;
    if (none && damage_excess(0, d) < 0)
        return;
    const double edge = newton_edge(d, earlier);
    *(none ? &thickness->numerical_error : &thickness->value) = edge;
    if (none || d->rates->skip_numerical_errors)
        return;
    const double lost = exp(energy_log_density(d->rates->source, edge)) -
                        exp(energy_log_density(d->rates->source, edge + d->worn_depth));
    const double reach =
        error / lost * exp(energy_log_integral(d->rates->source, edge, d->worn_depth));
    thickness->numerical_error = root_displacement(
        damage_excess, d, edge, error, fmax(2 * DBL_EPSILON * edge, isfinite(reach) ? reach : 0),
        error / d->rates->q_max);
}

wt_status layer_damage_depth(const layer_rates *rates, double time, double earlier,
                             wt_estimate *thickness, wt_error *err)
{
    *thickness = (wt_estimate){.unit = "m"};
    damage d = damage_create(rates, true);
    if (rates->formation == 0 || time == 0)
        return WT_OK;
    const double error = damage_error(rates);
    damage_set_time(&d, time);
    if (rates->source->profile == WT_PROFILE_PERSSON) {
        persson_thickness(&d, error, earlier, thickness);
        return WT_OK;
    }
    d.level = -error;
    double end = fmax(energy_monotonic_depth(rates->source), 1 / rates->q_min);
    while (damage_excess(end, &d) >= 0)
        end *= 2;
    double most, edge;
    wt_status status = damage_deepest_edge(&d, (depth_interval){0, end}, -error, &most, err);
    if (status != WT_OK || isnan(most))
        return status;
    /* slightly deeper, because D at the edge may be on either side of its level */
    const depth_interval range = {0, most * (1 + 4 * DBL_EPSILON) + DBL_MIN};
    status = damage_deepest_edge(&d, range, 0, &edge, err);
    if (status != WT_OK)
        return status;
    thickness->value = isnan(edge) ? 0 : edge;
    thickness->numerical_error = rates->skip_numerical_errors ? (double)NAN : most;
    if (isnan(edge) || rates->skip_numerical_errors) /* a layer may exist within the error */
        return status;
    return edge_error(&d, edge, most, error, &thickness->numerical_error, err);
}

/* ---- times ----------------------------------------------------------------------------------- */

typedef struct arrival {
    damage *d;
    double depth;
} arrival;

static double arrival_excess(double log_time, void *user)
{
    const arrival *p = user;
    damage_set_time(p->d, exp(log_time));
    return damage_excess(p->depth, p->d);
}

/* ln of the time at which a depth reaches the level; infinite if never. */
static wt_status damage_log_time(damage *d, double depth, double level, double *log_time,
                                 wt_error *err)
{
    const layer_rates *r = d->rates;
    d->level = level;
    damage_set_time(d, 1);
    if (!d->worn) {
        const double rate = energy_log_density(r->source, depth) + damage_scale(d);
        *log_time = level - rate;
        return WT_OK;
    }
    arrival p = {d, depth};
    /* from a worn depth of the shortest wave to one at which the longest wave has decayed */
    const double step = log(4);
    const double end = log(1e3 / r->q_min / r->wear);
    double low = -log(r->q_max * r->wear);
    *log_time = (double)INFINITY;
    while (arrival_excess(low, &p) >= 0)
        low -= step;
    double high = low + step;
    while (high < end && arrival_excess(high, &p) < 0)
        high += step;
    if (arrival_excess(high, &p) < 0)
        return WT_OK;
    return root_find(arrival_excess, &p, high - step, high, 0, log_time, err);
}

/* ln of the first time at which any depth at or below `from` reaches the level. It alternates
 * between the time of one position and the position of the largest D at that time until both agree.
 */
static wt_status damage_first_log_time(damage *d, double from, double level, double *log_time,
                                       wt_error *err)
{
    wt_status status = damage_log_time(d, from, level, log_time, err);
    if (status == WT_OK && isinf(*log_time)) /* w(0) can be 0, but not in the falling range */
        status = damage_log_time(d, fmax(from, energy_monotonic_depth(d->rates->source)), level,
                                 log_time, err);
    const double longest = log(DBL_MAX);
    double last = longest;
    while (status == WT_OK && *log_time < last && !energy_is_monotonic(d->rates->source)) {
        last = *log_time;
        damage_set_time(d, exp(last));
        const double best = damage_peak(d, from);
        if (!(d->level > level + DBL_EPSILON * (1 + fabs(last))))
            break;
        status = damage_log_time(d, best, level, log_time, err);
        *log_time = fmin(*log_time, last);
    }
    return status;
}

wt_status layer_damage_time(const layer_rates *rates, bool with_wear, wt_estimate depth,
                            wt_estimate *time, wt_error *err)
{
    *time = (wt_estimate){.value = (double)NAN, .numerical_error = (double)NAN, .unit = "s"};
    damage d = damage_create(rates, with_wear);
    if (!isfinite(depth.value))
        return WT_OK;
    const double error = damage_error(rates);
    if (rates->formation == 0)
        return WT_OK;
    const double above = fmax(0, depth.value - depth.numerical_error);
    double log_time = 0, early = 0, late = 0;
    wt_status status = damage_first_log_time(&d, depth.value, 0, &log_time, err);
    if (status != WT_OK || isinf(log_time))
        return status;
    time->value = exp(log_time);
    if (rates->skip_numerical_errors)
        return WT_OK;
    status = damage_first_log_time(&d, above, -error, &early, err);
    if (status == WT_OK)
        status = damage_first_log_time(&d, depth.value + depth.numerical_error, error, &late, err);
    time->numerical_error = fmax(time->value - exp(early), exp(late) - time->value) +
                            8 * DBL_EPSILON * (1 + fabs(log_time)) * time->value;
    return status;
}

/* ---- identification -------------------------------------------------------------------------- */

/* The thickness at balance determines U_c k: Qf(d) = Qw. Both rates scale with time, so that a
 * running-in time determines the depth worn off meanwhile, l = Qw t, which depends on the profile
 * only. */
wt_status wt_layer_identify_wear(const wt_energy_source *source, const wt_layer_parameters *p,
                                 double thickness, double specific_wear_rate,
                                 wt_identified_constants *found, wt_error *err)
{
    if (p == NULL || found == NULL)
        return wt_fail(err, WT_E_ARG, "nothing to identify a layer by");
    const wt_status status = energy_check(source, err);
    if (status != WT_OK)
        return status;
    const double zero = energy_log_tail(source, 0), there = energy_log_tail(source, thickness);
    if (!(thickness > 0) || !(specific_wear_rate > 0) || !isfinite(zero) || !isfinite(there)) {
        wt_fail(err, WT_E_RANGE, "no layer to identify");
        wt_error_expected(err, "a thickness and a wear rate above 0, and energy at that depth");
        wt_error_found(err, "%g m, %g m^2/N", thickness, specific_wear_rate);
        return WT_E_RANGE;
    }
    *found =
        (wt_identified_constants){.critical_energy = exp(there) / (p->damage * specific_wear_rate *
                                                                   p->pressure * p->velocity),
                                  .specific_wear_rate = specific_wear_rate,
                                  .ratio = exp(zero - there)};
    return WT_OK;
}

/* ---- depth worn off during running-in -------------------------------------------------------- */

typedef struct growth {
    const wt_energy_source *source;
    double from;      /* thickness reached: the share of the balance thickness [m] */
    double log_there; /* ln J at the balance */
} growth;

/* d l / d delta for the rate balance, d delta/dt = Qw (J(delta)/J(balance) - 1). */
static double worn_per_growth(double depth, void *user)
{
    const growth *g = user;
    return 1 / expm1(energy_log_tail(g->source, depth) - g->log_there);
}

/* ln of the damage that a position gains along its path, over that at the balance; 0 at the edge of
 * the layer. */
static double log_surplus(double length, void *user)
{
    const growth *g = user;
    return energy_log_integral(g->source, g->from, length) - g->log_there;
}

/* The integrand is smooth away from the balance: far fewer intervals are needed. */
enum { MAX_INTERVALS = 200 };
static const double integral_tolerance = 1e-12;

static wt_status compute_worn_length_rates(growth *g, double *length, wt_error *err)
{
    double error = 0;
    gsl_function f = {worn_per_growth, g};
    gsl_integration_workspace *const w = gsl_integration_workspace_alloc(MAX_INTERVALS);
    if (w == NULL)
        out_of_memory(MAX_INTERVALS * sizeof(double));
    const int failed = gsl_integration_qag(&f, 0, g->from, 0, integral_tolerance, MAX_INTERVALS,
                                           GSL_INTEG_GAUSS61, w, length, &error);
    gsl_integration_workspace_free(w);
    if (failed != 0 && !(error <= 1e-6 * *length)) {
        wt_fail(err, WT_E_CONVERGENCE, "the growth of the layer could not be integrated");
        return WT_E_CONVERGENCE;
    }
    return WT_OK;
}

static wt_status compute_worn_length_transport(growth *g, double *length, wt_error *err)
{
    double high = g->from, low = high;
    if (!(energy_log_tail(g->source, g->from) > g->log_there))
        return wt_fail(err, WT_E_RANGE,
                       "no energy between that share of the thickness and all of it");
    while (log_surplus(high, g) < 0)
        high *= 2;
    while (log_surplus(low, g) >= 0)
        low /= 2;
    return root_find(log_surplus, g, low, high, 0, length, err);
}

wt_status wt_layer_identify_time(const wt_energy_source *source, const wt_layer_parameters *p,
                                 double thickness, double time, double share,
                                 wt_identified_constants *found, wt_error *err)
{
    wt_status status = wt_layer_identify_wear(source, p, thickness, 1, found, err);
    if (status == WT_OK && (!(time > 0) || !(share > 0) || !(share < 1))) {
        wt_fail(err, WT_E_RANGE, "no running-in to identify a layer by");
        wt_error_expected(err, "a time above 0, and a share of the thickness between 0 and 1");
        wt_error_found(err, "%g s, %g", time, share);
        return WT_E_RANGE;
    }
    if (status != WT_OK)
        return status;
    growth g = {source, share * thickness, energy_log_tail(source, thickness)};
    double length = 0;
    status = p->incubation ? compute_worn_length_transport(&g, &length, err)
                           : compute_worn_length_rates(&g, &length, err);
    if (status != WT_OK)
        return status;
    const double k = length / (p->duty * p->pressure * p->velocity * time);
    return wt_layer_identify_wear(source, p, thickness, k, found, err);
}
