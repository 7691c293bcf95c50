/* Checks a description and tests it on a sample file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/registry.h"
#include "read/force_assembler.h"
#include "read/formats.h"
#include "read/text/text.h"

static void report_column(table_writer *report, const text_table *t, const text_column *c)
{
    static const char *const problems[] = {[COLUMN_GOOD] = "",
                                           [COLUMN_NO_UNIT] = "its unit is not said",
                                           [COLUMN_BAD_UNIT] = "its unit does not fit",
                                           [COLUMN_UNCLEAR] =
                                               "the column that identifies it is missing"};
    const wt_quantity q = c->rule->quantity;
    table_row(report);
    description_put_text(report, DESCRIPTION_COLUMN, c->name);
    description_put_text(report, DESCRIPTION_QUANTITY, wt_quantity_id(q));
    description_put_text(report, DESCRIPTION_UNIT, c->unit);
    description_put_text(report, DESCRIPTION_SI_UNIT, wt_quantity_unit(q));
    if (c->problem == COLUMN_GOOD)
        description_put(report, DESCRIPTION_FIRST_VALUE, text_table_value(t, 0, c));
    description_put(report, DESCRIPTION_ROWS, (double)t->n_rows);
    description_put(report, DESCRIPTION_LINE, (double)t->names_line);
    description_put_text(report, DESCRIPTION_PROBLEM, problems[c->problem]);
}

/* Reports the columns of each table, except for a table with the layout of the one before it. */
static void report_tables(table_writer *report, const text_file *file)
{
    for (size_t i = 0; i < file->n_tables; i++) {
        const text_table *t = &file->tables[i];
        if (i > 0 && t->quantities == file->tables[i - 1].quantities &&
            t->n_problems == file->tables[i - 1].n_problems)
            continue;
        for (size_t c = 0; c < t->n_columns; c++)
            report_column(report, t, &t->columns[c]);
        for (size_t c = 0; c < t->n_problems; c++)
            report_column(report, t, &t->problems[c]);
    }
}

/* Reads the sample as each kind of data for which its columns suffice. */
static wt_status read_all_kinds(const file_reader *reader, const text_file *file, wt_input *sample,
                                const wt_read_options *options, wt_log *log, wt_error *err)
{
    wt_status status = WT_OK;
    if (text_has_kind(file, WT_KIND_SWEEP)) {
        wt_sweep sweep = {.n_isotherms = 0};
        status = reader->read_sweep(reader, sample, options, log, &sweep, err);
        wt_sweep_clear(&sweep);
    }
    if (status == WT_OK && text_has_kind(file, WT_KIND_SPECTRUM)) {
        wt_power_spectrum spectrum = {.n = 0};
        status = reader->read_spectrum(reader, sample, options, log, &spectrum, err);
        wt_power_spectrum_clear(&spectrum);
    }
    if (status == WT_OK && text_has_kind(file, WT_KIND_RECORD)) {
        wt_record record = {.n = 0};
        status = reader->read_record(reader, sample, options, log, &record, err);
        wt_record_clear(&record);
    }
    if (status == WT_OK && text_has_kind(file, WT_KIND_FORCE)) {
        wt_force_source *source = NULL;
        wt_force_curve curve = {.n_segments = 0};
        status = force_open(reader->force, reader, sample, options, log, &source, err);
        if (status == WT_OK) {
            status = wt_force_next(source, &curve, err);
            wt_force_curve_clear(&curve);
            wt_force_close(source);
        }
        status = status == WT_END ? WT_OK : status;
    }
    return status;
}

/* Reads the sample, unpacked if necessary, and reports its columns and problems. */
static wt_status check_on_sample(const wt_formats *alone, wt_input *sample, wt_read_options options,
                                 wt_log *log, table_writer *report, wt_error *err)
{
    text_file file;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    file_peek peek = {.whole = true, .name = wt_input_name(sample), .input = sample};
    options.format = wt_formats_get(alone, 0)->id;
    wt_status status = find_reader(alone, sample, &options, 0, &reader, &content, err);
    if (status == WT_OK)
        status = wt_input_bytes(content, &peek.bytes, &peek.length, err);
    if (status != WT_OK)
        return status;
    if (reader->detect(reader, &peek).answer != ANSWER_YES)
        wt_log_add(log, WT_WARNING, peek.name, NULL,
                   "the detect element does not recognise this file");
    text_peek_free(peek.text);
    status = text_scan(reader, content, reader->info.kinds, &options, log, &file, err);
    if (status != WT_OK)
        return status;
    if (file.n_tables == 0)
        status = text_fail_empty(&file, "table whose names are understood", err);
    report_tables(report, &file);
    if (status == WT_OK)
        status = read_all_kinds(reader, &file, content, &options, log, err);
    text_file_free(&file);
    return status;
}

wt_status wt_format_description_check(const char *xml_path, wt_input *sample,
                                      const wt_read_options *options, wt_log *log,
                                      wt_table **report, wt_error *err)
{
    description_xsd *xsd = NULL;
    text_description *d = NULL;
    wt_formats *alone = NULL;
    wt_table *table = NULL;
    table_writer writer = table_begin(&description_schema, err);
    wt_status status = description_xsd_new(&xsd, err);
    if (status == WT_OK)
        status = description_parse_file(xsd, xml_path, &d, err);
    if (status == WT_OK)
        status = formats_from_description(d, xml_path, &alone, err);
    if (status == WT_OK && sample != NULL) {
        status = check_on_sample(alone, sample, options != NULL ? *options : wt_read_defaults(),
                                 log, &writer, err);
        if (status != WT_OK)
            wt_error_file(err, wt_input_name(sample));
    }
    const wt_status written = table_end(&writer, &table);
    status = status == WT_OK ? written : status;
    if (status == WT_OK)
        *report = table;
    else
        wt_table_free(table);
    wt_formats_free(alone);
    description_xsd_free(xsd);
    return status;
}
