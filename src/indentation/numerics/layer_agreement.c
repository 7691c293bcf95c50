/* Comparison of the layer thickness from the curves with another source (theory, or a section
 * under the microscope). The curves have a deviate for each thickness, the other source one of its
 * logarithm by its interval. The sum of both squares measures the deviation of a thickness.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/indentation.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

enum { POINTS = 2000, RATIOS = 241 };   /* steps of 1 % */
static const double widest_ratio = 8.0; /* in ln; ratios beyond 3000 are not searched */
/* Significance level of a "no". It is below the customary 5 % as a reserve for intervals that are
 * too narrow. */
static const double no_level = 0.01;
static const double source_range = 6.0; /* range in standard errors of the other source */

/* Logarithm of the other thickness: value, and standard errors below and above. */
typedef struct comparison_source {
    double at, below, above;
} comparison_source;

static double source_squared_deviation(const comparison_source *o, double x)
{
    const double deviation = x - o->at, error = deviation < 0 ? o->below : o->above;
    return isinf(error) ? 0.0 : deviation * deviation / (error * error);
}

/* Squared deviate of the curves with linear interpolation. Thicker layers have that of the first
 * step. The curves do not constrain layers below the range of the law if `below` is true. */
static double curve_squared_deviation(const wt_layer_profile *p, double x)
{
    size_t i = 1;
    if (x >= p->log_thickness[0])
        return p->deviate[0] * p->deviate[0];
    if (p->thinner_allowed && x < p->log_thickness[p->n_steps - 1])
        return 0.0;
    while (i + 1 < p->n_steps && x < p->log_thickness[i])
        i++;
    const double step = p->log_thickness[i] - p->log_thickness[i - 1],
                 part = fmin(1.0, (x - p->log_thickness[i - 1]) / step),
                 z = p->deviate[i - 1] + part * (p->deviate[i] - p->deviate[i - 1]);
    return z * z;
}

/* Smallest sum of squares if ln of the thickness by the curves exceeds the other by `shift`. */
static double min_squared_deviation(const double x[POINTS], const double curve_squares[POINTS],
                                    const comparison_source *o, double shift)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < POINTS; i++)
        least = fmin(least, curve_squares[i] + source_squared_deviation(o, x[i] - shift));
    return least;
}

/* Finds the joint interval from the sum of squares minus its minimum. */
static void find_joint_interval(const double x[POINTS], const double curve_squares[POINTS],
                                const comparison_source *o, double limit, wt_layer_agreement *to)
{
    const double least = min_squared_deviation(x, curve_squares, o, 0.0);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < POINTS; i++)
        if (curve_squares[i] + source_squared_deviation(o, x[i]) <= least + limit) {
            low = fmin(low, x[i]);
            high = fmax(high, x[i]);
        }
    to->low = low > x[0] ? exp(low) : 0.0;
    to->high = high < x[POINTS - 1] ? exp(high) : (double)HUGE_VAL;
}

static void find_ratio_interval(const double x[POINTS], const double curve_squares[POINTS],
                                const comparison_source *o, double limit, wt_layer_agreement *to)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < RATIOS; i++) {
        const double shift = widest_ratio * (2.0 * i / (RATIOS - 1) - 1.0);
        if (min_squared_deviation(x, curve_squares, o, shift) > limit)
            continue;
        low = fmin(low, shift);
        high = fmax(high, shift);
    }
    to->ratio_low = low <= -widest_ratio ? 0.0 : exp(low);
    to->ratio_high = high >= widest_ratio ? (double)HUGE_VAL : exp(high);
}

wt_layer_agreement wt_layer_compare(const wt_layer_profile *p, wt_interval other)
{
    const double quantile = gsl_cdf_ugaussian_Pinv(0.975), limit = quantile * quantile;
    const double none = (double)NAN;
    wt_layer_agreement to = {none, none, none, none, false, false};
    double x[POINTS], curve_squares[POINTS];
    if (p->n_steps < 2 || !(other.value > 0) || !(other.high >= other.value) ||
        !(other.low <= other.value))
        return to;
    const comparison_source o = {
        log(other.value),
        other.low > 0 ? log(other.value / other.low) / quantile : (double)HUGE_VAL,
        isfinite(other.high) ? log(other.high / other.value) / quantile : (double)HUGE_VAL};
    const double low = fmin(p->log_thickness[p->n_steps - 1],
                            isinf(o.below) ? o.at : o.at - source_range * o.below) -
                       widest_ratio,
                 high = fmax(p->log_thickness[0],
                             isinf(o.above) ? o.at : o.at + source_range * o.above) +
                        widest_ratio;
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = low + (high - low) * (double)i / (POINTS - 1);
        curve_squares[i] = curve_squared_deviation(p, x[i]);
    }
    find_ratio_interval(x, curve_squares, &o, limit, &to);
    to.differ = gsl_cdf_chisq_Q(min_squared_deviation(x, curve_squares, &o, 0.0), 1.0) < no_level;
    to.agree = to.ratio_low >= 1.0 / WT_LAYER_MARGIN && to.ratio_high <= WT_LAYER_MARGIN;
    if (!to.differ)
        find_joint_interval(x, curve_squares, &o, limit, &to);
    return to;
}
