/* A rubber without a Prony series: a table of moduli, the points of a master curve, or a
 * fractional Zener law.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"

#include "core/base/array.h"
#include "dma/law_parse.h"
#include "dma/sweep_input.h"
#include "job/inputs.h"

#include "core/base/clocale.h"
#include "core/base/range_text.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

wt_rubber_options wt_rubber_options_defaults(void)
{
    return (wt_rubber_options){.moduli = WT_MODULI_SERIES, .extrapolation = WT_EXTRAPOLATE_HOLD};
}

static const wt_param option_rows[] = {
    {PARAM_CHOICE_OF("moduli", wt_rubber_options, moduli, "series|points"),
     .help = "of isotherms: the Prony series, or the points of the master curve, linear in log-log "
             "between them and without an error"},
    {PARAM_CHOICE_OF("extrapolation", wt_rubber_options, extrapolation, "hold|slope"),
     .help = "outside the points of a table: the end values hold, or the end slopes go on"},
};
PARAM_TABLE(wt_rubber_options_params, wt_rubber_options, option_rows, wt_rubber_options_defaults,
            NO_PARTS)

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

wt_status flow_rubber_read(flow_file *file, const wt_rubber_options *options, double poisson_ratio,
                           const wt_job *work, wt_rubber *rubber, wt_error *err)
{
    wt_input *input = NULL;
    wt_rubber made = new_rubber(WT_RUBBER_TABLE, poisson_ratio);
    made.extrapolation = options->extrapolation;
    wt_status status = flow_open(work, file, "material", WT_KIND_SWEEP, &input, err);
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

wt_status wt_rubber_open(const char *text, const wt_read_options *read,
                         const wt_rubber_options *options, double poisson_ratio, const wt_job *work,
                         wt_rubber *rubber, wt_error *err)
{
    if (text == NULL || rubber == NULL || work == NULL)
        return wt_fail(err, WT_E_ARG, "no material");
    wt_zener zener = flow_zener_defaults();
    const wt_rubber_options o = options != NULL ? *options : wt_rubber_options_defaults();
    if (flow_has_law_prefix(&zener_text, text)) {
        const wt_status status = flow_law_parse(&zener_text, text, &zener, err);
        return status == WT_OK ? flow_rubber_zener(&zener, poisson_ratio, rubber, err) : status;
    }
    const wt_file_set set = {.read = read != NULL ? *read : wt_read_defaults()};
    flow_file file = {.path = text, .name = text, .set = &set};
    return flow_law_suggest(&zener_text, text,
                            flow_rubber_read(&file, &o, poisson_ratio, work, rubber, err), err);
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
    curve_point *p = calloc(view->n_rows + 1, sizeof *p);
    if (p == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = WT_OK;
    const size_t n = merge_points(view, p);
    wt_isotherm *points = n < 2 ? NULL : wt_sweep_add(sweep, n, 0);
    if (n < 2)
        status = wt_fail(err, WT_E_EMPTY, "the master curve has %zu points that can be used", n);
    else if (points == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; points != NULL && i < n; i++) {
        points->angular_frequency[i] = exp(p[i].frequency);
        points->storage_modulus[i] = exp(p[i].storage);
        points->loss_modulus[i] = exp(p[i].loss);
    }
    free(p);
    return status;
}

wt_status wt_rubber_tabulate(wt_rubber *rubber, const wt_table *master_curve,
                             const wt_rubber_options *options, wt_error *err)
{
    if (rubber == NULL || options == NULL)
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
    rubber->extrapolation = options->extrapolation;
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
            law, sizeof law, "%zu points from %s rad/s, outside the end %s",
            rubber->sweep.isotherms[0].n,
            format_range(rubber->prony.frequency_min, rubber->prony.frequency_max, 3).text,
            rubber->extrapolation == WT_EXTRAPOLATE_HOLD ? "values" : "slopes");
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
