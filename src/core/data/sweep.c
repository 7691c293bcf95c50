/* DMA sweeps: memory, sorting, removal of duplicates and selection of a sample.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/data/sweep_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

sweep_points isotherm_points(const wt_isotherm *t)
{
    return (sweep_points){{t->angular_frequency, t->storage_modulus, t->loss_modulus, t->strain,
                           t->loss_factor, t->point_temperature},
                          t->n,
                          t->sample};
}

sweep_points ramp_points(const wt_ramp *t)
{
    return (sweep_points){
        {t->temperature, t->storage_modulus, t->loss_modulus, t->strain, t->loss_factor},
        t->n,
        t->sample};
}

sweep_points strain_sweep_points(const wt_strain_sweep *t)
{
    return (sweep_points){{t->strain, t->storage_modulus, t->loss_modulus}, t->n, t->sample};
}

static void free_points(sweep_points p)
{
    for (size_t j = 0; j < SWEEP_ARRAYS; j++)
        free(p.array[j]);
    free(p.sample);
}

/* Allocates the moduli, the swept variable and the optional arrays `with`, zeroed. */
static void allocate_points(sweep_points *p, size_t n, unsigned with)
{
    const bool has[SWEEP_ARRAYS] = {[SWEEP_VARIABLE] = true,
                                    [SWEEP_STORAGE] = true,
                                    [SWEEP_LOSS] = true,
                                    [SWEEP_STRAIN] = (with & WT_SWEEP_HAS_STRAIN) != 0,
                                    [SWEEP_LOSS_FACTOR] = (with & WT_SWEEP_HAS_LOSS_FACTOR) != 0,
                                    [SWEEP_TEMPERATURE] = (with & WT_SWEEP_HAS_TEMPERATURE) != 0};
    *p = (sweep_points){.n = n};
    for (size_t j = 0; j < SWEEP_ARRAYS; j++)
        p->array[j] = has[j] ? wt_alloc(n, sizeof(double)) : NULL;
}

void wt_sweep_clear(wt_sweep *sweep)
{
    if (sweep == NULL)
        return;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        free_points(isotherm_points(&sweep->isotherms[i]));
    free(sweep->isotherms);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        free_points(ramp_points(&sweep->ramps[i]));
    free(sweep->ramps);
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        free_points(strain_sweep_points(&sweep->strain_sweeps[i]));
    free(sweep->strain_sweeps);
    *sweep = (wt_sweep){0};
}

wt_isotherm *wt_sweep_add(wt_sweep *sweep, size_t n, unsigned with)
{
    sweep_points p;
    wt_isotherm *const all = wt_realloc(sweep->isotherms, sweep->n_isotherms + 1, sizeof *all);
    sweep->isotherms = all;
    allocate_points(&p, n, with);
    all[sweep->n_isotherms] = (wt_isotherm){.temperature = (double)NAN,
                                            .temperature_spread = (double)NAN,
                                            .n = n,
                                            .angular_frequency = p.array[SWEEP_VARIABLE],
                                            .storage_modulus = p.array[SWEEP_STORAGE],
                                            .loss_modulus = p.array[SWEEP_LOSS],
                                            .strain = p.array[SWEEP_STRAIN],
                                            .loss_factor = p.array[SWEEP_LOSS_FACTOR],
                                            .point_temperature = p.array[SWEEP_TEMPERATURE]};
    return &all[sweep->n_isotherms++];
}

wt_ramp *wt_sweep_add_ramp(wt_sweep *sweep, size_t n, unsigned with)
{
    sweep_points p;
    wt_ramp *const all = wt_realloc(sweep->ramps, sweep->n_ramps + 1, sizeof *all);
    sweep->ramps = all;
    allocate_points(&p, n, with);
    all[sweep->n_ramps] = (wt_ramp){.angular_frequency = (double)NAN,
                                    .n = n,
                                    .temperature = p.array[SWEEP_VARIABLE],
                                    .storage_modulus = p.array[SWEEP_STORAGE],
                                    .loss_modulus = p.array[SWEEP_LOSS],
                                    .strain = p.array[SWEEP_STRAIN],
                                    .loss_factor = p.array[SWEEP_LOSS_FACTOR]};
    return &all[sweep->n_ramps++];
}

wt_strain_sweep *wt_sweep_add_strain_sweep(wt_sweep *sweep, size_t n)
{
    sweep_points p;
    wt_strain_sweep *const all =
        wt_realloc(sweep->strain_sweeps, sweep->n_strain_sweeps + 1, sizeof *all);
    sweep->strain_sweeps = all;
    allocate_points(&p, n, 0);
    all[sweep->n_strain_sweeps] = (wt_strain_sweep){.angular_frequency = (double)NAN,
                                                    .temperature = (double)NAN,
                                                    .n = n,
                                                    .strain = p.array[SWEEP_VARIABLE],
                                                    .storage_modulus = p.array[SWEEP_STORAGE],
                                                    .loss_modulus = p.array[SWEEP_LOSS]};
    return &all[sweep->n_strain_sweeps++];
}

/* ---- sorting --------------------------------------------------------------------------------- */

static int compare_numbers_nan_last(double a, double b) /* NaN last */
{
    return isnan(a) || isnan(b) ? isnan(a) - isnan(b) : (a > b) - (a < b);
}

/* Compares by temperature, then by source; numbers in the name of the source are compared as
 * numbers. */
static int compare_isotherm_order(const void *a, const void *b)
{
    const wt_isotherm *const p = a, *const q = b;
    const int order = compare_numbers_nan_last(p->temperature, q->temperature);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

static int compare_ramp_order(const void *a, const void *b)
{
    const wt_ramp *const p = a, *const q = b;
    const int order = compare_numbers_nan_last(p->angular_frequency, q->angular_frequency);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

static int compare_strain_sweeps(const void *a, const void *b)
{
    const wt_strain_sweep *const p = a, *const q = b;
    int order = compare_numbers_nan_last(p->temperature, q->temperature);
    if (order == 0)
        order = compare_numbers_nan_last(p->angular_frequency, q->angular_frequency);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

static void swap_points(const sweep_points *p, size_t i, size_t k)
{
    for (size_t j = 0; j < SWEEP_ARRAYS; j++) {
        if (p->array[j] == NULL)
            continue;
        const double kept = p->array[j][i];
        p->array[j][i] = p->array[j][k];
        p->array[j][k] = kept;
    }
}

static void sift_down(const sweep_points *p, size_t root, size_t n)
{
    const double *const w = p->array[0];
    size_t child;
    while ((child = 2 * root + 1) < n) {
        if (child + 1 < n && w[child] < w[child + 1])
            child++;
        if (!(w[root] < w[child]))
            return;
        swap_points(p, root, child);
        root = child;
    }
}

/* Some sweeps are measured with decreasing values. Heap sort can sort several arrays together and
 * needs no memory, so that it cannot fail. */
static void sort_points(sweep_points points)
{
    const sweep_points *const p = &points;
    const size_t n = points.n;
    const double *const w = p->array[0];
    bool sorted = true;
    for (size_t i = 1; i < n && sorted; i++)
        sorted = !(w[i] < w[i - 1]);
    if (sorted)
        return;
    for (size_t root = n / 2; root-- > 0;)
        sift_down(p, root, n);
    for (size_t end = n - 1; end > 0; end--) {
        swap_points(p, 0, end);
        sift_down(p, 0, end);
    }
}

void wt_sweep_sort(wt_sweep *sweep)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        sort_points(isotherm_points(&sweep->isotherms[i]));
    for (size_t i = 0; i < sweep->n_ramps; i++)
        sort_points(ramp_points(&sweep->ramps[i]));
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        sort_points(strain_sweep_points(&sweep->strain_sweeps[i]));
    if (sweep->n_isotherms > 1)
        qsort(sweep->isotherms, sweep->n_isotherms, sizeof *sweep->isotherms,
              compare_isotherm_order);
    if (sweep->n_ramps > 1)
        qsort(sweep->ramps, sweep->n_ramps, sizeof *sweep->ramps, compare_ramp_order);
    if (sweep->n_strain_sweeps > 1)
        qsort(sweep->strain_sweeps, sweep->n_strain_sweeps, sizeof *sweep->strain_sweeps,
              compare_strain_sweeps);
}

/* ---- duplicates ------------------------------------------------------------------------------ */

static bool is_same_sample(const char *a, const char *b)
{
    return strcmp(a != NULL ? a : "", b != NULL ? b : "") == 0;
}

/* Compares the bytes of two arrays; two missing arrays are equal. */
static bool are_equal_numbers(const double *a, const double *b, size_t n)
{
    if (a == NULL || b == NULL)
        return a == b;
    return memcmp(a, b, n * sizeof *a) == 0;
}

/* Strain and temperature are ignored, because they are no results. */
static bool is_duplicate(sweep_points a, sweep_points b)
{
    bool same = a.n == b.n && is_same_sample(a.sample, b.sample);
    for (size_t j = 0; same && j < SWEEP_ARRAYS; j++)
        same = j == SWEEP_STRAIN || j == SWEEP_TEMPERATURE ||
               are_equal_numbers(a.array[j], b.array[j], a.n);
    return same;
}

static bool is_same_point(const wt_isotherm *t, size_t i, size_t k)
{
    return are_equal_numbers(t->angular_frequency + i, t->angular_frequency + k, 1) &&
           are_equal_numbers(t->storage_modulus + i, t->storage_modulus + k, 1) &&
           are_equal_numbers(t->loss_modulus + i, t->loss_modulus + k, 1) &&
           (t->loss_factor == NULL || are_equal_numbers(t->loss_factor + i, t->loss_factor + k, 1));
}

/* Points of equal frequency are adjacent after sorting. */
static size_t remove_repeated_points(wt_isotherm *t)
{
    const sweep_points p = isotherm_points(t);
    size_t kept = 0;
    for (size_t i = 0; i < t->n; i++) {
        size_t before = kept;
        while (before > 0 && !is_same_point(t, before - 1, i) &&
               are_equal_numbers(t->angular_frequency + before - 1, t->angular_frequency + i, 1))
            before--;
        if (before > 0 && is_same_point(t, before - 1, i))
            continue;
        swap_points(&p, kept++, i);
    }
    const size_t dropped = t->n - kept;
    t->n = kept;
    return dropped;
}

static void remove_duplicate_points(wt_isotherm *t, wt_log *log)
{
    const size_t dropped = remove_repeated_points(t);
    if (dropped > 0)
        wt_log_action(log, WT_WARNING, WT_COPIED, dropped, WT_KEEP_OPTION, t->source, NULL,
                      "%zu points of the isotherm at %.1f degC are there twice; the copies are "
                      "left out",
                      dropped, t->temperature - WT_ZERO_CELSIUS);
}

/* Ramps of equal frequency are adjacent after sorting. */
static void remove_duplicate_ramps(wt_sweep *sweep, wt_log *log)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        wt_ramp *const t = &sweep->ramps[i];
        const wt_ramp *const b = kept > 0 ? &sweep->ramps[kept - 1] : NULL;
        if (b == NULL || b->angular_frequency != t->angular_frequency ||
            !is_duplicate(ramp_points(b), ramp_points(t))) {
            sweep->ramps[kept++] = *t;
            continue;
        }
        wt_log_action(log, WT_WARNING, WT_COPIED, 1, WT_KEEP_OPTION, t->source, NULL,
                      "this temperature sweep is a copy of that of %s and left out", b->source);
        free_points(ramp_points(t));
    }
    sweep->n_ramps = kept;
}

/* Strain sweeps of equal temperature and frequency are adjacent after sorting. */
static void remove_duplicate_strain_sweeps(wt_sweep *sweep, wt_log *log)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++) {
        wt_strain_sweep *const t = &sweep->strain_sweeps[i];
        const wt_strain_sweep *const b = kept > 0 ? &sweep->strain_sweeps[kept - 1] : NULL;
        if (b == NULL || b->angular_frequency != t->angular_frequency ||
            !is_duplicate(strain_sweep_points(b), strain_sweep_points(t))) {
            sweep->strain_sweeps[kept++] = *t;
            continue;
        }
        wt_log_action(log, WT_WARNING, WT_COPIED, 1, WT_KEEP_OPTION, t->source, NULL,
                      "this strain sweep is a copy of that of %s and left out", b->source);
        free_points(strain_sweep_points(t));
    }
    sweep->n_strain_sweeps = kept;
}

/* A duplicate at another temperature may be a typing error of the user. */
static void format_first_copy(const wt_isotherm *t, const wt_isotherm *original, char *text,
                              size_t size)
{
    if (t->temperature == original->temperature)
        snprintf(text, size, "%s is %s", t->source, original->source);
    else
        clocale_print(text, size, "%s at %.1f degC is %s at %.1f degC", t->source,
                      t->temperature - WT_ZERO_CELSIUS, original->source,
                      original->temperature - WT_ZERO_CELSIUS);
}

/* Every pair of isotherms is compared, because there are few of them. */
void wt_sweep_remove_duplicates(wt_sweep *sweep, wt_log *log)
{
    size_t kept = 0, n = 0;
    char first[2 * sizeof sweep->isotherms->source + 64] = "";
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *const t = &sweep->isotherms[i];
        size_t original = 0;
        remove_duplicate_points(t, log);
        while (original < kept &&
               !is_duplicate(isotherm_points(&sweep->isotherms[original]), isotherm_points(t)))
            original++;
        if (original == kept) {
            sweep->isotherms[kept++] = *t;
            continue;
        }
        if (n++ == 0)
            format_first_copy(t, &sweep->isotherms[original], first, sizeof first);
        free_points(isotherm_points(t));
    }
    sweep->n_isotherms = kept;
    remove_duplicate_ramps(sweep, log);
    remove_duplicate_strain_sweeps(sweep, log);
    if (n > 0)
        wt_log_action(log, WT_WARNING, WT_COPIED, n, WT_KEEP_OPTION, NULL, NULL,
                      "%zu %s and left out; the first: %s", n,
                      n > 1 ? "isotherms are copies of others" : "isotherm is a copy of another",
                      first);
}

/* ---- samples --------------------------------------------------------------------------------- */

wt_status wt_sweep_select_sample(wt_sweep *sweep, const char *name)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        if (is_same_sample(sweep->isotherms[i].sample, name))
            sweep->isotherms[kept++] = sweep->isotherms[i];
        else
            free_points(isotherm_points(&sweep->isotherms[i]));
    sweep->n_isotherms = kept;
    kept = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++)
        if (is_same_sample(sweep->ramps[i].sample, name))
            sweep->ramps[kept++] = sweep->ramps[i];
        else
            free_points(ramp_points(&sweep->ramps[i]));
    sweep->n_ramps = kept;
    kept = 0;
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        if (is_same_sample(sweep->strain_sweeps[i].sample, name))
            sweep->strain_sweeps[kept++] = sweep->strain_sweeps[i];
        else
            free_points(strain_sweep_points(&sweep->strain_sweeps[i]));
    sweep->n_strain_sweeps = kept;
    return sweep->n_isotherms + sweep->n_ramps + kept > 0 ? WT_OK : WT_E_NOT_FOUND;
}
