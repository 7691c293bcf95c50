/* Creates the rubber from the tables of the DMA job, with the draws that contain its
 * uncertainty. The tables may come from an untrusted file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/dma.h"

#include "core/table/registry.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static wt_status read_shift_factors(const table_view *shifts, wt_rubber *rubber, wt_error *err)
{
    const bool level =
        shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_VERTICAL) == WT_VERTICAL_NONE;
    const char *correlation = shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_WLF_CORRELATION);
    const int kind = shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_LAW);
    const wt_estimate c1 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C2);
    const size_t rows = shifts->n_rows;
    rubber->law = (wt_shift_law){
        .kind = kind <= WT_LAW_WLF_ARRHENIUS ? kind : WT_LAW_NONE,
        .wlf = {rubber->prony.reference_temperature, c1.value, c2.value},
        .activation_energy = shift_factors_value(shifts, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY).value,
        .joint = shift_factors_value(shifts, SHIFT_FACTORS_KEY_JOINT).value};
    rubber->c1_error = c1.standard_error;
    rubber->c2_error = c2.standard_error;
    if (correlation != NULL &&
        (!wt_number_parse(correlation, strlen(correlation), '.', &rubber->c_correlation) ||
         !isfinite(rubber->c_correlation)))
        rubber->c_correlation = 0; /* also for constants without errors */
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
        if (isnan(t) || isnan(b) || undetermined || level || rows < 2)
            continue;
        rubber->vertical_temperature[rubber->n_vertical] = t;
        rubber->vertical_log_b[rubber->n_vertical++] = b;
    }
    return WT_OK;
}

static wt_status read_prony(const table_view *table, wt_prony *prony, wt_error *err)
{
    const int deformation = prony_key_enum(table, PRONY_KEY_DEFORMATION);
    wt_status status = wt_prony_alloc(prony, table->n_rows, err);
    if (status != WT_OK)
        return status;
    prony->frequency_min = prony_value(table, PRONY_KEY_FREQUENCY_MIN).value;
    prony->frequency_max = prony_value(table, PRONY_KEY_FREQUENCY_MAX).value;
    prony->reference_temperature = prony_value(table, PRONY_KEY_REFERENCE_TEMPERATURE).value;
    prony->equilibrium_modulus = prony_value(table, PRONY_KEY_EQUILIBRIUM_MODULUS).value;
    prony->deformation = deformation == WT_SHEAR ? WT_SHEAR : WT_TENSION;
    if (isnan(prony->equilibrium_modulus) || deformation > WT_SHEAR) {
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

/* ---- draws ----------------------------------------------------------------------------------- */

static wt_status fail_draw(const table_view *view, size_t row, const char *expected, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "the draws of the material cannot be used");
    wt_error_place(err, "row %zu of %s", row + 1, view->schema->name);
    wt_error_expected(err, "%s", expected);
    wt_error_advice(err, "make the file anew with `weartrack master`");
    return WT_E_RANGE;
}

/* Checks that every draw has the same number of rows and that the draws are in order. */
static wt_status check_draw_order(const table_view *view, size_t n_draws, long column,
                                  wt_error *err)
{
    const size_t each = view->n_rows / n_draws;
    for (size_t i = 0; i < view->n_rows; i++)
        if (each * n_draws != view->n_rows ||
            wt_table_number(view->table, i, (size_t)column) != (double)(i / each + 1))
            return fail_draw(view, i, "draws 1, 2, 3 ... with as many rows each", err);
    return WT_OK;
}

static bool is_finite_above(double x, double least)
{
    return isfinite(x) && x > least;
}

/* Constants that the kind of law lacks stay NaN, as in the fitted law. */
static wt_status read_draw_law(const table_view *view, size_t first, const wt_rubber *rubber,
                               wt_rubber_draw *draw, wt_error *err)
{
    const wt_law_kind kind = rubber->law.kind;
    const double c1 = material_draws_get(view, first, MATERIAL_DRAWS_WLF_C1),
                 c2 = material_draws_get(view, first, MATERIAL_DRAWS_WLF_C2),
                 energy = material_draws_get(view, first, MATERIAL_DRAWS_ACTIVATION_ENERGY);
    const bool has_wlf = kind == WT_LAW_WLF || kind == WT_LAW_WLF_ARRHENIUS,
               has_energy = kind == WT_LAW_ARRHENIUS || kind == WT_LAW_WLF_ARRHENIUS;
    if ((has_wlf && (!isfinite(c1) || !isfinite(c2))) || (has_energy && !isfinite(energy)))
        return fail_draw(view, first, "the constants of the law of the shift factors", err);
    draw->law = rubber->law;
    draw->law.wlf.c1 = c1;
    draw->law.wlf.c2 = c2;
    draw->law.activation_energy = energy;
    return WT_OK;
}

static wt_status read_one_draw(const table_view *material, const table_view *series, size_t draw,
                               wt_rubber *rubber, wt_error *err)
{
    wt_rubber_draw *d = &rubber->draws[draw];
    const size_t first = draw * (material->n_rows / rubber->n_draws),
                 n = series->n_rows / rubber->n_draws;
    wt_status status = wt_prony_alloc(&d->prony, n, err);
    d->log_b = malloc((rubber->n_vertical + 1) * sizeof *d->log_b);
    if (status != WT_OK || d->log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    d->prony.deformation = rubber->prony.deformation;
    d->prony.reference_temperature = rubber->prony.reference_temperature;
    d->prony.frequency_min = rubber->prony.frequency_min;
    d->prony.frequency_max = rubber->prony.frequency_max;
    d->prony.equilibrium_modulus =
        material_draws_get(material, first, MATERIAL_DRAWS_EQUILIBRIUM_MODULUS);
    if (!is_finite_above(d->prony.equilibrium_modulus, -DBL_MIN))
        return fail_draw(material, first, "an equilibrium modulus, 0 or above", err);
    for (size_t k = 0; k < rubber->n_vertical; k++) {
        d->log_b[k] = material_draws_get(material, first + k, MATERIAL_DRAWS_LOG_B);
        if (!isfinite(d->log_b[k]) ||
            material_draws_get(material, first + k, MATERIAL_DRAWS_TEMPERATURE) !=
                rubber->vertical_temperature[k])
            return fail_draw(material, first + k, "log_b_material at each shifted isotherm", err);
    }
    for (size_t k = 0; k < n; k++) {
        const size_t row = draw * n + k;
        d->prony.relaxation_time[k] = series_draws_get(series, row, SERIES_DRAWS_RELAXATION_TIME);
        d->prony.modulus[k] = series_draws_get(series, row, SERIES_DRAWS_MODULUS);
        if (!is_finite_above(d->prony.relaxation_time[k], 0) ||
            !is_finite_above(d->prony.modulus[k], -DBL_MIN))
            return fail_draw(series, row, "a relaxation time above 0 and a modulus", err);
    }
    return read_draw_law(material, first, rubber, d, err);
}

static wt_status read_draws(const wt_table *material_draws, const wt_table *series_draws,
                            wt_rubber *rubber, wt_error *err)
{
    table_view material, series;
    wt_status status = table_bind(material_draws, &material_draws_schema, "", &material, err);
    if (status == WT_OK)
        status = table_bind(series_draws, &series_draws_schema, "", &series, err);
    if (status != WT_OK)
        return status;
    const size_t rows = material.n_rows;
    const double last = rows > 0 ? material_draws_get(&material, rows - 1, MATERIAL_DRAWS_DRAW) : 0;
    const wt_estimate reference =
        material_draws_value(&material, MATERIAL_DRAWS_KEY_REFERENCE_TEMPERATURE);
    if (!(last >= 1) || !(last <= (double)rows) || series.n_rows < (size_t)last ||
        (rubber->n_vertical > 0 && (double)rubber->n_vertical * last != (double)rows))
        return fail_draw(&material, rows > 0 ? rows - 1 : 0,
                         "draws 1, 2, 3 ... with a row for each shifted isotherm", err);
    if (reference.value != rubber->prony.reference_temperature)
        return fail_draw(&material, 0, "the reference temperature of the Prony series", err);
    const size_t n_draws = (size_t)last;
    status = check_draw_order(&material, n_draws, material.column[MATERIAL_DRAWS_DRAW], err);
    if (status == WT_OK)
        status = check_draw_order(&series, n_draws, series.column[SERIES_DRAWS_DRAW], err);
    if (status != WT_OK)
        return status;
    rubber->draws = calloc(n_draws, sizeof *rubber->draws);
    if (rubber->draws == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    rubber->n_draws = n_draws;
    for (size_t i = 0; status == WT_OK && i < n_draws; i++)
        status = read_one_draw(&material, &series, i, rubber, err);
    return status;
}

/* ---- the rubber ------------------------------------------------------------------------------ */

wt_status wt_rubber_from_tables(const wt_rubber_tables *tables, double poisson_ratio,
                                wt_rubber *result, wt_error *err)
{
    if (tables == NULL || tables->prony == NULL || result == NULL)
        return wt_fail(err, WT_E_ARG, "no Prony table");
    if ((tables->material_draws == NULL) != (tables->series_draws == NULL)) {
        wt_fail(err, WT_E_MISSING, "one of the two tables of draws is missing");
        wt_error_expected(err, "material_draws and series_draws, or neither");
        return WT_E_MISSING;
    }
    wt_rubber rubber = {.poisson_ratio = poisson_ratio,
                        .temperature_min = (double)NAN,
                        .temperature_max = (double)NAN};
    table_view view;
    wt_status status = table_bind(tables->prony, &prony_schema, "", &view, err);
    if (status == WT_OK)
        status = read_prony(&view, &rubber.prony, err);
    if (status == WT_OK && tables->shift_factors != NULL)
        status = table_bind(tables->shift_factors, &shift_factors_schema, "", &view, err);
    if (status == WT_OK && tables->shift_factors != NULL)
        status = read_shift_factors(&view, &rubber, err);
    if (status == WT_OK && tables->material_draws != NULL)
        status = read_draws(tables->material_draws, tables->series_draws, &rubber, err);
    if (status == WT_OK)
        *result = rubber;
    else
        wt_rubber_clear(&rubber);
    return status;
}
