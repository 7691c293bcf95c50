/* Declares the list of images that a reader creates from a file.
 *
 * Row 0 is the bottom line. Width and height are the distances between the centres of the first and
 * the last pixel [m]. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_IMAGES_H
#define WT_READ_IMAGES_H

#include "read/bytes/samples.h"
#include "read/header_values.h"
#include "weartrack/read.h"

typedef struct image_list {
    wt_image *images;
    size_t n;
} image_list;

/* Adds an image with the name, unit, pixels and size of `head`. The caller fills *values, row by
 * row. Returns WT_E_CORRUPT for no pixels or too many. */
wt_status images_add(image_list *list, const wt_image *head, double **values, wt_error *err);
/* Samples that stand in the file row by row. */
typedef struct image_raster {
    size_t from; /* offset of the first one */
    sample_type type;
    bool is_last; /* nothing follows them */
    bool is_from_top,
        is_from_right; /* the first row is the top one; a row begins at its right end */
} image_raster;
/* Adds an image whose values are `factor` times the samples of the file. */
wt_status images_add_raster(image_list *list, wt_input *input, const wt_image *head,
                            const image_raster *raster, double factor, wt_error *err);
/* Reports a fault in the header of an image file as WT_E_CORRUPT. */
wt_status images_fail_header(wt_error *err, const char *message, const char *expected);
/* Sets the distances between the outer pixel centres from the width and height of the whole
 * area. */
void images_set_size(wt_image *head, double width, double height);
/* Sets the area and the unit of the values from unit texts, in SI units. A value unit that is no
 * length is kept. Without a unit or a size the image has the size NaN. *factor converts the values
 * to SI units. */
void images_set_units(wt_image *head, const char *unit_xy, const char *unit_z, double width,
                      double height, double *factor);
/* Sets the name. A name that is too long is cut at a whole character. */
void images_set_name(wt_image *head, const char *name);
void images_free(wt_image **images, size_t *n);
/* Transfers the list to the caller on success and frees it on failure. WT_E_EMPTY if there is no
 * image. Missing pixels are logged; an invalid size becomes NaN. */
wt_status images_finish(image_list *list, wt_status status, const char *file, wt_log *log,
                        wt_image **images, size_t *n, wt_error *err);
/* Applies the options of the user to images whose file states no pixel size or height unit. Warns
 * of an unknown size and of spikes. */
wt_status images_apply_options(wt_image *images, size_t n, const wt_read_options *options,
                               const char *file, wt_log *log, wt_error *err);

/* Adds the rows of the images for `info` after those of the force curves, whose status is `curves`
 * and whose error is `curves_error`. A file with images but without curves is no failure. */
struct file_reader;

wt_status images_add_metadata(const struct file_reader *reader, wt_input *input,
                              const wt_read_options *options, wt_log *log, table_writer *metadata,
                              wt_status curves, const wt_error *curves_error);
/* Variant of images_add_metadata for a reader of images, with its describe_curves if it has one. */
wt_status images_describe(const struct file_reader *reader, wt_input *input,
                          const wt_read_options *options, wt_log *log, table_writer *metadata);

/* Reads the images like wt_images_read. With `masks_are_missing` the file is a conversion, and
 * masked points were not measured and become NaN. Otherwise a mask may mark anything. */
wt_status gwy_read(wt_input *input, bool masks_are_missing, wt_log *log, wt_image **images,
                   size_t *n_images, wt_error *err) WT_NODISCARD;

#endif
