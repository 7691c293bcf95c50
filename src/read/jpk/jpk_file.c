/* Opens a JPK file: its curves and segments, headers and grid. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "read/jpk/jpk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define KEY_MAX 512

/* The remaining input and the output position. A Latin-1 byte becomes at most two bytes of UTF-8.
 * An escape of six bytes becomes at most three, and a pair of twelve at most four. So twice the
 * input size plus the terminating zeros suffices. */
typedef struct property_parser {
    const unsigned char *at;
    const unsigned char *end;
    char *out;
    size_t line;
} property_parser;

static void append_utf8(property_parser *p, uint32_t c)
{
    if (c < 0x80) {
        *p->out++ = (char)c;
    } else if (c < 0x800) {
        *p->out++ = (char)(0xc0 | c >> 6);
        *p->out++ = (char)(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        *p->out++ = (char)(0xe0 | c >> 12);
        *p->out++ = (char)(0x80 | (c >> 6 & 0x3f));
        *p->out++ = (char)(0x80 | (c & 0x3f));
    } else {
        *p->out++ = (char)(0xf0 | c >> 18);
        *p->out++ = (char)(0x80 | (c >> 12 & 0x3f));
        *p->out++ = (char)(0x80 | (c >> 6 & 0x3f));
        *p->out++ = (char)(0x80 | (c & 0x3f));
    }
}

static bool is_blank(unsigned char c)
{
    return c == ' ' || c == '\t' || c == '\f';
}

static bool is_line_break(unsigned char c)
{
    return c == '\n' || c == '\r';
}

static void skip_blanks(property_parser *p)
{
    while (p->at < p->end && is_blank(*p->at))
        p->at++;
}

static void skip_line_break(property_parser *p)
{
    if (p->at == p->end)
        return;
    bool carriage = *p->at++ == '\r';
    if (carriage && p->at < p->end && *p->at == '\n')
        p->at++;
    p->line++;
}

static bool parse_hex4(const property_parser *p, const unsigned char *at, uint32_t *value)
{
    static const char digits[] = "0123456789abcdef";
    if (p->end - at < 4)
        return false;
    uint32_t v = 0;
    for (int i = 0; i < 4; i++) {
        unsigned char c = at[i];
        const char *digit = memchr(digits, c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c, 16);
        if (digit == NULL)
            return false;
        v = v << 4 | (uint32_t)(digit - digits);
    }
    *value = v;
    return true;
}

/* Parses the digits after "\u". A surrogate pair becomes one character. A lone surrogate becomes
 * the replacement character. */
static bool parse_unicode_escape(property_parser *p)
{
    uint32_t c = 0;
    if (!parse_hex4(p, p->at, &c) || c == 0)
        return false;
    p->at += 4;
    if (c >= 0xd800 && c < 0xe000) {
        uint32_t low = 0;
        if (c < 0xdc00 && p->end - p->at >= 6 && p->at[0] == '\\' && p->at[1] == 'u' &&
            parse_hex4(p, p->at + 2, &low) && low >= 0xdc00 && low < 0xe000) {
            c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
            p->at += 6;
        } else {
            c = 0xfffd;
        }
    }
    append_utf8(p, c);
    return true;
}

/* Parses an escape after its backslash. */
static bool parse_escape(property_parser *p)
{
    static const char letters[] = "tnrf", means[] = "\t\n\r\f";
    if (p->at == p->end)
        return true;
    unsigned char c = *p->at;
    if (is_line_break(c)) {
        skip_line_break(p);
        skip_blanks(p);
        return true;
    }
    p->at++;
    if (c == 'u')
        return parse_unicode_escape(p);
    if (c == '\0')
        return false;
    const char *letter = strchr(letters, c);
    append_utf8(p, letter != NULL ? (unsigned char)means[letter - letters] : c);
    return true;
}

/* True for an ASCII character that stands for itself and does not end a word. */
static bool is_plain_character(unsigned char c, bool key)
{
    return c > ' ' ? c < 0x80 && c != '\\' && !(key && (c == '=' || c == ':')) : c == ' ' && !key;
}

static void copy_plain(property_parser *p, bool key)
{
    const unsigned char *at = p->at;
    char *out = p->out;
    while (at < p->end && is_plain_character(*at, key))
        *out++ = (char)*at++;
    p->at = at;
    p->out = out;
}

/* Copies a word up to the end of the line, or up to the end of the key if `key`. */
static bool copy_token(property_parser *p, bool key)
{
    for (;;) {
        copy_plain(p, key);
        if (p->at == p->end || is_line_break(*p->at))
            break;
        const unsigned char c = *p->at;
        if (key && (c == '=' || c == ':' || is_blank(c)))
            break;
        p->at++;
        if (c == '\0')
            return false;
        if (c != '\\')
            append_utf8(p, c);
        else if (!parse_escape(p))
            return false;
    }
    *p->out++ = '\0';
    return true;
}

static int compare_entries(const void *a, const void *b)
{
    const property_entry *x = a, *y = b;
    int order = strcmp(x->key, y->key);
    if (order != 0)
        return order;
    /* all keys are in one block of text, in the order of the file */
    return x->key < y->key ? -1 : x->key > y->key;
}

static void reserve_properties(property_list *p, size_t length)
{
    /* a property has at least one byte and a line break; the last one needs no break */
    const size_t items = length / 2 + 1;
    const size_t size = items * sizeof *p->items + 2 * length + 2;
    if (size > p->capacity) {
        p->items = wt_realloc(p->items, size, 1);
        p->capacity = size;
    }
    p->text = (char *)(p->items + items);
}

static void sort_properties(property_list *p)
{
    if (p->n < 2)
        return;
    qsort(p->items, p->n, sizeof *p->items, compare_entries);
    size_t kept = 0;
    for (size_t i = 0; i < p->n; i++) {
        bool again = i + 1 < p->n && strcmp(p->items[i].key, p->items[i + 1].key) == 0;
        if (!again)
            p->items[kept++] = p->items[i];
    }
    p->n = kept;
}

wt_status properties_parse(property_list *properties, const unsigned char *bytes, size_t length,
                           wt_error *err)
{
    properties->n = 0;
    reserve_properties(properties, length);
    property_parser p = {.at = bytes, .end = bytes + length, .out = properties->text, .line = 1};
    while (p.at < p.end) {
        skip_blanks(&p);
        if (p.at == p.end)
            break;
        if (is_line_break(*p.at)) {
            skip_line_break(&p);
            continue;
        }
        if (*p.at == '#' || *p.at == '!') {
            while (p.at < p.end && !is_line_break(*p.at))
                p.at++;
            continue;
        }
        property_entry item = {.key = p.out};
        size_t line = p.line;
        bool good = copy_token(&p, true);
        if (good) {
            skip_blanks(&p);
            if (p.at < p.end && (*p.at == '=' || *p.at == ':')) {
                p.at++;
                skip_blanks(&p);
            }
            item.value = p.out;
            good = copy_token(&p, false);
        }
        if (!good) {
            properties->n = 0;
            wt_fail(err, WT_E_CORRUPT, "header is damaged");
            wt_error_place(err, "line %zu", line);
            wt_error_expected(err, "text with \\uXXXX for characters beyond Latin-1");
            return WT_E_CORRUPT;
        }
        properties->items[properties->n++] = item;
    }
    sort_properties(properties);
    return WT_OK;
}

void properties_clear(property_list *properties)
{
    free(properties->items);
    *properties = (property_list){0};
}

static int compare_key(const void *key, const void *item)
{
    return strcmp(key, ((const property_entry *)item)->key);
}

const char *properties_get(const property_list *properties, const char *key)
{
    if (properties->n == 0)
        return NULL;
    const property_entry *found =
        bsearch(key, properties->items, properties->n, sizeof *properties->items, compare_key);
    return found != NULL ? found->value : NULL;
}

const char *properties_find(const property_list *properties, const char *prefix, const char *suffix)
{
    char key[KEY_MAX];
    const size_t n = strlen(prefix), more = strlen(suffix) + 1;
    if (n >= sizeof key || more > sizeof key - n)
        return NULL;
    memcpy(key, prefix, n);
    memcpy(key + n, suffix, more);
    return properties_get(properties, key);
}

double properties_number(const property_list *properties, const char *prefix, const char *suffix)
{
    return parse_number_or_nan(properties_find(properties, prefix, suffix));
}

bool property_next_token(const char **list, char *word, size_t size)
{
    const char *start = *list != NULL ? *list + strspn(*list, " ") : "";
    const size_t n = strcspn(start, " ");
    *list = start;
    if (n == 0 || n >= size)
        return false;
    memcpy(word, start, n);
    word[n] = '\0';
    *list = start + n;
    return true;
}

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
