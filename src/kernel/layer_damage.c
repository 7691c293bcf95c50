/* Damage transport, D_t = Qw D_z + Omega: exact at constant load for any profile, because the
 * damage at depth z is what the material gathered on its way up from z + Qw t: D(z, t) = [int_z^(z
 * + Qw t) w dz] / (U_c k sigma0 v),  or w(z) t / U_c without wear. The layer reaches to the deepest
 * z with D = Lambda. A profile that peaks below the surface first makes a buried band.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/layer.h"

#include "kernel/root.h"

#include <float.h>
#include <math.h>

/* Depths are scanned in steps of this ratio for the highest and the deepest damage. */
static const double scan_ratio = 1.2;

typedef struct damage {
    const layer_rates *rates;
    double time;
} damage;

/* ln(D / Lambda) at a depth. */
static double damage_at(double depth, void *user)
{
    const damage *d = user;
    const layer_rates *r = d->rates;
    if (r->wear > 0)
        return energy_log_gain(r->source, depth, r->wear * d->time) - r->threshold -
               log(r->wear / r->duty);
    return energy_log_density(r->source, depth) + log(r->duty * d->time) - r->threshold;
}

/* Largest value of D at any depth and its depth: a scan, then bisection of the ratio around the
 * best. At the surface for a falling profile. */
static double damage_peak(damage *d, double *depth)
{
    *depth = 0;
    double best = damage_at(0, d);
    if (energy_falls(d->rates->source))
        return best;
    const double last = 4 / d->rates->q_min;
    for (double z = 1e-3 / d->rates->q_max; z < last; z *= scan_ratio) {
        const double value = damage_at(z, d);
        if (value > best) {
            best = value;
            *depth = z;
        }
    }
    if (*depth == 0)
        return best;
    double low = *depth / scan_ratio, high = *depth * scan_ratio;
    const double golden = 0.6180339887498949;
    while (high - low > 1e-8 * high) { /* the peak is flat: its value is good to the square */
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);
        if (damage_at(a, d) < damage_at(b, d))
            low = a;
        else
            high = b;
    }
    *depth = 0.5 * (low + high);
    return damage_at(*depth, d);
}

/* A depth below which D < Lambda. */
static double damage_end(damage *d)
{
    double depth = 1 / d->rates->q_min;
    while (damage_at(depth, d) >= 0)
        depth *= 2;
    return depth;
}

static double depth_error(damage *d, double root)
{
    const double error =
        d->rates->source->numerical_error + 16 * DBL_EPSILON * (1 + fabs(d->rates->threshold));
    return root_reach(damage_at, d, root, error, 2 * DBL_EPSILON * root, error / d->rates->q_max);
}

wt_status layer_damage_depth(const layer_rates *rates, double time, wt_estimate *thickness,
                             wt_error *err)
{
    *thickness = (wt_estimate){.unit = "m"};
    damage d = {.rates = rates, .time = time};
    if (rates->formation == 0 || time == 0)
        return WT_OK;
    double high = damage_end(&d), low = 0;
    bool found = false;
    if (!energy_falls(rates->source))
        for (double z = high / scan_ratio; !found && z > 1e-3 / rates->q_max; z /= scan_ratio) {
            found = damage_at(z, &d) >= 0;
            if (found)
                low = z;
            else
                high = z;
        }
    if (!found) { /* between the steps of the scan, or at the surface, or nowhere */
        if (damage_peak(&d, &low) < 0)
            return WT_OK;
        high = fmax(low * scan_ratio, high);
    }
    wt_status status = WT_OK;
    if (damage_at(low, &d) > 0)
        status = root_find(damage_at, &d, low, high, &thickness->value, err);
    else
        thickness->value = low;
    if (status == WT_OK)
        thickness->numerical_error = depth_error(&d, thickness->value);
    return status;
}

/* ln of the highest D / Lambda against ln of the time. */
static double peak_at(double log_time, void *user)
{
    damage *d = user;
    double depth;
    d->time = exp(log_time);
    return damage_peak(d, &depth);
}

wt_status layer_incubation(const layer_rates *rates, bool with_wear, double *time, wt_error *err)
{
    *time = (double)NAN;
    const bool worn = with_wear && rates->wear > 0;
    if (rates->formation == 0 || (worn && !(rates->log_ratio > 0)))
        return WT_OK;
    layer_rates unworn = *rates;
    unworn.wear = 0;
    damage d = {.rates = &unworn, .time = 1};
    double depth;
    const double first = -damage_peak(&d, &depth); /* ln of the time without wear */
    if (!worn) {
        *time = exp(first);
        return WT_OK;
    }
    d.rates = rates;
    double high = first;
    for (int i = 0; i < 200 && peak_at(high, &d) < 0; i++)
        high += 0.5;
    if (peak_at(high, &d) < 0) /* R is 1 up to rounding */
        return WT_OK;
    double log_time = first;
    wt_status status = WT_OK;
    if (high > first)
        status = root_find(peak_at, &d, first, high, &log_time, err);
    if (status == WT_OK)
        *time = exp(log_time);
    return status;
}
