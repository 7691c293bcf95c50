/* Statistics of the heights of a surface: amplitudes, slopes and peak curvature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/height_grid.h"

#include <math.h>

/* Running sum and number of values. */
typedef struct running_mean {
    double sum, n;
} running_mean;

static void mean_add(running_mean *m, double value)
{
    m->sum += value;
    m->n++;
}

static double mean_value(running_mean m)
{
    return m.n > 0 ? m.sum / m.n : (double)NAN;
}

static void compute_amplitudes(const double *z, size_t n, wt_surface_heights *to)
{
    running_mean height = {0, 0}, absolute = {0, 0}, power[3] = {{0, 0}, {0, 0}, {0, 0}};
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++)
        if (isfinite(z[i]))
            mean_add(&height, z[i]);
    const double middle = mean_value(height);
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(z[i]))
            continue;
        const double d = z[i] - middle, d2 = d * d;
        mean_add(&absolute, fabs(d));
        mean_add(&power[0], d2);
        mean_add(&power[1], d2 * d);
        mean_add(&power[2], d2 * d2);
        low = fmin(low, d);
        high = fmax(high, d);
    }
    to->n = n;
    to->missing = n - (size_t)height.n;
    to->rms = sqrt(mean_value(power[0]));
    to->mean_deviation = mean_value(absolute);
    to->peak_to_valley = high - low;
    to->skewness = mean_value(power[1]) / (to->rms * to->rms * to->rms);
    to->kurtosis = mean_value(power[2]) / (to->rms * to->rms * to->rms * to->rms);
}

void surface_height_statistics(const wt_height_map *map, wt_surface_heights *to)
{
    const size_t nx = map->nx, ny = map->ny;
    running_mean along_x = {0, 0}, along_y = {0, 0}, excess = {0, 0};
    compute_amplitudes(map->z, nx * ny, to);
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0; i < nx; i++) {
            const double *z = map->z + j * nx + i;
            const double sx = i + 1 < nx ? (z[1] - z[0]) / map->dx : (double)NAN;
            const double sy = j + 1 < ny ? (z[nx] - z[0]) / map->dy : (double)NAN;
            if (isfinite(sx))
                mean_add(&along_x, sx * sx);
            if (isfinite(sy))
                mean_add(&along_y, sy * sy);
            if (isfinite(sx) && isfinite(sy))
                mean_add(&excess, sqrt(1 + sx * sx + sy * sy) - 1);
        }
    to->slope_x = sqrt(mean_value(along_x));
    to->slope_y = sqrt(mean_value(along_y));
    to->rms_slope = ny > 1 ? hypot(to->slope_x, to->slope_y) : to->slope_x;
    to->area_excess = mean_value(excess);
}

/* Returns the most negative curvature of the peaks [1/m], from second differences over 2 l
 * points. */
static double peak_curvature(const wt_height_map *map, size_t l)
{
    const size_t nx = map->nx, ny = map->ny;
    const double x2 = (double)(l * l) * map->dx * map->dx, y2 = (double)(l * l) * map->dy * map->dy;
    double least = 0;
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0; i < nx; i++) {
            const double *z = map->z + j * nx + i;
            if (i >= l && i + l < nx)
                least = fmin(least, (*(z + l) - 2 * *z + *(z - l)) / x2);
            if (j >= l && j + l < ny)
                least = fmin(least, (*(z + l * nx) - 2 * *z + *(z - l * nx)) / y2);
        }
    return least;
}

double surface_tip_limit(const wt_height_map *map, double radius)
{
    const size_t most = (map->nx > map->ny ? map->nx : map->ny) / 2;
    const double step = map->ny > 1 ? fmax(map->dx, map->dy) : map->dx;
    for (size_t l = 1; l < most; l += 1 + l / 8)
        if (peak_curvature(map, l) >= -1 / (2 * radius))
            return M_PI / ((double)l * step);
    return 0;
}
