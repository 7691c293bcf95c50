/* Damage transport, D_t = Qw D_z + Omega: exact at constant load for any profile, because the
 * damage at depth z is what the material gathered on its way up from z + Qw t: D(z, t) = [int_z^(z
 * + Qw t) w dz] / (U_c k sigma0 v),  or w(z) t / U_c without wear. The layer reaches to the deepest
 * z with D = Lambda. A profile that peaks below the surface first makes a buried band, and several
 * waves make several.
 *
 * Where D rises and falls is known from bounds: each wave has a bounded second derivative on any
 * stretch of depth, so that a stretch is left only when D cannot reach the level in it or only
 * rises or only falls there. No band is so thin that it is stepped over.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_damage.h"

#include "core/math/root.h"

#include <float.h>
#include <math.h>

/* Stretches are halved down to this part of their depth; what a maximum gains inside is its square,
 * below rounding. */
static const double least_stretch = 1e-9;

damage damage_of(const layer_rates *rates, bool with_wear)
{
    return (damage){.rates = rates, .worn = with_wear && rates->wear > 0, .q_max = rates->q_max};
}

void damage_set_time(damage *d, double time)
{
    d->time = time;
    d->way = d->worn ? d->rates->wear * time : 0;
}

/* ln of D / Lambda over the integral or density of the energy. */
static double damage_scale(const damage *d)
{
    const layer_rates *r = d->rates;
    const double share = d->worn ? -log(r->wear / r->duty) : log(r->duty * d->time);
    return share - r->threshold;
}

/* Where the damage of an earlier load is now that so much more was worn off. */
static double now_at(const damage *d, size_t i, double depth)
{
    return depth + d->past[i].worn + d->way;
}

/* ln(D / Lambda) of the loads alone. */
double damage_of_loads(double depth, const damage *d)
{
    double sum = -HUGE_VAL;
    if (d->rates->formation > 0 && d->time > 0)
        sum = (d->worn ? rates_log_gain(d->rates, depth, d->way)
                       : rates_log_density(d->rates, depth)) +
              damage_scale(d);
    for (size_t i = 0; i < d->n_past; i++) {
        const damage_load *p = &d->past[i];
        const double place = now_at(d, i, depth);
        sum = log_add(sum, p->log_scale + (p->way > 0 ? rates_log_gain(p->rates, place, p->way)
                                                      : rates_log_density(p->rates, place)));
    }
    return sum;
}

/* The logarithm that the loads must bring, where some damage is there without them; where that is
 * enough, the least there is. */
static double damage_wanted(const damage *d)
{
    const double unloaded = d->rates->background * d->time + d->past_background;
    return unloaded > 0 ? log(fmax(DBL_MIN, exp(d->level) - unloaded)) : d->level;
}

double damage_at(double depth, void *user)
{
    const damage *d = user;
    if (d->n_past > 0)
        return damage_of_loads(depth, d) - damage_wanted(d);
    const double energy =
        d->worn ? rates_log_gain(d->rates, depth, d->way) : rates_log_density(d->rates, depth);
    return energy + damage_scale(d) - damage_wanted(d);
}

double damage_error(const layer_rates *rates)
{
    return rates->error + rates->wear_error + 16 * DBL_EPSILON * (1 + fabs(rates->threshold));
}

/* Adds a course with the logarithm of its weight. */
static void course_plus(energy_course *sum, energy_course c, double log_weight)
{
    c.log_scale += log_weight;
    if (!(c.value > 0))
        return;
    const double most = fmax(sum->log_scale, c.log_scale);
    const double left = exp(sum->log_scale - most), right = exp(c.log_scale - most);
    *sum = (energy_course){most, left * sum->value + right * c.value,
                           left * sum->slope + right * c.slope,
                           left * sum->curvature + right * c.curvature};
}

/* D / Lambda with slope and bound, to be multiplied by exp(log_scale). */
energy_course damage_course(const damage *d, double depth, double reach)
{
    energy_course sum;
    if (d->n_past == 0) {
        sum = rates_course(d->rates, depth, d->way, reach);
        sum.log_scale += damage_scale(d);
        return sum;
    }
    sum = (energy_course){.log_scale = -HUGE_VAL};
    if (d->rates->formation > 0 && d->time > 0)
        course_plus(&sum, rates_course(d->rates, depth, d->way, reach), damage_scale(d));
    for (size_t i = 0; i < d->n_past; i++) {
        const damage_load *p = &d->past[i];
        course_plus(&sum, rates_course(p->rates, now_at(d, i, depth), p->way, reach), p->log_scale);
    }
    return sum;
}

damage_load damage_load_of(const damage *d)
{
    return (damage_load){.rates = d->rates, .way = d->way, .log_scale = damage_scale(d)};
}

/* Goes up from the lower end of `range`, where D is below the level. With `best` NULL to the first
 * stretch at whose lower end D is below and at whose upper end it is not; false if there is none.
 * Else all the way, for the depth *best where D is highest, to which the level is set. */
bool damage_climb(damage *d, stretch range, stretch *crossing, double *best)
{
    const double floor = 1e-12 / d->q_max;
    double high = range.high, length = 0.5 * high;
    bool halved = false;
    while (high > range.low) {
        const double low = fmax(high - length, range.low);
        length = high - low;
        const energy_course c = damage_course(d, low, length);
        const double excess = c.log_scale - damage_wanted(d);
        const double here = log(c.value) + excess;
        const double most =
            log(c.value + length * (fmax(0, c.slope) + 0.5 * length * c.curvature)) + excess;
        const bool turns = fabs(c.slope) < length * c.curvature;
        if (turns && !(most <= DBL_EPSILON) && length > fmax(floor, least_stretch * high)) {
            length *= 0.5;
            halved = true;
            continue;
        }
        if (best != NULL && here > 0) {
            *best = low;
            d->level += here;
        } else if (best == NULL && here >= 0) {
            *crossing = (stretch){low, high};
            return true;
        }
        high = low;
        length *= halved ? 1 : 2; /* twice as long was too long here just now */
        halved = false;
    }
    return false;
}

/* The depth at or below `from` where D is highest; its level becomes that of d. */
static double damage_peak(damage *d, double from)
{
    const double end = fmax(from, energy_falling(d->rates->source));
    double depth = end;
    d->level = 0;
    d->level = damage_at(end, d);
    (void)damage_climb(d, (stretch){from, end}, NULL, &depth);
    return depth;
}

/* Deepest place in a range where D is at the level; NaN if there is none. D is below the level at
 * its lower end. */
static wt_status damage_edge(damage *d, stretch range, double level, double *edge, wt_error *err)
{
    stretch s;
    *edge = (double)NAN;
    d->level = level;
    if (!damage_climb(d, range, &s, NULL))
        return WT_OK;
    const bool deeper = damage_at(s.high, d) >= 0; /* by the rounding of where the stretch ends */
    *edge = deeper ? s.high : s.low;
    return !deeper && damage_at(s.low, d) > 0 ? root_find(damage_at, d, s.low, s.high, 0, edge, err)
                                              : WT_OK;
}

/* As damage_climb goes to where D rises above the level, to where it falls below it. */
static bool damage_leave(damage *d, double from, stretch *crossing)
{
    const double floor = 1e-12 / d->q_max;
    double high = from, length = 0.5 * high;
    bool halved = false;
    while (high > 0) {
        const double low = fmax(high - length, 0);
        length = high - low;
        const energy_course c = damage_course(d, low, length);
        const double excess = c.log_scale - damage_wanted(d);
        const double least = c.value - length * (fmax(0, -c.slope) + 0.5 * length * c.curvature);
        const bool turns = fabs(c.slope) < length * c.curvature;
        if (turns && !(least > 0 && log(least) + excess >= 0) &&
            length > fmax(floor, least_stretch * high)) {
            length *= 0.5;
            halved = true;
            continue;
        }
        if (log(c.value) + excess < 0) {
            *crossing = (stretch){low, high};
            return true;
        }
        high = low;
        length *= halved ? 1 : 2; /* twice as long was too long here just now */
        halved = false;
    }
    return false;
}

wt_status damage_band(damage *d, double from, stretch *band, double *above, wt_error *err)
{
    stretch s;
    double upper = 0, lower = 0;
    *above = 0;
    if (!damage_climb(d, (stretch){0, from}, &s, NULL))
        return wt_fail(err, WT_E_NOT_FOUND, "no modified band");
    lower = s.low;
    wt_status status = WT_OK;
    const double inside = s.low;
    if (damage_at(s.low, d) > 0 && damage_at(s.high, d) < 0)
        status = root_find(damage_at, d, s.low, s.high, 0, &lower, err);
    if (status == WT_OK && damage_leave(d, inside, &s)) {
        *above = upper = s.low;
        if (damage_at(s.low, d) < 0 && damage_at(s.high, d) > 0)
            status = root_find(damage_at, d, s.low, s.high, 0, &upper, err);
    }
    *band = (stretch){upper, lower};
    return status;
}

/* How far the edge moves, to other bands too, when D moves by its error. `most`: as deep as it may
 * be. */
static wt_status edge_error(damage *d, double edge, double most, double error, double *reach,
                            wt_error *err)
{
    double least = 0;
    const wt_status status = damage_edge(d, (stretch){0, edge}, error, &least, err);
    *reach = fmax(most - edge, edge - (isnan(least) ? 0 : least)) + 4 * DBL_EPSILON * edge;
    return status;
}

/* Of a profile that falls all the way: one edge, which only goes deeper. */
static wt_status falling_depth(damage *d, double error, double earlier, wt_estimate *thickness,
                               wt_error *err)
{
    const bool none = damage_at(0, d) < 0;
    if (d->rates->without_errors)
        thickness->numerical_error = (double)NAN;
    if (none && d->rates->without_errors)
        return WT_OK;
    if (none) /* perhaps there is a layer all the same */
        d->level = -error;
    if (none && damage_at(0, d) < 0)
        return WT_OK;
    double edge = earlier, step = earlier > 0 ? 0.1 * earlier : 1 / d->rates->q_max;
    stretch s = {earlier, earlier};
    do {
        s.low = s.high;
        s.high += step;
        step *= 2;
    } while (damage_at(s.high, d) >= 0);
    if (damage_at(s.low, d) > 0) { /* but for rounding it is there */
        const wt_status status = root_find(damage_at, d, s.low, s.high, 0, &edge, err);
        if (status != WT_OK)
            return status;
    }
    if (none) {
        thickness->numerical_error = edge;
        return WT_OK;
    }
    thickness->value = edge;
    if (d->rates->without_errors)
        return WT_OK;
    const double lost =
        exp(rates_log_density(d->rates, edge)) - exp(rates_log_density(d->rates, edge + d->way));
    const double reach = error / lost * exp(rates_log_gain(d->rates, edge, d->way));
    thickness->numerical_error = root_reach(
        damage_at, d, edge, error, fmax(2 * DBL_EPSILON * edge, isfinite(reach) ? reach : 0),
        error / d->rates->q_max);
    return WT_OK;
}

wt_status layer_damage_depth(const layer_rates *rates, double time, double earlier,
                             wt_estimate *thickness, wt_error *err)
{
    *thickness = (wt_estimate){.unit = "m"};
    damage d = damage_of(rates, true);
    if (rates->formation == 0 || time == 0)
        return WT_OK;
    const double error = damage_error(rates);
    damage_set_time(&d, time);
    if (rates->background * time >= 1) { /* modified without a load, however deep */
        thickness->value = HUGE_VAL;
        return WT_OK;
    }
    if (energy_falls(rates->source))
        return falling_depth(&d, error, earlier, thickness, err);
    d.level = -error;
    double end = fmax(energy_falling(rates->source), 1 / rates->q_min);
    while (damage_at(end, &d) >= 0)
        end *= 2;
    double most, edge;
    wt_status status = damage_edge(&d, (stretch){0, end}, -error, &most, err);
    if (status != WT_OK || isnan(most))
        return status;
    /* a step deeper, for at the edge itself D may be on either side of its level */
    const stretch range = {0, most * (1 + 4 * DBL_EPSILON) + DBL_MIN};
    status = damage_edge(&d, range, 0, &edge, err);
    if (status != WT_OK)
        return status;
    thickness->value = isnan(edge) ? 0 : edge;
    thickness->numerical_error = rates->without_errors ? (double)NAN : most;
    if (isnan(edge) || rates->without_errors) /* perhaps there is a layer all the same */
        return status;
    return edge_error(&d, edge, most, error, &thickness->numerical_error, err);
}

/* ---- times ----------------------------------------------------------------------------------- */

typedef struct passage {
    damage *d;
    double depth;
} passage;

static double passage_at(double log_time, void *user)
{
    const passage *p = user;
    damage_set_time(p->d, exp(log_time));
    return damage_at(p->depth, p->d);
}

/* ln of the time at which a depth is at the level; infinite if never. */
static wt_status damage_log_time(damage *d, double depth, double level, double *log_time,
                                 wt_error *err)
{
    const layer_rates *r = d->rates;
    d->level = level;
    damage_set_time(d, 1);
    if (!d->worn) {
        const double rate = damage_of_loads(depth, d);
        *log_time = level - (r->background > 0 ? log_add(rate, log(r->background)) : rate);
        return WT_OK;
    }
    passage p = {d, depth};
    /* from a way of the shortest wave to one at whose end the longest has died out */
    const double step = log(4);
    double end = log(1e3 / r->q_min / r->wear);
    if (r->background > 0) /* or to when age alone is enough */
        end = fmax(end, level - log(r->background) + step);
    double low = -log(r->q_max * r->wear);
    *log_time = (double)INFINITY;
    while (passage_at(low, &p) >= 0)
        low -= step;
    double high = low + step;
    while (high < end && passage_at(high, &p) < 0)
        high += step;
    if (passage_at(high, &p) < 0)
        return WT_OK;
    return root_find(passage_at, &p, high - step, high, 0, log_time, err);
}

/* The same of any depth at or below `from`: the time of one place, then of the place where D is
 * highest then, until that is the same place. */
static wt_status damage_first(damage *d, double from, double level, double *log_time, wt_error *err)
{
    wt_status status = damage_log_time(d, from, level, log_time, err);
    if (status == WT_OK && isinf(*log_time)) /* w(0) may be 0, but not where it falls */
        status =
            damage_log_time(d, fmax(from, energy_falling(d->rates->source)), level, log_time, err);
    const double longest = log(DBL_MAX);
    double last = longest;
    while (status == WT_OK && *log_time < last && !energy_falls(d->rates->source)) {
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
    damage d = damage_of(rates, with_wear);
    if (!isfinite(depth.value))
        return WT_OK;
    const double error = damage_error(rates);
    if (rates->formation == 0) {
        if (rates->background > 0) {
            time->value = 1 / rates->background;
            time->numerical_error = rates->without_errors ? (double)NAN : error * time->value;
        }
        return WT_OK;
    }
    const double above = fmax(0, depth.value - depth.numerical_error);
    double log_time = 0, early = 0, late = 0;
    wt_status status = damage_first(&d, depth.value, 0, &log_time, err);
    if (status != WT_OK || isinf(log_time))
        return status;
    time->value = exp(log_time);
    if (rates->without_errors)
        return WT_OK;
    status = damage_first(&d, above, -error, &early, err);
    if (status == WT_OK)
        status = damage_first(&d, depth.value + depth.numerical_error, error, &late, err);
    time->numerical_error = fmax(time->value - exp(early), exp(late) - time->value) +
                            8 * DBL_EPSILON * (1 + fabs(log_time)) * time->value;
    return status;
}
