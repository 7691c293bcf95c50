/* Finds the peaks and the onset of the fall of a curve, and interpolates between its points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/gaussian_process.h"

#include "core/math/root.h"
#include "core/math/students_t.h"
#include "weartrack/dma.h"

#include <math.h>
#include <stdlib.h>

/* ---- onset ----------------------------------------------------------------------------------- */

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
    const wt_status status = gaussian_process_new(x, z, n, &s, err);
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

/* ---- peaks ----------------------------------------------------------------------------------- */

/* The fit includes points above this share of the height. A Gaussian has its inflection there,
 * which a parabola cannot follow. */
static const double peak_share = 0.6;
/* The fit needs nine points, three times the constants of a parabola. A largest point among the
 * outer two may belong to a continuing rise. */
enum { LEAST = 9, FROM_END = 2 };
/* A valley separates two maxima if the values rise by this factor on both sides. This is ten
 * times the scatter of a careful sweep. */
static const double valley_rise_ratio = 1.1;
/* Points that interpolate a value. Less three constants they determine their scatter to 20 %; half
 * as many would do so to 35 %. */
enum { NEIGHBOURS = 15 };
/* Positions at which the sign of the slope is tested, far more than a curve of few points has
 * maxima. Bisection ends at 1e-12 of a step. */
enum { GRID = 100, HALVINGS = 40 };

static void set_no_peak(wt_peak *peak, const char *reason)
{
    *peak = (wt_peak){.at = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                      .height = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                      .misfit = (double)NAN,
                      .reason = reason};
}

/* Selects the points around the largest one: first index and end index. */
static void select_peak_points(const double *y, size_t n, size_t top, size_t *first, size_t *last)
{
    *first = top;
    *last = top + 1;
    while (*first > 0 && y[*first - 1] > peak_share * y[top])
        --*first;
    while (*last < n && y[*last] > peak_share * y[top])
        ++*last;
    while (*last - *first < LEAST && *last - *first < n) {
        if (*first > 0 && (*last == n || y[*first - 1] >= y[*last]))
            --*first;
        else
            ++*last;
    }
}

/* ---- position of a maximum ------------------------------------------------------------------- */

static double falling_probability(const gaussian_process *s, double x)
{
    return gaussian_process_probability_below(s, x, GP_SLOPE, 0);
}

typedef struct slope_level {
    const gaussian_process *s;
    double level;
} slope_level;

static bool is_fall_probability_below(double x, void *user)
{
    const slope_level *l = user;
    return falling_probability(l->s, x) < l->level;
}

/* Returns the position at which the probability of a falling curve equals `level`. */
static double slope_crossing(const gaussian_process *s, double low, double high, double level)
{
    slope_level l = {s, level};
    root_bisect(is_fall_probability_below, &l, &low, &high, 0, HALVINGS);
    return 0.5 * (low + high);
}

/* Finds the maximum nearest to the largest point. The limits are where the curve rises or falls
 * with 97.5 % probability; NaN if undetermined. */
static wt_interval find_maximum(const gaussian_process *s, double from, double to, double largest)
{
    const double step = (to - from) / GRID;
    double probable[GRID + 1];
    wt_interval top = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    long at = -1;
    for (int i = 0; i <= GRID; i++)
        probable[i] = falling_probability(s, from + i * step);
    for (long i = 0; i < GRID; i++)
        if (probable[i] < 0.5 && probable[i + 1] >= 0.5 &&
            (at < 0 ||
             fabs(from + (double)i * step - largest) < fabs(from + (double)at * step - largest)))
            at = i;
    if (at < 0)
        return top;
    top.value = slope_crossing(s, from + (double)at * step, from + (double)(at + 1) * step, 0.5);
    long low = at, high = at + 1;
    while (low >= 0 && probable[low] > 0.025)
        low--;
    while (high <= GRID && probable[high] < 0.975)
        high++;
    if (low >= 0)
        top.low =
            slope_crossing(s, from + (double)low * step, from + (double)(low + 1) * step, 0.025);
    if (high <= GRID)
        top.high =
            slope_crossing(s, from + (double)(high - 1) * step, from + (double)high * step, 0.975);
    top.standard_error = (top.high - top.low) / (2 * NORMAL_95);
    return top;
}

/* ---- peak ------------------------------------------------------------------------------------ */

static double relative_misfit(const gaussian_process *s, const double *x, const double *z, size_t n)
{
    double squares = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = z[i] - gaussian_process_mean(s, x[i], GP_VALUE);
        squares += off * off;
    }
    return sqrt(squares / (double)n);
}

/* Locates the peak of n points. z: ln y relative to the largest point. */
static wt_status locate_peak(const double *x, const double *z, size_t n, double largest_x,
                             double largest_y, wt_peak *peak, wt_error *err)
{
    gaussian_process s;
    wt_status status = gaussian_process_new(x, z, n, &s, err);
    if (status == WT_OK) {
        peak->at = find_maximum(&s, x[0], x[n - 1], largest_x);
        peak->n = n;
    }
    peak->found =
        status == WT_OK && !isnan(peak->at.value) && !isnan(peak->at.low) && !isnan(peak->at.high);
    if (status == WT_OK && !peak->found) {
        set_no_peak(peak, "no peak above the scatter of the points");
    } else if (status == WT_OK) {
        const wt_interval height = gaussian_process_interval(&s, peak->at.value);
        peak->misfit = relative_misfit(&s, x, z, n);
        peak->height =
            (wt_interval){.value = largest_y * exp(height.value),
                          .low = largest_y * exp(height.low),
                          .high = largest_y * exp(height.high),
                          .standard_error = largest_y * height.standard_error * exp(height.value)};
        peak->reason = "";
    }
    gaussian_process_free(&s);
    return status;
}

wt_status wt_peak_find(const double *x, const double *y, size_t n, wt_peak *peak, wt_error *err)
{
    size_t top = 0, first, last;
    set_no_peak(peak, "fewer than 5 points");
    if (n < GP_MIN_POINTS)
        return WT_OK;
    for (size_t i = 1; i < n; i++)
        top = y[i] > y[top] ? i : top;
    if (top < FROM_END || top + FROM_END >= n) {
        set_no_peak(peak, top < FROM_END ? "no peak in range: largest at the lowest temperatures"
                                         : "no peak in range: largest at the highest temperatures");
        return WT_OK;
    }
    select_peak_points(y, n, top, &first, &last);
    double *z = wt_alloc(last - first, sizeof *z);
    for (size_t i = first; i < last; i++)
        z[i - first] = log(y[i] / y[top]);
    const wt_status status = locate_peak(x + first, z, last - first, x[top], y[top], peak, err);
    free(z);
    return status;
}

/* ---- other peaks ----------------------------------------------------------------------------- */

typedef struct peak_list {
    const double *x, *y;
    size_t main_index; /* the largest of all points */
    wt_peak *peaks;
    size_t n, most;
} peak_list;

/* Returns the lowest point between `from` and `to` if the values rise again beyond it, otherwise
 * `from`. */
static size_t find_valley(const double *y, size_t from, size_t to)
{
    size_t lowest = from;
    for (size_t i = from; i != to; i += to > from ? 1 : (size_t)-1) {
        lowest = y[i] < y[lowest] ? i : lowest;
        if (lowest != from && y[i] >= valley_rise_ratio * y[lowest])
            return lowest;
    }
    return from;
}

/* Adds the peaks of the points [first, last), split at valleys. The main peak is skipped. */
static wt_status add_secondary_peaks(peak_list *list, size_t first, size_t last, wt_error *err)
{
    const double *y = list->y;
    if (last - first < LEAST)
        return WT_OK;
    size_t top = first;
    for (size_t i = first; i < last; i++)
        top = y[i] > y[top] ? i : top;
    const size_t cold = find_valley(y, top, first), warm = find_valley(y, top, last - 1);
    wt_status status = cold != top ? add_secondary_peaks(list, first, cold + 1, err) : WT_OK;
    if (status == WT_OK && top != list->main_index && list->n < list->most) {
        const size_t from = cold != top ? cold : first, to = warm != top ? warm + 1 : last;
        wt_peak *peak = &list->peaks[list->n];
        status = to - from >= LEAST ? wt_peak_find(list->x + from, y + from, to - from, peak, err)
                                    : WT_OK;
        list->n += status == WT_OK && to - from >= LEAST && peak->found;
    }
    return status == WT_OK && warm != top ? add_secondary_peaks(list, warm, last, err) : status;
}

wt_status wt_secondary_peaks(const double *x, const double *y, size_t n, size_t most,
                             wt_peak *peaks, size_t *n_peaks, wt_error *err)
{
    peak_list list = {.x = x, .y = y, .peaks = peaks, .most = most};
    for (size_t i = 1; i < n; i++)
        list.main_index = y[i] > y[list.main_index] ? i : list.main_index;
    const wt_status status = add_secondary_peaks(&list, 0, n, err);
    *n_peaks = status == WT_OK ? list.n : 0;
    return status;
}

/* ---- between points -------------------------------------------------------------------------- */

wt_status wt_smooth_interpolate(const double *x, const double *y, size_t n, double at,
                                wt_interval *value, wt_error *err)
{
    *value = (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    if (n < GP_MIN_POINTS || at < x[0] || at > x[n - 1])
        return WT_OK;
    const size_t most = n < NEIGHBOURS ? n : NEIGHBOURS;
    size_t first = 0;
    while (first + most < n && at - x[first] > x[first + most] - at)
        first++;
    double z[NEIGHBOURS];
    for (size_t i = 0; i < most; i++)
        z[i] = log(y[first + i]);
    gaussian_process s;
    const wt_status status = gaussian_process_new(x + first, z, most, &s, err);
    if (status == WT_OK) {
        const wt_interval log_value = gaussian_process_interval(&s, at);
        value->value = exp(log_value.value);
        value->low = exp(log_value.low);
        value->high = exp(log_value.high);
        value->standard_error = value->value * log_value.standard_error;
    }
    gaussian_process_free(&s);
    return status;
}
