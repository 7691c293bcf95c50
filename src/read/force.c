/* Reading through the reader that a file belongs to: the public functions of force curves, sweeps,
 * images and spectra, and the facts of `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/facts.h"
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
    status = facts_new(&table, err);
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
