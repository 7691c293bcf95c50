/* Reads a ZIP archive whose entries are files of force curves. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "read/collection.h"
#include "core/base/memory.h"
#include "read/bytes/input.h"
#include "read/bytes/zip.h"
#include "read/metadata.h"

#include <stdlib.h>
#include <string.h>

/* The limit on the unpacked size of an entry stops an archive that is made to expand without
 * end. */
#define MAX_ENTRY_SIZE ((size_t)256 << 20)
enum { NAMES_SHOWN = 5 };

typedef struct collection_entry {
    const char *name;
    size_t number; /* index in the archive */
} collection_entry;

typedef struct collection {
    zip_archive *archive;
    collection_entry *entries; /* sorted by name, 2 before 10 */
    size_t n;
    const char *name; /* name of the archive */
} collection;

static void close_collection(collection *c)
{
    archive_close(c->archive);
    free(c->entries);
    *c = (collection){.n = 0};
}

static int compare_entry_names(const void *a, const void *b)
{
    const collection_entry *x = a, *y = b;
    const int order = strverscmp(x->name, y->name);
    return order != 0 ? order : (x->number > y->number) - (x->number < y->number);
}

/* Folders, hidden files and the metadata folder of macOS contain no data. */
static bool is_file(const char *name)
{
    const char *base = strrchr(name, '/');
    base = base != NULL ? base + 1 : name;
    return *base != '\0' && *base != '.' && strncmp(name, "__MACOSX/", 9) != 0;
}

static wt_status open_collection(wt_input *input, collection *c, wt_error *err)
{
    *c = (collection){.name = wt_input_name(input)};
    wt_status status = archive_open(input, &c->archive, err);
    if (status != WT_OK)
        return status;
    c->entries = wt_alloc(c->archive->n, sizeof *c->entries);
    for (size_t i = 0; i < c->archive->n; i++)
        if (is_file(archive_name(c->archive, i)))
            c->entries[c->n++] = (collection_entry){archive_name(c->archive, i), i};
    qsort(c->entries, c->n, sizeof *c->entries, compare_entry_names);
    return WT_OK;
}

/* Unpacks entry `i` into a new input, which the caller closes. */
static wt_status unpack_entry(const collection *c, size_t i, wt_input **input, wt_error *err)
{
    byte_buffer buffer = {.data = NULL};
    const wt_status status =
        archive_read(c->archive, c->entries[i].number, MAX_ENTRY_SIZE, &buffer, err);
    if (status != WT_OK) {
        free(buffer.data);
        return status;
    }
    char *const name = format_text("%s, %s", c->name, c->entries[i].name);
    *input = input_from_bytes(buffer.data, buffer.length, name);
    free(name);
    return WT_OK;
}

wt_status collection_visit(wt_input *input, collection_visitor *look, void *user, wt_error *err)
{
    collection c;
    bool is_done = false;
    wt_status status = open_collection(input, &c, err);
    for (size_t i = 0; i < c.n && status == WT_OK && !is_done; i++) {
        wt_input *content = NULL;
        wt_error damaged = WT_ERROR_INIT;
        status = unpack_entry(&c, i, &content, &damaged);
        if (status == WT_OK)
            status = look(content, user, &is_done, err);
        else if (status != WT_E_MEMORY)
            status = WT_OK; /* the reader of the entry reports the damage */
        else
            wt_fail(err, status, "%s", damaged.message);
        wt_input_close(content);
    }
    close_collection(&c);
    return status;
}

/* ---- curves ---------------------------------------------------------------------------------- */

typedef struct collection_source {
    wt_force_source base;
    collection files;
    const wt_formats *formats;
    collection_opener *open;
    size_t next, n_curves; /* next entry, and number of curves read */
    wt_input *input;       /* input of the current entry, or NULL */
    wt_force_source *inner;
} collection_source;

static void close_entry(collection_source *s)
{
    wt_force_close(s->inner);
    wt_input_close(s->input);
    s->inner = NULL;
    s->input = NULL;
}

/* An entry that is not a force curve is skipped with a warning. One that is a force curve but
 * cannot be read is an error. */
static wt_status open_next_entry(collection_source *s, wt_error *err)
{
    const char *place = s->files.entries[s->next].name;
    wt_error cause = WT_ERROR_INIT;
    char text[512];
    wt_status status = unpack_entry(&s->files, s->next++, &s->input, &cause);
    if (status == WT_OK)
        status = s->open(s->formats, s->input, &s->base.options, s->base.log, &s->inner, &cause);
    if (status == WT_OK)
        return WT_OK;
    close_entry(s);
    if (status == WT_E_FORMAT || status == WT_E_UNSUPPORTED || status == WT_E_EMPTY) {
        wt_error_format(&cause, text, sizeof text);
        wt_log_add(s->base.log, WT_WARNING, s->base.name, place, "left out: %s", text);
        return WT_OK;
    }
    if (err != NULL)
        *err = cause;
    return status;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    collection_source *s = (collection_source *)base;
    for (;;) {
        wt_status status = WT_END;
        if (s->inner != NULL)
            status = wt_force_next(s->inner, curve, err);
        if (s->inner != NULL && status != WT_END) {
            curve->index = s->n_curves++;
            return status;
        }
        close_entry(s);
        if (s->next == s->files.n)
            return WT_END;
        status = open_next_entry(s, err);
        if (status != WT_OK) {
            curve->index = s->n_curves++;
            return status;
        }
    }
}

static void close_source(wt_force_source *base)
{
    collection_source *s = (collection_source *)base;
    close_entry(s);
    close_collection(&s->files);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    (void)self;
    base->n_curves = SIZE_MAX;
    return open_collection(input, &((collection_source *)base)->files, err);
}

static const force_stream collection_force = {.size = sizeof(collection_source),
                                              .open = open_source,
                                              .next = next_curve,
                                              .close = close_source};

void collection_set_opener(wt_force_source *source, const wt_formats *formats,
                           collection_opener *open)
{
    collection_source *s = (collection_source *)source;
    s->formats = formats;
    s->open = open;
}

/* ---- the descriptor -------------------------------------------------------------------------- */

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    collection c;
    (void)self;
    (void)options;
    (void)log;
    wt_status status = open_collection(input, &c, metadata->err);
    if (status != WT_OK)
        return status;
    metadata_add(metadata, "files", "", "entries of the archive", "%zu", c.n);
    for (size_t i = 0; i < c.n && i < NAMES_SHOWN; i++)
        metadata_add(metadata, "file", "", "", "%s", c.entries[i].name);
    if (c.n > NAMES_SHOWN)
        metadata_add(metadata, "more files", "", "", "%zu", c.n - NAMES_SHOWN);
    close_collection(&c);
    return WT_OK;
}

const file_reader reader_collection = {
    .info = {.id = "archive",
             .title = "ZIP archive of files of force curves",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence = "each file is read as its own format",
             .version = "1"},
    .force = &collection_force,
    .describe = describe,
};
