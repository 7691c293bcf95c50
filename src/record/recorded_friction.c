/* Friction of the cycles of a record against time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/recorded_friction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Longer series are replaced by means over equal numbers of cycles, which bounds the work. */
enum { MOST_MEANS = 1000 };

/* Converts middles of cycles to their ends, half-way to the next. Missing cycles before the first
 * have its duration. */
static bool convert_midpoints_to_ends(recorded_run *r, double lost)
{
    double *const t = r->end;
    const double first = t[1] - t[0], last = t[r->n - 1] - t[r->n - 2];
    r->begin = lost * first;
    const double start = t[0] - 0.5 * first - r->begin;
    for (size_t i = 0; i + 1 < r->n; i++) {
        if (!(t[i + 1] > t[i]))
            return false;
        t[i] = 0.5 * (t[i] + t[i + 1]) - start;
    }
    t[r->n - 1] += 0.5 * last - start;
    return true;
}

static double cycle_time(const table_view *cycles, size_t row, double velocity)
{
    const double time = record_cycles_get(cycles, row, RECORD_CYCLES_TIME);
    return isnan(time) ? record_cycles_get(cycles, row, RECORD_CYCLES_DISTANCE) / velocity : time;
}

static bool is_cycle_of_step(const table_view *cycles, size_t row, const recorded_run *r)
{
    return record_cycles_get(cycles, row, RECORD_CYCLES_STEP) == (double)r->step &&
           strcmp(record_cycles_text(cycles, row, RECORD_CYCLES_FILE), r->at.file) == 0;
}

/* Number of cycles before the first of two, by a counter that starts at 0. It is 0 below one cycle,
 * because counters also start at 1. */
static double cycles_before(const double count[2])
{
    const double before = count[0] / (count[1] - count[0]) - 0.5;
    return before > 1 && isfinite(before) ? before : 0;
}

static void read_cycles(const table_view *cycles, recorded_run *r)
{
    bool timed = true;
    double laps[2] = {(double)NAN, (double)NAN}, slid[2] = {(double)NAN, (double)NAN};
    for (size_t i = 0; i < cycles->n_rows; i++) {
        const double friction = record_cycles_get(cycles, i, RECORD_CYCLES_FRICTION);
        if (!is_cycle_of_step(cycles, i, r) || !isfinite(friction))
            continue;
        if (r->n < 2) {
            laps[r->n] = record_cycles_get(cycles, i, RECORD_CYCLES_LAPS);
            slid[r->n] = record_cycles_get(cycles, i, RECORD_CYCLES_DISTANCE);
        }
        r->end[r->n] = cycle_time(cycles, i, r->at.velocity);
        timed = timed && isfinite(r->end[r->n]);
        r->friction[r->n++] = friction;
    }
    const double lost = isnan(laps[0]) ? cycles_before(slid) : cycles_before(laps);
    if (r->at.note[0] != '\0')
        r->note = r->at.note;
    else if (r->n < RUNNING_IN_CURVE_MIN_MEANS)
        r->note = "too few cycles to follow friction in time";
    else if (!timed)
        r->note = "neither time nor distance of its cycles is known";
    else if (!convert_midpoints_to_ends(r, lost))
        r->note = "the times of its cycles do not rise";
}

/* Skips steps at rest at the beginning of a file and returns its first step that slides. */
static size_t first_sliding(const table_view *record, size_t row, const wt_sliding *sliding)
{
    const char *const file = record_text(record, row, RECORD_FILE);
    while (!(measured_step_read(record, row, sliding).velocity > 0) && row + 1 < record->n_rows &&
           record_get(record, row + 1, RECORD_STEP) == record_get(record, row, RECORD_STEP) + 1 &&
           strcmp(record_text(record, row + 1, RECORD_FILE), file) == 0)
        row++;
    return row;
}

recorded_run *recorded_read(const table_view *record, const table_view *cycles,
                            const wt_sliding *sliding, size_t *n)
{
    recorded_run *const runs = wt_alloc(record->n_rows, sizeof *runs);
    *n = 0;
    for (size_t i = 0; i < record->n_rows; i++) {
        if (record_get(record, i, RECORD_STEP) != 1)
            continue;
        recorded_run *const r = &runs[(*n)++];
        const size_t row = first_sliding(record, i, sliding);
        *r = (recorded_run){.at = measured_step_read(record, row, sliding),
                            .step = (size_t)record_get(record, row, RECORD_STEP),
                            .end = wt_alloc(cycles->n_rows, sizeof *r->end),
                            .friction = wt_alloc(cycles->n_rows, sizeof *r->friction),
                            .running_in = record_get(record, row, RECORD_RUNNING_IN),
                            .note = ""};
        read_cycles(cycles, r);
    }
    return runs;
}

void recorded_free(recorded_run *runs, size_t n)
{
    for (size_t i = 0; runs != NULL && i < n; i++) {
        free(runs[i].end);
        free(runs[i].friction);
    }
    free(runs);
}

static size_t count_cycles_until(const recorded_run *r, double until)
{
    size_t n = 0;
    while (n < r->n && r->end[n] <= until)
        n++;
    return n;
}

static size_t mean_length(size_t n)
{
    return (n + MOST_MEANS - 1) / MOST_MEANS;
}

bool recorded_is_averaged(const recorded_run *r, double until)
{
    return mean_length(count_cycles_until(r, until)) > 1;
}

size_t recorded_mean_count(const recorded_run *r, double until)
{
    const size_t n = count_cycles_until(r, until);
    return n > 0 ? n / mean_length(n) : 0;
}

running_in_series recorded_read_series(const recorded_run *r, double until)
{
    const size_t cycles = count_cycles_until(r, until),
                 length = cycles > 0 ? mean_length(cycles) : 1;
    running_in_series s = running_in_series_alloc(recorded_mean_count(r, until));
    s.begin = r->begin;
    for (size_t i = 0; i < s.n; i++) {
        s.end[i] = r->end[(i + 1) * length - 1];
        for (size_t k = 0; k < length; k++)
            s.friction[i] += r->friction[i * length + k] / (double)length;
    }
    return s;
}
