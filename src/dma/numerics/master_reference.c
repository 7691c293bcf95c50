/* Chooses the reference temperature: the requested one, one onto which others can be shifted, or
 * the glass transition.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/clocale.h"
#include "core/math/root.h"

#include <math.h>

/* Step of the search for the peak of tan delta [decade], before a parabola through three points.
 * A peak of E'' is at least 1.14 decades wide at half height. */
static const double step = 0.05;
/* Maximum distance of the reference from the isotherms [K]. Farther away the data do not
 * determine the law. Chosen; beyond it the user must state the reference. */
static const double max_extrapolation = 20.0;
/* [K], far below the accuracy of a thermometer */
static const double temperature_tolerance = 1e-6;

static double fitted_loss_factor(const wt_posterior *p, double log_frequency)
{
    wt_interval modulus[WITH_LOSS_FACTOR];
    posterior_moduli(p, log_frequency * M_LN10, false, modulus);
    return modulus[LOSS_FACTOR].value;
}

/* Returns log10 of the reduced angular frequency of the largest peak of tan delta. NaN if there
 * is no peak in the measured range. */
static double find_loss_factor_peak(const wt_master *m)
{
    const size_t n = (size_t)floor((m->log_frequency[m->n - 1] - m->log_frequency[0]) / step);
    double y[3] = {0, 0, 0}, most = -HUGE_VAL, at = (double)NAN;
    for (size_t k = 0; k <= n; k++) {
        const double x = m->log_frequency[0] + step * (double)k;
        y[0] = y[1];
        y[1] = y[2];
        y[2] = fitted_loss_factor(m->posterior, x);
        if (k < 2 || !(y[1] > y[0] && y[1] >= y[2] && y[1] > most))
            continue;
        most = y[1];
        at = x - step + 0.5 * step * (y[0] - y[2]) / (y[0] - 2.0 * y[1] + y[2]);
    }
    return at;
}

typedef struct reference_search {
    const wt_shift_law *law;
    double peak;
} reference_search;

/* Returns true below the peak, and also below the pole of the law, where it has no value. */
static bool is_below_peak(double temperature, void *user)
{
    const reference_search *s = user;
    return !(log10(2.0 * M_PI) + wt_shift_law_log_a(s->law, temperature) < s->peak);
}

/* Finds the temperature at which the law shifts 1 Hz to the peak. */
static wt_status find_transition_temperature(const wt_master *m, double *temperature, wt_error *err)
{
    const double peak = m->n > 0 && wt_master_shift_quantity(m) != WT_SHIFT_LOSS
                            ? find_loss_factor_peak(m)
                            : (double)NAN;
    double low = m->shifts[0].temperature - max_extrapolation,
           high = m->shifts[m->n_shifts - 1].temperature + max_extrapolation;
    const bool law = m->law.kind != WT_LAW_NONE;
    const double first = law ? log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, low) : 0.0,
                 last = law ? log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, high) : 0.0;
    if (!law || isnan(peak) || first < peak || !(last < peak)) { /* first is NaN below the pole */
        char peak_position[64];
        clocale_print(peak_position, sizeof peak_position,
                      "at 1 Hz tan delta peaks more than %g K %s the isotherms", max_extrapolation,
                      first < peak ? "below" : "above");
        wt_fail(err, WT_E_RANGE, "no glass transition for a reference: %s",
                !law          ? "the shifts have no law"
                : isnan(peak) ? "tan delta has no peak that was measured"
                              : peak_position);
        wt_error_advice(err, "give a reference temperature");
        return WT_E_RANGE;
    }
    reference_search search = {&m->law, peak};
    root_bisect(is_below_peak, &search, &low, &high, 0,
                (int)ceil(log2((high - low) / temperature_tolerance)));
    *temperature = high;
    return WT_OK;
}

static void forward_log(const wt_log *from, wt_log *to)
{
    for (size_t i = 0; i < wt_log_count(from); i++) {
        const wt_log_entry e = wt_log_get(from, i);
        for (size_t k = 0; k < e.count; k++)
            wt_log_add_topic(to, e.severity, e.topic, e.file, e.place, "%s", e.text);
    }
}

/* Fits, and if the middle isotherm is too flat repeats the fit with the steepest one as
 * reference, unless a reference is stated. */
static wt_status fit_with_fallback_reference(const wt_sweep *sweep, wt_master_options options,
                                             wt_log *log, wt_master *master, wt_error *err)
{
    double better;
    wt_error flat = WT_ERROR_INIT;
    wt_log *first_log = wt_log_new(); /* buffered, because a second fit repeats the messages */
    if (first_log == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the remarks of a fit");
    const wt_status status = master_fit_once(sweep, &options, first_log, master, &better, &flat);
    const bool is_final = isnan(better) || !isnan(options.reference_temperature);
    if (is_final)
        forward_log(first_log, log);
    wt_log_free(first_log);
    if (is_final) {
        if (status != WT_OK && err != NULL)
            *err = flat;
        return status;
    }
    wt_log_add(log, WT_WARNING, NULL, NULL,
               "the isotherm in the middle is too flat to shift others onto it: the reference "
               "is %.2f °C, where the modulus changes most with frequency",
               better - WT_ZERO_CELSIUS);
    options.reference_temperature = better;
    return master_fit_once(sweep, &options, log, master, &better, err);
}

wt_status wt_master_fit(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                        wt_master *master, wt_error *err)
{
    wt_master_options adjusted = options != NULL ? *options : wt_master_options_defaults();
    if (adjusted.reference_at != WT_REFERENCE_TAN_DELTA_PEAK)
        return fit_with_fallback_reference(sweep, adjusted, log, master, err);
    if (!isnan(adjusted.reference_temperature)) {
        wt_fail(err, WT_E_ARG, "two references: a temperature and the peak of tan delta");
        wt_error_place(err, "reference-at");
        wt_error_advice(err, "give one of them");
        return WT_E_ARG;
    }
    wt_master first = {0};
    wt_status status = fit_with_fallback_reference(sweep, adjusted, NULL, &first, err);
    if (status == WT_OK)
        status = find_transition_temperature(&first, &adjusted.reference_temperature, err);
    wt_master_clear(&first);
    return status == WT_OK ? fit_with_fallback_reference(sweep, adjusted, log, master, err)
                           : status;
}
