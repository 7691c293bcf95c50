/* Strokes of a reciprocating record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "record/numerics/cycles.h"

#include <math.h>

/* A way back is one of a quarter of the stroke at least: less is scatter of the sensor. */
static const double least_way = 0.25;
/* What is left out at either end of a stroke, of its length: there the motion turns round, and the
 * friction with it. */
static const double ends = 0.1;
/* Friction that changes its sign is that of strokes if the smaller side is so much of the larger.
 */
static const double least_side = 0.2;

/* Where a signal turns round, with hysteresis; NaN does not count. */
typedef struct turning {
    double low, high; /* since the last turn */
    size_t at_low, at_high;
    int way; /* 1 up, -1 down, 0 not known yet */
} turning;

/* True where the signal has turned: *at is the sample of the turn. */
static bool turns(turning *t, double value, size_t i, double hysteresis, size_t *at)
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
    if (t->way >= 0 && t->high - value > hysteresis) {
        *at = t->at_high;
        t->low = value;
        t->at_low = i;
        const bool turned = t->way > 0;
        t->way = -1;
        return turned;
    }
    if (t->way <= 0 && value - t->low > hysteresis) {
        *at = t->at_low;
        t->high = value;
        t->at_high = i;
        const bool turned = t->way < 0;
        t->way = 1;
        return turned;
    }
    return false;
}

/* Range of a signal: its means above and below the middle of what it reaches. */
typedef struct sides {
    double low, high;
} sides;

static sides sides_of(const double *x, size_t n)
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
    return (sides){sum[0] / count[0], sum[1] / count[1]};
}

/* The signal whose turns are those of the stroke, and how far it must go back; NULL. Friction turns
 * round at the ends of a stroke in one leap, so that its leaps are turns, too. */
static const double *turning_signal(const wt_record *record, const double *friction,
                                    double *hysteresis)
{
    const double *const position = record->channel[WT_RECORD_POSITION];
    const sides f = sides_of(friction, record->n);
    if (position != NULL) {
        const sides p = sides_of(position, record->n);
        *hysteresis = least_way * (p.high - p.low);
        return p.high > p.low ? position : NULL;
    }
    *hysteresis = 0.5 * (f.high - f.low);
    const double small = fmin(-f.low, f.high), large = fmax(-f.low, f.high);
    return f.low < 0 && f.high > 0 && small > least_side * large ? friction : NULL;
}

/* Sides of 0 of a leap: the first sample behind it. Position turns at its extreme. */
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
    turning t = {0};
    size_t turn[2] = {0, 0}, n_turns = 0;
    spans->n = 0;
    for (size_t i = 0; signal != NULL && i < record->n; i++) {
        size_t at;
        if (i == 0 || record->step[i] != record->step[i - 1]) {
            t = (turning){signal[i], signal[i], i, i, 0};
            n_turns = 0;
        }
        if (!turns(&t, signal[i], i, hysteresis, &at))
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

/* Mean over the middle of one way: by position where there is one, else by number. */
static double middle_mean(const double *position, const double *friction, size_t first, size_t end)
{
    double low = (double)INFINITY, high = -(double)INFINITY, sum = 0, n = 0;
    for (size_t i = first; i < end; i++) {
        const double at = position != NULL ? position[i] : (double)i;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    const double cut = ends * (high - low);
    for (size_t i = first; i < end; i++) {
        const double at = position != NULL ? position[i] : (double)i;
        if (at < low + cut || at > high - cut || isnan(friction[i]))
            continue;
        sum += friction[i];
        n++;
    }
    return n > 0 ? sum / n : (double)NAN;
}

stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span)
{
    const double *const position = record->channel[WT_RECORD_POSITION];
    return (stroke_means){middle_mean(position, friction, span.first, span.turn),
                          middle_mean(position, friction, span.turn, span.end)};
}
