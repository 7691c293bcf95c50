/* Converts the tables of a text export to the sweeps of a DMA measurement.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_sweep.h"

#include "core/base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Maximum number of decades that an instrument sweeps at one temperature. */
static const double decades_max = 7;

/* Warns of a master curve of another program, which looks like one isotherm. */
static void warn_shifted(const sweep_builder *b, double low, double high)
{
    const double decades = log10(high / low);
    if (decades > decades_max)
        wt_log_add(b->log, WT_WARNING, b->file->name,
                   format_line_position(b->table->names_line).text,
                   "%s over %.1f decades at one temperature: this looks like a "
                   "master curve that was shifted already; export the measured isotherms",
                   b->c.step != NULL ? "times" : "frequencies", decades);
}

/* Names an isotherm by its source; one of several strain amplitudes also by its amplitude. */
static void name_isotherm(const sweep_builder *b, wt_isotherm *isotherm)
{
    char amplitude[24] = "";
    if (b->amplitudes && isotherm->strain != NULL)
        clocale_print(amplitude, sizeof amplitude, " (%.3g %%)", 100 * isotherm->strain[0]);
    sweep_format_source(b, isotherm->source, sizeof isotherm->source - strlen(amplitude));
    strcat(isotherm->source, amplitude);
}

/* True if the temperature of the collected rows changes from the first to the last third by more
 * than a sensor scatters, and the header states no set temperature. */
static bool temperature_drifts(const sweep_builder *b)
{
    static const double drift_least = 0.3; /* [K] */
    const size_t n = b->n / 3;
    double change = 0;
    for (size_t i = 0; i < n; i++)
        change += sweep_temperature(b, b->rows[b->n - 1 - i]) - sweep_temperature(b, b->rows[i]);
    return n > 0 && fabs(change) > drift_least * (double)n &&
           (isnan(b->table->header.value[HEADER_TEMPERATURE]) ||
            b->table->header.priority[HEADER_TEMPERATURE] != HEADER_OVERRIDES);
}

/* Creates an isotherm from the collected rows, if the frequency varies. */
static wt_status finish_isotherm(sweep_builder *b)
{
    double low = (double)INFINITY, high = 0;
    const char *title = b->table->title;
    for (size_t i = 0; i < b->n; i++) {
        low = fmin(low, sweep_angular_frequency(b, b->rows[i]));
        high = fmax(high, sweep_angular_frequency(b, b->rows[i]));
    }
    if (b->n == 0)
        return WT_OK;
    if (!(high > low * (1 + SAME_FREQUENCY))) {
        wt_log_add(b->log, WT_NOTE, b->file->name, format_line_position(b->table->names_line).text,
                   "%s%s%zu points at one %s, left out", title, title[0] != '\0' ? ": " : "", b->n,
                   b->c.step != NULL ? "time" : "frequency: not a frequency sweep");
        b->n = 0;
        return WT_OK;
    }
    warn_shifted(b, low, high);
    wt_isotherm *isotherm =
        wt_sweep_add(b->sweep, b->n,
                     sweep_optional_arrays(&b->c) |
                         (temperature_drifts(b) ? (unsigned)WT_SWEEP_HAS_TEMPERATURE : 0));
    for (size_t i = 0; i < b->n; i++) {
        isotherm->angular_frequency[i] = sweep_angular_frequency(b, b->rows[i]);
        isotherm->storage_modulus[i] = sweep_storage_modulus(b, b->rows[i]);
        isotherm->loss_modulus[i] = sweep_loss_modulus(b, b->rows[i]);
        if (b->c.strain != NULL)
            isotherm->strain[i] = text_table_value(b->table, b->rows[i], b->c.strain);
        if (isotherm->loss_factor != NULL)
            isotherm->loss_factor[i] = sweep_loss_factor(b, b->rows[i]);
        if (isotherm->point_temperature != NULL)
            isotherm->point_temperature[i] = sweep_temperature(b, b->rows[i]);
    }
    name_isotherm(b, isotherm);
    wt_status status =
        sweep_set_temperature(b, &isotherm->temperature, &isotherm->temperature_spread);
    b->n = 0;
    return status;
}

/* True if a row has the block and temperature of the previous one. */
static bool is_same_isotherm(const sweep_builder *b, size_t last, size_t row)
{
    const double jump = b->file->description->temperature_jump;
    return b->table->blocks[row] == b->table->blocks[last] &&
           !(fabs(sweep_temperature(b, row) - sweep_temperature(b, last)) > jump);
}

/* Splits rows into isotherms: at the end of a block, a reversal of the frequency or a jump of the
 * temperature. */
static wt_status split_rows(sweep_builder *b, const size_t *rows, size_t n)
{
    int direction = 0;
    wt_status status = WT_OK;
    b->n = 0;
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        if (b->n > 0) {
            const size_t row = rows[i], last = b->rows[b->n - 1];
            const int way = sweep_direction(b, last, row);
            if (way * direction < 0 || !is_same_isotherm(b, last, row)) {
                status = finish_isotherm(b);
                direction = 0;
            } else if (way != 0) {
                direction = way;
            }
        }
        b->rows[b->n++] = rows[i];
    }
    return status == WT_OK ? finish_isotherm(b) : status;
}

/* Maximum ratio of amplitudes with the same set value. */
static const double same_amplitude = 1.5;

static bool has_other_amplitude(const sweep_builder *b, size_t row, size_t other)
{
    const double ratio = text_table_value(b->table, row, b->c.strain) /
                         text_table_value(b->table, other, b->c.strain);
    return ratio > same_amplitude || ratio < 1 / same_amplitude;
}

/* Groups the rows by amplitude if several amplitudes alternate at each frequency. The frequency
 * then reverses between the groups. */
static void group_amplitudes(sweep_builder *b, size_t *rows, size_t n)
{
    bool turns = false;
    for (size_t i = 1; i < n && !turns; i++)
        turns = b->table->blocks[rows[i]] == b->table->blocks[rows[i - 1]] &&
                sweep_direction(b, rows[i - 1], rows[i]) == 0 &&
                has_other_amplitude(b, rows[i], rows[i - 1]);
    b->amplitudes = turns;
    for (size_t first = 0, end, done; turns && first < n; first = done) {
        /* a block at one temperature */
        for (end = first + 1; end < n && is_same_isotherm(b, rows[end - 1], rows[end]);)
            end++;
        const size_t like = rows[first];
        size_t n_others = 0;
        done = first;
        for (size_t i = first; i < end; i++)
            if (has_other_amplitude(b, rows[i], like))
                b->rows[n_others++] = rows[i];
            else
                rows[done++] = rows[i];
        memcpy(rows + done, b->rows, n_others * sizeof *rows);
    }
}

/* Splits the rows of one sample into sweeps. */
static wt_status split_sample(sweep_builder *b, size_t *rows, size_t n)
{
    const bool swept = b->c.step == NULL;
    wt_status status = WT_OK;
    collect_scattered_rows(b, rows, n);
    if (swept)
        status = extract_strain_sweeps(b, rows, &n);
    if (status == WT_OK && swept)
        extract_ramps(b, rows, &n);
    if (status == WT_OK && swept && b->c.strain != NULL)
        group_amplitudes(b, rows, n);
    return status == WT_OK ? split_rows(b, rows, n) : status;
}

/* Sets the sample name of the sweeps added since `from`, by the column or the file. */
static void name_sample(const sweep_builder *b, const wt_sweep *from)
{
    wt_sweep *const s = b->sweep;
    const bool by_file = b->options->sample_by == WT_SAMPLE_BY_FILE;
    const char *name = by_file                  ? wt_path_base(b->file->name)
                       : b->sample != NO_SAMPLE ? b->file->samples.items[b->sample]
                                                : NULL;
    for (size_t i = from->n_isotherms; name != NULL && i < s->n_isotherms; i++)
        s->isotherms[i].sample = wt_strdup(name);
    for (size_t i = from->n_ramps; name != NULL && i < s->n_ramps; i++)
        s->ramps[i].sample = wt_strdup(name);
    for (size_t i = from->n_strain_sweeps; name != NULL && i < s->n_strain_sweeps; i++)
        s->strain_sweeps[i].sample = wt_strdup(name);
}

static void remove_samples(const text_table *t)
{
    for (size_t row = 0; row < t->n_rows; row++)
        t->samples[row] = NO_SAMPLE;
}

/* Keeps the samples of a column such as "Specimen" or "Run" only if they repeat one grid. */
static void check_guessed_samples(const sweep_builder *b)
{
    const text_table *const t = b->table;
    const line_position_text place = format_line_position(t->names_line);
    if (samples_repeat_grid(b)) {
        wt_log_add(b->log, WT_WARNING, b->file->name, place.text,
                   "column %zu, %s, repeats the same frequencies and temperatures: each of its "
                   "values counts as a sample",
                   t->sample_cell + 1, t->sample_name);
        return;
    }
    wt_log_add(b->log, WT_NOTE, b->file->name, place.text, "columns not used: %s", t->sample_name);
    remove_samples(t);
}

/* Ignores a sample column of numbers that nearly all differ, or of too many names; it counts
 * something. */
static void ignore_count_column(const sweep_builder *b)
{
    const text_table *t = b->table;
    if (t->is_sample_guessed) {
        check_guessed_samples(b);
        return;
    }
    const text_list *names = &b->file->samples;
    bool seen[SAMPLES_MAX] = {false};
    bool numbers = true;
    size_t n = 0; /* number of names in this table */
    for (size_t row = 0; row < t->n_rows; row++) {
        const size_t i = t->samples[row];
        double value;
        if (i == NO_SAMPLE || seen[i])
            continue;
        seen[i] = true;
        n++;
        numbers = numbers && wt_number_parse(names->items[i], strlen(names->items[i]), '.', &value);
    }
    const bool counts = numbers && n > 1 && 4 * n > 3 * t->n_rows &&
                        b->options->conditioning != WT_CONDITIONING_KEEP;
    if (t->sample_cell == SIZE_MAX || !(counts || names->n >= SAMPLES_MAX))
        return;
    wt_log_action(b->log, WT_WARNING, WT_LEFT_OUT, 0, counts ? WT_KEEP_OPTION : NULL, b->file->name,
                  format_line_position(t->names_line).text,
                  "column %zu, which would name the sample, %s: left out", t->sample_cell + 1,
                  counts ? "is different in every row" : "has too many names");
    remove_samples(t);
}

/* Leaves out the rows that the instrument marks as outside of its limits, unless it marks all of
 * them. Returns the number of rows that are left. */
static size_t drop_flagged_rows(const sweep_builder *b, size_t *rows, size_t n)
{
    const text_table *const t = b->table;
    size_t kept = 0, line = 0;
    for (size_t i = 0; i < n; i++)
        if (t->kinds[rows[i]] != ROW_KIND_FLAGGED)
            rows[kept++] = rows[i];
        else
            line = line == 0 ? t->row_lines[rows[i]] : line;
    if (kept == n)
        return n;
    wt_log_action(b->log, WT_WARNING, kept > 0 ? WT_LEFT_OUT : WT_IMPLAUSIBLE, n - kept,
                  kept > 0 ? WT_KEEP_OPTION : NULL, b->file->name, format_line_position(line).text,
                  kept > 0 ? "rows that the instrument flags as outside of its limits are left "
                             "out: %zu of %zu in the table"
                           : "the instrument flags all rows of the table as outside of its limits; "
                             "they are used: %zu of %zu",
                  n - kept, n);
    return kept > 0 ? kept : n;
}

static wt_status split_table(sweep_builder *b)
{
    const text_table *t = b->table;
    size_t *rows = wt_alloc(t->n_rows, sizeof *rows), n = 0;
    size_t *sample_rows = wt_alloc(t->n_rows, sizeof *sample_rows);
    wt_status status = WT_OK;
    ignore_count_column(b);
    for (size_t row = 0; row < t->n_rows; row++)
        if (sweep_is_valid_row(b, row))
            rows[n++] = row;
    if (n < t->n_rows)
        wt_log_action(b->log, WT_NOTE, WT_LEFT_OUT, t->n_rows - n, "--columns", b->file->name,
                      format_line_position(t->names_line).text,
                      "%zu rows without a positive frequency or without a modulus left out",
                      t->n_rows - n);
    if (b->options->conditioning != WT_CONDITIONING_KEEP)
        n = drop_flagged_rows(b, rows, n);
    while (status == WT_OK && n > 0) {
        const wt_sweep before = *b->sweep;
        size_t taken = 0, kept = 0;
        b->sample = t->samples[rows[0]];
        for (size_t i = 0; i < n; i++)
            if (t->samples[rows[i]] == b->sample)
                sample_rows[taken++] = rows[i];
            else
                rows[kept++] = rows[i];
        n = kept;
        status = split_sample(b, sample_rows, taken);
        name_sample(b, &before);
    }
    free(sample_rows);
    free(rows);
    return status;
}

static size_t count_sweeps(const wt_sweep *s)
{
    return s->n_isotherms + s->n_ramps + s->n_strain_sweeps;
}

/* Notes which moduli were measured and which are derived. */
static void report_derived_moduli(const sweep_builder *b)
{
    const sweep_columns *c = &b->c;
    if (c->step != NULL)
        return;
    if (!c->has_storage || !c->has_loss)
        wt_log_add(b->log, WT_NOTE, b->file->name, NULL, "only the %s was measured",
                   c->has_storage ? "storage modulus"
                   : c->has_loss  ? "loss modulus"
                                  : "loss factor");
    const char *const angle = c->factor != NULL  ? "loss factor"
                              : c->phase != NULL ? "phase angle"
                                                 : NULL;
    if (c->has_storage && c->has_loss && c->storage == NULL)
        wt_log_add(b->log, WT_NOTE, b->file->name, NULL,
                   "no column of the storage modulus: it follows from column \"%s\" and the %s",
                   (c->magnitude != NULL ? c->magnitude : c->loss)->name,
                   angle != NULL ? angle : "loss modulus");
    if (c->has_loss && c->loss == NULL)
        wt_log_add(b->log, WT_NOTE, b->file->name, NULL,
                   "no column of the loss modulus: it follows from the storage modulus and %s%s",
                   angle != NULL ? "the " : "|E*| in column ",
                   angle != NULL ? angle : c->magnitude->name);
}

/* Fails if the user contradicts the deformation that the column names state. */
static wt_status check_deformation(const sweep_builder *b)
{
    const wt_read_deformation stated = b->options->deformation;
    if (stated != WT_DEFORMATION_FROM_FILE &&
        (stated == WT_DEFORMATION_SHEAR) != (b->c.deformation == WT_SHEAR)) {
        wt_fail(b->err, WT_E_UNIT, "the file says that its moduli are of %s, not of %s",
                b->c.deformation == WT_SHEAR ? "shear" : "tension or bending",
                stated == WT_DEFORMATION_SHEAR ? "shear" : "tension or bending");
        wt_error_place(b->err, "line %zu", b->table->names_line);
        const text_column *const column = b->c.storage != NULL     ? b->c.storage
                                          : b->c.magnitude != NULL ? b->c.magnitude
                                                                   : b->c.loss;
        wt_error_found(b->err, "column \"%s\"", column->name);
        wt_error_advice(b->err, "if the file is wrong, say what its columns are with --columns");
        wt_error_options(b->err, "columns");
        return WT_E_UNIT;
    }
    return WT_OK;
}

/* Fails for sweeps of different loading, since a master curve needs one kind. */
static wt_status fail_mixed_loading(wt_loading before, wt_loading now, wt_error *err)
{
    static const char *const words[] = {[WT_OSCILLATION] = "oscillation",
                                        [WT_RELAXATION] = "stress relaxation",
                                        [WT_CREEP] = "creep"};
    wt_fail(err, WT_E_UNIT, "%s and %s in one sweep", words[before], words[now]);
    wt_error_expected(err, "isotherms that were all measured in one way");
    wt_error_advice(err, "give the files of each apart");
    return WT_E_UNIT;
}

static wt_status read_sweep_table(sweep_builder *b)
{
    wt_status status = text_table_require(b->table, WT_KIND_SWEEP, b->err);
    if (status != WT_OK)
        return status;
    b->c = sweep_find_columns(b->table, b->options->deformation);
    if ((b->c.step != NULL) != b->steps)
        return WT_OK;
    if (b->c.frequency == NULL && b->c.step == NULL && isnan(b->options->frequency) &&
        isnan(b->table->header.value[HEADER_ANGULAR_FREQUENCY])) {
        b->is_frequency_missing = true;
        return text_table_problem(
            b->table, WT_Q_BIT(WT_Q_FREQUENCY) | WT_Q_BIT(WT_Q_ANGULAR_FREQUENCY), b->err);
    }
    if (count_sweeps(b->sweep) > 0 && b->c.loading != b->sweep->loading)
        return fail_mixed_loading(b->sweep->loading, b->c.loading, b->err);
    if (count_sweeps(b->sweep) > 0 && b->c.deformation != b->sweep->deformation) {
        wt_fail(b->err, WT_E_UNIT, "tension and shear in one sweep");
        wt_error_place(b->err, "line %zu", b->table->names_line);
        wt_error_expected(b->err, "the moduli of one deformation, E or G");
        return WT_E_UNIT;
    }
    status = check_deformation(b);
    if (status != WT_OK)
        return status;
    b->sweep->deformation = b->c.deformation;
    b->sweep->loading = b->c.loading;
    report_derived_moduli(b);
    b->rows = wt_alloc(b->table->n_rows, sizeof *b->rows);
    status = split_table(b);
    free(b->rows);
    b->rows = NULL;
    return status;
}

/* Moves all sweeps, or none on failure. */
static wt_status move_sweeps(wt_sweep *to, wt_sweep *from, wt_error *err)
{
    const size_t n = to->n_isotherms, n_ramps = to->n_ramps, n_strain = to->n_strain_sweeps;
    if (count_sweeps(to) > 0 && to->deformation != from->deformation) {
        wt_fail(err, WT_E_UNIT, "tension and shear in one sweep");
        wt_error_expected(err, "a file with moduli of %s like those before it",
                          to->deformation == WT_TENSION ? "tension (E)" : "shear (G)");
        return WT_E_UNIT;
    }
    if (count_sweeps(to) > 0 && to->loading != from->loading)
        return fail_mixed_loading(to->loading, from->loading, err);
    to->isotherms = wt_realloc(to->isotherms, n + from->n_isotherms, sizeof *to->isotherms);
    to->ramps = wt_realloc(to->ramps, n_ramps + from->n_ramps, sizeof *to->ramps);
    to->strain_sweeps =
        wt_realloc(to->strain_sweeps, n_strain + from->n_strain_sweeps, sizeof *to->strain_sweeps);
    if (from->n_isotherms > 0)
        memcpy(to->isotherms + n, from->isotherms, from->n_isotherms * sizeof *to->isotherms);
    if (from->n_ramps > 0)
        memcpy(to->ramps + n_ramps, from->ramps, from->n_ramps * sizeof *to->ramps);
    if (from->n_strain_sweeps > 0)
        memcpy(to->strain_sweeps + n_strain, from->strain_sweeps,
               from->n_strain_sweeps * sizeof *to->strain_sweeps);
    to->n_strain_sweeps = n_strain + from->n_strain_sweeps;
    to->n_isotherms = n + from->n_isotherms;
    to->n_ramps = n_ramps + from->n_ramps;
    to->deformation = from->deformation;
    to->loading = from->loading;
    from->n_isotherms = from->n_ramps = from->n_strain_sweeps = 0;
    wt_sweep_sort(to);
    return WT_OK;
}

wt_status text_build_sweep(const text_file *file, const wt_read_options *options, wt_log *log,
                           wt_sweep *sweep, wt_error *err)
{
    wt_sweep made = {.n_isotherms = 0};
    wt_status status = sweep_check_temperatures(file, options, log, err);
    const text_table *lacking = NULL;
    size_t n_steps = 0;
    /* tests of relaxation or creep are read only if the file has no sweep */
    for (int pass = 0; pass < 2 && status == WT_OK && count_sweeps(&made) == 0; pass++)
        for (size_t i = 0; i < file->n_tables && status == WT_OK; i++) {
            sweep_builder b = {.file = file,
                               .table = &file->tables[i],
                               .options = options,
                               .log = log,
                               .sweep = &made,
                               .steps = pass == 1,
                               .err = err};
            status = read_sweep_table(&b);
            n_steps += pass == 0 && b.c.step != NULL;
            lacking = b.is_frequency_missing ? b.table : lacking;
        }
    if (n_steps > 0 && made.loading == WT_OSCILLATION)
        wt_log_add(log, WT_NOTE, file->name, NULL,
                   "%zu test%s of relaxation or creep left out beside the sweeps", n_steps,
                   n_steps > 1 ? "s" : "");
    for (size_t i = 0; i < file->n_tables && status == WT_OK && made.loading == WT_OSCILLATION; i++)
        sweep_check_table(file, &file->tables[i], log);
    for (size_t i = 0; i < file->steps.n; i++)
        wt_log_add(log, WT_NOTE, file->name, NULL, "step without a frequency sweep: %s",
                   file->steps.items[i]);
    if (status == WT_OK && count_sweeps(&made) == 0 && lacking != NULL) {
        status = wt_fail(err, WT_E_MISSING, "no frequency");
        wt_error_place(err, "table at line %zu", lacking->names_line);
        wt_error_expected(err, "a column of frequency");
        wt_error_advice(err, "give the one of all points with --frequency 10Hz");
        wt_error_options(err, "frequency");
    }
    if (status == WT_OK && count_sweeps(&made) == 0)
        status = text_fail_empty(file, "sweep of frequency, temperature or strain", err);
    if (status == WT_OK)
        sweep_warn_shared_temperature(file, options, &made, log);
    if (status == WT_OK)
        status = move_sweeps(sweep, &made, err);
    wt_sweep_clear(&made);
    return status;
}

wt_status text_read_sweep(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_sweep *sweep, wt_error *err)
{
    text_file file;
    wt_status status = text_scan(self, input, WT_KIND_SWEEP, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    status = text_build_sweep(&file, options, log, sweep, err);
    text_file_free(&file);
    return status;
}
