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
/* A scar differs from the rows before and behind it by so many standard deviations of the
 * difference of adjacent rows, over so many points: for independent normal heights both together
 * never occur in any map. */
static const double scar_deviations = 6;
enum { LEAST_SCAR = 16 };
/* A scar of more rows is a feature of the surface. */
enum { WIDEST_SCAR = 4 };

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

/* ---- scars ----------------------------------------------------------------------------------- */

/* True if `width` heights of a column from z on are all above the heights before and behind them by
 * more than `least`, or all below (sign -1). nx: from one row to the next. */
static bool stands_out(const double *z, size_t nx, size_t width, double sign, double least)
{
    const double before = sign * *(z - nx), behind = sign * z[width * nx];
    bool all = !isnan(before) && !isnan(behind);
    for (size_t k = 0; all && k < width; k++)
        all = sign * z[k * nx] - fmax(before, behind) > least;
    return all;
}

/* Marks the points of each column that stand out: 1 or -1. */
static void mark_points(const double *z, size_t nx, size_t ny, double least, signed char *mark)
{
    for (size_t j = 1; j + 1 < ny; j++)
        for (size_t i = 0; i < nx; i++)
            for (size_t width = 1; width <= WIDEST_SCAR && j + width < ny; width++)
                for (int sign = -1; sign <= 1; sign += 2)
                    for (size_t k = 0;
                         k < width && stands_out(&z[j * nx + i], nx, width, sign, least); k++)
                        mark[(j + k) * nx + i] = (signed char)sign;
}

/* Keeps the marks of long runs and returns the number of runs. */
static size_t keep_scars(signed char *mark, size_t nx, size_t ny)
{
    size_t scars = 0;
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0, to; i < nx; i = to) {
            signed char *const row = mark + j * nx;
            for (to = i + 1; to < nx && row[to] == row[i];)
                to++;
            scars += row[i] != 0 && to - i >= LEAST_SCAR;
            for (size_t k = i; k < to && to - i < LEAST_SCAR; k++)
                row[k] = 0;
        }
    return scars;
}

/* Replaces the marked heights by those between the rows before and behind them. */
static void replace_marked(double *z, size_t nx, size_t ny, const signed char *mark)
{
    for (size_t i = 0; i < nx; i++)
        for (size_t j = 1, to; j + 1 < ny; j = to) {
            to = j + 1;
            if (mark[j * nx + i] == 0)
                continue;
            while (mark[to * nx + i] != 0)
                to++; /* the last row has no mark */
            const double before = z[(j - 1) * nx + i], behind = z[to * nx + i];
            for (size_t k = j; k < to; k++)
                z[k * nx + i] =
                    before + (behind - before) * (double)(k - j + 1) / (double)(to - j + 1);
        }
}

static size_t find_scars(double *z, size_t nx, size_t ny, double least, bool mend)
{
    signed char *const mark = wt_alloc(nx * ny, 1);
    if (least > 0)
        mark_points(z, nx, ny, least, mark);
    const size_t scars = keep_scars(mark, nx, ny);
    if (scars > 0 && mend)
        replace_marked(z, nx, ny, mark);
    free(mark);
    return scars;
}

/* ---- offsets --------------------------------------------------------------------------------- */

/* Subtracts the running sum of the shifts, so that the rows stand on one level; `sign` -1 puts the
 * offsets back. */
static void remove_shifts(double *z, size_t nx, const levels *rows, double sign)
{
    double level = 0;
    for (size_t j = 1; j <= rows->n; j++) {
        level += sign * rows->shift[j - 1];
        for (size_t i = 0; i < nx; i++)
            z[j * nx + i] -= level;
    }
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
    if (found.offsets > 0)
        remove_shifts(z, map->nx, &rows, 1);
    found.scars = find_scars(z, map->nx, map->ny, scar_deviations * rows.difference, mend);
    if (found.offsets > 0 && !mend)
        remove_shifts(z, map->nx, &rows, -1);
    if (found.offsets > 0 && mend)
        level_rows(z, map);
    free(rows.shift);
    free(columns.shift);
    return found;
}
