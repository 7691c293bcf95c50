/* Tables of the relaxation spectrum: density with its error, reduced series and fractional Zener
 * law.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"
#include "dma/sweep_input.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>

wt_interval flow_power_of_ten(wt_interval log)
{
    return (wt_interval){pow(10, log.value), (double)NAN, pow(10, log.low), pow(10, log.high)};
}

TABLE_ROW(relaxation_spectrum, RELAXATION_SPECTRUM, double relaxation_time; wt_interval density;)

wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&relaxation_spectrum_schema, err);
    for (size_t i = 0; i < m->prony.n; i++) {
        wt_interval density;
        wt_master_spectrum(m, i, &density);
        if (!isnan(density.value))
            TABLE_ADD(relaxation_spectrum, &t, m->prony.relaxation_time[i],
                      flow_power_of_ten(density));
    }
    relaxation_spectrum_set_value(&t, RELAXATION_SPECTRUM_KEY_REFERENCE_TEMPERATURE,
                                  m->reference_temperature, 0, 0);
    relaxation_spectrum_set_text(&t, RELAXATION_SPECTRUM_KEY_DEFORMATION,
                                 flow_deformation_name(m->deformation));
    return table_end(&t, table);
}

/* Returns the largest relative half width of the 95 % intervals of a modulus. */
static double widest_interval(const wt_interval *fitted, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, pow(10, 0.5 * (fitted[i].high - fitted[i].low)) - 1);
    return most;
}

/* Sets the keys of the fractional Zener law with tensile moduli, in the syntax of the friction
 * option, and its comparison with the series. */
static void set_zener_keys(const wt_master *m, const wt_prony *p, double poisson_ratio,
                           table_writer *t)
{
    const double to_young = m->deformation == WT_SHEAR ? 2 * (1 + poisson_ratio) : 1;
    char words[256];
    wt_zener_fit z;
    if (wt_master_zener(m, p, &z, NULL) != WT_OK)
        return; /* without a fitted law the keys stay unset */
    clocale_print(words, sizeof words, "fractional-zener:e0=%.4gPa,eg=%.4gPa,tau=%.4gs,alpha=%.4g",
                  to_young * z.e0, to_young * z.eg, z.tau, z.alpha);
    prony_reduced_set_text(t, PRONY_REDUCED_KEY_ZENER,
                           z.determined ? words : "none: the points do not reach its glass");
    clocale_print(
        words, sizeof words,
        "%s by AICc, lower by %.3g; off the points (rms of E', E'') by %.2g %% and %.2g %%, the "
        "fractional Zener law by %.3g %% and %.3g %%",
        z.series_aicc < z.aicc ? "the Prony series" : "the fractional Zener law",
        fabs(z.aicc - z.series_aicc), 100 * z.series_rms_storage, 100 * z.series_rms_loss,
        100 * z.rms_storage, 100 * z.rms_loss);
    if (!isnan(z.aicc) && !isnan(z.series_aicc))
        prony_reduced_set_text(t, PRONY_REDUCED_KEY_BETTER, words);
}

TABLE_ROW(prony_reduced, PRONY_REDUCED, double relaxation_time, modulus, share;)

static wt_status build_reduced_table(const wt_master *m, const wt_prony *p, double poisson_ratio,
                                     wt_table **table, wt_error *err)
{
    double sum = p->equilibrium_modulus, deviation[2];
    table_writer t = table_begin(&prony_reduced_schema, err);
    wt_prony_deviation(&m->prony, p, deviation);
    for (size_t i = 0; i < p->n; i++)
        sum += p->modulus[i];
    for (size_t i = 0; i < p->n; i++)
        TABLE_ADD(prony_reduced, &t, p->relaxation_time[i], p->modulus[i], p->modulus[i] / sum);
    const struct {
        prony_reduced_key key;
        double value;
    } values[] = {{PRONY_REDUCED_KEY_EQUILIBRIUM_MODULUS, p->equilibrium_modulus},
                  {PRONY_REDUCED_KEY_INSTANTANEOUS_MODULUS, sum},
                  {PRONY_REDUCED_KEY_REFERENCE_TEMPERATURE, p->reference_temperature},
                  {PRONY_REDUCED_KEY_FREQUENCY_MIN, p->frequency_min},
                  {PRONY_REDUCED_KEY_FREQUENCY_MAX, p->frequency_max}},
      plain[] = {{PRONY_REDUCED_KEY_DEVIATION_STORAGE, deviation[0]},
                 {PRONY_REDUCED_KEY_DEVIATION_LOSS, deviation[1]},
                 {PRONY_REDUCED_KEY_INTERVAL_STORAGE, widest_interval(m->fitted_storage, m->n)},
                 {PRONY_REDUCED_KEY_INTERVAL_LOSS, widest_interval(m->fitted_loss, m->n)}};
    for (size_t i = 0; i < COUNT_OF(values); i++)
        prony_reduced_set_value(&t, values[i].key, values[i].value, (double)NAN, 0);
    for (size_t i = 0; i < COUNT_OF(plain); i++)
        prony_reduced_set_print(&t, plain[i].key, "%.3g", plain[i].value);
    prony_reduced_set_text(&t, PRONY_REDUCED_KEY_DEFORMATION,
                           flow_deformation_name(p->deformation));
    set_zener_keys(m, p, poisson_ratio, &t);
    return table_end(&t, table);
}

/* Builds the table of the reduced series. It warns if the deviation exceeds the requested limit. */
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err)
{
    const wt_reduction *options = &job->reduction;
    wt_prony p = {0};
    double deviation[2];
    wt_status status = wt_prony_reduce(&m->prony, options, &p, err);
    if (status == WT_OK)
        status = build_reduced_table(m, &p, job->poisson_ratio, table, err);
    if (status == WT_OK) {
        wt_prony_deviation(&m->prony, &p, deviation);
        const double most = fmax(deviation[0], deviation[1]);
        if (most > options->error)
            wt_log_add(work->log, WT_WARNING, NULL, NULL,
                       "the reduced Prony series of %zu term%s is off the spectrum by up to "
                       "%.3g %%, more than the %.3g %% of --prony-error: %s",
                       p.n, p.n == 1 ? "" : "s", 100 * most, 100 * options->error,
                       options->terms > 0 ? "more terms are closer"
                                          : "its long-term modulus may not be that of the rubber");
    }
    wt_prony_clear(&p);
    return status;
}
