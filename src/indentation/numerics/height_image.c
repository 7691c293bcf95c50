/* Height images at a position: planes and their residuals.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/height_image.h"

#include "core/math/cholesky.h"

#include <float.h>
#include <math.h>

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
    double m[3][3], v[3], plane[3], squares;
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
    const double singular = 9 * DBL_EPSILON; /* relative rounding error of previous unknowns */
    if (s.n < SPOT_MIN_PIXELS || !cholesky_solve(&s.m[0][0], 3, 3, singular, s.v))
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
