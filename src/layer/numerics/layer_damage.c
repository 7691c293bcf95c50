/* Damage transport, D_t = Qw D_z + Omega. The solution is exact at constant load for any profile.
 * The damage at depth z is the integral along the path of the material from z + Qw t: D(z, t) =
 * [int_z^(z + Qw t) w dz] / (U_c k sigma0 v), or w(z) t / U_c without wear. The layer reaches to
 * the deepest z with D = Lambda. A profile with its maximum below the surface first forms a buried
 * band, and several waves can form several bands.
 *
 * The search uses bounds: each wave has a bounded second derivative on any depth interval. An
 * interval is left only if D cannot reach the level in it, or if D is monotonic there. No band is
 * missed, however thin.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_damage.h"

#include "core/math/root.h"

#include <float.h>
#include <math.h>

/* Smallest depth interval relative to the depth. A maximum inside exceeds the ends by the square of
 * it, which is below rounding. */
static const double min_relative_interval = 1e-9;

damage damage_create(const layer_rates *rates, bool with_wear)
{
    return (damage){.rates = rates, .worn = with_wear && rates->wear > 0, .q_max = rates->q_max};
}

void damage_set_time(damage *d, double time)
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

/* Present depth coordinate of the damage of an earlier load, after the wear since then. */
static double shifted_depth(const damage *d, size_t i, double depth)
{
    return depth + d->past[i].worn + d->worn_depth;
}

/* ln(D / Lambda) due to the loads. */
double damage_log_total(double depth, const damage *d)
{
    double sum = -HUGE_VAL;
    if (d->rates->formation > 0 && d->time > 0)
        sum = (d->worn ? energy_log_integral(d->rates->source, depth, d->worn_depth)
                       : energy_log_density(d->rates->source, depth)) +
              damage_scale(d);
    for (size_t i = 0; i < d->n_past; i++) {
        const damage_load *p = &d->past[i];
        const double shifted = shifted_depth(d, i, depth);
        sum = log_add(sum, p->log_scale +
                               (p->worn_depth > 0
                                    ? energy_log_integral(p->rates->source, shifted, p->worn_depth)
                                    : energy_log_density(p->rates->source, shifted)));
    }
    return sum;
}

double damage_excess(double depth, void *user)
{
    const damage *d = user;
    if (d->n_past > 0)
        return damage_log_total(depth, d) - d->level;
    const double energy = d->worn ? energy_log_integral(d->rates->source, depth, d->worn_depth)
                                  : energy_log_density(d->rates->source, depth);
    return energy + damage_scale(d) - d->level;
}

double damage_error(const layer_rates *rates)
{
    return rates->error + rates->wear_error + 16 * DBL_EPSILON * (1 + fabs(rates->threshold));
}

/* Adds an expansion with the logarithm of its weight. */
static void add_expansion(energy_expansion *sum, energy_expansion c, double log_weight)
{
    c.log_scale += log_weight;
    if (!(c.value > 0))
        return;
    const double most = fmax(sum->log_scale, c.log_scale);
    const double left = exp(sum->log_scale - most), right = exp(c.log_scale - most);
    *sum = (energy_expansion){most, left * sum->value + right * c.value,
                              left * sum->slope + right * c.slope,
                              left * sum->curvature + right * c.curvature};
}

/* D / Lambda with slope and bound of the second derivative; multiply all by exp(log_scale). */
energy_expansion damage_expand(const damage *d, double depth, double reach)
{
    energy_expansion sum;
    if (d->n_past == 0) {
        sum = energy_expand(d->rates->source, d->rates->q_min, depth, d->worn_depth, reach);
        sum.log_scale += damage_scale(d);
        return sum;
    }
    sum = (energy_expansion){.log_scale = -HUGE_VAL};
    if (d->rates->formation > 0 && d->time > 0)
        add_expansion(&sum,
                      energy_expand(d->rates->source, d->rates->q_min, depth, d->worn_depth, reach),
                      damage_scale(d));
    for (size_t i = 0; i < d->n_past; i++) {
        const damage_load *p = &d->past[i];
        add_expansion(&sum,
                      energy_expand(p->rates->source, p->rates->q_min, shifted_depth(d, i, depth),
                                    p->worn_depth, reach),
                      p->log_scale);
    }
    return sum;
}

damage_load damage_load_create(const damage *d)
{
    return (damage_load){
        .rates = d->rates, .worn_depth = d->worn_depth, .log_scale = damage_scale(d)};
}

/* Searches upwards from the lower end of `range`, where D is below the level. With `best` NULL it
 * stops at the first interval where D is below the level at the lower end and not below at the
 * upper; false if there is none. Otherwise it searches the whole range for the depth *best of the
 * largest D, and sets the level to it. */
bool damage_find_rise(damage *d, depth_interval range, depth_interval *crossing, double *best)
{
    const double floor = 1e-12 / d->q_max;
    double high = range.high, length = 0.5 * high;
    bool halved = false;
    while (high > range.low) {
        const double low = fmax(high - length, range.low);
        length = high - low;
        const energy_expansion c = damage_expand(d, low, length);
        const double excess = c.log_scale - d->level;
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

/* Searches as damage_find_rise does, but for the depth where D falls below the level. */
static bool damage_find_fall(damage *d, double from, depth_interval *crossing)
{
    const double floor = 1e-12 / d->q_max;
    double high = from, length = 0.5 * high;
    bool halved = false;
    while (high > 0) {
        const double low = fmax(high - length, 0);
        length = high - low;
        const energy_expansion c = damage_expand(d, low, length);
        const double excess = c.log_scale - d->level;
        const double least = c.value - length * (fmax(0, -c.slope) + 0.5 * length * c.curvature);
        const bool turns = fabs(c.slope) < length * c.curvature;
        if (turns && !(least > 0 && log(least) + excess >= 0) &&
            length > fmax(floor, min_relative_interval * high)) {
            length *= 0.5;
            halved = true;
            continue;
        }
        if (log(c.value) + excess < 0) {
            *crossing = (depth_interval){low, high};
            return true;
        }
        high = low;
        length *= halved ? 1 : 2; /* twice this length was just rejected */
        halved = false;
    }
    return false;
}

wt_status damage_band(damage *d, double from, depth_interval *band, double *above, wt_error *err)
{
    depth_interval s;
    double upper = 0, lower = 0;
    *above = 0;
    if (!damage_find_rise(d, (depth_interval){0, from}, &s, NULL))
        return wt_fail(err, WT_E_NOT_FOUND, "no modified band");
    lower = s.low;
    wt_status status = WT_OK;
    const double inside = s.low;
    if (damage_excess(s.low, d) > 0 && damage_excess(s.high, d) < 0)
        status = root_find(damage_excess, d, s.low, s.high, 0, &lower, err);
    if (status == WT_OK && damage_find_fall(d, inside, &s)) {
        *above = upper = s.low;
        if (damage_excess(s.low, d) < 0 && damage_excess(s.high, d) > 0)
            status = root_find(damage_excess, d, s.low, s.high, 0, &upper, err);
    }
    *band = (depth_interval){upper, lower};
    return status;
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

/* Thickness for a profile that falls with depth: a single edge that only moves deeper. */
static wt_status monotonic_thickness(damage *d, double error, double earlier,
                                     wt_estimate *thickness, wt_error *err)
{
    const bool none = damage_excess(0, d) < 0;
    if (d->rates->skip_numerical_errors)
        thickness->numerical_error = (double)NAN;
    if (none && d->rates->skip_numerical_errors)
        return WT_OK;
    if (none) /* a layer may exist within the error */
        d->level = -error;
    if (none && damage_excess(0, d) < 0)
        return WT_OK;
    double edge = earlier, step = earlier > 0 ? 0.1 * earlier : 1 / d->rates->q_max;
    depth_interval s = {earlier, earlier};
    do {
        s.low = s.high;
        s.high += step;
        step *= 2;
    } while (damage_excess(s.high, d) >= 0);
    if (damage_excess(s.low, d) > 0) { /* otherwise the edge is there up to rounding */
        const wt_status status = root_find(damage_excess, d, s.low, s.high, 0, &edge, err);
        if (status != WT_OK)
            return status;
    }
    if (none) {
        thickness->numerical_error = edge;
        return WT_OK;
    }
    thickness->value = edge;
    if (d->rates->skip_numerical_errors)
        return WT_OK;
    const double lost = exp(energy_log_density(d->rates->source, edge)) -
                        exp(energy_log_density(d->rates->source, edge + d->worn_depth));
    const double reach =
        error / lost * exp(energy_log_integral(d->rates->source, edge, d->worn_depth));
    thickness->numerical_error = root_displacement(
        damage_excess, d, edge, error, fmax(2 * DBL_EPSILON * edge, isfinite(reach) ? reach : 0),
        error / d->rates->q_max);
    return WT_OK;
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
    if (energy_is_monotonic(rates->source))
        return monotonic_thickness(&d, error, earlier, thickness, err);
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
        const double rate = damage_log_total(depth, d);
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
