/* Measured friction of records, prepared for the prediction: the steady friction of the steps, and
 * the friction of the cycles against time.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/measured_friction.h"
#include "core/base/array.h"
#include "core/base/text.h"
#include "friction/sliding_contact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Covariances need memory quadratic in the number of steps: 500 steps take 2 MB each. */
enum { MOST_STEPS = 500 };
/* Steps that differ by less share one contact computation. A shift of 0.25 K moves filled rubber by
 * 1/40 decade. Friction depends on the pressure with an exponent of 1/3 at most. */
static const double same_temperature = 0.25 /* [K] */, same_pressure = 0.01;
/* Loads of one step agree to 10 %; see conditions.c. */
static const double same_load = 1.1;

static const char *exclusion_reason(const measured_step *s)
{
    if (!(s->velocity > 0))
        return "nothing slides in it";
    if (!(s->friction > 0))
        return "no friction coefficient above 0";
    if (!(s->error > 0) || !isfinite(s->error))
        return "no standard error";
    return "";
}

static bool is_step_used(const measured_step *s)
{
    return s->note[0] == '\0';
}

/* Unknown values are equal and sort after all known values. */
static int compare_values(double a, double b)
{
    if (isnan(a) || isnan(b))
        return (isnan(a) ? 1 : 0) - (isnan(b) ? 1 : 0);
    return (a > b) - (a < b);
}

static int compare_conditions(const void *x, const void *y)
{
    const measured_step *a = x, *b = y;
    const double of_a[] = {a->temperature, a->pressure, a->velocity, a->friction, a->error},
                 of_b[] = {b->temperature, b->pressure, b->velocity, b->friction, b->error};
    int order = is_step_used(b) - is_step_used(a);
    for (size_t i = 0; order == 0 && i < COUNT_OF(of_a); i++)
        order = compare_values(of_a[i], of_b[i]);
    return order;
}

/* Replaces values that merely fluctuate by the first of them, so that the steps sort by
 * velocity. */
static void merge_fluctuations(measured *m)
{
    for (size_t i = 0; i < m->n_all; i++)
        for (size_t k = 0; k < i; k++) {
            measured_step *const a = &m->step[k], *const b = &m->step[i];
            if (fabs(a->temperature - b->temperature) < same_temperature)
                b->temperature = a->temperature;
            if (fabs(log(b->pressure / a->pressure)) < same_pressure)
                b->pressure = a->pressure;
        }
}

static void append_remark(char *remarks, size_t size, const char *words)
{
    clocale_append(remarks, size, "%s%s", remarks[0] != '\0' ? "; " : "", words);
}

void measured_steps_add_remark(measured *m, const char *words)
{
    append_remark(m->remarks, sizeof m->remarks, words);
}

void measured_default_remarks(const table_view *record, bool first_steps, char *remarks,
                              size_t size)
{
    bool velocity = false, temperature = false, pressure = false;
    double lightest = (double)INFINITY, heaviest = 0;
    for (size_t i = 0; i < record->n_rows; i++) {
        const double load = record_get(record, i, RECORD_NORMAL_FORCE);
        if (first_steps && record_get(record, i, RECORD_STEP) != 1)
            continue;
        velocity |= isnan(record_get(record, i, RECORD_VELOCITY));
        temperature |= isnan(record_get(record, i, RECORD_TEMPERATURE));
        pressure |= isnan(record_get(record, i, RECORD_PRESSURE));
        lightest = fmin(lightest, load); /* fmin and fmax skip NaN */
        heaviest = fmax(heaviest, load);
    }
    if (velocity)
        append_remark(remarks, size,
                      "the record does not say the velocity of every step: that of the case");
    if (temperature)
        append_remark(remarks, size,
                      "the record does not say the temperature of every step: that of the case");
    if (pressure)
        append_remark(remarks, size,
                      "the record does not say the nominal pressure of every step: that of the "
                      "case");
    if (pressure && heaviest > same_load * lightest)
        append_remark(remarks, size,
                      "the load changes between the steps, and the pressure with it: the steps "
                      "of another load do not test the theory alone");
}

/* Reads a row of the record. Missing conditions come from the case. */
static measured_step measured_step_read(const table_view *record, size_t row,
                                        const wt_sliding *sliding)
{
    const double velocity = record_get(record, row, RECORD_VELOCITY),
                 temperature = record_get(record, row, RECORD_TEMPERATURE),
                 pressure = record_get(record, row, RECORD_PRESSURE);
    const bool rests = isnan(velocity) && record_get(record, row, RECORD_ROTATION) == 0;
    measured_step s = {.velocity = rests             ? 0
                                   : isnan(velocity) ? flow_reference_velocity(sliding)
                                                     : velocity,
                       .temperature = temperature > 0 ? temperature : sliding->temperature.value,
                       .pressure = pressure > 0 ? pressure : sliding->pressure.value,
                       .friction = record_get(record, row, RECORD_FRICTION),
                       .error = record_get(record, row, RECORD_FRICTION_STANDARD_ERROR),
                       .file = record_text(record, row, RECORD_FILE)};
    s.measured = (wt_interval){s.friction, s.error, record_get(record, row, RECORD_FRICTION_LOW),
                               record_get(record, row, RECORD_FRICTION_HIGH)};
    s.note = exclusion_reason(&s);
    return s;
}

void measured_step_conditions(const measured_step *step, wt_sliding *sliding)
{
    const wt_estimate stated = sliding->pressure;
    const double relative = stated.standard_error / stated.value;
    sliding->pressure = (wt_estimate){
        step->pressure, isfinite(relative) ? relative * step->pressure : 0, 0, stated.unit};
    sliding->temperature.value = step->temperature;
}

wt_status measured_steps_read(const table_view *record, const wt_sliding *sliding, measured *m,
                              wt_error *err)
{
    *m = (measured){.step = wt_alloc(record->n_rows, sizeof *m->step)};
    for (size_t i = 0; i < record->n_rows; i++) {
        measured_step *const s = &m->step[m->n_all++];
        *s = measured_step_read(record, i, sliding);
        m->n += is_step_used(s);
    }
    measured_default_remarks(record, false, m->remarks, sizeof m->remarks);
    merge_fluctuations(m);
    qsort(m->step, m->n_all, sizeof *m->step, compare_conditions);
    if (m->n == 0) {
        wt_fail(err, WT_E_EMPTY, "no step of the record has a friction coefficient with an error");
        wt_error_advice(err, "longer records: the error comes from the scatter of the cycles");
        return WT_E_EMPTY;
    }
    if (m->n > MOST_STEPS) {
        wt_fail(err, WT_E_RANGE, "the records have too many steps");
        wt_error_expected(err, "%d at most", MOST_STEPS);
        wt_error_found(err, "%zu", m->n);
        return WT_E_RANGE;
    }
    return WT_OK;
}

void measured_steps_clear(measured *m)
{
    free(m->step);
    *m = (measured){.step = NULL};
}

size_t measured_group_length(const measured *m, size_t first)
{
    size_t n = 1;
    const measured_step *const a = &m->step[first];
    for (; first + n < m->n; n++) {
        const measured_step *const b = &m->step[first + n];
        const bool same = compare_values(a->temperature, b->temperature) == 0 &&
                          compare_values(a->pressure, b->pressure) == 0;
        if (!same)
            break;
    }
    return n;
}

/* ---- cycles of running-in -------------------------------------------------------------------- */

/* Fewer cycles do not show a course. */
enum { MIN_CYCLES = 16 };

/* A sample at the start is that of the bare surface at one time, and no mean of a cycle. */
static double remove_start(recorded_run *r)
{
    const double start = r->end[0];
    r->n--;
    memmove(r->end, r->end + 1, r->n * sizeof *r->end);
    memmove(r->friction, r->friction + 1, r->n * sizeof *r->friction);
    return start;
}

/* Converts middles of cycles to their ends, half-way to the next. Missing cycles before the first
 * have its duration. */
static bool convert_midpoints_to_ends(recorded_run *r, double lost, bool from_start)
{
    double *const t = r->end;
    const double first = t[1] - t[0];
    double start = t[0] - (0.5 + lost) * first;
    r->begin = lost * first;
    if (from_start) {
        start = remove_start(r);
        r->begin = 0.5 * first;
    }
    const double last = t[r->n - 1] - t[r->n - 2];
    for (size_t i = 0; i + 1 < r->n; i++) {
        if (!(t[i + 1] > t[i]))
            return false;
        t[i] = 0.5 * (t[i] + t[i + 1]) - start;
    }
    t[r->n - 1] += 0.5 * last - start;
    return true;
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
        const double time = record_cycles_get(cycles, i, RECORD_CYCLES_TIME),
                     distance = record_cycles_get(cycles, i, RECORD_CYCLES_DISTANCE);
        if (record_cycles_get(cycles, i, RECORD_CYCLES_STEP) != (double)r->step ||
            strcmp(record_cycles_text(cycles, i, RECORD_CYCLES_FILE), r->at.file) != 0 ||
            !isfinite(friction))
            continue;
        if (r->n < 2) {
            laps[r->n] = record_cycles_get(cycles, i, RECORD_CYCLES_LAPS);
            slid[r->n] = distance;
        }
        r->end[r->n] = isnan(time) ? distance / r->at.velocity : time;
        timed = timed && isfinite(r->end[r->n]);
        r->friction[r->n++] = friction;
    }
    const double lost = isnan(laps[0]) ? cycles_before(slid) : cycles_before(laps);
    const bool from_start =
        r->samples <= 1 && (laps[0] == 0 || slid[0] == 0 || (r->n > 0 && r->end[0] == 0));
    if (r->at.note[0] != '\0')
        r->note = r->at.note;
    else if (r->n < MIN_CYCLES + (size_t)from_start)
        r->note = "too few cycles to follow friction in time";
    else if (!timed)
        r->note = "neither time nor distance of its cycles is known";
    else if (!convert_midpoints_to_ends(r, lost, from_start))
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
                            .samples = record_get(record, row, RECORD_SAMPLES),
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
