/* Reads Gwyddion Simple Field files (.gsf), which Gwyddion writes for images of any instrument.
 *
 * A file has a line with the name of the format and lines "key = value". One to four zero bytes
 * follow, up to a multiple of four. Then come little-endian floats line by line, the top line
 * first. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/samples.h"
#include "read/images.h"
#include "read/reader.h"

#include <math.h>
#include <string.h>

static const char first_line[] = "Gwyddion Simple Field 1.0\n";
#define HEADER_MAX ((size_t)1 << 16)

typedef struct gsf_header {
    size_t n_columns, n_rows;
    double width, height; /* NaN if absent */
    char unit_xy[16], unit_z[16], title[48];
    size_t data; /* offset of the samples */
} gsf_header;

static double parse_number(const char *text, size_t n)
{
    double value = (double)NAN;
    return wt_number_parse(text, n, '.', &value) ? value : (double)NAN;
}

static size_t parse_positive_integer(const char *text, size_t n)
{
    const double value = parse_number(text, n);
    return value >= 1 && value <= 1e9 && value == floor(value) ? (size_t)value : 0;
}

static void set_header_value(gsf_header *h, const char *key, size_t n_key, const char *text,
                             size_t n)
{
    const struct {
        const char *key;
        size_t *count;
        double *number;
        char *text;
        size_t size;
    } known[] = {{"XRes", &h->n_columns, NULL, NULL, 0},
                 {"YRes", &h->n_rows, NULL, NULL, 0},
                 {"XReal", NULL, &h->width, NULL, 0},
                 {"YReal", NULL, &h->height, NULL, 0},
                 {"XYUnits", NULL, NULL, h->unit_xy, sizeof h->unit_xy},
                 {"ZUnits", NULL, NULL, h->unit_z, sizeof h->unit_z},
                 {"Title", NULL, NULL, h->title, sizeof h->title}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strlen(known[i].key) != n_key || memcmp(known[i].key, key, n_key) != 0)
            continue;
        if (known[i].count != NULL)
            *known[i].count = parse_positive_integer(text, n);
        else if (known[i].number != NULL)
            *known[i].number = parse_number(text, n);
        else
            snprintf(known[i].text, known[i].size, "%.*s", (int)(n < 64 ? n : 64), text);
    }
}

/* Returns a part of a line without blanks at both ends. */
static const char *trim_blanks(const char *from, const char *to, size_t *n)
{
    while (from < to && (*from == ' ' || *from == '\t'))
        from++;
    while (to > from && (to[-1] == ' ' || to[-1] == '\t' || to[-1] == '\r'))
        to--;
    *n = (size_t)(to - from);
    return from;
}

static wt_status read_gsf_header(wt_input *input, gsf_header *h, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    bool whole = false;
    *h = (gsf_header){.width = (double)NAN, .height = (double)NAN};
    const wt_status status = wt_input_peek(input, HEADER_MAX, &bytes, &length, &whole, err);
    if (status != WT_OK)
        return status;
    const char *text = (const char *)bytes;
    const char *end = memchr(bytes, 0, length);
    if (end == NULL || length < sizeof first_line - 1 ||
        memcmp(text, first_line, sizeof first_line - 1) != 0)
        return images_fail_header(err, "the header has no end",
                                  "lines \"key = value\", then a zero byte");
    for (const char *line = text + sizeof first_line - 1; line < end;) {
        const char *next = memchr(line, '\n', (size_t)(end - line));
        const char *stop = next != NULL ? next : end;
        const char *sign = memchr(line, '=', (size_t)(stop - line));
        if (sign != NULL) {
            size_t n_key, n;
            const char *key = trim_blanks(line, sign, &n_key),
                       *value = trim_blanks(sign + 1, stop, &n);
            set_header_value(h, key, n_key, value, n);
        }
        line = stop + 1;
    }
    h->data = ((size_t)(end - text) / 4 + 1) * 4;
    if (h->n_columns == 0 || h->n_rows == 0)
        return images_fail_header(err, "the size of the image is missing",
                                  "XRes and YRes, integers");
    return WT_OK;
}

/* Fills the image head. Positions count from the lower left corner; the offsets of the file point
 * downwards and are ignored. */
static void fill_image_head(const gsf_header *h, wt_image *head, double *factor)
{
    *head = (wt_image){.n_columns = h->n_columns, .n_rows = h->n_rows};
    images_set_units(head, h->unit_xy, h->unit_z, h->width, h->height, factor);
    images_set_name(head, h->title[0] != '\0' ? h->title : "field");
}

static wt_status gsf_images(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_image **images,
                            size_t *n_images, wt_error *err)
{
    gsf_header h;
    image_list list = {NULL, 0};
    wt_image head;
    double factor = 1;
    (void)self;
    (void)options;
    wt_status status = read_gsf_header(input, &h, err);
    if (status == WT_OK) {
        const image_raster raster = {
            .from = h.data, .type = SAMPLE_FLOAT32, .is_last = true, .is_from_top = true};
        fill_image_head(&h, &head, &factor);
        status = images_add_raster(&list, input, &head, &raster, factor, err);
    }
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(PEEK_BEGINS(peek, first_line), 95);
}

const file_reader reader_gsf = {
    .info = {.id = "gsf",
             .title = "Gwyddion Simple Field (.gsf), an image of any instrument",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence =
                 "a measured field without heights, whose numbers another program agrees on",
             .version = "1"},
    .detect = detect,
    .read_images = gsf_images,
    .describe = images_describe,
};
