/* Damage through successive loads. Each load adds the integral of its rate along the path of the
 * rubber during the load. The modified bands are the depths at which the sum reaches the threshold.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_damage_bands.h"

#include "core/base/param.h"
#include "core/math/root.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Step relative to the depth for the slope that converts an error of the damage to that of an edge.
 */
static const double slope_step = 1e-6;

/* ---- loads ----------------------------------------------------------------------------------- */

void layer_loads_clear(layer_loads *loads)
{
    free(loads->rates);
    free(loads->past);
    free(loads->begin);
    *loads = (layer_loads){0};
}

static wt_status check_stage(const wt_layer_load *stages, size_t i, wt_error *err)
{
    const wt_layer_load *s = &stages[i];
    wt_status status = WT_OK;
    if (!(s->duration >= 0) || !isfinite(s->duration))
        status = range_error("duration of a stage", s->duration, "finite and >= 0 s", err);
    else if (s->source != NULL && (s->source->profile != stages->source->profile ||
                                   s->source->local_friction != stages->source->local_friction))
        status = wt_fail(err, WT_E_ARG, "the stages of a layer have different depth profiles");
    if (status != WT_OK)
        wt_error_place(err, "stage %zu", i + 1);
    return status;
}

static void include_load_range(layer_loads *loads, const layer_rates *r)
{
    if (!(r->q_max > 0))
        return;
    loads->q_min = loads->q_max > 0 ? fmin(loads->q_min, r->q_min) : r->q_min;
    loads->q_max = fmax(loads->q_max, r->q_max);
    loads->falling = fmax(loads->falling, energy_monotonic_depth(r->source));
    loads->error = fmax(loads->error, damage_error(r));
}

wt_status layer_loads_create(const wt_layer_load *stages, size_t n, layer_loads *loads,
                             wt_error *err)
{
    if (stages == NULL || n == 0 || stages->source == NULL)
        return wt_fail(err, WT_E_ARG, "the loads of a layer need one stage at least");
    *loads = (layer_loads){.n = n,
                           .rates = wt_alloc(n, sizeof *loads->rates),
                           .past = wt_alloc(n, sizeof *loads->past),
                           .begin = wt_alloc(n, sizeof *loads->begin),
                           .start = stages->parameters.start_thickness,
                           .falls = energy_is_monotonic(stages->source)};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        wt_layer_parameters p = stages[i].parameters;
        p.incubation = true; /* damage is transported */
        status = check_stage(stages, i, err);
        if (status == WT_OK)
            status = layer_rates_compute(stages[i].source, &p, &loads->rates[i], err);
        if (status != WT_OK)
            break;
        include_load_range(loads, &loads->rates[i]);
        if (i + 1 < n)
            loads->begin[i + 1] = loads->begin[i] + stages[i].duration;
    }
    if (status != WT_OK)
        layer_loads_clear(loads);
    return status;
}

damage layer_loads_damage(layer_loads *loads, double time, double *worn)
{
    size_t now = 0;
    while (now + 1 < loads->n && loads->begin[now + 1] <= time)
        now++;
    damage d = damage_create(&loads->rates[now], true);
    damage_set_time(&d, time - loads->begin[now]);
    d.q_max = loads->q_max;
    d.past = loads->past;
    *worn = d.worn_depth;
    double since = 0; /* depth worn off up to the present load [m] */
    for (size_t i = now; i-- > 0;) {
        const layer_rates *r = &loads->rates[i];
        damage before = damage_create(r, true);
        damage_set_time(&before, loads->begin[i + 1] - loads->begin[i]);
        if (r->formation > 0 && before.time > 0) {
            loads->past[d.n_past] = damage_load_create(&before);
            loads->past[d.n_past++].worn = since;
        }
        since += before.worn_depth;
    }
    *worn += since;
    return d;
}

/* ---- bands ----------------------------------------------------------------------------------- */

/* Edge with its error, from the error of the damage. */
static wt_estimate edge_with_error(damage *d, double edge, double error)
{
    wt_estimate e = {.value = edge, .unit = "m"};
    const double step = slope_step * edge;
    const double slope =
        step > 0 ? (damage_excess(edge + step, d) - damage_excess(edge, d)) / step : 0;
    if (edge > 0)
        e.numerical_error = error / fabs(slope) + 4 * DBL_EPSILON * edge;
    return e;
}

static void add_band(wt_layer_section *s, wt_layer_band band)
{
    if (s->n < WT_LAYER_MAX_BANDS)
        s->band[s->n] = band;
    s->n++;
}

/* Returns a depth below all bands. */
static double depth_below_bands(const layer_loads *loads, damage *d)
{
    double end = fmax(loads->falling, 1 / loads->q_min);
    while (damage_excess(end, d) >= 0)
        end *= 2;
    return end;
}

static wt_status add_monotonic_band(const layer_loads *loads, damage *d, wt_layer_section *section,
                                    wt_error *err)
{
    double edge = 0;
    if (damage_excess(0, d) < 0)
        return WT_OK;
    const double end = depth_below_bands(loads, d);
    const wt_status status =
        damage_excess(0, d) > 0 ? root_find(damage_excess, d, 0, end, 0, &edge, err) : WT_OK;
    add_band(section, (wt_layer_band){.upper = {.unit = "m"},
                                      .lower = edge_with_error(d, edge, loads->error)});
    return status;
}

static wt_status find_bands(const layer_loads *loads, damage *d, wt_layer_section *section,
                            wt_error *err)
{
    double from = depth_below_bands(loads, d);
    while (from > 0) {
        depth_interval band;
        const wt_status status = damage_band(d, from, &band, &from, NULL);
        if (status == WT_E_NOT_FOUND)
            break;
        if (status != WT_OK)
            return wt_fail(err, status, "the edges of a modified band cannot be found");
        add_band(section, (wt_layer_band){edge_with_error(d, band.low, loads->error),
                                          edge_with_error(d, band.high, loads->error)});
    }
    return WT_OK;
}

/* Adds the old layer from the surface to a depth, and removes the bands that it covers. */
static void add_old_layer(wt_layer_section *s, double depth)
{
    wt_layer_band old = {{.unit = "m"},
                         {.value = depth, .numerical_error = 4 * DBL_EPSILON * depth, .unit = "m"}};
    if (!(depth > 0) || s->n > WT_LAYER_MAX_BANDS)
        return;
    while (s->n > 0 && s->band[s->n - 1].upper.value <= depth) {
        if (s->band[s->n - 1].lower.value > depth)
            old.lower = s->band[s->n - 1].lower;
        s->n--;
    }
    add_band(s, old);
}

/* Section for damage that falls with depth, where the value at the surface decides if there is a
 * band. */
static wt_status falling(const layer_loads *loads, damage *d, bool edges, wt_layer_section *section,
                         wt_error *err)
{
    if (edges)
        return add_monotonic_band(loads, d, section, err);
    if (damage_excess(0, d) >= 0)
        add_band(section, (wt_layer_band){{.unit = "m"}, {.unit = "m"}});
    return WT_OK;
}

static wt_status compute_section(layer_loads *loads, double time, bool edges,
                                 wt_layer_section *section, wt_error *err)
{
    wt_layer_section s = {.time = time};
    damage d = layer_loads_damage(loads, time, &s.worn);
    const bool any = d.n_past > 0 || (d.rates->formation > 0 && d.time > 0);
    wt_status status = WT_OK;
    if (any)
        status = loads->falls ? falling(loads, &d, edges, &s, err) : find_bands(loads, &d, &s, err);
    add_old_layer(&s, loads->start - s.worn);
    *section = s;
    return status;
}

wt_status layer_section_compute(layer_loads *loads, double time, wt_layer_section *section,
                                wt_error *err)
{
    return compute_section(loads, time, true, section, err);
}

wt_status layer_section_bands(layer_loads *loads, double time, wt_layer_section *section,
                              wt_error *err)
{
    return compute_section(loads, time, false, section, err);
}

wt_status wt_layer_sections(const wt_layer_load *stages, size_t n_stages, const double *time,
                            size_t n, wt_layer_section *sections, wt_error *err)
{
    layer_loads loads = {0};
    if (n > 0 && (time == NULL || sections == NULL))
        return wt_fail(err, WT_E_ARG, "the sections of a layer need times and a place for them");
    wt_status status = layer_times_check(time, n, err);
    if (status == WT_OK)
        status = layer_loads_create(stages, n_stages, &loads, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = layer_section_compute(&loads, time[i], &sections[i], err);
    layer_loads_clear(&loads);
    return status;
}

wt_status wt_layer_damage(const wt_layer_load *stages, size_t n_stages, double time, double depth,
                          double *amount, wt_error *err)
{
    layer_loads loads = {0};
    if (amount == NULL || !(depth >= 0))
        return wt_fail(err, WT_E_ARG, "a damage needs a depth and a place for it");
    wt_status status = layer_times_check(&time, 1, err);
    if (status == WT_OK)
        status = layer_loads_create(stages, n_stages, &loads, err);
    if (status == WT_OK) {
        double worn;
        damage d = layer_loads_damage(&loads, time, &worn);
        const bool any = d.n_past > 0 || (d.rates->formation > 0 && d.time > 0);
        *amount = any ? exp(damage_log_total(depth, &d)) : 0;
    }
    layer_loads_clear(&loads);
    return status;
}
