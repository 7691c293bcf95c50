/* Times at which the modified bands of successive loads begin, reach the surface, merge or are worn
 * off. The number of bands is followed over close times; each change is located by bisection.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_damage_bands.h"

#include "core/math/root.h"

#include <float.h>
#include <math.h>
#include <stdint.h>

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
