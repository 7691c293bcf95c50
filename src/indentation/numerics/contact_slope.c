/* Deflection sensitivity: slope of the detector signal against the piezo position while the tip
 * presses on a rigid surface.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <stdlib.h>

/* Largest and smallest number of blocks in the part, and samples per block. The fit to the block
 * means has three parameters. Seven degrees of freedom determine the scatter to a quarter, and
 * three are the minimum. A curve needs at least 40 samples, so that the end tenth has four. A
 * scatter needs at least three curves. */
enum {
    BLOCKS = 10,
    MIN_BLOCKS = 6,
    BLOCK_SAMPLES = 2,
    PARAMETERS = 3,
    LINE = 2, /* parameters of a line */
    MIN_CURVE_SAMPLES = 40,
    END_FRACTION = 10,
    MIN_UNITS = 3
};
/* Share of the baseline for its tilt; it must be as long as the part. The rest may include
 * long-range forces and optical interference. The error of the tilt is proportional to the share to
 * the power of -3/2: it is twice that of the whole baseline, and six times with half the share. */
static const double baseline_share = 0.6;
/* Smallest rise of the signal in standard deviations of the noise. It determines a slope to some
 * per cent. */
static const double min_rise = 20;
/* Standard deviation of a normal distribution over its median distance from the median. */
static const double mad_to_deviation = 1.4826;

wt_slope_options wt_slope_defaults(void)
{
    return (wt_slope_options){.from = 0.25, .to = 0.95};
}

static const wt_param rows[] = {
    {PARAM("contact-from", wt_slope_options, from, WT_Q_NONE, FROM_BELOW(0, 1)), .value = "X",
     .flags = PARAM_NO_CASE,
     .help = "where the part of the contact begins that the slope is measured by: share of the "
             "rise of the signal above its baseline"},
    {PARAM("contact-to", wt_slope_options, to, WT_Q_NONE, ABOVE_TO(0, 1)), .value = "X",
     .flags = PARAM_NO_CASE, .help = "where it ends"},
};
PARAM_TABLE(wt_slope_params, wt_slope_options, rows, wt_slope_defaults, NO_PARTS)

/* ---- the samples ----------------------------------------------------------------------------- */

/* Samples from far away to contact. */
typedef struct slope_samples {
    double *z, *v; /* [n] */
    double *scratch;
    size_t n;
} slope_samples;

static void collect_finite_samples(slope_samples *s, const double *position, const double *signal,
                                   size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (isfinite(position[i]) && isfinite(signal[i])) {
            s->z[s->n] = position[i];
            s->v[s->n++] = signal[i];
        }
    const size_t end = s->n / END_FRACTION;
    if (end > 0 && numbers_mean(s->v, end) > numbers_mean(s->v + s->n - end, end)) {
        numbers_reverse(s->z, s->n);
        numbers_reverse(s->v, s->n);
    }
}

static double baseline_level(const slope_samples *s)
{
    const size_t n = s->n / END_FRACTION;
    for (size_t i = 0; i < n; i++)
        s->scratch[i] = s->v[i];
    return numbers_median(s->scratch, n);
}

/* Standard deviation of the noise from the median step. The contact affects the median only if it
 * is most of the curve. */
static double difference_noise_level(const slope_samples *s)
{
    for (size_t i = 0; i + 1 < s->n; i++)
        s->scratch[i] = fabs(s->v[i + 1] - s->v[i]);
    return mad_to_deviation * numbers_median(s->scratch, s->n - 1) / sqrt(2);
}

/* ---- lines ----------------------------------------------------------------------------------- */

typedef struct fitted_line {
    double z, v, slope; /* mean position, mean signal, slope */
} fitted_line;

static fitted_line fit_line(const double *z, const double *v, size_t n)
{
    fitted_line l = {numbers_mean(z, n), numbers_mean(v, n), 0};
    double zz = 0, zv = 0;
    for (size_t i = 0; i < n; i++) {
        zz += (z[i] - l.z) * (z[i] - l.z);
        zv += (z[i] - l.z) * (v[i] - l.v);
    }
    l.slope = zv / zz;
    return l;
}

/* ---- the part of the contact ----------------------------------------------------------------- */

typedef struct contact_part {
    size_t first, n;
    double from, to; /* limits of the position */
    double contact;  /* intersection of the line through the part with the baseline */
} contact_part;

/* Finds the part of the contact. The first limits are crossings of the signal, the final ones those
 * of a line through these samples, so that noise does not select the samples. Positions rise
 * towards contact afterwards. Returns false without such a line; p->n is the number of samples in
 * any case. */
static bool find_contact_part(slope_samples *s, double low, double high, double baseline,
                              contact_part *p)
{
    size_t peak = 0;
    for (size_t i = 1; i < s->n; i++)
        if (s->v[i] > s->v[peak])
            peak = i;
    size_t end = peak, begin;
    while (end > 0 && s->v[end] > high)
        end--;
    begin = end;
    while (begin > 0 && s->v[begin - 1] > low)
        begin--;
    p->n = end - begin + 1;
    if (p->n < MIN_BLOCKS)
        return false;
    fitted_line l = fit_line(s->z + begin, s->v + begin, p->n);
    if (!isfinite(l.slope) || !(fabs(l.slope) > 0))
        return false;
    if (l.slope < 0) {
        for (size_t i = 0; i < s->n; i++)
            s->z[i] = -s->z[i];
        l.slope = -l.slope;
        l.z = -l.z;
    }
    p->from = l.z + (low - l.v) / l.slope;
    p->to = l.z + (high - l.v) / l.slope;
    p->contact = l.z + (baseline - l.v) / l.slope;
    p->first = peak;
    while (p->first > 0 && s->z[p->first - 1] >= p->from)
        p->first--;
    while (p->first < peak && s->z[p->first] < p->from)
        p->first++;
    p->n = 0;
    while (p->first + p->n <= peak && s->z[p->first + p->n] <= p->to)
        p->n++;
    return true;
}

/* Slope of the baseline far from contact, with a standard error from block means. The result is NaN
 * if the baseline is shorter than the part. */
static double fit_baseline_tilt(const slope_samples *s, const contact_part *p,
                                double *standard_error)
{
    const double end = s->z[0] + baseline_share * (p->contact - s->z[0]);
    double z[BLOCKS], v[BLOCKS], zz = 0, left = 0;
    size_t n = 0;
    while (n < p->first && s->z[n] <= end)
        n++;
    if (n < BLOCKS || !(end - s->z[0] >= p->to - p->from))
        return (double)NAN;
    for (size_t b = 0; b < BLOCKS; b++) {
        const size_t first = n * b / BLOCKS, length = n * (b + 1) / BLOCKS - first;
        z[b] = numbers_mean(s->z + first, length);
        v[b] = numbers_mean(s->v + first, length);
    }
    const fitted_line l = fit_line(z, v, BLOCKS);
    for (size_t b = 0; b < BLOCKS; b++) {
        const double deviation = v[b] - l.v - l.slope * (z[b] - l.z);
        zz += (z[b] - l.z) * (z[b] - l.z);
        left += deviation * deviation;
    }
    *standard_error = sqrt(left / (BLOCKS - LINE) / zz);
    return fit_line(s->z, s->v, n).slope;
}

/* ---- the slope ------------------------------------------------------------------------------- */

/* Fits a parabola to the block means. */
static void fit_block_parabola(const slope_samples *s, const contact_part *p, wt_contact_slope *c)
{
    const size_t most = p->n / BLOCK_SAMPLES;
    const size_t n = most < MIN_BLOCKS ? MIN_BLOCKS : most < BLOCKS ? most : BLOCKS;
    double z[BLOCKS], v[BLOCKS], zz = 0, zzz = 0, zv = 0, qq = 0, qv = 0, left = 0;
    for (size_t b = 0; b < n; b++) {
        const size_t first = p->n * b / n, end = p->n * (b + 1) / n;
        z[b] = numbers_mean(s->z + p->first + first, end - first);
        v[b] = numbers_mean(s->v + p->first + first, end - first);
    }
    const double z0 = numbers_mean(z, n), v0 = numbers_mean(v, n);
    for (size_t b = 0; b < n; b++) {
        z[b] -= z0;
        v[b] -= v0;
        zz += z[b] * z[b];
        zzz += z[b] * z[b] * z[b];
        zv += z[b] * v[b];
    }
    /* Quadratic term, orthogonal to the linear and constant terms. */
    double q[BLOCKS];
    for (size_t b = 0; b < n; b++) {
        q[b] = z[b] * z[b] - zz / (double)n - zzz / zz * z[b];
        qq += q[b] * q[b];
        qv += q[b] * v[b];
    }
    const double slope = zv / zz, bend = qv / qq;
    for (size_t b = 0; b < n; b++) {
        const double deviation = v[b] - slope * z[b] - bend * q[b];
        left += deviation * deviation;
    }
    c->df = (double)n - PARAMETERS;
    const double variance = left / c->df;
    c->travel = p->to - p->from;
    c->slope = slope;
    c->slope_error = sqrt(variance / zz);
    c->change = 2 * bend * c->travel / slope;
    c->change_error = 2 * sqrt(variance / qq) * c->travel / slope;
}

static double line_residual(const slope_samples *s, const contact_part *p)
{
    const fitted_line l = fit_line(s->z + p->first, s->v + p->first, p->n);
    double squares = 0;
    for (size_t i = p->first; i < p->first + p->n; i++) {
        const double deviation = s->v[i] - l.v - l.slope * (s->z[i] - l.z);
        squares += deviation * deviation;
    }
    return sqrt(squares / (double)p->n);
}

static void measure_part(const slope_samples *s, const contact_part *p, double rise,
                         wt_contact_slope *c)
{
    c->n = p->n;
    c->misfit = line_residual(s, p) / rise;
    fit_block_parabola(s, p, c);
    double tilt_error = 0;
    const double tilt = fit_baseline_tilt(s, p, &tilt_error), uncorrected = c->slope;
    if (isnan(tilt))
        return;
    c->slope -= tilt;
    c->slope_error = hypot(c->slope_error, tilt_error);
    c->tilt = tilt / c->slope;
    c->change *= uncorrected / c->slope;
    c->change_error *= uncorrected / c->slope;
}

static void measure_slope(slope_samples *s, const wt_slope_options *options, wt_contact_slope *c)
{
    if (s->n < MIN_CURVE_SAMPLES) {
        snprintf(c->reason, sizeof c->reason, "%zu samples, at least %d are needed", s->n,
                 MIN_CURVE_SAMPLES);
        return;
    }
    const double baseline = baseline_level(s), noise = difference_noise_level(s);
    double top = s->v[0];
    for (size_t i = 1; i < s->n; i++)
        top = fmax(top, s->v[i]);
    const double rise = top - baseline;
    contact_part p = {.n = 0};
    if (!(rise > min_rise * noise)) {
        clocale_print(c->reason, sizeof c->reason,
                      "no contact: the signal rises by less than %g times its noise", min_rise);
        return;
    }
    c->signal_from = options->from * rise;
    c->signal_to = options->to * rise;
    const bool rises =
        find_contact_part(s, baseline + c->signal_from, baseline + c->signal_to, baseline, &p);
    if (p.n < MIN_BLOCKS) {
        clocale_print(c->reason, sizeof c->reason,
                      "%zu samples between %g and %g of the rise, at least %d are needed", p.n,
                      options->from, options->to, MIN_BLOCKS);
        return;
    }
    if (rises)
        measure_part(s, &p, rise, c);
    c->found = rises && c->slope > 0 && isfinite(c->slope) && isfinite(c->slope_error);
    if (!c->found)
        snprintf(c->reason, sizeof c->reason, "the signal does not rise with the piezo");
}

wt_status wt_contact_slope_fit(const double *position, const double *signal, size_t n,
                               const wt_slope_options *options, wt_contact_slope *slope,
                               wt_error *err)
{
    const wt_slope_options defaults = wt_slope_defaults();
    const double unknown = (double)NAN;
    if (position == NULL || signal == NULL || slope == NULL)
        return wt_fail(err, WT_E_ARG, "no curve");
    *slope = (wt_contact_slope){.slope = unknown,
                                .slope_error = unknown,
                                .change = unknown,
                                .change_error = unknown,
                                .tilt = unknown,
                                .misfit = unknown,
                                .signal_from = unknown,
                                .signal_to = unknown,
                                .travel = unknown,
                                .df = unknown};
    options = options != NULL ? options : &defaults;
    wt_status status = param_check(wt_slope_params(), options, err);
    if (status == WT_OK && !(options->from < options->to))
        status = range_error("contact-to", options->to, "more than contact-from", err);
    if (status != WT_OK)
        return status;
    double *block = wt_alloc(3 * (n + 1), sizeof *block);
    slope_samples s = {.z = block, .v = block + n + 1, .scratch = block + 2 * (n + 1)};
    collect_finite_samples(&s, position, signal, n);
    measure_slope(&s, options, slope);
    free(block);
    return WT_OK;
}

/* ---- several curves -------------------------------------------------------------------------- */

/* Mean of the values from *at on that belong to one unit; without units, of one value. Moves *at to
 * the next unit. */
static double unit_mean(const double *values, const long *units, size_t n, size_t *at)
{
    const size_t first = *at;
    do
        ++*at;
    while (units != NULL && *at < n && units[*at] == units[first]);
    return numbers_mean(values + first, *at - first);
}

static size_t sum_unit_means(const double *values, const long *units, size_t n, double *sum)
{
    size_t n_units = 0;
    *sum = 0;
    for (size_t at = 0; at < n; n_units++)
        *sum += unit_mean(values, units, n, &at);
    return n_units;
}

wt_interval wt_student_mean(const double *values, const long *units, size_t n, size_t *n_units)
{
    const double unknown = (double)NAN;
    wt_interval i = {unknown, unknown, unknown, unknown};
    double sum = 0, squares = 0;
    *n_units = sum_unit_means(values, units, n, &sum);
    if (*n_units < MIN_UNITS) {
        units = NULL;
        *n_units = sum_unit_means(values, units, n, &sum);
    }
    if (n == 0)
        return i;
    const double count = (double)*n_units;
    i.value = sum / count;
    if (*n_units < 2)
        return i;
    for (size_t at = 0; at < n;) {
        const double deviation = unit_mean(values, units, n, &at) - i.value;
        squares += deviation * deviation;
    }
    i.standard_error = sqrt(squares / (count - 1) / count);
    const double half = wt_student_quantile(count - 1) * i.standard_error;
    i.low = i.value - half;
    i.high = i.value + half;
    return i;
}
