/* Residual imprint at a spot from an image after the indentation that is aligned with the image
 * before.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/spot.h"

#include "core/base/clocale.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>

/* Smallest number of reference positions. Largest ratio of pixel sizes and of image sides. Steps
 * per contact radius of the search for the deepest change, and search distance in contact radii. */
enum { MIN_REFERENCES = 8, MAX_SIZE_RATIO = 4, STEPS_PER_RADIUS = 4, SEARCH_RADII = 2 };

/* Factor of the 97.5 % quantile for the largest of several deviates. The largest of 50 normal
 * deviates exceeds a further one by 4.43 in 2.5 % of cases, a single one by 1.96. At most 50
 * independent discs fit in the search distance of two radii. */
static const double largest_of_many_factor = 4.43 / 1.96;

/* Value at the spot minus the mean of the reference positions. Their scatter is its error. */
static wt_interval subtract_reference_mean(double value, const double *others, size_t n)
{
    const moments m = sample_moments(others, n);
    const double error = sqrt(m.variance * (1 + 1 / (double)n)),
                 half_width = students_t_quantile((double)n - 1) * error;
    return (wt_interval){value - m.mean, error, value - m.mean - half_width,
                         value - m.mean + half_width};
}

/* Measures the depressions at reference positions. depth, volume: space for all positions. */
static void measure_references(const wt_height_map *difference, const spot *s,
                               const spot_positions *p, double *depth, double *volume, size_t *n)
{
    for (size_t k = 0; k < p->nx * p->ny; k++) {
        const double x = p->radius * (2 * (double)(k % p->nx) + 1),
                     y = p->radius * (2 * (double)(k / p->nx) + 1);
        if (hypot(x - s->x, y - s->y) < 6 * s->contact + s->error)
            continue;
        const spot_depression other = spot_measure_depression(difference, x, y, s->contact);
        if (isnan(other.depth) || isnan(other.volume))
            continue;
        depth[*n] = other.depth;
        volume[(*n)++] = other.volume;
    }
}

/* Finds the deepest change within the error of the position. */
static void find_deepest(const wt_height_map *difference, const spot *s, imprint *to)
{
    enum { MAX_SEARCH_STEPS = 24 }; /* steps to each side; limits the run time */
    const double search_radius = fmin(s->error, SEARCH_RADII * s->contact);
    const int steps =
        (int)fmin(MAX_SEARCH_STEPS, ceil(STEPS_PER_RADIUS * search_radius / s->contact));
    for (int k = 0; k < (2 * steps + 1) * (2 * steps + 1); k++) {
        const double x = s->x + search_radius * (k % (2 * steps + 1) - steps) / fmax(steps, 1),
                     y = s->y + search_radius * (k / (2 * steps + 1) - steps) / fmax(steps, 1);
        if (hypot(x - s->x, y - s->y) > search_radius * (1 + 1e-9))
            continue;
        const spot_depression depression = spot_measure_depression(difference, x, y, s->contact);
        if (isnan(depression.depth) || depression.depth <= to->deepest)
            continue;
        to->deepest = depression.depth;
        to->deepest_x = x;
        to->deepest_y = y;
    }
}

static void measure_imprint(const wt_height_map *difference, const spot *s, imprint *to)
{
    if (s->plane.n + s->plane.missing < SPOT_MIN_PIXELS)
        return; /* there are far more positions than pixels */
    const spot_positions p = spot_positions_create(difference, 2 * s->contact);
    double *depth = wt_alloc(2 * (p.nx * p.ny + 1), sizeof *depth);
    double *volume = depth + p.nx * p.ny + 1;
    const spot_depression imprint_value =
        spot_measure_depression(difference, s->x, s->y, s->contact);
    measure_references(difference, s, &p, depth, volume, &to->places);
    if (!isnan(imprint_value.depth) && !isnan(imprint_value.volume) &&
        to->places >= MIN_REFERENCES) {
        to->depth = subtract_reference_mean(imprint_value.depth, depth, to->places);
        to->volume = subtract_reference_mean(imprint_value.volume, volume, to->places);
        find_deepest(difference, s, to);
        to->deepest -= imprint_value.depth - to->depth.value;
    }
    free(depth);
}

static void describe_failed_shift(const imprint *to, char *verdict, size_t size)
{
    if (isnan(to->shift.overlap))
        clocale_print(
            verdict, size,
            "inconclusive: there is no shift at which a quarter of the images has heights of "
            "both; images of the same place would tell");
    else
        clocale_print(
            verdict, size,
            "inconclusive: the parts of the images do not agree how one lies beside the other "
            "(overlap at the best shift %.0f %%); images of the same place that show more "
            "around it would tell",
            100 * to->shift.overlap);
}

/* True if the change is significantly deeper than at the spot and than 0. Positions on the lines of
 * a depression look higher than they are. */
static bool is_deeper_elsewhere(const imprint *to)
{
    return to->deepest - fmax(to->depth.value, 0) >
           largest_of_many_factor * (to->depth.high - to->depth.value);
}

static void describe_deeper_position(const wt_image *before, const imprint *to, char *verdict,
                                     size_t size)
{
    char depth[32], x[32], y[32];
    wt_format_si(to->deepest, "m", 3, depth, sizeof depth);
    wt_format_si(to->deepest_x + before->x_min, "m", 4, x, sizeof x);
    wt_format_si(to->deepest_y + before->y_min, "m", 4, y, sizeof y);
    clocale_print(verdict, size,
                  "inconclusive: the change is deepest (%s) at x %s, y %s, within the error of the "
                  "position; that place instead would tell (--at-x, --at-y)",
                  depth, x, y);
}

static void assess_imprint(const wt_image *before, const spot *s, imprint *to)
{
    char depth[32], error[32], high[32], around[32];
    wt_format_si(to->depth.value, "m", 3, depth, sizeof depth);
    wt_format_si(to->depth.standard_error, "m", 2, error, sizeof error);
    wt_format_si(to->depth.high, "m", 2, high, sizeof high);
    wt_format_si(4 * s->contact, "m", 3, around, sizeof around);
    if (!to->shift.found)
        describe_failed_shift(to, to->verdict, sizeof to->verdict);
    else if (isnan(to->depth.value) && to->places < MIN_REFERENCES)
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: %zu untouched places as large as the contact tell the error, %d are "
            "needed; images that show more around it or a better known position would tell",
            to->places, MIN_REFERENCES);
    else if (isnan(to->depth.value))
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: the images overlap in %.0f %%, and that does not hold %s about the "
            "place, four contact radii; images that do would tell",
            100 * to->shift.overlap, around);
    else if (!(to->depth.standard_error > 0))
        clocale_print(to->verdict, sizeof to->verdict,
                      "inconclusive: both images have the same heights; an image taken after the "
                      "indentation would tell");
    else if (to->depth.low > 0)
        clocale_print(to->verdict, sizeof to->verdict,
                      "yes: %s deep over the contact, on average, standard error %s", depth, error);
    else if (is_deeper_elsewhere(to))
        describe_deeper_position(before, to, to->verdict, sizeof to->verdict);
    else if (to->depth.high < 0)
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: the surface is higher after the indentation, or lower two to four "
            "contact radii beside the place; a third image would tell whether it stays");
    else
        clocale_print(to->verdict, sizeof to->verdict,
                      "none is seen%s: at most %s over the contact, on average",
                      s->error > SEARCH_RADII * s->contact ? " within two contact radii" : "",
                      high);
}

/* Checks the image sizes. Different pixel sizes are resampled; very different images are rejected.
 */
static wt_status check_image_sizes(const wt_image *a, const wt_image *b, const char *path,
                                   wt_error *err)
{
    const wt_height_map f = wt_image_height_map(a), g = wt_image_height_map(b);
    const double ratios[] = {f.dx / g.dx, f.dy / g.dy, a->width / b->width, a->height / b->height};
    bool good = true;
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++)
        good = good && ratios[i] >= 1.0 / MAX_SIZE_RATIO && ratios[i] <= MAX_SIZE_RATIO;
    if (good)
        return WT_OK;
    char size[4][32];
    const double sizes[] = {a->width, a->height, b->width, b->height};
    for (size_t i = 0; i < 4; i++)
        wt_format_si(sizes[i], "m", 4, size[i], sizeof size[i]);
    const wt_status status = wt_fail(
        err, WT_E_RANGE, "the image after the indentation is too different from the one before");
    wt_error_file(err, path);
    wt_error_expected(err, "sides and pixels within %d times of %zu x %zu pixels over %s x %s",
                      MAX_SIZE_RATIO, a->n_columns, a->n_rows, size[0], size[1]);
    wt_error_found(err, "%zu x %zu pixels over %s x %s", b->n_columns, b->n_rows, size[2], size[3]);
    wt_error_advice(err, "take an image of the same area with as many pixels");
    return status;
}

static double largest_strain(const double g[2][2])
{
    /* Largest singular value of the gradient. */
    const double sum = hypot(g[0][0] + g[1][1], g[1][0] - g[0][1]),
                 difference = hypot(g[0][0] - g[1][1], g[1][0] + g[0][1]);
    return 0.5 * (sum + difference);
}

/* Compares two images with equal pixels. */
static void compare_images(const wt_height_map *before, const wt_height_map *after, const spot *s,
                           imprint *to)
{
    to->shift = spot_align(before, after, s->x, s->y, 3 * s->contact);
    if (!to->shift.found)
        return;
    to->difference = wt_alloc(before->nx * before->ny, sizeof *to->difference);
    spot_difference(before, after, &to->shift, to->difference);
    wt_height_map changed = *before;
    changed.z = to->difference;
    to->strain = largest_strain((const double(*)[2])to->shift.gradient);
    measure_imprint(&changed, s, to);
}

imprint spot_empty_imprint(void)
{
    const double nan = (double)NAN;
    const wt_interval unknown = {nan, nan, nan, nan};
    return (imprint){.shift = {.overlap = nan},
                     .strain = nan,
                     .depth = unknown,
                     .volume = unknown,
                     .deepest = nan,
                     .deepest_x = nan,
                     .deepest_y = nan};
}

wt_status spot_imprint_find(const wt_spot_job *job, const wt_image *before, const spot *s,
                            const wt_job *work, imprint *to, wt_error *err)
{
    wt_image after = {.values = NULL};
    wt_height_map resampled = {.z = NULL};
    *to = spot_empty_imprint();
    wt_status status = spot_image_read(job, job->after, "after", work, &after, err);
    if (status == WT_OK)
        status = check_image_sizes(before, &after, job->after, err);
    if (status == WT_OK) {
        const wt_height_map first = wt_image_height_map(before),
                            second = wt_image_height_map(&after);
        const bool same =
            fabs(second.dx / first.dx - 1) < 1e-6 && fabs(second.dy / first.dy - 1) < 1e-6;
        if (!same)
            resampled = spot_resample(&second, first.dx, first.dy);
        compare_images(&first, same ? &second : &resampled, s, to);
        assess_imprint(before, s, to);
    }
    free((void *)resampled.z);
    wt_image_clear(&after);
    return status;
}
