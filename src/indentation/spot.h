/* State that the files of the spot job share. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_SPOT_H
#define WT_INDENTATION_SPOT_H

#include "indentation/numerics/height_image.h"
#include "weartrack/indentation.h"

typedef struct spot {
    double x, y;           /* from the first pixel [m] */
    double contact, power; /* contact radius a [m]; d ln a / d ln depth */
    double error;          /* error of the position [m] */
    spot_plane plane;
    double low, high, median;
    char verdict[320];
} spot;

typedef struct imprint {
    spot_shift shift;
    double strain; /* largest change of the drift along the image, per length */
    wt_interval depth, volume;
    double deepest, deepest_x, deepest_y; /* from the first pixel [m] */
    size_t places;
    double *difference; /* at the pixels of the image before; NULL if not known; owned */
    char verdict[320];
} imprint;

/* Adjacent positions over the image, each `radius` from the next and from the edges. */
typedef struct spot_positions {
    size_t nx, ny;
    double radius;
} spot_positions;
spot_positions spot_positions_create(const wt_height_map *field, double radius);

/* Reads the height image that the job names from a file. Other images are freed. */
wt_status spot_image_read(const wt_spot_job *job, const char *path, const char *role,
                          const wt_job *work, wt_image *image, wt_error *err) WT_NODISCARD;
/* Returns an imprint of unknown values, for a job without an image after the indentation. */
imprint spot_empty_imprint(void);
/* Measures the change at the spot in the image job->after. */
wt_status spot_imprint_find(const wt_spot_job *job, const wt_image *before, const spot *s,
                            const wt_job *work, imprint *to, wt_error *err) WT_NODISCARD;
/* Creates the table spot_map: the heights around the spot, and with `difference` those after it.
 * `difference` may be NULL. */
wt_status spot_map_create(const wt_height_map *before, const spot *s, const double *difference,
                          wt_table **table, wt_error *err) WT_NODISCARD;

#endif
