/* Describes a text export for `info`. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include "core/base/clocale.h"
#include "core/base/range_text.h"
#include "read/force_assembler.h"

#include "read/images.h"
#include "read/metadata.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Number of tables shown; further tables mostly have the same columns. */
#define TABLES_SHOWN ((size_t)4)

/* The file and how it is read. */
typedef struct text_reading {
    const file_reader *self;
    wt_input *input;
    const wt_read_options *options;
    unsigned kinds;
    size_t piece;
    size_t n_curves; /* number of curves, if the text is read part by part */
} text_reading;

/* Selects the stream of curves. A text that is read part by part was read to its end before. */
static const force_stream *stream_of(const text_reading *r)
{
    return r->piece == SIZE_MAX ? r->self->force : &text_force_first;
}

static wt_status begin_parts(const text_reading *r, wt_log *log, text_parts **parts, wt_error *err)
{
    return text_parts_begin(r->self, r->input, r->piece, r->kinds, r->options, log, parts, err);
}

static void add_header(const text_file *file, table_writer *facts)
{
    for (size_t i = 0; i < file->description->n_fields; i++)
        if (file->values[i].line > 0)
            facts_add(facts, file->description->fields[i].name, file->values[i].unit,
                      line_place(file->values[i].line).words, "%s", file->values[i].text);
}

static void add_column(const text_table *t, const text_column *c, table_writer *facts)
{
    char item[96];
    const text_place place = line_place(t->names_line);
    const char *source = place.words;
    const wt_quantity q = c->rule->quantity;
    const char *id = wt_quantity_id(q);
    snprintf(item, sizeof item, "column \"%s\"", c->name);
    switch (c->problem) {
    case COLUMN_GOOD:
        facts_add(facts, item, c->unit, source, "%s, %s -> %s%s%s", id,
                  c->unit[0] != '\0' ? c->unit : "no unit", wt_quantity_unit(q),
                  c->rule->has_segment ? ", " : "",
                  c->rule->has_segment ? wt_segment_kind_name(c->rule->segment) : "");
        break;
    case COLUMN_NO_UNIT:
        facts_add(facts, item, c->unit, source,
                  "%s, but its unit is not said: give --units \"%s=...\"", id, c->name);
        break;
    case COLUMN_BAD_UNIT:
        facts_add(facts, item, c->unit, source, "unit \"%s\" does not fit %s", c->unit, id);
        break;
    default:
        facts_add(facts, item, c->unit, source, "not clear without a column \"%s\"", c->rule->with);
        break;
    }
}

/* The columns of the first table; those of other tables are mostly the same. */
typedef struct first_table {
    size_t n_columns;
    wt_quantity_set quantities;
} first_table;

static void add_table(const text_file *file, size_t of_file, size_t number, first_table *first,
                      table_writer *facts)
{
    const text_table *const t = &file->tables[of_file];
    char item[32];
    snprintf(item, sizeof item, "table %zu", number + 1);
    facts_add(facts, item, "", line_place(t->names_line).words,
              "%s%s%zu rows, separator %s, decimal %s", t->title, t->title[0] != '\0' ? ": " : "",
              t->n_rows, separator_name(t->separator), t->decimal == ',' ? "comma" : "point");
    if (number == 0)
        *first = (first_table){t->n_columns, t->quantities};
    else if (t->n_columns == first->n_columns && t->quantities == first->quantities &&
             t->n_problems == 0)
        return;
    /* the columns of a matrix are equal */
    for (size_t i = 0; i < t->n_columns && (i == 0 || !file->description->matrix); i++)
        add_column(t, &t->columns[i], facts);
    for (size_t i = 0; i < t->n_problems; i++)
        add_column(t, &t->problems[i], facts);
}

static void add_problem(wt_error *problem, table_writer *facts)
{
    char text[1024], place[sizeof problem->place];
    memcpy(place, problem->place, sizeof place);
    problem->file[0] = problem->place[0] = '\0'; /* shown in other columns */
    wt_error_format(problem, text, sizeof text);
    facts_add(facts, "not readable as it is", "", place, "%s", text);
}

static void add_sweep(const text_file *file, const wt_read_options *options, wt_log *log,
                      table_writer *facts)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_sweep(file, options, log, &sweep, &problem) != WT_OK) {
        add_problem(&problem, facts);
        return;
    }
    facts_add(facts, "deformation", "", "", "%s",
              sweep.deformation == WT_TENSION ? "tension (E)" : "shear (G)");
    const bool step = sweep.loading != WT_OSCILLATION;
    if (step)
        facts_add(facts, "loading", "", "", "%s",
                  sweep.loading == WT_CREEP ? "creep" : "stress relaxation");
    facts_add(facts, "isotherms", "", "", "%zu", sweep.n_isotherms);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        const wt_isotherm *s = &sweep.isotherms[i];
        const double first = s->angular_frequency[0], last = s->angular_frequency[s->n - 1];
        facts_add(facts, "isotherm", "", s->source, "%.2f degC, %zu points, %.4g to %.4g %s",
                  s->temperature - WT_ZERO_CELSIUS, s->n, step ? 1 / last : first,
                  step ? 1 / first : last, step ? "s" : "rad/s");
    }
    if (sweep.n_ramps > 0)
        facts_add(facts, "temperature sweeps", "", "", "%zu", sweep.n_ramps);
    for (size_t i = 0; i < sweep.n_ramps; i++) {
        const wt_ramp *r = &sweep.ramps[i];
        facts_add(facts, "temperature sweep", "", r->source,
                  "%.4g rad/s, %zu points, %.2f to %.2f degC", r->angular_frequency, r->n,
                  r->temperature[0] - WT_ZERO_CELSIUS, r->temperature[r->n - 1] - WT_ZERO_CELSIUS);
    }
    if (sweep.n_strain_sweeps > 0)
        facts_add(facts, "strain sweeps", "", "", "%zu", sweep.n_strain_sweeps);
    for (size_t i = 0; i < sweep.n_strain_sweeps; i++) {
        const wt_strain_sweep *r = &sweep.strain_sweeps[i];
        char at[32] = "temperature not known";
        if (!isnan(r->temperature))
            clocale_print(at, sizeof at, "%.2f degC", r->temperature - WT_ZERO_CELSIUS);
        facts_add(facts, "strain sweep", "", r->source,
                  "%s, %.4g rad/s, %zu points, amplitude %s %%", at, r->angular_frequency, r->n,
                  format_range(100 * r->strain[0], 100 * r->strain[r->n - 1], 3).text);
    }
    wt_sweep_clear(&sweep);
}

static void add_curve(const wt_force_curve *curve, table_writer *facts)
{
    char item[64];
    for (size_t i = 0; i < curve->n_segments; i++) {
        const wt_segment *s = &curve->segments[i];
        snprintf(item, sizeof item, "curve %zu, segment %zu", curve->index, s->index);
        facts_add(facts, item, "", "", "%s, %zu points", wt_segment_kind_name(s->kind),
                  s->n_points);
    }
}

/* Describes the curves without forces, which may need an unknown calibration. */
static void add_curves(const text_reading *r, table_writer *facts)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options bare = *r->options;
    bare.want &= ~WT_Q_BIT(WT_Q_FORCE);
    if (force_open(stream_of(r), r->self, r->input, &bare, NULL, &source, &problem) != WT_OK) {
        add_problem(&problem, facts);
        return;
    }
    facts_add(facts, "curves", "", "", "%zu",
              r->piece == SIZE_MAX ? wt_force_count(source) : r->n_curves);
    for (size_t i = 0; i < TABLES_SHOWN; i++) {
        const wt_status got = wt_force_next(source, &curve, &problem);
        if (got != WT_OK && got != WT_END)
            add_problem(&problem, facts);
        if (got != WT_OK)
            break;
        add_curve(&curve, facts);
        if (i > 0)
            continue;
        facts_number(facts, "spring constant", curve.cantilever.spring_constant, "N/m", "");
        facts_number(facts, "sensitivity", curve.cantilever.sensitivity, "m/V", "");
    }
    wt_force_curve_clear(&curve);
    wt_force_close(source);
}

static void add_force(const text_reading *r, table_writer *facts)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options force_only = *r->options;
    force_only.want = WT_Q_BIT(WT_Q_FORCE);
    add_curves(r, facts);
    if (force_open(stream_of(r), r->self, r->input, &force_only, NULL, &source, &problem) != WT_OK)
        return;
    if (wt_force_next(source, &curve, &problem) == WT_E_MISSING)
        add_problem(&problem, facts);
    wt_force_curve_clear(&curve);
    wt_force_close(source);
}

static void add_spectrum(const file_reader *self, wt_input *input, const wt_read_options *options,
                         table_writer *facts)
{
    wt_power_spectrum spectrum = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_read_spectrum(self, input, options, NULL, &spectrum, &problem) != WT_OK) {
        add_problem(&problem, facts);
        return;
    }
    facts_add(facts, "power spectrum", "", "", "%s, %zu points, %.4g to %.4g rad/m",
              spectrum.kind == WT_SPECTRUM_2D ? "two-dimensional" : "one-dimensional", spectrum.n,
              spectrum.wavenumber[0], spectrum.wavenumber[spectrum.n - 1]);
    wt_power_spectrum_clear(&spectrum);
}

/* Describes the first tables. The text is read again if they are no longer in memory. */
static wt_status add_tables(const text_reading *r, const text_parts *parts, table_writer *facts)
{
    const text_file *file = text_parts_file(parts);
    text_parts *again = NULL;
    first_table first = {0};
    size_t n = 0;
    wt_status status = WT_OK;
    if (file->n_tables < file->n_seen) {
        status = begin_parts(r, NULL, &again, facts->err);
        if (status == WT_OK) {
            file = text_parts_file(again);
            status = text_parts_next(again, facts->err);
        }
    }
    while (status == WT_OK && n < TABLES_SHOWN) {
        for (size_t i = 0; i < file->n_tables && n < TABLES_SHOWN; i++, n++)
            add_table(file, i, n, &first, facts);
        status = again != NULL && n < TABLES_SHOWN ? text_parts_next(again, facts->err) : WT_END;
    }
    text_parts_free(again);
    return status == WT_END ? WT_OK : status;
}

static wt_status add_layout(const text_reading *r, const text_parts *parts, table_writer *facts)
{
    const text_file *file = text_parts_file(parts);
    facts_add(facts, "encoding", "", "", "%s", file->feed->words);
    add_header(file, facts);
    facts_add(facts, "tables", "", "", "%zu", file->n_seen);
    const wt_status status = add_tables(r, parts, facts);
    for (size_t i = 0; i < file->steps.n; i++)
        facts_add(facts, "step without a table that is understood", "", "", "%s",
                  file->steps.items[i]);
    if (file->unknown.n > 0) {
        char names[4096];
        text_unknown(file, names, sizeof names);
        facts_add(facts, "columns not used", "", "", "%s", names);
    }
    return status;
}

static void add_noise(const file_reader *self, wt_input *input, const wt_read_options *options,
                      table_writer *facts)
{
    wt_noise_spectrum noise = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_read_noise(self, input, options, NULL, &noise, &problem) == WT_OK)
        facts_add(facts, "thermal noise", "", "", "%zu points, %.4g to %.4g Hz, of %s", noise.n,
                  noise.frequency[0], noise.frequency[noise.n - 1],
                  noise.volts ? "the detector" : "the deflection");
    else
        add_problem(&problem, facts);
    wt_noise_spectrum_clear(&noise);
}

static void add_record(const file_reader *self, wt_input *input, const wt_read_options *options,
                       table_writer *facts)
{
    wt_record record = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_read_record(self, input, options, NULL, &record, &problem) == WT_OK)
        facts_add(facts, "record of friction", "", "", "%zu samples in %zu step%s", record.n,
                  record.step[record.n - 1] + 1, record.step[record.n - 1] == 0 ? "" : "s");
    else
        add_problem(&problem, facts);
    wt_record_clear(&record);
}

/* Describes the sweep of all tables, which are read again if they are no longer in memory. */
static wt_status add_sweep_of(const text_reading *r, const text_file *file, wt_log *log,
                              table_writer *facts)
{
    text_file whole = {0};
    if (file->n_tables == file->n_seen) {
        add_sweep(file, r->options, log, facts);
        return WT_OK;
    }
    const wt_status status =
        text_scan(r->self, r->input, r->kinds, r->options, NULL, &whole, facts->err);
    if (status == WT_OK)
        add_sweep(&whole, r->options, log, facts);
    text_file_free(&whole);
    return status;
}

/* Describes layout and sweep. *has receives the kinds of data that remain to be described. */
static wt_status describe_parts(text_reading *r, text_parts *parts, wt_log *log, unsigned *has,
                                table_writer *facts)
{
    static const unsigned others[] = {WT_KIND_FORCE, WT_KIND_IMAGE, WT_KIND_SPECTRUM, WT_KIND_NOISE,
                                      WT_KIND_RECORD};
    const text_file *const file = text_parts_file(parts);
    wt_error problem = WT_ERROR_INIT;
    wt_status status = WT_OK;
    while ((status = text_parts_next(parts, &problem)) == WT_OK)
        r->n_curves += text_count_curves(file, WT_KIND_FORCE);
    if (status != WT_END) {
        add_problem(&problem, facts);
        return WT_OK;
    }
    status = add_layout(r, parts, facts);
    if (status == WT_OK && file->n_seen == 0) {
        (void)text_fail_empty(file, "table that is understood", &problem);
        add_problem(&problem, facts);
    }
    if (status == WT_OK && text_has(file, WT_KIND_SWEEP) && file->n_seen > 0)
        status = add_sweep_of(r, file, log, facts);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        *has |= text_has(file, others[i]) ? others[i] : 0;
    return status;
}

wt_status text_describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                        wt_log *log, table_writer *facts)
{
    text_description *const description = self->description;
    text_reading r = {self, input, options, description->kinds, SIZE_MAX, 0};
    text_parts *parts = NULL;
    unsigned has = 0;
    facts_add(facts, "description version", "", "", "%s", description->version);
    wt_status status = text_piece(description, input, &r.piece, facts->err);
    if (status == WT_OK)
        status = begin_parts(&r, log, &parts, facts->err);
    if (status == WT_OK)
        status = describe_parts(&r, parts, log, &has, facts);
    text_parts_free(parts);
    if (status != WT_OK)
        return status;
    if ((has & WT_KIND_FORCE) != 0)
        add_force(&r, facts);
    if ((has & WT_KIND_IMAGE) != 0)
        status = images_facts(self, input, options, NULL, facts, WT_OK, NULL);
    if ((has & WT_KIND_SPECTRUM) != 0)
        add_spectrum(self, input, options, facts);
    if ((has & WT_KIND_NOISE) != 0)
        add_noise(self, input, options, facts);
    if ((has & WT_KIND_RECORD) != 0)
        add_record(self, input, options, facts);
    return status;
}

wt_status text_describe_made(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, table_writer *facts)
{
    wt_input *text = NULL;
    file_reader of_text = *self;
    of_text.as_text = NULL;
    wt_status status = self->as_text(self, input, NULL, &text, facts->err);
    if (status == WT_OK)
        status = text_describe(&of_text, text, options, log, facts);
    wt_input_close(text);
    return status;
}
