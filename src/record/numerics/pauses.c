/* Pauses of a friction record, found by its motion: distance, laps, position, velocity or rotation.
 * Without these channels, a gap in the time is a pause.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/pauses.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shortest pause as a fraction of the time of a step. A shorter one has no visible effect on the
 * running-in. */
static const double least_part = 1e-3;
/* A pause takes at least this many times the time that the motion beside it takes for the same
 * progress. The clock of a recorder is late by less, and a display changes its last digit
 * sooner. */
static const double outstanding = 10;
/* Number of levels on either side whose median gives the sliding speed. A single outlier does not
 * change it. */
enum { BESIDE = 5 };
/* Fraction of the range of a position. A slider at rest moves by less. */
static const double standing = 0.02;
/* Fraction of the time between turning points. A sinusoidal motion stays within the rest range for
 * 1/7 of this time at a turning point. */
static const double least_of_stroke = 0.5;
/* Multiple of the median scatter about the position of a slider at rest. Smaller deviations are
 * scatter. */
static const double outside = 5;
/* Fraction of the largest speed. A slower disc may be at rest, with a speed that is noise. */
static const double at_rest = 0.01;
/* Ratio of mean and standard deviation. Rectified noise has 1.3; signed noise without motion has 0.
 * A slowly turning motor exceeds the limit. */
static const double noise = 2;
/* Fewest gaps of the recorder: equal gaps, the longest below twice the shortest. */
enum { FEW_GAPS = 5 };
/* Fraction of the range. A channel that falls by more reciprocates. */
static const double there_and_back = 0.1;

/* Samples of one step with the motion of one channel. */
typedef struct pause_search {
    const double *time, *moved; /* [n] */
    size_t n;
    double *cut;     /* [n] pause before a sample that is removed [s] */
    bool *rest;      /* [n] */
    double *scratch; /* [n] */
} pause_search;

typedef struct motion_level {
    size_t first, next;    /* samples at which the level is reached and left */
    double time, progress; /* up to the next level */
} motion_level;

/* ---- unidirectional motion ------------------------------------------------------------------- */

static double largest_fall(const double *x, size_t n)
{
    double most = -(double)INFINITY, fall = 0;
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, x[i]);
        fall = fmax(fall, most - x[i]);
    }
    return fall;
}

/* Groups samples at one position into levels. A measured distance scatters by as much as it
 * falls. */
static size_t find_levels(const pause_search *s, motion_level *levels)
{
    const double same = 2 * largest_fall(s->moved, s->n);
    size_t n = 0;
    for (size_t first = 0, next; first + 1 < s->n; first = next) {
        for (next = first + 1; next + 1 < s->n && !(fabs(s->moved[next] - s->moved[first]) > same);
             next++)
            ;
        levels[n++] = (motion_level){first, next, s->time[next] - s->time[first],
                                     fabs(s->moved[next] - s->moved[first])};
    }
    return n;
}

/* Median time per progress of the levels on one side. NaN if there are none. */
static double median_slowness(const motion_level *levels, size_t n)
{
    double slow[BESIDE];
    size_t known = 0;
    for (size_t i = 0; i < n && i < BESIDE; i++)
        if (levels[i].progress > 0)
            slow[known++] = levels[i].time / levels[i].progress;
    return known > 0 ? numbers_median(slow, known) : (double)NAN;
}

static void find_pauses_in_levels(pause_search *s, motion_level *levels)
{
    const size_t n = find_levels(s, levels);
    const double least = least_part * (s->time[s->n - 1] - s->time[0]);
    for (size_t k = 1; k + 1 < n; k++) {
        const motion_level *const l = &levels[k];
        const double before = median_slowness(levels + (k > BESIDE ? k - BESIDE : 0),
                                              k > BESIDE ? BESIDE : k),
                     behind = median_slowness(l + 1, n - k - 1),
                     expected = l->progress * fmax(before, behind);
        if (isnan(before + behind) || !(l->time > outstanding * expected) ||
            !(l->time - expected > least))
            continue;
        s->cut[l->next] = l->time - expected;
        for (size_t i = l->first + 1; i < l->next; i++)
            s->rest[i] = true;
    }
}

/* ---- reciprocating motion -------------------------------------------------------------------- */

/* Mean time between turning points. It counts strokes from one outer quarter of the range to the
 * other: the path itself would include the noise of every sample. */
static double mean_stroke_time(const pause_search *s, double low, double high)
{
    const double quarter = 0.25 * (high - low);
    size_t strokes = 0;
    int side = 0;
    for (size_t i = 0; i < s->n; i++) {
        const int at = s->moved[i] < low + quarter ? -1 : s->moved[i] > high - quarter ? 1 : side;
        strokes += at * side < 0;
        side = at;
    }
    return (s->time[s->n - 1] - s->time[0]) / (double)(strokes > 0 ? strokes : 1);
}

/* Restricts samples near one position to the rest itself. Before and after, the slider was
 * moving. */
static void trim_rest(const pause_search *s, size_t *first, size_t *next)
{
    const size_t n = *next - *first;
    memcpy(s->scratch, s->moved + *first, n * sizeof *s->scratch);
    const double place = numbers_median(s->scratch, n);
    for (size_t i = 0; i < n; i++)
        s->scratch[i] = fabs(s->moved[*first + i] - place);
    const double near = outside * numbers_median(s->scratch, n);
    while (*first + 1 < *next && fabs(s->moved[*first] - place) > near)
        ++*first;
    while (*first + 1 < *next && fabs(s->moved[*next - 1] - place) > near)
        --*next;
}

static void find_rests(pause_search *s, double low, double high)
{
    const double least = fmax(least_part * (s->time[s->n - 1] - s->time[0]),
                              least_of_stroke * mean_stroke_time(s, low, high));
    for (size_t first = 0, next; first < s->n; first = next) {
        for (next = first + 1;
             next < s->n && fabs(s->moved[next] - s->moved[first]) <= standing * (high - low);
             next++)
            ;
        size_t from = first, to = next;
        if (first == 0 || next == s->n || !(s->time[next - 1] - s->time[first] > least))
            continue;
        trim_rest(s, &from, &to);
        s->cut[to] = s->time[to - 1] - s->time[from];
        for (size_t i = from + 1; i < to; i++)
            s->rest[i] = true;
    }
}

/* ---- motion of a channel --------------------------------------------------------------------- */

/* Sets a speed to zero where it is noise: runs far below the largest speed whose mean does not
 * exceed their scatter. */
static void suppress_speed_noise(double *speed, size_t n)
{
    double fastest = 0;
    for (size_t i = 0; i < n; i++)
        fastest = fmax(fastest, fabs(speed[i]));
    for (size_t first = 0, end; first < n; first = end) {
        double sum = 0, squares = 0;
        for (end = first; end < n && fabs(speed[end]) < at_rest * fastest; end++) {
            sum += speed[end];
            squares += speed[end] * speed[end];
        }
        const double count = (double)(end - first), mean = sum / count,
                     deviation = sqrt(fmax(squares / count - mean * mean, 0));
        for (size_t i = first; i < end && fabs(mean) <= noise * deviation; i++)
            speed[i] = 0;
        end += end == first;
    }
}

static bool is_complete_channel(const double *x, size_t n)
{
    for (size_t i = 0; x != NULL && i < n; i++)
        if (isnan(x[i]))
            return false;
    return x != NULL;
}

/* Integrates a speed, which holds over the interval before its sample. */
static void integrate_speed(double *speed, const double *time, size_t n, double *way)
{
    suppress_speed_noise(speed, n);
    way[0] = 0;
    for (size_t i = 1; i < n; i++)
        way[i] = way[i - 1] + speed[i] * (time[i] - time[i - 1]);
}

/* Copies the motion of a channel from sample `first` on. WT_RECORD_CHANNELS stands for the sample
 * number. False if the record lacks the channel. */
static bool channel_motion(const wt_record *record, wt_record_channel c, size_t first, size_t n,
                           double *moved, double *scratch)
{
    const double *const x =
        c < WT_RECORD_CHANNELS && record->channel[c] != NULL ? record->channel[c] + first : NULL;
    for (size_t i = 0; c == WT_RECORD_CHANNELS && i < n; i++)
        moved[i] = (double)i;
    if (c == WT_RECORD_CHANNELS)
        return true;
    if (!is_complete_channel(x, n))
        return false;
    memcpy(scratch, x, n * sizeof *scratch);
    if (c == WT_RECORD_VELOCITY || c == WT_RECORD_ROTATION)
        integrate_speed(scratch, record->channel[WT_RECORD_TIME] + first, n, moved);
    else
        memcpy(moved, scratch, n * sizeof *moved);
    for (size_t i = 0; i < n; i++) /* the sign is that of a direction */
        scratch[i] = moved[n - 1] < moved[0] ? -moved[i] : moved[i];
    memcpy(moved, scratch, n * sizeof *moved);
    return true;
}

/* ---- record ---------------------------------------------------------------------------------- */

/* Scratch arrays with one element per sample. */
typedef struct pause_buffers {
    double *moved, *scratch;
    double *cut, *paused; /* [s] before a sample: pauses of this channel, pauses of all channels */
    bool *rest;
    motion_level *levels;
} pause_buffers;

static void find_pauses_in_step(const wt_record *record, wt_record_channel c, size_t first,
                                size_t n, const pause_buffers *r)
{
    pause_search s = {record->channel[WT_RECORD_TIME] + first,
                      r->moved,
                      n,
                      r->cut + first,
                      r->rest + first,
                      r->scratch};
    if (!channel_motion(record, c, first, n, r->moved, r->scratch))
        return;
    double low = r->moved[0], high = r->moved[0];
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, r->moved[i]);
        high = fmax(high, r->moved[i]);
    }
    if (!(high > low))
        return;
    if (largest_fall(r->moved, n) > there_and_back * (high - low))
        find_rests(&s, low, high);
    else
        find_pauses_in_levels(&s, r->levels);
}

/* Restores the time of many equal gaps, which belong to the recorder. Returns their number. */
static size_t restore_recorder_gaps(const wt_record *record, double *cut)
{
    double least = (double)INFINITY, most = 0;
    size_t n = 0;
    for (size_t i = 0; i < record->n; i++)
        if (cut[i] > 0) {
            least = fmin(least, cut[i]);
            most = fmax(most, cut[i]);
            n++;
        }
    if (n < FEW_GAPS || most > 2 * least)
        return 0;
    memset(cut, 0, record->n * sizeof *cut);
    return n;
}

/* Removes the samples at rest and renumbers the others. */
static void remove_rests(wt_record *record, const pause_buffers *r)
{
    static const wt_record_channel running[] = {WT_RECORD_TIME, WT_RECORD_DISTANCE, WT_RECORD_LAPS};
    double *const *const channel = record->channel;
    double shift[COUNT_OF(running)] = {0}, paused = 0;
    size_t to = 0;
    for (size_t i = 0; i < record->n; i++) {
        paused += r->paused[i] + r->cut[i];
        shift[0] += r->cut[i];
        /* a display that counts at rest adds no path */
        for (size_t k = 1; k < COUNT_OF(running); k++)
            if (r->rest[i] && channel[running[k]] != NULL)
                shift[k] += channel[running[k]][i] - channel[running[k]][i - 1];
        if (r->rest[i])
            continue;
        r->paused[to] = paused;
        paused = 0;
        record->step[to] = record->step[i];
        for (int c = 0; c < WT_RECORD_CHANNELS; c++)
            if (channel[c] != NULL)
                channel[c][to] = channel[c][i];
        for (size_t k = 0; k < COUNT_OF(running); k++)
            if (channel[running[k]] != NULL)
                channel[running[k]][to] -= shift[k];
        to++;
    }
    record->n = to;
}

static void find_pauses_by_channel(wt_record *record, wt_record_channel c, const pause_buffers *r,
                                   size_t *alike)
{
    if (c < WT_RECORD_CHANNELS && record->channel[c] == NULL)
        return;
    memset(r->cut, 0, record->n * sizeof *r->cut);
    memset(r->rest, 0, record->n * sizeof *r->rest);
    for (size_t first = 0, end; first < record->n; first = end) {
        for (end = first + 1; end < record->n && record->step[end] == record->step[first]; end++)
            ;
        find_pauses_in_step(record, c, first, end - first, r);
    }
    if (c == WT_RECORD_CHANNELS)
        *alike = restore_recorder_gaps(record, r->cut);
    remove_rests(record, r);
}

static void list_pauses(const wt_record *record, const double *paused, record_pauses *pauses)
{
    for (size_t i = 0; i < record->n; i++) {
        if (!(paused[i] > 0))
            continue;
        pauses->of = array_grow(pauses->of, pauses->n, sizeof *pauses->of);
        pauses->of[pauses->n++] = (record_pause){i, record->channel[WT_RECORD_TIME][i], paused[i]};
    }
}

record_pauses record_remove_pauses(wt_record *record)
{
    /* the finest channel first; time alone last, without a progressive channel */
    static const wt_record_channel order[] = {WT_RECORD_DISTANCE, WT_RECORD_VELOCITY,
                                              WT_RECORD_ROTATION, WT_RECORD_POSITION,
                                              WT_RECORD_LAPS,     WT_RECORD_CHANNELS};
    const size_t n = record->n;
    arena memory = {0};
    record_pauses pauses = {.n = 0};
    if (record->channel[WT_RECORD_TIME] == NULL || n < 2)
        return pauses;
    const pause_buffers r = {arena_numbers(&memory, n),
                             arena_numbers(&memory, n),
                             arena_numbers(&memory, n),
                             arena_numbers(&memory, n),
                             arena_alloc(&memory, n, sizeof(bool)),
                             arena_alloc(&memory, n, sizeof(motion_level))};
    for (size_t i = 0; i < COUNT_OF(order); i++)
        if (order[i] != WT_RECORD_CHANNELS || (record->channel[WT_RECORD_DISTANCE] == NULL &&
                                               record->channel[WT_RECORD_LAPS] == NULL))
            find_pauses_by_channel(record, order[i], &r, &pauses.alike);
    list_pauses(record, r.paused, &pauses);
    arena_free(&memory);
    return pauses;
}
