/* Job of a spot: roughness of a height image under the tip at its depth.
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "indentation/numerics/height_image.h"
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

/* Adjacent positions over the image, each `radius` from the next and from the edges. */
typedef struct spot_positions {
    size_t nx, ny;
    double radius;
} spot_positions;

/* ---- image and positions --------------------------------------------------------------------- */

/* Reads the height image that the job names from a file. Other images are freed. */
static wt_status spot_image_read(const wt_spot_job *job, const char *path, const wt_job *work,
                                 wt_image *image, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    flow_file file = {.path = path, .name = path, .set = &set};
    return flow_heights_read(&file, job->image, false, WT_ROLE_SPOT, work, image, err);
}

static spot_positions spot_positions_create(const wt_height_map *f, double radius)
{
    const double width = (double)(f->nx - 1) * f->dx, height = (double)(f->ny - 1) * f->dy;
    return (spot_positions){(size_t)fmax(0, floor(width / (2 * radius))),
                            (size_t)fmax(0, floor(height / (2 * radius))), radius};
}

/* Relative error of the contact area by the roughness that is still acceptable. The value is
 * chosen. */
static const double largest_effect = 0.1;

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
                         .read = wt_read_defaults()};
}

static const wt_param rows[] = {
    {PARAM("depth", wt_spot_job, depth, WT_Q_INDENTATION, ABOVE(0)), .value = "D",
     .flags = PARAM_REQUIRED | PARAM_NO_CASE,
     .help = SUCH_AS("indentation that the tip reached, ", "70nm", "")},
    {PARAM("at-x", wt_spot_job, x, WT_Q_LENGTH, ANY_NUMBER), .value = "X",
     .unset = "the middle of the image", .flags = PARAM_NO_CASE,
     .help = SUCH_AS("where it went in, in the coordinates of the image, ", "1.2um", "")},
    {PARAM("at-y", wt_spot_job, y, WT_Q_LENGTH, ANY_NUMBER), .value = "Y",
     .unset = "the middle of the image", .flags = PARAM_NO_CASE,
     .help = "where it went in, in the coordinates of the image"},
    {PARAM("position-error", wt_spot_job, position_error, WT_Q_LENGTH, AT_LEAST(0)), .value = "D",
     .unset = "one contact radius", .flags = PARAM_NO_CASE,
     .help = SUCH_AS("how far from there it may have entered, ", "50nm", "")},
    {PARAM_TEXT_OF("image", wt_spot_job, image), .value = "NAME",
     .unset = "the first image of heights", .flags = PARAM_NO_CASE,
     .help = "which image of a file: a part of its name, such as backward"},
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

static double roughness_limit(const spot *s)
{
    return s->power > 0 ? largest_effect / (2 * s->power) : (double)NAN;
}

/* Tests the roughness against its limit. The text "inconclusive" also states how to decide. */
static void assess_roughness(const wt_spot_job *job, const wt_height_map *f, bool covered, spot *s)
{
    const double limit = roughness_limit(s), low = s->low / job->depth, high = s->high / job->depth;
    char pixel[32], contact[32], required_pixel[32], search_radius[32];
    wt_format_si(fmax(f->dx, f->dy), "m", 3, pixel, sizeof pixel);
    wt_format_si(s->contact, "m", 3, contact, sizeof contact);
    wt_format_si(s->contact * sqrt(M_PI / (SPOT_MIN_PIXELS + 2)), "m", 2, required_pixel,
                 sizeof required_pixel);
    wt_format_si(s->contact + s->error, "m", 3, search_radius, sizeof search_radius);
    if (s->x < 0 || s->y < 0 || s->x > f->dx * (double)(f->nx - 1) ||
        s->y > f->dy * (double)(f->ny - 1))
        clocale_print(s->verdict, sizeof s->verdict,
                      "inconclusive: the place lies outside of the image; its coordinates in "
                      "the image would decide (--at-x, --at-y)");
    else if (isnan(s->plane.rms) && s->plane.n + s->plane.missing < SPOT_MIN_PIXELS)
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: pixels of %s are too coarse for a contact radius of %s (%zu in it, "
            "%d are needed); an image with pixels of %s or less would decide",
            pixel, contact, s->plane.n + s->plane.missing, SPOT_MIN_PIXELS, required_pixel);
    else if (!covered)
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: the contact radius of %s is not measured about each place that the "
            "tip may have entered (%d heights and nine tenths of its pixels); an image that "
            "has heights up to %s from the place would decide",
            contact, SPOT_MIN_PIXELS, search_radius);
    else if (isnan(limit))
        clocale_print(
            s->verdict, sizeof s->verdict,
            "inconclusive: the contact of this tip does not grow with its depth, so no limit "
            "follows from the depth; the roughness stands beside it for you to judge");
    else if (low > limit)
        clocale_print(s->verdict, sizeof s->verdict,
                      "no: the roughness is %.2g of the depth, above the limit of %.2g, where one "
                      "rms height of "
                      "depth makes %s of the contact area",
                      s->plane.rms / job->depth, limit, format_percent(largest_effect).text);
    else if (high <= limit)
        clocale_print(s->verdict, sizeof s->verdict,
                      "yes: the roughness is %.2g of the depth, the limit is %.2g",
                      s->plane.rms / job->depth, limit);
    else
        clocale_print(s->verdict, sizeof s->verdict,
                      "inconclusive: %s of the depth, depending on the place, and the limit is "
                      "%.2g; a better known position would decide (--position-error)",
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

TABLE_ROW(spot, SPOT, spot spot; wt_interval roughness, ratio; double x, y, depth, tilt, limit;)

TABLE_KEYS(spot, SPOT, const char *tip, *image, *verdict; wt_estimate effect;)

static wt_status add_spot_row(const wt_spot_job *job, const wt_image *image, const spot *s,
                              wt_table **table, wt_error *err)
{
    const double nan = (double)NAN, depth = job->depth, rms = s->plane.rms;
    const wt_interval none = {nan, nan, nan, nan};
    const bool has_roughness = !isnan(rms);
    char tip[256];
    table_writer t = table_begin(&spot_schema, err);
    TABLE_ADD(spot, &t, .spot = *s,
              .roughness = has_roughness ? (wt_interval){rms, nan, s->low, s->high} : none,
              .ratio = has_roughness
                           ? (wt_interval){rms / depth, nan, s->low / depth, s->high / depth}
                           : none,
              .x = s->x + image->x_min, .y = s->y + image->y_min, .depth = depth,
              .tilt = has_roughness ? hypot(s->plane.slope_x, s->plane.slope_y) : nan,
              .limit = roughness_limit(s));
    wt_tip_describe(&job->tip, tip, sizeof tip);
    TABLE_SET(spot, &t, tip, image->name, s->verdict, {largest_effect, 0, 0, NULL});
    return table_end(&t, table);
}

wt_status wt_spot_compute(const wt_spot_job *job, const char *path, const wt_job *work,
                          wt_table **table, wt_error *err)
{
    if (job == NULL || path == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no image of a spot");
    wt_image image = {.values = NULL};
    spot s = {0};
    wt_status status = param_check(wt_spot_job_params(), job, err);
    if (status == WT_OK)
        status = wt_tip_check(&job->tip, err);
    if (status == WT_OK)
        status = spot_image_read(job, path, work, &image, err);
    if (status == WT_OK) {
        const wt_height_map field = wt_image_height_map(&image);
        find_roughness(job, &image, &field, &s);
        status = add_spot_row(job, &image, &s, table, err);
    }
    cost_report(work, (cost_summary){.items = 1});
    wt_image_clear(&image);
    return status;
}
