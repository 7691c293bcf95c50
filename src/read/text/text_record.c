/* Converts the tables of a text export to a friction record. Each table is a step, and so is each
 * block of a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>

/* The quantity of a channel, and the header value that replaces an absent column. */
static const struct {
    wt_quantity quantity;
    header_value header;
} sources[WT_RECORD_CHANNELS] = {
    [WT_RECORD_TIME] = {WT_Q_TIME, HEADER_COUNT},
    [WT_RECORD_DISTANCE] = {WT_Q_SLIDING_DISTANCE, HEADER_COUNT},
    [WT_RECORD_LAPS] = {WT_Q_LAPS, HEADER_COUNT},
    [WT_RECORD_POSITION] = {WT_Q_POSITION_X, HEADER_COUNT},
    [WT_RECORD_FRICTION_FORCE] = {WT_Q_FRICTION_FORCE, HEADER_COUNT},
    [WT_RECORD_NORMAL_FORCE] = {WT_Q_NORMAL_FORCE, HEADER_LOAD},
    [WT_RECORD_COEFFICIENT] = {WT_Q_FRICTION_COEFFICIENT, HEADER_COUNT},
    [WT_RECORD_VELOCITY] = {WT_Q_VELOCITY, HEADER_VELOCITY},
    [WT_RECORD_ROTATION] = {WT_Q_ANGULAR_FREQUENCY, HEADER_COUNT},
    [WT_RECORD_PRESSURE] = {WT_Q_PRESSURE, HEADER_COUNT},
    [WT_RECORD_TEMPERATURE] = {WT_Q_TEMPERATURE, HEADER_TEMPERATURE},
    [WT_RECORD_WEAR_DEPTH] = {WT_Q_WEAR_DEPTH, HEADER_COUNT},
    [WT_RECORD_TORQUE] = {WT_Q_TORQUE, HEADER_COUNT},
};

static double channel_header_value(const text_table *t, int channel)
{
    const header_value h = sources[channel].header;
    return h < HEADER_COUNT ? t->header.value[h] : (double)NAN;
}

static void allocate_record(const text_file *file, wt_record *record)
{
    size_t rows = 0;
    for (size_t i = 0; i < file->n_tables; i++)
        rows += file->tables[i].n_rows;
    record->step = wt_alloc(rows, sizeof *record->step);
    for (int c = 0; c < WT_RECORD_CHANNELS; c++)
        for (size_t i = 0; i < file->n_tables && record->channel[c] == NULL; i++) {
            const text_table *t = &file->tables[i];
            if (text_table_column(t, sources[c].quantity, -1) == NULL &&
                isnan(channel_header_value(t, c)))
                continue;
            record->channel[c] = wt_alloc(rows, sizeof *record->channel[c]);
        }
}

static bool has_value(const wt_record *record, wt_record_channel c, size_t i)
{
    return record->channel[c] != NULL && isfinite(record->channel[c][i]);
}

/* True for a row with friction, and with time and laps where these are recorded. */
static bool is_sample(const wt_record *record, size_t i)
{
    return (has_value(record, WT_RECORD_COEFFICIENT, i) ||
            has_value(record, WT_RECORD_FRICTION_FORCE, i) ||
            has_value(record, WT_RECORD_TORQUE, i)) &&
           (record->channel[WT_RECORD_TIME] == NULL || has_value(record, WT_RECORD_TIME, i)) &&
           (record->channel[WT_RECORD_LAPS] == NULL || has_value(record, WT_RECORD_LAPS, i));
}

/* Adds the samples of a table. Other rows are skipped and counted in *n_left_out. */
static void add_table_samples(const text_table *t, wt_record *record, size_t *step,
                              size_t *n_left_out)
{
    const text_column *column[WT_RECORD_CHANNELS];
    for (int c = 0; c < WT_RECORD_CHANNELS; c++)
        column[c] = text_table_column(t, sources[c].quantity, -1);
    for (size_t r = 0; r < t->n_rows; r++) {
        for (int c = 0; c < WT_RECORD_CHANNELS; c++)
            if (record->channel[c] != NULL)
                record->channel[c][record->n] = column[c] != NULL
                                                    ? text_table_value(t, r, column[c])
                                                    : channel_header_value(t, c);
        *step += r > 0 && t->blocks[r] != t->blocks[r - 1];
        record->step[record->n] = *step;
        if (is_sample(record, record->n))
            record->n++;
        else
            ++*n_left_out;
    }
}

/* Makes time, distance or laps continue from step to step where they restart. Time and laps must
 * not decrease within a step; a measured distance may scatter. */
static wt_status make_continuous(const text_file *file, wt_record *record, wt_record_channel c,
                                 const char *what, wt_error *err)
{
    double *const x = record->channel[c];
    double shift = 0, last = (double)NAN;
    for (size_t i = 0; x != NULL && i < record->n; i++) {
        const bool begins = i > 0 && record->step[i] != record->step[i - 1];
        if (begins && x[i] + shift < last)
            shift = last - x[i];
        x[i] += shift;
        if (x[i] < last && c != WT_RECORD_DISTANCE) {
            const wt_status status = wt_fail(err, WT_E_CORRUPT, "%s falls within a step", what);
            wt_error_expected(err, "samples in the order in which they were taken");
            wt_error_found(err, "%g behind %g at sample %zu", x[i], last, i + 1);
            wt_error_file(err, file->name);
            return status;
        }
        last = isnan(x[i]) ? last : x[i];
    }
    return WT_OK;
}

/* Reverses the sign of the normal force if it is negative under load, as for many instruments. */
static void orient_load(const text_file *file, wt_record *record, wt_log *log)
{
    double *const load = record->channel[WT_RECORD_NORMAL_FORCE];
    size_t negative = 0, positive = 0;
    for (size_t i = 0; load != NULL && i < record->n; i++) {
        negative += load[i] < 0;
        positive += load[i] > 0;
    }
    if (negative <= positive)
        return;
    for (size_t i = 0; i < record->n; i++)
        load[i] = -load[i];
    wt_log_add(log, WT_NOTE, file->name, NULL,
               "the normal force is negative when it presses; it is turned round");
}

/* Warns of unread columns. Without an optional column the record is valid but incomplete. */
static void warn_unread_columns(const text_file *file, const text_table *t, wt_log *log)
{
    for (size_t i = 0; i < t->n_problems; i++) {
        const text_column *const c = &t->problems[i];
        const char *const quantity = wt_quantity_id(c->rule->quantity);
        if (c->problem == COLUMN_BAD_UNIT)
            wt_log_add(log, WT_WARNING, file->name, NULL,
                       "column \"%s\" is not read: \"%s\" is no unit of %s", c->name, c->unit,
                       quantity);
        else if (c->problem == COLUMN_NO_UNIT)
            wt_log_add(log, WT_WARNING, file->name, NULL,
                       "column \"%s\" is not read: the file does not say its unit (%s; give it "
                       "with --units)",
                       c->name, quantity);
    }
}

static wt_status fill_record(const text_file *file, wt_record *record, wt_log *log, wt_error *err)
{
    size_t step = 0, left_out = 0;
    wt_status status = WT_OK;
    for (size_t i = 0; i < file->n_tables && status == WT_OK; i++) {
        const text_table *t = &file->tables[i];
        const size_t before = record->n;
        status = text_table_require(t, WT_KIND_RECORD, err);
        if (status == WT_OK)
            add_table_samples(t, record, &step, &left_out);
        warn_unread_columns(file, t, log);
        if (isnan(record->radius))
            record->radius = t->header.value[HEADER_RADIUS];
        step += record->n > before;
    }
    if (status == WT_OK && record->n == 0)
        status = text_fail_empty(file, "record of friction", err);
    if (left_out > 0)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, left_out, "--columns", file->name, NULL,
                      "%zu row%s without friction or without a time left out", left_out,
                      left_out == 1 ? "" : "s");
    return status;
}

/* Checks the steps of each block, since a step may restart its time. */
static void check_steps(const text_file *file, wt_log *log)
{
    for (size_t i = 0; i < file->n_tables; i++) {
        const text_table *const t = &file->tables[i];
        for (size_t first = 0, end = 0; first < t->n_rows; first = end) {
            while (end < t->n_rows && t->blocks[end] == t->blocks[first])
                end++;
            text_check_steps(file, t, -1, first, end, log);
        }
    }
}

wt_status text_read_record(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_record *record, wt_error *err)
{
    text_file file;
    wt_record made = {.radius = (double)NAN};
    wt_status status = text_scan(self, input, WT_KIND_RECORD, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    allocate_record(&file, &made);
    status = fill_record(&file, &made, log, err);
    if (status == WT_OK)
        status = make_continuous(&file, &made, WT_RECORD_TIME, "time", err);
    if (status == WT_OK)
        status = make_continuous(&file, &made, WT_RECORD_DISTANCE, "distance", err);
    if (status == WT_OK)
        status = make_continuous(&file, &made, WT_RECORD_LAPS, "the number of laps", err);
    if (status == WT_OK) {
        orient_load(&file, &made, log);
        check_steps(&file, log);
        *record = made;
    } else {
        wt_record_clear(&made);
    }
    text_file_free(&file);
    return status;
}
