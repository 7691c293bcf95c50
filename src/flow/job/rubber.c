/* The rubber as the stages after the DMA know it, and its material law at a temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/draws.h"

#include "base/clocale.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Without a shift law the material is used as it is up to this far from its reference [K]; a DMA
 * oven holds its temperature no better. */
#define SAME_TEMPERATURE 1.0

void wt_rubber_clear(wt_rubber *rubber)
{
    if (rubber == NULL)
        return;
    wt_prony_clear(&rubber->prony);
    free(rubber->vertical_temperature);
    free(rubber->vertical_log_b);
    if (rubber->has_master)
        wt_master_curve_clear(&rubber->master);
    *rubber = (wt_rubber){0};
}

/* log10 b_T, or a change of it at the isotherms, by linear interpolation; held outside, which *held
 * says, except that it is 0 at the reference temperature wherever that is. */
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
        double way = rubber->prony.reference_temperature - t[end], gone = temperature - t[end];
        *held = gone != 0;
        if ((end == 0 ? way < 0 : way > 0) && gone != 0)
            return b[end] * (1 - fmin(gone / way, 1));
        return b[end];
    }
    size_t i = 1;
    while (t[i] < temperature)
        i++;
    if (!(t[i] > t[i - 1]))
        return b[i];
    return b[i - 1] + (b[i] - b[i - 1]) * (temperature - t[i - 1]) / (t[i] - t[i - 1]);
}

/* log10 a_T of the WLF law and its standard error by propagation. */
static wt_status horizontal_shift(const wt_rubber *rubber, double temperature, double *log_a,
                                  double *log_a_error, wt_error *err)
{
    double from = temperature - rubber->prony.reference_temperature;
    *log_a = *log_a_error = 0;
    if (isnan(from))
        return wt_fail(err, WT_E_MISSING, "the reference temperature of the material is not known");
    if (!rubber->has_wlf) {
        if (fabs(from) <= SAME_TEMPERATURE)
            return WT_OK;
        wt_fail(err, WT_E_MISSING, "no shift law takes the material to another temperature");
        wt_error_expected(err, "a temperature within 1 K of %.2f degC",
                          rubber->prony.reference_temperature - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f degC", temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "give WLF constants, or DMA isotherms at several temperatures");
        return WT_E_MISSING;
    }
    *log_a = wt_wlf_log_shift(&rubber->wlf, temperature);
    if (isnan(*log_a)) {
        wt_fail(err, WT_E_RANGE, "the temperature is at or below the pole of the WLF law");
        wt_error_expected(err, "more than %.2f degC",
                          rubber->wlf.reference_temperature - rubber->wlf.c2 - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f degC", temperature - WT_ZERO_CELSIUS);
        return WT_E_RANGE;
    }
    double step = temperature - rubber->wlf.reference_temperature;
    double sum = rubber->wlf.c2 + step;
    if (isnan(rubber->c1_error) || isnan(rubber->c2_error)) {
        *log_a_error = fabs(step) * rubber->slope_error;
        return WT_OK;
    }
    double by_c1 = -step / sum * rubber->c1_error;
    double by_c2 = rubber->wlf.c1 * step / (sum * sum) * rubber->c2_error;
    double variance = by_c1 * by_c1 + by_c2 * by_c2 + 2 * rubber->c_correlation * by_c1 * by_c2;
    *log_a_error = variance > 0 ? sqrt(variance) : 0;
    return WT_OK;
}

static void make_statement(const wt_rubber *rubber, double temperature, bool held,
                           char statement[256])
{
    statement[0] = '\0';
    if (temperature < rubber->temperature_min || temperature > rubber->temperature_max)
        clocale_print(statement, 256,
                      "%.1f degC is outside the isotherms (%.1f to %.1f degC): the WLF law is "
                      "extrapolated%s",
                      temperature - WT_ZERO_CELSIUS, rubber->temperature_min - WT_ZERO_CELSIUS,
                      rubber->temperature_max - WT_ZERO_CELSIUS,
                      held ? " and the vertical shift held" : "");
}

/* Replicate of the series at the reference temperature, and what the same draw changes log10 b_T by
 * at another temperature. */
static wt_status material_replicate(const wt_rubber *rubber, double temperature, uint64_t seed,
                                    size_t replicate, wt_prony *prony, double *change,
                                    wt_error *err)
{
    const wt_master_curve *master = &rubber->master;
    double *change_b = malloc((master->n_shifts + 1) * sizeof *change_b);
    bool held;
    if (change_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status =
        wt_prony_replicate(master, &rubber->prony_options, seed, replicate, prony, change_b, err);
    if (status == WT_OK) {
        size_t n = 0; /* the rubber has the determined shifts only */
        for (size_t i = 0; i < master->n_shifts; i++)
            if (master->shifts[i].determined)
                change_b[n++] = change_b[i];
        *change = vertical_shift(rubber, change_b, temperature, &held);
    }
    free(change_b);
    return status;
}

wt_status wt_rubber_at(const wt_rubber *rubber, double temperature, uint64_t seed, size_t replicate,
                       wt_material **material, char statement[256], wt_error *err)
{
    if (rubber == NULL || material == NULL)
        return wt_fail(err, WT_E_ARG, "no rubber");
    wt_prony prony = {0};
    double log_a = 0, log_a_error = 0, log_b = 0;
    bool held = false;
    wt_status status = WT_OK;
    if (isnan(temperature))
        temperature = rubber->prony.reference_temperature;
    else
        status = horizontal_shift(rubber, temperature, &log_a, &log_a_error, err);
    if (status != WT_OK)
        return status;
    log_b = vertical_shift(rubber, rubber->vertical_log_b, temperature, &held);
    log_a += log_a_error * flow_draw_normal(seed, replicate, FLOW_DRAW_SHIFT_LAW);

    if (replicate != WT_NO_REPLICATE && rubber->has_master) {
        double change = 0;
        status = material_replicate(rubber, temperature, seed, replicate, &prony, &change, err);
        log_b += change;
    } else {
        status = wt_prony_alloc(&prony, rubber->prony.n, err);
        if (status == WT_OK) {
            prony.deformation = rubber->prony.deformation;
            prony.equilibrium_modulus = rubber->prony.equilibrium_modulus;
            for (size_t k = 0; k < prony.n; k++) {
                prony.relaxation_time[k] = rubber->prony.relaxation_time[k];
                prony.modulus[k] = rubber->prony.modulus[k];
            }
        }
    }
    if (status != WT_OK)
        goto done;
    double a = pow(10, log_a), b = pow(10, log_b);
    prony.reference_temperature = temperature;
    prony.frequency_min = rubber->prony.frequency_min / a;
    prony.frequency_max = rubber->prony.frequency_max / a;
    prony.equilibrium_modulus /= b;
    for (size_t i = 0; i < prony.n; i++) {
        prony.relaxation_time[i] *= a;
        prony.modulus[i] /= b;
    }
    status = wt_material_prony(&prony, rubber->poisson_ratio, material, err);
    if (status == WT_OK && statement != NULL)
        make_statement(rubber, temperature, held, statement);
done:
    wt_prony_clear(&prony);
    return status;
}

/* ---- from tables ----------------------------------------------------------------------------- */

static wt_status read_shifts(const table_view *shifts, wt_rubber *rubber, wt_error *err)
{
    const char *vertical = shift_factors_words(shifts, SHIFT_FACTORS_KEY_VERTICAL);
    const char *correlation = shift_factors_words(shifts, SHIFT_FACTORS_KEY_WLF_CORRELATION);
    const wt_estimate c1 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C2),
                      slope = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_SLOPE);
    const size_t rows = shifts->n_rows;
    rubber->wlf = (wt_wlf){rubber->prony.reference_temperature, c1.value, c2.value};
    rubber->has_wlf = isfinite(c1.value) && isfinite(c2.value);
    rubber->c1_error = c1.standard_error;
    rubber->c2_error = c2.standard_error;
    rubber->slope_error = isnan(slope.value) ? 0 : slope.standard_error;
    if (correlation != NULL &&
        !wt_number_parse(correlation, strlen(correlation), '.', &rubber->c_correlation))
        rubber->c_correlation = 0;
    rubber->vertical_temperature = malloc((rows + 1) * sizeof *rubber->vertical_temperature);
    rubber->vertical_log_b = malloc((rows + 1) * sizeof *rubber->vertical_log_b);
    if (rubber->vertical_temperature == NULL || rubber->vertical_log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < rows; i++) {
        double t = shift_factors_get(shifts, i, SHIFT_FACTORS_TEMPERATURE);
        double b = shift_factors_get(shifts, i, SHIFT_FACTORS_LOG_B);
        if (i == 0 || t < rubber->temperature_min)
            rubber->temperature_min = t;
        if (i == 0 || t > rubber->temperature_max)
            rubber->temperature_max = t;
        bool undetermined = shift_factors_get(shifts, i, SHIFT_FACTORS_DETERMINED) <= 0;
        if (isnan(t) || isnan(b) || undetermined || strcmp(vertical, "none") == 0)
            continue;
        rubber->vertical_temperature[rubber->n_vertical] = t;
        rubber->vertical_log_b[rubber->n_vertical++] = b;
    }
    return WT_OK;
}

static wt_status read_prony(const table_view *table, wt_prony *prony, wt_error *err)
{
    const char *deformation = prony_words(table, PRONY_KEY_DEFORMATION);
    wt_status status = wt_prony_alloc(prony, table->n_rows, err);
    if (status != WT_OK)
        return status;
    prony->frequency_min = prony_value(table, PRONY_KEY_FREQUENCY_MIN).value;
    prony->frequency_max = prony_value(table, PRONY_KEY_FREQUENCY_MAX).value;
    prony->reference_temperature = prony_value(table, PRONY_KEY_REFERENCE_TEMPERATURE).value;
    prony->equilibrium_modulus = prony_value(table, PRONY_KEY_EQUILIBRIUM_MODULUS).value;
    prony->deformation = strcmp(deformation, "shear") == 0 ? WT_SHEAR : WT_TENSION;
    if (isnan(prony->equilibrium_modulus) ||
        (prony->deformation == WT_TENSION && strcmp(deformation, "tension") != 0)) {
        wt_fail(err, WT_E_MISSING, "the table is not a Prony series");
        wt_error_expected(err, "keys equilibrium_modulus and deformation (tension or shear)");
        wt_error_advice(err, "give the prony table of `weartrack master`");
        return WT_E_MISSING;
    }
    for (size_t i = 0; i < prony->n; i++) {
        prony->relaxation_time[i] = prony_get(table, i, PRONY_RELAXATION_TIME);
        prony->modulus[i] = prony_get(table, i, PRONY_MODULUS);
        if (!(prony->relaxation_time[i] > 0) || !(prony->modulus[i] >= 0)) {
            wt_fail(err, WT_E_RANGE, "a Prony term is not positive");
            wt_error_place(err, "row %zu", i + 1);
            return WT_E_RANGE;
        }
    }
    return WT_OK;
}

wt_status wt_rubber_from_tables(const wt_table *prony, const wt_table *shift_factors,
                                double poisson_ratio, wt_rubber *result, wt_error *err)
{
    if (prony == NULL || result == NULL)
        return wt_fail(err, WT_E_ARG, "no Prony table");
    wt_rubber rubber = {.poisson_ratio = poisson_ratio,
                        .temperature_min = (double)NAN,
                        .temperature_max = (double)NAN};
    table_view view;
    wt_status status = table_bind(prony, &prony_schema, "", &view, err);
    if (status == WT_OK)
        status = read_prony(&view, &rubber.prony, err);
    if (status == WT_OK && shift_factors != NULL)
        status = table_bind(shift_factors, &shift_factors_schema, "", &view, err);
    if (status == WT_OK && shift_factors != NULL)
        status = read_shifts(&view, &rubber, err);
    if (status == WT_OK)
        *result = rubber;
    else
        wt_rubber_clear(&rubber);
    return status;
}
