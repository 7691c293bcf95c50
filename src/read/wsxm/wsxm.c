/* Reads height maps of WSxM (Nanotec): .stp and .top.
 *
 * A file has two lines with the name of the format, the size of the header, sections of lines
 * "name: value" in Latin-1, and the samples of the image, little-endian. The samples begin with the
 * lower right corner and have no unit: their range is the "Z Amplitude" of the header.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/text.h"
#include "read/bytes/samples.h"
#include "read/description/description.h"
#include "read/images.h"
#include "read/reader.h"

#include <math.h>
#include <string.h>

#define FIRST_LINE "WSxM file copyright"
#define SECOND_LINE "SxM Image file"

#define HEADER_MAX ((size_t)1 << 16)

/* A value with a unit in UTF-8. The number is NaN if the header does not state it. */
typedef struct wsxm_quantity {
    double value;
    char unit[16];
} wsxm_quantity;

typedef struct wsxm_header {
    size_t size; /* of the header [byte] */
    size_t n_columns, n_rows;
    sample_type type;
    wsxm_quantity width, height, range;
    char channel[48];
} wsxm_header;

/* Copies text to UTF-8. Text that is UTF-8 already is unchanged, other text is Latin-1. */
static void copy_latin1(char *to, size_t size, text_span text)
{
    const bool is_utf8 = utf8_valid_length(text.text, text.length) == text.length;
    size_t n = 0;
    for (size_t i = 0; i < text.length && n + 2 < size; i++) {
        const unsigned char c = (unsigned char)text.text[i];
        if (c < 0x80 || is_utf8) {
            to[n++] = (char)c;
        } else {
            to[n++] = (char)(0xc0 | c >> 6);
            to[n++] = (char)(0x80 | (c & 0x3f));
        }
    }
    to[n] = '\0';
}

/* Finds a line "name: value" of the header. */
static bool find_value(text_span header, const char *name, text_span *value)
{
    const size_t n_name = strlen(name);
    const char *const end = header.text + header.length;
    for (const char *line = header.text; line < end;) {
        const char *const next = memchr(line, '\n', (size_t)(end - line));
        const char *stop = next != NULL ? next : end;
        while (line < stop && (*line == ' ' || *line == '\t'))
            line++;
        if ((size_t)(stop - line) > n_name && memcmp(line, name, n_name) == 0 &&
            line[n_name] == ':') {
            line += n_name + 1;
            while (line < stop && (*line == ' ' || *line == '\t'))
                line++;
            while (stop > line && strchr(" \t\r", stop[-1]) != NULL)
                stop--;
            *value = (text_span){line, (size_t)(stop - line)};
            return true;
        }
        if (next == NULL)
            break;
        line = next + 1;
    }
    return false;
}

/* Reads an integer of at least 1; 0 for another text. */
static size_t read_count(text_span header, const char *name)
{
    static const double most = 1e9;
    text_span text;
    double value = 0;
    return find_value(header, name, &text) &&
                   wt_number_parse(text.text, text.length, '.', &value) && value >= 1 &&
                   value <= most && value == floor(value)
               ? (size_t)value
               : 0;
}

/* Reads a number with its unit. Other text behind the number belongs to the unit, which is then
 * unknown. */
static wsxm_quantity read_quantity(text_span header, const char *name)
{
    wsxm_quantity q = {.value = (double)NAN};
    text_span text;
    if (!find_value(header, name, &text))
        return q;
    const char *const blank = memchr(text.text, ' ', text.length);
    const size_t n = blank != NULL ? (size_t)(blank - text.text) : text.length;
    if (!wt_number_parse(text.text, n, '.', &q.value) || !(q.value > 0))
        q.value = (double)NAN;
    if (n < text.length)
        copy_latin1(q.unit, sizeof q.unit, (text_span){blank + 1, text.length - n - 1});
    return q;
}

/* Without a type the samples are 16-bit integers, as older versions wrote them. */
static bool read_type(text_span header, sample_type *type)
{
    static const struct {
        const char *name;
        sample_type type;
    } types[] = {{"short", SAMPLE_INT16},
                 {"integer", SAMPLE_INT32},
                 {"float", SAMPLE_FLOAT32},
                 {"double", SAMPLE_FLOAT64}};
    text_span text;
    *type = SAMPLE_INT16;
    if (!find_value(header, "Image Data Type", &text))
        return true;
    for (size_t i = 0; i < COUNT_OF(types); i++)
        if (strlen(types[i].name) == text.length &&
            memcmp(types[i].name, text.text, text.length) == 0) {
            *type = types[i].type;
            return true;
        }
    return false;
}

static wt_status read_wsxm_header(wt_input *input, wsxm_header *h, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    bool whole = false;
    text_span channel;
    *h = (wsxm_header){.size = 0};
    const wt_status status = wt_input_peek(input, HEADER_MAX, &bytes, &length, &whole, err);
    if (status != WT_OK)
        return status;
    text_span header = {(const char *)bytes, length};
    h->size = read_count(header, "Image header size");
    if (h->size == 0 || h->size > length)
        return images_fail_header(err, "the header has no end",
                                  "\"Image header size\" within the file");
    header.length = h->size;
    h->n_columns = read_count(header, "Number of columns");
    h->n_rows = read_count(header, "Number of rows");
    if (h->n_columns == 0 || h->n_rows == 0)
        return images_fail_header(err, "the size of the image is missing",
                                  "\"Number of columns\" and \"Number of rows\", integers");
    if (!read_type(header, &h->type))
        return images_fail_header(err, "the type of the samples is unknown",
                                  "\"Image Data Type\": short, integer, float or double");
    h->width = read_quantity(header, "X Amplitude");
    h->height = read_quantity(header, "Y Amplitude");
    h->range = read_quantity(header, "Z Amplitude");
    if (find_value(header, "Acquisition channel", &channel))
        copy_latin1(h->channel, sizeof h->channel, channel);
    return WT_OK;
}

/* Returns a lateral size [m]; NaN without a unit of length. */
static double lateral_size(const wsxm_quantity *q)
{
    double factor = 1, offset = 0;
    return wt_unit_to_si(q->unit, WT_Q_LENGTH, &factor, &offset, NULL) == WT_OK ? factor * q->value
                                                                                : (double)NAN;
}

/* Scales the samples to the range that the header states. Without it the unit is unknown. */
static void scale_heights(const wsxm_header *h, double factor, wt_image *image, const char *file,
                          wt_log *log)
{
    const size_t n = image->n_columns * image->n_rows;
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (isinf(image->values[i])) /* no height; it would make the range infinite */
            image->values[i] = (double)NAN;
        low = fmin(low, image->values[i]);
        high = fmax(high, image->values[i]);
    }
    if (isnan(h->range.value)) {
        snprintf(image->unit, sizeof image->unit, "1");
        wt_log_add(log, WT_WARNING, file, image->name,
                   "the header has no \"Z Amplitude\": the scale of the heights is unknown");
        return;
    }
    const double scale = high > low ? factor * h->range.value / (high - low) : 0;
    for (size_t i = 0; i < n; i++)
        image->values[i] *= scale;
}

static wt_status wsxm_images(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err)
{
    wsxm_header h;
    image_list list = {NULL, 0};
    double factor = 1;
    (void)self;
    (void)options;
    wt_status status = read_wsxm_header(input, &h, err);
    if (status == WT_OK) {
        const image_raster raster = {.from = h.size, .type = h.type, .is_from_right = true};
        wt_image head = {.n_columns = h.n_columns, .n_rows = h.n_rows};
        images_set_units(&head, "m", h.range.unit, lateral_size(&h.width), lateral_size(&h.height),
                         &factor);
        images_set_name(&head, h.channel[0] != '\0' ? h.channel : "image");
        status = images_add_raster(&list, input, &head, &raster, 1, err);
    }
    if (status == WT_OK)
        scale_heights(&h, factor, &list.images[0], wt_input_name(input), log);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

/* Force curves of WSxM have the same first line. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(PEEK_BEGINS(peek, FIRST_LINE) && PEEK_CONTAINS(peek, SECOND_LINE),
                              90);
}

const file_reader reader_wsxm = {
    .info = {.id = "wsxm",
             .title = "WSxM height maps (.stp, .top)",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence = "a measured file of 16-bit samples, whose numbers other programs agree on",
             .version = "1"},
    .detect = detect,
    .read_images = wsxm_images,
    .describe = images_describe,
};
