/* Which temperature is the reference: the one asked for, one that others can be shifted onto, or
 * the glass transition. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/master.h"

#include <math.h>

/* Where the peak of tan delta is looked for [decade], and how far beyond the isotherms its
 * temperature [K]. */
static const double step = 0.05, beyond = 20.0, close = 1e-6;

static double factor_at(const wt_posterior *p, double log_frequency)
{
    wt_interval modulus[WITH_LOSS_FACTOR];
    posterior_moduli(p, log_frequency * M_LN10, modulus);
    return modulus[LOSS_FACTOR].value;
}

/* log10 of the reduced angular frequency at which tan delta has its largest peak; NaN: it has none
 * within what was measured. */
static double find_peak(const wt_master *m)
{
    const size_t n = (size_t)floor((m->log_frequency[m->n - 1] - m->log_frequency[0]) / step);
    double y[3] = {0, 0, 0}, most = -HUGE_VAL, at = (double)NAN;
    for (size_t k = 0; k <= n; k++) {
        const double x = m->log_frequency[0] + step * (double)k;
        y[0] = y[1];
        y[1] = y[2];
        y[2] = factor_at(m->posterior, x);
        if (k < 2 || !(y[1] > y[0] && y[1] >= y[2] && y[1] > most))
            continue;
        most = y[1];
        at = x - step + 0.5 * step * (y[0] - y[2]) / (y[0] - 2.0 * y[1] + y[2]);
    }
    return at;
}

/* Where the law brings 1 Hz to the peak. */
static wt_status find_transition(const wt_master *m, double *temperature, wt_error *err)
{
    const double peak =
        m->n > 0 && wt_master_shifted_by(m) != WT_BY_LOSS ? find_peak(m) : (double)NAN;
    double low = m->shifts[0].temperature - beyond,
           high = m->shifts[m->n_shifts - 1].temperature + beyond;
    const double last = log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, high);
    if (m->law.kind == WT_LAW_NONE || isnan(peak) || !(last < peak)) {
        wt_fail(err, WT_E_RANGE, "no glass transition for a reference: %s",
                m->law.kind == WT_LAW_NONE ? "the shifts have no law"
                                           : "tan delta has no peak that was measured");
        wt_error_advice(err, "give a reference temperature");
        return WT_E_RANGE;
    }
    while (high - low > close) {
        const double middle = 0.5 * (low + high);
        if (log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, middle) < peak)
            high = middle;
        else
            low = middle; /* also below the pole */
    }
    *temperature = high;
    return WT_OK;
}

/* Where the isotherm in the middle is one of a glass, flat, the one that changes most is the
 * reference, unless one is asked for. */
static wt_status fit_somewhere(const wt_sweep *sweep, wt_master_options options, wt_parselog *log,
                               wt_master *master, wt_error *err)
{
    double better;
    wt_error flat = WT_ERROR_INIT;
    const wt_status status = master_fit_once(sweep, &options, log, master, &better, &flat);
    if (isnan(better) || !isnan(options.reference_temperature)) {
        if (status != WT_OK && err != NULL)
            *err = flat;
        return status;
    }
    wt_parselog_add(log, WT_WARNING, NULL, NULL,
                    "the isotherm in the middle is too flat to shift others onto it: the reference "
                    "is %.2f °C, where the modulus changes most with frequency",
                    better - WT_ZERO_CELSIUS);
    options.reference_temperature = better;
    return master_fit_once(sweep, &options, log, master, &better, err);
}

wt_status wt_master_fit(const wt_sweep *sweep, const wt_master_options *options, wt_parselog *log,
                        wt_master *master, wt_error *err)
{
    wt_master_options own = options != NULL ? *options : wt_master_options_defaults();
    if (own.reference_at != WT_REFERENCE_TAN_DELTA_PEAK)
        return fit_somewhere(sweep, own, log, master, err);
    if (!isnan(own.reference_temperature)) {
        wt_fail(err, WT_E_ARG, "two references: a temperature and the peak of tan delta");
        wt_error_place(err, "reference-at");
        wt_error_advice(err, "give one of them");
        return WT_E_ARG;
    }
    wt_master first = {0};
    wt_status status = fit_somewhere(sweep, own, NULL, &first, err);
    if (status == WT_OK)
        status = find_transition(&first, &own.reference_temperature, err);
    wt_master_clear(&first);
    return status == WT_OK ? fit_somewhere(sweep, own, log, master, err) : status;
}
