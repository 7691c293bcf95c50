/* Height images at a position: planes and their residuals, interpolated heights, depressions.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/height_image.h"

#include "core/math/cholesky.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* ---- planes ---------------------------------------------------------------------------------- */

/* Finds the first and last pixel of an axis within a distance of a position. Without pixels first >
 * last. */
static void pixel_span(double centre, double reach, double step, size_t n, size_t *first,
                       size_t *last)
{
    const double low = ceil((centre - reach) / step), high = floor((centre + reach) / step);
    *first = 1;
    *last = 0;
    if (!(high >= 0 && low <= (double)(n - 1)))
        return; /* such numbers may overflow */
    *first = low > 0 ? (size_t)low : 0;
    *last = high < (double)(n - 1) ? (size_t)high : n - 1;
}

bool spot_solve(size_t n, double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], double v[SPOT_UNKNOWNS])
{
    /* Relative tolerance for the rounding error of previous unknowns. */
    return cholesky_solve(&m[0][0], SPOT_UNKNOWNS, n, (double)(n * n) * DBL_EPSILON, v);
}

/* Calls `visit` for each pixel of a disc. u and v are in radii. */
typedef void disc_visit(void *user, double u, double v, double z);
static void visit_disc(const wt_height_map *f, double x, double y, double radius, disc_visit *visit,
                       void *user)
{
    size_t first[2], last[2];
    pixel_span(x, radius, f->dx, f->nx, &first[0], &last[0]);
    pixel_span(y, radius, f->dy, f->ny, &first[1], &last[1]);
    for (size_t j = first[1]; j <= last[1]; j++)
        for (size_t i = first[0]; i <= last[0]; i++) {
            const double u = (double)i * f->dx - x, v = (double)j * f->dy - y, r = hypot(u, v);
            if (r <= radius)
                visit(user, u / radius, v / radius, f->z[j * f->nx + i]);
        }
}

typedef struct plane_sums {
    double m[SPOT_UNKNOWNS][SPOT_UNKNOWNS], v[SPOT_UNKNOWNS], plane[3], squares;
    size_t n, missing;
} plane_sums;

static void add_pixel(void *user, double u, double v, double z)
{
    plane_sums *s = user;
    const double row[3] = {1, u, v};
    if (!isfinite(z)) {
        s->missing++;
        return;
    }
    s->n++;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            s->m[i][k] += row[i] * row[k];
        s->v[i] += row[i] * (z - s->plane[0]); /* minus one height, for precision */
    }
}

static void add_square(void *user, double u, double v, double z)
{
    plane_sums *s = user;
    const double residual = z - (s->plane[0] + s->plane[1] * u + s->plane[2] * v);
    if (isfinite(z))
        s->squares += residual * residual;
}

static void find_first_height(void *user, double u, double v, double z)
{
    double *height = user;
    (void)u;
    (void)v;
    if (isnan(*height) && isfinite(z))
        *height = z;
}

spot_plane spot_plane_fit(const wt_height_map *field, double x, double y, double radius)
{
    plane_sums s = {.plane = {(double)NAN, 0, 0}};
    spot_plane plane = {(double)NAN, (double)NAN, (double)NAN, (double)NAN, 0, 0};
    visit_disc(field, x, y, radius, find_first_height, &s.plane[0]);
    visit_disc(field, x, y, radius, add_pixel, &s);
    plane.n = s.n;
    plane.missing = s.missing;
    if (s.n < SPOT_MIN_PIXELS || !spot_solve(3, s.m, s.v))
        return plane;
    s.plane[0] += s.v[0];
    s.plane[1] = s.v[1];
    s.plane[2] = s.v[2];
    visit_disc(field, x, y, radius, add_square, &s);
    plane.height = s.plane[0];
    plane.slope_x = s.plane[1] / radius;
    plane.slope_y = s.plane[2] / radius;
    plane.rms = sqrt(s.squares / (double)(s.n - 3));
    return plane;
}

bool spot_disc_is_covered(const wt_height_map *f, double x, double y, double radius)
{
    const double width = (double)(f->nx - 1) * f->dx, height = (double)(f->ny - 1) * f->dy;
    if (x < radius || y < radius || x > width - radius || y > height - radius)
        return false;
    const spot_plane p = spot_plane_fit(f, x, y, radius);
    return p.n >= SPOT_MIN_PIXELS && 10 * p.missing <= p.n + p.missing;
}

/* ---- interpolation --------------------------------------------------------------------------- */

enum { INTERPOLATION_NODES = 6 }; /* nodes of a fifth-degree polynomial */

/* Weights of the polynomial through the pixels -2 .. 3, at 0 <= t < 1. */
static void polynomial_weights(double t, double w[INTERPOLATION_NODES])
{
    const double a = t + 2, b = t + 1, d = t - 1, e = t - 2, f = t - 3;
    w[0] = -b * t * d * e * f / 120;
    w[1] = a * t * d * e * f / 24;
    w[2] = -a * b * d * e * f / 12;
    w[3] = a * b * t * e * f / 12;
    w[4] = -a * b * t * d * f / 24;
    w[5] = a * b * t * d * e / 120;
}

double spot_interpolate_height(const wt_height_map *f, double i, double j)
{
    const double bi = floor(i), bj = floor(j);
    double wi[INTERPOLATION_NODES], wj[INTERPOLATION_NODES], sum = 0;
    if (!(bi >= 2) || !(bj >= 2) || bi + 3 > (double)(f->nx - 1) || bj + 3 > (double)(f->ny - 1))
        return (double)NAN;
    polynomial_weights(i - bi, wi);
    polynomial_weights(j - bj, wj);
    const double *corner = f->z + ((size_t)bj - 2) * f->nx + (size_t)bi - 2;
    for (size_t b = 0; b < INTERPOLATION_NODES; b++) {
        double row = 0;
        for (size_t a = 0; a < INTERPOLATION_NODES; a++)
            row += wi[a] * corner[b * f->nx + a];
        sum += wj[b] * row;
    }
    return sum;
}

/* ---- depressions ----------------------------------------------------------------------------- */

/* Rows around a position, each minus the line through its means from two to four radii on the left
 * and on the right. An offset of a scanned row is no depression. */
typedef struct patch {
    wt_height_map field;
    double x, y; /* position in the patch [m] */
    double *z;
} patch;

/* Mean position and height of the known pixels of a row from low to high [m]. Returns false if
 * there are none. */
static bool row_mean(const wt_height_map *f, size_t j, double low, double high, double *u,
                     double *z)
{
    size_t first, last, n = 0;
    pixel_span(0.5 * (low + high), 0.5 * (high - low), f->dx, f->nx, &first, &last);
    *u = *z = 0;
    for (size_t i = first; i <= last; i++) {
        const double value = f->z[j * f->nx + i];
        if (!isfinite(value))
            continue;
        n++;
        *u += ((double)i * f->dx - *u) / (double)n;
        *z += (value - *z) / (double)n;
    }
    return n > 0;
}

static void extract_patch(const wt_height_map *f, double x, double y, double radius, patch *to)
{
    size_t i[2], j[2];
    pixel_span(x, 2 * radius + INTERPOLATION_NODES * f->dx, f->dx, f->nx, &i[0], &i[1]);
    pixel_span(y, 2 * radius + INTERPOLATION_NODES * f->dy, f->dy, f->ny, &j[0], &j[1]);
    *to = (patch){{NULL, i[1] - i[0] + 1, j[1] - j[0] + 1, f->dx, f->dy, false},
                  x - (double)i[0] * f->dx,
                  y - (double)j[0] * f->dy,
                  NULL};
    double *z = to->z = wt_alloc(to->field.nx * to->field.ny, sizeof *z);
    to->field.z = to->z;
    for (size_t b = j[0]; b <= j[1]; b++) {
        double u[2] = {0}, h[2] = {0};
        const bool known = row_mean(f, b, x - 4 * radius, x - 2 * radius, &u[0], &h[0]) &&
                           row_mean(f, b, x + 2 * radius, x + 4 * radius, &u[1], &h[1]);
        for (size_t a = i[0]; a <= i[1]; a++) {
            const double t = known ? ((double)a * f->dx - u[0]) / (u[1] - u[0]) : (double)NAN;
            *z++ = f->z[b * f->nx + a] - ((1 - t) * h[0] + t * h[1]);
        }
    }
}

/* Mean depth within a radius. Counted pixels would blur the rim of the disc by a pixel and reduce
 * the depth of a depression of four pixels by 1 %. The function therefore sums rings with the
 * two-point Gauss rule in r^2. The result is NaN if more than a tenth is unknown. */
static double mean_depth(const patch *p, double radius)
{
    enum { MORE_RINGS = 8 }; /* a ring is at most an eighth of a pixel-wide disc */
    const double across = radius / fmin(p->field.dx, p->field.dy), gauss = 0.5 / sqrt(3);
    const size_t rings = 2 * ((size_t)ceil(across) + MORE_RINGS),
                 spokes = (size_t)ceil(2 * M_PI * across) + 2 * MORE_RINGS;
    double sum = 0;
    size_t n = 0;
    for (size_t k = 0; k < rings; k++) {
        const double at = (double)(k / 2) + 0.5 + (k % 2 == 0 ? -gauss : gauss),
                     r = radius * sqrt(2 * at / (double)rings);
        for (size_t a = 0; a < spokes; a++) {
            const double angle = 2 * M_PI * ((double)a + 0.5 * (double)(k % 2)) / (double)spokes,
                         z = spot_interpolate_height(&p->field,
                                                     (p->x + r * cos(angle)) / p->field.dx,
                                                     (p->y + r * sin(angle)) / p->field.dy);
            if (!isfinite(z))
                continue;
            sum -= z;
            n++;
        }
    }
    return 10 * n >= 9 * rings * spokes ? sum / (double)n : (double)NAN;
}

spot_depression spot_measure_depression(const wt_height_map *difference, double x, double y,
                                        double radius)
{
    patch p = {.z = NULL};
    if (!spot_disc_is_covered(difference, x, y, 4 * radius) ||
        !spot_disc_is_covered(difference, x, y, radius))
        return (spot_depression){(double)NAN, (double)NAN};
    extract_patch(difference, x, y, radius, &p);
    const spot_depression depression = {mean_depth(&p, radius),
                                        mean_depth(&p, 2 * radius) * M_PI * 4 * radius * radius};
    free(p.z);
    return depression;
}
