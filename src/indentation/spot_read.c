/* Selection of the height image in a file, and adjacent positions on it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/spot.h"
#include "job/height_input.h"

#include <math.h>

wt_status spot_image_read(const wt_spot_job *job, const char *path, const char *role,
                          const wt_job *work, wt_image *image, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    flow_file file = {.path = path, .name = path, .set = &set};
    return flow_heights_read(&file, job->image, false, role, work, image, err);
}

spot_positions spot_positions_create(const wt_height_map *f, double radius)
{
    const double width = (double)(f->nx - 1) * f->dx, height = (double)(f->ny - 1) * f->dy;
    return (spot_positions){(size_t)fmax(0, floor(width / (2 * radius))),
                            (size_t)fmax(0, floor(height / (2 * radius))), radius};
}
