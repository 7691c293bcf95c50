/* Parametric bootstrap of a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/parametric_bootstrap.h"
#include "dma/sweep_input.h"
#include "job/random_draws.h"

#include "core/base/array.h"
#include "dma/law/prony_law.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* ---- isotherms ------------------------------------------------------------------------------- */

static const wt_master_shift *find_shift(const wt_master *fit, double temperature, size_t *k)
{
    for (*k = 0; *k < fit->n_shifts; ++*k)
        if (!(fabs(fit->shifts[*k].temperature - temperature) > 0))
            return fit->shifts[*k].determined ? &fit->shifts[*k] : NULL;
    return NULL;
}

/* log10 a_T of the simulated isotherm: by the shift law at a scattered temperature, because an oven
 * has this scatter. Without a law it is the fitted value, and a stated shift stays fixed. */
static double draw_true_shift(const wt_isotherm *measured, const wt_master *fit, size_t k,
                              uint64_t seed)
{
    const wt_master_shift *s = &fit->shifts[k];
    const double at = wt_shift_law_log_a(&fit->law, s->temperature);
    if (measured->shift_is_stated || fit->law.kind == WT_LAW_NONE || isnan(at))
        return s->log_a.value;
    const double spread = isfinite(fit->temperature_spread) ? fit->temperature_spread : 0;
    const double step = spread * flow_draw_normal(seed, k, FLOW_DRAW_ISOTHERM);
    const double moved = wt_shift_law_log_a(&fit->law, s->temperature + step);
    return isnan(moved) ? at : moved;
}

static wt_status draw_isotherm(const wt_isotherm *measured, const wt_master *fit, size_t k,
                               double shift, uint64_t seed, wt_sweep *sweep)
{
    const wt_master_shift *s = &fit->shifts[k];
    wt_isotherm *iso = wt_sweep_add(sweep, measured->n, 0);
    double noise[2] = {0, 0};
    if (iso == NULL)
        return WT_E_MEMORY;
    iso->temperature = measured->temperature;
    iso->shift_is_stated = measured->shift_is_stated;
    iso->stated_log_a = measured->stated_log_a;
    iso->vertical_shift_is_stated = measured->vertical_shift_is_stated;
    iso->stated_log_b = measured->stated_log_b;
    const double rest = sqrt(fmax(0, 1 - fit->correlation * fit->correlation));
    for (size_t j = 0; j < measured->n; j++) {
        double storage, loss;
        const double omega = measured->angular_frequency[j];
        prony_moduli(&fit->prony, omega * pow(10, shift), &storage, &loss);
        for (int i = 0; i < 2; i++) {
            const double z = flow_draw_normal(seed, (k << 24) + 2 * j + (size_t)i, FLOW_DRAW_NOISE);
            noise[i] = j == 0 ? z : fit->correlation * noise[i] + rest * z;
        }
        iso->angular_frequency[j] = omega;
        iso->storage_modulus[j] = storage * pow(10, -s->log_b.value) *
                                  exp(fit->noise_storage * s->noise_factor * noise[0]);
        iso->loss_modulus[j] =
            loss * pow(10, -s->log_b.value) * exp(fit->noise_loss * s->noise_factor * noise[1]);
        if (isnan(measured->storage_modulus[j])) /* a missing measurement stays missing */
            iso->storage_modulus[j] = (double)NAN;
        if (isnan(measured->loss_modulus[j]))
            iso->loss_modulus[j] = (double)NAN;
    }
    return WT_OK;
}

wt_status bootstrap_sweep(const wt_sweep *measured, const wt_master *fit, uint64_t seed,
                          wt_sweep *sweep, double *shift, wt_error *err)
{
    double at_reference = (double)NAN;
    wt_status status = flow_require_oscillation(measured, "drawing isotherms anew", err);
    size_t k = 0;
    sweep->deformation = measured->deformation;
    for (size_t i = 0; i < fit->n_shifts; i++)
        shift[i] = (double)NAN;
    for (size_t i = 0; i < measured->n_isotherms && status == WT_OK; i++) {
        const wt_isotherm *iso = &measured->isotherms[i];
        const wt_master_shift *s = find_shift(fit, iso->temperature, &k);
        if (s == NULL)
            continue;
        shift[k] = draw_true_shift(iso, fit, k, seed);
        status = draw_isotherm(iso, fit, k, shift[k], seed, sweep);
        if (!(s->log_a.standard_error > 0)) /* reference isotherm: 0 by definition */
            at_reference = shift[k];
    }
    for (size_t i = 0; i < fit->n_shifts && !isnan(at_reference); i++)
        shift[i] -= at_reference;
    wt_sweep_sort(sweep);
    return status == WT_OK ? WT_OK : wt_fail(err, status, "out of memory");
}

/* ---- groups of moduli ------------------------------------------------------------------------ */

bool bootstrap_scatter(const double *modulus, const long *spot, size_t n, double error,
                       scattered_group *group)
{
    double sum = 0, squares = 0, inside = 0, inverse = 0;
    *group = (scattered_group){.n = n, .spot = spot};
    for (size_t i = 0; i < n; i++) {
        double mean = 0, before = 0;
        size_t here = 0;
        for (size_t k = 0; k < n; k++) {
            before += k < i && spot[k] == spot[i];
            here += spot[k] == spot[i];
            mean += spot[k] == spot[i] ? log(modulus[k]) : 0;
        }
        mean /= (double)here;
        inside += pow(log(modulus[i]) - mean, 2);
        if (before > 0)
            continue;
        group->n_spots++;
        sum += mean;
        squares += mean * mean;
        inverse += 1 / (double)here;
    }
    const double spots = (double)group->n_spots;
    if (group->n_spots < 2)
        return false;
    group->mean = sum / spots;
    const double curves = n > group->n_spots ? inside / (double)(n - group->n_spots) : 0;
    const double means = (squares - sum * sum / spots) / (spots - 1);
    group->within = sqrt(fmax(0, curves - error));
    group->between = sqrt(fmax(0, means - curves * inverse / spots));
    return true;
}

void bootstrap_group(const scattered_group *group, uint64_t seed, unsigned number, double *modulus)
{
    for (size_t i = 0; i < group->n; i++) {
        const size_t place = ((size_t)number << 32) + (size_t)group->spot[i];
        const double spot = flow_draw_normal(seed, place, FLOW_DRAW_SPOT);
        const double curve = flow_draw_normal(seed, ((size_t)number << 32) + i, FLOW_DRAW_CURVE);
        modulus[i] = exp(group->mean + group->between * spot + group->within * curve);
    }
}

/* ---- inputs ---------------------------------------------------------------------------------- */

static const struct {
    const char *words;
    size_t offset;
    flow_draw what;
} inputs[] = {
    {"pressure", offsetof(case_variant, sliding.pressure), FLOW_DRAW_PRESSURE},
    {"temperature", offsetof(case_variant, sliding.temperature), FLOW_DRAW_TEMPERATURE},
    {"shear stress", offsetof(case_variant, sliding.shear_stress), FLOW_DRAW_SHEAR_STRESS},
    {"roughness", offsetof(case_variant, surface.c0), FLOW_DRAW_DENSITY},
    {"specific wear rate", offsetof(case_variant, layer.specific_wear_rate), FLOW_DRAW_WEAR},
    {"critical energy", offsetof(case_variant, layer.critical_energy), FLOW_DRAW_CRITICAL_ENERGY},
    {"observed thickness", offsetof(case_variant, layer.observed_thickness), FLOW_DRAW_OBSERVED},
    {"layer thickness", offsetof(case_variant, known.thickness), FLOW_DRAW_THICKNESS},
    {"modulus ratio", offsetof(case_variant, known.modulus_ratio), FLOW_DRAW_RATIO},
    {"slope of the modulus ratio", offsetof(case_variant, known.ratio_slope),
     FLOW_DRAW_RATIO_SLOPE},
};

/* Returns input i if it has an error and applies, else NULL. */
static wt_estimate *find_stated_input(case_variant *s, size_t i)
{
    wt_estimate *e = (wt_estimate *)((char *)s + inputs[i].offset);
    const bool of_layer = inputs[i].offset >= offsetof(case_variant, layer) &&
                          inputs[i].offset < offsetof(case_variant, known);
    const bool of_known = inputs[i].offset >= offsetof(case_variant, known);
    const bool computed = inputs[i].what == FLOW_DRAW_THICKNESS && s->has_layer;
    const bool there = of_layer ? s->has_layer : of_known ? s->has_known && !computed : true;
    return there && e->standard_error > 0 && isfinite(e->value) ? e : NULL;
}

void bootstrap_inputs(case_variant *s, uint64_t seed)
{
    for (size_t i = 0; i < COUNT_OF(inputs); i++) {
        wt_estimate *e = find_stated_input(s, i);
        if (e == NULL)
            continue;
        const double value = e->value;
        const bool ratio = inputs[i].what == FLOW_DRAW_RATIO;
        if (inputs[i].what == FLOW_DRAW_TEMPERATURE || inputs[i].what == FLOW_DRAW_RATIO_SLOPE) {
            e->value = flow_draw_value(*e, seed, 0, inputs[i].what);
            continue;
        }
        e->value = flow_draw_positive_t(*e, ratio ? s->known.modulus_ratio_df : 0, seed, 0,
                                        inputs[i].what);
        e->standard_error *= e->value / value;
    }
}

void bootstrap_fix_inputs(case_variant *s)
{
    for (size_t i = 0; i < COUNT_OF(inputs); i++) {
        wt_estimate *e = find_stated_input(s, i);
        if (e != NULL)
            e->standard_error = 0;
    }
    s->softness.storage_error = s->softness.loss_error = NULL;
}

void bootstrap_describe(const case_variant *s, char *text, size_t size)
{
    case_variant any = *s;
    size_t n = 0;
    text[0] = '\0';
    for (size_t i = 0; i < COUNT_OF(inputs) && n < size; i++)
        if (find_stated_input(&any, i) != NULL)
            n += (size_t)snprintf(text + n, size - n, "%s%s", n > 0 ? ", " : "", inputs[i].words);
}
