/* Time of a measured course against a predicted one, by least squares.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/running_in_curve.h"

#include "core/base/memory.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>

/* Factors that are tried: e^-4 to e^4 in steps of 2 %. */
enum { STEPS = 400, FACTORS = 2 * STEPS + 1 };
static const double last_log = 4;
/* Largest correlation of successive residuals: with more, the course itself is in the residuals. */
static const double most_correlation = 0.95;

static double log_factor_at(size_t k)
{
    return last_log * ((double)k - STEPS) / STEPS;
}

double running_in_mean_of(running_in_function *course, const void *user, double begin, double end)
{
    /* Eight points give the mean of a course that is linear in the logarithm of time to 2 % of its
     * change over a decade; within a tenth of the time it hardly changes. */
    enum { WITHIN = 8 };
    const size_t n = end - begin > 0.1 * begin ? WITHIN : 1;
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += course(user, begin + (end - begin) * ((double)i + 0.5) / (double)n);
    return sum / (double)n;
}

/* Fits level and ratio at a factor and returns the sum of squares. x: [n] scratch. residual: [n],
 * or NULL. */
static double sum_of_squares(const running_in_mean *mean, size_t n, running_in_function *course,
                             const void *user, double factor, double *x, double *residual)
{
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < n; i++) {
        x[i] = running_in_mean_of(course, user, mean[i].begin / factor, mean[i].end / factor);
        mean_x += x[i] / (double)n;
        mean_y += mean[i].friction / (double)n;
    }
    for (size_t i = 0; i < n; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (mean[i].friction - mean_y);
        yy += (mean[i].friction - mean_y) * (mean[i].friction - mean_y);
    }
    const double ratio = xx > 0 ? xy / xx : 0;
    for (size_t i = 0; residual != NULL && i < n; i++)
        residual[i] = mean[i].friction - mean_y - ratio * (x[i] - mean_x);
    return fmax(yy - ratio * xy, 0);
}

/* Variance of the mean of correlated residuals over that of independent ones. */
static double correlation_factor(const double *residual, size_t n)
{
    double product = 0, square = 0;
    for (size_t i = 0; i < n; i++) {
        square += residual[i] * residual[i];
        product += i > 0 ? residual[i] * residual[i - 1] : 0;
    }
    const double r = square > 0 ? fmin(fmax(product / square, 0), most_correlation) : 0;
    return (1 + r) / (1 - r);
}

wt_interval running_in_curve_factor(const running_in_mean *mean, size_t n,
                                    running_in_function *course, const void *user)
{
    wt_interval found = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    if (n < 4) /* one more than the constants */
        return found;
    double *const x = wt_alloc(2 * n, sizeof *x), *const residual = x + n;
    double squares[FACTORS];
    size_t best = 0;
    for (size_t k = 0; k < FACTORS; k++) {
        squares[k] = sum_of_squares(mean, n, course, user, exp(log_factor_at(k)), x, NULL);
        if (squares[k] < squares[best])
            best = k;
    }
    const double least =
        sum_of_squares(mean, n, course, user, exp(log_factor_at(best)), x, residual);
    const double allowed =
        least * (1 + NORMAL_95 * NORMAL_95 * correlation_factor(residual, n) / ((double)n - 3));
    double level = 0, constant = 0;
    for (size_t i = 0; i < n; i++)
        level += mean[i].friction / (double)n;
    for (size_t i = 0; i < n; i++)
        constant += (mean[i].friction - level) * (mean[i].friction - level);
    free(x);
    if (!(constant > allowed)) /* a constant is as good */
        return found;
    size_t low = best, high = best;
    while (low > 0 && squares[low - 1] <= allowed)
        low--;
    while (high + 1 < FACTORS && squares[high + 1] <= allowed)
        high++;
    const double half_step = 0.5 * last_log / STEPS;
    if (best > 0 && best + 1 < FACTORS) /* else it is beyond the search */
        found.value = exp(log_factor_at(best));
    found.low = low > 0 ? exp(log_factor_at(low) - half_step) : (double)NAN;
    found.high = high + 1 < FACTORS ? exp(log_factor_at(high) + half_step) : (double)NAN;
    found.standard_error = (found.high - found.low) / (2 * NORMAL_95);
    return found;
}

double running_in_curve_factor_between(const running_in_mean *mean, size_t n,
                                       running_in_function *course, const void *user, double low,
                                       double high)
{
    /* steps of 3 % for a range of a factor of 16, far below the errors of a running-in */
    enum { BETWEEN = 100 };
    const double step = log(high / low) / BETWEEN;
    double *const x = wt_alloc(n, sizeof *x);
    size_t best = 0;
    double least = (double)NAN;
    for (size_t k = 0; k <= BETWEEN; k++) {
        const double squares =
            sum_of_squares(mean, n, course, user, low * exp((double)k * step), x, NULL);
        if (isnan(least) || squares < least) {
            least = squares;
            best = k;
        }
    }
    free(x);
    return best > 0 && best < BETWEEN ? low * exp((double)best * step) : (double)NAN;
}
