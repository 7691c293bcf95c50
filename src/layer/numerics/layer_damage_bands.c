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
#include <stdint.h>
#include <stdlib.h>

/* Times per decade. Successive times differ by a factor of 1.009, less than the distance of events
 * that cancel each other. For successive loads, each of which is followed from its start, it is
 * 1.037. For the first event alone, which nothing cancels immediately, it is 1.15. */
static const double times_per_decade = 256, times_several_loads = 64, times_first_event = 16;

/* Relative tolerance of the time of the first event, which replicates use. */
static const double first_tolerance = 1e-7;

/* Relative time before and after an event at which the bands are wider than rounding. */
static const double event_margin = 1e-9;

/* First time of a load that follows another one, relative to the smallest of its duration, the time
 * before it and its own incubation time. */
static const double first_part = 1e-4;

/* The search ends when this multiple of the longest wave has been worn off, */
static const double longest_waves = 20;

/* or, without wear, at this multiple of the time of the first event. */
static const double last_without_wear = 1e6;

typedef struct event_search {
    layer_loads *loads;
    wt_layer_event *events;
    size_t most, n, stop_count; /* stop after this number of events */
    double per_decade, closest; /* times per decade; relative tolerance of an event */
    wt_layer_section before;    /* section at the last time */
} event_search;

static bool touches_surface(const wt_layer_section *s)
{
    return s->n > 0 && s->n <= WT_LAYER_MAX_BANDS && !(s->band[s->n - 1].upper.value > 0);
}

static bool has_same_bands(const wt_layer_section *a, const wt_layer_section *b)
{
    return a->n == b->n && touches_surface(a) == touches_surface(b);
}

static double damage_slope(double depth, void *user)
{
    return damage_expand(user, depth, 0).slope;
}

/* Depth between two limits at which the damage is stationary. */
static double stationary_depth(event_search *s, double time, double low, double high)
{
    double worn, depth = 0.5 * (low + high);
    damage d = layer_loads_damage(s->loads, time, &worn);
    if (damage_slope(low, &d) * damage_slope(high, &d) < 0 &&
        root_find(damage_slope, &d, low, high, 0, &depth, NULL) != WT_OK)
        depth = 0.5 * (low + high);
    return depth;
}

/* Returns the index of the band of `more` that `fewer` does not contain; both begin with the
 * deepest. */
static size_t unmatched_band(const wt_layer_section *fewer, const wt_layer_section *more)
{
    for (size_t i = 0; i < fewer->n; i++)
        if (more->band[i].lower.value < fewer->band[i].upper.value ||
            more->band[i].upper.value > fewer->band[i].lower.value)
            return i;
    return fewer->n;
}

/* Adds the event that distinguishes two sections at a time. */
static void add_event(event_search *s, double time, const wt_layer_section *b,
                      const wt_layer_section *after)
{
    wt_layer_event e = {WT_LAYER_SURFACE_REACHED, time, 0};
    if (after->n > b->n && after->n <= WT_LAYER_MAX_BANDS) {
        const wt_layer_band *band = &after->band[unmatched_band(b, after)];
        e.kind = band->upper.value > 0 ? WT_LAYER_BAND_ONSET : WT_LAYER_SURFACE_ONSET;
        if (band->upper.value > 0)
            e.depth = stationary_depth(s, time, band->upper.value, band->lower.value);
    } else if (after->n < b->n && b->n <= WT_LAYER_MAX_BANDS) {
        const size_t lost_band = unmatched_band(after, b);
        const bool merged = lost_band > 0 &&
                            after->band[lost_band - 1].upper.value < b->band[lost_band].lower.value;
        e.kind = merged ? WT_LAYER_BANDS_MERGE : WT_LAYER_WORN_OFF;
        if (merged)
            e.depth = stationary_depth(s, time, b->band[lost_band].lower.value,
                                       b->band[lost_band - 1].upper.value);
    }
    if (s->n < s->most)
        s->events[s->n] = e;
    s->n++;
}

/* Locates the event between the previous time and a later one to the tolerance. */
static wt_status locate_event(event_search *s, double later, wt_error *err)
{
    double low = s->before.time, high = later;
    wt_layer_section early = {0}, late = {0};
    wt_status status = WT_OK;
    while (status == WT_OK && high > low * (1 + s->closest)) {
        wt_layer_section middle;
        status = layer_section_bands(s->loads, 0.5 * (low + high), &middle, err);
        if (status == WT_OK && has_same_bands(&s->before, &middle))
            low = middle.time;
        else
            high = middle.time;
    }
    if (status == WT_OK)
        status = layer_section_bands(s->loads, low * (1 - event_margin), &early, err);
    if (status == WT_OK)
        status = layer_section_bands(s->loads, high * (1 + event_margin), &late, err);
    if (status == WT_OK && !has_same_bands(&early, &late))
        add_event(s, high, &early, &late);
    s->before = late;
    return status;
}

/* Adds all events up to a time. */
static wt_status search_step(event_search *s, double time, wt_error *err)
{
    wt_layer_section end;
    wt_status status = layer_section_bands(s->loads, time, &end, err);
    while (status == WT_OK && s->before.time < time && !has_same_bands(&s->before, &end))
        status = locate_event(s, time, err);
    s->before = end;
    return status;
}

/* Searches from `first` to `last` after the start of a load. */
static wt_status search_time_range(event_search *s, double begin, double first, double last,
                                   wt_error *err)
{
    const double factor = pow(10, 1 / s->per_decade);
    double time = first / factor;
    wt_status status = WT_OK;
    if (begin == 0)
        status = layer_section_bands(s->loads, time, &s->before, err);
    while (status == WT_OK && time < last && s->n < s->stop_count) {
        time = fmin(time * factor, last);
        status = search_step(s, begin + time, err);
    }
    return status;
}

/* Searches one load; `first` is its own incubation time, NaN if infinite. */
static wt_status search_load(event_search *s, size_t i, double first, wt_error *err)
{
    const layer_loads *loads = s->loads;
    const double begin = loads->begin[i], wear = loads->rates[i].wear;
    const bool is_last = i + 1 == loads->n, alone = begin == 0;
    double last = is_last ? HUGE_VAL : loads->begin[i + 1] - begin;
    if (is_last)
        last = wear > 0    ? fmax(longest_waves / (loads->q_min * wear), first > 0 ? 2 * first : 0)
               : first > 0 ? last_without_wear * first
                           : 0;
    if (alone)
        return first > 0 && first < last ? search_time_range(s, 0, first, last, err) : WT_OK;
    const double scale = fmin(fmin(last, begin), first > 0 ? first : HUGE_VAL);
    return scale > 0 ? search_time_range(s, begin, first_part * scale, last, err) : WT_OK;
}

static wt_status search_events(const wt_layer_load *stages, size_t n_stages, size_t stop_count,
                               wt_layer_event *events, size_t most, size_t *n, wt_error *err)
{
    layer_loads loads = {0};
    const bool first_alone = stop_count == 1;
    event_search s = {.loads = &loads,
                      .events = events,
                      .most = most,
                      .stop_count = stop_count,
                      .per_decade = first_alone    ? times_first_event
                                    : n_stages > 1 ? times_several_loads
                                                   : times_per_decade,
                      .closest = first_alone ? first_tolerance : 2 * DBL_EPSILON};
    wt_status status = layer_loads_create(stages, n_stages, &loads, err);
    loads.start = 0; /* the events are those of bare rubber */
    for (size_t i = 0; status == WT_OK && i < n_stages && s.n < stop_count; i++) {
        wt_estimate first = {.value = (double)NAN};
        status = layer_damage_time(&loads.rates[i], true, (wt_estimate){.unit = "m"}, &first, err);
        if (status == WT_OK)
            status = search_load(&s, i, first.value, err);
    }
    layer_loads_clear(&loads);
    *n = s.n;
    return status;
}

wt_status wt_layer_load_events(const wt_layer_load *stages, size_t n_stages, wt_layer_event *events,
                               size_t most, size_t *n, wt_error *err)
{
    if (stages == NULL || n == NULL || (most > 0 && events == NULL))
        return wt_fail(err, WT_E_ARG, "the events of a layer need loads and a place for them");
    return search_events(stages, n_stages, SIZE_MAX, events, most, n, err);
}

wt_status wt_layer_first_event(const wt_layer_load *stages, size_t n_stages, wt_layer_event *event,
                               wt_error *err)
{
    size_t n = 0;
    if (stages == NULL || event == NULL)
        return wt_fail(err, WT_E_ARG, "the first event of a layer needs loads and a place for it");
    const wt_status status = search_events(stages, n_stages, 1, event, 1, &n, err);
    if (status == WT_OK && n == 0)
        *event = (wt_layer_event){WT_LAYER_BAND_ONSET, (double)NAN, (double)NAN};
    return status;
}

wt_status wt_layer_events(const wt_energy_source *source, const wt_layer_parameters *parameters,
                          wt_layer_event *events, size_t most, size_t *n, wt_error *err)
{
    if (parameters == NULL)
        return wt_fail(err, WT_E_ARG, "the events of a layer need parameters");
    const wt_layer_load stage = {.source = source, .parameters = *parameters};
    return wt_layer_load_events(&stage, 1, events, most, n, err);
}

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
