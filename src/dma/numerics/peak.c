/* Finds the peaks and the onset of the fall of a curve, and interpolates between its points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/base/array.h"
#include "core/math/cholesky.h"
#include "core/math/root.h"
#include "core/math/students_t.h"
#include "weartrack/dma.h"

#include <math.h>
#include <stdlib.h>

/* ---- a curve through points ------------------------------------------------------------------ */

/* A curve needs two points more than a parabola has terms. More than MOST_POINTS are merged with
 * their neighbours, which preserves all features wider than the shortest length; without that two
 * more of a hundred intervals of an onset miss it. */
enum { PARABOLA = 3, LEAST_POINTS = PARABOLA + 2, MOST_POINTS = 48 };
/* Sines over a range that extends beyond the points, which are -1 to 1, by half of it. The fastest
 * has six radians in the shortest length, so that its prior variance is below 1e-8 of the first. */
enum { SINES = 24, TERMS = PARABOLA + SINES };
static const double sine_range = 1.5;
/* Correlation lengths of the departure from a parabola, relative to half the range. They extend
 * from a quarter (below it the curve has as many slope changes as 15 points) to more than the
 * range. Ratios of its variance to the noise variance of a point extend from what ten points
 * resolve to exact data. The steps are so small that the weights change little between neighbours.
 */
static const double lengths[] = {0.25, 0.4, 0.6, 1.0, 1.6, 2.5};
static const double ratios[] = {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
enum { RATIOS = COUNT_OF(ratios), COMPONENTS = COUNT_OF(lengths) * RATIOS };
/* Components below this weight relative to the best one are dropped. All 48 together then weigh
 * less than a twentieth, which changes no shown digit. */
static const double negligible_weight = 1e-3;

/* Coefficients of the terms with one length and ratio. */
typedef struct curve_component {
    double weight, deviation;  /* of a point */
    double scale[TERMS];       /* prior deviations of the terms; 1: flat */
    double coefficient[TERMS]; /* of the scaled terms */
    double
        root[TERMS * TERMS]; /* Cholesky factor of their inverse covariance, over that of a point */
} curve_component;

/* A parabola and a Gaussian process, as a sum of sines (A. Solin and S. Särkkä, Stat. Comput. 30
 * (2020) 419), averaged over length and variance by restricted likelihood. */
typedef struct smooth_curve {
    double centre, half, freedom;
    size_t n; /* components */
    curve_component *components;
} smooth_curve;

/* Computes the terms at x, or their slopes. */
static void fill_terms(const smooth_curve *s, double x, bool slope, double term[TERMS])
{
    const double at = (x - s->centre) / s->half;
    term[0] = slope ? 0 : 1;
    term[1] = slope ? 1 / s->half : at;
    term[2] = slope ? 2 * at / s->half : at * at;
    for (int k = 0; k < SINES; k++) {
        const double rate = M_PI * (k + 1) / (2 * sine_range), angle = rate * (at + sine_range);
        term[PARABOLA + k] = slope ? rate / s->half * cos(angle) : sin(angle);
    }
}

/* Fits a component. Returns ln of its weight, or -HUGE_VAL if a matrix is singular. terms: [n *
 * TERMS]; normal: their products; right: those with y. */
static double fit_component(const double *terms, const double *y, size_t n, const double *normal,
                            const double *right, double length, double ratio, curve_component *c)
{
    double log_det = 0, squares = 0;
    for (size_t k = 0; k < TERMS; k++) {
        const double rate = M_PI * ((double)k + 1 - PARABOLA) / (2 * sine_range);
        c->scale[k] = k < PARABOLA ? 1
                                   : sqrt(ratio * sqrt(2 * M_PI) * length / sine_range) *
                                         exp(-0.25 * pow(rate * length, 2));
        c->coefficient[k] = c->scale[k] * right[k];
        for (size_t j = 0; j <= k; j++)
            c->root[k * TERMS + j] = c->scale[k] * c->scale[j] * normal[k * TERMS + j] +
                                     (j == k && k >= PARABOLA ? 1 : 0);
    }
    if (!cholesky_solve(c->root, TERMS, TERMS, 0, c->coefficient))
        return -HUGE_VAL;
    for (size_t k = 0; k < TERMS; k++) {
        log_det += 2 * log(c->root[k * TERMS + k]);
        squares += k < PARABOLA ? 0 : c->coefficient[k] * c->coefficient[k];
    }
    for (size_t i = 0; i < n; i++) {
        double off = y[i];
        for (size_t k = 0; k < TERMS; k++)
            off -= c->scale[k] * c->coefficient[k] * terms[i * TERMS + k];
        squares += off * off;
    }
    squares = fmax(squares, 1e-300);
    c->deviation = sqrt(squares / (double)(n - PARABOLA));
    return -0.5 * (log_det + (double)(n - PARABOLA) * log(squares));
}

/* Fits the curve to n points with x rising, at least LEAST_POINTS. The caller frees the
 * components. */
static smooth_curve fit_curve(const double *all_x, const double *all_y, size_t n_all)
{
    const size_t each = (n_all + MOST_POINTS - 1) / MOST_POINTS, n = (n_all + each - 1) / each;
    double x[MOST_POINTS], y[MOST_POINTS];
    for (size_t i = 0, from = 0; i < n; i++, from += each) {
        const size_t count = from + each < n_all ? each : n_all - from;
        x[i] = numbers_mean(all_x + from, count);
        y[i] = numbers_mean(all_y + from, count);
    }
    smooth_curve s = {.centre = 0.5 * (x[0] + x[n - 1]),
                      .half = x[n - 1] > x[0] ? 0.5 * (x[n - 1] - x[0]) : 1,
                      .freedom = (double)(n - PARABOLA),
                      .components = wt_alloc(COMPONENTS, sizeof *s.components)};
    double normal[TERMS * TERMS] = {0}, right[TERMS] = {0}, weight[COMPONENTS], best = -HUGE_VAL,
                          sum = 0, *terms = wt_alloc(n * TERMS, sizeof *terms);
    for (size_t i = 0; i < n; i++) {
        double *const term = terms + i * TERMS;
        fill_terms(&s, x[i], false, term);
        for (size_t k = 0; k < TERMS; k++) {
            right[k] += term[k] * y[i];
            for (size_t j = 0; j <= k; j++)
                normal[k * TERMS + j] += term[k] * term[j];
        }
    }
    for (size_t j = 0; j < COMPONENTS; j++) {
        weight[j] = fit_component(terms, y, n, normal, right, lengths[j / RATIOS],
                                  ratios[j % RATIOS], &s.components[j]);
        best = fmax(best, weight[j]);
    }
    for (size_t j = 0; j < COMPONENTS; j++)
        if (weight[j] > best + log(negligible_weight)) {
            s.components[s.n] = s.components[j];
            sum += s.components[s.n++].weight = exp(weight[j] - best);
        }
    for (size_t j = 0; j < s.n; j++)
        s.components[j].weight /= sum;
    free(terms);
    return s;
}

/* Returns a sum of terms of a component, and its directions of independent errors. */
static double component_sum(const curve_component *c, const double term[TERMS], double error[TERMS])
{
    double mean = 0;
    for (size_t k = 0; k < TERMS; k++) {
        error[k] = c->scale[k] * term[k];
        mean += error[k] * c->coefficient[k];
    }
    cholesky_forward(c->root, TERMS, TERMS, error, error);
    for (size_t k = 0; k < TERMS; k++)
        error[k] *= c->deviation;
    return mean;
}

/* Computes the distributions of the value or slope at x. */
static void curve_distribution(const smooth_curve *s, double x, bool slope,
                               mixture_component part[COMPONENTS])
{
    double term[TERMS], error[TERMS];
    fill_terms(s, x, slope, term);
    for (size_t j = 0; j < s->n; j++) {
        double square = 0;
        part[j].weight = s->components[j].weight;
        part[j].mean = component_sum(&s->components[j], term, error);
        for (size_t k = 0; k < TERMS; k++)
            square += error[k] * error[k];
        part[j].deviation = sqrt(square);
    }
}

static wt_interval curve_value(const smooth_curve *s, double x)
{
    mixture_component part[COMPONENTS];
    curve_distribution(s, x, false, part);
    return student_mixture_interval(part, s->n, s->freedom);
}

/* Returns the probability that the curve falls at x. */
static double falling_probability(const smooth_curve *s, double x)
{
    mixture_component part[COMPONENTS];
    curve_distribution(s, x, true, part);
    return mixture_probability(part, s->n, s->freedom, 0);
}

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

/* Maximum weight of components in which the onset is undefined: the share outside a 95 %
 * interval. */
static const double max_undefined_share = 0.05;

/* Finds the onset of one component from its slopes, and its error to first order. Returns false if
 * it is undefined. */
static bool component_onset(const smooth_curve *s, const curve_component *c, const double *x,
                            mixture_component *part)
{
    double slope[POSITIONS], moved[POSITIONS], error[POSITIONS][TERMS], term[TERMS], square = 0;
    for (int i = 0; i < POSITIONS; i++) {
        fill_terms(s, x[i], true, term);
        slope[i] = component_sum(c, term, error[i]);
    }
    const double mean = tangent_intersection(x, slope, POSITIONS);
    for (size_t k = 0; k < TERMS; k++) {
        double to[2];
        for (int side = 0; side < 2; side++) {
            for (int i = 0; i < POSITIONS; i++)
                moved[i] = slope[i] + (side == 0 ? error[i][k] : -error[i][k]);
            to[side] = tangent_intersection(x, moved, POSITIONS);
        }
        square += pow(isnan(to[0])   ? mean - to[1]
                      : isnan(to[1]) ? to[0] - mean
                                     : (to[0] - to[1]) / 2,
                      2);
    }
    *part = (mixture_component){c->weight, mean, sqrt(square)};
    return isfinite(mean) && isfinite(square);
}

static void locate_onset(const double *x, const double *z, size_t n, wt_onset *onset)
{
    double positions[POSITIONS], sum = 0;
    smooth_curve s = fit_curve(x, z, n);
    mixture_component part[COMPONENTS];
    size_t known = 0;
    for (int i = 0; i < POSITIONS; i++)
        positions[i] = x[0] + (x[n - 1] - x[0]) * i / (POSITIONS - 1);
    for (size_t j = 0; j < s.n; j++)
        if (component_onset(&s, &s.components[j], positions, &part[known]))
            sum += part[known++].weight;
    for (size_t i = 0; i < known; i++)
        part[i].weight /= sum;
    if (sum >= 1 - max_undefined_share)
        *onset = (wt_onset){true, student_mixture_interval(part, known, s.freedom), n, ""};
    else
        onset->reason = "the points do not show both the glass and the steepest fall";
    free(s.components);
}

wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset, wt_error *err)
{
    size_t first, last;
    (void)err;
    *onset = (wt_onset){.at = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                        .reason = "fewer than 5 points"};
    if (n < LEAST_POINTS)
        return WT_OK;
    double *z = wt_alloc(n, sizeof *z), lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        z[i] = log(y[i]);
        lowest = fmin(lowest, z[i]);
        highest = fmax(highest, z[i]);
    }
    select_fall_points(x, z, n, &first, &last);
    if (highest - lowest < log(least_fall))
        onset->reason = "it falls by less than a factor 2";
    else if (last - first < LEAST_POINTS)
        onset->reason = "fewer than 5 points about its fall";
    else
        locate_onset(x + first, z + first, last - first, onset);
    free(z);
    return WT_OK;
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

typedef struct slope_level {
    const smooth_curve *s;
    double level;
} slope_level;

static bool is_fall_probability_below(double x, void *user)
{
    const slope_level *l = user;
    return falling_probability(l->s, x) < l->level;
}

/* Returns the position at which the probability of a falling curve equals `level`. */
static double slope_crossing(const smooth_curve *s, double low, double high, double level)
{
    slope_level l = {s, level};
    root_bisect(is_fall_probability_below, &l, &low, &high, 0, HALVINGS);
    return 0.5 * (low + high);
}

/* Finds the maximum nearest to the largest point. The limits are where the curve rises or falls
 * with 97.5 % probability; NaN if undetermined. */
static wt_interval find_maximum(const smooth_curve *s, double from, double to, double largest)
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

static double relative_misfit(const smooth_curve *s, const double *x, const double *z, size_t n)
{
    double squares = 0;
    for (size_t i = 0; i < n; i++)
        squares += pow(z[i] - curve_value(s, x[i]).value, 2);
    return sqrt(squares / (double)n);
}

/* Returns the interval of a value with this logarithm. */
static wt_interval exponential(wt_interval z)
{
    return (wt_interval){exp(z.value), z.standard_error * exp(z.value), exp(z.low), exp(z.high)};
}

/* Locates the peak of n points. z: ln y. */
static void locate_peak(const double *x, const double *z, size_t n, double largest_x, wt_peak *peak)
{
    const smooth_curve s = fit_curve(x, z, n);
    const wt_interval at = find_maximum(&s, x[0], x[n - 1], largest_x);
    if (isnan(at.value) || isnan(at.low) || isnan(at.high))
        set_no_peak(peak, "no peak above the scatter of the points");
    else
        *peak = (wt_peak){.found = true,
                          .at = at,
                          .height = exponential(curve_value(&s, at.value)),
                          .n = n,
                          .misfit = relative_misfit(&s, x, z, n),
                          .reason = ""};
    free(s.components);
}

wt_status wt_peak_find(const double *x, const double *y, size_t n, wt_peak *peak, wt_error *err)
{
    size_t top = 0, first, last;
    (void)err;
    set_no_peak(peak, "fewer than 5 points");
    if (n < LEAST_POINTS)
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
        z[i - first] = log(y[i]);
    locate_peak(x + first, z, last - first, x[top], peak);
    free(z);
    return WT_OK;
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
    (void)err;
    if (n < LEAST_POINTS || at < x[0] || at > x[n - 1])
        return WT_OK;
    const size_t most = n < NEIGHBOURS ? n : NEIGHBOURS;
    size_t first = 0;
    while (first + most < n && at - x[first] > x[first + most] - at)
        first++;
    double z[NEIGHBOURS];
    for (size_t i = 0; i < most; i++)
        z[i] = log(y[first + i]);
    const smooth_curve s = fit_curve(x + first, z, most);
    *value = exponential(curve_value(&s, at));
    free(s.components);
    return WT_OK;
}
