/* Material laws: fractional Zener, E = (E0 + Eg z) / (1 + z) with z = (i w tau)^alpha, and table
 * of moduli; functions that all laws share; how temperature and strain change the moduli.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law/material.h"

#include "core/base/quantity.h"
#include "core/math/simd.h"

#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>

/* ---- fractional Zener ------------------------------------------------------------------------ */

typedef struct zener_data {
    double e0, rise; /* E0 and Eg - E0 [Pa] */
    double tau, alpha;
    double cosine, sine; /* cosine and sine of alpha pi / 2 */
} zener_data;

/* E = E0 + (Eg - E0) z / (1 + z) is written with |z| or 1/|z|, whichever is below 1. Nothing
 * overflows, and because cos(alpha pi / 2) >= 0 no digits cancel. */
static void zener_modulus(const wt_material *material, const double *omega, size_t n,
                          double *storage, double *loss)
{
    const zener_data *d = material->data;
    for (size_t i = 0; i < n; i++) {
        const double exponent = d->alpha * log(omega[i] * d->tau);
        const double r = exp(-fabs(exponent));
        const double denominator = 1 + 2 * r * d->cosine + r * r;
        const double numerator = exponent < 0 ? r * (d->cosine + r) : 1 + r * d->cosine;
        storage[i] = d->e0 + d->rise * (numerator / denominator);
        loss[i] = d->rise * (r * d->sine / denominator);
    }
}

static const wt_material_law zener_law = {
    .name = "fractional_zener",
    .modulus = zener_modulus,
    .free = material_free_data,
};

wt_status wt_material_fractional_zener(double e0, double eg, double tau, double alpha,
                                       double poisson_ratio, wt_material **material, wt_error *err)
{
    if (material == NULL)
        return wt_fail(err, WT_E_ARG, "a material needs a place for the result");
    wt_status status = material_check_poisson(poisson_ratio, err);
    if (status == WT_OK)
        status = material_check_value("e0", e0, "finite and >= 0 Pa", e0 >= 0, err);
    if (status == WT_OK)
        status = material_check_value("eg", eg, MODULUS_RANGE " and >= e0",
                                      eg >= MODULUS_MIN && eg <= MODULUS_MAX && eg >= e0, err);
    if (status == WT_OK)
        status = material_check_value("tau", tau, "finite and > 0 s", tau > 0, err);
    if (status == WT_OK)
        status =
            material_check_value("alpha", alpha, "0 < alpha <= 1", alpha > 0 && alpha <= 1, err);
    if (status != WT_OK)
        return status;
    zener_data *d = wt_alloc(1, sizeof *d);
    *d = (zener_data){.e0 = e0,
                      .rise = eg - e0,
                      .tau = tau,
                      .alpha = alpha,
                      .cosine = alpha < 1 ? cos(alpha * M_PI_2) : 0,
                      .sine = sin(alpha * M_PI_2)};
    *material = material_create(&zener_law, d, poisson_ratio, (double)NAN, (double)NAN);
    return WT_OK;
}

/* ---- table of moduli ------------------------------------------------------------------------- */

typedef struct table_data {
    size_t n;
    wt_extrapolation extrapolation;
    double *omega;       /* [n] rad/s, rising */
    double *log_omega;   /* [n] */
    double *log_storage; /* [n] */
    double *log_loss;    /* [n] */
    double slope[2][2];  /* end slopes: [low, high][storage, loss] */
    double numbers[];    /* [4 n] storage of the four arrays */
} table_data;

/* Computes ln E' and ln E''. They are limited to 700, so that e^x stays finite. */
static void table_log_moduli(const table_data *d, const double *omega, size_t n, double *storage,
                             double *loss)
{
    const double most = 700;
    const size_t ends[] = {0, d->n - 1};
    const double first = d->log_omega[0], last = d->log_omega[d->n - 1];
    const bool hold = d->extrapolation == WT_EXTRAPOLATE_HOLD;
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        double x = log(omega[i]);
        if (hold)
            x = x < first ? first : x > last ? last : x;
        if (x < first || x > last) {
            const size_t end = x > last;
            const double beyond = x - d->log_omega[ends[end]];
            const double *slope = d->slope[end];
            storage[i] = fmin(d->log_storage[ends[end]] + slope[0] * beyond, most);
            loss[i] = fmin(d->log_loss[ends[end]] + slope[1] * beyond, most);
            continue;
        }
        if (!(x >= d->log_omega[k] &&
              x < d->log_omega[k + 1])) /* most frequencies lie in the previous interval */
            k = gsl_interp_bsearch(d->log_omega, x, 0, d->n - 1);
        const double t = (x - d->log_omega[k]) / (d->log_omega[k + 1] - d->log_omega[k]);
        const double e = d->log_storage[k] + t * (d->log_storage[k + 1] - d->log_storage[k]);
        const double f = d->log_loss[k] + t * (d->log_loss[k + 1] - d->log_loss[k]);
        storage[i] = e > most ? most : e; /* this form preserves NaN */
        loss[i] = f > most ? most : f;
    }
}

static void table_modulus(const wt_material *material, const double *omega, size_t n,
                          double *storage, double *loss)
{
    enum { BATCH = 32 }; /* frequencies in one pass; they fit in the first cache */
    double logs[2][BATCH];
    for (size_t from = 0; from < n; from += BATCH) {
        const size_t left = n - from < BATCH ? n - from : BATCH;
        table_log_moduli(material->data, omega + from, left, logs[0], logs[1]);
        vector_exp(logs[0], left, storage + from);
        vector_exp(logs[1], left, loss + from);
    }
}

static const double *table_breaks(const wt_material *material, size_t *n)
{
    const table_data *d = material->data;
    *n = d->n;
    return d->omega;
}

static const wt_material_law table_law = {
    .name = "table",
    .modulus = table_modulus,
    .breaks = table_breaks,
    .free = material_free_data,
    .power_below = true,
};

static wt_status table_check(const double *omega, const double *storage, const double *loss,
                             size_t n, wt_error *err)
{
    for (size_t i = 0; i < n; i++) {
        wt_status status =
            material_check_value("angular frequency", omega[i], "finite, > 0 rad/s and rising",
                                 omega[i] > (i ? omega[i - 1] : 0), err);
        if (status == WT_OK)
            status =
                material_check_value("storage modulus", storage[i], MODULUS_RANGE,
                                     storage[i] >= MODULUS_MIN && storage[i] <= MODULUS_MAX, err);
        if (status == WT_OK)
            status = material_check_value("loss modulus", loss[i], MODULUS_RANGE,
                                          loss[i] >= MODULUS_MIN && loss[i] <= MODULUS_MAX, err);
        if (status != WT_OK) {
            wt_error_place(err, "knot %zu of %zu", i + 1, n);
            return status;
        }
    }
    return WT_OK;
}

/* Computes the end slopes from ratios. Differences of logarithms lose digits, which matters far
 * outside the knots. */
static void find_boundary_slopes(table_data *d, const double *storage, const double *loss)
{
    for (size_t end = 0; end < 2; end++) {
        const size_t k = end == 0 ? 0 : d->n - 2;
        const double width = log1p((d->omega[k + 1] - d->omega[k]) / d->omega[k]);
        d->slope[end][0] = log(storage[k + 1] / storage[k]) / width;
        d->slope[end][1] = log(loss[k + 1] / loss[k]) / width;
    }
}

/* A steeper modulus passes through the whole range of a double within three decades, and its
 * integrals are slow. */
static const double max_slope = 100;

/* Sliding contributes frequencies down to 0, where |E|^2 must stay integrable over the angle. */
static wt_status check_boundary_slopes(const table_data *d, wt_error *err)
{
    const double low = fmin(d->slope[0][0], d->slope[0][1]);
    double most = 0;
    for (size_t i = 0; i < 4; i++)
        if (fabs(d->slope[i / 2][i % 2]) > fabs(most))
            most = d->slope[i / 2][i % 2];
    wt_status status = material_check_value(
        "log-log slope of the modulus at the low end of a table", low,
        "> -0.25, so that it can be continued to frequency 0", low > -0.25, err);
    if (status == WT_OK)
        status = material_check_value("log-log slope of the modulus at an end of a table", most,
                                      "from -100 to 100, so that it can be continued",
                                      fabs(most) <= max_slope, err);
    if (status != WT_OK)
        wt_error_advice(err, "hold the end values instead, or leave out the knots at that end");
    return status;
}

wt_status wt_material_table(const double *omega, const double *storage, const double *loss,
                            size_t n, double poisson_ratio, wt_extrapolation extrapolation,
                            wt_material **material, wt_error *err)
{
    if (omega == NULL || storage == NULL || loss == NULL || material == NULL || n < 2)
        return wt_fail(err, WT_E_ARG, "a material table needs at least 2 knots; found %zu", n);
    wt_status status = material_check_poisson(poisson_ratio, err);
    if (status == WT_OK)
        status = table_check(omega, storage, loss, n, err);
    if (status != WT_OK)
        return status;

    table_data *d = wt_alloc(1, sizeof *d + 4 * n * sizeof d->numbers[0]);
    d->n = n;
    d->extrapolation = extrapolation;
    d->omega = d->numbers;
    d->log_omega = d->omega + n;
    d->log_storage = d->log_omega + n;
    d->log_loss = d->log_storage + n;
    for (size_t i = 0; i < n; i++) {
        d->omega[i] = omega[i];
        d->log_omega[i] = log(omega[i]);
        d->log_storage[i] = log(storage[i]);
        d->log_loss[i] = log(loss[i]);
    }
    for (size_t i = 1; status == WT_OK && i < n; i++)
        if (!(d->log_omega[i] > d->log_omega[i - 1]))
            status =
                wt_fail(err, WT_E_RANGE,
                        "knots %zu and %zu of a material table are too close together", i, i + 1);
    find_boundary_slopes(d, storage, loss);
    if (status == WT_OK && extrapolation == WT_EXTRAPOLATE_SLOPE)
        status = check_boundary_slopes(d, err);
    if (status == WT_OK)
        *material = material_create(&table_law, d, poisson_ratio, omega[0], omega[n - 1]);
    else
        free(d);
    return status;
}

/* ---- every law ------------------------------------------------------------------------------- */

wt_status material_check_poisson(double poisson_ratio, wt_error *err)
{
    static const wt_param row = POISSON_RATIO(wt_material);
    return param_check_number(&row, poisson_ratio, err);
}

wt_status material_check_value(const char *name, double value, const char *expected, bool good,
                               wt_error *err)
{
    char full[128];
    if (good && isfinite(value))
        return WT_OK;
    snprintf(full, sizeof full, "%s of a material", name);
    return range_error(full, value, expected, err);
}

wt_material *material_create(const wt_material_law *law, void *data, double poisson_ratio,
                             double frequency_min, double frequency_max)
{
    wt_material *made = wt_alloc(1, sizeof *made);
    *made = (wt_material){.law = law,
                          .poisson_ratio = poisson_ratio,
                          .frequency_min = frequency_min,
                          .frequency_max = frequency_max,
                          .data = data};
    return made;
}

void material_free_data(wt_material *material)
{
    free(material->data);
}

void wt_material_free(wt_material *material)
{
    if (material == NULL)
        return;
    if (material->law->free != NULL)
        material->law->free(material);
    free(material);
}

/* ---- strain ---------------------------------------------------------------------------------- */

/* No filled rubber softens by more than a hundred times (Payne): what is beyond is a modulus in
 * another unit. */
static const double least_factor = 1e-3, most_factor = 1e3;

wt_status wt_softening_check(const wt_softening *table, wt_error *err)
{
    if (table == NULL || table->n == 0 || table->strain == NULL || table->storage == NULL ||
        table->loss == NULL)
        return wt_fail(err, WT_E_ARG, "a softening needs a table of strain, f and g");
    for (size_t k = 0; k < table->n; k++) {
        const double strain = table->strain[k], f = table->storage[k], g = table->loss[k];
        wt_status status = WT_OK;
        if (!(strain > (k ? table->strain[k - 1] : 0)) || !isfinite(strain))
            status = range_error("strain of a softening", strain, "finite, > 0 and rising", err);
        else if (!(f >= least_factor && f <= most_factor))
            status = range_error("f of a softening", f, "from 1e-3 to 1e3", err);
        else if (!(g >= least_factor && g <= most_factor))
            status = range_error("g of a softening", g, "from 1e-3 to 1e3", err);
        if (status != WT_OK) {
            wt_error_place(err, "point %zu of %zu", k + 1, table->n);
            return status;
        }
    }
    return WT_OK;
}

/* ---- temperature ----------------------------------------------------------------------------- */

double wt_wlf_log_shift(const wt_wlf *wlf, double temperature)
{
    const double rise = temperature - wlf->reference_temperature;
    const double above_pole = wlf->c2 + rise;
    /* With a pole at or above the reference the law is infinite between the two. */
    if (!(above_pole > 0.0) || !(wlf->c2 > 0.0))
        return (double)NAN;
    return -wlf->c1 * rise / above_pole;
}

double wt_arrhenius_log_shift(double activation_energy, double reference_temperature,
                              double temperature)
{
    if (!(temperature > 0.0) || !(reference_temperature > 0.0))
        return (double)NAN;
    /* One quotient for 1/T - 1/Tref avoids cancellation at neighbouring temperatures. */
    return activation_energy / (GAS_CONSTANT * M_LN10) *
           ((reference_temperature - temperature) / (temperature * reference_temperature));
}

double wt_shift_law_log_a(const wt_shift_law *law, double temperature)
{
    const double reference = law->wlf.reference_temperature;
    switch (law->kind) {
    case WT_LAW_WLF:
        return wt_wlf_log_shift(&law->wlf, temperature);
    case WT_LAW_ARRHENIUS:
        return wt_arrhenius_log_shift(law->activation_energy, reference, temperature);
    case WT_LAW_WLF_ARRHENIUS:
        return wt_wlf_log_shift(&law->wlf, fmax(temperature, law->joint)) -
               wt_wlf_log_shift(&law->wlf, fmax(reference, law->joint)) +
               wt_arrhenius_log_shift(law->activation_energy, fmin(reference, law->joint),
                                      fmin(temperature, law->joint));
    case WT_LAW_NONE:
        break;
    }
    return (double)NAN;
}
