/* Selects the isotherms and temperature sweeps of one strain amplitude. A filled rubber softens
 * with strain, so a master curve belongs to one amplitude.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"

#include <math.h>
#include <stdlib.h>

/* Two runs of one chamber agree within 1.5 K. Exports with four digits differ by 5e-4 in
 * frequency. Two amplitudes are different if their ratio exceeds 2, as in
 * dma/numerics/master_add_notes.c. */
static const double same_temperature = 1.5, same_frequency = 1e-3, amplitude_ratio_limit = 2;

/* Amplitude of an isotherm or a temperature sweep (NaN if unmeasured) with its ranges of
 * temperature [K] and angular frequency [rad/s]. */
typedef struct sweep_entry {
    const char *source;
    bool is_ramp, drop;
    double amplitude, temperature[2], frequency[2];
} sweep_entry;

/* Returns the geometric mean of the positive amplitudes, or NaN if there is none. */
static double mean_amplitude(const double *strain, size_t n)
{
    double sum = 0;
    size_t n_positive = 0;
    for (size_t i = 0; i < n && strain != NULL; i++)
        if (strain[i] > 0) {
            sum += log(strain[i]);
            n_positive++;
        }
    return n_positive > 0 ? exp(sum / (double)n_positive) : (double)NAN;
}

/* Lists the isotherms first, then the temperature sweeps. An entry without points overlaps no
 * other entry. */
static void list_sweep_entries(const wt_sweep *sweep, sweep_entry *entries)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *t = &sweep->isotherms[i];
        *entries++ =
            (sweep_entry){.source = t->source,
                          .amplitude = mean_amplitude(t->strain, t->n),
                          .temperature = {t->temperature, t->temperature},
                          .frequency = {t->n > 0 ? t->angular_frequency[0] : (double)NAN,
                                        t->n > 0 ? t->angular_frequency[t->n - 1] : (double)NAN}};
    }
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        const wt_ramp *r = &sweep->ramps[i];
        *entries++ =
            (sweep_entry){.source = r->source,
                          .is_ramp = true,
                          .amplitude = mean_amplitude(r->strain, r->n),
                          .temperature = {r->n > 0 ? r->temperature[0] : (double)NAN,
                                          r->n > 0 ? r->temperature[r->n - 1] : (double)NAN},
                          .frequency = {r->angular_frequency * (1 - same_frequency),
                                        r->angular_frequency * (1 + same_frequency)}};
    }
}

/* Returns true if both share temperatures and frequencies and differ in amplitude. */
static bool amplitudes_differ(const sweep_entry *a, const sweep_entry *b)
{
    const double ratio = a->amplitude / b->amplitude;
    return a->temperature[0] <= b->temperature[1] + same_temperature &&
           b->temperature[0] <= a->temperature[1] + same_temperature &&
           a->frequency[0] < b->frequency[1] && b->frequency[0] < a->frequency[1] &&
           (ratio > amplitude_ratio_limit || ratio < 1 / amplitude_ratio_limit);
}

static wt_status fail_mixed_amplitudes(const sweep_entry *a, const sweep_entry *b, wt_error *err)
{
    const double low = 100 * fmin(a->amplitude, b->amplitude),
                 high = 100 * fmax(a->amplitude, b->amplitude);
    const char *const sweep_kind = !a->is_ramp && !b->is_ramp ? "isotherms"
                                   : a->is_ramp && b->is_ramp ? "temperature sweeps"
                                                              : "isotherms and temperature sweeps";
    wt_fail(err, WT_E_AMBIGUOUS, "%s of several strain amplitudes at one temperature", sweep_kind);
    wt_error_place(err, "%s", a->source);
    wt_error_expected(err, "those of one amplitude, for a filled rubber softens with strain");
    wt_error_found(err, "%.3g %% and %.3g %% at %.1f degC", low, high,
                   fmax(a->temperature[0], b->temperature[0]) - WT_ZERO_CELSIUS);
    wt_error_advice(err, "choose one with --strain %.3g%%", low);
    return WT_E_AMBIGUOUS;
}

static bool is_closer_to_target(const sweep_entry *a, const sweep_entry *b, double target)
{
    return fabs(log2(a->amplitude / target)) <= fabs(log2(b->amplitude / target));
}

/* Warns if the requested amplitude differs by more than a factor of 2 from every measured
 * amplitude. */
static void warn_unmatched_strain(const sweep_entry *entries, size_t n, double target, wt_log *log)
{
    const sweep_entry *nearest = NULL;
    for (size_t i = 0; i < n; i++)
        if (!isnan(entries[i].amplitude) &&
            (nearest == NULL || !is_closer_to_target(nearest, &entries[i], target)))
            nearest = &entries[i];
    if (n > 0 && nearest == NULL)
        wt_log_add(log, WT_WARNING, entries[0].source, NULL,
                   "sweeps of one strain are asked for, but no strain amplitude was read");
    else if (n > 0 && (nearest->amplitude / target > amplitude_ratio_limit ||
                       target / nearest->amplitude > amplitude_ratio_limit))
        wt_log_add(log, WT_WARNING, nearest->source, NULL,
                   "sweeps at a strain of %.3g %% are asked for; the nearest were measured "
                   "at %.3g %%",
                   100 * target, 100 * nearest->amplitude);
}

/* Moves the excluded sweeps to a temporary sweep and frees them. Logs the number of excluded
 * sweeps. */
static void remove_other_amplitudes(wt_sweep *sweep, const sweep_entry *entries, wt_log *log)
{
    wt_sweep dropped = {0};
    const sweep_entry *const ramps = entries + sweep->n_isotherms;
    size_t isotherms = 0, kept = 0;
    dropped.isotherms = wt_alloc(sweep->n_isotherms, sizeof *dropped.isotherms);
    dropped.ramps = wt_alloc(sweep->n_ramps, sizeof *dropped.ramps);
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        if (entries[i].drop)
            dropped.isotherms[dropped.n_isotherms++] = sweep->isotherms[i];
        else
            sweep->isotherms[isotherms++] = sweep->isotherms[i];
    for (size_t i = 0; i < sweep->n_ramps; i++)
        if (ramps[i].drop)
            dropped.ramps[dropped.n_ramps++] = sweep->ramps[i];
        else
            sweep->ramps[kept++] = sweep->ramps[i];
    sweep->n_isotherms = isotherms;
    sweep->n_ramps = kept;
    if (dropped.n_isotherms > 0)
        wt_log_add(log, WT_WARNING, dropped.isotherms[0].source, NULL,
                   "%zu isotherm%s of other strain amplitudes left out", dropped.n_isotherms,
                   dropped.n_isotherms > 1 ? "s" : "");
    if (dropped.n_ramps > 0)
        wt_log_add(log, WT_WARNING, dropped.ramps[0].source, NULL,
                   "%zu temperature sweep%s of other strain amplitudes left out", dropped.n_ramps,
                   dropped.n_ramps > 1 ? "s" : "");
    wt_sweep_clear(&dropped);
}

wt_status flow_select_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                                wt_log *log, wt_error *err)
{
    const double target = n_sets > 0 ? sets[0].read.strain : (double)NAN;
    const size_t n = sweep->n_isotherms + sweep->n_ramps;
    sweep_entry *entries = wt_alloc(n, sizeof *entries);
    wt_status status = WT_OK;
    list_sweep_entries(sweep, entries);
    for (size_t i = 0; i < n && status == WT_OK; i++)
        for (size_t k = i + 1; k < n && status == WT_OK; k++) {
            if (!amplitudes_differ(&entries[i], &entries[k]))
                continue;
            if (isnan(target))
                status = fail_mixed_amplitudes(&entries[i], &entries[k], err);
            else if (is_closer_to_target(&entries[i], &entries[k], target))
                entries[k].drop = true;
            else
                entries[i].drop = true;
        }
    if (status == WT_OK && !isnan(target))
        warn_unmatched_strain(entries, n, target, log);
    if (status == WT_OK)
        remove_other_amplitudes(sweep, entries, log);
    free(entries);
    return status;
}
