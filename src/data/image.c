/* Images. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/data.h"

#include <stdlib.h>

void wt_image_clear(wt_image *image)
{
    if (image == NULL)
        return;
    free(image->values);
    *image = (wt_image){0};
}
