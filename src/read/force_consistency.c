/* Checks inconsistent metadata: the spring constant against force and deflection, and the piezo
 * height against its sensor.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/force_consistency.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES_MIN = 4 };
/* Relative tolerances. Rounded values agree within them; a piezo with creep or hysteresis may
 * exceed them. */
static const double constant_tolerance = 0.02, height_tolerance = 0.05;
/* A ratio above this indicates a wrong unit and not another calibration. */
static const double unit_error_ratio = 3;
/* Minimum share of explained variance for which the slope is used. */
static const double explained_share_min = 0.9;

/* Returns the slope of y over x. *share is the share of the variance of y that it explains. Pairs
 * with a missing sample are skipped. */
static double fitted_slope(const double *x, const double *y, size_t n, double *share)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, m = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i])) {
            sx += x[i];
            sy += y[i];
            m++;
        }
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i])) {
            sxx += (x[i] - sx / m) * (x[i] - sx / m);
            sxy += (x[i] - sx / m) * (y[i] - sy / m);
            syy += (y[i] - sy / m) * (y[i] - sy / m);
        }
    *share = sxx > 0 && syy > 0 ? sxy * sxy / (sxx * syy) : 0;
    return sxy / sxx;
}

static bool is_usable_signal(const force_signal *signal)
{
    return signal != NULL && signal->problem == NULL;
}

wt_status check_spring_constant(wt_force_source *source, const force_metadata *metadata,
                                const force_signal *force, const force_signal *deflection,
                                wt_error *err)
{
    const double own = metadata->cantilever.spring_constant;
    const double k = own > 0 ? own : source->options.spring_constant;
    const size_t n = metadata->n_points;
    double share = 0;
    if (source->constant_checked || !is_usable_signal(force) || !is_usable_signal(deflection) ||
        force->channel == deflection->channel || !(k > 0) || n < SAMPLES_MIN)
        return WT_OK;
    double *values = calloc(2 * n, sizeof *values);
    if (values == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu samples", n);
    wt_status status =
        source->stream->decode(source, deflection, deflection->to_si, n, values, err);
    if (status == WT_OK)
        status = source->stream->decode(source, force, force->to_si, n, values + n, err);
    const double fitted = status == WT_OK ? fitted_slope(values, values + n, n, &share) : 0;
    free(values);
    if (share < explained_share_min)
        return status;
    source->constant_checked = true;
    if (fabs(fitted / k - 1) > constant_tolerance + 1 - share)
        wt_log_action(source->log, WT_WARNING, WT_CONTRADICTED, 0, NULL, source->name,
                      metadata->place,
                      "force and deflection of the file mean a spring constant of %.4g N/m, %s "
                      "%.4g N/m",
                      fitted, own > 0 ? "the file says" : "given is", k);
    return status;
}

static void report_override(const wt_force_source *source, const char *what, const char *unit,
                            double given, double own, double scale)
{
    if (!(own > 0) || isnan(given) || fabs(given / own - 1) <= constant_tolerance)
        return;
    const bool is_suspicious = fmax(given / own, own / given) > unit_error_ratio;
    wt_log_add(source->log, is_suspicious ? WT_WARNING : WT_NOTE, source->name, NULL,
               "the %s given, %.4g %s, takes the place of that of the file, %.4g %s%s", what,
               scale * given, unit, scale * own, unit,
               is_suspicious ? ": is its unit the right one?" : "");
}

void report_overrides(wt_force_source *source, const force_metadata *metadata)
{
    if (source->given_checked)
        return;
    source->given_checked = true;
    report_override(source, "spring constant", "N/m", source->options.spring_constant,
                    metadata->cantilever.spring_constant, 1);
    report_override(source, "deflection sensitivity", "nm/V", source->options.sensitivity,
                    metadata->cantilever.sensitivity, 1e9);
}

static double value_range(const double *values, size_t n)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

void check_height_ranges(wt_force_source *source, const force_metadata *metadata,
                         const wt_segment *segment)
{
    if (source->heights_checked || segment->kind != WT_SEGMENT_APPROACH ||
        segment->n_points < SAMPLES_MIN)
        return;
    const wt_channel *const height = wt_segment_channel(segment, WT_Q_HEIGHT),
                            *const measured = wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT);
    if (height == NULL || measured == NULL)
        return;
    const double piezo = value_range(height->values, segment->n_points);
    const double sensor = value_range(measured->values, segment->n_points);
    if (!(piezo > 0) || !(sensor > 0))
        return;
    source->heights_checked = true;
    if (fabs(piezo - sensor) > height_tolerance * sensor)
        wt_log_add(source->log, WT_NOTE, source->name, metadata->place,
                   "the height of the piezo changes by %.4g um, that of its sensor by %.4g "
                   "um; the sensor is used",
                   1e6 * piezo, 1e6 * sensor);
}
