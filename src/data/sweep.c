/* DMA sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/data.h"

#include <math.h>
#include <stdio.h>
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

/* ---- copies ---------------------------------------------------------------------------------- */

static bool same_numbers(const double *a, const double *b, size_t n)
{
    return memcmp(a, b, n * sizeof *a) == 0;
}

static bool is_copy(const wt_isotherm *a, const wt_isotherm *b)
{
    return a->n == b->n && same_numbers(a->angular_frequency, b->angular_frequency, a->n) &&
           same_numbers(a->storage_modulus, b->storage_modulus, a->n) &&
           same_numbers(a->loss_modulus, b->loss_modulus, a->n);
}

static bool same_point(const wt_isotherm *t, size_t i, size_t k)
{
    return same_numbers(t->angular_frequency + i, t->angular_frequency + k, 1) &&
           same_numbers(t->storage_modulus + i, t->storage_modulus + k, 1) &&
           same_numbers(t->loss_modulus + i, t->loss_modulus + k, 1);
}

/* Points of one frequency stand together. */
static size_t drop_points(wt_isotherm *t)
{
    size_t kept = 0;
    for (size_t i = 0; i < t->n; i++) {
        size_t before = kept;
        while (before > 0 && !same_point(t, before - 1, i) &&
               same_numbers(t->angular_frequency + before - 1, t->angular_frequency + i, 1))
            before--;
        if (before > 0 && same_point(t, before - 1, i))
            continue;
        swap_points(t, kept++, i);
    }
    const size_t dropped = t->n - kept;
    t->n = kept;
    return dropped;
}

static void drop_copies_of_points(wt_isotherm *t, wt_parselog *log)
{
    const size_t dropped = drop_points(t);
    if (dropped > 0)
        wt_parselog_add(log, WT_WARNING, t->source, NULL,
                        "%zu points of the isotherm at %.1f degC stand there twice; the copies are "
                        "left out",
                        dropped, t->temperature - WT_ZERO_CELSIUS);
}

/* Isotherms are few; those measured again at one temperature fewer. */
void wt_sweep_drop_copies(wt_sweep *sweep, wt_parselog *log)
{
    size_t kept = 0, n = 0;
    char first[2 * sizeof sweep->isotherms->source + 8] = "";
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *const t = &sweep->isotherms[i];
        size_t original = 0;
        drop_copies_of_points(t, log);
        while (original < kept && !is_copy(&sweep->isotherms[original], t))
            original++;
        if (original == kept) {
            sweep->isotherms[kept++] = *t;
            continue;
        }
        if (n++ == 0)
            snprintf(first, sizeof first, "%s is %s", t->source, sweep->isotherms[original].source);
        isotherm_free(t);
    }
    sweep->n_isotherms = kept;
    if (n > 0)
        wt_parselog_add(log, WT_WARNING, NULL, NULL, "%zu %s and left out; the first: %s", n,
                        n > 1 ? "isotherms are copies of others" : "isotherm is a copy of another",
                        first);
}
