/* Parses the INI text at the beginning of a .nid file, in Latin-1 or UTF-8 as the bytes show.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "read/nid/nid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns a copy in UTF-8 with a terminating zero. */
static char *convert_to_utf8(const unsigned char *bytes, size_t n, bool latin1)
{
    char *text = wt_alloc(2 * n + 1, 1);
    char *to = text;
    for (size_t i = 0; i < n; i++) {
        if (latin1 && bytes[i] >= 0x80) {
            *to++ = (char)(0xc0 | bytes[i] >> 6);
            *to++ = (char)(0x80 | (bytes[i] & 0x3f));
        } else {
            *to++ = (char)bytes[i];
        }
    }
    *to = '\0';
    return text;
}

static int compare_items(const void *a, const void *b)
{
    const nid_item *x = a, *y = b;
    int order = strcmp(x->section, y->section);
    return order != 0 ? order : strcmp(x->key, y->key);
}

/* Compares items by name; equal names keep the order of the file, since all keys are in one block
 * of text. */
static int compare_item_order(const void *a, const void *b)
{
    const nid_item *x = a, *y = b;
    int order = compare_items(a, b);
    return order != 0 ? order : x->key < y->key ? -1 : x->key > y->key;
}

/* ---- lengths of lines ----------------------------------------------------------------------- */

/* The numbers of samples of the lines of a section. The file has a line "LineDim7Points=400" for
 * every line of every channel, so they are stored as numbers. */
struct nid_line_lengths {
    size_t number; /* number of the section in the file */
    const char *section;
    uint32_t *points; /* [n] samples of the first lines */
    size_t n;
};

/* Parses the digits at the beginning of a text and returns their number; 0 if they might
 * overflow. */
static size_t parse_digits(const char *text, size_t n, uint32_t *value)
{
    enum { MAX_DIGITS = 9 };
    size_t i = 0;
    for (*value = 0; i < n && text[i] >= '0' && text[i] <= '9'; i++) {
        if (i == MAX_DIGITS)
            return 0;
        *value = 10 * *value + (uint32_t)(text[i] - '0');
    }
    return i;
}

static bool has_prefix(const char *text, size_t n, const char *prefix)
{
    const size_t length = strlen(prefix);
    return n >= length && memcmp(text, prefix, length) == 0;
}

/* Adds the length of a line. False for a length out of sequence, which is an ordinary item. */
static bool add_line_length(nid_header *header, size_t section, uint32_t line, uint32_t points)
{
    nid_line_lengths *list = header->n_lengths > 0 ? &header->lengths[header->n_lengths - 1] : NULL;
    if (list == NULL || list->number != section) {
        header->lengths = array_grow(header->lengths, header->n_lengths, sizeof *list);
        list = &header->lengths[header->n_lengths++];
        *list = (nid_line_lengths){.number = section, .section = ""};
    }
    if (line != list->n)
        return false;
    list->points = array_grow(list->points, list->n, sizeof *list->points);
    list->points[list->n++] = points;
    return true;
}

/* Parses a "LineDim" key of a channel. Its number of samples is stored; its position is not used.
 * Returns false for another line. */
static bool parse_line_length(nid_header *header, size_t section, const char *line, size_t n)
{
    static const char first[] = "LineDim", last[] = "Points=";
    const size_t begin = sizeof first - 1, end = sizeof last - 1;
    uint32_t number = 0, points = 0;
    if (!has_prefix(line, n, first))
        return false;
    const size_t digits = parse_digits(line + begin, n - begin, &number);
    const char *const key = line + begin + digits;
    const size_t left = n - begin - digits;
    if (digits == 0)
        return false;
    if (has_prefix(key, left, last) && left > end &&
        parse_digits(key + end, left - end, &points) == left - end)
        return add_line_length(header, section, number, points);
    return has_prefix(key, left, "Min=") || has_prefix(key, left, "Range=");
}

bool nid_line_length(const nid_header *header, const char *section, size_t line, size_t *n)
{
    char key[48];
    for (size_t i = 0; i < header->n_lengths; i++)
        if (strcmp(header->lengths[i].section, section) == 0 && line < header->lengths[i].n) {
            *n = header->lengths[i].points[line];
            return true;
        }
    snprintf(key, sizeof key, "LineDim%zuPoints", line);
    return nid_integer(header, section, key, UINT32_MAX, n);
}

/* ---- all lines ------------------------------------------------------------------------------ */

/* Sets the section name of the lengths of section `number`. *next is the first entry without a
 * name; entries are in the order of the sections. */
static void name_section(nid_header *header, size_t number, const char *name, size_t *next)
{
    while (*next < header->n_lengths && header->lengths[*next].number == number)
        header->lengths[(*next)++].section = name;
}

static void parse_line(nid_header *header, char *line, const char **section)
{
    size_t n = strlen(line);
    while (n > 0 && (line[n - 1] == '\r' || line[n - 1] == ' '))
        line[--n] = '\0';
    if (line[0] == '[') {
        if (line[n - 1] == ']')
            line[n - 1] = '\0';
        *section = line + 1;
        return;
    }
    /* A value may contain '='; only the first one separates. */
    char *equals = strchr(line, '=');
    if (equals == NULL)
        return;
    *equals = '\0';
    header->items[header->n++] = (nid_item){*section, line, equals + 1};
}

static void parse_items(nid_header *header)
{
    size_t lines = 1, n_sections = 0, n_named = 0;
    for (const char *p = header->text; *p != '\0'; p++)
        lines += *p == '\n';
    header->items = wt_alloc(lines, sizeof *header->items);
    const char *section = "";
    char *line = header->text;
    while (line != NULL) {
        char *end = strchr(line, '\n');
        const bool is_section = line[0] == '[';
        if (end != NULL)
            *end++ = '\0';
        parse_line(header, line, &section);
        if (is_section)
            name_section(header, ++n_sections, section, &n_named);
        line = end;
    }
    qsort(header->items, header->n, sizeof *header->items, compare_item_order);
    size_t kept = 0;
    for (size_t i = 0; i < header->n; i++)
        if (kept == 0 || compare_items(&header->items[kept - 1], &header->items[i]) != 0)
            header->items[kept++] = header->items[i];
    header->n = kept;
}

/* The lines that are parsed later. */
typedef struct header_lines {
    unsigned char *bytes;
    size_t n, capacity, n_sections;
} header_lines;

static void append_line(header_lines *lines, const char *line, size_t n)
{
    if (n > lines->capacity - lines->n) {
        lines->capacity = 2 * lines->capacity + n;
        lines->bytes = wt_realloc(lines->bytes, lines->capacity, 1);
    }
    memcpy(lines->bytes + lines->n, line, n);
    lines->n += n;
}

/* Splits a piece into complete lines. *used is the number of bytes consumed; *end is true where the
 * data begin. */
static wt_status split_lines(nid_header *header, header_lines *lines, const char *piece, size_t n,
                             size_t *used, bool *end, wt_error *err)
{
    size_t at = 0;
    const char *stop = piece;
    while (n - at >= 2 && !*end && stop != NULL) {
        const char *const line = piece + at;
        *end = header->data + at > 0 && memcmp(line, "#!", 2) == 0;
        stop = *end ? NULL : memchr(line, '\n', n - at);
        if (stop == NULL)
            break;
        size_t length = (size_t)(stop - line);
        at += length + 1;
        if (memchr(line, '\0', length) != NULL)
            return wt_fail(err, WT_E_CORRUPT, "the header holds zero bytes");
        lines->n_sections += line[0] == '[';
        const size_t whole = length + 1;
        while (length > 0 && (line[length - 1] == '\r' || line[length - 1] == ' '))
            length--;
        if (!parse_line_length(header, lines->n_sections, line, length))
            append_line(lines, line, whole);
    }
    *used = at;
    return WT_OK;
}

static wt_status fail_no_end(wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "the header has no end");
    wt_error_expected(err, "a line that begins with #!");
    return WT_E_CORRUPT;
}

/* Reads the lines of the header, which may be large but has no long line. */
static wt_status read_header_lines(input_window *from, nid_header *header, header_lines *lines,
                                   wt_error *err)
{
    static const size_t piece = (size_t)1 << 20;
    bool end = false;
    while (!end) {
        const unsigned char *bytes = NULL;
        const size_t left = from->size - header->data, n = left < piece ? left : piece;
        size_t used = 0;
        wt_status status = window_bytes(from, header->data, n, &bytes, err);
        if (status == WT_OK)
            status = split_lines(header, lines, (const char *)bytes, n, &used, &end, err);
        if (status != WT_OK)
            return status;
        header->data += used;
        if (used == 0 && !end)
            return fail_no_end(err);
    }
    header->data += 2;
    return WT_OK;
}

wt_status nid_header_read(wt_input *input, nid_header *header, wt_error *err)
{
    input_window from;
    header_lines lines = {.bytes = NULL};
    *header = (nid_header){0};
    wt_status status = window_open(&from, input, err);
    if (status == WT_OK)
        status = read_header_lines(&from, header, &lines, err);
    window_close(&from);
    if (status == WT_OK) {
        header->latin1 = utf8_valid_length((const char *)lines.bytes, lines.n) < lines.n;
        header->text = convert_to_utf8(lines.bytes, lines.n, header->latin1);
        parse_items(header);
    } else {
        nid_header_clear(header);
    }
    free(lines.bytes);
    return status;
}

void nid_header_clear(nid_header *header)
{
    for (size_t i = 0; i < header->n_lengths; i++)
        free(header->lengths[i].points);
    free(header->lengths);
    free(header->items);
    free(header->text);
    *header = (nid_header){0};
}

const char *nid_get(const nid_header *header, const char *section, const char *key)
{
    nid_item wanted = {section, key, NULL};
    if (header->n == 0)
        return NULL;
    const nid_item *found =
        bsearch(&wanted, header->items, header->n, sizeof *header->items, compare_items);
    return found != NULL ? found->value : NULL;
}

double nid_number(const nid_header *header, const char *section, const char *key)
{
    return parse_number_or_nan(nid_get(header, section, key));
}

bool nid_integer(const nid_header *header, const char *section, const char *key, size_t max_value,
                 size_t *count)
{
    double value = nid_number(header, section, key);
    if (!(value >= 0 && value <= (double)max_value) || value != floor(value))
        return false;
    *count = (size_t)value;
    return true;
}

double nid_quantity(const nid_header *header, const char *section, const char *key,
                    wt_quantity quantity)
{
    const char *text = nid_get(header, section, key);
    double value = (double)NAN, factor = 1, offset = 0;
    char unit[NID_TEXT];
    if (text == NULL || text[0] == '\0' || text[1] != '[')
        return (double)NAN;
    const char *end = strstr(text, "]*[");
    if (end == NULL || !wt_number_parse(text + 2, (size_t)(end - text - 2), '.', &value))
        return (double)NAN;
    const char *start = end + 3;
    size_t n = strcspn(start, "]");
    if (n == 0 || n >= sizeof unit)
        return (double)NAN;
    memcpy(unit, start, n);
    unit[n] = '\0';
    if (wt_unit_to_si(unit, quantity, &factor, &offset, NULL) != WT_OK)
        return (double)NAN;
    return factor * value + offset;
}

bool nid_list_item(const char *list, char separator, size_t i, char *item, size_t size)
{
    for (; i > 0; i--) {
        list = strchr(list, separator);
        if (list == NULL)
            return false;
        list++;
    }
    const char *end = strchr(list, separator);
    size_t n = end != NULL ? (size_t)(end - list) : strlen(list);
    if (n >= size)
        n = size - 1;
    memcpy(item, list, n);
    item[n] = '\0';
    return true;
}
