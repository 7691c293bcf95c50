/* Implements the list of images that a reader creates from a file. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "read/images.h"
#include "core/base/memory.h"
#include "core/base/text.h"
#include "core/table/registry.h"
#include "read/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Minimum height of a spike above all its neighbours, in rms steps between points. Noise and edges
 * stay below it. */
static const double spike_steps = 4.0;

/* Minimum share of the spikes in the mean square step. Below it they do not dominate the slopes. */
static const double spike_fraction_min = 0.5;

/* Minimum number of points for a meaningful rms step. */
enum { MIN_POINTS = 64 };

typedef struct neighbour_range {
    double low, high;
    size_t n; /* number of valid neighbours */
} neighbour_range;

static void add_neighbour(neighbour_range *all, double height)
{
    if (isnan(height))
        return;
    all->low = fmin(all->low, height);
    all->high = fmax(all->high, height);
    all->n++;
}

static neighbour_range find_neighbours(const wt_image *image, size_t column, size_t row)
{
    const double *const at = image->values + row * image->n_columns + column;
    neighbour_range all = {HUGE_VAL, -HUGE_VAL, 0};
    if (column > 0)
        add_neighbour(&all, at[-1]);
    if (column + 1 < image->n_columns)
        add_neighbour(&all, at[1]);
    if (row > 0)
        add_neighbour(&all, *(at - image->n_columns));
    if (row + 1 < image->n_rows)
        add_neighbour(&all, at[image->n_columns]);
    return all;
}

/* Returns the distance of a height beyond the range of its neighbours. It is 0 within the range or
 * with less than two neighbours. */
static double height_excess(double height, const neighbour_range *all)
{
    return all->n < 2 || isnan(height) ? 0 : fmax(0, fmax(height - all->high, all->low - height));
}

/* Returns the sum of the squared steps between adjacent points, in units of `scale`, which prevents
 * overflow. *n is the number of steps. */
static double sum_squared_steps(const wt_image *image, double scale, size_t *n)
{
    double sum = 0;
    *n = 0;
    for (size_t row = 0; row < image->n_rows; row++)
        for (size_t column = 0; column < image->n_columns; column++) {
            const double *const at = image->values + row * image->n_columns + column;
            const double right = column + 1 < image->n_columns ? at[1] : (double)NAN;
            const double above = row + 1 < image->n_rows ? at[image->n_columns] : (double)NAN;
            const double steps[] = {right / scale - *at / scale, above / scale - *at / scale};
            for (size_t i = 0; i < 2; i++) {
                sum += isnan(steps[i]) ? 0 : steps[i] * steps[i];
                *n += isnan(steps[i]) ? 0 : 1;
            }
        }
    return sum;
}

static double largest_height(const wt_image *image)
{
    double largest = 0;
    for (size_t i = 0; i < image->n_columns * image->n_rows; i++)
        largest = fmax(largest, fabs(image->values[i])); /* fmax ignores a NaN */
    return largest;
}

/* Warns of single heights that dominate the slopes of a height image. */
static void images_check_spikes(const wt_image *image, const char *file, wt_log *log)
{
    const size_t n = image->n_columns * image->n_rows;
    const double scale = largest_height(image);
    size_t n_steps = 0, n_spikes = 0, at = 0;
    double spike_sum = 0, largest = 0;
    if (n < MIN_POINTS || !(scale > 0))
        return;
    const double sum = sum_squared_steps(image, scale, &n_steps);
    const double least = spike_steps * scale * sqrt(sum / (double)n_steps);
    for (size_t i = 0; i < n; i++) {
        const neighbour_range all =
            find_neighbours(image, i % image->n_columns, i / image->n_columns);
        const double excess = height_excess(image->values[i], &all);
        if (!(excess > least))
            continue;
        n_spikes++;
        spike_sum += (double)all.n * (excess / scale) * (excess / scale);
        at = excess > largest ? i : at;
        largest = fmax(largest, excess);
    }
    if (n_spikes == 0 || !(spike_sum > spike_fraction_min * sum))
        return;
    char excess_text[32];
    wt_format_si(largest, "m", 3, excess_text, sizeof excess_text);
    wt_log_add(log, WT_WARNING, file, image->name,
               "%zu of %zu heights stand out alone, the farthest, in column %zu and row %zu from "
               "below, by %s, and make most of the slopes: spikes, or a damaged file; take them "
               "out before",
               n_spikes, n, at % image->n_columns, at / image->n_columns, excess_text);
}

#define MAX_PIXELS ((size_t)1 << 28)

wt_status images_add(image_list *list, const wt_image *head, double **values, wt_error *err)
{
    if (head->n_columns == 0 || head->n_rows == 0 || head->n_columns > MAX_PIXELS / head->n_rows) {
        wt_fail(err, WT_E_CORRUPT, "impossible size of an image");
        wt_error_expected(err, "1 to %zu pixels", MAX_PIXELS);
        wt_error_found(err, "%zu x %zu", head->n_columns, head->n_rows);
        return WT_E_CORRUPT;
    }
    list->images = wt_realloc(list->images, list->n + 1, sizeof *list->images);
    *values = try_alloc(head->n_columns * head->n_rows, sizeof **values);
    if (*values == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for an image of %zu x %zu points",
                       head->n_columns, head->n_rows);
    list->images[list->n] = *head;
    list->images[list->n++].values = *values;
    return WT_OK;
}

wt_status images_fail_header(wt_error *err, const char *message, const char *expected)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "header of the file");
    wt_error_expected(err, "%s", expected);
    return WT_E_CORRUPT;
}

wt_status images_add_raster(image_list *list, wt_input *input, const wt_image *head,
                            const image_raster *raster, double factor, wt_error *err)
{
    const size_t n = head->n_columns, n_rows = head->n_rows, size = sample_width(raster->type) * n;
    input_window window = {.input = NULL};
    double *values = NULL;
    wt_status status = window_open(&window, input, err);
    if (status == WT_OK &&
        (raster->from > window.size || (window.size - raster->from) / size < n_rows ||
         (raster->is_last && window.size - raster->from != size * n_rows))) {
        status = images_fail_header(err, "the size of the file contradicts its header",
                                    "a sample for each of the columns x rows");
        wt_error_found(err, "%zu x %zu pixels in %zu bytes", n, n_rows, window.size);
    }
    if (status == WT_OK)
        status = images_add(list, head, &values, err);
    for (size_t row = 0; status == WT_OK && row < n_rows; row++) {
        const unsigned char *bytes = NULL;
        double *const line = values + n * (raster->is_from_top ? n_rows - 1 - row : row);
        status = window_bytes(&window, raster->from + size * row, size, &bytes, err);
        if (status != WT_OK)
            break;
        samples_decode(raster->type, false, bytes, n, factor, 0, line);
        for (size_t i = 0; raster->is_from_right && i < n / 2; i++) {
            const double left = line[i];
            line[i] = line[n - 1 - i];
            line[n - 1 - i] = left;
        }
    }
    window_close(&window);
    return status;
}

void images_set_size(wt_image *head, double width, double height)
{
    head->width = width * (double)(head->n_columns - 1) / (double)head->n_columns;
    head->height = height * (double)(head->n_rows - 1) / (double)head->n_rows;
}

void images_set_units(wt_image *head, const char *unit_xy, const char *unit_z, double width,
                      double height, double *factor)
{
    double lateral = 1, offset = 0;
    snprintf(head->x_unit, sizeof head->x_unit, "m");
    if (unit_xy[0] == '\0' || wt_unit_to_si(unit_xy, WT_Q_LENGTH, &lateral, &offset, NULL) != WT_OK)
        lateral = (double)NAN;
    images_set_size(head, lateral * (width > 0 ? width : (double)NAN),
                    lateral * (height > 0 ? height : (double)NAN));
    const bool length =
        unit_z[0] != '\0' && wt_unit_to_si(unit_z, WT_Q_LENGTH, factor, &offset, NULL) == WT_OK;
    if (!length)
        *factor = 1;
    snprintf(head->unit, sizeof head->unit, "%s", length ? "m" : unit_z[0] != '\0' ? unit_z : "1");
}

void images_set_name(wt_image *head, const char *name)
{
    snprintf(head->name, sizeof head->name, "%s", name);
    utf8_sanitize(head->name);
}

static void mark_missing_pixels(wt_image *image, const char *file, wt_log *log)
{
    const size_t n = image->n_columns * image->n_rows;
    const size_t missing = samples_mark_missing(image->values, n);
    if (missing > 0)
        wt_log_add(log, WT_WARNING, file, image->name,
                   "%zu of %zu pixels are not finite numbers and left out", missing, n);
    /* A single line has height 0 and a single column has width 0. */
    if (isinf(image->width) || (!(image->width > 0) && image->n_columns > 1))
        image->width = (double)NAN;
    if (isinf(image->height) || (!(image->height > 0) && image->n_rows > 1))
        image->height = (double)NAN;
    (void)samples_mark_missing(&image->x_min, 1);
    (void)samples_mark_missing(&image->y_min, 1);
}

/* ---- options of the user --------------------------------------------------------------------- */

/* Relative difference above which two pixel sizes are different and not just rounded. */
static const double size_tolerance = 1e-3;

static void apply_pixel_size(wt_image *image, double pixel, const char *file, wt_log *log)
{
    const bool area = strcmp(image->x_unit, "m") == 0 || image->n_rows > 1;
    const double width = pixel * (double)(image->n_columns - 1);
    if (isnan(pixel) || !area)
        return;
    if (fabs(image->width - width) > size_tolerance * width)
        wt_log_add(log, WT_WARNING, file, image->name,
                   "the file gives pixels of another size; that of --pixel-size is taken");
    image->width = width;
    image->height = pixel * (double)(image->n_rows - 1);
    snprintf(image->x_unit, sizeof image->x_unit, "m");
}

static wt_status apply_height_unit(wt_image *image, const char *unit, const char *file, wt_log *log,
                                   wt_error *err)
{
    double factor = 1, offset = 0;
    if (unit == NULL || strcmp(image->unit, "m") == 0)
        return WT_OK;
    const wt_status status = wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, err);
    if (status != WT_OK)
        return status;
    if (strcmp(image->unit, "1") != 0)
        wt_log_add(log, WT_WARNING, file, image->name,
                   "the file gives its values in %s; they are taken as heights in %s", image->unit,
                   unit);
    for (size_t i = 0; i < image->n_columns * image->n_rows; i++)
        image->values[i] *= factor;
    snprintf(image->unit, sizeof image->unit, "m");
    return WT_OK;
}

wt_status images_apply_options(wt_image *images, size_t n, const wt_read_options *options,
                               const char *file, wt_log *log, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        apply_pixel_size(&images[i], options->pixel_size, file, log);
        status = apply_height_unit(&images[i], options->height_unit, file, log, err);
        if (isnan(images[i].width) || isnan(images[i].height))
            wt_log_add(log, WT_WARNING, file, images[i].name,
                       "the size of the image is not known; --pixel-size gives it");
        if (status == WT_OK && strcmp(images[i].unit, "m") == 0)
            images_check_spikes(&images[i], file, log);
    }
    return status;
}

void images_free(wt_image **images, size_t *n)
{
    for (size_t i = 0; i < *n; i++)
        wt_image_clear(&(*images)[i]);
    free(*images);
    *images = NULL;
    *n = 0;
}

wt_status images_finish(image_list *list, wt_status status, const char *file, wt_log *log,
                        wt_image **images, size_t *n, wt_error *err)
{
    for (size_t i = 0; status == WT_OK && i < list->n; i++)
        mark_missing_pixels(&list->images[i], file, log);
    if (status == WT_OK && list->n == 0)
        status = wt_fail(err, WT_E_EMPTY, "the file holds no image");
    if (status == WT_OK) {
        *images = list->images;
        *n = list->n;
    } else {
        images_free(&list->images, &list->n);
    }
    *list = (image_list){NULL, 0};
    return status;
}

wt_status images_add_metadata(const file_reader *reader, wt_input *input,
                              const wt_read_options *options, wt_log *log, table_writer *metadata,
                              wt_status curves, const wt_error *curves_error)
{
    wt_image *images = NULL;
    wt_error images_error = WT_ERROR_INIT;
    size_t n = 0;
    wt_status status = reader->read_images(reader, input, options, log, &images, &n, &images_error);
    if (status == WT_OK)
        status = images_apply_options(images, n, options, wt_input_name(input), log, &images_error);
    for (size_t i = 0; i < n; i++) {
        char item[32], width[32], height[32];
        wt_format_si(images[i].width, "m", 4, width, sizeof width);
        wt_format_si(images[i].height, "m", 4, height, sizeof height);
        snprintf(item, sizeof item, "%s %zu",
                 images[i].n_rows == 1 ? fact_item_text(FACT_PROFILE) : "image", i);
        if (isnan(images[i].width) || isnan(images[i].height))
            metadata_add(metadata, item, images[i].unit, "", "%s, %zu x %zu pixels, size unknown",
                         images[i].name, images[i].n_columns, images[i].n_rows);
        else
            metadata_add(metadata, item, images[i].unit, "", "%s, %zu x %zu pixels, %s x %s",
                         images[i].name, images[i].n_columns, images[i].n_rows, width, height);
        wt_image_clear(&images[i]);
    }
    free(images);
    if (status == WT_E_MEMORY && metadata->err != NULL)
        *metadata->err = images_error;
    if (status == WT_E_MEMORY)
        return status;
    if (curves == WT_OK && status != WT_OK && status != WT_E_EMPTY)
        metadata_add(metadata, "image not read", "", "", "%s", images_error.message);
    if (curves == WT_OK || (curves == WT_E_EMPTY && status == WT_OK))
        return WT_OK;
    /* If both fail, the error of the curves is returned. */
    if (metadata->err != NULL)
        *metadata->err = curves_error == NULL || (curves == WT_E_EMPTY && status != WT_E_EMPTY)
                             ? images_error
                             : *curves_error;
    return curves == WT_E_EMPTY ? status : curves;
}

wt_status images_describe(const file_reader *reader, wt_input *input,
                          const wt_read_options *options, wt_log *log, table_writer *metadata)
{
    wt_error err = WT_ERROR_INIT;
    if (reader->describe_curves == NULL)
        return images_add_metadata(reader, input, options, log, metadata, WT_E_EMPTY, NULL);
    const wt_status status = reader->describe_curves(input, options, log, metadata, &err);
    return images_add_metadata(reader, input, options, log, metadata, status, &err);
}
