/* The images of a spot: which of a file, and places side by side on it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/spot/spot.h"
#include "flow/work/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is in metres, but of the lever. */
static bool is_of_lever(const wt_image *image)
{
    return strncmp(image->name, "Deflection", strlen("Deflection")) == 0 ||
           strncmp(image->name, "Amplitude", strlen("Amplitude")) == 0;
}

static bool has_heights(const wt_image *image, const char *name)
{
    return strcmp(image->unit, "m") == 0 && image->n_rows > 1 && image->n_columns > 1 &&
           image->width > 0 && image->height > 0 &&
           (name == NULL ? !is_of_lever(image) : strstr(image->name, name) != NULL);
}

wt_status spot_image_read(const wt_spot_job *job, const char *path, const char *role,
                          const wt_job *work, wt_image *image, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    flow_file file = {.path = path, .name = path, .set = &set};
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0, chosen = SIZE_MAX;
    wt_status status = flow_open(work, &file, role, WT_KIND_IMAGE, &input, err);
    if (status == WT_OK)
        status = wt_images_read(work->formats, input, &job->read, work->log, &images, &n, err);
    for (size_t i = 0; i < n; i++) {
        if (chosen == SIZE_MAX && has_heights(&images[i], job->image)) {
            chosen = i;
            *image = images[i];
        } else {
            wt_image_clear(&images[i]);
        }
    }
    free(images);
    wt_input_close(input);
    if (status == WT_OK && chosen == SIZE_MAX) {
        status =
            wt_fail(err, WT_E_NOT_FOUND, "no image of heights%s%s in the file",
                    job->image != NULL ? " called " : "", job->image != NULL ? job->image : "");
        wt_error_file(err, path);
        wt_error_expected(err, "two or more lines of heights in metres, over an area in metres");
        wt_error_found(err, "images: %zu; `weartrack info FILE` shows them", n);
    }
    return status;
}

spot_places spot_places_lay(const wt_height_map *f, double radius)
{
    const double width = (double)(f->nx - 1) * f->dx, height = (double)(f->ny - 1) * f->dy;
    return (spot_places){(size_t)fmax(0, floor(width / (2 * radius))),
                         (size_t)fmax(0, floor(height / (2 * radius))), radius};
}
