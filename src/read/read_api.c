/* Reads DMA sweeps, spectra, friction records and images with the reader and the options of a file.
 * Tests a description on a sample file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"

#include "core/base/shared_params.h"
#include "core/table/registry.h"
#include "read/force_assembler.h"
#include "read/formats.h"
#include "read/header_values.h"
#include "read/images.h"
#include "read/reader.h"
#include "read/text/text.h"

#include <math.h>
#include <string.h>

typedef struct read_request {
    wt_read_options options;
    const file_reader *reader;
    wt_input *content;
} read_request;

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
        .sheet = NULL,
        .strain = (double)NAN,
        .frequency = (double)NAN,
        .pixel_size = (double)NAN,
        .height_unit = NULL,
    };
}

static wt_status check_name_pattern(const void *member, wt_error *err)
{
    const char *pattern = *(const char *const *)member;
    const char *place = pattern != NULL ? strchr(pattern, '#') : NULL;
    if (pattern == NULL || (place != NULL && strchr(place + 1, '#') == NULL))
        return WT_OK;
    wt_fail(err, WT_E_ARG, "\"%s\" does not say where in a name the temperature stands", pattern);
    wt_error_expected(err, "one # in its place, such as \"*_#degC*\"");
    return WT_E_ARG;
}

static wt_status check_length_unit(const void *member, wt_error *err)
{
    const char *unit = *(const char *const *)member;
    double factor = 1, offset = 0;
    return unit == NULL ? WT_OK : wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, err);
}

static const wt_param rows[] = {
    SPRING_CONSTANT(wt_read_options, PARAM_NO_CASE, NULL),
    SENSITIVITY(wt_read_options, PARAM_NO_CASE, NULL),
    {PARAM("temperature", wt_read_options, temperature, WT_Q_TEMPERATURE, ABOVE(0)), .value = "T",
     .unset = "", .help = SUCH_AS("temperature of DMA files that state none, ", "20degC", "")},
    {PARAM_TEXT_OF("temperature-in-name", wt_read_options, temperature_in_name), .value = "PATTERN",
     .unset = "",
     .help = SUCH_AS("place of the temperature in the names of DMA files or sheets that state "
                     "none, in degrees Celsius: # is the number and * any text, ",
                     "\"*_#C.txt\"", ""),
     .check = check_name_pattern},
    {PARAM("frequency", wt_read_options, frequency, WT_Q_FREQUENCY, ABOVE(0)), .value = "F",
     .unset = "",
     .help = SUCH_AS("frequency of strain and temperature sweeps whose files state none, ", "10Hz",
                     "")},
    {PARAM_TEXTS_OF("units", wt_read_options, units, n_units), .value = "NAME=UNIT", .unset = "",
     .help = "unit of a column for which the file states none, such as \"E'=MPa\"; repeatable"},
    {PARAM("pixel-size", wt_read_options, pixel_size, WT_Q_LENGTH, ABOVE(0)), .value = "L",
     .unset = "",
     .help = SUCH_AS("pixel spacing of height maps whose files do not state their size, ", "0.5um",
                     "")},
    {PARAM_TEXT_OF("height-unit", wt_read_options, height_unit), .value = "UNIT", .unset = "",
     .help = "unit of the values of height maps whose files state no unit of length, such as nm",
     .check = check_length_unit},
    {PARAM_CHOICE_OF("spectrum-convention", wt_read_options, spectrum_convention,
                     "weartrack|contact-engineering"),
     .help = "definition of the density of a power spectrum; densities of contact.engineering "
             "(SurfaceTopography) are divided by (2 pi)^2 for an area and by 2 pi for a profile"},
    {PARAM_TEXT_OF("format", wt_read_options, format), .value = "ID", .unset = "",
     .help = "read the files as this format (see weartrack formats list)"},
    {PARAM_TEXT_OF("sheet", wt_read_options, sheet), .value = "NAME", .unset = "",
     .help = "sheet of a spreadsheet file; all reads every sheet that holds data, one after the "
             "other; default: the only sheet that holds data"},
    {PARAM_CHOICE_OF("deformation", wt_read_options, deformation, "of-file|tension|shear|bending"),
     .help = "deformation that the moduli of a DMA file belong to if their names do not state it, "
             "as in \"storage modulus\"; bending gives E like tension"},
    {PARAM("strain", wt_read_options, strain, WT_Q_STRAIN, ABOVE(0)), .value = "S", .unset = "",
     .help = SUCH_AS("select the DMA isotherms and temperature sweeps with the strain amplitude "
                     "nearest to this one, ",
                     "0.1%", ", if there are several amplitudes")},
    {PARAM_TEXT_OF("sample", wt_read_options, sample), .value = "NAME", .unset = "",
     .help = "select the DMA sweeps of this sample, or its result of weartrack master; all: the "
             "sweeps are of one material whatever their names are"},
    {PARAM_CHOICE_OF("sample-by", wt_read_options, sample_by, "name|file"),
     .help = "how the samples of DMA sweeps are distinguished: by the name in a column or in "
             "the header, or by the file"},
    {PARAM_CHOICE_OF("conditioning", wt_read_options, conditioning, "mend|keep"),
     .help = "mend leaves out or corrects copies, flagged rows, outliers, pauses, zeros and "
             "drifts; keep uses them as they are"},
};

PARAM_TABLE(wt_read_params, wt_read_options, rows, wt_read_defaults, NO_PARTS)

/* Begins every kind of read. It checks `given` (NULL: the defaults), and finds the reader and the
 * unpacked content. */
static wt_status read_start(const wt_formats *formats, wt_input *input,
                            const wt_read_options *given, unsigned kind, read_request *request,
                            wt_error *err)
{
    resource_error_clear();
    *request = (read_request){.options = given != NULL ? *given : wt_read_defaults()};
    wt_status status = param_check(wt_read_params(), &request->options, err);
    if (status != WT_OK)
        return status;
    return find_reader(formats, input, &request->options, kind, &request->reader, &request->content,
                       err);
}

/* Ends every kind of read: adds the file name to an error and reports a resource error of a
 * library. */
static wt_status read_end(wt_input *input, wt_status status, wt_error *err)
{
    status = resource_error_finish(status, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

/* ---- data ------------------------------------------------------------------------------------ */

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

/* ---- test of a description ------------------------------------------------------------------- */

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
