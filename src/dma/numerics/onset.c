/* Finds the onset temperature of the fall of the storage modulus.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/gaussian_process.h"
#include "weartrack/dma.h"

#include <math.h>
#include <stdlib.h>

/* The glass tangent is laid where ln E' falls with this share of its steepest slope. Standards
 * leave this position to the eye; the slope of a glass is about a hundredth. */
static const double glass_share = 0.1;
/* The analysis covers these shares of the whole fall of ln E', extended by half its width on the
 * warm and twice on the cold side. It thus contains the glass and the steepest slope. */
static const double fall_begin = 0.1, fall_end = 0.6, warm_margin = 0.5, cold_margin = 2;
/* Positions at which slopes are compared: three per shortest correlation length. The cold
 * tangent lies between two of them. */
enum { POSITIONS = 41 };
/* A fall below a factor of 2 is no glass transition. Glass and rubber differ by two decades, or
 * half of one with much filler. */
static const double least_fall = 2;

static size_t steepest_index(const double *slope, size_t n)
{
    size_t at = 0;
    for (size_t i = 1; i < n; i++)
        at = slope[i] < slope[at] ? i : at;
    return at;
}

/* Integrates the slope from position a to position b by the trapezoidal rule. */
static double integrate_slope(const double *x, const double *slope, size_t a, size_t b)
{
    double sum = 0;
    for (size_t i = a; i < b; i++)
        sum += 0.5 * (slope[i] + slope[i + 1]) * (x[i + 1] - x[i]);
    return sum;
}

/* Returns the intersection of the tangents, or NaN if the steepest slope or the glass is not
 * inside. */
static double tangent_intersection(const double *x, const double *slope, size_t n)
{
    const size_t top = steepest_index(slope, n);
    const double steepest = slope[top], glass = glass_share * steepest;
    size_t cold = top;
    while (cold > 0 && slope[cold] < glass)
        cold--;
    if (!(steepest < 0) || top + 1 >= n || slope[cold] < glass)
        return (double)NAN;
    const double part = (glass - slope[cold]) / (slope[cold + 1] - slope[cold]),
                 at = x[cold] + part * (x[cold + 1] - x[cold]),
                 fall = integrate_slope(x, slope, cold + 1, top) +
                        0.5 * (glass + slope[cold + 1]) * (x[cold + 1] - at);
    /* ln E' = glass (T - at) meets ln E' = fall + steepest (T - x[top]). */
    return at + (fall - steepest * (x[top] - at)) / (glass - steepest);
}

/* Selects the points around the fall: first index and end index. */
static void select_fall_points(const double *x, const double *z, size_t n, size_t *first,
                               size_t *last)
{
    size_t top = 0, low = 0, begin, end;
    for (size_t i = 1; i < n; i++)
        top = z[i] > z[top] ? i : top;
    for (size_t i = low = top; i < n; i++)
        low = z[i] < z[low] ? i : low;
    const double fall = z[top] - z[low];
    for (end = top; end < low && z[end] > z[top] - fall_end * fall;)
        end++;
    for (begin = end; begin > top && z[begin] < z[top] - fall_begin * fall;)
        begin--;
    const double width = x[end] - x[begin];
    for (*first = begin; *first > 0 && x[*first - 1] >= x[begin] - cold_margin * width;)
        --*first;
    for (*last = end + 1; *last < n && x[*last] <= x[end] + warm_margin * width;)
        ++*last;
}

static wt_status locate_onset(const double *x, const double *z, size_t n, wt_onset *onset,
                              wt_error *err)
{
    double positions[POSITIONS];
    gaussian_process s;
    for (int i = 0; i < POSITIONS; i++)
        positions[i] = x[0] + (x[n - 1] - x[0]) * i / (POSITIONS - 1);
    const wt_status status = gaussian_process_new(x, z, n, false, &s, err);
    if (status == WT_OK)
        onset->at = gaussian_process_slope_interval(&s, positions, POSITIONS, tangent_intersection);
    gaussian_process_free(&s);
    if (status == WT_OK && !isnan(onset->at.value))
        *onset = (wt_onset){true, onset->at, n, ""};
    else
        onset->reason = "the points do not show both the glass and the steepest fall";
    return status;
}

wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset, wt_error *err)
{
    size_t first, last;
    *onset = (wt_onset){.at = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                        .reason = "fewer than 5 points"};
    if (n < GP_MIN_POINTS)
        return WT_OK;
    double *z = wt_alloc(n, sizeof *z), lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        z[i] = log(y[i]);
        lowest = fmin(lowest, z[i]);
        highest = fmax(highest, z[i]);
    }
    select_fall_points(x, z, n, &first, &last);
    wt_status status = WT_OK;
    if (highest - lowest < log(least_fall))
        onset->reason = "it falls by less than a factor 2";
    else if (last - first < GP_MIN_POINTS)
        onset->reason = "fewer than 5 points about its fall";
    else
        status = locate_onset(x + first, z + first, last - first, onset, err);
    free(z);
    return status;
}
