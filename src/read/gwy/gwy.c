/* Reads Gwyddion files (.gwy): "GWYP", then a container of objects. The data fields "/N/data" are
 * images, and graphs may be profiles. The top line of an image comes first.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/bytes.h"
#include "read/bytes/samples.h"
#include "read/images.h"
#include "read/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The bytes that are not read yet. */
typedef struct gwy_bytes {
    const unsigned char *at, *end;
} gwy_bytes;

typedef struct gwy_component {
    const char *key; /* zero-terminated */
    char type;       /* b, c, i, q, d, s or o; capitals for arrays */
    gwy_bytes value; /* items of an array; name, size and components of an object */
    size_t n;        /* number of items */
} gwy_component;

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

/* Reads the name and the components of the object at *from and moves *from to its end; false if it
 * is truncated. */
static bool gwy_read_object(gwy_bytes *from, const char **name, gwy_bytes *components)
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

/* Reads the next component; false at the end, or on damage with *status = WT_E_CORRUPT. */
static bool gwy_next_component(gwy_bytes *components, gwy_component *to, wt_status *status)
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

/* Finds the component with this key and type; false if there is none. */
static bool gwy_find_component(gwy_bytes components, const char *key, char type, gwy_component *to)
{
    wt_status status = WT_OK;
    while (gwy_next_component(&components, to, &status))
        if (to->type == type && strcmp(to->key, key) == 0)
            return true;
    return false;
}

/* Returns the unit stored at a key, an object with a text; "" if it is absent. */
static const char *gwy_unit(gwy_bytes components, const char *key)
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

static double gwy_double(const gwy_component *component)
{
    double value;
    samples_decode(SAMPLE_FLOAT64, false, component->value.at, 1, 1, 0, &value);
    return isfinite(value) ? value : (double)NAN;
}

static size_t gwy_count(const gwy_component *component)
{
    double value;
    samples_decode(SAMPLE_INT32, false, component->value.at, 1, 1, 0, &value);
    return value > 0 ? (size_t)value : 0;
}

/* Tolerance of equal steps, relative to a step. It changes no spectrum noticeably. */
static const double step_tolerance = 1e-3;

static const char prefix[] = "/0/graph/graph/";

/* True if the key belongs to a graph of the container. */
static bool gwy_is_graph(const char *key)
{
    return strncmp(key, prefix, sizeof prefix - 1) == 0 &&
           strspn(key + sizeof prefix - 1, "0123456789") == strlen(key + sizeof prefix - 1);
}

static bool has_equal_steps(const double *x, size_t n)
{
    const double step = (x[n - 1] - x[0]) / (double)(n - 1);
    bool equal = step > 0 && isfinite(step);
    for (size_t i = 0; equal && i < n; i++)
        equal = fabs(x[i] - x[0] - step * (double)i) <= step_tolerance * step;
    return equal;
}

static wt_status add_graph_profile(image_list *list, gwy_bytes graph, gwy_bytes curve,
                                   const char *key, const char *file, wt_log *log, wt_error *err)
{
    gwy_component x, y, title;
    double lateral = 1, vertical = 1, offset = 0, *values = NULL;
    const bool whole = gwy_find_component(curve, "xdata", 'D', &x) &&
                       gwy_find_component(curve, "ydata", 'D', &y) && x.n == y.n && x.n > 1;
    const bool lengths =
        whole &&
        wt_unit_to_si(gwy_unit(graph, "x_unit"), WT_Q_LENGTH, &lateral, &offset, NULL) == WT_OK &&
        wt_unit_to_si(gwy_unit(graph, "y_unit"), WT_Q_LENGTH, &vertical, &offset, NULL) == WT_OK;
    double *const positions = lengths ? wt_alloc(x.n, sizeof *positions) : NULL;
    if (lengths)
        (void)samples_decode(SAMPLE_FLOAT64, false, x.value.at, x.n, lateral, 0, positions);
    wt_status status = WT_OK;
    if (!lengths || !has_equal_steps(positions, x.n)) {
        wt_log_add(log, WT_NOTE, file, key,
                   "a graph that is no profile is left out: lengths against lengths at equal "
                   "steps would be one");
    } else {
        wt_image head = {.n_columns = x.n,
                         .n_rows = 1,
                         .unit = "m",
                         .x_unit = "m",
                         .width = positions[x.n - 1] - positions[0],
                         .x_min = positions[0]};
        images_set_name(&head, gwy_find_component(graph, "title", 's', &title)
                                   ? (const char *)title.value.at
                                   : "profile");
        status = images_add(list, &head, &values, err);
        if (status == WT_OK)
            (void)samples_decode(SAMPLE_FLOAT64, false, y.value.at, y.n, vertical, 0, values);
    }
    free(positions);
    return status;
}

/* Adds the curves of a graph (the components of its object) that are profiles: lengths against
 * lengths at equal steps. Other curves are skipped with a note. */
static wt_status gwy_add_profiles(image_list *list, gwy_bytes graph, const char *key,
                                  const char *file, wt_log *log, wt_error *err)
{
    gwy_component curves;
    wt_status status = WT_OK;
    if (!gwy_find_component(graph, "curves", 'O', &curves))
        return WT_OK;
    for (size_t i = 0; status == WT_OK && i < curves.n; i++) {
        const char *name = NULL;
        gwy_bytes curve;
        if (!gwy_read_object(&curves.value, &name, &curve))
            break; /* all objects were checked before */
        status = add_graph_profile(list, graph, curve, key, file, log, err);
    }
    return status;
}

/* Limit on the fields of a file, since each searches the container for its title. */
enum { MAX_FIELDS = 1000 };
static const char signature[] = "GWYP";

static wt_status fail_gwy(wt_error *err, const char *place, const char *message)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "%s", place);
    wt_error_expected(err, "components that end with their object");
    return WT_E_CORRUPT;
}

/* Parses the number N of a key "/N" that `rest` follows; false for another key. */
static bool parse_channel_key(const char *key, const char *rest, unsigned long *number)
{
    char *end = NULL;
    if (key[0] != '/' || key[1] < '0' || key[1] > '9')
        return false;
    *number = strtoul(key + 1, &end, 10);
    return strcmp(end, rest) == 0;
}

static double field_length(gwy_bytes field, const char *key)
{
    gwy_component c;
    return gwy_find_component(field, key, 'd', &c) ? gwy_double(&c) : (double)NAN;
}

/* Marks the masked heights of a channel as missing. */
static wt_status apply_mask(wt_image *image, gwy_bytes container, unsigned long number,
                            wt_error *err)
{
    char key[48];
    gwy_component mask, data;
    gwy_bytes field;
    const char *name = NULL;
    snprintf(key, sizeof key, "/%lu/mask", number);
    if (!gwy_find_component(container, key, 'o', &mask))
        return WT_OK;
    const size_t n = image->n_columns * image->n_rows;
    double *set = wt_alloc(n, sizeof *set);
    wt_status status = WT_OK;
    if (!gwy_read_object(&mask.value, &name, &field) ||
        !gwy_find_component(field, "data", 'D', &data) || data.n != n)
        status = fail_gwy(err, key, "a mask of another size than its field");
    else
        samples_decode(SAMPLE_FLOAT64, false, data.value.at, n, 1, 0, set);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        if (set[i] > 0) {
            const size_t row = image->n_rows - 1 - i / image->n_columns;
            image->values[row * image->n_columns + i % image->n_columns] = (double)NAN;
        }
    free(set);
    return status;
}

static wt_status add_gwy_field(image_list *list, gwy_bytes field, const char *key,
                               const char *title, wt_error *err)
{
    gwy_component columns, rows, data;
    double factor = 1, *values = NULL;
    if (!gwy_find_component(field, "xres", 'i', &columns) ||
        !gwy_find_component(field, "yres", 'i', &rows) ||
        !gwy_find_component(field, "data", 'D', &data))
        return fail_gwy(err, key, "a field without its size or its data");
    wt_image head = {.n_columns = gwy_count(&columns), .n_rows = gwy_count(&rows)};
    if (head.n_columns == 0 || head.n_rows == 0 || data.n / head.n_columns != head.n_rows ||
        data.n % head.n_columns != 0) {
        fail_gwy(err, key, "the data of a field contradict its size");
        wt_error_found(err, "%zu x %zu pixels and %zu values", head.n_columns, head.n_rows, data.n);
        return WT_E_CORRUPT;
    }
    images_set_units(&head, gwy_unit(field, "si_unit_xy"), gwy_unit(field, "si_unit_z"),
                     field_length(field, "xreal"), field_length(field, "yreal"), &factor);
    images_set_name(&head, title[0] != '\0' ? title : key);
    const wt_status status = images_add(list, &head, &values, err);
    for (size_t row = 0; status == WT_OK && row < head.n_rows; row++)
        samples_decode(SAMPLE_FLOAT64, false, data.value.at + sizeof(double) * head.n_columns * row,
                       head.n_columns, factor, 0,
                       values + (head.n_rows - 1 - row) * head.n_columns);
    return status;
}

static wt_status add_graph(image_list *list, gwy_component *c, const char *file, wt_log *log,
                           wt_error *err)
{
    const char *name = NULL;
    gwy_bytes graph;
    if (!gwy_read_object(&c->value, &name, &graph) || strcmp(name, "GwyGraphModel") != 0)
        return WT_OK;
    return gwy_add_profiles(list, graph, c->key, file, log, err);
}

/* Adds the data fields and profiles in the order of the file. */
static wt_status add_gwy_fields(image_list *list, gwy_bytes container, bool masks_are_missing,
                                const char *file, wt_log *log, wt_error *err)
{
    wt_status status = WT_OK, broken = WT_OK;
    gwy_bytes rest = container;
    gwy_component c;
    unsigned long number = 0;
    while (status == WT_OK && gwy_next_component(&rest, &c, &broken)) {
        const char *name = NULL;
        gwy_bytes field;
        if (!masks_are_missing && c.type == 'o' && parse_channel_key(c.key, "/mask", &number))
            wt_log_add(log, WT_NOTE, file, c.key,
                       "a mask, which may mark anything, is not treated as missing heights");
        if (list->n < MAX_FIELDS && c.type == 'o' && gwy_is_graph(c.key))
            status = add_graph(list, &c, file, log, err);
        if (c.type != 'o' || !parse_channel_key(c.key, "/data", &number) ||
            !gwy_read_object(&c.value, &name, &field) || strcmp(name, "GwyDataField") != 0)
            continue;
        if (list->n == MAX_FIELDS) {
            status = wt_fail(err, WT_E_UNSUPPORTED, "more than %d fields in one file", MAX_FIELDS);
            break;
        }
        char key[48];
        gwy_component title;
        snprintf(key, sizeof key, "/%lu/data/title", number);
        const bool named = gwy_find_component(container, key, 's', &title);
        status = add_gwy_field(list, field, c.key, named ? (const char *)title.value.at : "", err);
        if (status == WT_OK && masks_are_missing)
            status = apply_mask(&list->images[list->n - 1], container, number, err);
    }
    return status == WT_OK && broken != WT_OK
               ? fail_gwy(err, "container", "a component extends beyond its object")
               : status;
}

wt_status gwy_read(wt_input *input, bool masks_are_missing, wt_log *log, wt_image **images,
                   size_t *n_images, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    image_list list = {NULL, 0};
    gwy_bytes all, container;
    const char *name = NULL;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    all = (gwy_bytes){bytes + sizeof signature - 1, bytes + length};
    if (length < sizeof signature || memcmp(bytes, signature, sizeof signature - 1) != 0 ||
        !gwy_read_object(&all, &name, &container) || strcmp(name, "GwyContainer") != 0)
        status = fail_gwy(err, "beginning of the file", "the file is cut, or holds no container");
    if (status == WT_OK)
        status =
            add_gwy_fields(&list, container, masks_are_missing, wt_input_name(input), log, err);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

static wt_status gwy_images(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_image **images,
                            size_t *n_images, wt_error *err)
{
    (void)self;
    (void)options;
    return gwy_read(input, false, log, images, n_images, err);
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(PEEK_BEGINS(peek, signature), 95);
}

const file_reader reader_gwy = {
    .info = {.id = "gwy",
             .title = "Gwyddion (.gwy), images of any instrument",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence = "a file of another program, whose numbers a third one agrees on",
             .version = "1"},
    .detect = detect,
    .read_images = gwy_images,
    .describe = images_describe,
};
