/* Set of formats: binary readers, descriptions embedded in the library, those of a folder, and one
 * from columns that the user names: a plain table (such as table-units) with these columns in
 * front.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/formats.h"

#include "core/base/array.h"
#include "core/base/memory.h"
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

/* Adds a description and takes ownership of it, also on failure. A description with the same id is
 * replaced, with a note in the log. */
static wt_status formats_add_description(wt_formats *f, text_description *d, wt_log *log,
                                         const char *path, wt_error *err)
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

/* ---- named columns --------------------------------------------------------------------------- */

/* An option "NAME=QUANTITY:UNIT". The unit applies where the file does not state one. */
typedef struct column_option {
    text_span name, unit;
    wt_quantity quantity;
} column_option;

static wt_status fail_column_option(const char *text, const char *message, wt_error *err)
{
    wt_fail(err, WT_E_ARG, "%s", message);
    wt_error_expected(err, "NAME=QUANTITY or NAME=QUANTITY:UNIT");
    wt_error_found(err, "\"%s\"", text);
    wt_error_advice(err, "for example \"Stor. Mod.=storage_modulus:MPa\"; the quantities stand in "
                         "weartrack-format(5)");
    return WT_E_ARG;
}

static wt_status parse_column_option(const char *text, column_option *column, wt_error *err)
{
    char id[64];
    double factor, offset;
    const char *equal = strrchr(text, '=');
    if (equal == NULL || equal == text || equal[1] == '\0')
        return fail_column_option(text, "a column is not given as NAME=QUANTITY:UNIT", err);
    const char *unit = strchr(equal, ':');
    const size_t n = unit != NULL ? (size_t)(unit - equal) - 1 : strlen(equal + 1);
    snprintf(id, sizeof id, "%.*s", (int)(n < sizeof id ? n : sizeof id - 1), equal + 1);
    *column = (column_option){.name = {text, (size_t)(equal - text)}};
    if (!wt_quantity_find(id, &column->quantity) || column->quantity == WT_Q_NONE)
        return fail_column_option(text, "a column is given for a quantity that there is not", err);
    if (unit == NULL)
        return WT_OK;
    column->unit = (text_span){unit + 1, strlen(unit + 1)};
    if (wt_unit_to_si(column->unit.text, column->quantity, &factor, &offset, NULL) != WT_OK)
        return fail_column_option(text, "the unit of a column does not fit its quantity", err);
    return WT_OK;
}

/* A kind of data, the id of its plain table, and the score of that. */
typedef struct base_table {
    unsigned kind;
    const char *id, *score;
} base_table;

/* Selects the plain table that contains the quantities of the columns. */
static const base_table *select_base_table(const column_option *columns, size_t n)
{
    static const char usual[] = "score=\"30\"";
    static const base_table bases[] = {{WT_KIND_FORCE, "table-force", usual},
                                       {WT_KIND_SPECTRUM, "table-spectrum", usual},
                                       {WT_KIND_IMAGE, "table-surface", "score=\"20\""},
                                       {WT_KIND_RECORD, "table-record", usual},
                                       {WT_KIND_SWEEP, "table-units", usual}};
    const size_t last = sizeof bases / sizeof *bases - 1;
    const wt_quantity_set sweep_quantities = kind_quantities(bases[last].kind);
    for (size_t i = 0; i < n; i++)
        for (size_t b = 0; b < last; b++)
            if ((kind_quantities(bases[b].kind) & ~sweep_quantities &
                 WT_Q_BIT(columns[i].quantity)) != 0)
                return &bases[b];
    return &bases[last];
}

static void write_escaped(FILE *out, text_span text)
{
    for (size_t i = 0; i < text.length; i++) {
        const char c = text.text[i];
        if (c == '<' || c == '>' || c == '&' || c == '"')
            (void)fprintf(out, "&#%d;", c);
        else
            (void)fputc(c, out);
    }
}

static void write_columns(FILE *out, const column_option *columns, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        (void)fprintf(out, "<column quantity=\"%s\"", wt_quantity_id(columns[i].quantity));
        if (columns[i].unit.length > 0) {
            (void)fputs(" unit=\"", out);
            write_escaped(out, columns[i].unit);
            (void)fputc('"', out);
        }
        (void)fputs("><name>", out);
        write_escaped(out, columns[i].name);
        (void)fputs("</name></column>\n    ", out);
    }
}

/* Writes the description of the plain table with its own head. The score is above that of every
 * description without the name of a manufacturer. The columns of the user precede those of the
 * plain table. */
static wt_status write_description(const base_table *base, const char *xml,
                                   const column_option *columns, size_t n, char **text,
                                   size_t *length, wt_error *err)
{
    const char *const score = base->score;
    const char *const detect = strstr(xml, "<detect>");
    const char *const scored = detect != NULL ? strstr(detect, score) : NULL;
    const char *const first = scored != NULL ? strstr(scored, "<column ") : NULL;
    if (first == NULL)
        return wt_fail(err, WT_E_SCHEMA, "no description %s that columns could be added to",
                       base->id);
    FILE *const out = text_stream_open(text, length);
    (void)fprintf(out,
                  "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<format id=\"given-columns\" "
                  "version=\"1\" kinds=\"%s\" verified=\"false\">\n"
                  "  <title>table with columns named by the user, else as %s</title>\n"
                  "  <evidence>the call</evidence>\n  ",
                  kind_name(base->kind), base->id);
    (void)fwrite(detect, 1, (size_t)(scored - detect), out);
    (void)fputs("score=\"60\"", out);
    (void)fwrite(scored + strlen(score), 1, (size_t)(first - scored) - strlen(score), out);
    write_columns(out, columns, n);
    (void)fputs(first, out);
    text_stream_close(out);
    return WT_OK;
}

wt_status wt_formats_add_columns(wt_formats *formats, const char *const *columns, size_t n,
                                 wt_error *err)
{
    char *text = NULL;
    size_t length = 0;
    text_description *d = NULL;
    description_xsd *schema = NULL;
    if (n == 0)
        return WT_OK;
    column_option *parsed = wt_alloc(n, sizeof *parsed);
    wt_status status = WT_OK;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = parse_column_option(columns[i], &parsed[i], err);
    if (status == WT_OK) {
        const base_table *base = select_base_table(parsed, n);
        status = write_description(base, wt_formats_xml(formats, base->id), parsed, n, &text,
                                   &length, err);
    }
    if (status == WT_OK)
        status = description_xsd_new(&schema, err);
    if (status == WT_OK)
        status = description_parse(schema, text, length, "the columns given", &d, err);
    if (status == WT_OK) {
        d->given_columns = true;
        status = formats_add_description(formats, d, NULL, "the columns given", err);
    }
    description_xsd_free(schema);
    free(text);
    free(parsed);
    return status;
}
