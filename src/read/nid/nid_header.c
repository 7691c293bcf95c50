/* The INI text at the beginning of a .nid file, in Latin-1 or UTF-8 as the bytes show.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nid/nid.h"

#include "base/number.h"
#include "base/utf8.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A copy in UTF-8 with a terminating zero. */
static char *to_utf8(const unsigned char *bytes, size_t n, bool latin1)
{
    char *text = malloc(2 * n + 1);
    char *to = text;
    if (text == NULL)
        return NULL;
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

static int by_name(const void *a, const void *b)
{
    const nid_item *x = a, *y = b;
    int order = strcmp(x->section, y->section);
    return order != 0 ? order : strcmp(x->key, y->key);
}

/* Equal names in the order of the file: all keys lie in one block of text. */
static int by_name_and_place(const void *a, const void *b)
{
    const nid_item *x = a, *y = b;
    int order = by_name(a, b);
    return order != 0 ? order : x->key < y->key ? -1 : x->key > y->key;
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
    /* Values may hold '=' themselves; only the first one counts. */
    char *equals = strchr(line, '=');
    if (equals == NULL)
        return;
    *equals = '\0';
    header->items[header->n++] = (nid_item){*section, line, equals + 1};
}

static wt_status parse(nid_header *header, wt_error *err)
{
    size_t lines = 1;
    for (const char *p = header->text; *p != '\0'; p++)
        lines += *p == '\n';
    header->items = calloc(lines, sizeof *header->items);
    if (header->items == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the header");
    const char *section = "";
    char *line = header->text;
    while (line != NULL) {
        char *end = strchr(line, '\n');
        if (end != NULL)
            *end++ = '\0';
        parse_line(header, line, &section);
        line = end;
    }
    qsort(header->items, header->n, sizeof *header->items, by_name_and_place);
    size_t kept = 0;
    for (size_t i = 0; i < header->n; i++)
        if (kept == 0 || by_name(&header->items[kept - 1], &header->items[i]) != 0)
            header->items[kept++] = header->items[i];
    header->n = kept;
    return WT_OK;
}

bool nid_header_ends(const unsigned char *bytes, size_t length)
{
    return memmem(bytes, length, "\n#!", 3) != NULL;
}

wt_status nid_header_read(const unsigned char *bytes, size_t length, nid_header *header,
                          wt_error *err)
{
    *header = (nid_header){0};
    const unsigned char *end = memmem(bytes, length, "\n#!", 3);
    if (end == NULL) {
        wt_fail(err, WT_E_CORRUPT, "the header has no end");
        wt_error_expected(err, "a line that begins with #!");
        return WT_E_CORRUPT;
    }
    size_t n = (size_t)(end - bytes) + 1;
    if (memchr(bytes, '\0', n) != NULL)
        return wt_fail(err, WT_E_CORRUPT, "the header holds zero bytes");
    header->latin1 = utf8_check((const char *)bytes, n) < n;
    header->data = n + 2;
    header->text = to_utf8(bytes, n, header->latin1);
    wt_status status = header->text != NULL ? parse(header, err)
                                            : wt_fail(err, WT_E_MEMORY, "no memory for the header");
    if (status != WT_OK)
        nid_header_clear(header);
    return status;
}

void nid_header_clear(nid_header *header)
{
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
        bsearch(&wanted, header->items, header->n, sizeof *header->items, by_name);
    return found != NULL ? found->value : NULL;
}

double nid_number(const nid_header *header, const char *section, const char *key)
{
    return number_of(nid_get(header, section, key));
}

bool nid_count(const nid_header *header, const char *section, const char *key, size_t most,
               size_t *count)
{
    double value = nid_number(header, section, key);
    if (!(value >= 0 && value <= (double)most) || value != floor(value))
        return false;
    *count = (size_t)value;
    return true;
}

double nid_typed(const nid_header *header, const char *section, const char *key,
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
