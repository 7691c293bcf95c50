/* Parses the objects of a Gwyddion file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/gwy/gwy_object.h"

#include "read/bytes/bytes.h"
#include "read/bytes/samples.h"

#include <math.h>
#include <string.h>

static size_t bytes_left(const gwy_bytes *b)
{
    return (size_t)(b->end - b->at);
}

/* Reads a text and its terminating zero. */
static bool read_text(gwy_bytes *b, const char **text)
{
    const unsigned char *zero = bytes_left(b) > 0 ? memchr(b->at, 0, bytes_left(b)) : NULL;
    if (zero == NULL)
        return false;
    *text = (const char *)b->at;
    b->at = zero + 1;
    return true;
}

static bool read_size(gwy_bytes *b, size_t *size)
{
    if (bytes_left(b) < 4)
        return false;
    *size = le32(b->at);
    b->at += 4;
    return true;
}

bool gwy_read_object(gwy_bytes *from, const char **name, gwy_bytes *components)
{
    size_t size = 0;
    if (!read_text(from, name) || !read_size(from, &size) || size > bytes_left(from))
        return false;
    *components = (gwy_bytes){from->at, from->at + size};
    from->at += size;
    return true;
}

/* Returns the item size of a type with items of equal size; 0 for other types [byte]. */
static size_t item_width(char type)
{
    switch (type) {
    case 'b':
    case 'c':
        return 1;
    case 'i':
        return 4;
    case 'q':
    case 'd':
        return 8;
    default:
        return 0;
    }
}

static bool skip_item(gwy_bytes *b, char type)
{
    const size_t width = item_width(type);
    const char *name = NULL;
    gwy_bytes inner;
    if (type == 's')
        return read_text(b, &name);
    if (type == 'o')
        return gwy_read_object(b, &name, &inner);
    if (width == 0 || width > bytes_left(b))
        return false;
    b->at += width;
    return true;
}

static bool skip_value(gwy_bytes *b, gwy_component *to)
{
    const bool array = to->type >= 'A' && to->type <= 'Z';
    const char item = (char)(array ? to->type - 'A' + 'a' : to->type);
    const size_t width = item_width(item);
    to->n = 1;
    if (array && !read_size(b, &to->n))
        return false;
    to->value.at = b->at;
    if (width > 0) {
        if (to->n > bytes_left(b) / width)
            return false;
        b->at += to->n * width;
    } else {
        /* Each item has at least one byte, so a large count ends with the bytes. */
        for (size_t i = 0; i < to->n; i++)
            if (!skip_item(b, item))
                return false;
    }
    to->value.end = b->at;
    return true;
}

bool gwy_next_component(gwy_bytes *components, gwy_component *to, wt_status *status)
{
    if (bytes_left(components) == 0)
        return false;
    if (read_text(components, &to->key) && bytes_left(components) > 0) {
        to->type = (char)*components->at++;
        if (skip_value(components, to))
            return true;
    }
    *status = WT_E_CORRUPT;
    return false;
}

bool gwy_find_component(gwy_bytes components, const char *key, char type, gwy_component *to)
{
    wt_status status = WT_OK;
    while (gwy_next_component(&components, to, &status))
        if (to->type == type && strcmp(to->key, key) == 0)
            return true;
    return false;
}

const char *gwy_unit(gwy_bytes components, const char *key)
{
    gwy_component unit, text;
    gwy_bytes inside;
    const char *name = NULL;
    if (!gwy_find_component(components, key, 'o', &unit) ||
        !gwy_read_object(&unit.value, &name, &inside) ||
        !gwy_find_component(inside, "unitstr", 's', &text))
        return "";
    return (const char *)text.value.at;
}

double gwy_double(const gwy_component *component)
{
    double value;
    samples_decode(SAMPLE_FLOAT64, false, component->value.at, 1, 1, 0, &value);
    return isfinite(value) ? value : (double)NAN;
}

size_t gwy_count(const gwy_component *component)
{
    double value;
    samples_decode(SAMPLE_INT32, false, component->value.at, 1, 1, 0, &value);
    return value > 0 ? (size_t)value : 0;
}
