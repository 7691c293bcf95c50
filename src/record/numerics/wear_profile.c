/* Wear track in a profile across it, and Hertzian contact of a ball: nominal pressure, load and
 * duty of a point of the track.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "weartrack/record.h"

#include <gsl/gsl_fit.h>
#include <math.h>

wt_ball_contact wt_ball_contact_compute(double load, double radius, double modulus,
                                        double poisson_ratio)
{
    const double a = cbrt(0.75 * load * radius * (1 - poisson_ratio * poisson_ratio) / modulus);
    return (wt_ball_contact){a, load / (M_PI * a * a)};
}

double wt_ball_load(double pressure, double radius, double modulus, double poisson_ratio)
{
    const double a =
        0.75 * M_PI * pressure * radius * (1 - poisson_ratio * poisson_ratio) / modulus;
    return M_PI * a * a * pressure;
}

double wt_ball_duty(double contact_radius, double track_radius, double aside)
{
    const double y = aside / contact_radius, part = 1 - y * y;
    return 3 * contact_radius / (8 * track_radius) * (part < 0 ? 0 : part);
}

enum { FEWEST = 40 };            /* ten in each quarter */
static const double outside = 3; /* standard deviations that indicate a track */

/* Area of the part above 0 between two samples. The linear segment is cut at zero. */
static double area_above(double width, double a, double b)
{
    return 0.5 * width * (fmax(a, 0) + fmax(b, 0));
}

/* Standard error of the area below the base line. The error of the line follows from the slow
 * scatter of the outer quarters. Within the track the samples scatter, too. */
static wt_status find_area_error(const double *r, size_t n, size_t quarter, const double *x,
                                 wt_track *track, wt_error *err)
{
    wt_steady left, right;
    wt_status status = wt_steady_mean(r, quarter, &left, err);
    if (status == WT_OK)
        status = wt_steady_mean(r + n - quarter, quarter, &right, err);
    if (status != WT_OK)
        return status;
    const double width = track->to - track->from, step = (x[n - 1] - x[0]) / (double)(n - 1),
                 slow = 0.5 * (left.correlation + right.correlation),
                 line = 0.5 * hypot(left.mean.standard_error, right.mean.standard_error),
                 own = track->scatter * sqrt(slow * step / width);
    track->area.standard_error = width * hypot(line, own);
    return WT_OK;
}

static wt_status measure_track(const double *x, const double *r, size_t n, size_t quarter,
                               wt_track *track, wt_error *err)
{
    size_t first = n, last = 0;
    for (size_t i = 0; i < n; i++) {
        /* two successive samples: a single one in a few hundred is scatter */
        if (i > 0 && fmax(r[i - 1], r[i]) < -outside * track->scatter) {
            first = first == n ? i - 1 : first;
            last = i;
        }
        if (-r[i] > track->depth) {
            track->depth = -r[i];
            track->at = x[i];
        }
    }
    if (first == n || last == first)
        return WT_OK;
    track->found = true;
    track->from = x[first];
    track->to = x[last];
    track->area = (wt_estimate){0, 0, 0, "m^2"};
    track->ridges = 0;
    for (size_t i = first; i < last; i++) {
        track->area.value += area_above(x[i + 1] - x[i], -r[i], -r[i + 1]);
        track->ridges += area_above(x[i + 1] - x[i], r[i], r[i + 1]);
    }
    return find_area_error(r, n, quarter, x, track, err);
}

wt_status wt_track_find(const double *x, const double *z, size_t n, wt_track *track, wt_error *err)
{
    const double none = (double)NAN;
    const size_t quarter = n / 4;
    arena memory = {0};
    *track = (wt_track){.at = none,
                        .from = none,
                        .to = none,
                        .area = {none, none, 0, "m^2"},
                        .ridges = none,
                        .depth = 0};
    if (n < FEWEST) {
        wt_fail(err, WT_E_RANGE, "a profile of so few points shows no wear track");
        wt_error_expected(err, "%d points or more", FEWEST);
        wt_error_found(err, "%zu", n);
        return WT_E_RANGE;
    }
    double *const bx = arena_numbers(&memory, 2 * quarter),
                  *const bz = arena_numbers(&memory, 2 * quarter),
                  *const r = arena_numbers(&memory, n);
    double c00, c01, c11, squares;
    for (size_t i = 0; i < quarter; i++) {
        bx[i] = x[i];
        bz[i] = z[i];
        bx[quarter + i] = x[n - quarter + i];
        bz[quarter + i] = z[n - quarter + i];
    }
    gsl_fit_linear(bx, 1, bz, 1, 2 * quarter, &track->intercept, &track->slope, &c00, &c01, &c11,
                   &squares);
    track->scatter = sqrt(squares / (double)(2 * quarter - 1));
    for (size_t i = 0; i < n; i++)
        r[i] = z[i] - track->intercept - track->slope * x[i];
    const wt_status status = measure_track(x, r, n, quarter, track, err);
    arena_free(&memory);
    return status;
}
