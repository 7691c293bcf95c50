/* weartrack convert: an instrument file to an open one. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include <math.h>
#include <string.h>

#include "cmd/readopts.h"

enum { MAX_COLUMNS = 64 };

/* The channels of all segments, each quantity once: the columns of the table. */
static size_t curve_columns(const wt_force_curve *curve, const wt_channel **columns)
{
    size_t n = 0;
    for (size_t s = 0; s < curve->n_segments; s++)
        for (size_t c = 0; c < curve->segments[s].n_channels; c++) {
            const wt_channel *channel = &curve->segments[s].channels[c];
            size_t k = 0;
            while (k < n && columns[k]->quantity != channel->quantity)
                k++;
            if (k == n && n < MAX_COLUMNS)
                columns[n++] = channel;
        }
    return n;
}

static wt_status curve_table(const wt_force_curve *curve, wt_table **out, wt_error *err)
{
    char name[64], text[64];
    snprintf(name, sizeof name, "force_curve/%zu", curve->index);
    wt_table *t = wt_table_new(name, "force curve");
    const wt_channel *columns[MAX_COLUMNS];
    const size_t n = curve_columns(curve, columns);
    wt_status status = t != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    const struct {
        const char *key;
        double value;
        const char *unit;
    } keys[] = {{"position_x", curve->x, "m"},
                {"position_y", curve->y, "m"},
                {"spring_constant", curve->cantilever.spring_constant, "N/m"},
                {"sensitivity", curve->cantilever.sensitivity, "m/V"}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && status == WT_OK; i++)
        if (!isnan(keys[i].value))
            status = wt_table_set_estimate(t, keys[i].key,
                                           (wt_estimate){keys[i].value, 0, 0, keys[i].unit}, err);
    if (status == WT_OK) {
        snprintf(text, sizeof text, "%zu", curve->index);
        status = wt_table_set_key(t, "curve", text, err);
    }
    if (status == WT_OK)
        status = wt_table_add_text_column(t, "segment", "kind of segment", err);
    for (size_t k = 0; k < n && status == WT_OK; k++)
        status = wt_table_add_column(t, wt_quantity_id(columns[k]->quantity),
                                     wt_quantity_unit(columns[k]->quantity), columns[k]->name, err);
    for (size_t s = 0; s < curve->n_segments && status == WT_OK; s++) {
        const wt_segment *segment = &curve->segments[s];
        if (s > 0)
            status = wt_table_new_block(t, err);
        const wt_channel *of_segment[MAX_COLUMNS];
        for (size_t k = 0; k < n; k++)
            of_segment[k] = wt_segment_channel(segment, columns[k]->quantity);
        for (size_t i = 0; i < segment->n_points && status == WT_OK; i++) {
            status = wt_table_add_row(t, err);
            if (status == WT_OK)
                status = wt_table_put_text(t, 0, wt_segment_kind_name(segment->kind), err);
            for (size_t k = 0; k < n && status == WT_OK; k++)
                if (of_segment[k] != NULL)
                    wt_table_put(t, k + 1, of_segment[k]->values[i]);
        }
    }
    if (status != WT_OK) {
        wt_table_free(t);
        return status;
    }
    *out = t;
    return WT_OK;
}

/* The text stream is written curve by curve, so a map needs no more memory than a curve; the HDF5
 * result is collected first. A curve that cannot be read is said and the others go on. */
static wt_status convert_force(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_parselog *log, FILE *stream,
                               const char *output, bool with_provenance, wt_result *result,
                               size_t *n_failed, wt_error *err)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    bool first = true;
    wt_status status = wt_force_open(formats, input, options, log, &source, err);
    while (status == WT_OK) {
        wt_error curve_err = WT_ERROR_INIT;
        const wt_status got = wt_force_next(source, &curve, &curve_err);
        if (got == WT_END)
            break;
        if (got != WT_OK) {
            wt_error_file(&curve_err, wt_input_name(input));
            cmd_fail("convert", &curve_err);
            *n_failed += 1;
            continue;
        }
        wt_table *table = NULL;
        status = curve_table(&curve, &table, err);
        if (status == WT_OK && stream == NULL) {
            status = wt_result_add(result, table, err);
            first = false;
            continue;
        }
        if (status == WT_OK) {
            status = wt_stream_write(
                stream, table, first && with_provenance ? wt_result_provenance_const(result) : NULL,
                err);
            wt_error_file(status != WT_OK ? err : NULL, output);
            first = false;
        }
        wt_table_free(table);
    }
    if (status == WT_OK && first)
        status = wt_fail(err, *n_failed > 0 ? WT_E_CORRUPT : WT_E_EMPTY, "no curve could be read");
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    return status;
}

static wt_status convert_sweep(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_parselog *log, wt_result *result,
                               wt_error *err)
{
    wt_sweep sweep = {0};
    wt_table *t = NULL;
    wt_status status = wt_sweep_read(formats, input, options, log, &sweep, err);
    if (status != WT_OK)
        goto done;
    wt_sweep_sort(&sweep);
    const bool shear = sweep.deformation == WT_SHEAR;
    t = wt_table_new("sweep", "DMA frequency sweeps");
    if (t == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    const wt_quantity storage = shear ? WT_Q_SHEAR_STORAGE_MODULUS : WT_Q_STORAGE_MODULUS;
    const wt_quantity loss = shear ? WT_Q_SHEAR_LOSS_MODULUS : WT_Q_LOSS_MODULUS;
    const wt_quantity quantities[] = {WT_Q_TEMPERATURE, WT_Q_ANGULAR_FREQUENCY, storage, loss};
    for (size_t i = 0; i < 4 && status == WT_OK; i++)
        status =
            wt_table_add_column(t, wt_quantity_id(quantities[i]), wt_quantity_unit(quantities[i]),
                                wt_quantity_title(quantities[i]), err);
    for (size_t k = 0; k < sweep.n_isotherms && status == WT_OK; k++) {
        const wt_isotherm *iso = &sweep.isotherms[k];
        if (k > 0)
            status = wt_table_new_block(t, err);
        for (size_t i = 0; i < iso->n && status == WT_OK; i++) {
            status = wt_table_add_row(t, err);
            if (status != WT_OK)
                break;
            wt_table_put(t, 0, iso->temperature);
            wt_table_put(t, 1, iso->angular_frequency[i]);
            wt_table_put(t, 2, iso->storage_modulus[i]);
            wt_table_put(t, 3, iso->loss_modulus[i]);
        }
    }
    if (status == WT_OK) {
        status = wt_result_add(result, t, err);
        t = NULL;
    }
done:
    wt_table_free(t);
    wt_sweep_clear(&sweep);
    return status;
}

static wt_status image_table(const wt_image *image, size_t number, wt_table **out, wt_error *err)
{
    char name[64];
    snprintf(name, sizeof name, "image/%zu", number);
    wt_table *t = wt_table_new(name, image->name);
    wt_status status = t != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    const bool flat = image->n_rows < 2;
    if (status == WT_OK)
        status = wt_table_add_column(t, "x", image->x_unit, "first axis", err);
    if (status == WT_OK && !flat)
        status = wt_table_add_column(t, "y", "m", "second axis", err);
    if (status == WT_OK)
        status = wt_table_add_column(t, "value", image->unit, image->name, err);
    const double steps_x = image->n_columns > 1 ? (double)(image->n_columns - 1) : 1;
    const double steps_y = image->n_rows > 1 ? (double)(image->n_rows - 1) : 1;
    for (size_t row = 0; row < image->n_rows && status == WT_OK; row++) {
        if (row > 0)
            status = wt_table_new_block(t, err);
        for (size_t column = 0; column < image->n_columns && status == WT_OK; column++) {
            status = wt_table_add_row(t, err);
            if (status != WT_OK)
                break;
            size_t k = 0;
            wt_table_put(t, k++, image->x_min + image->width * (double)column / steps_x);
            if (!flat)
                wt_table_put(t, k++, image->y_min + image->height * (double)row / steps_y);
            wt_table_put(t, k, image->values[row * image->n_columns + column]);
        }
    }
    if (status != WT_OK) {
        wt_table_free(t);
        return status;
    }
    *out = t;
    return WT_OK;
}

static wt_status convert_images(const wt_formats *formats, wt_input *input,
                                const wt_read_options *options, wt_parselog *log, wt_result *result,
                                wt_error *err)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_status status = wt_images_read(formats, input, options, log, &images, &n, err);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        wt_table *t = NULL;
        status = image_table(&images[i], i, &t, err);
        if (status == WT_OK)
            status = wt_result_add(result, t, err);
    }
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
    return status;
}

static wt_status convert_spectrum(const wt_formats *formats, wt_input *input,
                                  const wt_read_options *options, wt_parselog *log,
                                  wt_result *result, wt_error *err)
{
    wt_power_spectrum spectrum = {0};
    wt_table *t = NULL;
    wt_status status = wt_power_spectrum_read(formats, input, options, log, &spectrum, err);
    if (status != WT_OK)
        return status;
    const wt_quantity density =
        spectrum.kind == WT_SPECTRUM_2D ? WT_Q_POWER_SPECTRUM_2D : WT_Q_POWER_SPECTRUM_1D;
    t = wt_table_new("roughness", "power spectrum");
    if (t == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = wt_table_add_column(t, "wavenumber", wt_quantity_unit(WT_Q_WAVENUMBER),
                                     "wavenumber", err);
    if (status == WT_OK)
        status = wt_table_add_column(t, wt_quantity_id(density), wt_quantity_unit(density),
                                     wt_quantity_title(density), err);
    for (size_t i = 0; i < spectrum.n && status == WT_OK; i++) {
        status = wt_table_add_row(t, err);
        if (status != WT_OK)
            break;
        wt_table_put(t, 0, spectrum.wavenumber[i]);
        wt_table_put(t, 1, spectrum.density[i]);
    }
    wt_power_spectrum_clear(&spectrum);
    if (status == WT_OK)
        return wt_result_add(result, t, err);
    wt_table_free(t);
    return status;
}

/* One kind of data per call: what the file holds first in this order, or the kind asked for. */
static const struct {
    unsigned kind;
    const char *word;
} kinds[] = {{WT_KIND_FORCE, "force"},
             {WT_KIND_SWEEP, "sweep"},
             {WT_KIND_SPECTRUM, "spectrum"},
             {WT_KIND_IMAGE, "image"}};

static wt_status convert(const wt_formats *formats, wt_input *input, unsigned kind,
                         const wt_read_options *options, wt_parselog *log, FILE *stream,
                         const char *output, bool with_provenance, wt_result *result,
                         size_t *n_failed, wt_error *err)
{
    switch (kind) {
    case WT_KIND_FORCE:
        return convert_force(formats, input, options, log, stream, output, with_provenance, result,
                             n_failed, err);
    case WT_KIND_SWEEP:
        return convert_sweep(formats, input, options, log, result, err);
    case WT_KIND_SPECTRUM:
        return convert_spectrum(formats, input, options, log, result, err);
    default:
        return convert_images(formats, input, options, log, result, err);
    }
}

int cmd_convert(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_read_values values;
    cmd_read_values_init(&values);
    int wanted = -1;
    cmd_option options[10] = {{"kind", 0, CMD_CHOICE, &wanted, "force|sweep|spectrum|image",
                               WT_Q_NONE, "which data of a file that holds several kinds"}};
    size_t n = 1;
    n += cmd_read_force_options(&values, options + n);
    n += cmd_read_dma_options(&values, options + n);
    n += cmd_read_units_option(&values, options + n);
    const cmd_usage usage = {
        "convert", "[OPTION]... FILE",
        "Writes an instrument file as a text stream (weartrack-stream(5)), or as HDF5 if the name\n"
        "after -o ends in .h5 or .hdf5, in SI units. - is standard input.",
        CMD_OPT_OUTPUT | CMD_OPT_FORMAT | CMD_OPT_FORMATS | CMD_OPT_PROVENANCE, NULL};
    int first = 0, status = CMD_OK;
    size_t n_failed = 0;
    wt_error err = WT_ERROR_INIT;
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_parselog *log = NULL;
    wt_result *result = NULL;
    wt_outfile *file = NULL;
    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    if (argc - first != 1) {
        status = cmd_usage_error("convert", "one file is needed; %d given", argc - first);
        goto done;
    }
    log = wt_parselog_new();
    result = wt_result_new();
    if (log == NULL || result == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        goto fail;
    }
    const char *path = argv[first];
    const wt_format_info *info = NULL;
    if (wt_formats_new(common.formats, &formats, log, &err) != WT_OK ||
        wt_input_open(path, &input, &err) != WT_OK)
        goto fail;
    status = cmd_check_format("convert", &common, formats);
    if (status != CMD_OK)
        goto done;
    wt_read_options read_options = cmd_read_make(&values, &common);
    if (read_options.format == NULL &&
        wt_detect(formats, input, wanted >= 0 ? kinds[wanted].kind : 0, &info, &err) != WT_OK)
        goto fail;
    for (size_t i = 0; info == NULL && i < wt_formats_count(formats); i++)
        if (strcmp(wt_formats_get(formats, i)->id, read_options.format) == 0)
            info = wt_formats_get(formats, i);
    read_options.format = info->id;

    /* provenance: the file that was read */
    const unsigned char *bytes = NULL;
    wt_provenance_input record = {.path = path, .role = "input", .format = info->id};
    size_t length = 0;
    if (wt_input_bytes(input, &bytes, &length, &err) != WT_OK)
        goto fail;
    record.bytes = length;
    wt_digest(bytes, length, record.sha256);
    if (!common.no_provenance &&
        (wt_provenance_add_input(wt_result_provenance(result), &record) != WT_OK ||
         cmd_provenance(result, cmd_full_argc, cmd_full_argv, &err) != WT_OK)) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        goto fail;
    }

    const bool to_store = cmd_is_store(common.output);
    const bool to_file = common.output != NULL && strcmp(common.output, "-") != 0;
    const char *place = to_file ? common.output : "standard output";
    FILE *stream = to_store ? NULL : stdout;
    if (to_file && !to_store) {
        if (wt_outfile_open(common.output, &file, &err) != WT_OK)
            goto fail;
        stream = wt_outfile_stream(file);
    }
    /* An .nid file may hold images and curves: without --kind the first kind that has data counts.
     */
    wt_status converted = WT_E_EMPTY;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0] && converted == WT_E_EMPTY; k++) {
        if ((info->kinds & kinds[k].kind) == 0 || (wanted >= 0 && (size_t)wanted != k))
            continue;
        err = (wt_error)WT_ERROR_INIT;
        converted = convert(formats, input, kinds[k].kind, &read_options, log, stream, place,
                            !common.no_provenance, result, &n_failed, &err);
        if (converted == WT_OK && kinds[k].kind == WT_KIND_FORCE && stream != NULL)
            goto written;
    }
    if (converted == WT_E_EMPTY && err.status == WT_OK) {
        wt_fail(&err, WT_E_EMPTY, "the file holds no data of that kind");
        wt_error_found(&err, "%s", info->title);
    }
    if (converted != WT_OK)
        goto fail;
    if (to_store) {
        if (cmd_write(&common, result, &err) != WT_OK)
            goto fail;
    } else {
        for (size_t i = 0; i < wt_result_n_tables(result); i++) {
            if (wt_stream_write(stream, wt_result_table(result, i),
                                i == 0 && !common.no_provenance ? wt_result_provenance_const(result)
                                                                : NULL,
                                &err) != WT_OK) {
                wt_error_file(&err, place);
                goto fail;
            }
        }
    }
written:
    if (file != NULL) {
        wt_outfile *done_file = file;
        file = NULL;
        if (wt_outfile_commit(done_file, &err) != WT_OK) {
            wt_error_file(&err, place);
            goto fail;
        }
    }
    cmd_print_log("convert", log, false, common.quiet);
    if (n_failed > 0)
        status = CMD_FAILED;
    goto done;
fail:
    cmd_print_log("convert", log, false, common.quiet);
    wt_error_file(&err, argv[first]);
    status = cmd_fail("convert", &err);
done:
    wt_outfile_discard(file);
    wt_result_free(result);
    wt_parselog_free(log);
    wt_input_close(input);
    wt_formats_free(formats);
    cmd_read_values_free(&values);
    return status;
}
