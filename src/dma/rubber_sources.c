/* Creates the rubber from its sources: the tables of the DMA job with the draws that contain its
 * uncertainty, a table of moduli, or a fractional Zener law. The tables may come from an untrusted
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/registry.h"
#include "dma/law_parse.h"
#include "dma/sweep_input.h"
#include "job/inputs.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- table of moduli or fractional Zener law ------------------------------------------------- */

/* Points of several isotherms closer than this in ln omega are averaged: a twentieth of a
 * decade. */
#define MERGE_WIDTH (0.05 * M_LN10)

static wt_rubber new_rubber(wt_rubber_kind kind, double poisson_ratio)
{
    const double unknown = (double)NAN;
    return (wt_rubber){.kind = kind,
                       .prony = {.deformation = WT_TENSION,
                                 .reference_temperature = unknown,
                                 .frequency_min = unknown,
                                 .frequency_max = unknown},
                       .poisson_ratio = poisson_ratio,
                       .temperature_min = unknown,
                       .temperature_max = unknown};
}

/* Checks that the material can be created at its reference temperature. */
static wt_status check_rubber(const wt_rubber *rubber, wt_error *err)
{
    wt_material *material = NULL;
    const wt_status status =
        wt_rubber_material(rubber, (double)NAN, 0, WT_NO_REPLICATE, &material, NULL, err);
    if (status == WT_OK)
        wt_material_free(material);
    return status;
}

/* ---- fractional Zener ------------------------------------------------------------------------ */

wt_zener flow_zener_defaults(void)
{
    const double unset = (double)NAN;
    return (wt_zener){.e0 = unset, .eg = unset, .tau = unset, .alpha = unset};
}

static const wt_param zener_rows[] = {
    {PARAM("e0", wt_zener, e0, WT_Q_MODULUS, AT_LEAST(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "modulus after a long time"},
    {PARAM("eg", wt_zener, eg, WT_Q_MODULUS, ABOVE(0)), .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "modulus of the glass"},
    {PARAM("tau", wt_zener, tau, WT_Q_TIME, ABOVE(0)), .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "relaxation time"},
    {PARAM("alpha", wt_zener, alpha, WT_Q_NONE, ABOVE_TO(0, 1)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "exponent: E = (E0 + Eg z) / (1 + z), z = (i omega tau)^alpha; 1 is the Zener solid"},
};

PARAM_TABLE(flow_zener_params, wt_zener, zener_rows, flow_zener_defaults, NO_PARTS)

static const flow_law_text zener_text = {
    .prefix = "fractional-zener:",
    .name = "fractional Zener law",
    .what = "material",
    .example = "e0=5MPa,eg=2GPa,tau=1us,alpha=0.4",
    .params = flow_zener_params,
};

wt_status flow_rubber_zener(const wt_zener *zener, double poisson_ratio, wt_rubber *rubber,
                            wt_error *err)
{
    wt_rubber made = new_rubber(WT_RUBBER_ZENER, poisson_ratio);
    made.zener = *zener;
    const wt_status status = check_rubber(&made, err);
    if (status == WT_OK)
        *rubber = made;
    return status;
}

/* ---- points ---------------------------------------------------------------------------------- */

static void set_frequency_range(wt_rubber *rubber, const wt_isotherm *points)
{
    rubber->prony.deformation = rubber->sweep.deformation;
    rubber->prony.frequency_min = points->angular_frequency[0];
    rubber->prony.frequency_max = points->angular_frequency[points->n - 1];
}

wt_status flow_rubber_read(flow_file *file, double poisson_ratio, const wt_job *work,
                           wt_rubber *rubber, wt_error *err)
{
    wt_input *input = NULL;
    wt_rubber made = new_rubber(WT_RUBBER_TABLE, poisson_ratio);
    wt_status status = flow_open(work, file, WT_ROLE_MATERIAL, WT_KIND_SWEEP, &input, err);
    wt_read_options read = flow_read_options(file);
    read.allow_missing_temperature = true;
    if (status == WT_OK)
        status = wt_sweep_read(work->formats, input, &read, work->log, &made.sweep, err);
    wt_input_close(input);
    if (status == WT_OK)
        status = flow_require_oscillation(&made.sweep, "a table of the material", err);
    if (status == WT_OK && made.sweep.n_isotherms != 1) {
        status = wt_fail(err, WT_E_ARG, "a table of the material has one temperature");
        wt_error_found(err, "%zu isotherms", made.sweep.n_isotherms);
        wt_error_advice(err, "give several isotherms as a DMA, which makes one curve of them");
    }
    if (status == WT_OK) {
        wt_sweep_sort(&made.sweep); /* by frequency */
        set_frequency_range(&made, &made.sweep.isotherms[0]);
        made.prony.reference_temperature = made.sweep.isotherms[0].temperature;
        status = check_rubber(&made, err);
    }
    if (status == WT_OK) {
        *rubber = made;
        return WT_OK;
    }
    wt_error_file(err, file->name);
    wt_rubber_clear(&made);
    return status;
}

wt_status wt_rubber_open(const char *text, const wt_read_options *read, double poisson_ratio,
                         const wt_job *work, wt_rubber *rubber, wt_error *err)
{
    if (text == NULL || rubber == NULL || work == NULL)
        return wt_fail(err, WT_E_ARG, "no material");
    wt_zener zener = flow_zener_defaults();
    if (flow_has_law_prefix(&zener_text, text)) {
        const wt_status status = flow_law_parse(&zener_text, text, &zener, err);
        return status == WT_OK ? flow_rubber_zener(&zener, poisson_ratio, rubber, err) : status;
    }
    const wt_file_set set = {.read = read != NULL ? *read : wt_read_defaults()};
    flow_file file = {.path = text, .name = text, .set = &set};
    return flow_law_suggest(&zener_text, text,
                            flow_rubber_read(&file, poisson_ratio, work, rubber, err), err);
}

/* ---- the points of a master curve ------------------------------------------------------------ */

typedef struct curve_point {
    double frequency, storage, loss; /* natural logarithms */
} curve_point;

/* Collects the points that are not excluded, sorts them and averages close ones. Returns their
 * number. */
static size_t merge_points(const table_view *view, curve_point *p)
{
    size_t n = 0, joined = 0;
    for (size_t i = 0; i < view->n_rows; i++) {
        p[n] = (curve_point){log(master_curve_get(view, i, MASTER_CURVE_ANGULAR_FREQUENCY)),
                             log(master_curve_get(view, i, MASTER_CURVE_STORAGE_MODULUS)),
                             log(master_curve_get(view, i, MASTER_CURVE_LOSS_MODULUS))};
        n += !(master_curve_get(view, i, MASTER_CURVE_LEFT_OUT) > 0) && isfinite(p[n].frequency) &&
             isfinite(p[n].storage) && isfinite(p[n].loss);
    }
    if (n > 0)
        qsort(p, n, sizeof *p, numbers_compare);
    for (size_t i = 0; i < n;) {
        curve_point mean = {0, 0, 0};
        size_t count = 0;
        const double first = p[i].frequency;
        for (; i < n && (count == 0 || p[i].frequency < first + MERGE_WIDTH); i++) {
            const double share = 1 / (double)++count;
            mean.frequency += share * (p[i].frequency - mean.frequency);
            mean.storage += share * (p[i].storage - mean.storage);
            mean.loss += share * (p[i].loss - mean.loss);
        }
        p[joined++] = mean;
    }
    return joined;
}

static wt_status read_curve_points(const table_view *view, wt_sweep *sweep, wt_error *err)
{
    curve_point *p = wt_alloc(view->n_rows, sizeof *p);
    wt_status status = WT_OK;
    const size_t n = merge_points(view, p);
    wt_isotherm *points = n < 2 ? NULL : wt_sweep_add(sweep, n, 0);
    if (points == NULL)
        status = wt_fail(err, WT_E_EMPTY, "the master curve has %zu points that can be used", n);
    for (size_t i = 0; points != NULL && i < n; i++) {
        points->angular_frequency[i] = exp(p[i].frequency);
        points->storage_modulus[i] = exp(p[i].storage);
        points->loss_modulus[i] = exp(p[i].loss);
    }
    free(p);
    return status;
}

wt_status wt_rubber_tabulate(wt_rubber *rubber, const wt_table *master_curve, wt_error *err)
{
    if (rubber == NULL)
        return wt_fail(err, WT_E_ARG, "no rubber");
    table_view view;
    wt_sweep sweep = {.n_isotherms = 0};
    wt_status status = table_bind(master_curve, &master_curve_schema, "", &view, err);
    if (status == WT_OK)
        status = read_curve_points(&view, &sweep, err);
    if (status != WT_OK)
        return status;
    sweep.deformation = master_curve_key_enum(&view, MASTER_CURVE_KEY_DEFORMATION) == WT_SHEAR
                            ? WT_SHEAR
                            : WT_TENSION;
    const double reference =
        master_curve_value(&view, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value;
    wt_prony_clear(&rubber->prony);
    wt_sweep_clear(&rubber->sweep);
    flow_rubber_clear_draws(rubber);
    rubber->c1_error = rubber->c2_error = 0; /* they are not the whole error of the points */
    rubber->kind = WT_RUBBER_TABLE;
    rubber->sweep = sweep;
    rubber->prony.reference_temperature = reference;
    set_frequency_range(rubber, &sweep.isotherms[0]);
    if (rubber->n_vertical == 0 && rubber->law.kind == WT_LAW_NONE)
        rubber->temperature_min = rubber->temperature_max = (double)NAN;
    return check_rubber(rubber, err);
}

/* ---- description ----------------------------------------------------------------------------- */

static void describe_transverse(const wt_rubber *rubber, char *text, size_t size)
{
    const wt_transverse *t = &rubber->transverse;
    const double nu = rubber->poisson_ratio;
    clocale_print(text, size,
                  "transversely isotropic: Ez %g E' + %g i E'', Ep %g E' + %g i E'', shear %g and "
                  "%g times those of E, nu_p %g, nu_zp %g",
                  t->axial_storage, t->axial_loss, t->plane_storage, t->plane_loss,
                  t->shear_storage, t->shear_loss, isnan(t->plane_poisson) ? nu : t->plane_poisson,
                  isnan(t->axial_poisson) ? nu : t->axial_poisson);
}

size_t wt_rubber_describe(const wt_rubber *rubber, char *buffer, size_t size)
{
    char law[128] = "", transverse[256] = "";
    if (rubber->kind == WT_RUBBER_TABLE)
        clocale_print(
            law, sizeof law, "%zu points from %s rad/s, outside the end values",
            rubber->sweep.isotherms[0].n,
            format_range(rubber->prony.frequency_min, rubber->prony.frequency_max, 3).text);
    else if (rubber->kind == WT_RUBBER_ZENER)
        clocale_print(law, sizeof law,
                      "fractional Zener, E0 %.4g Pa, Eg %.4g Pa, tau %.4g s, alpha %.4g",
                      rubber->zener.e0, rubber->zener.eg, rubber->zener.tau, rubber->zener.alpha);
    if (rubber->is_transverse)
        describe_transverse(rubber, transverse, sizeof transverse);
    const int n =
        snprintf(buffer, size, "%s%s%s", law, law[0] && transverse[0] ? "; " : "", transverse);
    return n > 0 ? (size_t)n : 0;
}

/* ---- tables of the DMA job ------------------------------------------------------------------- */

static void read_shift_factors(const table_view *shifts, wt_rubber *rubber)
{
    const bool level =
        shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_VERTICAL) == WT_VERTICAL_NONE;
    const char *correlation = shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_WLF_CORRELATION);
    const int kind = shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_LAW);
    const int verdict = shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const wt_estimate c1 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C2);
    const size_t rows = shifts->n_rows;
    rubber->law = (wt_shift_law){
        .kind = kind <= WT_LAW_WLF_ARRHENIUS ? (wt_law_kind)kind : WT_LAW_NONE,
        .wlf = {rubber->prony.reference_temperature, c1.value, c2.value},
        .activation_energy = shift_factors_value(shifts, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY).value,
        .joint = shift_factors_value(shifts, SHIFT_FACTORS_KEY_JOINT).value};
    rubber->superposition = verdict <= WT_SUPERPOSITION_INCONCLUSIVE ? (wt_superposition)verdict
                                                                     : WT_SUPERPOSITION_HOLDS;
    rubber->c1_error = c1.standard_error;
    rubber->c2_error = c2.standard_error;
    if (correlation != NULL &&
        (!wt_number_parse(correlation, strlen(correlation), '.', &rubber->c_correlation) ||
         !isfinite(rubber->c_correlation)))
        rubber->c_correlation = 0; /* also for constants without errors */
    rubber->vertical_temperature = wt_alloc(rows, sizeof *rubber->vertical_temperature);
    rubber->vertical_log_b = wt_alloc(rows, sizeof *rubber->vertical_log_b);
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
}

static wt_status read_prony(const table_view *table, wt_prony *prony, wt_error *err)
{
    const int deformation = prony_key_enum(table, PRONY_KEY_DEFORMATION);
    wt_prony_alloc(prony, table->n_rows);
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
    wt_prony_alloc(&d->prony, n);
    d->log_b = wt_alloc(rubber->n_vertical, sizeof *d->log_b);
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
    rubber->draws = wt_alloc(n_draws, sizeof *rubber->draws);
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
        read_shift_factors(&view, &rubber);
    if (status == WT_OK && tables->material_draws != NULL)
        status = read_draws(tables->material_draws, tables->series_draws, &rubber, err);
    if (status == WT_OK)
        *result = rubber;
    else
        wt_rubber_clear(&rubber);
    return status;
}
