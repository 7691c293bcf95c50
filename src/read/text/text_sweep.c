/* Tables of a text export to the isotherms of a DMA sweep.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Instruments hold a set frequency better than this; what differs by less is the same one. */
static const double same_frequency = 0.01;

typedef struct sweep_columns {
    const text_column *frequency, *storage, *loss, *magnitude, *factor, *temperature, *strain;
    double to_angular; /* 2 pi for a frequency in Hz */
    wt_deformation deformation;
} sweep_columns;

typedef struct builder {
    const text_file *file;
    const text_table *table;
    sweep_columns c;
    const wt_read_options *options;
    wt_parselog *log;
    wt_sweep *sweep;
    size_t *rows; /* of the isotherm that is being collected */
    size_t n;
    wt_error *err;
} builder;

static sweep_columns find_columns(const text_table *t)
{
    sweep_columns c = {.to_angular = 1};
    const bool tension = quantities_suffice(t->quantities & ~WT_Q_BIT(WT_Q_SHEAR_STORAGE_MODULUS) &
                                                ~WT_Q_BIT(WT_Q_SHEAR_COMPLEX_MODULUS),
                                            WT_KIND_SWEEP);
    c.deformation = tension ? WT_TENSION : WT_SHEAR;
    c.frequency = text_table_column(t, WT_Q_ANGULAR_FREQUENCY, -1);
    if (c.frequency == NULL) {
        c.frequency = text_table_column(t, WT_Q_FREQUENCY, -1);
        c.to_angular = 2 * M_PI;
    }
    c.storage =
        text_table_column(t, tension ? WT_Q_STORAGE_MODULUS : WT_Q_SHEAR_STORAGE_MODULUS, -1);
    c.loss = text_table_column(t, tension ? WT_Q_LOSS_MODULUS : WT_Q_SHEAR_LOSS_MODULUS, -1);
    c.magnitude =
        text_table_column(t, tension ? WT_Q_COMPLEX_MODULUS : WT_Q_SHEAR_COMPLEX_MODULUS, -1);
    c.factor = text_table_column(t, WT_Q_LOSS_FACTOR, -1);
    c.temperature = text_table_column(t, WT_Q_TEMPERATURE, -1);
    c.strain = text_table_column(t, WT_Q_STRAIN, -1);
    return c;
}

static double angular(const builder *b, size_t row)
{
    return b->c.to_angular * text_table_value(b->table, row, b->c.frequency);
}

static double storage(const builder *b, size_t row)
{
    if (b->c.storage != NULL)
        return text_table_value(b->table, row, b->c.storage);
    const double magnitude = text_table_value(b->table, row, b->c.magnitude);
    if (b->c.factor != NULL)
        return magnitude / hypot(1.0, text_table_value(b->table, row, b->c.factor));
    const double lost = text_table_value(b->table, row, b->c.loss);
    return sqrt((magnitude - lost) * (magnitude + lost));
}

static double loss(const builder *b, size_t row)
{
    if (b->c.loss != NULL)
        return text_table_value(b->table, row, b->c.loss);
    return storage(b, row) * text_table_value(b->table, row, b->c.factor);
}

static double temperature(const builder *b, size_t row)
{
    return b->c.temperature != NULL ? text_table_value(b->table, row, b->c.temperature)
                                    : (double)NAN;
}

static bool is_point(const builder *b, size_t row)
{
    return angular(b, row) > 0 && !isnan(storage(b, row)) && !isnan(loss(b, row));
}

/* Mean and scatter of the column, or what the header or the user says. */
static wt_status set_temperature(const builder *b, wt_isotherm *isotherm)
{
    const double header = b->table->header.value[HEADER_TEMPERATURE];
    const bool fallback = b->table->header.fallback[HEADER_TEMPERATURE];
    double mean = 0, scatter = 0;
    size_t n = 0;
    /* Welford's recurrence: the scatter of 0.01 K about 300 K is not lost to rounding. */
    for (size_t i = 0; i < b->n; i++) {
        const double t = temperature(b, b->rows[i]);
        if (isnan(t))
            continue;
        const double before = t - mean;
        mean += before / (double)++n;
        scatter += before * (t - mean);
    }
    isotherm->temperature_spread = n > 1 ? sqrt(scatter / (double)(n - 1)) : (double)NAN;
    if (!isnan(header) && (!fallback || n == 0)) {
        isotherm->temperature = header;
        if (fallback)
            wt_parselog_add(b->log, WT_WARNING, b->file->name, NULL,
                            "the temperature of %.2f degC stands in the header text only",
                            header - WT_ZERO_CELSIUS);
    } else if (n > 0) {
        isotherm->temperature = mean;
    } else if (!isnan(b->options->temperature) || b->options->any_temperature) {
        isotherm->temperature = b->options->temperature;
    } else {
        wt_status status = text_table_problem(b->table, WT_Q_BIT(WT_Q_TEMPERATURE), b->err);
        if (status != WT_OK)
            return status;
        wt_fail(b->err, WT_E_MISSING, "no temperature");
        wt_error_place(b->err, "table at line %zu", b->table->names_line);
        wt_error_expected(b->err, "a column of temperature or a header line that tells it");
        wt_error_advice(b->err, "give it with --temperature 25degC");
        return WT_E_MISSING;
    }
    if (isotherm->temperature <= 0) {
        wt_fail(b->err, WT_E_RANGE, "temperature below absolute zero");
        wt_error_place(b->err, "table at line %zu", b->table->names_line);
        wt_error_found(b->err, "%g K", isotherm->temperature);
        return WT_E_RANGE;
    }
    return WT_OK;
}

/* "FILE, TITLE OF THE STEP"; the title is what tells the isotherms apart, so the name gives way. */
static void set_source(const builder *b, wt_isotherm *isotherm)
{
    const text_table *t = b->table;
    const char *name = wt_path_base(b->file->name);
    char end[112];
    if (t->title[0] != '\0')
        snprintf(end, sizeof end, ", %s", t->title);
    else
        snprintf(end, sizeof end, ", line %zu", t->names_line);
    const size_t length = strlen(end);
    text_copy(isotherm->source, sizeof isotherm->source - length, (text_span){name, strlen(name)});
    memcpy(isotherm->source + strlen(isotherm->source), end, length + 1);
}

/* No instrument sweeps so many decades at one temperature. */
static const double most_decades = 7;

/* A master curve that another program made looks like one isotherm. */
static void warn_of_shifted(const builder *b, double low, double high)
{
    const double decades = log10(high / low);
    if (decades > most_decades)
        wt_parselog_add(b->log, WT_WARNING, b->file->name, line_place(b->table->names_line).words,
                        "frequencies over %.1f decades at one temperature: this looks like a "
                        "master curve that was shifted already; export the measured isotherms",
                        decades);
}

/* The rows collected so far become an isotherm, if their frequency was swept. */
static wt_status flush(builder *b)
{
    double low = (double)INFINITY, high = 0;
    const char *title = b->table->title;
    for (size_t i = 0; i < b->n; i++) {
        low = fmin(low, angular(b, b->rows[i]));
        high = fmax(high, angular(b, b->rows[i]));
    }
    if (b->n == 0)
        return WT_OK;
    if (!(high > low * (1 + same_frequency))) {
        wt_parselog_add(b->log, WT_NOTE, b->file->name, line_place(b->table->names_line).words,
                        "%s%s%zu points at one frequency: not a frequency sweep, left out", title,
                        title[0] != '\0' ? ": " : "", b->n);
        b->n = 0;
        return WT_OK;
    }
    warn_of_shifted(b, low, high);
    wt_isotherm *isotherm = wt_sweep_add(b->sweep, b->n, b->c.strain != NULL);
    if (isotherm == NULL)
        return wt_fail(b->err, WT_E_MEMORY, "no memory for an isotherm");
    for (size_t i = 0; i < b->n; i++) {
        isotherm->angular_frequency[i] = angular(b, b->rows[i]);
        isotherm->storage_modulus[i] = storage(b, b->rows[i]);
        isotherm->loss_modulus[i] = loss(b, b->rows[i]);
        if (b->c.strain != NULL)
            isotherm->strain[i] = text_table_value(b->table, b->rows[i], b->c.strain);
    }
    set_source(b, isotherm);
    wt_status status = set_temperature(b, isotherm);
    b->n = 0;
    return status;
}

/* An isotherm ends where a block ends, where the frequency turns back or where the temperature
 * jumps. */
static wt_status split_table(builder *b)
{
    const text_table *t = b->table;
    const double jump = b->file->description->temperature_jump;
    int direction = 0;
    size_t dropped = 0;
    wt_status status = WT_OK;
    for (size_t row = 0; row < t->n_rows && status == WT_OK; row++) {
        if (!is_point(b, row)) {
            dropped++;
            continue;
        }
        if (b->n > 0) {
            const size_t last = b->rows[b->n - 1];
            const double ratio = angular(b, row) / angular(b, last);
            const int way = ratio > 1 + same_frequency         ? 1
                            : ratio < 1 / (1 + same_frequency) ? -1
                                                               : 0;
            const bool jumps = fabs(temperature(b, row) - temperature(b, last)) > jump;
            if (t->blocks[row] != t->blocks[last] || way * direction < 0 || jumps) {
                status = flush(b);
                direction = 0;
            } else if (way != 0) {
                direction = way;
            }
        }
        b->rows[b->n++] = row;
    }
    if (status == WT_OK)
        status = flush(b);
    if (dropped > 0)
        wt_parselog_add(b->log, WT_NOTE, b->file->name, line_place(t->names_line).words,
                        "%zu rows without a positive frequency or without a modulus left out",
                        dropped);
    return status;
}

static wt_status read_table(builder *b)
{
    wt_status status = text_table_require(b->table, WT_KIND_SWEEP, b->err);
    if (status != WT_OK)
        return status;
    b->c = find_columns(b->table);
    if (b->sweep->n_isotherms > 0 && b->c.deformation != b->sweep->deformation) {
        wt_fail(b->err, WT_E_UNIT, "tension and shear in one sweep");
        wt_error_place(b->err, "line %zu", b->table->names_line);
        wt_error_expected(b->err, "the moduli of one deformation, E or G");
        return WT_E_UNIT;
    }
    b->sweep->deformation = b->c.deformation;
    if (b->c.storage == NULL)
        wt_parselog_add(
            b->log, WT_NOTE, b->file->name, NULL,
            "no column of the storage modulus: it follows from column \"%s\" and the %s",
            b->c.magnitude->name, b->c.factor != NULL ? "loss factor" : "loss modulus");
    if (b->c.loss == NULL)
        wt_parselog_add(b->log, WT_NOTE, b->file->name, NULL,
                        "no column of the loss modulus: storage modulus times loss factor");
    b->n = 0;
    b->rows = malloc((b->table->n_rows + 1) * sizeof *b->rows);
    if (b->rows == NULL)
        return wt_fail(b->err, WT_E_MEMORY, "no memory for an isotherm");
    status = split_table(b);
    free(b->rows);
    b->rows = NULL;
    return status;
}

/* Moves the isotherms; all or none. */
static wt_status append(wt_sweep *to, wt_sweep *from, wt_error *err)
{
    const size_t before = to->n_isotherms;
    if (before > 0 && to->deformation != from->deformation) {
        wt_fail(err, WT_E_UNIT, "tension and shear in one sweep");
        wt_error_expected(err, "a file with moduli of %s like those before it",
                          to->deformation == WT_TENSION ? "tension (E)" : "shear (G)");
        return WT_E_UNIT;
    }
    wt_isotherm *grown =
        realloc(to->isotherms, (before + from->n_isotherms) * sizeof *to->isotherms);
    if (grown == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the isotherms");
    memcpy(grown + before, from->isotherms, from->n_isotherms * sizeof *grown);
    to->isotherms = grown;
    to->n_isotherms = before + from->n_isotherms;
    to->deformation = from->deformation;
    from->n_isotherms = 0;
    wt_sweep_sort(to);
    return WT_OK;
}

wt_status text_sweep(const text_file *file, const wt_read_options *options, wt_parselog *log,
                     wt_sweep *sweep, wt_error *err)
{
    wt_sweep made = {.n_isotherms = 0};
    wt_status status = WT_OK;
    for (size_t i = 0; i < file->n_tables && status == WT_OK; i++) {
        builder b = {.file = file,
                     .table = &file->tables[i],
                     .options = options,
                     .log = log,
                     .sweep = &made,
                     .err = err};
        status = read_table(&b);
    }
    for (size_t i = 0; i < file->steps.n; i++)
        wt_parselog_add(log, WT_NOTE, file->name, NULL, "step without a frequency sweep: %s",
                        file->steps.items[i]);
    if (status == WT_OK && made.n_isotherms == 0)
        status = text_nothing(file, "frequency sweep", err);
    if (status == WT_OK)
        status = append(sweep, &made, err);
    wt_sweep_clear(&made);
    return status;
}

wt_status text_read_sweep(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, wt_sweep *sweep, wt_error *err)
{
    text_file file;
    wt_status status = text_scan(self, input, WT_KIND_SWEEP, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    status = text_sweep(&file, options, log, sweep, err);
    text_file_free(&file);
    return status;
}
