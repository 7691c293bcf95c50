/* Runs a description over a text, as a whole or part by part.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_scanner.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Piece size for larger files [byte]. */
#define TEXT_PIECE ((size_t)1 << 20)

struct text_parts {
    text_scanner s;
    text_file file;
    wt_read_options options;  /* its texts are borrowed */
    wt_unit_usage *unit_uses; /* [n_units] use of the units of the user */
};

/* Drops tables without rows. */
static void drop_empty_tables(text_file *file)
{
    size_t kept = 0;
    for (size_t i = 0; i < file->n_tables; i++) {
        if (file->tables[i].n_rows == 0)
            text_table_free(&file->tables[i]);
        else
            file->tables[kept++] = file->tables[i];
    }
    file->n_tables = kept;
}

static void warn_replaced_bytes(const text_file *file, wt_log *log)
{
    const text_feed *feed = file->feed;
    if (feed->n_replaced > 0)
        wt_log_add(log, WT_WARNING, file->name, NULL, "%zu byte sequences are no characters of %s",
                   feed->n_replaced, feed->words);
}

/* Records if columns with this name use the unit of the user. */
static void record_column_use(const text_column *columns, size_t n, const char *name,
                              wt_unit_usage *use)
{
    for (size_t i = 0; i < n; i++) {
        const text_column *const c = &columns[i];
        if (!name_equals((text_span){c->name, strlen(c->name)}, name))
            continue;
        if (c->overruled == NULL) {
            use->used = true;
        } else if (!use->overruled) {
            use->overruled = true;
            snprintf(use->stated, sizeof use->stated, "%s", c->unit);
        }
    }
}

/* Records which columns of the part have a unit of the user. */
static void record_unit_use(text_parts *p)
{
    const text_file *file = &p->file;
    for (size_t u = 0; u < p->options.n_units; u++) {
        char name[COLUMN_NAME_SIZE];
        const char *const unit = p->options.units[u], *const equal = strrchr(unit, '=');
        if (equal == NULL)
            continue;
        name_normalise((text_span){unit, (size_t)(equal - unit)}, name);
        for (size_t i = 0; i < file->n_tables; i++) {
            const text_table *const t = &file->tables[i];
            record_column_use(t->columns, t->n_columns, name, &p->unit_uses[u]);
            record_column_use(t->problems, t->n_problems, name, &p->unit_uses[u]);
        }
    }
}

/* Merges the use of a unit into that of all files, which threads share. The first file that
 * overrules the unit stores its own one, which is read after all files. */
static void merge_unit_use(const wt_unit_usage *unit_uses, wt_unit_usage *all)
{
    if (unit_uses->used)
        __atomic_store_n(&all->used, true, __ATOMIC_RELAXED);
    if (unit_uses->overruled && !__atomic_exchange_n(&all->overruled, true, __ATOMIC_RELAXED))
        memcpy(all->stated, unit_uses->stated, sizeof all->stated);
}

/* Checks the units of the user. A unit for an absent column is probably misspelled. A unit that
 * contradicts the file was meant for another file. */
static wt_status check_unit_options(const text_parts *p, wt_error *err)
{
    for (size_t u = 0; u < p->options.n_units; u++) {
        const wt_unit_usage *const unit_uses = &p->unit_uses[u];
        const char *const unit = p->options.units[u], *const equal = strrchr(unit, '=');
        if (equal == NULL || equal == unit || equal[1] == '\0') {
            wt_fail(err, WT_E_ARG, "a unit is not given as NAME=UNIT");
            wt_error_found(err, "\"%s\"", unit);
            wt_error_advice(err, "for example --units \"E'=MPa\"");
            wt_error_options(err, "units");
            return WT_E_ARG;
        }
        if (p->options.unit_usage != NULL)
            merge_unit_use(unit_uses, &p->options.unit_usage[u]);
        else if (unit_uses->overruled)
            wt_log_add(p->s.log, WT_WARNING, p->file.name, NULL,
                       "column \"%.*s\" is in \"%s\", as the file or its format says; the "
                       "unit given, \"%s\", does not apply to it",
                       (int)(equal - unit), unit, unit_uses->stated, equal + 1);
        else if (!unit_uses->used)
            wt_log_add(p->s.log, WT_WARNING, p->file.name, NULL,
                       "a unit is given for \"%.*s\", but there is no such column",
                       (int)(equal - unit), unit);
    }
    return WT_OK;
}

/* ---- parts -------------------------------------------------------------------------------- */

/* True if rows depend only on their names row, and steps separate the blocks. */
static bool can_split(const text_description *d)
{
    return d->n_steps > 0 && d->encoding == ENCODING_UTF_8 && d->units == UNITS_NAME &&
           d->n_unread_tests == 0;
}

wt_status text_choose_piece(text_description *description, wt_input *input, size_t *piece,
                            wt_error *err)
{
    const text_description *d = NULL;
    size_t size = 0;
    *piece = SIZE_MAX;
    wt_status status = description_load(description, DESCRIPTION_WHOLE, &d, err);
    if (status != WT_OK || !can_split(d))
        return status;
    status = wt_input_size(input, &size, err);
    if (status == WT_OK && size > TEXT_PIECE)
        *piece = TEXT_PIECE;
    return status;
}

/* True if lines above a table can state its temperature: the description itself finds neither a
 * temperature nor steps in them. */
static bool reads_conditions(const text_description *d, unsigned kinds)
{
    bool is_found = d->n_steps > 0;
    for (size_t i = 0; i < d->n_fields; i++)
        is_found = is_found || d->fields[i].quantity == WT_Q_TEMPERATURE;
    return (d->kinds & kinds & WT_KIND_SWEEP) != 0 && !is_found;
}

wt_status text_parts_begin(const file_reader *reader, wt_input *input, size_t piece, unsigned kinds,
                           const wt_read_options *options, wt_log *log, text_parts **parts,
                           wt_error *err)
{
    const text_description *d = NULL;
    const wt_status status = description_load(reader->description, DESCRIPTION_WHOLE, &d, err);
    if (status != WT_OK)
        return status;
    text_parts *const p = wt_alloc(1, sizeof *p);
    p->options = *options;
    p->file = (text_file){.description = d, .name = wt_input_name(input)};
    p->file.feed = wt_alloc(1, sizeof *p->file.feed);
    p->file.values = arena_alloc(&p->file.memory, d->n_fields, sizeof *p->file.values);
    p->unit_uses = arena_alloc(&p->file.memory, options->n_units, sizeof *p->unit_uses);
    *p->file.feed = (text_feed){.input = input, .encoding = d->encoding, .piece = piece};
    p->s = (text_scanner){.file = &p->file,
                          .d = d,
                          .options = &p->options,
                          .log = log,
                          .kinds = kinds & d->kinds,
                          .kind = ROW_KIND_NONE,
                          .sample = NO_SAMPLE,
                          .halts = piece != SIZE_MAX,
                          .reads_conditions = reads_conditions(d, kinds),
                          .title_condition = condition_none()};
    for (size_t i = 0; i < HEADER_COUNT; i++)
        p->s.header.value[i] = (double)NAN;
    *parts = p;
    return WT_OK;
}

static void free_tables(text_parts *p)
{
    for (size_t i = 0; i < p->file.n_tables; i++)
        text_table_free(&p->file.tables[i]);
    p->file.n_tables = 0;
    arena_free(&p->file.table_memory);
    p->s.table = NULL;
}

/* Scans the next part, which may have no table. */
static wt_status scan_next_part(text_parts *p, wt_error *err)
{
    text_file *const file = &p->file;
    free_tables(p);
    p->s.err = err;
    scan_lines(&p->s);
    if (p->s.status != WT_OK)
        return p->s.status;
    record_unit_use(p);
    wt_status status = p->s.ended ? check_unit_options(p, err) : WT_OK;
    drop_empty_tables(file);
    if (status == WT_OK)
        tables_split_conditions(file);
    file->n_seen += file->n_tables;
    for (size_t i = 0; i < file->n_tables; i++)
        file->quantities |= file->tables[i].quantities;
    if (status == WT_OK && p->s.ended)
        warn_replaced_bytes(file, p->s.log);
    return status;
}

wt_status text_parts_next(text_parts *p, wt_error *err)
{
    wt_status status = p->s.ended ? WT_END : WT_OK;
    while (status == WT_OK) {
        status = scan_next_part(p, err);
        if (status != WT_OK) {
            p->s.ended = true;
            wt_error_file(err, p->file.name);
        } else if (p->file.n_tables > 0) {
            break;
        } else if (p->s.ended) {
            status = WT_END;
        }
    }
    return status;
}

const text_file *text_parts_file(const text_parts *p)
{
    return &p->file;
}

void text_parts_free(text_parts *p)
{
    if (p == NULL)
        return;
    names_free(&p->s.names);
    cells_free(&p->s.row);
    text_file_free(&p->file);
    free(p);
}

wt_status text_scan(const file_reader *reader, wt_input *input, unsigned kinds,
                    const wt_read_options *options, wt_log *log, text_file *file, wt_error *err)
{
    wt_input *text = NULL;
    text_parts *parts = NULL;
    wt_status status =
        reader->as_text != NULL ? reader->as_text(reader, input, log, &text, err) : WT_OK;
    if (status == WT_OK)
        status = text_parts_begin(reader, text != NULL ? text : input, SIZE_MAX, kinds, options,
                                  log, &parts, err);
    if (status == WT_OK)
        status = text_parts_next(parts, err);
    if (status == WT_OK || status == WT_END) {
        status = WT_OK;
        *file = parts->file;
        file->name = wt_input_name(input);
        parts->file = (text_file){0};
    }
    text_parts_free(parts);
    wt_input_close(text);
    return status;
}

void text_file_free(text_file *file)
{
    for (size_t i = 0; i < file->n_tables; i++)
        text_table_free(&file->tables[i]);
    free(file->tables);
    arena_free(&file->memory);
    arena_free(&file->table_memory);
    feed_free(file->feed);
    *file = (text_file){0};
}
