/* Alignment of two height images: a search in whole pixels from coarse to fine, then shifts of
 * image blocks, which are linear in the position if the drift is steady.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/height_image.h"

#include <math.h>
#include <stdlib.h>

/* Pixels along an image at the start of the search over all shifts, whose run time grows with their
 * fourth power. The resolution then doubles in steps. The best shift changes by one or two pixels,
 * and the search covers three pixels to each side. */
enum { COARSE_PIXELS = 64, SEARCH_RADIUS = 3 };
/* Blocks along an axis, each with its own shift, and the smallest number of blocks, which is twice
 * the number of drift parameters. */
enum { SIDE = 4, PARTS = SIDE * SIDE, MIN_PARTS = 6 };
/* Limit of the iterations. */
enum { MOST_STEPS = 20 };

/* Part of the first image: pixels from..to without a disc. */
typedef struct region {
    size_t i[2], j[2];
    double x, y, radius;
} region;

static bool is_in_disc(const wt_height_map *f, const region *r, size_t i, size_t j)
{
    const double u = (double)i * f->dx - r->x, v = (double)j * f->dy - r->y;
    return u * u + v * v <= r->radius * r->radius;
}

/* ---- whole pixels ---------------------------------------------------------------------------- */

/* Adds the differences of a line, minus one height for precision, to the equations of a plane.
 * Returns their sum of squares. u is the start of the line. */
static double add_line_differences(const double *first_row, const double *second_row, size_t pixels,
                                   const double u[2], double *height,
                                   double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double *v)
{
    double n = 0, along = 0, along_along = 0, sum = 0, sum_along = 0, squares = 0, first = *height,
           at = u[0];
    for (size_t i = 0; i < pixels; i++, at++) {
        double d = second_row[i] - first_row[i];
        if (!isfinite(d))
            continue;
        first = isnan(first) ? d : first;
        d -= first;
        n++;
        along += at;
        along_along += at * at;
        sum += d;
        sum_along += at * d;
        squares += d * d;
    }
    *height = first;
    const double lower[SPOT_UNKNOWNS][SPOT_UNKNOWNS] = {{n},
                                                        {along, along_along},
                                                        {u[1] * n, u[1] * along, u[1] * u[1] * n}},
                 right[SPOT_UNKNOWNS] = {sum, sum_along, u[1] * sum};
    for (size_t p = 0; p < SPOT_UNKNOWNS; p++) {
        for (size_t q = 0; q <= p; q++)
            m[p][q] += lower[p][q];
        v[p] += right[p];
    }
    return squares;
}

/* Variance of the difference to the second image, shifted by whole pixels, minus its plane. Without
 * the plane, a tilt between the images would favour the smallest overlap. The result is infinite
 * with fewer than `least` pixels. */
static double height_variance(const wt_height_map *before, const wt_height_map *after,
                              const region *r, const long s[2], size_t least)
{
    double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS] = {{0}}, v[SPOT_UNKNOWNS] = {0}, squares = 0,
           first = (double)NAN;
    size_t from[2], to[2];
    const size_t *range[2] = {r->i, r->j}, size[2] = {after->nx, after->ny};
    for (int k = 0; k < 2; k++) {
        const long low = -s[k], high = (long)size[k] - s[k];
        from[k] = low > (long)range[k][0] ? (size_t)low : range[k][0];
        to[k] = high < (long)range[k][1] ? (size_t)(high > 0 ? high : 0) : range[k][1];
        if (from[k] >= to[k])
            return (double)INFINITY;
    }
    if ((to[0] - from[0]) * (to[1] - from[1]) < least)
        return (double)INFINITY;
    for (size_t j = from[1]; j < to[1]; j++) {
        const double u[2] = {-0.5 * (double)(to[0] - from[0] - 1),
                             (double)j - 0.5 * (double)(from[1] + to[1] - 1)};
        const double *second_row = after->z + (size_t)((long)j + s[1]) * after->nx;
        squares += add_line_differences(before->z + j * before->nx + from[0],
                                        second_row + (size_t)((long)from[0] + s[0]),
                                        to[0] - from[0], u, &first, m, v);
    }
    const double n = m[0][0], right[SPOT_UNKNOWNS] = {v[0], v[1], v[2]};
    if (n < (double)least || !spot_solve(SPOT_UNKNOWNS, m, v))
        return (double)INFINITY;
    for (size_t p = 0; p < SPOT_UNKNOWNS; p++)
        squares -= v[p] * right[p];
    return squares / n;
}

/* Finds the best shift within from..to of both axes. */
static bool find_best_shift(const wt_height_map *before, const wt_height_map *after,
                            const region *r, const long from[2], const long to[2], size_t least,
                            long shift[2])
{
    double best = (double)INFINITY;
    for (long b = from[1]; b <= to[1]; b++)
        for (long a = from[0]; a <= to[0]; a++) {
            const long s[2] = {a, b};
            const double cost = height_variance(before, after, r, s, least);
            if (cost < best) {
                best = cost;
                shift[0] = a;
                shift[1] = b;
            }
        }
    return isfinite(best);
}

/* Computes means of f x f pixels. */
static void coarsen_image(const wt_height_map *of, size_t f, wt_height_map *to)
{
    *to = (wt_height_map){NULL, of->nx / f, of->ny / f, of->dx * (double)f, of->dy * (double)f,
                          false};
    double *z = wt_alloc((to->nx * to->ny + 1), sizeof *z);
    for (size_t j = 0; j < to->ny; j++)
        for (size_t i = 0; i < to->nx; i++) {
            double sum = 0;
            for (size_t b = 0; b < f; b++)
                for (size_t a = 0; a < f; a++)
                    sum += of->z[(j * f + b) * of->nx + i * f + a];
            z[j * to->nx + i] = sum / (double)(f * f);
        }
    to->z = z;
}

/* Searches with pixels of f x f: all shifts, or those near the result of the next coarser pixels.
 */
static bool search_level(const wt_height_map *before, const wt_height_map *after, region all,
                         size_t f, bool first, long shift[2])
{
    wt_height_map small[2];
    coarsen_image(before, f, &small[0]);
    coarsen_image(after, f, &small[1]);
    const size_t n = small[0].nx * small[0].ny, other = small[1].nx * small[1].ny;
    const long low[2] = {first ? -(long)small[0].nx : 2 * shift[0] - SEARCH_RADIUS,
                         first ? -(long)small[0].ny : 2 * shift[1] - SEARCH_RADIUS},
               high[2] = {first ? (long)small[1].nx : 2 * shift[0] + SEARCH_RADIUS,
                          first ? (long)small[1].ny : 2 * shift[1] + SEARCH_RADIUS};
    all.i[1] = small[0].nx;
    all.j[1] = small[0].ny;
    const bool found =
        find_best_shift(&small[0], &small[1], &all, low, high, (n < other ? n : other) / 4, shift);
    free((void *)small[0].z);
    free((void *)small[1].z);
    return found;
}

static bool find_pixel_shift(const wt_height_map *before, const wt_height_map *after,
                             const region *all, long shift[2])
{
    const size_t most = before->nx > before->ny ? before->nx : before->ny;
    size_t f = 1;
    bool found = true;
    while (most / f > COARSE_PIXELS)
        f *= 2;
    for (bool first = true; f > 0 && found; f /= 2, first = false)
        found = search_level(before, after, *all, f, first, shift);
    return found;
}

/* ---- subpixel shifts ------------------------------------------------------------------------- */

/* Image block: centre [m], shift [pixels], and weight for each axis. */
typedef struct image_block {
    double x, y, shift[2], weight[2];
} image_block;

/* Slope of the difference along the rows, shifts in x and y, and the difference itself. */
enum { SLOPE, SHIFT_X, SHIFT_Y, UNKNOWNS, DIFFERENCE = UNKNOWNS, TERMS };

/* Adds a row with a free offset, because scanning does not determine the offset of a row. */
static void add_row_equations(const double sum[TERMS], double products[TERMS][TERMS], size_t n,
                              double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double *v)
{
    for (size_t p = 0; p < UNKNOWNS && n > 0; p++) {
        for (size_t q = 0; q <= p; q++)
            m[p][q] += products[p][q] - sum[p] * sum[q] / (double)n;
        v[p] += products[DIFFERENCE][p] - sum[DIFFERENCE] * sum[p] / (double)n;
    }
}

/* Sums the equations of a Gauss-Newton step. The slopes are those of the first image at its pixels,
 * whose noise is independent of that of the interpolated heights. */
static void sum_block_equations(const wt_height_map *before, const wt_height_map *after,
                                const region *r, const double shift[2],
                                double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double *v)
{
    const double middle = 0.5 * (double)(r->i[0] + r->i[1]), half = (double)(r->i[1] - r->i[0]);
    for (size_t j = r->j[0] > 0 ? r->j[0] : 1; j < r->j[1] && j + 1 < before->ny; j++) {
        double sum[TERMS] = {0}, products[TERMS][TERMS] = {{0}}, first = (double)NAN;
        size_t n = 0;
        for (size_t i = r->i[0] > 0 ? r->i[0] : 1; i < r->i[1] && i + 1 < before->nx; i++) {
            const double *z = before->z + j * before->nx + i;
            double row[TERMS] = {
                ((double)i - middle) / half, 0.5 * (z[1] - *(z - 1)),
                0.5 * (z[before->nx] - *(z - before->nx)),
                *z - spot_interpolate_height(after, (double)i + shift[0], (double)j + shift[1])};
            if (is_in_disc(before, r, i, j) || !isfinite(row[1] + row[2] + row[3]))
                continue;
            first = n == 0 ? row[DIFFERENCE] : first;
            row[DIFFERENCE] -= first;
            n++;
            for (size_t p = 0; p < TERMS; p++) {
                sum[p] += row[p];
                for (size_t q = 0; q <= p; q++)
                    products[p][q] += row[p] * row[q];
            }
        }
        add_row_equations(sum, products, n, m, v);
    }
}

/* Refines the shift of a block from whole pixels. Returns false if it is not determined. */
static bool refine_shift(const wt_height_map *before, const wt_height_map *after, const region *r,
                         image_block *p)
{
    const double start[2] = {p->shift[0], p->shift[1]};
    for (int step = 0; step < MOST_STEPS; step++) {
        double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS] = {{0}}, v[SPOT_UNKNOWNS] = {0};
        sum_block_equations(before, after, r, p->shift, m, v);
        if (!spot_solve(UNKNOWNS, m, v))
            return false;
        p->shift[0] += v[SHIFT_X];
        p->shift[1] += v[SHIFT_Y];
        if (!(hypot(p->shift[0] - start[0], p->shift[1] - start[1]) < 2))
            return false;
        /* Inverse of the last two unknowns from the Cholesky factor. */
        const double a = m[SHIFT_X][SHIFT_X], b = m[SHIFT_Y][SHIFT_X], c = m[SHIFT_Y][SHIFT_Y];
        p->weight[0] = a * a * c * c / (b * b + c * c);
        p->weight[1] = c * c;
        if (hypot(v[SHIFT_X], v[SHIFT_Y]) < 1e-4) /* tolerance in pixels */
            return true;
    }
    return false;
}

/* Copies the image with NaN in the disc. */
static void blank_disc(const wt_height_map *f, const region *r, wt_height_map *to)
{
    double *z = wt_alloc(f->nx * f->ny, sizeof *z);
    for (size_t j = 0; j < f->ny; j++)
        for (size_t i = 0; i < f->nx; i++)
            z[j * f->nx + i] = is_in_disc(f, r, i, j) ? (double)NAN : f->z[j * f->nx + i];
    *to = *f;
    to->z = z;
}

static size_t count_outside_disc(const wt_height_map *f, const region *r)
{
    size_t n = 0;
    for (size_t j = r->j[0]; j < r->j[1]; j++)
        for (size_t i = r->i[0]; i < r->i[1]; i++)
            n += !is_in_disc(f, r, i, j);
    return n;
}

/* Finds the shifts of the blocks of the overlap. `cut` is the first image without the disc. */
static size_t find_block_shifts(const wt_height_map *before, const wt_height_map *cut,
                                const wt_height_map *after, const region *all, const long whole[2],
                                image_block parts[PARTS])
{
    size_t from[2], to[2], n = 0;
    const size_t size[2] = {before->nx, before->ny}, other[2] = {after->nx, after->ny};
    for (int k = 0; k < 2; k++) {
        const long end = (long)other[k] - whole[k];
        from[k] = whole[k] < 0 ? (size_t)-whole[k] : 0;
        to[k] = end < 0 ? 0 : (size_t)end < size[k] ? (size_t)end : size[k];
        if (from[k] >= to[k])
            return 0;
    }
    for (size_t b = 0; b < SIDE; b++)
        for (size_t a = 0; a < SIDE; a++) {
            region r = *all;
            for (size_t k = 0; k < 2; k++) {
                r.i[k] = from[0] + (to[0] - from[0]) * (a + k) / SIDE;
                r.j[k] = from[1] + (to[1] - from[1]) * (b + k) / SIDE;
            }
            image_block *p = &parts[n];
            const long low[2] = {whole[0] - SEARCH_RADIUS, whole[1] - SEARCH_RADIUS},
                       high[2] = {whole[0] + SEARCH_RADIUS, whole[1] + SEARCH_RADIUS};
            long shift[2] = {0, 0};
            if (!find_best_shift(cut, after, &r, low, high, count_outside_disc(cut, &r) / 4, shift))
                continue;
            *p = (image_block){.x = 0.5 * (double)(r.i[0] + r.i[1] - 1) * before->dx,
                               .y = 0.5 * (double)(r.j[0] + r.j[1] - 1) * before->dy,
                               .shift = {(double)shift[0], (double)shift[1]}};
            n += refine_shift(before, after, &r, p);
        }
    return n;
}

/* ---- steady drift ---------------------------------------------------------------------------- */

/* Plane through the shifts of the blocks along one axis: value at the position, gradient along x
 * and y. */
typedef struct drift_plane {
    double at, gradient[2], error, rms; /* [pixels]; rms of the residuals of the blocks */
} drift_plane;

static bool fit_drift(const image_block *parts, size_t n, int axis, const region *all,
                      double length, drift_plane *to)
{
    double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS] = {{0}}, v[SPOT_UNKNOWNS] = {0}, squares = 0, sum = 0,
           weight = 0, unit[SPOT_UNKNOWNS] = {1};
    for (size_t k = 0; k < n; k++) {
        const double row[3] = {1, (parts[k].x - all->x) / length, (parts[k].y - all->y) / length};
        for (size_t p = 0; p < 3; p++) {
            for (size_t q = 0; q <= p; q++)
                m[p][q] += parts[k].weight[axis] * row[p] * row[q];
            v[p] += parts[k].weight[axis] * row[p] * parts[k].shift[axis];
        }
    }
    double second[SPOT_UNKNOWNS][SPOT_UNKNOWNS];
    for (size_t p = 0; p < SPOT_UNKNOWNS; p++)
        for (size_t q = 0; q < SPOT_UNKNOWNS; q++)
            second[p][q] = m[p][q];
    if (!spot_solve(3, m, v) || !spot_solve(3, second, unit))
        return false;
    for (size_t k = 0; k < n; k++) {
        const double deviation = parts[k].shift[axis] - v[0] -
                                 v[1] * (parts[k].x - all->x) / length -
                                 v[2] * (parts[k].y - all->y) / length;
        squares += deviation * deviation;
        sum += parts[k].weight[axis] * deviation * deviation;
        weight += parts[k].weight[axis];
    }
    *to = (drift_plane){.at = v[0],
                        .gradient = {v[1] / length, v[2] / length},
                        .error = sqrt(sum / (double)(n - 3) * unit[0]),
                        .rms = sqrt(squares / (double)(n - 3))};
    return weight > 0;
}

/* Fits the drift. Excludes up to a quarter of the blocks, the largest residual first, until the
 * rest agrees. */
static bool fit_block_drift(image_block *parts, size_t *n, const region *all, double length,
                            drift_plane found[2])
{
    const size_t least = *n - *n / 4;
    for (;;) {
        if (*n < MIN_PARTS || !fit_drift(parts, *n, 0, all, length, &found[0]) ||
            !fit_drift(parts, *n, 1, all, length, &found[1]))
            return false;
        if (hypot(found[0].rms, found[1].rms) < 0.5)
            return true;
        if (*n == least)
            return false;
        size_t worst = 0;
        double most = -1;
        for (size_t k = 0; k < *n; k++) {
            double deviation[2];
            for (int axis = 0; axis < 2; axis++)
                deviation[axis] = parts[k].shift[axis] - found[axis].at -
                                  found[axis].gradient[0] * (parts[k].x - all->x) -
                                  found[axis].gradient[1] * (parts[k].y - all->y);
            if (hypot(deviation[0], deviation[1]) > most) {
                most = hypot(deviation[0], deviation[1]);
                worst = k;
            }
        }
        parts[worst] = parts[--*n];
    }
}

spot_shift spot_align(const wt_height_map *before, const wt_height_map *after, double x, double y,
                      double radius)
{
    const region all = {{0, before->nx}, {0, before->ny}, x, y, radius};
    const double length = fmax((double)before->nx * before->dx, (double)before->ny * before->dy);
    long whole[2] = {0, 0};
    image_block parts[PARTS];
    drift_plane d[2];
    spot_shift shift = {.x = (double)NAN,
                        .y = (double)NAN,
                        .x_error = (double)NAN,
                        .y_error = (double)NAN,
                        .overlap = (double)NAN};
    wt_height_map cut = {.z = NULL};
    size_t n = 0;
    blank_disc(before, &all, &cut);
    const bool found = find_pixel_shift(&cut, after, &all, whole);
    if (found)
        n = find_block_shifts(before, &cut, after, &all, whole, parts);
    free((void *)cut.z);
    if (!found)
        return shift;
    const double left[2] = {fmax(0, -(double)whole[0]), fmax(0, -(double)whole[1])},
                 right[2] = {fmin((double)before->nx, (double)after->nx - (double)whole[0]),
                             fmin((double)before->ny, (double)after->ny - (double)whole[1])};
    shift.overlap =
        (right[0] - left[0]) * (right[1] - left[1]) / ((double)before->nx * (double)before->ny);
    if (!fit_block_drift(parts, &n, &all, length, d))
        return shift;
    shift.blocks = n;
    shift.degrees = n - 3;
    shift.found = true;
    shift.x = d[0].at * before->dx;
    shift.y = d[1].at * before->dy;
    shift.x_error = d[0].error * before->dx;
    shift.y_error = d[1].error * before->dy;
    for (int k = 0; k < 2; k++) {
        shift.gradient[0][k] = d[0].gradient[k] * before->dx;
        shift.gradient[1][k] = d[1].gradient[k] * before->dy;
    }
    shift.at_x = x;
    shift.at_y = y;
    return shift;
}

/* ---- the second image on the pixels of the first --------------------------------------------- */

wt_height_map spot_resample(const wt_height_map *field, double dx, double dy)
{
    wt_height_map to = {NULL,
                        (size_t)floor((double)(field->nx - 1) * field->dx / dx) + 1,
                        (size_t)floor((double)(field->ny - 1) * field->dy / dy) + 1,
                        dx,
                        dy,
                        false};
    double *z = wt_alloc(to.nx * to.ny, sizeof *z);
    for (size_t j = 0; j < to.ny; j++)
        for (size_t i = 0; i < to.nx; i++)
            z[j * to.nx + i] = spot_interpolate_height(field, (double)i * dx / field->dx,
                                                       (double)j * dy / field->dy);
    to.z = z;
    return to;
}

void spot_difference(const wt_height_map *before, const wt_height_map *after,
                     const spot_shift *shift, double *difference)
{
    for (size_t j = 0; j < before->ny; j++)
        for (size_t i = 0; i < before->nx; i++) {
            const double u = (double)i * before->dx - shift->at_x,
                         v = (double)j * before->dy - shift->at_y;
            const double x = shift->x + shift->gradient[0][0] * u + shift->gradient[0][1] * v,
                         y = shift->y + shift->gradient[1][0] * u + shift->gradient[1][1] * v;
            difference[j * before->nx + i] =
                spot_interpolate_height(after, (double)i + x / before->dx,
                                        (double)j + y / before->dy) -
                before->z[j * before->nx + i];
        }
}
