/* Job of a spot: roughness of a height image under the tip at its depth, and the residual imprint
 * in an image after the indentation. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/base/param.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "indentation/numerics/height_image.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct spot {
    double x, y;           /* from the first pixel [m] */
    double contact, power; /* contact radius a [m]; d ln a / d ln depth */
    double error;          /* error of the position [m] */
    spot_plane plane;
    double low, high, median;
    char verdict[320];
} spot;

typedef struct imprint {
    spot_shift shift;
    double strain; /* largest change of the drift along the image, per length */
    wt_interval depth, volume;
    double deepest, deepest_x, deepest_y; /* from the first pixel [m] */
    size_t places;
    double *difference; /* at the pixels of the image before; NULL if not known; owned */
    char verdict[320];
} imprint;

/* Adjacent positions over the image, each `radius` from the next and from the edges. */
typedef struct spot_positions {
    size_t nx, ny;
    double radius;
} spot_positions;

/* ---- image and positions --------------------------------------------------------------------- */

/* Reads the height image that the job names from a file. Other images are freed. */
static wt_status spot_image_read(const wt_spot_job *job, const char *path, const char *role,
                                 const wt_job *work, wt_image *image, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    flow_file file = {.path = path, .name = path, .set = &set};
    return flow_heights_read(&file, job->image, false, role, work, image, err);
}

static spot_positions spot_positions_create(const wt_height_map *f, double radius)
{
    const double width = (double)(f->nx - 1) * f->dx, height = (double)(f->ny - 1) * f->dy;
    return (spot_positions){(size_t)fmax(0, floor(width / (2 * radius))),
                            (size_t)fmax(0, floor(height / (2 * radius))), radius};
}

/* ---- residual imprint ------------------------------------------------------------------------ */

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

/* True if the change is significantly deeper than at the spot and than 0. Positions on the lines of
 * a depression look higher than they are. */
static bool is_deeper_elsewhere(const imprint *to)
{
    return to->deepest - fmax(to->depth.value, 0) >
           largest_of_many_factor * (to->depth.high - to->depth.value);
}

static void assess_imprint(const wt_image *before, const spot *s, imprint *to)
{
    char depth[32], error[32], high[32], around[32], deepest[32], x[32], y[32];
    wt_format_si(to->depth.value, "m", 3, depth, sizeof depth);
    wt_format_si(to->depth.standard_error, "m", 2, error, sizeof error);
    wt_format_si(to->depth.high, "m", 2, high, sizeof high);
    wt_format_si(4 * s->contact, "m", 3, around, sizeof around);
    wt_format_si(to->deepest, "m", 3, deepest, sizeof deepest);
    wt_format_si(to->deepest_x + before->x_min, "m", 4, x, sizeof x);
    wt_format_si(to->deepest_y + before->y_min, "m", 4, y, sizeof y);
    if (!to->shift.found && isnan(to->shift.overlap))
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: there is no shift at which a quarter of the images has heights of "
            "both; images of the same place would tell");
    else if (!to->shift.found)
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: the parts of the images do not agree how one lies beside the other "
            "(overlap at the best shift %.0f %%); images of the same place that show more "
            "around it would tell",
            100 * to->shift.overlap);
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
        clocale_print(
            to->verdict, sizeof to->verdict,
            "inconclusive: the change is deepest (%s) at x %s, y %s, within the error of the "
            "position; that place instead would tell (--at-x, --at-y)",
            deepest, x, y);
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

/* Returns an imprint of unknown values, for a job without an image after the indentation. */
static imprint spot_empty_imprint(void)
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

/* Measures the change at the spot in the image job->after. */
static wt_status spot_imprint_find(const wt_spot_job *job, const wt_image *before, const spot *s,
                                   const wt_job *work, imprint *to, wt_error *err)
{
    wt_image after = {.values = NULL};
    wt_height_map resampled = {.z = NULL};
    wt_status status = spot_image_read(job, job->after, "after", work, &after, err);
    const size_t n = before->n_rows * before->n_columns;
    if (status == WT_OK && n == after.n_rows * after.n_columns &&
        flow_hash_samples(0, before->values, n) == flow_hash_samples(0, after.values, n))
        wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, "--after", job->after, NULL,
                      "the same samples as the image before it: a copy, which tells no change");
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

/* ---- map of the heights ---------------------------------------------------------------------- */

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

/* Creates the table spot_map: the heights around the spot, and with `difference` those after it.
 * `difference` may be NULL. */
static wt_status spot_map_create(const wt_height_map *before, const spot *s,
                                 const double *difference, wt_table **table, wt_error *err)
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

/* ---- parameters ------------------------------------------------------------------------------ */

/* Steps of the position within its error to each side. The function reports the range over 81
 * positions. */
enum { POSITION_STEPS = 4 };

wt_spot_job wt_spot_job_defaults(void)
{
    return (wt_spot_job){.depth = (double)NAN,
                         .x = (double)NAN,
                         .y = (double)NAN,
                         .position_error = (double)NAN,
                         .largest_effect = 0.1,
                         .read = wt_read_defaults()};
}

static const wt_param rows[] = {
    {PARAM("depth", wt_spot_job, depth, WT_Q_INDENTATION, ABOVE(0)), .value = "D",
     .flags = PARAM_REQUIRED | PARAM_NO_CASE,
     .help = "indentation that the tip reached, such as 70nm"},
    {PARAM("at-x", wt_spot_job, x, WT_Q_LENGTH, ANY_NUMBER), .value = "X",
     .unset = "the middle of the image", .flags = PARAM_NO_CASE,
     .help = "where it went in, in the coordinates of the image, such as 1.2um"},
    {PARAM("at-y", wt_spot_job, y, WT_Q_LENGTH, ANY_NUMBER), .value = "Y",
     .unset = "the middle of the image", .flags = PARAM_NO_CASE,
     .help = "where it went in, in the coordinates of the image"},
    {PARAM("position-error", wt_spot_job, position_error, WT_Q_LENGTH, AT_LEAST(0)), .value = "D",
     .unset = "one contact radius", .flags = PARAM_NO_CASE,
     .help = "how far from there it may have gone in, such as 50nm"},
    {PARAM("largest-effect", wt_spot_job, largest_effect, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X", .flags = PARAM_NO_CASE,
     .help = "relative error of the contact area by the roughness that is still fine"},
    {PARAM_TEXT_OF("image", wt_spot_job, image), .value = "NAME",
     .unset = "the first image of heights", .flags = PARAM_NO_CASE,
     .help = "which image of a file: a part of its name, such as backward"},
    {PARAM_TEXT_OF("after", wt_spot_job, after), .value = "FILE", .unset = "",
     .flags = PARAM_NO_CASE, .help = "image of the spot after the indentation"},
    {PARAM_FLAG_OF("map", wt_spot_job, map), .flags = PARAM_NO_CASE,
     .help =
         "the table spot_map, too: heights about the place before and after, of which weartrack "
         "report makes a figure"},
};
PARAM_TABLE(wt_spot_job_params, wt_spot_job, rows, wt_spot_job_defaults, NO_PARTS)

/* ---- roughness ------------------------------------------------------------------------------- */

static double contact_radius(const wt_tip *tip, double depth)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    return slope / 2;
}

/* Finds the range of the roughness. Returns false if a position is not covered by measured pixels.
 */
static bool find_roughness_range(const wt_height_map *f, spot *s)
{
    s->low = s->high = s->plane.rms;
    for (int j = -POSITION_STEPS; j <= POSITION_STEPS; j++)
        for (int i = -POSITION_STEPS; i <= POSITION_STEPS; i++) {
            const double u = s->error * i / POSITION_STEPS, v = s->error * j / POSITION_STEPS;
            if (hypot(u, v) > s->error)
                continue;
            if (!spot_disc_is_covered(f, s->x + u, s->y + v, s->contact))
                return false;
            const double rms = spot_plane_fit(f, s->x + u, s->y + v, s->contact).rms;
            s->low = fmin(s->low, rms);
            s->high = fmax(s->high, rms);
        }
    return true;
}

static void find_median_roughness(const wt_height_map *f, spot *s)
{
    const spot_positions p = spot_positions_create(f, s->contact);
    double *rms = wt_alloc((p.nx * p.ny + 1), sizeof *rms);
    size_t n = 0;
    for (size_t j = 0; j < p.ny; j++)
        for (size_t i = 0; i < p.nx; i++) {
            const double local_rms = spot_plane_fit(f, p.radius * (2 * (double)i + 1),
                                                    p.radius * (2 * (double)j + 1), s->contact)
                                         .rms;
            if (!isnan(local_rms))
                rms[n++] = local_rms;
        }
    s->median = n > 0 ? numbers_median(rms, n) : (double)NAN;
    free(rms);
}

static double roughness_limit(const wt_spot_job *job, const spot *s)
{
    return s->power > 0 ? job->largest_effect / (2 * s->power) : (double)NAN;
}

/* Tests the roughness against its limit. The text "inconclusive" also states how to decide. */
static void assess_roughness(const wt_spot_job *job, const wt_height_map *f, bool covered, spot *s)
{
    const double limit = roughness_limit(job, s), low = s->low / job->depth,
                 high = s->high / job->depth;
    char pixel[32], contact[32], required_pixel[32], search_radius[32];
    wt_format_si(fmax(f->dx, f->dy), "m", 3, pixel, sizeof pixel);
    wt_format_si(s->contact, "m", 3, contact, sizeof contact);
    wt_format_si(s->contact * sqrt(M_PI / (SPOT_MIN_PIXELS + 2)), "m", 2, required_pixel,
                 sizeof required_pixel);
    wt_format_si(s->contact + s->error, "m", 3, search_radius, sizeof search_radius);
    if (s->x < 0 || s->y < 0 || s->x > f->dx * (double)(f->nx - 1) ||
        s->y > f->dy * (double)(f->ny - 1))
        clocale_print(s->verdict, sizeof s->verdict,
                      "inconclusive: the place lies outside of the image; its coordinates, as the "
                      "image counts them, would tell (--at-x, --at-y)");
    else if (isnan(s->plane.rms) && s->plane.n + s->plane.missing < SPOT_MIN_PIXELS)
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: pixels of %s are too coarse for a contact radius of %s (%zu in it, "
            "%d are needed); an image with pixels of %s or less would tell",
            pixel, contact, s->plane.n + s->plane.missing, SPOT_MIN_PIXELS, required_pixel);
    else if (!covered)
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: the contact radius of %s is not measured about each place that the "
            "tip may have gone in (%d heights and nine tenths of its pixels); an image that has "
            "heights up to %s from the place would tell",
            contact, SPOT_MIN_PIXELS, search_radius);
    else if (isnan(limit))
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: the contact of this tip does not grow with its depth, so no limit "
            "follows from the depth; the roughness stands beside it for you to judge");
    else if (low > limit)
        clocale_print(
            s->verdict, sizeof s->verdict,
            "too rough: %.2g of the depth, above the limit of %.2g, where one rms height of "
            "depth makes %.2g %% of the contact area",
            s->plane.rms / job->depth, limit, 100 * job->largest_effect);
    else if (high <= limit)
        clocale_print(s->verdict, sizeof s->verdict,
                      "smooth enough: %.2g of the depth, the limit is %.2g",
                      s->plane.rms / job->depth, limit);
    else
        clocale_print(s->verdict, sizeof s->verdict,
                      "inconclusive: %s of the depth, depending on the place, and the limit is "
                      "%.2g; a better known position would tell (--position-error)",
                      format_range(low, high, 2).text, limit);
}

static void find_roughness(const wt_spot_job *job, const wt_image *image, const wt_height_map *f,
                           spot *s)
{
    const double step = 1e-3, depth = job->depth;
    s->contact = contact_radius(&job->tip, depth);
    s->power = (log(contact_radius(&job->tip, depth * exp(step))) -
                log(contact_radius(&job->tip, depth * exp(-step)))) /
               (2 * step);
    s->x = isnan(job->x) ? image->width / 2 : job->x - image->x_min;
    s->y = isnan(job->y) ? image->height / 2 : job->y - image->y_min;
    s->error = isnan(job->position_error) ? s->contact : job->position_error;
    s->plane = spot_plane_fit(f, s->x, s->y, s->contact);
    s->low = s->high = s->median = (double)NAN;
    const bool covered = find_roughness_range(f, s);
    if (covered)
        find_median_roughness(f, s);
    else
        s->plane.rms = (double)NAN;
    assess_roughness(job, f, covered, s);
}

/* ---- the table ------------------------------------------------------------------------------- */

TABLE_ROW(spot, SPOT, spot spot; imprint left; wt_interval roughness, ratio;
          wt_estimate shift_x, shift_y;
          double x, y, depth, tilt, limit, places, deepest_x, deepest_y;)

TABLE_KEYS(spot, SPOT, const char *tip, *image, *verdict; wt_estimate effect;)

static wt_status add_spot_row(const wt_spot_job *job, const wt_image *image, const spot *s,
                              const imprint *left, wt_table **table, wt_error *err)
{
    const double nan = (double)NAN, depth = job->depth, rms = s->plane.rms;
    const wt_interval none = {nan, nan, nan, nan};
    const bool has_roughness = !isnan(rms), found = left->shift.found;
    const spot_shift *shift = &left->shift;
    char tip[256];
    table_writer t = table_begin(&spot_schema, err);
    TABLE_ADD(
        spot, &t, .spot = *s, .left = *left,
        .roughness = has_roughness ? (wt_interval){rms, nan, s->low, s->high} : none,
        .ratio =
            has_roughness ? (wt_interval){rms / depth, nan, s->low / depth, s->high / depth} : none,
        .shift_x = {found ? shift->x : nan, found ? shift->x_error : nan, 0, NULL},
        .shift_y = {found ? shift->y : nan, found ? shift->y_error : nan, 0, NULL},
        .x = s->x + image->x_min, .y = s->y + image->y_min, .depth = depth,
        .tilt = has_roughness ? hypot(s->plane.slope_x, s->plane.slope_y) : nan,
        .limit = roughness_limit(job, s), .places = job->after != NULL ? (double)left->places : nan,
        .deepest_x = left->deepest_x + image->x_min, .deepest_y = left->deepest_y + image->y_min);
    if (job->after != NULL)
        spot_set_text(&t, SPOT_KEY_IMPRINT, left->verdict);
    wt_tip_describe(&job->tip, tip, sizeof tip);
    TABLE_SET(spot, &t, tip, image->name, s->verdict, {job->largest_effect, 0, 0, NULL});
    return table_end(&t, table);
}

void wt_spot_tables_clear(wt_spot_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->spot);
    wt_table_free(tables->spot_map);
    *tables = (wt_spot_tables){0};
}

wt_status wt_spot_compute(const wt_spot_job *job, const char *path, const wt_job *work,
                          wt_spot_tables *tables, wt_error *err)
{
    if (job == NULL || path == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no image of a spot");
    wt_image image = {.values = NULL};
    wt_height_map field = {.z = NULL};
    spot s = {0};
    imprint left = spot_empty_imprint();
    wt_spot_tables result = {0};
    wt_status status = param_check(wt_spot_job_params(), job, err);
    if (status == WT_OK)
        status = wt_tip_check(&job->tip, err);
    if (status == WT_OK)
        status = spot_image_read(job, path, "before", work, &image, err);
    if (status == WT_OK) {
        field = wt_image_height_map(&image);
        find_roughness(job, &image, &field, &s);
    }
    if (status == WT_OK && job->after != NULL)
        status = spot_imprint_find(job, &image, &s, work, &left, err);
    if (status == WT_OK)
        status = add_spot_row(job, &image, &s, &left, &result.spot, err);
    if (status == WT_OK && job->map)
        status = spot_map_create(&field, &s, left.difference, &result.spot_map, err);
    cost_report(work, (cost_summary){.items = 1});
    if (status == WT_OK)
        *tables = result;
    else
        wt_spot_tables_clear(&result);
    free(left.difference);
    wt_image_clear(&image);
    return status;
}
