/* Monte Carlo draws of a layer: the error sources, and the values of one replicate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/monte_carlo.h"
#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/cholesky.h"
#include "core/math/students_t.h"
#include "core/table/registry.h"
#include "friction/replicates.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Number of replicates for quantiles: two of them lie beyond each limit of 95 %. */
enum { REPLICATES_FOR_QUANTILES = 80 };

/* Quantile of n sorted values at the probability `part`; NaN beyond the last of the m finite ones.
 */
static double censored_quantile(const double *sorted, size_t m, size_t n, double part)
{
    const double at = fmax(part * (double)n - 0.5, 0);
    const size_t i = (size_t)at;
    if (i + 1 >= m)
        return (double)NAN;
    return sorted[i] + (at - (double)i) * (sorted[i + 1] - sorted[i]);
}

/* ---- along the line -------------------------------------------------------------------------- */

typedef struct parabola {
    double b[3];
} parabola;

/* Fits a parabola to the values against their positions along the linear fit; the quadratic term
 * describes nonlinearity. False if the fit is singular. */
static bool fit_parabola(const replicates *r, size_t k, const double *at, parabola *fitted)
{
    double a[9] = {0};
    *fitted = (parabola){{0}};
    for (size_t i = 0; i < r->n; i++) {
        const double value = r->value[i * r->stride + k], power[3] = {1, at[i], at[i] * at[i]};
        for (size_t u = 0; isfinite(value) && u < 3; u++) {
            fitted->b[u] += power[u] * value;
            for (size_t v = 0; v <= u; v++)
                a[u * 3 + v] += power[u] * power[v];
        }
    }
    return cholesky_solve(a, 3, 3, 0, fitted->b);
}

static double evaluate_parabola(const parabola *fitted, double x)
{
    return fitted->b[0] + x * (fitted->b[1] + x * fitted->b[2]);
}

typedef struct line_position {
    double at;
    size_t replicate;
} line_position;

static int compare_positions(const void *left, const void *right)
{
    const line_position *const a = left, *const b = right;
    return a->at != b->at ? (a->at > b->at) - (a->at < b->at)
                          : (a->replicate > b->replicate) - (a->replicate < b->replicate);
}

/* Correction of each of the n values if each draw had its expected order statistic; 0 without a
 * fit. */
static void compute_corrections(const replicates *r, size_t k, double *correction)
{
    parabola fitted;
    double *const at = wt_alloc(r->n + 1, sizeof *at);
    line_position *const positions = wt_alloc(r->n + 1, sizeof *positions);
    const bool has_line = replicates_line_positions(r, k, at) && fit_parabola(r, k, at, &fitted);
    for (size_t i = 0; i < r->n; i++)
        correction[i] = 0;
    for (size_t i = 0; has_line && i < r->n; i++)
        positions[i] = (line_position){at[i], i};
    if (has_line)
        qsort(positions, r->n, sizeof *positions, compare_positions);
    for (size_t i = 0; has_line && i < r->n; i++) {
        const double expected = normal_quantile(((double)i + 0.5) / (double)r->n);
        correction[positions[i].replicate] =
            evaluate_parabola(&fitted, expected) - evaluate_parabola(&fitted, positions[i].at);
    }
    free(at);
    free(positions);
}

/* Limits of the quantity whose logarithm is quantity k of the replicates, with this probability
 * beyond each limit. Replicates without a value count as above all others. Quantiles of some
 * hundred replicates scatter by a tenth of the interval, in the same direction for all results of a
 * seed. The draws are standard normal, however. Each replicate is therefore moved along the
 * parabola fit from its draw to the expected value of its rank. */
static void replicate_interval(const replicates *r, size_t k, double tail_probability,
                               wt_interval *interval)
{
    double *const sorted = wt_alloc(r->n + 1, sizeof *sorted);
    double *const correction = wt_alloc(r->n + 1, sizeof *correction);
    size_t m = 0;
    compute_corrections(r, k, correction);
    for (size_t i = 0; i < r->n; i++) {
        const double value = r->value[i * r->stride + k];
        if (isfinite(value))
            sorted[m++] = value + correction[i];
    }
    numbers_sort(sorted, m);
    interval->low = exp(censored_quantile(sorted, m, r->n, tail_probability));
    interval->high = exp(censored_quantile(sorted, m, r->n, 1 - tail_probability));
    free(sorted);
    free(correction);
}

double layer_replicates_add(replicates *r, const wt_sliding *sliding, const wt_layer_job *job)
{
    replicates_add(r, job->specific_wear_rate.standard_error, FLOW_DRAW_WEAR, "specific wear rate");
    const bool calibrated = !isnan(job->observed_thickness.value);
    const double given =
        (calibrated ? job->observed_thickness : job->critical_energy).standard_error;
    replicates_add(r, given, calibrated ? FLOW_DRAW_OBSERVED : FLOW_DRAW_CRITICAL_ENERGY,
                   calibrated ? "observed thickness" : "critical energy");
    if (job->energy != WT_LAYER_HYSTERESIS)
        replicates_add(r, sliding->shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    return given;
}

static wt_status check_layer_inputs(const wt_sliding *sliding, const wt_layer_job *job,
                                    const wt_layer_observation *observation, const wt_job *work,
                                    wt_error *err)
{
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status == WT_OK && observation != NULL && sliding->layer_rubber == NULL &&
        !(observation->modulus_ratio.value > 0)) {
        status = wt_fail(err, WT_E_MISSING, "the modulus of the layer is not known");
        wt_error_expected(err, "modulus-ratio above 0");
    }
    return status == WT_OK ? sliding_layer_check(observation, err) : status;
}

wt_status layer_draws_init(layer_draws *d, const wt_sliding *sliding, const wt_layer_job *job,
                           const wt_layer_observation *observation, const wt_job *work,
                           const char *what, bool friction, wt_error *err)
{
    *d = (layer_draws){.observation = observation};
    wt_status status = check_layer_inputs(sliding, job, observation, work, err);
    if (status != WT_OK)
        return status;
    d->stated = *job;
    if (observation != NULL) {
        double gain[2] = {(double)NAN, (double)NAN};
        status = sliding_layer_zero_loss_range(sliding, observation, work, gain, err);
        if (status != WT_OK)
            return status;
        sliding_layer_describe(sliding, observation, gain, work->log, d->moduli, sizeof d->moduli);
    }
    if (observation != NULL && observation->bulk_shear)
        d->stated.shear.exponent = 0;
    d->values = (layer_context){
        .sliding = sliding,
        .job = &d->stated,
        .work = work,
        .replicate = WT_NO_REPLICATE,
        .modulus_ratio = observation != NULL ? observation->modulus_ratio.value : (double)NAN,
        .slope = sliding_layer_ratio_slope(observation, work->seed, WT_NO_REPLICATE)};
    status = layer_job_calibrate(&d->values, &d->calibrated, err);
    d->values.job = &d->calibrated;
    d->replicates = replicates_create(sliding, work, what);
    layer_replicates_add(&d->replicates, sliding, job);
    if (friction && job->energy == WT_LAYER_HYSTERESIS && !isnan(sliding->shear_stress.value))
        replicates_add(&d->replicates, sliding->shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    if (friction && observation != NULL)
        replicates_add_layer(&d->replicates, sliding, observation,
                             error_source_text(SOURCE_MODULUS_RATIO));
    return status;
}

wt_status layer_draws_replicate_context(const layer_draws *d, size_t replicate, wt_layer_job *job,
                                        layer_context *context, wt_error *err)
{
    *context = d->values;
    context->job = &d->stated;
    context->replicate = replicate;
    context->drawn = d->replicates.drawn;
    context->slope = sliding_layer_ratio_slope(d->observation, context->work->seed, replicate);
    if (d->observation != NULL)
        context->modulus_ratio =
            flow_draw_positive_t(d->observation->modulus_ratio, d->observation->modulus_ratio_df,
                                 context->work->seed, replicate, FLOW_DRAW_RATIO);
    const wt_status status = layer_job_calibrate(context, job, err);
    context->job = job;
    return status;
}

void layer_draws_describe(const layer_draws *d, char *text, size_t size)
{
    const char *const lacks = d->replicates.lacks;
    snprintf(text, size, "%s%s%s", replicates_included_errors(&d->replicates),
             lacks[0] != '\0' ? "; no error is known of: " : "", lacks);
}

wt_estimate layer_draws_modulus_ratio(const layer_draws *d)
{
    if (d->values.sliding->layer_rubber == NULL)
        return flow_stated_estimate(d->observation->modulus_ratio);
    return (wt_estimate){(double)NAN, (double)NAN, (double)NAN, "1"};
}

void layer_draws_clear(layer_draws *d)
{
    replicates_clear(&d->replicates);
}

static const double tail_probability = 0.025; /* probability beyond each limit of a 95 % interval */

static size_t count_finite(const replicates *r, size_t k)
{
    size_t known = 0;
    for (size_t i = 0; i < r->n; i++)
        known += isfinite(r->value[i * r->stride + k]) ? 1 : 0;
    return known;
}

wt_interval layer_draws_interval(const layer_draws *d, size_t k, double value)
{
    const replicates *r = &d->replicates;
    const double error = r->error[k], factor = exp(NORMAL_95 * error);
    const size_t known = count_finite(r, k);
    wt_interval interval = {value, value * error, value / factor, value * factor};
    const bool nearly_all_finite = (double)(r->n - known) <= tail_probability * (double)r->n;
    if (!nearly_all_finite)
        interval.low = interval.high = interval.standard_error = (double)NAN;
    else if (isfinite(value) && r->n >= REPLICATES_FOR_QUANTILES)
        replicate_interval(r, k, tail_probability, &interval);
    return interval;
}

void layer_draws_assess(const layer_draws *d, size_t k, double value, const char *without,
                        const char *with, char *text, size_t size)
{
    const replicates *r = &d->replicates;
    const size_t known = count_finite(r, k), n_other = isfinite(value) ? r->n - known : known;
    if (r->n == 0)
        snprintf(text, size, "%s: no replicates are drawn",
                 stated_verdict_text(VERDICT_NOT_TESTED));
    else if ((double)n_other <= tail_probability * (double)r->n)
        snprintf(text, size, "%s: nearly all replicates agree", stated_verdict_text(VERDICT_YES));
    else
        clocale_print(
            text, size,
            "%s: in %.3g %% of the replicates %s; smaller errors of what is drawn would settle it",
            stated_verdict_text(VERDICT_INCONCLUSIVE), 100 * (double)n_other / (double)r->n,
            isfinite(value) ? without : with);
}
