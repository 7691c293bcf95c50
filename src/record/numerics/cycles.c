/* Division of a friction record into cycles, the strokes of a reciprocating record, and means over
 * the cycles.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "weartrack/core.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

/* Samples of one cycle. `turn`: first sample of the return stroke of a double stroke. */
typedef struct cycle_span {
    size_t first, turn, end;
} cycle_span;

typedef struct cycle_spans {
    cycle_span *span; /* [n], allocated for one per sample */
    size_t n;
} cycle_spans;

/* Mean friction of the forward and the return stroke without the ends of the stroke, and its
 * variance about them. */
typedef struct stroke_means {
    double there, back, variance;
} stroke_means;

/* ---- strokes --------------------------------------------------------------------------------- */

/* Smallest return motion as a fraction of the stroke. Smaller ones are scatter of the sensor. */
static const double least_way = 0.25;

/* Fraction of the stroke skipped at either end, where motion and friction reverse. */
static const double end_share = 0.1;

/* Smallest ratio of the smaller to the larger level of a friction that changes sign with the
 * strokes. */
static const double least_side = 0.2;

/* Turning points of a signal with hysteresis. NaN is skipped. */
typedef struct turn_detector {
    double low, high; /* extremes since the last turn */
    size_t at_low, at_high;
    int direction; /* 1 up, -1 down, 0 unknown */
} turn_detector;

/* True at a turn; *at is then the sample of the extreme. */
static bool detect_turn(turn_detector *t, double value, size_t i, double hysteresis, size_t *at)
{
    if (isnan(value))
        return false;
    if (value > t->high) {
        t->high = value;
        t->at_high = i;
    }
    if (value < t->low) {
        t->low = value;
        t->at_low = i;
    }
    if (t->direction >= 0 && t->high - value > hysteresis) {
        *at = t->at_high;
        t->low = value;
        t->at_low = i;
        const bool turned = t->direction > 0;
        t->direction = -1;
        return turned;
    }
    if (t->direction <= 0 && value - t->low > hysteresis) {
        *at = t->at_low;
        t->high = value;
        t->at_high = i;
        const bool turned = t->direction < 0;
        t->direction = 1;
        return turned;
    }
    return false;
}

/* Levels of a signal: its means below and above the middle of its range. */
typedef struct signal_range {
    double low, high;
} signal_range;

static signal_range signal_levels(const double *x, size_t n)
{
    double low = (double)INFINITY, high = -(double)INFINITY, sum[2] = {0, 0}, count[2] = {0, 0};
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, x[i]);
        high = fmax(high, x[i]);
    }
    for (size_t i = 0; i < n; i++)
        if (!isnan(x[i])) {
            const int side = x[i] > 0.5 * (low + high);
            sum[side] += x[i];
            count[side]++;
        }
    return (signal_range){sum[0] / count[0], sum[1] / count[1]};
}

/* Returns the signal whose turns are those of the stroke, and its hysteresis. NULL if there is
 * none. Friction reverses abruptly at the ends of a stroke. */
static const double *turning_signal(const wt_record *record, const double *friction,
                                    double *hysteresis)
{
    const double *const position = record->channel[WT_RECORD_POSITION];
    const signal_range f = signal_levels(friction, record->n);
    if (position != NULL) {
        const signal_range p = signal_levels(position, record->n);
        *hysteresis = least_way * (p.high - p.low);
        return p.high > p.low ? position : NULL;
    }
    *hysteresis = 0.5 * (f.high - f.low);
    const double small = fmin(-f.low, f.high), large = fmax(-f.low, f.high);
    return f.low < 0 && f.high > 0 && small > least_side * large ? friction : NULL;
}

/* Returns the first sample after a sign change of friction. Position turns at its extreme. */
static size_t turn_at(const double *signal, bool leaps, size_t at, size_t now)
{
    size_t i = at;
    while (leaps && i < now && (signal[i] > 0) == (signal[at] > 0))
        i++;
    return i;
}

/* Finds double strokes within the steps by turning points of the position, else by sign changes of
 * the friction. Finds none without either. */
static void strokes_find(const wt_record *record, const double *friction, cycle_spans *spans)
{
    double hysteresis;
    const double *const signal = turning_signal(record, friction, &hysteresis);
    const bool leaps = signal == friction;
    turn_detector t = {0};
    size_t turn[2] = {0, 0}, n_turns = 0;
    spans->n = 0;
    for (size_t i = 0; signal != NULL && i < record->n; i++) {
        size_t at;
        if (i == 0 || record->step[i] != record->step[i - 1]) {
            t = (turn_detector){signal[i], signal[i], i, i, 0};
            n_turns = 0;
        }
        if (!detect_turn(&t, signal[i], i, hysteresis, &at))
            continue;
        at = turn_at(signal, leaps, at, i);
        if (n_turns == 2) {
            spans->span[spans->n++] = (cycle_span){turn[0], turn[1], at};
            turn[0] = at;
            n_turns = 1;
        } else {
            turn[n_turns++] = at;
        }
    }
}

/* Mean over the middle of one stroke, by position if measured, else by sample number. *squares:
 * sum of the squared deviations, added to. */
static double middle_mean(const double *position, const double *friction, size_t first, size_t end,
                          double *squares)
{
    double low = (double)INFINITY, high = -(double)INFINITY, mean = (double)NAN, n = 0;
    for (size_t i = first; i < end; i++) {
        const double at = position != NULL ? position[i] : (double)i;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    const double cut = end_share * (high - low);
    for (size_t i = first; i < end; i++) {
        const double at = position != NULL ? position[i] : (double)i;
        if (at < low + cut || at > high - cut || isnan(friction[i]))
            continue;
        const double off = n > 0 ? friction[i] - mean : 0;
        mean = n > 0 ? mean + off / (n + 1) : friction[i];
        n++;
        *squares += off * (friction[i] - mean);
    }
    return mean;
}

static stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span)
{
    const double *const position = record->channel[WT_RECORD_POSITION];
    double squares = 0;
    const double there = middle_mean(position, friction, span.first, span.turn, &squares),
                 back = middle_mean(position, friction, span.turn, span.end, &squares);
    const double n = (double)(span.end - span.first);
    return (stroke_means){there, back, n > 2 ? squares / (n - 2) : 0};
}

/* ---- zero of strokes without a change of sign ------------------------------------------------ */

/* A magnitude falls below this share of its lower level where the motion reverses. With few samples
 * a part of the reversals shows it. */
static const double dip_level = 0.5, least_dips = 0.05;
/* Share of a stroke at its ends in which friction reverses. The sensor gives way. */
static const double reversal_share = 0.2;
/* Least friction as a share of the zero. A magnitude with a zero has two levels, too, and a fast
 * reversal leaves no sample. Below it, half of the reversals must have a sample between the levels,
 * which are apart by five standard deviations. */
static const double least_friction = 0.25, least_between = 0.5, levels_apart = 5;

/* Samples near a reversal from the lower level to the higher one. */
static void inspect_reversal(const double *friction, size_t from, size_t to, signal_range level,
                             double *dips, double *between)
{
    const double quarter = 0.25 * (level.high - level.low);
    bool dip = false, inside = false;
    for (size_t i = from; i < to; i++) {
        const double f = fabs(friction[i]);
        dip = dip || f < dip_level * level.low;
        inside = inside || (f > level.low + quarter && f < level.high - quarter);
    }
    *dips += dip;
    *between += inside;
}

/* True if friction of one sign is that of both directions, with a zero above it. A magnitude falls
 * to zero at both reversals; friction with a zero changes from one level to the other. */
static bool has_zero_above_friction(const wt_record *record, const double *friction,
                                    const cycle_spans *spans)
{
    double there = 0, back = 0, variance = 0, n = 0, dips = 0, between = 0;
    for (size_t k = 0; k < spans->n; k++) {
        const stroke_means m = strokes_mean(record, friction, spans->span[k]);
        if (isnan(m.there) || isnan(m.back))
            continue;
        there += m.there;
        back += m.back;
        variance += m.variance;
        n++;
    }
    if (!(there * back > 0))
        return false;
    const signal_range level = {fmin(fabs(there), fabs(back)) / n,
                                fmax(fabs(there), fabs(back)) / n};
    for (size_t k = 0; k < spans->n; k++) {
        const cycle_span s = spans->span[k];
        const size_t turn = fabs(there) < fabs(back) ? s.turn : s.end,
                     around = 1 + (size_t)(reversal_share * 0.5 * (double)(s.end - s.first)),
                     from = turn > around ? turn - around : 0,
                     to = turn + around < record->n ? turn + around : record->n;
        inspect_reversal(friction, from, to, level, &dips, &between);
    }
    const double difference = level.high - level.low;
    return dips < least_dips * n &&
           (difference > least_friction * (level.high + level.low) ||
            (between > least_between * n && difference > levels_apart * sqrt(variance / n)));
}

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

static double sample_load(const wt_record *record, double load, size_t i)
{
    const double *const measured = record->channel[WT_RECORD_NORMAL_FORCE];
    return measured != NULL ? measured[i] : load;
}

/* The coefficient of the file is used unless it lost the sign that the force has. */
static wt_status sample_friction(const wt_record *record, double load, double *friction,
                                 wt_cycles *cycles, wt_error *err)
{
    const double *const given = record->channel[WT_RECORD_COEFFICIENT],
                        *const force = record->channel[WT_RECORD_FRICTION_FORCE];
    const bool has_load = record->channel[WT_RECORD_NORMAL_FORCE] != NULL || load > 0,
               by_force = force != NULL && has_load &&
                          (given == NULL ||
                           (has_both_signs(force, record->n) && !has_both_signs(given, record->n)));
    if (given == NULL && !by_force) {
        const wt_status status = wt_fail(err, WT_E_MISSING, "a friction force without a load");
        wt_error_expected(err, "a column of the normal force or of the friction coefficient");
        wt_error_advice(err, "give the load: weartrack record --load 5N, or <load> in the "
                             "<record> of a case");
        return status;
    }
    for (size_t i = 0; i < record->n; i++) {
        const double normal = sample_load(record, load, i),
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
    const wt_status status = wt_fail(err, WT_E_MISSING, "the record does not tell three whole %s",
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

static double span_mean(const double *x, cycle_span s)
{
    double sum = 0, n = 0;
    for (size_t i = s.first; x != NULL && i < s.end; i++)
        if (!isnan(x[i])) {
            sum += x[i];
            n++;
        }
    return n > 0 ? sum / n : (double)NAN;
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
static size_t span_end(const wt_record *record, cycle_span s)
{
    return same_step(record, s.end) ? s.end : s.end - 1;
}

static double span_difference(const double *x, const wt_record *record, cycle_span s)
{
    return x != NULL ? x[span_end(record, s)] - x[s.first] : (double)NAN;
}

/* For strokes the mean of a quantity that changes its sign with the direction is that of its
 * magnitude. */
static double mean_speed(const double *x, cycle_span s, wt_cycle_kind kind)
{
    double sum = 0, n = 0;
    if (kind != WT_CYCLE_STROKE)
        return fabs(span_mean(x, s));
    for (size_t i = s.first; x != NULL && i < s.end; i++)
        if (!isnan(x[i])) {
            sum += fabs(x[i]);
            n++;
        }
    return n > 0 ? sum / n : (double)NAN;
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
        cycles->kind == WT_CYCLE_STROKE && has_zero_above_friction(record, friction, spans);
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
