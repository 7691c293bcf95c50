/* Fractional Zener material: E = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "dma/law/material.h"

#include <math.h>
#include <stdlib.h>

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
