/* Heights of a scan, thinned for a figure. SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/surface.h"

#include "core/table/table_rows.h"
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Maximum points along the side of all maps of a figure, and along a line: more than a page
 * resolves. */
enum { MOST_SIDE = 256, MOST_LINE = 2048 };

void surface_view_clear(surface_view *view)
{
    free(view->z);
    free(view->line);
    *view = (surface_view){.nx = 0};
}

/* Returns the step that leaves at most `most` of n points. */
static size_t thinning_step(size_t n, size_t most)
{
    return (n - 1) / most + 1;
}

static size_t thinned_count(size_t n, size_t step)
{
    return (n - 1) / step + 1;
}

static wt_status thin_heights(const wt_height_map *map, size_t most, surface_view *to,
                              wt_error *err)
{
    const bool profile = map->ny == 1;
    const size_t step = thinning_step(map->nx > map->ny ? map->nx : map->ny, most),
                 along = thinning_step(map->nx, MOST_LINE);
    const double *const row = map->z + map->ny / 2 * map->nx;
    *to = (surface_view){.nx = profile ? 0 : thinned_count(map->nx, step),
                         .ny = profile ? 0 : thinned_count(map->ny, step),
                         .dx = map->dx * (double)step,
                         .dy = map->dy * (double)step,
                         .n_line = thinned_count(map->nx, along),
                         .line_step = map->dx * (double)along};
    to->z = malloc((to->nx * to->ny + 1) * sizeof *to->z);
    to->line = malloc(to->n_line * sizeof *to->line);
    if (to->z == NULL || to->line == NULL) {
        surface_view_clear(to);
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    for (size_t j = 0; j < to->ny; j++)
        for (size_t i = 0; i < to->nx; i++)
            to->z[j * to->nx + i] = map->z[j * step * map->nx + i * step];
    for (size_t i = 0; i < to->n_line; i++)
        to->line[i] = row[i * along];
    return WT_OK;
}

wt_status surface_view_create(const wt_height_map *map, wt_surface_form form, size_t n_scans,
                              surface_view *to, wt_error *err)
{
    const size_t maps_per_row = (size_t)ceil(sqrt((double)n_scans));
    double coefficients[FORM_TERMS];
    double *z = malloc(map->nx * map->ny * sizeof *z);
    if (z == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu x %zu heights", map->nx, map->ny);
    memcpy(z, map->z, map->nx * map->ny * sizeof *z);
    const wt_height_map less = {z, map->nx, map->ny, map->dx, map->dy, map->levelled};
    wt_status status = surface_remove_form(z, map->nx, map->ny, (unsigned)form, coefficients, err);
    if (status == WT_OK)
        status =
            thin_heights(&less, maps_per_row < MOST_SIDE ? MOST_SIDE / maps_per_row : 1, to, err);
    free(z);
    return status;
}

/* ---- tables ---------------------------------------------------------------------------------- */

TABLE_ROW(height_map, HEIGHT_MAP, double scan, x, y, height;)
TABLE_ROW(height_profile, HEIGHT_PROFILE, double scan, x, height;)

wt_status surface_view_maps(const surface_scan *scans, size_t n, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&height_map_schema, err);
    for (size_t s = 0; s < n; s++) {
        const surface_view *v = &scans[s].view;
        for (size_t j = 0; j < v->ny; j++)
            for (size_t i = 0; i < v->nx; i++)
                TABLE_ADD(height_map, &t, (double)(s + 1), (double)i * v->dx, (double)j * v->dy,
                          v->z[j * v->nx + i]);
    }
    return table_end(&t, table);
}

wt_status surface_view_profiles(const surface_scan *scans, size_t n, wt_table **table,
                                wt_error *err)
{
    table_writer t = table_begin(&height_profile_schema, err);
    for (size_t s = 0; s < n; s++) {
        const surface_view *v = &scans[s].view;
        for (size_t i = 0; i < v->n_line; i++)
            TABLE_ADD(height_profile, &t, (double)(s + 1), (double)i * v->line_step, v->line[i]);
    }
    return table_end(&t, table);
}
