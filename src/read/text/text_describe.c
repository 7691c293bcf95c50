/* Describes a text export for `info`. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "read/force_assembler.h"

#include "core/table/registry.h"
#include "read/header_values.h"
#include "read/images.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Number of tables shown; further tables mostly have the same columns. */
#define TABLES_SHOWN ((size_t)4)

/* The file and how it is read. */
typedef struct describe_context {
    const file_reader *self;
    wt_input *input;
    const wt_read_options *options;
    unsigned kinds;
    size_t piece;
    size_t n_curves; /* number of curves, if the text is read part by part */
} describe_context;

/* Selects the stream of curves. A text that is read part by part was read to its end before. */
static const force_stream *select_stream(const describe_context *r)
{
    return r->piece == SIZE_MAX ? r->self->force : &text_force_streamed;
}

static wt_status begin_parts(const describe_context *r, wt_log *log, text_parts **parts,
                             wt_error *err)
{
    return text_parts_begin(r->self, r->input, r->piece, r->kinds, r->options, log, parts, err);
}

static void describe_header(const text_file *file, table_writer *metadata)
{
    for (size_t i = 0; i < file->description->n_fields; i++)
        if (file->values[i].line > 0)
            metadata_add(metadata, file->description->fields[i].name, file->values[i].unit,
                         format_line_position(file->values[i].line).text, "%s",
                         file->values[i].text);
}

static void describe_column(const text_table *t, const text_column *c, table_writer *metadata)
{
    char item[96];
    const line_position_text place = format_line_position(t->names_line);
    const char *source = place.text;
    const wt_quantity q = c->rule->quantity;
    const char *id = wt_quantity_id(q);
    snprintf(item, sizeof item, "%s \"%s\"", fact_item_text(FACT_COLUMN), c->name);
    switch (c->problem) {
    case COLUMN_GOOD:
        metadata_add(metadata, item, c->unit, source, "%s, %s -> %s%s%s", id,
                     c->unit[0] != '\0' ? c->unit : "no unit", wt_quantity_unit(q),
                     c->rule->has_segment ? ", " : "",
                     c->rule->has_segment ? wt_segment_kind_name(c->rule->segment) : "");
        break;
    case COLUMN_NO_UNIT:
        metadata_add(metadata, item, c->unit, source,
                     "%s, but its unit is not said: give --units \"%s=...\"", id, c->name);
        facts_put_text(metadata, FACTS_OPTIONS, "units");
        break;
    case COLUMN_BAD_UNIT:
        metadata_add(metadata, item, c->unit, source, "unit \"%s\" does not fit %s", c->unit, id);
        break;
    default:
        metadata_add(metadata, item, c->unit, source, "not clear without a column \"%s\"",
                     c->rule->required_name);
        break;
    }
    facts_put(metadata, FACTS_QUANTITY, q);
}

/* The columns of the first table; those of other tables are mostly the same. */
typedef struct first_table {
    size_t n_columns;
    wt_quantity_set quantities;
} first_table;

static void describe_table(const text_file *file, size_t of_file, size_t number, first_table *first,
                           table_writer *metadata)
{
    const text_table *const t = &file->tables[of_file];
    char item[32];
    snprintf(item, sizeof item, "%s %zu", fact_item_text(FACT_TABLE), number + 1);
    metadata_add(metadata, item, "", format_line_position(t->names_line).text,
                 "%s%s%zu rows, separator %s, decimal %s", t->title,
                 t->title[0] != '\0' ? ": " : "", t->n_rows, separator_name(t->separator),
                 t->decimal == ',' ? "comma" : "point");
    if (number == 0)
        *first = (first_table){t->n_columns, t->quantities};
    else if (t->n_columns == first->n_columns && t->quantities == first->quantities &&
             t->n_problems == 0)
        return;
    /* the columns of a matrix are equal */
    for (size_t i = 0; i < t->n_columns && (i == 0 || !file->description->matrix); i++)
        describe_column(t, &t->columns[i], metadata);
    for (size_t i = 0; i < t->n_problems; i++)
        describe_column(t, &t->problems[i], metadata);
}

static void describe_problem(wt_error *problem, table_writer *metadata)
{
    char text[1024], place[sizeof problem->place];
    memcpy(place, problem->place, sizeof place);
    problem->file[0] = problem->place[0] = '\0'; /* shown in other columns */
    wt_error_format(problem, text, sizeof text);
    metadata_add(metadata, fact_item_text(FACT_UNREADABLE), "", place, "%s", text);
    facts_put_text(metadata, FACTS_OPTIONS, problem->options);
}

static void describe_sweep(const text_file *file, const wt_read_options *options, wt_log *log,
                           table_writer *metadata)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_build_sweep(file, options, log, &sweep, &problem) != WT_OK) {
        describe_problem(&problem, metadata);
        return;
    }
    metadata_add(metadata, fact_item_text(FACT_DEFORMATION), "", "", "%s",
                 sweep.deformation == WT_TENSION ? "tension (E)" : "shear (G)");
    const bool step = sweep.loading != WT_OSCILLATION;
    if (step)
        metadata_add(metadata, "loading", "", "", "%s",
                     sweep.loading == WT_CREEP ? "creep" : "stress relaxation");
    metadata_add(metadata, fact_item_text(FACT_ISOTHERMS), "", "", "%zu", sweep.n_isotherms);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        const wt_isotherm *s = &sweep.isotherms[i];
        const double first = s->angular_frequency[0], last = s->angular_frequency[s->n - 1];
        metadata_add(metadata, "isotherm", "", s->source, "%.2f degC, %zu points, %.4g to %.4g %s",
                     s->temperature - WT_ZERO_CELSIUS, s->n, step ? 1 / last : first,
                     step ? 1 / first : last, step ? "s" : "rad/s");
    }
    if (sweep.n_ramps > 0)
        metadata_add(metadata, fact_item_text(FACT_RAMPS), "", "", "%zu", sweep.n_ramps);
    for (size_t i = 0; i < sweep.n_ramps; i++) {
        const wt_ramp *r = &sweep.ramps[i];
        metadata_add(metadata, "temperature sweep", "", r->source,
                     "%.4g rad/s, %zu points, %.2f to %.2f degC", r->angular_frequency, r->n,
                     r->temperature[0] - WT_ZERO_CELSIUS,
                     r->temperature[r->n - 1] - WT_ZERO_CELSIUS);
    }
    if (sweep.n_strain_sweeps > 0)
        metadata_add(metadata, fact_item_text(FACT_STRAIN_SWEEPS), "", "", "%zu",
                     sweep.n_strain_sweeps);
    for (size_t i = 0; i < sweep.n_strain_sweeps; i++) {
        const wt_strain_sweep *r = &sweep.strain_sweeps[i];
        char at[32] = "temperature not known";
        if (!isnan(r->temperature))
            clocale_print(at, sizeof at, "%.2f degC", r->temperature - WT_ZERO_CELSIUS);
        metadata_add(metadata, "strain sweep", "", r->source,
                     "%s, %.4g rad/s, %zu points, amplitude %s %%", at, r->angular_frequency, r->n,
                     format_range(100 * r->strain[0], 100 * r->strain[r->n - 1], 3).text);
    }
    wt_sweep_clear(&sweep);
}

static void describe_curve(const wt_force_curve *curve, table_writer *metadata)
{
    char item[64];
    for (size_t i = 0; i < curve->n_segments; i++) {
        const wt_segment *s = &curve->segments[i];
        snprintf(item, sizeof item, "curve %zu, segment %zu", curve->index, s->index);
        metadata_add(metadata, item, "", "", "%s, %zu points", wt_segment_kind_name(s->kind),
                     s->n_points);
    }
}

/* Describes the curves without forces, which may need an unknown calibration. */
static void describe_curves(const describe_context *r, table_writer *metadata)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options bare = *r->options;
    bare.want &= ~WT_Q_BIT(WT_Q_FORCE);
    if (force_open(select_stream(r), r->self, r->input, &bare, NULL, &source, &problem) != WT_OK) {
        describe_problem(&problem, metadata);
        return;
    }
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "", "%zu",
                 r->piece == SIZE_MAX ? wt_force_count(source) : r->n_curves);
    for (size_t i = 0; i < TABLES_SHOWN; i++) {
        const wt_status got = wt_force_next(source, &curve, &problem);
        if (got != WT_OK && got != WT_END)
            describe_problem(&problem, metadata);
        if (got != WT_OK)
            break;
        describe_curve(&curve, metadata);
        if (i > 0)
            continue;
        metadata_add_number(metadata, fact_item_text(FACT_SPRING_CONSTANT),
                            curve.cantilever.spring_constant, "N/m", "");
        metadata_add_number(metadata, "sensitivity", curve.cantilever.sensitivity, "m/V", "");
    }
    wt_force_curve_clear(&curve);
    wt_force_close(source);
}

static void describe_force(const describe_context *r, table_writer *metadata)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options force_only = *r->options;
    force_only.want = WT_Q_BIT(WT_Q_FORCE);
    describe_curves(r, metadata);
    if (force_open(select_stream(r), r->self, r->input, &force_only, NULL, &source, &problem) !=
        WT_OK)
        return;
    if (wt_force_next(source, &curve, &problem) == WT_E_MISSING)
        describe_problem(&problem, metadata);
    wt_force_curve_clear(&curve);
    wt_force_close(source);
}

static void describe_spectrum(const file_reader *self, wt_input *input,
                              const wt_read_options *options, table_writer *metadata)
{
    wt_power_spectrum spectrum = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_read_spectrum(self, input, options, NULL, &spectrum, &problem) != WT_OK) {
        describe_problem(&problem, metadata);
        return;
    }
    metadata_add(metadata, fact_item_text(FACT_SPECTRUM), "", "",
                 "%s, %zu points, %.4g to %.4g rad/m",
                 spectrum.kind == WT_SPECTRUM_2D ? "two-dimensional" : "one-dimensional",
                 spectrum.n, spectrum.wavenumber[0], spectrum.wavenumber[spectrum.n - 1]);
    wt_power_spectrum_clear(&spectrum);
}

/* Describes the first tables. The text is read again if they are no longer in memory. */
static wt_status describe_tables(const describe_context *r, const text_parts *parts,
                                 table_writer *metadata)
{
    const text_file *file = text_parts_file(parts);
    text_parts *again = NULL;
    first_table first = {0};
    size_t n = 0;
    wt_status status = WT_OK;
    if (file->n_tables < file->n_seen) {
        status = begin_parts(r, NULL, &again, metadata->err);
        if (status == WT_OK) {
            file = text_parts_file(again);
            status = text_parts_next(again, metadata->err);
        }
    }
    while (status == WT_OK && n < TABLES_SHOWN) {
        for (size_t i = 0; i < file->n_tables && n < TABLES_SHOWN; i++, n++)
            describe_table(file, i, n, &first, metadata);
        status = again != NULL && n < TABLES_SHOWN ? text_parts_next(again, metadata->err) : WT_END;
    }
    text_parts_free(again);
    return status == WT_END ? WT_OK : status;
}

static wt_status describe_layout(const describe_context *r, const text_parts *parts,
                                 table_writer *metadata)
{
    const text_file *file = text_parts_file(parts);
    metadata_add(metadata, "encoding", "", "", "%s", file->feed->words);
    describe_header(file, metadata);
    metadata_add(metadata, "tables", "", "", "%zu", file->n_seen);
    const wt_status status = describe_tables(r, parts, metadata);
    for (size_t i = 0; i < file->steps.n; i++)
        metadata_add(metadata, "step without a table that is understood", "", "", "%s",
                     file->steps.items[i]);
    if (file->unknown.n > 0) {
        char names[4096];
        text_format_unknown(file, names, sizeof names);
        metadata_add(metadata, "columns not used", "", "", "%s", names);
    }
    return status;
}

static void describe_record(const file_reader *self, wt_input *input,
                            const wt_read_options *options, table_writer *metadata)
{
    wt_record record = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    if (text_read_record(self, input, options, NULL, &record, &problem) == WT_OK)
        metadata_add(metadata, fact_item_text(FACT_RECORD), "", "", "%zu samples in %zu step%s",
                     record.n, record.step[record.n - 1] + 1,
                     record.step[record.n - 1] == 0 ? "" : "s");
    else
        describe_problem(&problem, metadata);
    wt_record_clear(&record);
}

/* Describes the sweep of all tables, which are read again if they are no longer in memory. */
static wt_status describe_whole_sweep(const describe_context *r, const text_file *file, wt_log *log,
                                      table_writer *metadata)
{
    text_file whole = {0};
    if (file->n_tables == file->n_seen) {
        describe_sweep(file, r->options, log, metadata);
        return WT_OK;
    }
    const wt_status status =
        text_scan(r->self, r->input, r->kinds, r->options, NULL, &whole, metadata->err);
    if (status == WT_OK)
        describe_sweep(&whole, r->options, log, metadata);
    text_file_free(&whole);
    return status;
}

/* Describes layout and sweep. *has receives the kinds of data that remain to be described. */
static wt_status describe_parts(describe_context *r, text_parts *parts, wt_log *log, unsigned *has,
                                table_writer *metadata)
{
    static const unsigned others[] = {WT_KIND_FORCE, WT_KIND_IMAGE, WT_KIND_SPECTRUM,
                                      WT_KIND_RECORD};
    const text_file *const file = text_parts_file(parts);
    wt_error problem = WT_ERROR_INIT;
    wt_status status = WT_OK;
    while ((status = text_parts_next(parts, &problem)) == WT_OK)
        r->n_curves += text_count_curves(file, WT_KIND_FORCE);
    if (status != WT_END) {
        describe_problem(&problem, metadata);
        return WT_OK;
    }
    status = describe_layout(r, parts, metadata);
    if (status == WT_OK && file->n_seen == 0) {
        (void)text_fail_empty(file, "table that is understood", &problem);
        describe_problem(&problem, metadata);
    }
    if (status == WT_OK && text_has_kind(file, WT_KIND_SWEEP) && file->n_seen > 0)
        status = describe_whole_sweep(r, file, log, metadata);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        *has |= text_has_kind(file, others[i]) ? others[i] : 0;
    return status;
}

wt_status text_describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                        wt_log *log, table_writer *metadata)
{
    text_description *const description = self->description;
    describe_context r = {self, input, options, description->kinds, SIZE_MAX, 0};
    text_parts *parts = NULL;
    unsigned has = 0;
    metadata_add(metadata, "description version", "", "", "%s", description->version);
    wt_status status = text_choose_piece(description, input, &r.piece, metadata->err);
    if (status == WT_OK)
        status = begin_parts(&r, log, &parts, metadata->err);
    if (status == WT_OK)
        status = describe_parts(&r, parts, log, &has, metadata);
    text_parts_free(parts);
    if (status != WT_OK)
        return status;
    if ((has & WT_KIND_FORCE) != 0)
        describe_force(&r, metadata);
    if ((has & WT_KIND_IMAGE) != 0)
        status = images_add_metadata(self, input, options, NULL, metadata, WT_OK, NULL);
    if ((has & WT_KIND_SPECTRUM) != 0)
        describe_spectrum(self, input, options, metadata);
    if ((has & WT_KIND_RECORD) != 0)
        describe_record(self, input, options, metadata);
    return status;
}

wt_status text_describe_converted(const file_reader *self, wt_input *input,
                                  const wt_read_options *options, wt_log *log,
                                  table_writer *metadata)
{
    wt_input *text = NULL;
    file_reader text_reader_only = *self;
    text_reader_only.as_text = NULL;
    wt_status status = self->as_text(self, input, NULL, &text, metadata->err);
    if (status == WT_OK)
        status = text_describe(&text_reader_only, text, options, log, metadata);
    wt_input_close(text);
    return status;
}
