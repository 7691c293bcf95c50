/* Manages the set of formats: binary readers, descriptions embedded in the library, and those of a
 * folder. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/formats.h"
#include "core/base/array.h"
#include "read/embedded_formats.h"
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

struct wt_formats {
    file_reader *readers;
    size_t n;
};

static const file_reader *const binary[] = {
#define READER(id) &reader_##id,
#include "read/readers.def"
};
#define N_BINARY (sizeof binary / sizeof *binary)

/* ---- building a set -------------------------------------------------------------------------- */

static void add_reader(wt_formats *f, const file_reader *reader)
{
    f->readers = array_grow(f->readers, f->n, sizeof *f->readers);
    f->readers[f->n++] = *reader;
}

bool wt_format_is_own(const wt_format_info *format)
{
    return format != NULL && strncmp(format->id, "weartrack-", strlen("weartrack-")) == 0;
}

const file_reader *formats_find_reader(const wt_formats *formats, const char *id)
{
    for (size_t i = 0; i < formats->n; i++)
        if (strcmp(formats->readers[i].info.id, id) == 0)
            return &formats->readers[i];
    return NULL;
}

wt_status formats_add_description(wt_formats *f, text_description *d, wt_log *log, const char *path,
                                  wt_error *err)
{
    wt_status status = WT_OK;
    const file_reader reader = text_reader(d);
    const file_reader *same = formats_find_reader(f, d->id);
    for (size_t i = 0; i < N_BINARY; i++)
        if (strcmp(binary[i]->info.id, d->id) == 0) {
            status = wt_fail(err, WT_E_SCHEMA, "the id belongs to a built-in reader");
            wt_error_file(err, path);
            wt_error_found(err, "id=\"%s\"", d->id);
            wt_error_advice(err, "choose another id");
        }
    if (status == WT_OK && same != NULL) {
        wt_log_add(log, WT_NOTE, path, NULL, "replaces the description \"%s\" of version %s", d->id,
                   same->description->version);
        description_free(same->description);
        f->readers[same - f->readers] = reader;
    } else if (status == WT_OK) {
        add_reader(f, &reader);
    }
    if (status != WT_OK)
        description_free(d);
    return status;
}

wt_status formats_from_description(text_description *d, const char *path, wt_formats **formats,
                                   wt_error *err)
{
    wt_formats *f = wt_alloc(1, sizeof *f);
    const wt_status status = formats_add_description(f, d, NULL, path, err);
    if (status == WT_OK)
        *formats = f;
    else
        wt_formats_free(f);
    return status;
}

static wt_status add_library_descriptions(wt_formats *f, wt_error *err)
{
    wt_status status = WT_OK;
    for (const embedded_text *e = embedded_formats; e->name != NULL && status == WT_OK; e++) {
        const size_t n = strlen(e->name);
        if (n >= 4 && strcmp(e->name + n - 4, ".xml") == 0)
            status = formats_add_description(f, description_from_library(e), NULL, e->name, err);
    }
    return status;
}

static wt_status add_description_folder(wt_formats *f, const char *folder, wt_log *log,
                                        wt_error *err)
{
    description_xsd *schema = NULL;
    char **paths = NULL;
    size_t n = 0;
    wt_status status = wt_glob(folder, "*.xml", &paths, &n, err);
    if (status == WT_OK)
        status = description_xsd_new(&schema, err);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        text_description *d = NULL;
        status = description_parse_file(schema, paths[i], &d, err);
        if (status == WT_OK)
            status = formats_add_description(f, d, log, paths[i], err);
    }
    description_xsd_free(schema);
    wt_strings_free(paths, n);
    return status;
}

/* Adds the binary readers. Those that run a description are added after it and borrow it. */
static void add_binary_readers(wt_formats *f, bool running)
{
    for (size_t i = 0; i < N_BINARY; i++) {
        file_reader reader = *binary[i];
        if ((reader.runs != NULL) != running)
            continue;
        if (running)
            reader.description = formats_find_reader(f, reader.runs)->description;
        add_reader(f, &reader);
    }
}

wt_status wt_formats_new(const char *folder, wt_formats **formats, wt_log *log, wt_error *err)
{
    wt_formats *f = wt_alloc(1, sizeof *f);
    add_binary_readers(f, false);
    wt_status status = add_library_descriptions(f, err);
    if (status == WT_OK && folder != NULL)
        status = add_description_folder(f, folder, log, err);
    if (status != WT_OK) {
        wt_formats_free(f);
        return status;
    }
    add_binary_readers(f, true);
    *formats = f;
    return WT_OK;
}

void wt_formats_free(wt_formats *formats)
{
    if (formats == NULL)
        return;
    for (size_t i = 0; i < formats->n; i++)
        if (reader_is_text(&formats->readers[i]))
            description_free(formats->readers[i].description);
    free(formats->readers);
    free(formats);
}

/* ---- queries --------------------------------------------------------------------------------- */

size_t wt_formats_count(const wt_formats *formats)
{
    return formats->n;
}

const file_reader *formats_reader(const wt_formats *formats, size_t i)
{
    return &formats->readers[i];
}

const wt_format_info *wt_formats_get(const wt_formats *formats, size_t i)
{
    return &formats->readers[i].info;
}

const wt_format_info *wt_formats_find(const wt_formats *formats, const char *id)
{
    const file_reader *reader = formats_find_reader(formats, id);
    return reader != NULL ? &reader->info : NULL;
}

const char *wt_formats_xml(const wt_formats *formats, const char *id)
{
    const file_reader *reader = formats_find_reader(formats, id);
    return reader != NULL && reader_is_text(reader) ? reader->description->xml : NULL;
}
