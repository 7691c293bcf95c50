/* Modulus ratio of track and bulk at several indentation rates as a power of the frequency. The
 * frequency of a rate is the equivalent frequency of its curves, as in the comparison with DMA.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/friction.h"

#include "core/math/normal_quantile.h"
#include "core/math/students_t.h"
#include "core/table/registry.h"

#include <math.h>

/* Upper limit of the number of indentation rates. */
enum { MAX_RATES = 64 };

typedef struct rate_ratio {
    double log_frequency, log_ratio, error, df; /* standard error and degrees of freedom of ln
                                                   ratio */
} rate_ratio;

typedef struct rate_ratios {
    size_t n;
    rate_ratio item[MAX_RATES];
} rate_ratios;

/* Mean ln frequency of the curves of a row, over both groups; NaN if no frequency is available. */
static double mean_log_frequency(const table_view *rates, double low, double high)
{
    const double rounding = 1e-9;
    double sum = 0, n = 0;
    for (size_t i = 0; i < rates->n_rows; i++) {
        const double rate = modulus_rate_get(rates, i, MODULUS_RATE_RATE),
                     frequency = modulus_rate_get(rates, i, MODULUS_RATE_EQUIVALENT_FREQUENCY),
                     curves = modulus_rate_get(rates, i, MODULUS_RATE_N);
        if (rate < low * (1 - rounding) || rate > high * (1 + rounding) || !(frequency > 0))
            continue;
        sum += curves * log(frequency);
        n += curves;
    }
    return n > 0 ? sum / n : (double)NAN;
}

static wt_status read_rates(const table_view *comparison, const table_view *rates, rate_ratios *r,
                            wt_error *err)
{
    for (size_t i = 0; i < comparison->n_rows; i++) {
        const double low = comparison_get(comparison, i, COMPARISON_RATE_LOW),
                     high = comparison_get(comparison, i, COMPARISON_RATE_HIGH),
                     ratio_low = comparison_get(comparison, i, COMPARISON_RATIO_LOW),
                     ratio_high = comparison_get(comparison, i, COMPARISON_RATIO_HIGH),
                     welch_df = comparison_get(comparison, i, COMPARISON_WELCH_DF),
                     df = isnan(welch_df) ? (double)INFINITY : welch_df;
        const rate_ratio entry = {.log_frequency = mean_log_frequency(rates, low, high),
                                  .log_ratio = log(comparison_get(comparison, i, COMPARISON_RATIO)),
                                  .error =
                                      log(ratio_high / ratio_low) / 2 / students_t_quantile(df),
                                  .df = df};
        if (!isfinite(entry.log_frequency) || !isfinite(entry.log_ratio) || !(entry.error > 0))
            continue;
        if (r->n == MAX_RATES) {
            wt_fail(err, WT_E_RANGE, "a comparison at more indentation rates than can be");
            wt_error_expected(err, "at most %d", MAX_RATES);
            return WT_E_RANGE;
        }
        r->item[r->n++] = entry;
    }
    return WT_OK;
}

/* Weighted linear fit through the rates. The error of the slope has the effective degrees of
 * freedom of the errors of the points. It is enlarged if the points scatter more than their errors.
 * Systematic errors that all rates share (spots, cantilevers) do not change the slope, so that the
 * error is conservative. */
static void fit_slope(const rate_ratios *r, double *slope, double *error)
{
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0, chi = 0;
    t_error part[MAX_RATES];
    for (size_t i = 0; i < r->n; i++) {
        const double weight = 1 / (r->item[i].error * r->item[i].error);
        w += weight;
        wx += weight * r->item[i].log_frequency;
        wy += weight * r->item[i].log_ratio;
    }
    const double x0 = wx / w, y0 = wy / w;
    for (size_t i = 0; i < r->n; i++) {
        const double weight = 1 / (r->item[i].error * r->item[i].error),
                     x = r->item[i].log_frequency - x0;
        wxx += weight * x * x;
        wxy += weight * x * (r->item[i].log_ratio - y0);
    }
    *slope = wxy / wxx;
    for (size_t i = 0; i < r->n; i++) {
        const double x = r->item[i].log_frequency - x0;
        const double off = (r->item[i].log_ratio - y0 - *slope * x) / r->item[i].error;
        chi += off * off;
        part[i] = (t_error){fabs(x) / (r->item[i].error * wxx), r->item[i].df};
    }
    const t_error all = t_error_sum(part, r->n);
    const double scatter = r->n > 2 ? fmax(1, chi / (double)(r->n - 2)) : 1;
    *error = all.error * sqrt(scatter) * students_t_quantile(all.df) / NORMAL_95;
}

static wt_status set_ratio_slope(const rate_ratios *r, wt_layer_observation *observation,
                                 wt_error *err)
{
    double low = (double)INFINITY, high = -(double)INFINITY, sum = 0;
    for (size_t i = 0; i < r->n; i++) {
        low = fmin(low, r->item[i].log_frequency);
        high = fmax(high, r->item[i].log_frequency);
        sum += r->item[i].log_frequency;
    }
    if (!(high > low)) {
        wt_fail(err, WT_E_MISSING, "the modulus ratio is known at one indentation rate only");
        wt_error_expected(err, "bulk and track compared at two rates or more, with intervals");
        wt_error_found(err, "%zu with an interval and a frequency", r->n);
        wt_error_advice(err, "measure both groups at another rate, three spots each; or leave out "
                             "that the ratio goes with the rate");
        return WT_E_MISSING;
    }
    observation->ratio_slope = (wt_estimate){.unit = "1"};
    fit_slope(r, &observation->ratio_slope.value, &observation->ratio_slope.standard_error);
    observation->ratio_frequency = exp(sum / (double)r->n); /* each spot has all rates */
    observation->ratio_lowest = exp(low);
    observation->ratio_highest = exp(high);
    return WT_OK;
}

wt_status wt_layer_observation_from_rates(const wt_table *comparison, const wt_table *modulus_rate,
                                          wt_layer_observation *observation, wt_error *err)
{
    table_view c, m;
    rate_ratios r = {.n = 0};
    if (comparison == NULL || modulus_rate == NULL || observation == NULL) {
        wt_fail(err, WT_E_MISSING, "no comparison of wear track and bulk at several rates");
        wt_error_advice(err, "a ratio by rate needs curves of both at several rates; ratio-slope, "
                             "ratio-frequency, ratio-lowest and ratio-highest give it otherwise");
        return WT_E_MISSING;
    }
    wt_status status = table_bind(comparison, &comparison_schema, "", &c, err);
    if (status == WT_OK)
        status = table_bind(modulus_rate, &modulus_rate_schema, "", &m, err);
    if (status == WT_OK)
        status = read_rates(&c, &m, &r, err);
    if (status == WT_OK)
        status = set_ratio_slope(&r, observation, err);
    if (status != WT_OK)
        return status;
    const wt_estimate ratio = comparison_value(&c, COMPARISON_KEY_MODULUS_RATIO);
    const double df = comparison_value(&c, COMPARISON_KEY_MODULUS_RATIO_DF).value;
    if (!(ratio.value > 0))
        return wt_fail(err, WT_E_MISSING, "the comparison tells no modulus ratio of all rates");
    observation->modulus_ratio = ratio;
    observation->modulus_ratio.unit = "1"; /* the table uses another unit text */
    observation->modulus_ratio_df = isnan(df) ? 0 : df;
    return WT_OK;
}
