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
#include "kernel/layer.h"

#include "model/root.h"

#include <float.h>
#include <math.h>

/* Stretches are halved down to this part of their depth; what a maximum gains inside is its square,
 * below rounding. */
static const double least_stretch = 1e-9;

typedef struct damage {
    const layer_rates *rates;
    bool worn;
    double time;
    double way;   /* up to the surface until `time` */
    double level; /* ln(D / Lambda) that is wanted */
} damage;

static damage damage_of(const layer_rates *rates, bool with_wear)
{
    return (damage){.rates = rates, .worn = with_wear && rates->wear > 0};
}

static void damage_set_time(damage *d, double time)
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

/* ln(D / Lambda) above the level. */
static double damage_at(double depth, void *user)
{
    const damage *d = user;
    const wt_energy_source *source = d->rates->source;
    const double energy =
        d->worn ? energy_log_gain(source, depth, d->way) : energy_log_density(source, depth);
    return energy + damage_scale(d) - d->level;
}

/* Relative error of D: of the energy and of the logarithms. */
static double damage_error(const layer_rates *rates)
{
    return rates->source->numerical_error + 16 * DBL_EPSILON * (1 + fabs(rates->threshold));
}

/* A stretch of depth. */
typedef struct stretch {
    double low, high;
} stretch;

/* Goes up from the lower end of `range`, where D is below the level. With `best` NULL to the first
 * stretch at whose lower end D is below and at whose upper end it is not; false if there is none.
 * Else all the way, for the depth *best where D is highest, to which the level is set. */
static bool damage_climb(damage *d, stretch range, stretch *crossing, double *best)
{
    const double scale = damage_scale(d);
    const double floor = 1e-12 / d->rates->q_max;
    double high = range.high, length = 0.5 * high;
    while (high > range.low) {
        const double low = fmax(high - length, range.low);
        length = high - low;
        const energy_course c = energy_course_at(d->rates->source, low, d->way, length);
        const double excess = scale + c.log_scale - d->level;
        const double here = log(c.value) + excess;
        const double most =
            log(c.value + length * (fmax(0, c.slope) + 0.5 * length * c.curvature)) + excess;
        const bool turns = fabs(c.slope) < length * c.curvature;
        if (turns && !(most <= DBL_EPSILON) && length > fmax(floor, least_stretch * high)) {
            length *= 0.5;
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
        length *= 2;
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
    const wt_energy_source *source = d->rates->source;
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
        exp(energy_log_density(source, edge)) - exp(energy_log_density(source, edge + d->way));
    const double reach = error / lost * exp(energy_log_gain(source, edge, d->way));
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
        *log_time = -damage_at(depth, d);
        return WT_OK;
    }
    passage p = {d, depth};
    /* from a way of the shortest wave to one at whose end the longest has died out */
    const double step = log(4), end = log(1e3 / r->q_min / r->wear);
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
    if (rates->formation == 0 || !isfinite(depth.value))
        return WT_OK;
    const double error = damage_error(rates);
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
