/* Isotherms of several strain amplitudes: a filled rubber softens with strain, so that a master
 * curve, and moduli against temperature, are of one. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/inputs.h"

#include <math.h>
#include <stdlib.h>

/* Kelvin within which two isotherms are of one temperature, and what makes their amplitudes two. */
static const double same_temperature = 1.5, other_amplitude = 2;

/* Geometric mean; NaN: not measured. */
static double amplitude(const wt_isotherm *t)
{
    double sum = 0;
    size_t n = 0;
    for (size_t i = 0; i < t->n && t->strain != NULL; i++)
        if (t->strain[i] > 0) {
            sum += log(t->strain[i]);
            n++;
        }
    return n > 0 ? exp(sum / (double)n) : (double)NAN;
}

/* Whether they are of one temperature, share frequencies and differ in amplitude. */
static bool differ(const wt_isotherm *a, const wt_isotherm *b)
{
    const double ratio = amplitude(a) / amplitude(b);
    return fabs(a->temperature - b->temperature) <= same_temperature && a->n > 0 && b->n > 0 &&
           a->angular_frequency[0] < b->angular_frequency[b->n - 1] &&
           b->angular_frequency[0] < a->angular_frequency[a->n - 1] &&
           (ratio > other_amplitude || ratio < 1 / other_amplitude);
}

static wt_status refuse(const wt_isotherm *a, const wt_isotherm *b, wt_error *err)
{
    const double low = 100 * fmin(amplitude(a), amplitude(b)),
                 high = 100 * fmax(amplitude(a), amplitude(b));
    wt_fail(err, WT_E_AMBIGUOUS, "isotherms of several strain amplitudes at one temperature");
    wt_error_place(err, "%s", a->source);
    wt_error_expected(err, "those of one amplitude, for a filled rubber softens with strain");
    wt_error_found(err, "%.3g %% and %.3g %% at %.1f degC", low, high,
                   a->temperature - WT_ZERO_CELSIUS);
    wt_error_advice(err, "choose one with --strain %.3g%%", low);
    return WT_E_AMBIGUOUS;
}

/* How far what was asked for is from what was measured. */
static void check_wanted(const wt_sweep *sweep, double wanted, wt_parselog *log)
{
    double nearest = (double)NAN;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const double here = amplitude(&sweep->isotherms[i]);
        if (isnan(nearest) || fabs(log2(here / wanted)) < fabs(log2(nearest / wanted)))
            nearest = here;
    }
    if (sweep->n_isotherms > 0 && isnan(nearest))
        wt_parselog_add(log, WT_WARNING, sweep->isotherms[0].source, NULL,
                        "isotherms of one strain are asked for, but no strain amplitude was read");
    else if (nearest / wanted > other_amplitude || wanted / nearest > other_amplitude)
        wt_parselog_add(log, WT_WARNING, sweep->isotherms[0].source, NULL,
                        "isotherms at a strain of %.3g %% are asked for; the nearest were measured "
                        "at %.3g %%",
                        100 * wanted, 100 * nearest);
}

wt_status flow_one_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                             wt_parselog *log, wt_error *err)
{
    const double wanted = n_sets > 0 ? sets[0].read.strain : (double)NAN;
    wt_sweep dropped = {0};
    size_t kept = 0;
    bool *drop = calloc(sweep->n_isotherms + 1, sizeof *drop);
    dropped.isotherms = calloc(sweep->n_isotherms + 1, sizeof *dropped.isotherms);
    wt_status status = drop == NULL || dropped.isotherms == NULL
                           ? wt_fail(err, WT_E_MEMORY, "out of memory")
                           : WT_OK;
    for (size_t i = 0; i < sweep->n_isotherms && status == WT_OK; i++)
        for (size_t k = i + 1; k < sweep->n_isotherms && status == WT_OK; k++) {
            const wt_isotherm *a = &sweep->isotherms[i], *b = &sweep->isotherms[k];
            if (!differ(a, b))
                continue;
            if (isnan(wanted))
                status = refuse(a, b, err);
            else if (fabs(log2(amplitude(a) / wanted)) <= fabs(log2(amplitude(b) / wanted)))
                drop[k] = true;
            else
                drop[i] = true;
        }
    for (size_t i = 0; i < sweep->n_isotherms && status == WT_OK; i++)
        if (drop[i])
            dropped.isotherms[dropped.n_isotherms++] = sweep->isotherms[i];
        else
            sweep->isotherms[kept++] = sweep->isotherms[i];
    if (status == WT_OK)
        sweep->n_isotherms = kept;
    if (dropped.n_isotherms > 0)
        wt_parselog_add(log, WT_WARNING, dropped.isotherms[0].source, NULL,
                        "%zu isotherm%s of other strain amplitudes left out", dropped.n_isotherms,
                        dropped.n_isotherms > 1 ? "s" : "");
    if (status == WT_OK && !isnan(wanted))
        check_wanted(sweep, wanted, log);
    wt_sweep_clear(&dropped);
    free(drop);
    return status;
}
