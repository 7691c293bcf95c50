/* Opens a JPK file: its curves and segments, headers and grid.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parses digits up to `stop`. Nine digits exceed the number of curves that a file can contain. */
static bool parse_entry_number(const char **at, char stop, uint32_t *number)
{
    const char *p = *at;
    uint32_t value = 0;
    for (; *p >= '0' && *p <= '9'; p++) {
        if (p - *at >= 9)
            return false;
        value = 10 * value + (uint32_t)(*p - '0');
    }
    if (p == *at || *p != stop)
        return false;
    *at = p + 1;
    *number = value;
    return true;
}

static bool parse_literal(const char **at, const char *word)
{
    size_t n = strlen(word);
    if (strncmp(*at, word, n) != 0)
        return false;
    *at += n;
    return true;
}

/* Parses an entry name "[index/N/]segments/S/segment-header.properties". */
static bool parse_entry_name(const char *name, jpk_segment_ref *ref, bool *map)
{
    ref->curve = 0;
    *map = parse_literal(&name, "index/");
    if (*map && !parse_entry_number(&name, '/', &ref->curve))
        return false;
    return parse_literal(&name, "segments/") && parse_entry_number(&name, '/', &ref->segment) &&
           strcmp(name, "segment-header.properties") == 0;
}

static int compare_segment_refs(const void *a, const void *b)
{
    const jpk_segment_ref *x = a, *y = b;
    if (x->curve != y->curve)
        return x->curve < y->curve ? -1 : 1;
    if (x->segment != y->segment)
        return x->segment < y->segment ? -1 : 1;
    return x->entry < y->entry ? -1 : x->entry > y->entry;
}

static wt_status find_segments(jpk_file *file, wt_error *err)
{
    size_t count = file->archive->n;
    for (size_t i = 0; i < count; i++) {
        jpk_segment_ref ref = {.entry = (uint32_t)i};
        bool map = false;
        if (!parse_entry_name(archive_name(file->archive, i), &ref, &map))
            continue;
        file->refs = array_grow(file->refs, file->n_refs, sizeof *file->refs);
        file->map = file->map || map;
        file->refs[file->n_refs++] = ref;
    }
    if (file->n_refs == 0) {
        wt_fail(err, WT_E_EMPTY, "the file holds no force curve");
        wt_error_expected(err, "entries segments/0/segment-header.properties");
        return WT_E_EMPTY;
    }
    qsort(file->refs, file->n_refs, sizeof *file->refs, compare_segment_refs);
    size_t kept = 0;
    for (size_t i = 0; i < file->n_refs; i++) {
        bool new_curve = i == 0 || file->refs[i].curve != file->refs[kept - 1].curve;
        if (!new_curve && file->refs[i].segment == file->refs[kept - 1].segment) {
            wt_log_add(file->log, WT_WARNING, file->name,
                       archive_name(file->archive, file->refs[i].entry),
                       "segment stands twice in the archive; the first is read");
            continue;
        }
        file->n_curves += new_curve;
        file->refs[kept++] = file->refs[i];
    }
    file->n_refs = kept;
    return WT_OK;
}

/* Reads a header, which stays empty if the file has none. */
static wt_status read_jpk_header(jpk_file *file, const char *name, property_list *header,
                                 wt_error *err)
{
    size_t i = 0;
    if (!archive_find(file->archive, name, &i))
        return WT_OK;
    wt_status status = archive_read(file->archive, i, JPK_HEADER_MAX, &file->buffer, err);
    if (status == WT_OK)
        status = properties_parse(header, file->buffer.data, file->buffer.length, err);
    if (status != WT_OK)
        wt_error_place(err, "%s", name);
    return status;
}

/* Builds the prefix of a key of the root header, such as
 * "force-scan-map.position-pattern.grid.". */
static bool build_root_key(const property_list *header, const char *rest, char *key, size_t size)
{
    const char *type = properties_get(header, "type");
    if (type == NULL)
        return false;
    int n = snprintf(key, size, "%s.%s", type, rest);
    return n > 0 && (size_t)n < size;
}

static void read_map_grid(jpk_file *file)
{
    char key[192];
    if (!build_root_key(&file->header, "position-pattern.", key, sizeof key))
        return;
    double columns = properties_number(&file->header, key, "grid.ilength");
    double rows = properties_number(&file->header, key, "grid.jlength");
    if (columns >= 1 && columns <= 1e6 && rows >= 1 && rows <= 1e6) {
        file->columns = lround(columns);
        file->rows = lround(rows);
    }
    const char *turns = properties_find(&file->header, key, "back-and-forth");
    file->back_and_forth = turns != NULL && strcmp(turns, "true") == 0;
    if (!build_root_key(&file->header, "indexes.", key, sizeof key))
        return;
    double first = properties_number(&file->header, key, "min");
    double last = properties_number(&file->header, key, "max");
    if (first >= 0 && last >= first && last < 1e9)
        file->n_expected = (size_t)(last - first) + 1;
}

static void report_defects(const jpk_file *file)
{
    if (file->archive->defect != NULL)
        wt_log_add(file->log, WT_LOSS, file->name, NULL, "%s; read as far as it goes",
                   file->archive->defect);
    if (file->header.n == 0)
        wt_log_add(file->log, WT_WARNING, file->name, "header.properties",
                   "header is missing: no grid, no instrument");
    if (file->n_expected > file->n_curves)
        wt_log_add(file->log, file->archive->defect != NULL ? WT_LOSS : WT_WARNING, file->name,
                   NULL, "holds %zu of the %zu curves planned", file->n_curves, file->n_expected);
}

wt_status jpk_file_open(wt_input *input, wt_log *log, jpk_file *file, wt_error *err)
{
    *file = (jpk_file){.log = log, .name = wt_input_name(input)};
    wt_status status = archive_open(input, &file->archive, err);
    if (status == WT_OK)
        status = find_segments(file, err);
    if (status == WT_OK)
        status = read_jpk_header(file, "header.properties", &file->header, err);
    if (status == WT_OK)
        status = read_jpk_header(file, "shared-data/header.properties", &file->shared, err);
    if (status != WT_OK) {
        jpk_file_close(file);
        return status;
    }
    if (file->map)
        read_map_grid(file);
    report_defects(file);
    return WT_OK;
}

void jpk_file_close(jpk_file *file)
{
    archive_close(file->archive);
    properties_clear(&file->header);
    properties_clear(&file->shared);
    properties_clear(&file->position);
    free(file->buffer.data);
    free(file->refs);
    free(file->lcds);
    *file = (jpk_file){0};
}

void jpk_file_set_position(jpk_file *file, size_t ref, wt_force_curve *curve)
{
    size_t number = file->refs[ref].curve;
    const property_list *header = &file->header;
    char key[192];
    if (file->map) {
        snprintf(key, sizeof key, "index/%zu/header.properties", number);
        header = &file->position;
        file->position.n = 0;
        if (read_jpk_header(file, key, &file->position, NULL) != WT_OK || file->position.n == 0)
            wt_log_add(file->log, WT_WARNING, file->name, key,
                       "header of a curve cannot be read: its position is unknown");
    }
    if (build_root_key(header, "header.", key, sizeof key)) {
        curve->x = properties_number(header, key, "position.x");
        curve->y = properties_number(header, key, "position.y");
        /* the grid index; it differs from the curve number in an excerpt of a larger file */
        double place = properties_number(header, key, "position-index");
        if (place >= 0 && place < 1e9)
            number = (size_t)place;
    }
    if (file->map && file->position.n > 0 && (isnan(curve->x) || isnan(curve->y)))
        wt_log_add(file->log, WT_WARNING, file->name, NULL,
                   "the header of a curve says no position, as where it was cut");
    (void)force_set_grid_position(file->columns, file->rows, file->back_and_forth, number, curve);
}

void jpk_file_check_segments(const jpk_file *file, size_t ref, size_t n)
{
    const property_list *const header = file->map ? &file->position : &file->header;
    char key[192];
    if (!build_root_key(header, "force-segments.", key, sizeof key))
        return;
    const double stated = properties_number(header, key, "count");
    if (stated > (double)n)
        wt_log_add(file->log, WT_WARNING, file->name,
                   archive_name(file->archive, file->refs[ref].entry),
                   "the curve has %zu of the %.0f segments that its header counts: entries of "
                   "the archive are missing",
                   n, stated);
}
