/* When the modified bands of a constant load begin, reach the surface and merge: the number of
 * bands is followed over close times, and where it changes the time is found by halves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/layer_bands.h"

#include "model/root.h"

#include <float.h>
#include <math.h>

/* Two times are a factor of 1.009 apart, closer than events that do not undo each other. */
static const double times_per_decade = 256;
/* So long before and after an event the bands are wide enough to be more than rounding. */
static const double settled = 1e-9;
/* Events are over when so many times the longest wave has been worn off, */
static const double longest_waves = 20;
/* or, without wear, so many times the time of the first. */
static const double last_without_wear = 1e6;

typedef struct event_search {
    layer_loads *loads;
    wt_layer_event *events;
    size_t most, n;
    wt_layer_section before; /* at the last time looked at */
} event_search;

static bool touches(const wt_layer_section *s)
{
    return s->n > 0 && s->n <= WT_LAYER_BANDS && !(s->band[s->n - 1].upper.value > 0);
}

static bool same_bands(const wt_layer_section *a, const wt_layer_section *b)
{
    return a->n == b->n && touches(a) == touches(b);
}

static double slope_at(double depth, void *user)
{
    return damage_course(user, depth, 0).slope;
}

/* Where the damage is stationary between two depths. */
static double stationary(event_search *s, double time, double low, double high)
{
    double worn, depth = 0.5 * (low + high);
    damage d = layer_loads_at(s->loads, time, &worn);
    if (slope_at(low, &d) * slope_at(high, &d) < 0 &&
        root_find(slope_at, &d, low, high, 0, &depth, NULL) != WT_OK)
        depth = 0.5 * (low + high);
    return depth;
}

/* The band of `more` that is not in `fewer`, both from the deepest on. */
static size_t new_band(const wt_layer_section *fewer, const wt_layer_section *more)
{
    for (size_t i = 0; i < fewer->n; i++)
        if (more->band[i].lower.value < fewer->band[i].upper.value ||
            more->band[i].upper.value > fewer->band[i].lower.value)
            return i;
    return fewer->n;
}

/* What happened at a time between two sections. */
static void event_add(event_search *s, double time, const wt_layer_section *b,
                      const wt_layer_section *after)
{
    wt_layer_event e = {WT_LAYER_SURFACE_REACHED, time, 0};
    if (after->n > b->n && after->n <= WT_LAYER_BANDS) {
        const wt_layer_band *band = &after->band[new_band(b, after)];
        e.kind = band->upper.value > 0 ? WT_LAYER_BAND_ONSET : WT_LAYER_SURFACE_ONSET;
        if (band->upper.value > 0)
            e.depth = stationary(s, time, band->upper.value, band->lower.value);
    } else if (after->n < b->n && b->n <= WT_LAYER_BANDS) {
        const size_t gone = new_band(after, b);
        e.kind = WT_LAYER_BANDS_MERGE;
        e.depth = stationary(s, time, b->band[gone].lower.value, b->band[gone - 1].upper.value);
    }
    if (s->n < s->most)
        s->events[s->n] = e;
    s->n++;
}

/* The event between the time before and a later one, to the last digits. */
static wt_status event_find(event_search *s, double later, wt_error *err)
{
    double low = s->before.time, high = later;
    wt_layer_section early = {0}, late = {0};
    wt_status status = WT_OK;
    while (status == WT_OK && high > low * (1 + 2 * DBL_EPSILON)) {
        wt_layer_section middle;
        status = layer_section_at(s->loads, 0.5 * (low + high), &middle, err);
        if (status == WT_OK && same_bands(&s->before, &middle))
            low = middle.time;
        else
            high = middle.time;
    }
    if (status == WT_OK)
        status = layer_section_at(s->loads, low * (1 - settled), &early, err);
    if (status == WT_OK)
        status = layer_section_at(s->loads, high * (1 + settled), &late, err);
    if (status == WT_OK && !same_bands(&early, &late))
        event_add(s, high, &early, &late);
    s->before = late;
    return status;
}

/* All changes up to a time. */
static wt_status events_until(event_search *s, double time, wt_error *err)
{
    wt_layer_section end;
    wt_status status = layer_section_at(s->loads, time, &end, err);
    while (status == WT_OK && s->before.time < time && !same_bands(&s->before, &end))
        status = event_find(s, time, err);
    s->before = end;
    return status;
}

wt_status wt_layer_events(const wt_energy_source *source, const wt_layer_parameters *parameters,
                          wt_layer_event *events, size_t most, size_t *n, wt_error *err)
{
    layer_loads loads = {0};
    if (parameters == NULL || n == NULL || (most > 0 && events == NULL))
        return wt_fail(err, WT_E_ARG, "the events of a layer need parameters and a place for them");
    wt_layer_stage stage = {.source = source, .parameters = *parameters};
    stage.parameters.start_thickness = 0;
    event_search s = {.loads = &loads, .events = events, .most = most};
    wt_estimate first = {.value = (double)NAN};
    wt_status status = layer_loads_make(&stage, 1, &loads, err);
    if (status == WT_OK)
        status = layer_damage_time(loads.rates, true, (wt_estimate){.unit = "m"}, &first, err);
    if (status == WT_OK && first.value > 0) {
        const double wear = loads.rates->wear;
        const double last = wear > 0 ? fmax(longest_waves / (loads.q_min * wear), 2 * first.value)
                                     : last_without_wear * first.value;
        const double factor = pow(10, 1 / times_per_decade);
        double time = first.value / factor;
        status = layer_section_at(&loads, time, &s.before, err);
        while (status == WT_OK && time < last)
            status = events_until(&s, time *= factor, err);
    }
    layer_loads_clear(&loads);
    *n = s.n;
    return status;
}
