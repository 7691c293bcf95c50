/* Job of friction records: it reduces the samples of a tribometer to friction that a theory can be
 * compared with.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/record.h"
#include "core/base/array.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "record/numerics/pauses.h"
#include "record/numerics/steady_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef void stored_row_callback(void *user, const table_view *view, size_t row);

/* Copies the rows of a table of the result, if it exists, to the table that is written. `each` is
 * called with every row. */
static wt_status stored_record_copy_rows(const wt_result *result, const table_schema *schema,
                                         table_writer *t, stored_row_callback *each, void *user,
                                         wt_error *err)
{
    table_view view = {0};
    const wt_status status = table_bind_result(result, schema, "", &view, err);
    if (status != WT_OK || view.table == NULL)
        return status;
    table_block(t);
    for (size_t row = 0; row < view.n_rows; row++) {
        table_row(t);
        for (unsigned c = 0; schema->columns[c].name != NULL; c++)
            if (!view_has_column(&view, schema, c))
                continue;
            else if (schema->columns[c].kind == SCHEMA_TEXT)
                writer_text(t, schema, c, view_text(&view, schema, row, c));
            else
                writer_number(t, schema, c, view_number(&view, schema, row, c));
        if (each != NULL)
            each(user, &view, row);
    }
    return WT_OK;
}

/* Fewest samples per cycle. With fewer, the mean of a cycle contains a variable part of its
 * wave. */
static const double fewest_samples = 20;
/* Tolerance between the coefficient of a file and its forces: the digits of a display. */
static const double same_friction = 0.01;

/* ---- one step -------------------------------------------------------------------------------- */

static const wt_interval not_known = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

TABLE_ROW(record, RECORD, record_conditions at; wt_steady steady;
          wt_interval drift, end, end_time, end_distance; const char *end_note;
          double zero, difference, samples, pauses, paused; size_t cycles, step;
          const char *averaged_over, *note, *file; steady_decay_kind decay; double left;)

TABLE_ROW(record_cycles, RECORD_CYCLES, wt_cycle cycle; size_t number; bool steady; size_t step;
          const char *file;)

typedef struct running_in_end {
    wt_interval cycles;
    size_t steady_start;
    const char *why_not;
} running_in_end;

static running_in_end find_running_in_end(const wt_record_job *job, const double *y, size_t n)
{
    if (job->running_in == WT_RUNNING_IN_LIKELIHOOD) {
        const wt_running_in found = wt_running_in_find(y, n);
        return (running_in_end){found.end, found.steady_start, found.reason};
    }
    return (running_in_end){not_known, 0, "not looked for"};
}

static double cycle_middle(const wt_cycle *cycle, bool distance)
{
    return distance ? cycle->distance : cycle->time;
}

/* Time or distance at the beginning of a cycle from the beginning of the step on: half-way between
 * the middles. */
static double cycle_start(const wt_cycle *c, size_t n, double number, bool distance)
{
    if (isnan(number) || n < 2)
        return (double)NAN;
    const size_t k = (size_t)number;
    const double first = cycle_middle(&c[0], distance),
                 start = first - 0.5 * (cycle_middle(&c[1], distance) - first);
    if (k == 0)
        return 0;
    return k < n ? 0.5 * (cycle_middle(&c[k - 1], distance) + cycle_middle(&c[k], distance)) - start
                 : cycle_middle(&c[n - 1], distance) - start;
}

static wt_interval interval_in_units(const wt_cycle *c, size_t n, wt_interval cycles, bool distance)
{
    const double value = cycle_start(c, n, cycles.value, distance),
                 low = cycle_start(c, n, cycles.low, distance),
                 high = cycle_start(c, n, cycles.high, distance);
    const double per_cycle = cycles.high > cycles.low
                                 ? (high - low) / (cycles.high - cycles.low)
                                 : cycle_start(c, n, fmin(cycles.value, 1), distance);
    return (wt_interval){value, cycles.standard_error * per_cycle, low, high};
}

static const char *cycle_kind_name(wt_cycle_kind kind)
{
    static const char *const words[] = {"", "double stroke", "lap", "span of time", "sample"};
    return words[kind];
}

static void append_note(char *note, size_t size, const char *words)
{
    if (words[0] != '\0')
        clocale_append(note, size, "%s%s", note[0] != '\0' ? "; " : "", words);
}

/* Counts the pauses within a step. A record without time does not determine them. */
static void count_pauses(const record_pauses *pauses, const wt_cycle *first, const wt_cycle *last,
                         record_row *r, char *note, size_t size)
{
    char words[120];
    r->pauses = r->paused = isnan(first->time) ? (double)NAN : 0;
    for (size_t i = 0; i < pauses->n; i++)
        if (pauses->of[i].before > first->first && pauses->of[i].before < last->first + last->n) {
            r->pauses++;
            r->paused += pauses->of[i].time;
        }
    if (!(r->pauses > 0))
        return;
    clocale_print(words, sizeof words, "%.0f pause%s of %s%.4g s left out", r->pauses,
                  r->pauses > 1 ? "s" : "", r->pauses > 1 ? "together " : "", r->paused);
    append_note(note, size, words);
}

static void note_decay(const wt_job *work, const record_row *r, char *note, size_t size)
{
    static const char *const words[] = {
        "", "the plateau of a decay is reported",
        "ends before it is steady: the plateau of its decay is reported",
        "ends before it is steady: the plateau of its decay is not known"};
    append_note(note, size, words[r->decay]);
    if (r->decay >= DECAY_GOES_ON)
        wt_log_add(
            work->log, WT_WARNING, r->file, NULL,
            "step %zu ends before friction is steady: it still changes by about %.2g, and %s",
            r->step, -r->left,
            r->decay == DECAY_GOES_ON
                ? "the reported friction is the plateau of this decay"
                : "to which value is not known; the mean of the last part is reported");
}

/* Notes the limitations of a step. */
static void note_step(const wt_job *work, const wt_cycles *cycles, const record_row *r, char *note,
                      size_t size)
{
    char words[160];
    const bool periodic = cycles->kind == WT_CYCLE_LAP || cycles->kind == WT_CYCLE_STROKE;
    append_note(note, size, r->steady.note);
    note_decay(work, r, note, size);
    if (periodic && cycles->samples < fewest_samples)
        append_note(note, size, "few samples in a cycle: its mean holds a part of its wave");
    if (isnan(r->end.value) && r->steady.n < r->cycles && r->decay < DECAY_GOES_ON) { /* no end was
                                                             found, and yet a part is truncated */
        append_note(note, size, "not steady: the last tenth is reported");
        wt_log_add(work->log, WT_WARNING, r->file, NULL,
                   "friction does not become steady before the last tenth of step %zu, whose "
                   "mean is reported",
                   r->step);
    }
    if (r->drift.low * r->drift.high > 0) {
        clocale_print(words, sizeof words, "drifts by %.2g over the steady part", r->drift.value);
        append_note(note, size, words);
    }
    if (conditions_are_at_rest(r->at))
        append_note(note, size, "nothing slides in it");
    else if (isnan(r->at.velocity) && !isnan(r->at.rotation))
        append_note(note, size, "velocity not known: give --track-radius");
    if (fabs(r->zero) > r->steady.mean.value) {
        clocale_print(words, sizeof words,
                      "an offset of %.3g, above the friction, is removed: half the difference "
                      "of the directions is reported",
                      r->zero);
        append_note(note, size, words);
    }
    if (cycles->kind == WT_CYCLE_STROKE && !cycles->has_zero)
        append_note(note, size, "friction has no sign, so that its zero is not known");
}

static double mean_zero_offset(const wt_cycle *cycles, size_t n)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < n; i++)
        if (!isnan(cycles[i].zero)) {
            sum += cycles[i].zero;
            count++;
        }
    return count > 0 ? sum / count : (double)NAN;
}

static wt_status measure_step(const wt_record_job *job, const wt_cycle *cycle, size_t n,
                              record_row *r, size_t *steady_start, wt_error *err)
{
    double *const y = wt_alloc(n, sizeof *y);
    for (size_t i = 0; i < n; i++)
        y[i] = cycle[i].coefficient;
    running_in_end end = find_running_in_end(job, y, n);
    const size_t from = end.steady_start < n ? end.steady_start : 0;
    const wt_cycle *const steady = cycle + from;
    const wt_status status = wt_steady_mean(y + from, n - from, &r->steady, err);
    if (status == WT_OK && job->running_in == WT_RUNNING_IN_LIKELIHOOD &&
        (r->steady.drift.low * r->steady.drift.high > 0 || from > 0))
        r->decay = steady_decay_follow(y, n, &r->steady.mean, &r->left);
    if (r->decay >= DECAY_GOES_ON) {
        end.cycles = not_known;
        end.why_not = "it continues to the end of the record";
    }
    free(y);
    r->at = conditions_mean(steady, n - from);
    const double cycles = (double)(n - from) - 1; /* the drift is that of a cycle */
    r->drift =
        (wt_interval){r->steady.drift.value * cycles, r->steady.drift.standard_error * cycles,
                      r->steady.drift.low * cycles, r->steady.drift.high * cycles};
    r->end = end.cycles;
    r->end_time = interval_in_units(cycle, n, end.cycles, false);
    r->end_distance = interval_in_units(cycle, n, end.cycles, true);
    r->end_note = end.why_not;
    r->zero = mean_zero_offset(steady, n - from);
    r->cycles = n;
    *steady_start = from;
    return status;
}

/* ---- one file -------------------------------------------------------------------------------- */

/* Rows so far, for their common conditions. */
typedef struct common_rows {
    record_group friction;
    record_conditions first;
    bool alike;
} common_rows;

typedef struct record_writers {
    table_writer record, cycles, wear;
    common_rows all;
    bool has_wear;    /* requested, or read from a stored record */
    wear_rates rates; /* of it */
    size_t n_files;
} record_writers;

/* Rows at rest have no friction coefficient of sliding. */
static void add_row_friction(common_rows *all, const record_row *r)
{
    if (conditions_are_at_rest(r->at))
        return;
    if (!(all->friction.n > 0)) {
        all->first = r->at;
        all->alike = true;
    }
    all->alike = all->alike && conditions_are_equal(all->first, r->at);
    record_group_add(&all->friction,
                     (wt_estimate){r->steady.mean.value, r->steady.mean.standard_error, 0, "1"});
}

static wt_status add_steps(const wt_record_job *job, const wt_job *work, const wt_cycles *cycles,
                           const record_pauses *pauses, const char *file, record_writers *w,
                           wt_error *err)
{
    wt_status status = WT_OK;
    size_t step = 0;
    for (size_t first = 0, n; first < cycles->n && status == WT_OK; first += n) {
        char note[512] = "";
        size_t from = 0;
        record_row r = {.difference = cycles->difference,
                        .samples = cycles->samples,
                        .averaged_over = cycle_kind_name(cycles->kind),
                        .step = ++step,
                        .note = note,
                        .file = file};
        const wt_cycle *const cycle = cycles->cycle + first;
        n = conditions_step_length(cycle, cycles->n - first);
        status = measure_step(job, cycle, n, &r, &from, err);
        if (status != WT_OK)
            return status;
        count_pauses(pauses, cycle, cycle + n - 1, &r, note, sizeof note);
        note_step(work, cycles, &r, note, sizeof note);
        record_add_row(&w->record, &r);
        add_row_friction(&w->all, &r);
        table_block(&w->cycles);
        for (size_t i = 0; i < n; i++)
            TABLE_ADD(record_cycles, &w->cycles, cycle[i], i + 1, i >= from, step, file);
    }
    return status;
}

static void warn_difference(const wt_job *work, const wt_cycles *cycles, const char *file)
{
    double sum = 0;
    for (size_t i = 0; i < cycles->n; i++)
        sum += cycles->cycle[i].coefficient;
    if (cycles->difference > same_friction * sum / (double)cycles->n)
        wt_log_action(work->log, WT_WARNING, WT_CONTRADICTED, cycles->n, "--columns", file, NULL,
                      "the friction coefficient of the file and its friction force over its load "
                      "differ by up to %.3g; the first is used",
                      cycles->difference);
}

static void warn_pauses(const wt_job *work, const record_pauses *pauses, const char *file)
{
    double all = 0;
    for (size_t i = 0; i < pauses->n; i++)
        all += pauses->of[i].time;
    if (pauses->n > 0)
        wt_log_action(work->log, WT_WARNING, WT_LEFT_OUT, pauses->n, WT_KEEP_OPTION, file, NULL,
                      pauses->n > 1 ? "%zu pauses of together %.4g s were left out, the first at "
                                      "%.4g s of sliding; a pause is not sliding time"
                                    : "%zu pause of %.4g s was left out at %.4g s of sliding; a "
                                      "pause is not sliding time",
                      pauses->n, all, pauses->of[0].at);
    if (pauses->alike > 0)
        wt_log_add(work->log, WT_WARNING, file, NULL,
                   "%zu equal gaps in the time are treated as pauses of the recorder while "
                   "sliding continues; no column of distance, laps or velocity confirms it",
                   pauses->alike);
}

/* Radius of a disc from distance and laps. NaN if the record lacks one of them. */
static double track_radius_from_laps(const wt_record *record)
{
    const double *const distance = record->channel[WT_RECORD_DISTANCE],
                        *const laps = record->channel[WT_RECORD_LAPS];
    const size_t last = record->n - 1;
    if (distance == NULL || laps == NULL || record->n == 0)
        return (double)NAN;
    const double radius = (distance[last] - distance[0]) / (2 * M_PI * (laps[last] - laps[0]));
    return radius > 0 && isfinite(radius) ? radius : (double)NAN;
}

/* The track length needs the radius. A record of laps determines it for a disc. */
static wt_status measure_wear(const wt_record_job *job, const wt_job *work, const wt_record *record,
                              const wt_cycles *cycles, wt_estimate radius, const char *file,
                              record_writers *w, wt_error *err)
{
    if (isnan(radius.value) && isnan(job->track_length.value) && cycles->kind != WT_CYCLE_STROKE) {
        radius.value = track_radius_from_laps(record);
        if (!isnan(radius.value))
            wt_log_add(work->log, WT_WARNING, file, NULL,
                       "the track is %.4g mm long by distance and laps, treated as that of a disc; "
                       "if it is not, give its length with --track-length",
                       2e3 * M_PI * radius.value);
    }
    return wear_add(job, record, cycles, radius, file, &w->wear, &w->rates, err);
}

/* ---- stored result --------------------------------------------------------------------------- */

static void count_stored(void *user, const table_view *v, size_t row)
{
    const record_row r = {.at = {.velocity = record_get(v, row, RECORD_VELOCITY),
                                 .rotation = record_get(v, row, RECORD_ROTATION),
                                 .normal_force = record_get(v, row, RECORD_NORMAL_FORCE),
                                 .pressure = record_get(v, row, RECORD_PRESSURE),
                                 .temperature = record_get(v, row, RECORD_TEMPERATURE)},
                          .steady.mean.value = record_get(v, row, RECORD_FRICTION),
                          .steady.mean.standard_error =
                              record_get(v, row, RECORD_FRICTION_STANDARD_ERROR)};
    add_row_friction(user, &r);
}

static void count_stored_wear(void *user, const table_view *v, size_t row)
{
    wear_rates *const rates = user;
    if (row > 0 && strcmp(wear_text(v, row, WEAR_FILE), wear_text(v, row - 1, WEAR_FILE)) != 0)
        wear_rates_close_run(rates);
    const double rate = wear_get(v, row, WEAR_RATE);
    if (!isnan(rate))
        record_group_add(
            &rates->run,
            (wt_estimate){rate, wear_get(v, row, WEAR_RATE_STANDARD_ERROR), 0, "m^2/N"});
}

static void begin_wear(record_writers *w, wt_error *err)
{
    if (!w->has_wear)
        w->wear = table_begin(&wear_schema, err);
    w->has_wear = true;
}

/* Adds the rows of a stored record to those that are measured in this call. */
static wt_status read_stored_record(const wt_job *work, const flow_file *file, record_writers *w,
                                    wt_error *all, wt_error *err)
{
    const wt_tables_role role = {NULL, WT_ROLE_RECORD, "what weartrack record wrote"};
    wt_result *result = NULL;
    wt_status status = wt_tables_read(file->path, file->name, work, role, &result, err);
    if (status == WT_OK && wt_result_find(result, "record") == NULL) {
        status = wt_fail(err, WT_E_EMPTY, "the result holds no record of friction");
        wt_error_advice(err, "give what weartrack record wrote");
    }
    if (status == WT_OK)
        status =
            stored_record_copy_rows(result, &record_schema, &w->record, count_stored, &w->all, err);
    if (status == WT_OK)
        status =
            stored_record_copy_rows(result, &record_cycles_schema, &w->cycles, NULL, NULL, err);
    if (status == WT_OK && wt_result_find(result, "wear") != NULL) {
        begin_wear(w, all);
        status = stored_record_copy_rows(result, &wear_schema, &w->wear, count_stored_wear,
                                         &w->rates, err);
        wear_rates_close_run(&w->rates);
    }
    wt_result_free(result);
    if (status != WT_OK)
        wt_error_file(err, file->name);
    w->n_files += status == WT_OK;
    return status;
}

/* True if a file is a result of weartrack: a text stream or HDF5. A pipe, also a named one, can be
 * read only once. It is treated as a measured record. */
static bool is_stored(const flow_file *file)
{
    static const char *const begins[] = {"\x89HDF\r\n\x1a\n", "## weartrack:"};
    wt_input *input = NULL;
    struct stat found;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    const bool is_read = stat(file->path, &found) == 0 && S_ISREG(found.st_mode) &&
                         wt_input_open(file->path, &input, NULL) == WT_OK &&
                         wt_input_bytes(input, &bytes, &length, NULL) == WT_OK;
    bool stored = false;
    for (size_t i = 0; is_read && i < COUNT_OF(begins); i++)
        stored |= length >= strlen(begins[i]) && memcmp(bytes, begins[i], strlen(begins[i])) == 0;
    wt_input_close(input);
    return stored;
}

static wt_status measure_file(const wt_record_job *job, const wt_job *work, flow_file *file,
                              record_writers *w, wt_error *err)
{
    wt_input *input = NULL;
    wt_record record = {.n = 0};
    wt_cycles cycles = {.n = 0};
    record_pauses pauses = {.n = 0};
    wt_status status = flow_open(work, file, WT_ROLE_RECORD, WT_KIND_RECORD, &input, err);
    const wt_read_options read = flow_read_options(file);
    if (status == WT_OK)
        status = wt_record_read(work->formats, input, &read, work->log, &record, err);
    wt_input_close(input);
    if (status == WT_OK)
        status = flow_check_copy(file, condition_hash_record(file, &record), work);
    const wt_estimate stated = job->track_radius, read_radius = {record.radius, 0, 0, "m"},
                      radius = isnan(stated.value) ? read_radius : stated;
    wt_record_torque_to_force(&record, radius.value);
    if (status == WT_OK && read.conditioning == WT_CONDITIONING_MEND) {
        condition_record(&record, file->name, work->log);
        pauses = record_remove_pauses(&record);
    }
    if (status == WT_OK)
        status =
            wt_cycles_compute(&record, job->cycle, radius.value, job->load.value, &cycles, err);
    if (status == WT_OK && cycles.n == 0)
        status = wt_fail(err, WT_E_EMPTY, "the record holds no whole cycle");
    if (status == WT_OK) {
        warn_difference(work, &cycles, file->name);
        check_friction_coefficient(cycles.cycle[cycles.n / 2].coefficient, file->name, work->log);
        warn_pauses(work, &pauses, file->name);
        if (cycles.n_unloaded > 0)
            wt_log_action(work->log, WT_WARNING, WT_LEFT_OUT, cycles.n_unloaded, WT_KEEP_OPTION,
                          file->name, NULL, "%zu of %zu samples are at no load and left out",
                          cycles.n_unloaded, record.n);
        status = add_steps(job, work, &cycles, &pauses, file->name, w, err);
    }
    if (status == WT_OK && wear_is_requested(job))
        status = measure_wear(job, work, &record, &cycles, radius, file->name, w, err);
    if (status != WT_OK)
        wt_error_file(err, file->name);
    free(pauses.of);
    wt_cycles_clear(&cycles);
    wt_record_clear(&record);
    w->n_files += status == WT_OK;
    return status;
}

typedef struct record_task {
    const wt_record_job *job;
    const wt_job *work;
    record_writers *w;
    wt_error *all; /* error of the tables, independent of the file */
} record_task;

static wt_status process_file(void *user, flow_file *file, size_t i, wt_error *err)
{
    const record_task *const task = user;
    (void)i;
    return is_stored(file) ? read_stored_record(task->work, file, task->w, task->all, err)
                           : measure_file(task->job, task->work, file, task->w, err);
}

/* ---- tables ---------------------------------------------------------------------------------- */

static wt_status end_tables(record_writers *w, wt_status status, wt_record_tables *made)
{
    record_set_print(&w->record, RECORD_KEY_N_FILES, "%zu", w->n_files);
    if (w->all.friction.n > 0 && w->all.alike)
        record_set(&w->record, RECORD_KEY_FRICTION, record_group_mean(&w->all.friction, "1"));
    if (w->has_wear && w->rates.all.n > 0) {
        wear_set(&w->wear, WEAR_KEY_RATE, record_group_mean(&w->rates.all, "m^2/N"));
        wear_set_value(&w->wear, WEAR_KEY_RATE_DF, wear_rates_df(&w->rates), 0, 0);
    }
    const wt_status written[] = {table_end(&w->record, &made->record),
                                 table_end(&w->cycles, &made->record_cycles),
                                 w->has_wear ? table_end(&w->wear, &made->wear) : WT_OK};
    for (size_t i = 0; i < COUNT_OF(written); i++)
        status = status != WT_OK ? status : written[i];
    return status;
}

static wt_status make_record_tables(const wt_record_job *job, const wt_job *work,
                                    const flow_files *files, wt_record_tables *made, wt_error *err)
{
    size_t n_failed;
    record_writers w = {.record = table_begin(&record_schema, err),
                        .cycles = table_begin(&record_cycles_schema, err)};
    if (wear_is_requested(job))
        begin_wear(&w, err);
    record_cycles_set_text(&w.cycles, RECORD_CYCLES_KEY_AVERAGED_OVER,
                           job->cycle == WT_CYCLE_AUTO ? "result of each record"
                                                       : cycle_kind_name(job->cycle));
    record_task task = {job, work, &w, err};
    wt_status status = flow_files_process(files, work, process_file, &task, &n_failed, err);
    if (status == WT_OK && w.n_files == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no record of friction could be read");
        flow_error_add_files(files, n_failed, err);
    }
    cost_report(work, (cost_summary){.items = (double)w.n_files});
    return end_tables(&w, status, made);
}

wt_status wt_record_job_check(const wt_record_job *job, wt_error *err)
{
    if (job->profile != NULL && !isnan(job->track_area.value))
        return wt_fail(err, WT_E_ARG,
                       "profile and track-area both state the loss of the "
                       "track: give one of them");
    if (isnan(job->mass_loss.value) == isnan(job->density.value))
        return WT_OK;
    const char *const missing = isnan(job->density.value) ? "density" : "mass-loss";
    const wt_status status = wt_fail(err, WT_E_ARG, "no %s, and a volume takes both", missing);
    wt_error_advice(err, "give mass-loss, such as 3mg, and density, such as 1150kg/m^3");
    return status;
}

wt_status wt_record_compute(const wt_record_job *job, const wt_job *work, wt_record_tables *tables,
                            wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of records");
    flow_files files = {0};
    wt_record_tables made = {0};
    wt_status status = param_check(wt_record_job_params(), job, err);
    if (status == WT_OK)
        status = wt_record_job_check(job, err);
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    wt_record_job whole = *job;
    if (status == WT_OK && job->profile != NULL && job->n_sets > 0)
        status = wear_profile_area(job, work, &whole.track_area, err);
    if (status == WT_OK)
        status = make_record_tables(&whole, work, &files, &made, err);
    flow_files_clear(&files);
    if (status == WT_OK) {
        *tables = made;
        made = (wt_record_tables){0};
    }
    wt_tables_clear(&made, sizeof made);
    return status;
}
