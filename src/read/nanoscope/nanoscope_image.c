/* Reads the images of a NanoScope file. Lines run from the bottom upwards. The full range of the
 * 16-bit or 32-bit counts is the value of "Z scale" in volts of a soft scale.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nanoscope/nanoscope.h"

#include "core/base/number.h"
#include "read/bytes/bytes.h"
#include "read/images.h"

#include <math.h>
#include <string.h>

#define SECTION_IMAGE "Ciao image list"

static wt_status fail_image(wt_error *err, const char *message, const char *expected)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "\\*" SECTION_IMAGE);
    wt_error_expected(err, "%s", expected);
    return WT_E_CORRUPT;
}

/* Parses a scan size such as "2 2 ~m" or "500 nm" [m]; NaN if it is not understood. */
static void parse_scan_size(const char *text, double size[2])
{
    double factor = 1e-6, offset = 0;
    size_t n = 0;
    size[0] = size[1] = (double)NAN;
    for (int i = 0; text != NULL && i < 2; i++) {
        text += strspn(text, " ");
        n = number_prefix_length(text, strlen(text), '.');
        if (n == 0 || !wt_number_parse(text, n, '.', &size[i]))
            break;
        text += n;
    }
    if (text == NULL || isnan(size[0]))
        return;
    text += strspn(text, " ");
    size[1] = isnan(size[1]) ? size[0] : size[1];
    if (strcmp(text, "~m") != 0 &&
        wt_unit_to_si(text, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK)
        factor = (double)NAN;
    size[0] *= factor;
    size[1] *= factor;
}

static size_t section_integer(const nanoscope_header *h, size_t section, const char *key)
{
    const double value = nanoscope_number(h, section, key);
    return value >= 1 && value <= 1e15 ? (size_t)value : 0;
}

/* Returns the full scale: metres for a height, volts for any other channel. */
static double read_value_scale(const nanoscope_header *h, size_t section, wt_image *head)
{
    const char *data = nanoscope_get(h, section, "Image Data");
    const char *open = data != NULL ? strchr(data, '"') : NULL;
    const char *close = open != NULL ? strchr(open + 1, '"') : NULL;
    const nanoscope_value scale = nanoscope_parse_value(nanoscope_get(h, section, "Z scale"));
    const double soft = nanoscope_soft_scale(h, scale.soft);
    snprintf(head->name, sizeof head->name, "%.*s", close != NULL ? (int)(close - open - 1) : 0,
             close != NULL ? open + 1 : "");
    const char *line = nanoscope_get(h, section, "Line Direction");
    const size_t n = strlen(head->name);
    if (line != NULL)
        snprintf(head->name + n, sizeof head->name - n, ", %s", line);
    const bool height =
        strncmp(head->name, "Height", 6) == 0 || strncmp(head->name, "ZSensor", 7) == 0;
    snprintf(head->unit, sizeof head->unit, "%s", height && soft > 0 ? "m" : "V");
    return height && soft > 0 ? scale.value * soft : scale.value;
}

static wt_status read_image_block(const nanoscope_header *h, size_t section, input_window *w,
                                  image_list *list, wt_error *err)
{
    wt_image head = {.n_columns = section_integer(h, section, "Samps/line"),
                     .n_rows = section_integer(h, section, "Number of lines"),
                     .x_unit = "m"};
    const size_t offset = section_integer(h, section, "Data offset"),
                 bytes = section_integer(h, section, "Data length");
    const char *text = nanoscope_get(h, section, "Scan Size");
    double size[2], *values = NULL;
    const unsigned char *data = NULL;
    if (head.n_columns == 0 || head.n_rows == 0 || offset == 0 || bytes == 0)
        return fail_image(err, "the block of an image is not described",
                          "Data offset, Data length, Samps/line and Number of lines");
    const size_t width = bytes / head.n_columns / head.n_rows;
    if ((width != 2 && width != 4) || bytes != width * head.n_columns * head.n_rows)
        return fail_image(err, "the size of the block contradicts the pixels",
                          "2 or 4 bytes for each of Samps/line x Number of lines");
    if (offset > w->size || bytes > w->size - offset)
        return fail_image(err, "the end of the file is missing", "all of the image");
    parse_scan_size(text != NULL
                        ? text
                        : nanoscope_get(h, nanoscope_section(h, "Ciao scan list", 0), "Scan Size"),
                    size);
    images_set_size(&head, size[0], size[1]);
    const double scale = ldexp(read_value_scale(h, section, &head), width == 2 ? -16 : -32);
    wt_status status = images_add(list, &head, &values, err);
    if (status == WT_OK)
        status = window_bytes(w, offset, bytes, &data, err);
    const size_t n = head.n_columns * head.n_rows;
    if (status == WT_OK)
        samples_decode(width == 2 ? SAMPLE_INT16 : SAMPLE_INT32, false, data, n, scale, 0, values);
    for (size_t i = 0; status == WT_OK && i < n; i++) /* the lowest count means not measured */
        if (width == 2 ? le16(data + 2 * i) == 0x8000u : le32(data + 4 * i) == 0x80000000u)
            values[i] = (double)NAN;
    return status;
}

wt_status nanoscope_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_image **images, size_t *n_images, wt_error *err)
{
    nanoscope_header header = {.text = NULL};
    input_window window = {.input = NULL};
    image_list list = {NULL, 0};
    const unsigned char *bytes = NULL;
    size_t n = 0;
    bool all = false;
    (void)self;
    (void)options;
    wt_status status = wt_input_peek(input, NANOSCOPE_HEADER_MAX, &bytes, &n, &all, err);
    if (status == WT_OK && !nanoscope_is_header(bytes, n))
        status = fail_image(err, "damaged header", "\\*File list or \\*Force file list");
    if (status == WT_OK)
        status = nanoscope_header_read(bytes, n, &header, err);
    if (status == WT_OK)
        status = window_open(&window, input, err);
    for (size_t i = 0; status == WT_OK; i++) {
        const size_t section = nanoscope_section(&header, SECTION_IMAGE, i);
        if (section == SIZE_MAX)
            break;
        status = read_image_block(&header, section, &window, &list, err);
    }
    window_close(&window);
    nanoscope_header_clear(&header);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}
