/* Conditioning of friction records: outliers, load near zero, zero of the friction force.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/conditioning.h"

#include "core/base/array.h"
#include "core/base/memory.h"

#include <math.h>

/* A sample is an outlier at ten times what nine of ten samples stay below. A peak of static
 * friction is two to three times the sliding friction, so that no friction is left out. */
static const double outlier_factor = 10, usual_share = 0.9;
/* Longest run of outliers. A longer one is a condition of the experiment, such as another load. */
enum { LONGEST_RUN = 3 };
/* Least number of samples for a share of 0.9 to say anything. */
enum { LEAST_SAMPLES = 20 };
/* A value outside of five standard deviations is no scatter of a normal distribution: once in 1.7
 * million. */
static const double scatter_deviations = 5;
/* Number of samples before loading for a zero with a standard error below a third of the scatter.
 */
enum { LEAST_ZERO_SAMPLES = 10 };
/* A zero below a thousandth of the friction changes no digit that is reported. */
static const double least_zero = 1e-3;

/* The value that nine of ten magnitudes stay below. NaN if there are too few. */
static double usual_magnitude(const double *x, size_t n)
{
    double *const sorted = wt_alloc(n, sizeof *sorted);
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (!isnan(x[i]))
            sorted[m++] = fabs(x[i]);
    numbers_sort(sorted, m);
    const double usual =
        m < LEAST_SAMPLES ? (double)NAN : sorted[(size_t)(usual_share * (double)(m - 1))];
    free(sorted);
    return usual;
}

static void leave_out_outliers(double *x, size_t n, const char *what, const char *file, wt_log *log)
{
    const double most = x != NULL ? outlier_factor * usual_magnitude(x, n) : (double)NAN;
    size_t count = 0, first = 0;
    double value = 0;
    for (size_t i = 0, to; most > 0 && i < n; i = to) {
        to = i + 1;
        if (!(fabs(x[i]) > most))
            continue;
        while (to < n && fabs(x[to]) > most)
            to++;
        if (to - i > LONGEST_RUN)
            continue;
        first = count == 0 ? i : first;
        value = count == 0 ? x[i] : value;
        count += to - i;
        for (size_t k = i; k < to; k++)
            x[k] = (double)NAN;
    }
    if (count > 0)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, count, NULL, file, NULL,
                      "%zu of %zu samples of the %s left out as outliers, more than %.0f times the "
                      "usual value; the first is %.6g at sample %zu",
                      count, n, what, outlier_factor, value, first + 1);
}

/* An unloaded sensor scatters around zero: as far above it as below. */
static void remove_load_near_zero(double *load, size_t n)
{
    double squares = 0;
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        if (load[i] < 0) {
            squares += load[i] * load[i];
            count++;
        }
    const double most = count > 1 ? scatter_deviations * sqrt(squares / (double)count) : 0;
    const double usual = usual_magnitude(load, n);
    for (size_t i = 0; most < usual && i < n; i++)
        if (load[i] > 0 && load[i] < most)
            load[i] = 0;
}

static void subtract_zero(double *force, const double *load, size_t n, const char *file,
                          wt_log *log)
{
    double mean = 0, squares = 0;
    size_t count = 0, first = 0;
    while (first < n && !(load[first] > 0)) {
        const double x = force[first++];
        if (isnan(x))
            continue;
        const double step = x - mean;
        mean += step / (double)++count;
        squares += step * (x - mean);
    }
    if (count < LEAST_ZERO_SAMPLES || first == n)
        return;
    const double scatter = sqrt(squares / (double)(count - 1));
    if (!(fabs(mean) > scatter_deviations * scatter / sqrt((double)count) &&
          fabs(mean) > least_zero * usual_magnitude(force, n)))
        return;
    for (size_t i = 0; i < n; i++)
        force[i] -= mean;
    wt_log_action(
        log, WT_WARNING, WT_CORRECTED, n, NULL, file, NULL,
        "a zero of the friction force of %.4g N is seen in %zu samples before loading, and "
        "is subtracted",
        mean, count);
}

void condition_record(wt_record *record, const char *file, wt_log *log)
{
    double *const force = record->channel[WT_RECORD_FRICTION_FORCE],
                  *const load = record->channel[WT_RECORD_NORMAL_FORCE];
    leave_out_outliers(record->channel[WT_RECORD_COEFFICIENT], record->n, "friction coefficient",
                       file, log);
    leave_out_outliers(force, record->n, "friction force", file, log);
    leave_out_outliers(load, record->n, "normal force", file, log);
    if (load != NULL) {
        remove_load_near_zero(load, record->n);
        if (force != NULL)
            subtract_zero(force, load, record->n, file, log);
    }
}
