/* DMA sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void isotherm_free(wt_isotherm *isotherm)
{
    free(isotherm->angular_frequency);
    free(isotherm->storage_modulus);
    free(isotherm->loss_modulus);
    free(isotherm->strain);
}

void wt_sweep_clear(wt_sweep *sweep)
{
    if (sweep == NULL)
        return;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        isotherm_free(&sweep->isotherms[i]);
    free(sweep->isotherms);
    *sweep = (wt_sweep){0};
}

wt_isotherm *wt_sweep_add(wt_sweep *sweep, size_t n, bool with_strain)
{
    if (n > SIZE_MAX / sizeof(double) ||
        sweep->n_isotherms >= SIZE_MAX / sizeof *sweep->isotherms - 1)
        return NULL;
    const size_t size = (n > 0 ? n : 1) * sizeof(double);
    wt_isotherm isotherm = {.temperature = (double)NAN,
                            .temperature_spread = (double)NAN,
                            .n = n,
                            .angular_frequency = malloc(size),
                            .storage_modulus = malloc(size),
                            .loss_modulus = malloc(size),
                            .strain = with_strain ? malloc(size) : NULL};
    wt_isotherm *const isotherms =
        realloc(sweep->isotherms, (sweep->n_isotherms + 1) * sizeof *isotherms);
    if (isotherms != NULL)
        sweep->isotherms = isotherms;
    if (isotherms == NULL || isotherm.angular_frequency == NULL ||
        isotherm.storage_modulus == NULL || isotherm.loss_modulus == NULL ||
        (with_strain && isotherm.strain == NULL)) {
        isotherm_free(&isotherm);
        return NULL;
    }
    isotherms[sweep->n_isotherms] = isotherm;
    return &isotherms[sweep->n_isotherms++];
}

/* By temperature, not known last; equal ones by where they came from, steps in their number. */
static int compare(const void *a, const void *b)
{
    const wt_isotherm *const p = a, *const q = b;
    if (isnan(p->temperature) || isnan(q->temperature)) {
        if (isnan(p->temperature) != isnan(q->temperature))
            return isnan(p->temperature) ? 1 : -1;
    } else if (p->temperature < q->temperature) {
        return -1;
    } else if (p->temperature > q->temperature) {
        return 1;
    }
    return strverscmp(p->source, q->source);
}

static void swap(double *values, size_t i, size_t k)
{
    if (values != NULL) {
        const double kept = values[i];
        values[i] = values[k];
        values[k] = kept;
    }
}

static void swap_points(wt_isotherm *isotherm, size_t i, size_t k)
{
    swap(isotherm->angular_frequency, i, k);
    swap(isotherm->storage_modulus, i, k);
    swap(isotherm->loss_modulus, i, k);
    swap(isotherm->strain, i, k);
}

static void sift_down(wt_isotherm *isotherm, size_t root, size_t n)
{
    const double *const w = isotherm->angular_frequency;
    size_t child;
    while ((child = 2 * root + 1) < n) {
        if (child + 1 < n && w[child] < w[child + 1])
            child++;
        if (!(w[root] < w[child]))
            return;
        swap_points(isotherm, root, child);
        root = child;
    }
}

/* Sweeps are also measured from high to low frequency. Heap sort, as it moves several arrays
 * together and needs no memory that could be refused. */
static void sort_points(wt_isotherm *isotherm)
{
    const double *const w = isotherm->angular_frequency;
    bool sorted = true;
    for (size_t i = 1; i < isotherm->n && sorted; i++)
        sorted = !(w[i] < w[i - 1]);
    if (sorted)
        return;
    for (size_t root = isotherm->n / 2; root-- > 0;)
        sift_down(isotherm, root, isotherm->n);
    for (size_t end = isotherm->n - 1; end > 0; end--) {
        swap_points(isotherm, 0, end);
        sift_down(isotherm, 0, end);
    }
}

void wt_sweep_sort(wt_sweep *sweep)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        sort_points(&sweep->isotherms[i]);
    if (sweep->n_isotherms > 1)
        qsort(sweep->isotherms, sweep->n_isotherms, sizeof *sweep->isotherms, compare);
}
