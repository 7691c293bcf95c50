/* Reads the channels of a .nid file: positions of the blocks, scaling of the numbers, and images.
 *
 * Value of a sample: Dim2Min + Dim2Range (raw + 2^(bits-1)) / 2^bits. Rows run from the bottom
 * upwards. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "read/bytes/samples.h"
#include "read/images.h"
#include "read/nid/nid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAP_SECTION "DataSet\\SpecInfos\\SpecMapTable"

#define POSITION_SECTION "DataSet\\SpecInfos\\SpecPosTable"

/* The entry Map0 = x0;x1;y0;y1;columns;rows;rotation;placement. */
typedef struct nid_map {
    double x0, x1, y0, y1, rotation;
    long columns, rows;
} nid_map;

static double parse_list_number(const char *list, size_t i)
{
    char item[NID_TEXT];
    return nid_list_item(list, ';', i, item, sizeof item) ? parse_number_or_nan(item) : (double)NAN;
}

static bool read_map(const nid_header *header, nid_map *map)
{
    const char *list = nid_get(header, MAP_SECTION, "Map0");
    if (list == NULL)
        return false;
    double columns = parse_list_number(list, 4), rows = parse_list_number(list, 5);
    if (!(columns >= 1 && columns <= 1e6 && rows >= 1 && rows <= 1e6))
        return false;
    *map = (nid_map){.x0 = parse_list_number(list, 0),
                     .x1 = parse_list_number(list, 1),
                     .y0 = parse_list_number(list, 2),
                     .y1 = parse_list_number(list, 3),
                     .rotation = parse_list_number(list, 6),
                     .columns = lround(columns),
                     .rows = lround(rows)};
    return true;
}

void nid_read_grid(const nid_header *header, long *columns, long *rows)
{
    nid_map map = {.columns = 0};
    (void)read_map(header, &map);
    *columns = map.columns;
    *rows = map.rows;
}

static double interpolate_grid(double first, double last, long i, long n)
{
    return n > 1 ? first + (last - first) * (double)i / (double)(n - 1) : first;
}

static void set_map_position(const nid_map *map, size_t i, const char *name, wt_log *log,
                             wt_force_curve *curve)
{
    if (!force_set_grid_position(map->columns, map->rows, true, i, curve)) {
        wt_log_add(log, WT_WARNING, name, MAP_SECTION,
                   "more curves than places in the map: place unknown");
        return;
    }
    if (map->rotation != 0) {
        wt_log_add(log, WT_WARNING, name, MAP_SECTION,
                   "the map is rotated, its unit is not known: positions left out");
        return;
    }
    curve->x = interpolate_grid(map->x0, map->x1, curve->grid_x, map->columns);
    curve->y = interpolate_grid(map->y0, map->y1, curve->grid_y, map->rows);
}

static double read_axis_factor(const nid_header *header, size_t axis)
{
    char unit[NID_TEXT];
    double factor = 1, offset = 0;
    const char *list = nid_get(header, POSITION_SECTION, "PosUnit");
    if (list == NULL)
        list = nid_get(header, POSITION_SECTION, "PosUnits");
    /* The list has one unit for all axes, or one for each. */
    if (list == NULL || (!nid_list_item(list, ';', axis, unit, sizeof unit) &&
                         !nid_list_item(list, ';', 0, unit, sizeof unit)))
        return (double)NAN;
    if (wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK)
        return (double)NAN;
    return factor;
}

static void set_listed_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                                wt_force_curve *curve)
{
    char key[32], axis[NID_TEXT];
    snprintf(key, sizeof key, "Pos%zu", i);
    const char *list = nid_get(header, POSITION_SECTION, key);
    const char *axes = nid_get(header, POSITION_SECTION, "PosAxis");
    for (size_t a = 0; list != NULL && axes != NULL; a++) {
        if (!nid_list_item(axes, ';', a, axis, sizeof axis))
            break;
        double value = read_axis_factor(header, a) * parse_list_number(list, a);
        if (strcmp(axis, "X") == 0)
            curve->x = value;
        else if (strcmp(axis, "Y") == 0)
            curve->y = value;
    }
    if (isnan(curve->x) || isnan(curve->y))
        wt_log_add(log, WT_WARNING, name, POSITION_SECTION,
                   "no position for a curve that is not in the list");
}

void nid_set_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                      wt_force_curve *curve)
{
    nid_map map;
    if (read_map(header, &map))
        set_map_position(&map, i, name, log, curve);
    else if (nid_get(header, POSITION_SECTION, "Count") != NULL)
        set_listed_position(header, i, name, log, curve);
}

#define MAX_GROUPS 256
#define MAX_SLOTS 256
#define MAX_SIDE ((size_t)1 << 30)

static const char *text_or_empty(const char *text)
{
    return text != NULL ? text : "";
}

static wt_status fail_key(const nid_header *header, const char *section, const char *key,
                          const char *expected, wt_error *err)
{
    const char *found = nid_get(header, section, key);
    wt_fail(err, WT_E_CORRUPT, "%s is missing or not understood", key);
    wt_error_place(err, "[%s]", section);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "%s", found != NULL ? found : "nothing");
    return WT_E_CORRUPT;
}

static wt_status expect_value(const nid_header *header, const char *section, const char *key,
                              const char *value, wt_error *err)
{
    const char *found = nid_get(header, section, key);
    if (found != NULL && strcmp(found, value) == 0)
        return WT_OK;
    return fail_key(header, section, key, value, err);
}

static wt_status read_channel_header(const nid_header *header, nid_channel *c, wt_error *err)
{
    const char *s = c->section;
    size_t bits = 0;
    if (!nid_integer(header, s, "Points", MAX_SIDE, &c->points) || c->points == 0)
        return fail_key(header, s, "Points", "a number of samples", err);
    if (!nid_integer(header, s, "Lines", MAX_SIDE, &c->lines) || c->lines == 0)
        return fail_key(header, s, "Lines", "a number of lines", err);
    if (!nid_integer(header, s, "SaveBits", 32, &bits) || (bits != 16 && bits != 32))
        return fail_key(header, s, "SaveBits", "16 or 32", err);
    c->bits = (unsigned)bits;
    c->minimum = nid_number(header, s, "Dim2Min");
    c->range = nid_number(header, s, "Dim2Range");
    if (isnan(c->minimum) || isnan(c->range))
        return fail_key(header, s, isnan(c->minimum) ? "Dim2Min" : "Dim2Range", "a number", err);
    if (!nid_integer(header, s, "Version", 1000, &c->version))
        return fail_key(header, s, "Version", "an integer", err);
    c->name = text_or_empty(nid_get(header, s, "Dim2Name"));
    c->unit = text_or_empty(nid_get(header, s, "Dim2Unit"));
    wt_status status = expect_value(header, s, "SaveMode", "Binary", err);
    if (status == WT_OK)
        status = expect_value(header, s, "SaveSign", "Signed", err);
    if (status == WT_OK)
        status = expect_value(header, s, "SaveOrder", "Intel", err);
    return status;
}

/* Adds the channel of slot (g, c) if the file contains it, and moves *at past its block. */
static wt_status add_file_channel(nid_file *file, size_t g, size_t c, const char *group_name,
                                  size_t length, size_t *at, wt_error *err)
{
    char key[64];
    snprintf(key, sizeof key, "Gr%zu-Ch%zu", g, c);
    nid_channel channel = {.group = g, .slot = c, .group_name = group_name, .offset = *at};
    channel.section = nid_get(&file->header, "DataSet", key);
    if (channel.section == NULL)
        return WT_OK;
    wt_status status = read_channel_header(&file->header, &channel, err);
    if (status != WT_OK)
        return status;
    size_t width = channel.bits / 8, left = length - *at;
    if (channel.points > left / width || channel.lines > left / width / channel.points) {
        wt_fail(err, WT_E_CORRUPT, "the file is shorter than its blocks");
        wt_error_place(err, "[%s]", channel.section);
        wt_error_expected(err, "%zu x %zu samples of %u bits", channel.points, channel.lines,
                          channel.bits);
        wt_error_found(err, "%zu bytes left", left);
        return WT_E_CORRUPT;
    }
    *at += channel.points * channel.lines * width;
    file->channels = wt_realloc(file->channels, file->n + 1, sizeof *file->channels);
    file->channels[file->n++] = channel;
    return WT_OK;
}

static wt_status find_channels(nid_file *file, size_t length, wt_error *err)
{
    size_t groups = 0, at = file->header.data;
    if (!nid_integer(&file->header, "DataSet", "GroupCount", MAX_GROUPS, &groups))
        return fail_key(&file->header, "DataSet", "GroupCount", "a number up to 256", err);
    for (size_t g = 0; g < groups; g++) {
        char key[64];
        size_t slots = 0;
        snprintf(key, sizeof key, "Gr%zu-Count", g);
        if (!nid_integer(&file->header, "DataSet", key, MAX_SLOTS, &slots))
            return fail_key(&file->header, "DataSet", key, "a number up to 256", err);
        snprintf(key, sizeof key, "Gr%zu-Name", g);
        const char *name = text_or_empty(nid_get(&file->header, "DataSet", key));
        for (size_t c = 0; c < slots; c++) {
            wt_status status = add_file_channel(file, g, c, name, length, &at, err);
            if (status != WT_OK)
                return status;
        }
    }
    if (at != length) {
        wt_fail(err, WT_E_CORRUPT, "the blocks do not end where the file ends");
        wt_error_expected(err, "%zu bytes", at);
        wt_error_found(err, "%zu bytes", length);
        return WT_E_CORRUPT;
    }
    if (file->n == 0)
        return wt_fail(err, WT_E_EMPTY, "the file holds no channel");
    return WT_OK;
}

wt_status nid_file_open(wt_input *input, nid_file *file, wt_error *err)
{
    size_t length = 0;
    *file = (nid_file){.name = wt_input_name(input)};
    wt_status status = nid_header_read(input, &file->header, err);
    if (status == WT_OK)
        status = wt_input_size(input, &length, err);
    if (status == WT_OK)
        status = find_channels(file, length, err);
    if (status == WT_OK)
        status = windows_open(&file->windows, file->n, input, err);
    if (status != WT_OK)
        nid_file_close(file);
    return status;
}

void nid_file_close(nid_file *file)
{
    nid_header_clear(&file->header);
    for (size_t i = 0; file->windows != NULL && i < file->n; i++)
        window_close(&file->windows[i]);
    free(file->windows);
    free(file->channels);
    *file = (nid_file){0};
}

bool nid_is_spectroscopy(const nid_channel *channel)
{
    return strncasecmp(channel->group_name, "Spec ", 5) == 0;
}

wt_status nid_decode(const nid_file *file, const nid_channel *c, size_t line, size_t n,
                     double factor, double *values, wt_error *err)
{
    const sample_type type = c->bits == 16 ? SAMPLE_INT16 : SAMPLE_INT32;
    const size_t width = sample_width(type);
    const unsigned char *bytes = NULL;
    const wt_status status =
        window_bytes(&file->windows[c - file->channels], c->offset + line * c->points * width,
                     n * width, &bytes, err);
    if (status != WT_OK)
        return status;
    const double half = ldexp(1.0, (int)c->bits - 1), whole = ldexp(1.0, (int)c->bits);
    samples_decode(type, false, bytes, n, 1, half, values);
    for (size_t i = 0; i < n; i++)
        values[i] = factor * (c->minimum + c->range * (values[i] / whole));
    return WT_OK;
}

/* Returns the SI unit for an exported one; "" and factor 1 for an unknown unit. */
static const char *nid_si_unit(const char *unit, double *factor)
{
    static const wt_quantity known[] = {WT_Q_LENGTH, WT_Q_DEFLECTION_VOLTAGE, WT_Q_FORCE,
                                        WT_Q_PHASE,  WT_Q_FREQUENCY,          WT_Q_TIME};
    double offset = 0; /* always 0 for these quantities */
    *factor = 1;
    for (size_t i = 0; unit[0] != '\0' && i < sizeof known / sizeof *known; i++)
        if (wt_unit_to_si(unit, known[i], factor, &offset, NULL) == WT_OK)
            return wt_quantity_unit(known[i]);
    *factor = 1;
    return "";
}

/* ---- images ------------------------------------------------------------------------------- */

/* Reads range and beginning of an axis in SI units; an axis with an unknown unit keeps its
 * numbers. */
static void read_image_axis(const nid_header *header, const char *section, int axis, double *range,
                            double *minimum, char *unit, size_t size)
{
    char key[16];
    double factor = 1;
    snprintf(key, sizeof key, "Dim%dUnit", axis);
    const char *si = nid_si_unit(text_or_empty(nid_get(header, section, key)), &factor);
    snprintf(key, sizeof key, "Dim%dRange", axis);
    *range = factor * nid_number(header, section, key);
    snprintf(key, sizeof key, "Dim%dMin", axis);
    *minimum = factor * nid_number(header, section, key);
    if (unit != NULL)
        snprintf(unit, size, "%s", si);
}

/* Counts the lines of constant value in [first, end). They were not measured, since a scan has
 * noise. */
static size_t count_flat_lines(const wt_image *image, size_t first, size_t end)
{
    size_t n = 0;
    for (size_t line = first; line < end; line++) {
        const double *values = image->values + line * image->n_columns;
        size_t i = 1;
        while (i < image->n_columns && values[i] == values[0])
            i++;
        n += i == image->n_columns ? 1 : 0;
    }
    return n;
}

/* Warns if a scan was stopped. CurLine is the line at which the scan ended, in either direction;
 * for a complete scan it is an edge of the image. Constant lines show which lines are missing. */
static void warn_stopped_scan(const nid_file *file, const nid_channel *c, wt_log *log,
                              const wt_image *image)
{
    const double current = nid_number(&file->header, c->section, "CurLine");
    const size_t n = image->n_rows;
    if (!(current >= 0 && current + 1 < (double)n))
        return;
    const size_t at = (size_t)current, above = count_flat_lines(image, at + 1, n),
                 below = count_flat_lines(image, 0, at);
    const size_t missing = above == n - at - 1 ? above : at > 0 && below == at ? below : 0;
    if (missing > 0 && count_flat_lines(image, 0, n) < n)
        wt_log_add(log, WT_WARNING, file->name, c->section,
                   "scan was stopped at line %zu: %zu of %zu lines were not measured", at, missing,
                   n);
}

static wt_status read_image(const nid_file *file, const nid_channel *c, wt_log *log,
                            image_list *list, wt_error *err)
{
    wt_image head = {.n_columns = c->points, .n_rows = c->lines};
    double factor = 1, *values = NULL;
    const char *unit = nid_si_unit(c->unit, &factor);
    if (unit[0] == '\0' && c->unit[0] != '\0') {
        unit = c->unit;
        wt_log_add(log, WT_NOTE, file->name, c->section, "unit %s is kept as it is", c->unit);
    }
    snprintf(head.name, sizeof head.name, "%s: %s", c->group_name, c->name);
    snprintf(head.unit, sizeof head.unit, "%s", unit[0] != '\0' ? unit : "1");
    read_image_axis(&file->header, c->section, 0, &head.width, &head.x_min, head.x_unit,
                    sizeof head.x_unit);
    read_image_axis(&file->header, c->section, 1, &head.height, &head.y_min, NULL, 0);
    wt_status status = images_add(list, &head, &values, err);
    for (size_t line = 0; status == WT_OK && line < c->lines; line++)
        status = nid_decode(file, c, line, c->points, factor, values + line * c->points, err);
    if (status == WT_OK)
        warn_stopped_scan(file, c, log, &list->images[list->n - 1]);
    return status;
}

wt_status nid_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_image **images, size_t *n_images, wt_error *err)
{
    (void)self;
    (void)options;
    nid_file file = {0};
    image_list list = {.n = 0};
    wt_status status = nid_file_open(input, &file, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < file.n && status == WT_OK; i++)
        if (!nid_is_spectroscopy(&file.channels[i]))
            status = read_image(&file, &file.channels[i], log, &list, err);
    status = images_finish(&list, status, file.name, log, images, n_images, err);
    nid_file_close(&file);
    return status;
}
