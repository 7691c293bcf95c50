/* Moduli of materials with their errors, and ratios of two materials.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/material_comparison.h"

#include "core/base/array.h"
#include "core/math/normal_quantile.h"

#include <math.h>
#include <stdlib.h>

enum { Q = MATERIALS_QUANTITIES };

void material_values_clear(material_values *v)
{
    free(v->value);
    free(v->draw);
    *v = (material_values){0};
}

/* Computes the log moduli of one draw. Consecutive points of one temperature share one material. */
static wt_status compute_log_moduli(const wt_rubber *rubber, const comparison_point *point,
                                    size_t n, uint64_t seed, size_t replicate, double *value,
                                    wt_error *err)
{
    double *omega = wt_alloc(3 * n, sizeof *omega);
    double *storage = omega + n, *loss = storage + n;
    wt_status status = WT_OK;
    for (size_t first = 0, last; status == WT_OK && first < n; first = last) {
        wt_material *material = NULL;
        for (last = first; last < n && point[last].temperature == point[first].temperature; last++)
            omega[last - first] = point[last].frequency;
        status = wt_rubber_material(rubber, point[first].temperature, seed, replicate, &material,
                                    NULL, err);
        if (status != WT_OK)
            break;
        material->law->modulus(material, omega, last - first, storage, loss);
        wt_material_free(material);
        for (size_t i = first; i < last; i++) {
            value[i * Q + MATERIALS_E1] = log(storage[i - first]);
            value[i * Q + MATERIALS_E2] = log(loss[i - first]);
            value[i * Q + MATERIALS_TAN] = log(loss[i - first] / storage[i - first]);
        }
    }
    free(omega);
    return status;
}

/* Subtracts the mean from the draws and computes their standard deviation. */
static void centre_draws(material_values *v)
{
    const size_t m = v->n * Q;
    for (size_t k = 0; k < m; k++) {
        double mean = 0, square = 0;
        for (size_t d = 0; d < v->n_draws; d++)
            mean += v->draw[d * m + k] / (double)v->n_draws;
        for (size_t d = 0; d < v->n_draws; d++) {
            v->draw[d * m + k] -= mean;
            square += v->draw[d * m + k] * v->draw[d * m + k];
        }
        v->error[k] = sqrt(square / (double)(v->n_draws - 1));
    }
}

wt_status material_values_compute(const wt_rubber *rubber,
                                  const material_systematic_errors *systematic,
                                  const comparison_point *point, size_t n, const wt_job *work,
                                  material_values *v, wt_error *err)
{
    const size_t m = n * Q;
    *v = (material_values){.n = n, .n_draws = rubber->n_draws > 1 ? rubber->n_draws : 0};
    v->value = wt_alloc(2 * m, sizeof *v->value);
    v->draw = wt_alloc(v->n_draws * m, sizeof *v->draw);
    v->error = v->value + m;
    wt_status status =
        compute_log_moduli(rubber, point, n, work->seed, WT_NO_REPLICATE, v->value, err);
    for (size_t d = 0; status == WT_OK && d < v->n_draws; d++)
        status = compute_log_moduli(rubber, point, n, work->seed, d, v->draw + d * m, err);
    if (status != WT_OK)
        return status;
    if (v->n_draws > 0)
        centre_draws(v);
    for (size_t k = 0; k < m; k++)
        v->error[k] =
            v->n_draws == 0
                ? (double)NAN
                : hypot(v->error[k], hypot(systematic->misfit[k % Q], systematic->sample[k % Q]));
    return WT_OK;
}

void material_ratio_clear(material_ratio *r)
{
    free(r->value);
    *r = (material_ratio){0};
}

/* Finds the 95 % quantile of the largest deviation over pairs of draws, in standard errors.
 * Draws of equal number share random numbers, so only different numbers are paired. */
static void find_critical_deviation(const material_values *a, const material_values *b,
                                    material_ratio *r)
{
    enum { PAIRINGS = 4 }; /* pairs for each draw; a draw is expensive, a pair is not */
    const size_t m = r->n * Q, n = PAIRINGS * a->n_draws;
    double *most = wt_alloc(n, sizeof *most);
    for (size_t i = 0; i < n; i++) {
        const size_t d = i % a->n_draws, pairing = i / a->n_draws + 1;
        const size_t e = (d + pairing * b->n_draws / (PAIRINGS + 1)) % b->n_draws;
        for (size_t k = 0; k < m; k++)
            most[i] = fmax(most[i], fabs(b->draw[e * m + k] - a->draw[d * m + k]) / r->error[k]);
    }
    numbers_sort(most, n);
    r->critical = fmax(most[(size_t)(0.95 * (double)n)], NORMAL_95);
    free(most);
}

material_ratio material_ratio_compute(const material_values *first, const material_values *second)
{
    const size_t m = first->n * Q;
    material_ratio r = {.n = first->n, .errors_known = first->n_draws > 0 && second->n_draws > 0};
    r.value = wt_alloc(2 * m, sizeof *r.value);
    r.error = r.value + m;
    for (size_t k = 0; k < m; k++) {
        r.value[k] = second->value[k] - first->value[k];
        r.error[k] = hypot(first->error[k], second->error[k]);
    }
    if (r.errors_known)
        find_critical_deviation(first, second, &r);
    return r;
}
