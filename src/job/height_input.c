/* Selects the height image of a file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/height_input.h"

#include <stdlib.h>
#include <string.h>

/* True for a signal of the cantilever, which may also be in metres. */
static bool is_cantilever_signal(const wt_image *image)
{
    return strncmp(image->name, "Deflection", strlen("Deflection")) == 0 ||
           strncmp(image->name, "Amplitude", strlen("Amplitude")) == 0;
}

static bool has_heights(const wt_image *image, const char *name, bool profiles)
{
    const bool area = image->n_rows > 1 && image->height > 0;
    const bool profile = profiles && image->n_rows == 1 && strcmp(image->x_unit, "m") == 0;
    return strcmp(image->unit, "m") == 0 && image->n_columns > 1 && image->width > 0 &&
           (area || profile) &&
           (name == NULL ? !is_cantilever_signal(image) : strstr(image->name, name) != NULL);
}

wt_status flow_heights_read(flow_file *file, const char *name, bool profiles, const char *role,
                            const wt_job *work, wt_image *image, wt_error *err)
{
    const wt_read_options *read = &file->set->read;
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0, chosen = SIZE_MAX;
    wt_status status = flow_open(work, file, role, WT_KIND_IMAGE, &input, err);
    if (status == WT_OK)
        status = wt_images_read(work->formats, input, read, work->log, &images, &n, err);
    for (size_t i = 0; i < n; i++) {
        if (chosen == SIZE_MAX && has_heights(&images[i], name, profiles)) {
            chosen = i;
            *image = images[i];
        } else {
            wt_image_clear(&images[i]);
        }
    }
    free(images);
    wt_input_close(input);
    if (status == WT_OK && chosen == SIZE_MAX) {
        status = wt_fail(err, WT_E_NOT_FOUND, "no image of heights%s%s in the file",
                         name != NULL ? " called " : "", name != NULL ? name : "");
        wt_error_file(err, file->name);
        wt_error_expected(err, "%slines of heights in metres, over an area in metres",
                          profiles ? "one or more " : "two or more ");
        wt_error_found(err, "images: %zu; `weartrack info FILE` shows them", n);
    }
    return status;
}
