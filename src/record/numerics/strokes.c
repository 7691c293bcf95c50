/* Double strokes of a reciprocating record: turning points, the friction of either direction, and
 * whether friction of one sign has a zero above it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/strokes.h"

#include <math.h>

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

void strokes_find(const wt_record *record, const double *friction, cycle_spans *spans)
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

stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span)
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

bool strokes_have_zero(const wt_record *record, const double *friction, const cycle_spans *spans)
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
