/* The list of images that a reader makes of a file. Row 0 is the bottom line; width and height go
 * from the middle of the first pixel to that of the last one.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_IMAGES_H
#define WT_READ_IMAGES_H

#include "read/bytes/samples.h"
#include "read/metadata.h"
#include "weartrack/read.h"

typedef struct image_list {
    wt_image *images;
    size_t n;
} image_list;

/* Adds an image with the name, unit, pixels and size of `head`; its values are for the caller to
 * fill. WT_E_CORRUPT: no pixels, or too many for any image. */
wt_status images_add(image_list *list, const wt_image *head, double **values, wt_error *err);
/* The size of an area of that many pixels side by side. */
void images_set_size(wt_image *head, double width, double height);
/* The area of that many pixels side by side and the unit of the values as texts say: SI units; what
 * is no length keeps its unit, and without a unit or a size the pixels have no size. *factor makes
 * the values SI. */
void images_set_units(wt_image *head, const char *unit_xy, const char *unit_z, double width,
                      double height, double *factor);
/* Cut where it is too long, but not within a character. */
void images_set_name(wt_image *head, const char *name);
void images_free(wt_image **images, size_t *n);
/* Hands the list on if `status` is good, else clears it. WT_E_EMPTY if there is no image. Pixels
 * that are missing go to the log; a size that is none is NaN. */
wt_status images_end(image_list *list, wt_status status, const char *file, wt_log *log,
                     wt_image **images, size_t *n, wt_error *err);
/* What the user says of images whose file does not: the size of their pixels, the unit of heights.
 * A size that nobody knows is warned of, and heights that are spikes. */
wt_status images_given(wt_image *images, size_t n, const wt_read_options *options, const char *file,
                       wt_log *log, wt_error *err);
/* Warns of single heights that make most of the slopes of an image of heights. */
void images_warn_of_spikes(const wt_image *image, const char *file, wt_log *log);
/* Adds what `info` shows of the images of a file, behind what it shows of its curves, which ended
 * with `curves` and `no_curves`: no curves are no failure beside an image. */
struct file_reader;
wt_status images_facts(const struct file_reader *reader, wt_input *input,
                       const wt_read_options *options, wt_log *log, table_writer *facts,
                       wt_status curves, const wt_error *no_curves);
/* The same of a reader of images alone. */
wt_status images_describe(const struct file_reader *reader, wt_input *input,
                          const wt_read_options *options, wt_log *log, table_writer *facts);

#endif
