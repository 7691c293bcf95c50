/* Memory of images, and their conversion to height maps. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "weartrack/core.h"

#include <math.h>
#include <stdlib.h>

void wt_image_clear(wt_image *image)
{
    if (image == NULL)
        return;
    free(image->values);
    *image = (wt_image){0};
}

wt_height_map wt_image_height_map(const wt_image *image)
{
    return (wt_height_map){image->values,
                           image->n_columns,
                           image->n_rows,
                           image->width / (double)(image->n_columns - 1),
                           image->n_rows > 1 ? image->height / (double)(image->n_rows - 1)
                                             : (double)NAN,
                           false};
}
