/* The check of a description, and its trial on a sample.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

static wt_status add_report_row(wt_table *report, const text_table *t, const text_column *c,
                                wt_error *err)
{
    const wt_quantity q = c->rule->quantity;
    wt_status status = wt_table_add_row(report, err);
    if (status == WT_OK)
        status = wt_table_put_text(report, 0, c->name, err);
    if (status == WT_OK)
        status = wt_table_put_text(report, 1, wt_quantity_id(q), err);
    if (status == WT_OK)
        status = wt_table_put_text(report, 2, c->unit, err);
    if (status == WT_OK)
        status = wt_table_put_text(report, 3, wt_quantity_unit(q), err);
    if (status != WT_OK)
        return status;
    const char *problem = "";
    if (c->problem == COLUMN_NO_UNIT)
        problem = "its unit is not said";
    else if (c->problem == COLUMN_BAD_UNIT)
        problem = "its unit does not fit";
    else if (c->problem == COLUMN_UNCLEAR)
        problem = "the column that tells what it is is not there";
    else
        wt_table_put(report, 4, text_table_value(t, 0, c));
    wt_table_put(report, 5, (double)t->n_rows);
    wt_table_put(report, 6, (double)t->names_line);
    return wt_table_put_text(report, 7, problem, err);
}

static wt_status add_report_columns(wt_table *report, wt_error *err)
{
    static const struct {
        const char *name, *words;
        bool number;
    } columns[] = {{"column", "name in the file", false},
                   {"quantity", "what it measures", false},
                   {"unit", "unit in the file", false},
                   {"si_unit", "unit of the first value", false},
                   {"first_value", "first value in the SI unit", true},
                   {"rows", "rows of its table", true},
                   {"line", "line of the names row", true},
                   {"problem", "why it is not read", false}};
    wt_status status = WT_OK;
    for (size_t i = 0; i < sizeof columns / sizeof *columns && status == WT_OK; i++)
        status = columns[i].number
                     ? wt_table_add_column(report, columns[i].name, "1", columns[i].words, err)
                     : wt_table_add_text_column(report, columns[i].name, columns[i].words, err);
    return status;
}

/* All columns of the first table of each layout. */
static wt_status fill_report(const text_file *file, wt_table *report, wt_error *err)
{
    wt_status status = add_report_columns(report, err);
    for (size_t i = 0; i < file->n_tables && status == WT_OK; i++) {
        const text_table *t = &file->tables[i];
        if (i > 0 && t->quantities == file->tables[i - 1].quantities &&
            t->n_problems == file->tables[i - 1].n_problems)
            continue;
        for (size_t c = 0; c < t->n_columns && status == WT_OK; c++)
            status = add_report_row(report, t, &t->columns[c], err);
        for (size_t c = 0; c < t->n_problems && status == WT_OK; c++)
            status = add_report_row(report, t, &t->problems[c], err);
    }
    return status;
}

/* Reads the sample as each kind that its columns promise. */
static wt_status try_kinds(const file_reader *reader, wt_input *sample,
                           const wt_read_options *options, wt_quantity_set found, wt_parselog *log,
                           wt_error *err)
{
    const unsigned kinds = reader->info.kinds;
    const bool many = (kinds & (kinds - 1)) != 0;
    wt_status status = WT_OK;
    if ((kinds & WT_KIND_SWEEP) != 0 && (!many || quantities_suffice(found, WT_KIND_SWEEP))) {
        wt_sweep sweep = {.n_isotherms = 0};
        status = reader->read_sweep(reader, sample, options, log, &sweep, err);
        wt_sweep_clear(&sweep);
    }
    if (status == WT_OK && (kinds & WT_KIND_SPECTRUM) != 0 &&
        (!many || quantities_suffice(found, WT_KIND_SPECTRUM))) {
        wt_power_spectrum spectrum = {.n = 0};
        status = reader->read_spectrum(reader, sample, options, log, &spectrum, err);
        wt_power_spectrum_clear(&spectrum);
    }
    if (status == WT_OK && (kinds & WT_KIND_FORCE) != 0 &&
        (!many || quantities_suffice(found, WT_KIND_FORCE))) {
        wt_force_source *source = NULL;
        wt_force_curve curve = {.n_segments = 0};
        status = reader->open_force(reader, sample, options, log, &source, err);
        if (status == WT_OK) {
            status = source->next(source, &curve, err);
            wt_force_curve_clear(&curve);
            source->close(source);
        }
        status = status == WT_END ? WT_OK : status;
    }
    return status;
}

static wt_status try_sample(const file_reader *reader, wt_input *sample,
                            const wt_read_options *options, wt_parselog *log, wt_table *report,
                            wt_error *err)
{
    text_file file;
    file_peek peek = {.whole = true, .name = wt_input_name(sample)};
    wt_quantity_set found = 0;
    wt_status status = wt_input_bytes(sample, &peek.bytes, &peek.length, err);
    if (status != WT_OK)
        return status;
    if (reader->detect(reader, &peek).answer != ANSWER_YES)
        wt_parselog_add(log, WT_WARNING, peek.name, NULL,
                        "the detect element does not recognise this file");
    text_peek_free(peek.text);
    status = text_scan(reader->description, sample, reader->info.kinds, options, log, &file, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < file.n_tables; i++)
        found |= file.tables[i].quantities;
    if (file.n_tables == 0)
        status = text_nothing(&file, "table whose names are understood", err);
    if (status == WT_OK)
        status = fill_report(&file, report, err);
    text_file_free(&file);
    return status == WT_OK ? try_kinds(reader, sample, options, found, log, err) : status;
}

wt_status wt_description_check(const char *xml_path, wt_input *sample,
                               const wt_read_options *options, wt_parselog *log, wt_table **report,
                               wt_error *err)
{
    const wt_read_options o = options != NULL ? *options : wt_read_defaults();
    description_schema *schema = NULL;
    text_description *d = NULL;
    wt_table *table = wt_table_new("description", "Columns that the description understands");
    if (table == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the report on a description");
    wt_status status = description_schema_new(&schema, err);
    if (status == WT_OK)
        status = description_parse_file(schema, xml_path, &d, err);
    if (status == WT_OK && sample != NULL) {
        const file_reader reader = text_reader(d);
        status = try_sample(&reader, sample, &o, log, table, err);
    } else if (status == WT_OK) {
        status = add_report_columns(table, err);
    }
    if (status == WT_OK) {
        *report = table;
        table = NULL;
    }
    wt_table_free(table);
    description_free(d);
    description_schema_free(schema);
    return status;
}
