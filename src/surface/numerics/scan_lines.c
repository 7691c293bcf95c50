/* Artefacts of a scanning probe: offsets of scan lines, and scars.
 *
 * On a surface without them, adjacent rows differ as adjacent columns do. Random offsets of the
 * rows add white noise to the levels of the rows; differences of white noise have a correlation of
 * -1/2 from one to the next. Heights have a correlation of 2^(2H-1) - 1 > -1/4 for H > 0.21
 * (increments of fractional Brownian motion: Mandelbrot and van Ness, SIAM Review 10 (1968) 422).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "surface/numerics/surface_analysis.h"

#include <math.h>

/* Least number of rows and columns: the standard deviation of their levels is then known to 20 %.
 */
enum { LEAST_LINES = 16 };
/* Ratio of the differences between rows to those between columns. With 20 % of error in either, a
 * ratio of 2 is 2.5 standard deviations off that of equal ones. */
static const double least_ratio = 2;
static const double most_correlation = -0.25;
/* Standard deviation of a normal distribution over its median absolute deviation. */
static const double deviations_per_median = 1.4826;
/* A scar differs from both adjacent rows by so many standard deviations of their difference, over
 * so many points: for independent normal heights both together never occur in any map. */
static const double scar_deviations = 6;
enum { LEAST_SCAR = 8 };

/* Differences of a map along one axis. */
typedef struct levels {
    size_t n;          /* number of differences between lines */
    double *shift;     /* [n] median difference of line k + 1 and line k */
    double deviation;  /* robust standard deviation of `shift` */
    double difference; /* robust standard deviation of single differences, less their shift */
} levels;

static double robust_deviation(double *x, size_t n)
{
    const double middle = numbers_median(x, n);
    for (size_t i = 0; i < n; i++)
        x[i] = fabs(x[i] - middle);
    return deviations_per_median * numbers_median(x, n);
}

/* `lines` lines of `points` heights; a step to the next line and to the next point of a line. */
static levels find_levels(const double *z, size_t lines, size_t points, size_t line, size_t point)
{
    double *const x = wt_alloc(lines + points, sizeof *x), *const spread =
                                                               wt_alloc(lines, sizeof *x);
    levels to = {.n = lines - 1, .shift = wt_alloc(lines, sizeof *to.shift)};
    size_t known = 0;
    for (size_t k = 0; k < to.n; k++) {
        size_t n = 0;
        for (size_t i = 0; i < points; i++) {
            const double difference = z[(k + 1) * line + i * point] - z[k * line + i * point];
            if (!isnan(difference))
                x[n++] = difference;
        }
        to.shift[k] = n > 0 ? numbers_median(x, n) : 0;
        if (n > 0)
            spread[known++] = robust_deviation(x, n);
    }
    for (size_t k = 0; k < to.n; k++)
        x[k] = to.shift[k];
    to.deviation = robust_deviation(x, to.n);
    to.difference = known > 0 ? numbers_median(spread, known) : 0;
    free(x);
    free(spread);
    return to;
}

static double next_correlation(const levels *l)
{
    double mean = 0, squares = 0, products = 0;
    for (size_t k = 0; k < l->n; k++)
        mean += l->shift[k] / (double)l->n;
    for (size_t k = 0; k < l->n; k++) {
        squares += (l->shift[k] - mean) * (l->shift[k] - mean);
        products += k > 0 ? (l->shift[k] - mean) * (l->shift[k - 1] - mean) : 0;
    }
    return squares > 0 ? products / squares : 0;
}

/* Height of a point above both adjacent rows, the lesser of two; 0 between them. */
static double standing_out(const wt_height_map *map, const levels *rows, size_t j, size_t i)
{
    const double *const z = &map->z[j * map->nx + i];
    const double above = z[0] - *(z - map->nx) - rows->shift[j - 1],
                 below = z[0] - z[map->nx] + rows->shift[j];
    if (above > 0 && below > 0)
        return fmin(above, below);
    return above < 0 && below < 0 ? fmax(above, below) : 0;
}

/* row: the heights of row j, with nx heights in each row. */
static void replace_scar(double *row, size_t nx, const levels *rows, size_t j, size_t from,
                         size_t to)
{
    for (size_t i = from; i < to; i++)
        row[i] = (*(row + i - nx) + rows->shift[j - 1] + row[i + nx] - rows->shift[j]) / 2;
}

static size_t find_scars(double *z, const wt_height_map *map, const levels *rows, bool mend)
{
    const double least = scar_deviations * rows->difference;
    size_t scars = 0;
    for (size_t j = 1; least > 0 && j + 1 < map->ny; j++)
        for (size_t i = 0, to; i < map->nx; i = to) {
            const double first = standing_out(map, rows, j, i);
            to = i + 1;
            if (!(fabs(first) > least))
                continue;
            while (to < map->nx && standing_out(map, rows, j, to) * first > 0 &&
                   fabs(standing_out(map, rows, j, to)) > least)
                to++;
            if (to - i < LEAST_SCAR)
                continue;
            scars++;
            if (mend)
                replace_scar(z + j * map->nx, map->nx, rows, j, i, to);
        }
    return scars;
}

static void level_rows(double *heights, wt_height_map *map)
{
    for (size_t j = 0; j < map->ny; j++) {
        double *const z = heights + j * map->nx;
        double sum = 0;
        size_t n = 0;
        for (size_t i = 0; i < map->nx; i++)
            if (!isnan(z[i])) {
                sum += z[i];
                n++;
            }
        for (size_t i = 0; i < map->nx && n > 0; i++)
            z[i] -= sum / (double)n;
    }
    map->levelled = true;
}

scan_line_faults surface_scan_lines(double *z, wt_height_map *map, bool mend)
{
    scan_line_faults found = {.scars = 0};
    if (map->nx < LEAST_LINES || map->ny < LEAST_LINES)
        return found;
    const levels rows = find_levels(z, map->ny, map->nx, map->nx, 1),
                 columns = find_levels(z, map->nx, map->ny, 1, map->nx);
    /* a longer step between rows has larger differences, at most in proportion */
    const double step = fmax(1, map->dy / map->dx);
    found.suspected = rows.deviation > least_ratio * step * columns.deviation;
    if (found.suspected && next_correlation(&rows) < most_correlation)
        found.offsets = rows.deviation / sqrt(2);
    /* without offsets, a shift of a row is that of a scar over more than half of it */
    for (size_t k = 0; k < rows.n && !(found.offsets > 0); k++)
        rows.shift[k] = 0;
    found.scars = find_scars(z, map, &rows, mend);
    if (found.offsets > 0 && mend)
        level_rows(z, map);
    free(rows.shift);
    free(columns.shift);
    return found;
}
