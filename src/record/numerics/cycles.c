/* Division of a friction record into cycles, and means over the cycles.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "record/numerics/strokes.h"
#include "weartrack/core.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

/* Limit of the number of time spans. A change is then located to 0.1 % of the record. */
static const double most_spans = 1000;
/* Each span holds a sample anywhere in the record except in the longest pauses, which take this
 * share of it. */
static const double pauses = 0.01;
/* Fraction of the fastest sample of a cycle. Slower samples are at rest except for noise of the
 * speed. */
static const double at_rest = 0.01;

/* ---- friction of each sample ----------------------------------------------------------------- */

static bool has_both_signs(const double *x, size_t n)
{
    size_t below = 0, above = 0;
    for (size_t i = 0; x != NULL && i < n; i++) {
        below += x[i] < 0;
        above += x[i] > 0;
    }
    return 10 * below > n && 10 * above > n; /* 10 % exceeds scatter about 0 */
}

/* The coefficient of the file is used unless it lost the sign that the force has. */
static wt_status sample_friction(const wt_record *record, double load, double *friction,
                                 wt_cycles *cycles, wt_error *err)
{
    const double *const given = record->channel[WT_RECORD_COEFFICIENT],
                        *const force = record->channel[WT_RECORD_FRICTION_FORCE];
    const double *const loads = record->channel[WT_RECORD_NORMAL_FORCE];
    const bool has_load = loads != NULL || load > 0,
               by_force = force != NULL && has_load &&
                          (given == NULL ||
                           (has_both_signs(force, record->n) && !has_both_signs(given, record->n)));
    if (given == NULL && force == NULL && record->channel[WT_RECORD_TORQUE] != NULL) {
        const wt_status status =
            wt_fail(err, WT_E_MISSING, "friction as a torque without a radius");
        wt_error_expected(err, "the radius of the track, at which the friction force acts");
        wt_error_advice(err, "give it: weartrack record --track-radius 10mm, or <track-radius> in "
                             "the <record> of a case");
        return status;
    }
    if (given == NULL && !by_force) {
        const wt_status status = wt_fail(err, WT_E_MISSING, "a friction force without a load");
        wt_error_expected(err, "a column of the normal force or of the friction coefficient");
        wt_error_advice(err, "give the load: weartrack record --load 5N, or <load> in the "
                             "<record> of a case");
        return status;
    }
    for (size_t i = 0; i < record->n; i++) {
        const double normal = loads != NULL ? loads[i] : load,
                     ratio = force != NULL && normal > 0 ? force[i] / normal : (double)NAN;
        friction[i] = by_force ? ratio : given[i];
        cycles->n_unloaded += by_force && normal <= 0;
        if (given != NULL)
            cycles->difference = fmax(cycles->difference, fabs(fabs(given[i]) - fabs(ratio)));
    }
    return WT_OK;
}

/* ---- selection of cycles --------------------------------------------------------------------- */

/* Returns the first channel that increases through the record. */
static const double *progress_channel(const wt_record *record)
{
    static const wt_record_channel order[] = {WT_RECORD_TIME, WT_RECORD_DISTANCE, WT_RECORD_LAPS};
    for (size_t i = 0; i < COUNT_OF(order); i++)
        if (record->channel[order[i]] != NULL)
            return record->channel[order[i]];
    return NULL;
}

static double lap_position(const wt_record *record, double radius, size_t i)
{
    const double *const laps = record->channel[WT_RECORD_LAPS],
                        *const distance = record->channel[WT_RECORD_DISTANCE];
    if (laps != NULL)
        return laps[i];
    return distance != NULL ? distance[i] / (2 * M_PI * radius) : (double)NAN;
}

static bool same_step(const wt_record *record, size_t i)
{
    return i < record->n && record->step[i] == record->step[i - 1];
}

/* Finds complete laps. The last lap of a step is incomplete, and the first one unless the step
 * begins with it. */
static void find_laps(const wt_record *record, double radius, cycle_spans *spans)
{
    for (size_t first = 0, end; first < record->n; first = end) {
        const double lap = floor(lap_position(record, radius, first));
        for (end = first + 1;
             same_step(record, end) && floor(lap_position(record, radius, end)) <= lap;)
            end++;
        const double spacing = end > first + 1 ? lap_position(record, radius, first + 1) -
                                                     lap_position(record, radius, first)
                                               : 0;
        const bool begins = (first > 0 && same_step(record, first)) ||
                            lap_position(record, radius, first) - lap <= 1.5 * spacing;
        if (begins && same_step(record, end) && !isnan(lap))
            spans->span[spans->n++] = (cycle_span){first, first, end};
    }
}

/* Returns a span that holds at least one sample: longer than all sampling intervals except pauses.
 * `steps`: [n] scratch. */
static double choose_span(const double *x, size_t n, double *steps)
{
    const double all = x[n - 1] - x[0];
    double sum = 0;
    for (size_t i = 1; i < n; i++)
        steps[i - 1] = x[i] - x[i - 1];
    numbers_sort(steps, n - 1);
    size_t i = 0;
    while (i + 1 < n - 1 && (sum += steps[i]) < (1 - pauses) * all)
        i++;
    return fmax(steps[i], all / most_spans);
}

static void find_time_spans(const wt_record *record, double *scratch, cycle_spans *spans)
{
    const double *const x = progress_channel(record);
    const double width = record->n > 1 ? choose_span(x, record->n, scratch) : 1;
    for (size_t first = 0, end; first < record->n; first = end) {
        /* the tolerance keeps equal sampling intervals from rounding to either side */
        for (end = first + 1; same_step(record, end) && !(x[end] - x[first] > 0.999 * width);)
            end++;
        spans->span[spans->n++] = (cycle_span){first, first, end};
    }
}

static void find_cycles(const wt_record *record, wt_cycle_kind kind, double radius,
                        const double *friction, double *scratch, cycle_spans *spans)
{
    spans->n = 0;
    switch (kind) {
    case WT_CYCLE_STROKE:
        strokes_find(record, friction, spans);
        break;
    case WT_CYCLE_LAP:
        find_laps(record, radius, spans);
        break;
    case WT_CYCLE_TIME:
        find_time_spans(record, scratch, spans);
        break;
    default:
        for (; spans->n < record->n; spans->n++)
            spans->span[spans->n] = (cycle_span){spans->n, spans->n, spans->n + 1};
    }
}

static wt_status choose_cycles(const wt_record *record, wt_cycle_kind wanted, double radius,
                               const double *friction, double *scratch, cycle_spans *spans,
                               wt_cycle_kind *kind, wt_error *err)
{
    enum { FEWEST = 3 }; /* fewer are not a series */
    for (*kind = WT_CYCLE_STROKE; *kind <= WT_CYCLE_SAMPLE; ++*kind) {
        if (wanted != WT_CYCLE_AUTO && *kind != wanted)
            continue;
        find_cycles(record, *kind, radius, friction, scratch, spans);
        if (spans->n >= FEWEST || *kind == WT_CYCLE_SAMPLE ||
            (*kind == WT_CYCLE_TIME && spans->n > 0))
            return WT_OK;
    }
    const wt_status status = wt_fail(err, WT_E_MISSING,
                                     "the record does not contain three "
                                     "whole %s",
                                     wanted == WT_CYCLE_LAP ? "laps" : "double strokes");
    wt_error_expected(err, wanted == WT_CYCLE_LAP
                               ? "a column of laps, or of distance and the radius of the track"
                               : "a column of the position, or friction that changes its sign");
    return status;
}

/* Friction of sliding exists only during motion: the function trims samples at rest from a cycle.
 * Strokes come to rest at their turning points. */
static cycle_span sliding_span(const wt_record *record, wt_cycle_kind kind, cycle_span s)
{
    const double *const x = record->channel[WT_RECORD_VELOCITY] != NULL
                                ? record->channel[WT_RECORD_VELOCITY]
                                : record->channel[WT_RECORD_ROTATION];
    double fastest = 0;
    if (x == NULL || kind == WT_CYCLE_STROKE)
        return s;
    for (size_t i = s.first; i < s.end; i++)
        fastest = fmax(fastest, fabs(x[i]));
    while (s.first + 1 < s.end && fabs(x[s.first]) < at_rest * fastest)
        s.first++;
    while (s.first + 1 < s.end && fabs(x[s.end - 1]) < at_rest * fastest)
        s.end--;
    return s;
}

/* ---- means ----------------------------------------------------------------------------------- */

static double mean_in_span(const double *x, cycle_span s, bool of_magnitude)
{
    double sum = 0, n = 0;
    for (size_t i = s.first; x != NULL && i < s.end; i++)
        if (!isnan(x[i])) {
            sum += of_magnitude ? fabs(x[i]) : x[i];
            n++;
        }
    return n > 0 ? sum / n : (double)NAN;
}

static double span_mean(const double *x, cycle_span s)
{
    return mean_in_span(x, s, false);
}

static double standard_deviation_in_span(const double *x, cycle_span s, double mean)
{
    double sum = 0, n = 0;
    for (size_t i = s.first; i < s.end; i++)
        if (!isnan(x[i])) {
            sum += (x[i] - mean) * (x[i] - mean);
            n++;
        }
    return n > 1 ? sqrt(sum / (n - 1)) : (double)NAN;
}

/* The span ends at the first sample of the next cycle, so that a cycle of one sample has a
 * duration. */
static double span_difference(const double *x, const wt_record *record, cycle_span s)
{
    return x != NULL ? x[same_step(record, s.end) ? s.end : s.end - 1] - x[s.first] : (double)NAN;
}

/* For strokes the mean of a quantity that changes its sign with the direction is that of its
 * magnitude. */
static double mean_speed(const double *x, cycle_span s, wt_cycle_kind kind)
{
    return fabs(mean_in_span(x, s, kind == WT_CYCLE_STROKE));
}

/* Length of a double stroke. */
static double double_stroke_path(const double *position, cycle_span s)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = s.first; position != NULL && i < s.end; i++) {
        low = fmin(low, position[i]);
        high = fmax(high, position[i]);
    }
    return high >= low ? 2 * (high - low) : (double)NAN;
}

static double cycle_velocity(const wt_record *record, double radius, cycle_span s,
                             wt_cycle_kind kind, const wt_cycle *c)
{
    const double measured = mean_speed(record->channel[WT_RECORD_VELOCITY], s, kind),
                 rotation = c->rotation * radius;
    if (!isnan(measured))
        return measured;
    if (!isnan(rotation))
        return rotation;
    double path = span_difference(record->channel[WT_RECORD_DISTANCE], record, s);
    if (isnan(path) && kind == WT_CYCLE_STROKE)
        path = double_stroke_path(record->channel[WT_RECORD_POSITION], s);
    return c->duration > 0 ? path / c->duration : (double)NAN;
}

/* `has_zero`: friction of one sign has a zero above it. */
static void set_friction(const wt_record *record, const double *friction, wt_cycle_kind kind,
                         bool has_zero, cycle_span s, wt_cycle *c)
{
    c->zero = (double)NAN;
    c->coefficient = span_mean(friction, s);
    c->deviation = standard_deviation_in_span(friction, s, c->coefficient);
    if (kind != WT_CYCLE_STROKE)
        return;
    const stroke_means m = strokes_mean(record, friction, s);
    const double n = (double)(s.turn - s.first), k = (double)(s.end - s.turn);
    const cycle_span there = {s.first, s.first, s.turn}, back = {s.turn, s.turn, s.end};
    c->deviation = sqrt((n * pow(standard_deviation_in_span(friction, there, m.there), 2) +
                         k * pow(standard_deviation_in_span(friction, back, m.back), 2)) /
                        (n + k));
    c->coefficient = 0.5 * (fabs(m.there) + fabs(m.back));
    if (m.there * m.back > 0 && !has_zero)
        return;
    c->coefficient = 0.5 * fabs(m.there - m.back);
    c->zero = 0.5 * (m.there + m.back);
}

/* Measured or stated normal force, else the friction force over the coefficient of the file. */
static double mean_normal_force(const wt_record *record, double load, cycle_span s)
{
    const double *const mu = record->channel[WT_RECORD_COEFFICIENT],
                        *const force = record->channel[WT_RECORD_FRICTION_FORCE];
    if (record->channel[WT_RECORD_NORMAL_FORCE] != NULL)
        return span_mean(record->channel[WT_RECORD_NORMAL_FORCE], s);
    if (!isnan(load) || mu == NULL || force == NULL)
        return load;
    double forces = 0, coefficients = 0;
    for (size_t i = s.first; i < s.end; i++) {
        forces += fabs(force[i]);
        coefficients += fabs(mu[i]);
    }
    return forces / coefficients;
}

static void set_cycle(const wt_record *record, double radius, double load, cycle_span s,
                      wt_cycle_kind kind, wt_cycle *c)
{
    double *const *const channel = record->channel;
    c->first = s.first;
    c->n = s.end - s.first;
    c->step = record->step[s.first];
    c->time = span_mean(channel[WT_RECORD_TIME], s);
    c->distance = span_mean(channel[WT_RECORD_DISTANCE], s);
    c->laps = span_mean(channel[WT_RECORD_LAPS], s);
    c->normal_force = mean_normal_force(record, load, s);
    c->duration = span_difference(channel[WT_RECORD_TIME], record, s);
    c->rotation = mean_speed(channel[WT_RECORD_ROTATION], s, kind);
    c->velocity = cycle_velocity(record, radius, s, kind, c);
    c->pressure = span_mean(channel[WT_RECORD_PRESSURE], s);
    c->temperature = span_mean(channel[WT_RECORD_TEMPERATURE], s);
    c->wear_depth = span_mean(channel[WT_RECORD_WEAR_DEPTH], s);
}

/* The sign of friction is that of a direction. Each step is made positive on average. */
static void make_step_friction_positive(wt_cycles *cycles)
{
    for (size_t first = 0, end; first < cycles->n; first = end) {
        double sum = 0;
        for (end = first; end < cycles->n && cycles->cycle[end].step == cycles->cycle[first].step;
             end++)
            sum += isnan(cycles->cycle[end].coefficient) ? 0 : cycles->cycle[end].coefficient;
        for (size_t i = first; i < end && sum < 0; i++)
            cycles->cycle[i].coefficient = -cycles->cycle[i].coefficient;
    }
}

static void fill_cycles(const wt_record *record, double radius, double load, const double *friction,
                        const cycle_spans *spans, double *scratch, wt_cycles *cycles)
{
    const bool has_zero =
        cycles->kind == WT_CYCLE_STROKE && strokes_have_zero(record, friction, spans);
    for (size_t k = 0; k < spans->n; k++) {
        wt_cycle *const c = &cycles->cycle[cycles->n];
        const cycle_span s = sliding_span(record, cycles->kind, spans->span[k]);
        set_friction(record, friction, cycles->kind, has_zero, s, c);
        set_cycle(record, radius, load, s, cycles->kind, c);
        if (isnan(c->coefficient))
            continue;
        cycles->has_zero = cycles->has_zero || !isnan(c->zero);
        scratch[cycles->n++] = (double)c->n;
    }
    make_step_friction_positive(cycles);
    numbers_sort(scratch, cycles->n);
    cycles->samples = cycles->n > 0 ? scratch[cycles->n / 2] : 0;
}

wt_status wt_cycles_compute(const wt_record *record, wt_cycle_kind kind, double radius, double load,
                            wt_cycles *cycles, wt_error *err)
{
    *cycles = (wt_cycles){.difference = (double)NAN};
    if (record == NULL || record->n == 0)
        return wt_fail(err, WT_E_ARG, "cycles of a record without samples");
    wt_cycles made = {.difference = (double)NAN};
    double *const friction = wt_alloc(record->n, sizeof *friction), *const room = wt_alloc(
                                                                        record->n, sizeof *room);
    cycle_spans spans = {wt_alloc(record->n, sizeof *spans.span), 0};
    wt_status status = sample_friction(record, load, friction, &made, err);
    if (status == WT_OK)
        status = choose_cycles(record, kind, radius, friction, room, &spans, &made.kind, err);
    if (status == WT_OK) {
        made.cycle = wt_alloc(spans.n, sizeof *made.cycle);
        fill_cycles(record, radius, load, friction, &spans, room, &made);
        made.friction = friction;
        *cycles = made;
    } else {
        free(friction);
    }
    free(room);
    free(spans.span);
    return status;
}

void wt_cycles_clear(wt_cycles *cycles)
{
    if (cycles == NULL)
        return;
    free(cycles->cycle);
    free(cycles->friction);
    *cycles = (wt_cycles){.n = 0};
}
