/* Heights of a surface before the transform: statistics, missing heights and form.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/cholesky.h"
#include "surface/numerics/surface_analysis.h"

#include <float.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

/* ---- statistics ------------------------------------------------------------------------------ */

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

/* ---- missing heights: a membrane over their neighbours --------------------------------------- */

/* Conjugate gradients: Hestenes and Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409.
 * Relative residual at the end of the iteration, far below the resolution of an instrument. */
static const double residual_left = 1e-12;

/* Number of neighbours of a grid point times its value, minus their values. */
static double curvature_at(const double *x, size_t nx, size_t ny, size_t p)
{
    const size_t i = p % nx, j = p / nx;
    double sum = 0;
    sum += i > 0 ? x[p] - x[p - 1] : 0;
    sum += i + 1 < nx ? x[p] - x[p + 1] : 0;
    sum += j > 0 ? x[p] - x[p - nx] : 0;
    sum += j + 1 < ny ? x[p] - x[p + nx] : 0;
    return sum;
}

/* Fills the n missing heights at `missing`, which are 0. The direction [ny * nx] is 0 elsewhere. */
static wt_status solve_membrane(double *z, size_t nx, size_t ny, const size_t *missing, size_t n,
                                double *direction, double *residual, wt_error *err)
{
    double first = 0;
    for (size_t k = 0; k < n; k++) {
        residual[k] = direction[missing[k]] = -curvature_at(z, nx, ny, missing[k]);
        first += residual[k] * residual[k];
    }
    double now = first;
    double *const product = residual + n;
    /* In exact arithmetic n steps suffice; a small patch needs a few more due to rounding. */
    for (size_t step = 0; step < 2 * n + 10; step++) {
        if (now <= residual_left * residual_left * first)
            return WT_OK;
        double along = 0, next = 0;
        for (size_t k = 0; k < n; k++) {
            product[k] = curvature_at(direction, nx, ny, missing[k]);
            along += direction[missing[k]] * product[k];
        }
        for (size_t k = 0; k < n; k++) {
            z[missing[k]] += now / along * direction[missing[k]];
            residual[k] -= now / along * product[k];
            next += residual[k] * residual[k];
        }
        for (size_t k = 0; k < n; k++)
            direction[missing[k]] = residual[k] + next / now * direction[missing[k]];
        now = next;
    }
    return wt_fail(err, WT_E_CONVERGENCE, "the missing heights could not be filled");
}

wt_status surface_fill_missing(double *z, size_t nx, size_t ny, wt_error *err)
{
    size_t n = 0;
    for (size_t p = 0; p < nx * ny; p++)
        n += isfinite(z[p]) ? 0 : 1;
    if (n == 0)
        return WT_OK;
    if (n == nx * ny)
        return wt_fail(err, WT_E_EMPTY, "all heights are missing");
    size_t *const missing = wt_alloc(n, sizeof *missing), k = 0;
    double *const numbers = wt_alloc(nx * ny + 2 * n, sizeof *numbers);
    for (size_t p = 0; p < nx * ny; p++)
        if (!isfinite(z[p])) {
            missing[k++] = p;
            z[p] = 0;
        }
    const wt_status status = solve_membrane(z, nx, ny, missing, n, numbers, numbers + nx * ny, err);
    free(missing);
    free(numbers);
    return status;
}

/* ---- form: a polynomial fitted by least squares ---------------------------------------------- */

/* Powers of x and y in the terms of a form. */
static const int power_x[FORM_TERMS] = {0, 1, 0, 2, 1, 0}, power_y[FORM_TERMS] = {0, 0, 1, 0, 1, 2};
enum { HIGHEST = 4 }; /* highest power in a product of two terms */

static double normalised_coordinate(size_t i, size_t n)
{
    return n > 1 ? (2 * (double)i + 1 - (double)n) / (double)n : 0;
}

/* Lists the terms of the form. A profile has no terms in y. */
static size_t select_form_terms(unsigned degree, bool profile, size_t terms[FORM_TERMS])
{
    size_t n = 0;
    for (size_t t = 0; t < FORM_TERMS; t++)
        if ((unsigned)(power_x[t] + power_y[t]) <= degree && !(profile && power_y[t] > 0))
            terms[n++] = t;
    return n;
}

/* Sums of x^i and of x^i z over the heights of a row. */
typedef struct row_sums {
    double x[HIGHEST + 1], z[HIGHEST / 2 + 1];
    size_t n;
} row_sums;

static row_sums sum_row(const double *z, size_t nx)
{
    row_sums s = {.n = 0};
    for (size_t i = 0; i < nx; i++) {
        if (!isfinite(z[i]))
            continue;
        const double x = normalised_coordinate(i, nx), x2 = x * x;
        s.n++;
        s.x[1] += x;
        s.x[2] += x2;
        s.x[3] += x2 * x;
        s.x[4] += x2 * x2;
        s.z[0] += z[i];
        s.z[1] += x * z[i];
        s.z[2] += x2 * z[i];
    }
    s.x[0] = (double)s.n;
    return s;
}

static double integer_power(double y, int n)
{
    return n == 0 ? 1 : n == 1 ? y : n == 2 ? y * y : n == 3 ? y * y * y : y * y * y * y;
}

static void subtract_form(double *z, size_t nx, size_t ny, const double c[FORM_TERMS])
{
    for (size_t j = 0; j < ny; j++) {
        const double y = normalised_coordinate(j, ny);
        const double a = c[0] + y * (c[2] + y * c[5]), b = c[1] + y * c[4];
        for (size_t i = 0; i < nx; i++) {
            const double x = normalised_coordinate(i, nx);
            z[j * nx + i] -= a + x * (b + x * c[3]);
        }
    }
}

wt_status surface_remove_form(double *z, size_t nx, size_t ny, unsigned degree,
                              double coefficients[FORM_TERMS], wt_error *err)
{
    size_t terms[FORM_TERMS], n_points = 0;
    double m[FORM_TERMS][FORM_TERMS] = {{0}}, v[FORM_TERMS] = {0};
    const size_t n = select_form_terms(degree, ny == 1, terms);
    for (size_t j = 0; j < ny; j++) {
        const row_sums s = sum_row(z + j * nx, nx);
        const double y = normalised_coordinate(j, ny);
        n_points += s.n;
        for (size_t a = 0; a < n; a++) {
            const int xa = power_x[terms[a]], ya = power_y[terms[a]];
            v[a] += integer_power(y, ya) * s.z[xa];
            for (size_t b = 0; b <= a; b++)
                m[a][b] += integer_power(y, ya + power_y[terms[b]]) * s.x[xa + power_x[terms[b]]];
        }
    }
    for (size_t t = 0; t < FORM_TERMS; t++)
        coefficients[t] = 0;
    /* Pivots within the rounding error count as zero. */
    if (n_points < n ||
        !cholesky_solve(&m[0][0], FORM_TERMS, n, (double)(n * n) * DBL_EPSILON, v)) {
        wt_fail(err, WT_E_EMPTY, "too few heights for the form that is taken off");
        wt_error_expected(err, "%zu or more that do not lie on one line", n);
        wt_error_found(err, "%zu", n_points);
        return WT_E_EMPTY;
    }
    for (size_t a = 0; a < n; a++)
        coefficients[terms[a]] = v[a];
    subtract_form(z, nx, ny, coefficients);
    return WT_OK;
}

/* ---- artefacts of a scanner ------------------------------------------------------------------ */

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
    double difference; /* robust standard deviation of single differences, less their shift; 0
                          unless asked for */
} levels;

static double robust_deviation(double *x, size_t n)
{
    const double middle = gsl_stats_median(x, 1, n);
    for (size_t i = 0; i < n; i++)
        x[i] = fabs(x[i] - middle);
    return deviations_per_median * gsl_stats_median(x, 1, n);
}

/* `lines` lines of `points` heights; a step to the next line and to the next point of a line. */
static levels find_levels(const double *z, size_t lines, size_t points, size_t line, size_t point,
                          bool with_difference)
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
        to.shift[k] = n > 0 ? gsl_stats_median(x, 1, n) : 0;
        if (n > 0 && with_difference)
            spread[known++] = robust_deviation(x, n);
    }
    for (size_t k = 0; k < to.n; k++)
        x[k] = to.shift[k];
    to.deviation = robust_deviation(x, to.n);
    to.difference = known > 0 ? gsl_stats_median(spread, 1, known) : 0;
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
        for (size_t i = 0; i < nx; i++) {
            if (!(fabs(z[j * nx + i] - z[(j - 1) * nx + i]) > least))
                continue; /* as most points: no width stands out */
            for (size_t width = 1; width <= WIDEST_SCAR && j + width < ny; width++)
                for (int sign = -1; sign <= 1; sign += 2)
                    for (size_t k = 0;
                         k < width && stands_out(&z[j * nx + i], nx, width, sign, least); k++)
                        mark[(j + k) * nx + i] = (signed char)sign;
        }
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
    const levels rows = find_levels(z, map->ny, map->nx, map->nx, 1, true),
                 columns = find_levels(z, map->nx, map->ny, 1, map->nx, false);
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
