/* Generalised Maxwell (Prony) material with its angular integrals in closed form.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law/prony_law.h"

#include "core/math/simd.h"
#include "dma/law/material.h"
#include "weartrack/core.h"

#include <math.h>
#include <stdlib.h>

void prony_moduli(const wt_prony *series, double omega, double *storage, double *loss)
{
    *storage = series->equilibrium_modulus;
    *loss = 0;
    for (size_t i = 0; i < series->n; i++)
        prony_add_term(series->modulus[i], series->relaxation_time[i], omega, storage, loss);
}

typedef struct prony_data {
    double equilibrium; /* E_inf [Pa] */
    size_t n;
    double *modulus;         /* E_k [Pa] */
    double *relaxation_time; /* tau_k [s] */
    double *weight;          /* 2 E_k V_k, V_k = E_inf + sum_j E_j tau_j / (tau_j + tau_k) */
    double numbers[];        /* [3 n] storage of the three arrays */
} prony_data;

/* Adds one term at n frequencies below prony_square_limit. The loop has no branch and
 * vectorises. */
WIDE_REGISTERS
static void add_term_moduli(const double *restrict omega, size_t n, double modulus, double tau,
                            double *restrict storage, double *restrict loss)
{
    for (size_t i = 0; i < n; i++) {
        const double z = omega[i] * tau, b = modulus * (z / (1 + z * z));
        storage[i] += b * z;
        loss[i] += b;
    }
}

static double highest_frequency(const double *omega, size_t n)
{
    double highest = 0;
    for (size_t i = 0; i < n; i++)
        highest = highest < omega[i] ? omega[i] : highest;
    return highest;
}

static void prony_modulus(const wt_material *material, const double *omega, size_t n,
                          double *storage, double *loss)
{
    const prony_data *d = material->data;
    for (size_t i = 0; i < n; i++) {
        storage[i] = d->equilibrium;
        loss[i] = 0;
    }
    const double highest = highest_frequency(omega, n);
    for (size_t k = 0; k < d->n; k++) {
        const double e = d->modulus[k];
        const double tau = d->relaxation_time[k];
        if (highest * tau < prony_square_limit)
            add_term_moduli(omega, n, e, tau, storage, loss);
        else
            for (size_t i = 0; i < n; i++)
                prony_add_term(e, tau, omega[i], &storage[i], &loss[i]);
    }
}

/* Adds one term to J1 and J2. Friction spends most of its time in this loop. Below the limit it
 * has no branch and vectorises. */
WIDE_REGISTERS
static void add_angular_term(const double *restrict omega, size_t n, double modulus, double tau,
                             double weight, double *restrict j1, double *restrict j2)
{
    for (size_t i = 0; i < n; i++) {
        const double a = omega[i] * tau;
        const double square = 1 + a * a;
        const double s = a / (square + sqrt(square));
        j1[i] += modulus * s;
        j2[i] += weight * (a * s);
    }
}

static void add_angular_term_checked(const double *omega, size_t n, double modulus, double tau,
                                     double weight, double *j1, double *j2)
{
    for (size_t i = 0; i < n; i++)
        if (omega[i] * tau < prony_square_limit) {
            add_angular_term(&omega[i], 1, modulus, tau, weight, &j1[i], &j2[i]);
        } else {
            j1[i] += modulus / omega[i] / tau;
            j2[i] += weight;
        }
}

/* With a = w tau, R = sqrt(1 + a^2), s = a / (R (1 + R)):
 *     int cos E'' = 2 pi sum E_k s_k,   int |E|^2 = 2 pi (E_inf^2 + 2 sum E_k V_k a_k s_k).
 * The double sum of |E|^2 reduces to one sum because int Re[1 / ((1 + i a c)(1 - i b c))] dphi =
 * 2 pi (a/R_a + b/R_b) / (a + b). All terms are positive, so no digits cancel. */
static void prony_angular(const wt_material *material, const double *restrict omega, size_t n,
                          double *restrict j1, double *restrict j2)
{
    const prony_data *d = material->data;
    const double base = d->equilibrium * d->equilibrium;
    const double highest = highest_frequency(omega, n);
    for (size_t i = 0; i < n; i++) {
        j1[i] = 0;
        j2[i] = base;
    }
    for (size_t k = 0; k < d->n; k++) {
        const double tau = d->relaxation_time[k];
        if (highest * tau < prony_square_limit)
            add_angular_term(omega, n, d->modulus[k], tau, d->weight[k], j1, j2);
        else
            add_angular_term_checked(omega, n, d->modulus[k], tau, d->weight[k], j1, j2);
    }
    const double two_pi = 2 * M_PI;
    for (size_t i = 0; i < n; i++) {
        j1[i] *= two_pi;
        j2[i] *= two_pi;
    }
}

/* Computes sqrt(1 + a^2) and E a / sqrt(1 + a^2) for a = omega tau. */
static void loss_root_and_height(double omega, double modulus, double tau, double *root,
                                 double *height)
{
    const double a = omega * tau;
    const bool square = a < prony_square_limit;
    *root = square ? sqrt(1 + a * a) : a;
    *height = square ? modulus * (a / *root) : modulus;
}

enum { LOSS_BLOCK = 64 }; /* terms in one pass; their arrays fit on the stack */

/* Adds h_j / (R_j + R_k) to the sums of the terms k of a block. */
WIDE_REGISTERS
static void add_pair_sums(double root, double height, const double *restrict roots, size_t n,
                          double *restrict sums)
{
    for (size_t k = 0; k < n; k++)
        sums[k] += height / (root + roots[k]);
}

/* int E''^2 = 2 pi sum_jk h_j h_k / (R_j + R_k) with R = sqrt(1 + a^2), h = E a / R. */
static void prony_angular_loss(const wt_material *material, const double *omega, size_t n,
                               double *j2)
{
    const prony_data *d = material->data;
    for (size_t i = 0; i < n; i++) {
        j2[i] = 0;
        for (size_t from = 0; from < d->n; from += LOSS_BLOCK) {
            const size_t count = d->n - from < LOSS_BLOCK ? d->n - from : LOSS_BLOCK;
            double roots[LOSS_BLOCK], heights[LOSS_BLOCK], sums[LOSS_BLOCK] = {0};
            for (size_t k = 0; k < count; k++)
                loss_root_and_height(omega[i], d->modulus[from + k], d->relaxation_time[from + k],
                                     &roots[k], &heights[k]);
            for (size_t j = 0; j < d->n; j++) {
                double root, height;
                loss_root_and_height(omega[i], d->modulus[j], d->relaxation_time[j], &root,
                                     &height);
                add_pair_sums(root, height, roots, count, sums);
            }
            for (size_t k = 0; k < count; k++)
                j2[i] += heights[k] * sums[k];
        }
        j2[i] *= 2 * M_PI;
    }
}

static size_t prony_terms(const wt_material *material)
{
    const prony_data *d = material->data;
    return d->n;
}

static const wt_material_law prony_law = {
    .name = "prony",
    .modulus = prony_modulus,
    .angular = prony_angular,
    .terms = prony_terms,
    .angular_loss = prony_angular_loss,
    .free = material_free_data,
};

static wt_status prony_check(const wt_prony *prony, wt_error *err)
{
    wt_status status =
        material_check_value("equilibrium_modulus", prony->equilibrium_modulus,
                             "finite and >= 0 Pa", prony->equilibrium_modulus >= 0, err);
    double sum = prony->equilibrium_modulus;
    for (size_t k = 0; status == WT_OK && k < prony->n; k++) {
        status = material_check_value("relaxation_time", prony->relaxation_time[k],
                                      "finite and > 0 s", prony->relaxation_time[k] > 0, err);
        if (status == WT_OK)
            status = material_check_value("modulus", prony->modulus[k], "finite and >= 0 Pa",
                                          prony->modulus[k] >= 0, err);
        if (status != WT_OK)
            wt_error_place(err, "Prony term %zu of %zu", k + 1, prony->n);
        else
            sum += prony->modulus[k];
    }
    if (status == WT_OK)
        status = material_check_value("glass modulus (the sum of all moduli)", sum, MODULUS_RANGE,
                                      sum >= MODULUS_MIN && sum <= MODULUS_MAX, err);
    return status;
}

wt_status wt_material_prony(const wt_prony *prony, double poisson_ratio, wt_material **material,
                            wt_error *err)
{
    if (prony == NULL || material == NULL)
        return wt_fail(err, WT_E_ARG, "a Prony material needs a series and a place for the result");
    wt_status status = material_check_poisson(poisson_ratio, err);
    if (status == WT_OK)
        status = prony_check(prony, err);
    if (status != WT_OK)
        return status;

    prony_data *d = wt_alloc(1, sizeof *d + 3 * prony->n * sizeof d->numbers[0]);
    d->modulus = d->numbers;
    d->relaxation_time = d->modulus + prony->n;
    d->weight = d->relaxation_time + prony->n;
    const double to_young = prony->deformation == WT_SHEAR ? 2 * (1 + poisson_ratio) : 1;
    d->equilibrium = to_young * prony->equilibrium_modulus;
    d->n = prony->n;
    for (size_t k = 0; k < d->n; k++) {
        d->modulus[k] = to_young * prony->modulus[k];
        d->relaxation_time[k] = prony->relaxation_time[k];
    }
    for (size_t k = 0; k < d->n; k++) {
        const double tau = d->relaxation_time[k];
        double v = d->equilibrium;
        for (size_t j = 0; j < d->n;
             j++) /* the ratio avoids a sum of two times, which may overflow */
            v += d->modulus[j] / (1 + tau / d->relaxation_time[j]);
        d->weight[k] = 2 * d->modulus[k] * v;
    }
    *material =
        material_create(&prony_law, d, poisson_ratio, prony->frequency_min, prony->frequency_max);
    return WT_OK;
}
