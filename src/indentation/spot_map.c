/* Heights around a spot before and after an indentation, for a figure.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/spot.h"

#include "core/table/table_rows.h"

#include <math.h>

/* Half width of the map in contact radii, so that imprint and undisturbed surface are visible. The
 * largest number of pixels suits a small figure. */
enum { MAP_RADII = 5, MAX_MAP_PIXELS = 81 };

/* Range of the pixels of an axis in the map. */
typedef struct pixel_range {
    size_t first, last, step;
} pixel_range;

static pixel_range select_pixels(double centre, double reach, double pixel, size_t n)
{
    const double low = fmax(0, ceil((centre - reach) / pixel)),
                 high = fmin((double)(n - 1), floor((centre + reach) / pixel));
    if (!(low <= high))
        return (pixel_range){1, 0, 1};
    const size_t first = (size_t)low, last = (size_t)high;
    return (pixel_range){first, last, (last - first) / MAX_MAP_PIXELS + 1};
}

static double height_above_plane(const wt_height_map *f, const spot_plane *p, size_t i, size_t j,
                                 double u, double v)
{
    return f->z[j * f->nx + i] - (p->height + p->slope_x * u + p->slope_y * v);
}

TABLE_ROW(spot_map, SPOT_MAP, double x, y, before, after, change;)

wt_status spot_map_create(const wt_height_map *before, const spot *s, const double *difference,
                          wt_table **table, wt_error *err)
{
    const double reach = MAP_RADII * s->contact, nan = (double)NAN;
    const pixel_range x = select_pixels(s->x, reach, before->dx, before->nx),
                      y = select_pixels(s->y, reach, before->dy, before->ny);
    wt_height_map changed = *before;
    spot_plane planes[2] = {spot_plane_fit(before, s->x, s->y, reach), {nan, nan, nan, nan, 0, 0}};
    if (difference != NULL) {
        changed.z = difference;
        planes[1] = spot_plane_fit(&changed, s->x, s->y, reach);
    }
    table_writer t = table_begin(&spot_map_schema, err);
    for (size_t j = y.first; j <= y.last; j += y.step)
        for (size_t i = x.first; i <= x.last; i += x.step) {
            const double u = (double)i * before->dx - s->x, v = (double)j * before->dy - s->y;
            const double before_height = height_above_plane(before, &planes[0], i, j, u, v),
                         change = difference != NULL
                                      ? height_above_plane(&changed, &planes[1], i, j, u, v)
                                      : nan;
            TABLE_ADD(spot_map, &t, u, v, before_height, before_height + change, change);
        }
    spot_map_set_value(&t, SPOT_MAP_KEY_CONTACT_RADIUS, s->contact, 0, 0);
    return table_end(&t, table);
}
