/* Reading through the reader that a file belongs to: the public functions of force curves, sweeps,
 * images and spectra, and the facts of `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/formats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_read_options wt_read_defaults(void)
{
    return (wt_read_options){
        .format = NULL,
        .want = WT_Q_ALL,
        .segments = WT_SEGMENT_ALL,
        .spring_constant = (double)NAN,
        .sensitivity = (double)NAN,
        .temperature = (double)NAN,
        .units = NULL,
        .n_units = 0,
    };
}

/* A value that replaces the file's must be a positive number. */
static wt_status check_options(const wt_read_options *options, wt_error *err)
{
    if (!isnan(options->spring_constant) &&
        !(isfinite(options->spring_constant) && options->spring_constant > 0))
        return wt_fail(err, WT_E_RANGE, "the spring constant %g N/m is not positive",
                       options->spring_constant);
    if (!isnan(options->sensitivity) &&
        !(isfinite(options->sensitivity) && options->sensitivity > 0))
        return wt_fail(err, WT_E_RANGE, "the sensitivity %g m/V is not positive",
                       options->sensitivity);
    return WT_OK;
}

static wt_status start(const wt_formats *formats, wt_input *input, const wt_read_options *given,
                       unsigned kind, wt_read_options *options, const file_reader **reader,
                       wt_error *err)
{
    *options = given != NULL ? *given : wt_read_defaults();
    wt_status status = check_options(options, err);
    if (status != WT_OK)
        return status;
    return find_reader(formats, input, options->format, kind, reader, err);
}

wt_status wt_force_open(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_force_source **source, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_status status = start(formats, input, options, WT_KIND_FORCE, &o, &reader, err);
    if (status != WT_OK)
        return status;
    status = reader->open_force(reader, input, &o, log, source, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

wt_status wt_force_next(wt_force_source *source, wt_force_curve *curve, wt_error *err)
{
    return source->next(source, curve, err);
}

void wt_force_close(wt_force_source *source)
{
    if (source != NULL)
        source->close(source);
}

size_t wt_force_count(const wt_force_source *source)
{
    return source->n_curves;
}

void wt_force_grid(const wt_force_source *source, long *columns, long *rows)
{
    *columns = source->grid_columns;
    *rows = source->grid_rows;
}

wt_status wt_sweep_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_sweep *sweep, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_status status = start(formats, input, options, WT_KIND_SWEEP, &o, &reader, err);
    if (status != WT_OK)
        return status;
    status = reader->read_sweep(reader, input, &o, log, sweep, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

wt_status wt_images_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                         wt_parselog *log, wt_image **images, size_t *n, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_status status = start(formats, input, options, WT_KIND_IMAGE, &o, &reader, err);
    if (status != WT_OK)
        return status;
    status = reader->read_images(reader, input, &o, log, images, n, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

wt_status wt_power_spectrum_read(const wt_formats *formats, wt_input *input,
                                 const wt_read_options *options, wt_parselog *log,
                                 wt_power_spectrum *spectrum, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_status status = start(formats, input, options, WT_KIND_SPECTRUM, &o, &reader, err);
    if (status != WT_OK)
        return status;
    status = reader->read_spectrum(reader, input, &o, log, spectrum, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

/* ---- facts -------------------------------------------------------------------------------- */

wt_status facts_add(wt_table *facts, const char *item, const char *value, const char *unit,
                    const char *source, wt_error *err)
{
    const char *cells[] = {item, value, unit, source};
    wt_status status = wt_table_add_row(facts, err);
    for (size_t i = 0; i < 4 && status == WT_OK; i++)
        status = wt_table_put_text(facts, i, cells[i], err);
    return status;
}

wt_status facts_number(wt_table *facts, const char *item, double value, const char *unit,
                       const char *source, wt_error *err)
{
    char text[32];
    wt_number_format(value, text);
    return facts_add(facts, item, isnan(value) ? "unknown" : text, unit, source, err);
}

wt_status facts_count(wt_table *facts, const char *item, size_t value, const char *source,
                      wt_error *err)
{
    char text[32];
    snprintf(text, sizeof text, "%zu", value);
    return facts_add(facts, item, text, "", source, err);
}

static wt_status add_columns(wt_table *facts, wt_error *err)
{
    static const struct {
        const char *name, *long_name;
    } columns[] = {{"item", "what is known"},
                   {"value", "its value"},
                   {"unit", "unit of the value"},
                   {"source", "where in the file it stands, or how it is known"}};
    wt_status status = WT_OK;
    for (size_t i = 0; i < sizeof columns / sizeof *columns && status == WT_OK; i++)
        status = wt_table_add_text_column(facts, columns[i].name, columns[i].long_name, err);
    return status;
}

static wt_status add_common(const file_reader *reader, wt_input *input, bool chosen,
                            wt_table *facts, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    char text[32];
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    snprintf(text, sizeof text, "%zu", length);
    status = facts_add(facts, "file", wt_input_name(input), "", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "size", text, "byte", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "format", reader->info.id, "",
                           chosen ? "chosen with --format" : "recognised by its content", err);
    if (status == WT_OK)
        status = facts_add(facts, "format title", reader->info.title, "", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "format verified", reader->info.verified ? "yes" : "no", "",
                           reader->info.evidence, err);
    return status;
}

wt_status wt_describe(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      wt_parselog *log, wt_table **facts, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_table *table = NULL;
    wt_status status = start(formats, input, options, 0, &o, &reader, err);
    if (status != WT_OK)
        return status;
    table = wt_table_new("facts", "What the file is");
    if (table == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory to describe the file");
    status = add_columns(table, err);
    if (status == WT_OK)
        status = add_common(reader, input, o.format != NULL, table, err);
    if (status == WT_OK)
        status = reader->describe(reader, input, &o, log, table, err);
    if (status != WT_OK) {
        wt_error_file(err, wt_input_name(input));
        wt_table_free(table);
        return status;
    }
    *facts = table;
    return WT_OK;
}
