/* The rubber that later stages use, and its material law at a temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include "core/base/text.h"

#include <math.h>
#include <stdlib.h>

/* Without a shift law the material is valid within 1 K of its reference, the stability of a DMA
 * oven. */
#define SAME_TEMPERATURE 1.0

void flow_rubber_clear_draws(wt_rubber *rubber)
{
    for (size_t i = 0; i < rubber->n_draws; i++) {
        wt_prony_clear(&rubber->draws[i].prony);
        free(rubber->draws[i].log_b);
    }
    free(rubber->draws);
    rubber->draws = NULL;
    rubber->n_draws = 0;
}

void wt_rubber_clear(wt_rubber *rubber)
{
    if (rubber == NULL)
        return;
    wt_prony_clear(&rubber->prony);
    free(rubber->vertical_temperature);
    free(rubber->vertical_log_b);
    flow_rubber_clear_draws(rubber);
    wt_sweep_clear(&rubber->sweep);
    *rubber = (wt_rubber){0};
}

/* Interpolates log10 b_T, or its change, linearly between the isotherms. Outside it is constant
 * and *held is true, but it tends to 0 at the reference temperature. */
static double vertical_shift(const wt_rubber *rubber, const double *b, double temperature,
                             bool *held)
{
    const double *t = rubber->vertical_temperature;
    size_t n = rubber->n_vertical;
    *held = false;
    if (n == 0)
        return 0;
    if (temperature <= t[0] || temperature >= t[n - 1]) {
        size_t end = temperature <= t[0] ? 0 : n - 1;
        double reference_distance = rubber->prony.reference_temperature - t[end],
               distance = temperature - t[end];
        *held = distance != 0;
        if ((end == 0 ? reference_distance < 0 : reference_distance > 0) && distance != 0)
            return b[end] * (1 - fmin(distance / reference_distance, 1));
        return b[end];
    }
    size_t i = 1;
    while (t[i] < temperature)
        i++;
    if (!(t[i] > t[i - 1]))
        return b[i];
    return b[i - 1] + (b[i] - b[i - 1]) * (temperature - t[i - 1]) / (t[i] - t[i - 1]);
}

/* Limit of log10 aT. A double covers 308 decades of time and frequency. */
static const double most_decades = 200;

/* Computes log10 a_T of a law, or fails if the law does not reach the temperature. */
static wt_status horizontal_shift(const wt_shift_law *law, double reference, double temperature,
                                  double *log_a, wt_error *err)
{
    const double from = temperature - reference;
    *log_a = 0;
    if (isnan(from)) {
        wt_fail(err, WT_E_MISSING, "the reference temperature of the material is not known");
        wt_error_advice(err, "give --reference-temperature");
        wt_error_options(err, "reference-temperature");
        return WT_E_MISSING;
    }
    if (law->kind == WT_LAW_NONE) {
        if (fabs(from) <= SAME_TEMPERATURE)
            return WT_OK;
        wt_fail(err, WT_E_MISSING, "no shift law takes the material to another temperature");
        wt_error_expected(err, "a temperature within 1 K of %.2f degC",
                          reference - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f degC", temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "give WLF constants, or DMA isotherms at several temperatures");
        return WT_E_MISSING;
    }
    *log_a = wt_shift_law_log_a(law, temperature);
    if (isnan(*log_a)) {
        wt_fail(err, WT_E_RANGE, "the temperature is at or below the pole of the WLF law");
        wt_error_expected(err, "more than %.2f degC",
                          law->wlf.reference_temperature - law->wlf.c2 - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f degC", temperature - WT_ZERO_CELSIUS);
        return WT_E_RANGE;
    }
    if (fabs(*log_a) > most_decades) {
        wt_fail(err, WT_E_RANGE, "the temperature is out of reach of the shift law");
        wt_error_expected(err, "one at which log10 aT is from -%g to %g", most_decades,
                          most_decades);
        wt_error_found(err, "%.2f degC, at which it is %.3g", temperature - WT_ZERO_CELSIUS,
                       *log_a);
        return WT_E_RANGE;
    }
    return WT_OK;
}

bool flow_rubber_can_shift(const wt_rubber *rubber, double temperature, wt_error *reason)
{
    double log_a;
    return isnan(temperature) || horizontal_shift(&rubber->law, rubber->prony.reference_temperature,
                                                  temperature, &log_a, reason) == WT_OK;
}

/* Returns the standard error of log10 a_T from the errors of stated WLF constants. */
static double shift_law_error(const wt_rubber *rubber, double temperature)
{
    const wt_wlf *wlf = &rubber->law.wlf;
    if (rubber->law.kind != WT_LAW_WLF)
        return 0;
    const double step = temperature - wlf->reference_temperature, sum = wlf->c2 + step;
    const double by_c1 = -step / sum * rubber->c1_error;
    const double by_c2 = wlf->c1 * step / (sum * sum) * rubber->c2_error;
    const double variance =
        by_c1 * by_c1 + by_c2 * by_c2 + 2 * rubber->c_correlation * by_c1 * by_c2;
    return variance > 0 ? sqrt(variance) : 0;
}

static void write_extrapolation_note(const wt_rubber *rubber, double temperature, bool held,
                                     char statement[256])
{
    statement[0] = '\0';
    if (temperature < rubber->temperature_min || temperature > rubber->temperature_max)
        clocale_print(statement, 256,
                      "%.1f degC is outside the isotherms (%.1f to %.1f degC): the shift law is "
                      "extrapolated%s",
                      temperature - WT_ZERO_CELSIUS, rubber->temperature_min - WT_ZERO_CELSIUS,
                      rubber->temperature_max - WT_ZERO_CELSIUS,
                      held ? " and the vertical shift held" : "");
}

/* Returns the draw of a replicate. The default seed starts with the first draw, other seeds
 * start later. NULL means the fitted values. */
static const wt_rubber_draw *replicate_draw(const wt_rubber *rubber, uint64_t seed,
                                            size_t replicate)
{
    if (replicate == WT_NO_REPLICATE || rubber->n_draws == 0)
        return NULL;
    const size_t first = (size_t)((seed - 1) * 64 % rubber->n_draws);
    return &rubber->draws[(first + replicate) % rubber->n_draws];
}

wt_shift_law flow_rubber_shift_law(const wt_rubber *rubber, uint64_t seed, size_t replicate)
{
    const wt_rubber_draw *draw = replicate_draw(rubber, seed, replicate);
    return draw != NULL ? draw->law : rubber->law;
}

/* Copies the series, with times multiplied by a and moduli divided by b. */
static void shifted_series(const wt_rubber *rubber, const wt_rubber_draw *draw, double temperature,
                           double a, double b, wt_prony *prony)
{
    const wt_prony *const from = draw != NULL ? &draw->prony : &rubber->prony;
    wt_prony_alloc(prony, from->n);
    prony->deformation = from->deformation;
    prony->reference_temperature = temperature;
    prony->frequency_min = from->frequency_min / a;
    prony->frequency_max = from->frequency_max / a;
    prony->equilibrium_modulus = from->equilibrium_modulus / b;
    for (size_t i = 0; i < from->n; i++) {
        prony->relaxation_time[i] = from->relaxation_time[i] * a;
        prony->modulus[i] = from->modulus[i] / b;
    }
}

static wt_status table_material(const wt_rubber *rubber, double a, double b, wt_material **material,
                                wt_error *err)
{
    const wt_isotherm *points = &rubber->sweep.isotherms[0];
    const size_t n = points->n;
    const double to_young =
        rubber->sweep.deformation == WT_SHEAR ? 2 * (1 + rubber->poisson_ratio) : 1;
    double *omega = wt_alloc(3 * n, sizeof *omega);
    double *storage = omega + n, *loss = storage + n;
    for (size_t i = 0; i < n; i++) {
        omega[i] = points->angular_frequency[i] / a;
        storage[i] = to_young / b * points->storage_modulus[i];
        loss[i] = to_young / b * points->loss_modulus[i];
    }
    const wt_status status = wt_material_table(omega, storage, loss, n, rubber->poisson_ratio,
                                               WT_EXTRAPOLATE_HOLD, material, err);
    free(omega);
    return status;
}

/* Creates the material, with times multiplied by a and moduli divided by b. */
static wt_status rubber_material(const wt_rubber *rubber, const wt_rubber_draw *draw,
                                 double temperature, double a, double b, wt_material **material,
                                 wt_error *err)
{
    const wt_zener *z = &rubber->zener;
    wt_prony prony = {0};
    if (rubber->kind == WT_RUBBER_TABLE)
        return table_material(rubber, a, b, material, err);
    if (rubber->kind == WT_RUBBER_ZENER)
        return wt_material_fractional_zener(z->e0 / b, z->eg / b, z->tau * a, z->alpha,
                                            rubber->poisson_ratio, material, err);
    shifted_series(rubber, draw, temperature, a, b, &prony);
    const wt_status status = wt_material_prony(&prony, rubber->poisson_ratio, material, err);
    wt_prony_clear(&prony);
    return status;
}

/* Computes the factors of times and moduli at a temperature. NaN means the reference, which then
 * replaces it. held: the factor of the moduli is extrapolated. */
static wt_status temperature_factors(const wt_rubber *rubber, const wt_rubber_draw *draw,
                                     uint64_t seed, size_t replicate, double *temperature,
                                     double *a, double *b, bool *held, wt_error *err)
{
    const double reference = rubber->prony.reference_temperature;
    const wt_shift_law *law = draw != NULL ? &draw->law : &rubber->law;
    const double *log_b = draw != NULL ? draw->log_b : rubber->vertical_log_b;
    double log_a = 0;
    wt_status status = WT_OK;
    if (isnan(*temperature))
        *temperature = reference;
    else
        status = horizontal_shift(law, reference, *temperature, &log_a, err);
    if (status != WT_OK)
        return status;
    if (rubber->n_draws == 0 && *temperature != reference)
        log_a += shift_law_error(rubber, *temperature) *
                 flow_draw_normal(seed, replicate, FLOW_DRAW_SHIFT_LAW);
    *a = pow(10, log_a);
    *b = pow(10, vertical_shift(rubber, log_b, *temperature, held));
    return WT_OK;
}

wt_status wt_rubber_material(const wt_rubber *rubber, double temperature, uint64_t seed,
                             size_t replicate, wt_material **material, char statement[256],
                             wt_error *err)
{
    if (rubber == NULL || material == NULL)
        return wt_fail(err, WT_E_ARG, "no rubber");
    const wt_rubber_draw *draw = replicate_draw(rubber, seed, replicate);
    wt_material *made = NULL;
    double a = 1, b = 1;
    bool held = false;
    wt_status status =
        temperature_factors(rubber, draw, seed, replicate, &temperature, &a, &b, &held, err);
    if (status == WT_OK)
        status = rubber_material(rubber, draw, temperature, a, b, &made, err);
    if (status == WT_OK && rubber->is_transverse)
        status = wt_material_transverse(made, NULL, NULL, &rubber->transverse,
                                        rubber->poisson_ratio, &made, err);
    if (status != WT_OK)
        return status;
    *material = made;
    if (statement != NULL)
        write_extrapolation_note(rubber, temperature, held, statement);
    return WT_OK;
}

wt_status flow_rubber_spectrum(const wt_rubber *rubber, double temperature, wt_prony *prony,
                               char statement[256], wt_error *err)
{
    wt_material *checked = NULL;
    double a = 1, b = 1;
    bool held = false;
    wt_status status =
        temperature_factors(rubber, NULL, 1, WT_NO_REPLICATE, &temperature, &a, &b, &held, err);
    if (status == WT_OK)
        shifted_series(rubber, NULL, temperature, a, b, prony);
    if (status == WT_OK)
        status = wt_material_prony(prony, rubber->poisson_ratio, &checked, err);
    wt_material_free(checked);
    if (status != WT_OK)
        return status;
    write_extrapolation_note(rubber, temperature, held, statement);
    const double to_young = prony->deformation == WT_SHEAR ? 2 * (1 + rubber->poisson_ratio) : 1;
    prony->deformation = WT_TENSION;
    prony->equilibrium_modulus *= to_young;
    for (size_t i = 0; i < prony->n; i++)
        prony->modulus[i] *= to_young;
    return WT_OK;
}

enum { ZENER_CONSTANTS = 4 }; /* of the fractional Zener model */

void wt_rubber_add_cost(const wt_rubber *rubber, const wt_job *work)
{
    const size_t items = rubber->kind == WT_RUBBER_TABLE   ? rubber->sweep.isotherms[0].n
                         : rubber->kind == WT_RUBBER_ZENER ? ZENER_CONSTANTS
                                                           : rubber->prony.n;
    cost_report(work, (cost_summary){.items = (double)items});
}
