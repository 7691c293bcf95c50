/* Reads NanoScope files: descriptor, detection, and the metadata for `info`.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/nanoscope/nanoscope.h"
#include "core/base/number.h"
#include "core/table/registry.h"
#include "read/bytes/bytes.h"
#include "read/header_values.h"
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
    const char *const full = nanoscope_get(h, section, "Z scale");
    const bool degrees = strncmp(head->name, "Phase", 5) == 0 && full != NULL && full[0] != '\0' &&
                         full[strlen(full) - 1] != 'V'; /* such as "180.0 deg" */
    snprintf(head->unit, sizeof head->unit, "%s", height && soft > 0 ? "m" : degrees ? "deg" : "V");
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
        return fail_image(err, "the file is cut off", "all of the image");
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

/* Reads all images of measured values, of an image file or of a force volume. */
static wt_status nanoscope_images(const file_reader *self, wt_input *input,
                                  const wt_read_options *options, wt_log *log, wt_image **images,
                                  size_t *n_images, wt_error *err)
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
    nanoscope_check_calibration(&header, wt_input_name(input), log);
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

typedef struct nanoscope_source {
    wt_force_source base;
    nanoscope_file file;
    size_t curve;
    size_t from; /* first sample of the current segment */
} nanoscope_source;

static const double pi = 3.14159265358979323846;

/* The ramp is a computed channel; it is not stored. */
static const char ramp_name[] = "Ramp";

/* Returns the metadata of segment `s` (0 approach, 1 hold, 2 retract); the signals point to the
 * file. */
static force_metadata nanoscope_metadata(const nanoscope_file *f, size_t s)
{
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_RETRACT};
    const size_t points[] = {f->n_in, f->n_hold, f->n_out};
    const double times[] = {f->time_in, f->time_hold, f->time_out};
    const double velocities[] = {f->velocity_in, (double)NAN, f->velocity_out};
    force_metadata metadata = {.kind = kinds[s],
                               .index = s == 2 && f->n_hold == 0 ? 1 : s,
                               .n_points = points[s],
                               .duration = times[s],
                               .velocity = velocities[s],
                               .setpoint = s == 0 ? f->trigger : (double)NAN,
                               .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
                               .cantilever = f->cantilever,
                               .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE,
                                          WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE},
                               .n_offers = 6};
    for (size_t i = 0; i < s; i++)
        metadata.start += points[i] > 0 ? times[i] : 0;
    if (isfinite(f->ramp))
        force_add_signal(&metadata, (force_signal){.quantity = WT_Q_HEIGHT,
                                                   .name = ramp_name,
                                                   .unit = "m",
                                                   .to_si = {1, 0},
                                                   .channel = ramp_name});
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const bool voltage = c->quantity == WT_Q_DEFLECTION_VOLTAGE;
        if (c->quantity != WT_Q_NONE)
            force_add_signal(&metadata, (force_signal){.quantity = c->quantity,
                                                       .name = c->name,
                                                       .unit = voltage ? "V" : "m",
                                                       .to_si = {c->scale, 0},
                                                       .channel = c});
    }
    return metadata;
}

/* Returns the piezo height of sample i in temporal order: a linear ramp from the turning point, or
 * a sinusoid. */
static double ramp_height(const nanoscope_file *f, size_t i)
{
    const double n = (double)(f->n_in + f->n_out);
    if (f->sinusoid)
        return f->ramp / 2 * (1 + cos(2 * pi * (double)i / n));
    if (i < f->n_in)
        return f->ramp * (double)(f->n_in - 1 - i) / (double)(f->half > 0 ? f->half : f->n_in);
    const size_t out = i - f->n_in;
    return out < f->n_hold
               ? 0
               : f->ramp * (double)(out - f->n_hold) / (double)(f->half > 0 ? f->half : f->n_out);
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const nanoscope_source *source = (const nanoscope_source *)base;
    const nanoscope_file *f = &source->file;
    const bool is_ramp = signal->channel == ramp_name;
    const unsigned char *stored = NULL;
    const wt_status status =
        is_ramp ? WT_OK : nanoscope_read_curve(f, signal->channel, source->curve, &stored, err);
    if (status != WT_OK)
        return status;
    /* these signals have no offset */
    for (size_t i = 0; i < n; i++) {
        const size_t at = source->from + i;
        values[i] =
            scaling.multiplier *
            (is_ramp ? ramp_height(f, at) : nanoscope_sample(f, signal->channel, stored, at));
    }
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    nanoscope_source *source = (nanoscope_source *)base;
    const nanoscope_file *f = &source->file;
    wt_status status = WT_OK;
    if (source->curve == f->n_curves)
        return WT_END;
    curve->index = source->curve;
    if (force_set_grid_position(f->columns, f->rows, false, source->curve, curve)) {
        curve->x = f->pitch * (double)curve->grid_x;
        curve->y = f->pitch * (double)curve->grid_y;
    }
    source->from = 0;
    for (size_t s = 0; s < 3 && status == WT_OK; s++) {
        const force_metadata metadata = nanoscope_metadata(f, s);
        if (force_is_segment_requested(base, metadata.kind))
            status = force_add_segment(base, &metadata, curve, err);
        source->from += metadata.n_points;
    }
    source->curve++;
    return status;
}

static void close_source(wt_force_source *base)
{
    nanoscope_file_close(&((nanoscope_source *)base)->file);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    nanoscope_file *f = &((nanoscope_source *)base)->file;
    (void)self;
    wt_status status = nanoscope_file_open(input, base->log, f, err);
    if (status == WT_OK && f->sinusoid)
        wt_log_add(base->log, WT_NOTE, base->name, NULL,
                   "PeakForce captures were not verified on a genuine file: compare one with "
                   "the instrument's own software");
    base->n_curves = f->n_curves;
    base->grid_columns = f->columns;
    base->grid_rows = f->rows;
    return status;
}

static const force_stream nanoscope_force = {.size = sizeof(nanoscope_source),
                                             .open = open_source,
                                             .next = next_curve,
                                             .decode = decode,
                                             .close = close_source};

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(nanoscope_is_header(peek->bytes, peek->length), 95);
}

static void add_identity(const nanoscope_file *f, table_writer *metadata)
{
    static const struct {
        const char *item, *section, *key;
    } known[] = {{"software version", "Force file list", "Version"},
                 {"date", "Force file list", "Date"},
                 {"instrument", "Equipment list", "Description"},
                 {"operating mode", "Ciao scan list", "Operating mode"},
                 {"trigger mode", "Ciao force list", "Trigger mode"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        metadata_add_text(metadata, known[i].item, known[i].key,
                          nanoscope_get(&f->header,
                                        nanoscope_section(&f->header, known[i].section, 0),
                                        known[i].key));
}

static void add_curves(const nanoscope_file *f, const wt_read_options *options,
                       table_writer *metadata)
{
    const force_metadata read = nanoscope_metadata(f, 0);
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "Data length", "%zu", f->n_curves);
    if (f->n_curves < f->n_planned)
        metadata_add(metadata, "curves planned", "", "Data length", "%zu", f->n_planned);
    if (f->columns > 0)
        metadata_add(metadata, "grid", "", "force/line", "%ld x %ld", f->columns, f->rows);
    for (size_t s = 0; s < 3; s++) {
        char item[32];
        const force_metadata segment = nanoscope_metadata(f, s);
        snprintf(item, sizeof item, "segment %zu", segment.index);
        if (segment.n_points > 0)
            metadata_add(metadata, item, "", "Samps/line", "%s, %zu points",
                         wt_segment_kind_name(segment.kind), segment.n_points);
    }
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const wt_quantity q = force_channel_quantity(&read, options, c);
        metadata_add(metadata, c->name, "", "Image Data", "%s, %u bits%s",
                     q == WT_Q_NONE ? "not read" : wt_quantity_id(q), 8 * c->width,
                     f->scaled ? ", 256 times the counts of the header" : "");
    }
    metadata_add_number(metadata, f->sinusoid ? "oscillation of the piezo" : "ramp size", f->ramp,
                        "m", f->sinusoid ? "Peak Force Amplitude" : "Ramp size, Sens. Zsens");
    force_describe_calibration(&read, options, "Spring Constant", "Sens. DeflSens", metadata);
    if (f->sinusoid)
        metadata_add(metadata, "odd", "", "",
                     "PeakForce captures were not verified on a genuine file");
}

static wt_status describe_curves(wt_input *input, const wt_read_options *options, wt_log *log,
                                 table_writer *metadata, wt_error *err)
{
    nanoscope_file file;
    const wt_status status = nanoscope_file_open(input, log, &file, err);
    if (status == WT_OK) {
        add_identity(&file, metadata);
        add_curves(&file, options, metadata);
    }
    nanoscope_file_close(&file);
    return status;
}

const file_reader reader_nanoscope = {
    .info = {.id = "nanoscope",
             .title = "NanoScope force curves, force volumes, PeakForce captures and images of "
                      "Bruker and Veeco (.spm, .pfc, .000)",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE,
             .verified = true,
             .evidence =
                 "measured single curves and a force volume of software 8.15 and 9.2; "
                 "the heights of images (tried on those of the volume) were not compared with "
                 "another program; PeakForce captures, hold segments, force volumes and "
                 "images of 32 bits: not verified on a genuine file",
             .version = "1"},
    .detect = detect,
    .force = &nanoscope_force,
    .read_images = nanoscope_images,
    .describe_curves = describe_curves,
    .describe = images_describe,
};
