/* The set of formats: binary readers, the descriptions inside the library, those of a folder.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/formats.h"

#include "read/embedded_formats.h"
#include "read/formats_text.h"
#include "read/stored.h"
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

/* A reader that runs a description. */
typedef struct text_reader {
    file_reader reader; /* first: `self` of its functions is this */
    text_description *description;
} text_reader;

struct wt_formats {
    const file_reader **readers; /* binary readers, then text readers */
    size_t n;
    text_reader *texts;
    size_t n_texts;
    text_reader stored; /* runs the description of the text stream on HDF5 */
};

static const file_reader *const binary[] = {&reader_jpk, &reader_nid};
#define N_BINARY (sizeof binary / sizeof *binary)

static const text_description *of(const file_reader *self)
{
    return ((const text_reader *)self)->description;
}

static detector_match detect(const file_reader *self, const file_peek *peek)
{
    return text_detect(of(self), peek);
}

static wt_status open_force(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_parselog *log,
                            wt_force_source **source, wt_error *err)
{
    return text_open_force(of(self), input, options, log, source, err);
}

static wt_status read_sweep(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_parselog *log, wt_sweep *sweep,
                            wt_error *err)
{
    return text_read_sweep(of(self), input, options, log, sweep, err);
}

static wt_status read_spectrum(const file_reader *self, wt_input *input,
                               const wt_read_options *options, wt_parselog *log,
                               wt_power_spectrum *spectrum, wt_error *err)
{
    return text_read_spectrum(of(self), input, options, log, spectrum, err);
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, wt_table *facts, wt_error *err)
{
    return text_describe(of(self), input, options, log, facts, err);
}

static detector_match detect_stored(const file_reader *self, const file_peek *peek)
{
    (void)self;
    return stored_detect(peek);
}

static wt_status open_force_stored(const file_reader *self, wt_input *input,
                                   const wt_read_options *options, wt_parselog *log,
                                   wt_force_source **source, wt_error *err)
{
    return stored_open_force(of(self), input, options, log, source, err);
}

static wt_status read_sweep_stored(const file_reader *self, wt_input *input,
                                   const wt_read_options *options, wt_parselog *log,
                                   wt_sweep *sweep, wt_error *err)
{
    return stored_read_sweep(of(self), input, options, log, sweep, err);
}

static wt_status read_spectrum_stored(const file_reader *self, wt_input *input,
                                      const wt_read_options *options, wt_parselog *log,
                                      wt_power_spectrum *spectrum, wt_error *err)
{
    return stored_read_spectrum(of(self), input, options, log, spectrum, err);
}

static wt_status describe_stored(const file_reader *self, wt_input *input,
                                 const wt_read_options *options, wt_parselog *log, wt_table *facts,
                                 wt_error *err)
{
    return stored_describe(of(self), input, options, log, facts, err);
}

static text_reader make_stored_reader(text_description *stream)
{
    return (text_reader){
        .description = stream,
        .reader = {.info = {.id = "weartrack-hdf5",
                            .title = "weartrack-hdf5(5): sweeps, spectra and force curves of this "
                                     "program",
                            .kinds = WT_KIND_FORCE | WT_KIND_SWEEP | WT_KIND_SPECTRUM,
                            .verified = true,
                            .evidence = "the HDF5 file that this program writes",
                            .version = "1"},
                   .detect = detect_stored,
                   .open_force = open_force_stored,
                   .read_sweep = read_sweep_stored,
                   .read_spectrum = read_spectrum_stored,
                   .describe = describe_stored}};
}

static text_reader make_reader(text_description *d)
{
    text_reader t = {.description = d};
    t.reader.info = (wt_format_info){.id = d->id,
                                     .title = d->title,
                                     .kinds = d->kinds,
                                     .verified = d->verified,
                                     .evidence = d->evidence,
                                     .version = d->version};
    t.reader.detect = detect;
    t.reader.open_force = (d->kinds & WT_KIND_FORCE) != 0 ? open_force : NULL;
    t.reader.read_sweep = (d->kinds & WT_KIND_SWEEP) != 0 ? read_sweep : NULL;
    t.reader.read_spectrum = (d->kinds & WT_KIND_SPECTRUM) != 0 ? read_spectrum : NULL;
    t.reader.describe = describe;
    return t;
}

/* Takes the description, also on failure. */
static wt_status add(wt_formats *f, text_description *d, wt_parselog *log, const char *path,
                     wt_error *err)
{
    for (size_t i = 0; i < N_BINARY; i++)
        if (strcmp(binary[i]->info.id, d->id) == 0) {
            wt_fail(err, WT_E_SCHEMA, "the id belongs to a built-in reader");
            wt_error_file(err, path);
            wt_error_found(err, "id=\"%s\"", d->id);
            wt_error_advice(err, "choose another id");
            description_free(d);
            return WT_E_SCHEMA;
        }
    for (size_t i = 0; i < f->n_texts; i++)
        if (strcmp(f->texts[i].description->id, d->id) == 0) {
            wt_parselog_add(log, WT_NOTE, path, NULL,
                            "replaces the description \"%s\" of version %s", d->id,
                            f->texts[i].description->version);
            description_free(f->texts[i].description);
            f->texts[i] = make_reader(d);
            return WT_OK;
        }
    text_reader *grown = realloc(f->texts, (f->n_texts + 1) * sizeof *grown);
    if (grown == NULL) {
        description_free(d);
        return wt_fail(err, WT_E_MEMORY, "no memory for the formats");
    }
    f->texts = grown;
    f->texts[f->n_texts++] = make_reader(d);
    return WT_OK;
}

static wt_status add_built_in(wt_formats *f, const description_schema *schema, wt_error *err)
{
    wt_status status = WT_OK;
    for (const embedded_text *e = embedded_formats; e->name != NULL && status == WT_OK; e++) {
        text_description *d = NULL;
        const size_t n = strlen(e->name);
        if (n < 4 || strcmp(e->name + n - 4, ".xml") != 0)
            continue;
        status = description_parse(schema, e->text, e->length, e->name, &d, err);
        if (status == WT_OK)
            status = add(f, d, NULL, e->name, err);
    }
    return status;
}

wt_status formats_parse_file(const description_schema *schema, const char *path,
                             text_description **description, wt_error *err)
{
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK)
        status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = description_parse(schema, (const char *)bytes, length, path, description, err);
    wt_input_close(input);
    return status;
}

static wt_status add_folder(wt_formats *f, const description_schema *schema, const char *folder,
                            wt_parselog *log, wt_error *err)
{
    char **paths = NULL;
    size_t n = 0;
    wt_status status = wt_glob(folder, "*.xml", &paths, &n, err);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        text_description *d = NULL;
        status = formats_parse_file(schema, paths[i], &d, err);
        if (status == WT_OK)
            status = add(f, d, log, paths[i], err);
    }
    wt_strings_free(paths, n);
    return status;
}

wt_status wt_formats_new(const char *folder, wt_formats **formats, wt_parselog *log, wt_error *err)
{
    description_schema *schema = NULL;
    wt_formats *f = calloc(1, sizeof *f);
    if (f == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the formats");
    wt_status status = description_schema_new(&schema, err);
    if (status == WT_OK)
        status = add_built_in(f, schema, err);
    if (status == WT_OK && folder != NULL)
        status = add_folder(f, schema, folder, log, err);
    description_schema_free(schema);
    if (status == WT_OK) {
        f->readers = malloc((N_BINARY + f->n_texts + 1) * sizeof(const file_reader *));
        if (f->readers == NULL)
            status = wt_fail(err, WT_E_MEMORY, "no memory for the formats");
    }
    if (status != WT_OK) {
        wt_formats_free(f);
        return status;
    }
    for (size_t i = 0; i < N_BINARY; i++)
        f->readers[f->n++] = binary[i];
    for (size_t i = 0; i < f->n_texts; i++)
        f->readers[f->n++] = &f->texts[i].reader;
    for (size_t i = 0; i < f->n_texts; i++)
        if (strcmp(f->texts[i].description->id, "weartrack-stream") == 0) {
            f->stored = make_stored_reader(f->texts[i].description);
            f->readers[f->n++] = &f->stored.reader;
        }
    *formats = f;
    return WT_OK;
}

void wt_formats_free(wt_formats *formats)
{
    if (formats == NULL)
        return;
    for (size_t i = 0; i < formats->n_texts; i++)
        description_free(formats->texts[i].description);
    free(formats->texts);
    free(formats->readers);
    free(formats);
}

size_t wt_formats_count(const wt_formats *formats)
{
    return formats->n;
}

const file_reader *formats_reader(const wt_formats *formats, size_t i)
{
    return formats->readers[i];
}

const wt_format_info *wt_formats_get(const wt_formats *formats, size_t i)
{
    return &formats->readers[i]->info;
}

const char *wt_formats_xml(const wt_formats *formats, const char *id)
{
    for (size_t i = 0; i < formats->n_texts; i++)
        if (strcmp(formats->texts[i].description->id, id) == 0)
            return formats->texts[i].description->xml;
    return NULL;
}
