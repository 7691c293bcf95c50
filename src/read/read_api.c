/* Reads DMA sweeps, spectra, friction records and images with the reader that recognises the file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/registry.h"
#include "read/force_assembler.h"
#include "read/formats.h"
#include "read/header_values.h"
#include "read/images.h"

#include <math.h>
#include <string.h>

wt_status wt_input_describe(const wt_formats *formats, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_table **metadata,
                            wt_error *err)
{
    read_request r;
    size_t length = 0;
    wt_status status = read_start(formats, input, options, 0, &r, err);
    if (status == WT_OK)
        status = wt_input_size(input, &length, err);
    if (status != WT_OK)
        return status;
    wt_table *table = NULL;
    table_writer w = table_begin(&facts_schema, err);
    metadata_add(&w, "file", "", "", "%s", wt_input_name(input));
    metadata_add(&w, "size", "byte", "", "%zu", length);
    metadata_add(&w, fact_item_text(FACT_FORMAT), "",
                 r.options.format != NULL ? "chosen with --format" : "recognised by its content",
                 "%s", r.reader->info.id);
    metadata_add(&w, "format title", "", "", "%s", r.reader->info.title);
    metadata_add(&w, "format verified", "", r.reader->info.evidence, "%s",
                 r.reader->info.verified ? "yes" : "no");
    status = r.reader->describe(r.reader, r.content, &r.options, log, &w);
    const wt_status written = table_end(&w, &table);
    status = read_end(input, status == WT_OK ? written : status, err);
    if (status == WT_OK)
        *metadata = table;
    else
        wt_table_free(table);
    return status;
}

wt_status wt_force_open(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_log *log, wt_force_source **source, wt_error *err)
{
    read_request r;
    wt_status status = read_start(formats, input, options, WT_KIND_FORCE, &r, err);
    if (status == WT_OK)
        status = force_open(r.reader->force, r.reader, r.content, &r.options, log, source, err);
    const wt_status end = read_end(input, status, err);
    if (status == WT_OK && end != WT_OK) {
        wt_force_close(*source);
        *source = NULL;
    }
    return end;
}

wt_status wt_sweep_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_log *log, wt_sweep *sweep, wt_error *err)
{
    read_request r;
    wt_status status = read_start(formats, input, options, WT_KIND_SWEEP, &r, err);
    if (status == WT_OK)
        status = r.reader->read_sweep(r.reader, r.content, &r.options, log, sweep, err);
    return read_end(input, status, err);
}

/* Converts spectral densities of another convention to that of this program. */
static wt_status apply_spectrum_convention(const read_request *r, const char *name, wt_log *log,
                                           wt_power_spectrum *spectrum, wt_error *err)
{
    if (r->options.spectrum_convention == WT_CONVENTION_WEARTRACK)
        return WT_OK;
    if (wt_format_is_own(&r->reader->info)) {
        wt_fail(err, WT_E_ARG, "the spectrum is one of this program");
        wt_error_advice(err, "leave spectrum-convention out: it is for files of other programs");
        return WT_E_ARG;
    }
    const bool area = spectrum->kind == WT_SPECTRUM_2D;
    const double factor = area ? 4 * M_PI * M_PI : 2 * M_PI;
    for (size_t i = 0; i < spectrum->n; i++)
        spectrum->density[i] /= factor;
    wt_log_add(log, WT_NOTE, name, NULL,
               "densities of contact.engineering are divided by %s = %.5g: here the mean "
               "square height is %s",
               area ? "(2 pi)^2" : "2 pi", factor, area ? "2 pi int q C dq" : "2 int C1 dq");
    return WT_OK;
}

wt_status wt_power_spectrum_read(const wt_formats *formats, wt_input *input,
                                 const wt_read_options *options, wt_log *log,
                                 wt_power_spectrum *spectrum, wt_error *err)
{
    read_request r;
    wt_power_spectrum result = {.n = 0};
    wt_status status = read_start(formats, input, options, WT_KIND_SPECTRUM, &r, err);
    if (status == WT_OK)
        status = r.reader->read_spectrum(r.reader, r.content, &r.options, log, &result, err);
    if (status == WT_OK)
        status = apply_spectrum_convention(&r, wt_input_name(input), log, &result, err);
    status = read_end(input, status, err);
    if (status == WT_OK)
        *spectrum = result;
    else
        wt_power_spectrum_clear(&result);
    return status;
}

wt_status wt_record_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                         wt_log *log, wt_record *record, wt_error *err)
{
    read_request r;
    wt_record result = {.n = 0};
    wt_status status = read_start(formats, input, options, WT_KIND_RECORD, &r, err);
    if (status == WT_OK)
        status = r.reader->read_record(r.reader, r.content, &r.options, log, &result, err);
    status = read_end(input, status, err);
    if (status == WT_OK)
        *record = result;
    else
        wt_record_clear(&result);
    return status;
}

wt_status wt_images_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                         wt_log *log, wt_image **images, size_t *n, wt_error *err)
{
    read_request r;
    wt_status status = read_start(formats, input, options, WT_KIND_IMAGE, &r, err);
    if (status == WT_OK)
        status = r.reader->read_images(r.reader, r.content, &r.options, log, images, n, err);
    if (status == WT_OK) {
        status = images_apply_options(*images, *n, &r.options, wt_input_name(input), log, err);
        if (status != WT_OK)
            images_free(images, n);
    }
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}
