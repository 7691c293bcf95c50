/* The rubber as the stages after the DMA know it, and its material law at a temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/draws.h"

#include "base/clocale.h"
#include "data/prony.h"
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
        wt_master_clear(&rubber->master);
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

/* log10 a_T of a law. */
static wt_status horizontal_shift(const wt_shift_law *law, double reference, double temperature,
                                  double *log_a, wt_error *err)
{
    const double from = temperature - reference;
    *log_a = 0;
    if (isnan(from))
        return wt_fail(err, WT_E_MISSING, "the reference temperature of the material is not known");
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
    return WT_OK;
}

/* Standard error of log10 a_T by those of the constants of a law that came with them. */
static double law_error(const wt_rubber *rubber, double temperature)
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

static void make_statement(const wt_rubber *rubber, double temperature, bool held,
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

/* Series, law and log10 b at the isotherms that have one: of a replicate, or as fitted. */
static wt_status material_of(const wt_rubber *rubber, uint64_t seed, size_t replicate,
                             wt_prony *prony, wt_shift_law *law, double *log_b, wt_error *err)
{
    const wt_master *master = &rubber->master;
    *law = rubber->law;
    for (size_t i = 0; i < rubber->n_vertical; i++)
        log_b[i] = rubber->vertical_log_b[i];
    if (replicate == WT_NO_REPLICATE || !rubber->has_master)
        return prony_copy(&rubber->prony, prony, err);
    wt_status status = wt_master_draw(master, seed, replicate, prony, law, log_b, err);
    size_t n = 0;
    for (size_t i = 0; status == WT_OK && i < master->n_shifts; i++)
        if (master->shifts[i].determined)
            log_b[n++] = log_b[i];
    return status;
}

wt_status wt_rubber_at(const wt_rubber *rubber, double temperature, uint64_t seed, size_t replicate,
                       wt_material **material, char statement[256], wt_error *err)
{
    if (rubber == NULL || material == NULL)
        return wt_fail(err, WT_E_ARG, "no rubber");
    const double reference = rubber->prony.reference_temperature;
    wt_prony prony = {0};
    wt_shift_law law;
    double log_a = 0;
    bool held = false;
    const size_t n_b = rubber->has_master ? rubber->master.n_shifts : rubber->n_vertical;
    double *log_b = malloc((n_b + 1) * sizeof *log_b);
    if (log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = material_of(rubber, seed, replicate, &prony, &law, log_b, err);
    if (status == WT_OK && isnan(temperature))
        temperature = reference;
    else if (status == WT_OK)
        status = horizontal_shift(&law, reference, temperature, &log_a, err);
    if (status != WT_OK)
        goto done;
    if (!rubber->has_master && temperature != reference)
        log_a +=
            law_error(rubber, temperature) * flow_draw_normal(seed, replicate, FLOW_DRAW_SHIFT_LAW);
    const double a = pow(10, log_a), b = pow(10, vertical_shift(rubber, log_b, temperature, &held));
    prony.reference_temperature = temperature;
    prony.frequency_min /= a;
    prony.frequency_max /= a;
    prony.equilibrium_modulus /= b;
    for (size_t i = 0; i < prony.n; i++) {
        prony.relaxation_time[i] *= a;
        prony.modulus[i] /= b;
    }
    status = wt_material_prony(&prony, rubber->poisson_ratio, material, err);
    if (status == WT_OK && statement != NULL)
        make_statement(rubber, temperature, held, statement);
done:
    free(log_b);
    wt_prony_clear(&prony);
    return status;
}

/* ---- from tables ----------------------------------------------------------------------------- */

static wt_law_kind law_kind(const char *words)
{
    return strcmp(words, "WLF") == 0         ? WT_LAW_WLF
           : strcmp(words, "Arrhenius") == 0 ? WT_LAW_ARRHENIUS
           : strcmp(words, "joined") == 0    ? WT_LAW_JOINED
                                             : WT_LAW_NONE;
}

static wt_status read_shifts(const table_view *shifts, wt_rubber *rubber, wt_error *err)
{
    const char *vertical = shift_factors_words(shifts, SHIFT_FACTORS_KEY_VERTICAL);
    const char *correlation = shift_factors_words(shifts, SHIFT_FACTORS_KEY_WLF_CORRELATION);
    const char *kind = shift_factors_words(shifts, SHIFT_FACTORS_KEY_LAW);
    const wt_estimate c1 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C2);
    const size_t rows = shifts->n_rows;
    rubber->law = (wt_shift_law){
        .kind = law_kind(kind),
        .wlf = {rubber->prony.reference_temperature, c1.value, c2.value},
        .activation_energy = shift_factors_value(shifts, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY).value,
        .joint = shift_factors_value(shifts, SHIFT_FACTORS_KEY_JOINT).value};
    rubber->c1_error = c1.standard_error;
    rubber->c2_error = c2.standard_error;
    if (correlation != NULL &&
        !wt_number_parse(correlation, strlen(correlation), '.', &rubber->c_correlation))
        rubber->c_correlation = 0;
    rubber->vertical_temperature = malloc((rows + 1) * sizeof *rubber->vertical_temperature);
    rubber->vertical_log_b = malloc((rows + 1) * sizeof *rubber->vertical_log_b);
    if (rubber->vertical_temperature == NULL || rubber->vertical_log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < rows; i++) {
        double t = shift_factors_get(shifts, i, SHIFT_FACTORS_TEMPERATURE);
        double b = shift_factors_get(shifts, i, SHIFT_FACTORS_LOG_B_MATERIAL);
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
