/* Where the storage modulus begins to fall. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/gaussian_process.h"

#include <math.h>
#include <stdlib.h>

/* The glass is where the logarithm falls with this share of its steepest slope: a tenth, for the
 * standards leave to the eye where the tangent of the glass is laid, and that of a glass is a
 * hundredth or so. */
static const double glass_share = 0.1;
/* The fall is looked at between these shares of the whole one, in ln E', and as far again and twice
 * as far beside it: from the glass to past the steepest place. */
static const double begins = 0.1, ends = 0.6, warmer = 0.5, colder = 2;
/* Places where slopes are compared: three to a shortest length of the curve. The cold tangent is
 * between two of them. */
enum { PLACES = 41 };
/* A modulus that falls by less than a factor two on the way shows no glass transition: between
 * glass and rubber lie two decades, and half of one with much filler. */
static const double least_fall = 2;

static size_t steepest_of(const double *slope, size_t n)
{
    size_t at = 0;
    for (size_t i = 1; i < n; i++)
        at = slope[i] < slope[at] ? i : at;
    return at;
}

/* Integral of the slope from place `a` to place `b`, trapezia. */
static double fall_between(const double *x, const double *slope, size_t a, size_t b)
{
    double sum = 0;
    for (size_t i = a; i < b; i++)
        sum += 0.5 * (slope[i] + slope[i + 1]) * (x[i + 1] - x[i]);
    return sum;
}

/* Where the tangents meet; NaN if the steepest place or that of the glass is not within. */
static double meeting_place(const double *x, const double *slope, size_t n)
{
    const size_t top = steepest_of(slope, n);
    const double steepest = slope[top], glass = glass_share * steepest;
    size_t cold = top;
    while (cold > 0 && slope[cold] < glass)
        cold--;
    if (!(steepest < 0) || top + 1 >= n || slope[cold] < glass)
        return (double)NAN;
    const double part = (glass - slope[cold]) / (slope[cold + 1] - slope[cold]),
                 at = x[cold] + part * (x[cold + 1] - x[cold]),
                 fall = fall_between(x, slope, cold + 1, top) +
                        0.5 * (glass + slope[cold + 1]) * (x[cold + 1] - at);
    /* ln E' = glass (T - at) meets ln E' = fall + steepest (T - x[top]). */
    return at + (fall - steepest * (x[top] - at)) / (glass - steepest);
}

/* The points about the fall: first and one past the last. */
static void choose_fall(const double *x, const double *z, size_t n, size_t *first, size_t *last)
{
    size_t top = 0, low = 0, begin, end;
    for (size_t i = 1; i < n; i++)
        top = z[i] > z[top] ? i : top;
    for (size_t i = low = top; i < n; i++)
        low = z[i] < z[low] ? i : low;
    const double fall = z[top] - z[low];
    for (end = top; end < low && z[end] > z[top] - ends * fall;)
        end++;
    for (begin = end; begin > top && z[begin] < z[top] - begins * fall;)
        begin--;
    const double width = x[end] - x[begin];
    for (*first = begin; *first > 0 && x[*first - 1] >= x[begin] - colder * width;)
        --*first;
    for (*last = end + 1; *last < n && x[*last] <= x[end] + warmer * width;)
        ++*last;
}

static wt_status place_onset(const double *x, const double *z, size_t n, wt_onset *onset,
                             wt_error *err)
{
    double places[PLACES];
    gaussian_process s;
    for (int i = 0; i < PLACES; i++)
        places[i] = x[0] + (x[n - 1] - x[0]) * i / (PLACES - 1);
    wt_status status = gaussian_process_new(x, z, n, false, &s, err);
    if (status == WT_OK)
        status = smooth_of_slopes(&s, places, PLACES, meeting_place, &onset->at, err);
    gaussian_process_free(&s);
    if (status == WT_OK && !isnan(onset->at.value))
        *onset = (wt_onset){true, onset->at, n, ""};
    else
        onset->why_not = "the points do not show both the glass and the steepest fall";
    return status;
}

wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset, wt_error *err)
{
    size_t first, last;
    *onset = (wt_onset){.at = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                        .why_not = "fewer than 5 points"};
    if (n < SMOOTH_LEAST)
        return WT_OK;
    double *z = malloc(n * sizeof *z), lowest = HUGE_VAL, highest = -HUGE_VAL;
    if (z == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for an onset");
    for (size_t i = 0; i < n; i++) {
        z[i] = log(y[i]);
        lowest = fmin(lowest, z[i]);
        highest = fmax(highest, z[i]);
    }
    choose_fall(x, z, n, &first, &last);
    wt_status status = WT_OK;
    if (highest - lowest < log(least_fall))
        onset->why_not = "it falls by less than a factor 2";
    else if (last - first < SMOOTH_LEAST)
        onset->why_not = "fewer than 5 points about its fall";
    else
        status = place_onset(x + first, z + first, last - first, onset, err);
    free(z);
    return status;
}
