/* DMA sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/data.h"

#include "base/clocale.h"

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
    free(isotherm->loss_factor);
    free(isotherm->sample);
}

static void ramp_free(wt_ramp *ramp)
{
    free(ramp->temperature);
    free(ramp->storage_modulus);
    free(ramp->loss_modulus);
    free(ramp->strain);
    free(ramp->loss_factor);
    free(ramp->sample);
}

static void strain_sweep_free(wt_strain_sweep *s)
{
    free(s->strain);
    free(s->storage_modulus);
    free(s->loss_modulus);
    free(s->sample);
}

void wt_sweep_clear(wt_sweep *sweep)
{
    if (sweep == NULL)
        return;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        isotherm_free(&sweep->isotherms[i]);
    free(sweep->isotherms);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        ramp_free(&sweep->ramps[i]);
    free(sweep->ramps);
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        strain_sweep_free(&sweep->strain_sweeps[i]);
    free(sweep->strain_sweeps);
    *sweep = (wt_sweep){0};
}

wt_isotherm *wt_sweep_add(wt_sweep *sweep, size_t n, unsigned with)
{
    const bool strain = (with & WT_WITH_STRAIN) != 0, factor = (with & WT_WITH_LOSS_FACTOR) != 0;
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
                            .strain = strain ? malloc(size) : NULL,
                            .loss_factor = factor ? malloc(size) : NULL};
    wt_isotherm *const isotherms =
        realloc(sweep->isotherms, (sweep->n_isotherms + 1) * sizeof *isotherms);
    if (isotherms != NULL)
        sweep->isotherms = isotherms;
    if (isotherms == NULL || isotherm.angular_frequency == NULL ||
        isotherm.storage_modulus == NULL || isotherm.loss_modulus == NULL ||
        (strain && isotherm.strain == NULL) || (factor && isotherm.loss_factor == NULL)) {
        isotherm_free(&isotherm);
        return NULL;
    }
    isotherms[sweep->n_isotherms] = isotherm;
    return &isotherms[sweep->n_isotherms++];
}

wt_ramp *wt_sweep_add_ramp(wt_sweep *sweep, size_t n, unsigned with)
{
    const bool strain = (with & WT_WITH_STRAIN) != 0, factor = (with & WT_WITH_LOSS_FACTOR) != 0;
    if (n > SIZE_MAX / sizeof(double) || sweep->n_ramps >= SIZE_MAX / sizeof *sweep->ramps - 1)
        return NULL;
    const size_t size = (n > 0 ? n : 1) * sizeof(double);
    wt_ramp ramp = {.angular_frequency = (double)NAN,
                    .n = n,
                    .temperature = malloc(size),
                    .storage_modulus = malloc(size),
                    .loss_modulus = malloc(size),
                    .strain = strain ? malloc(size) : NULL,
                    .loss_factor = factor ? malloc(size) : NULL};
    wt_ramp *const ramps = realloc(sweep->ramps, (sweep->n_ramps + 1) * sizeof *ramps);
    if (ramps != NULL)
        sweep->ramps = ramps;
    if (ramps == NULL || ramp.temperature == NULL || ramp.storage_modulus == NULL ||
        ramp.loss_modulus == NULL || (strain && ramp.strain == NULL) ||
        (factor && ramp.loss_factor == NULL)) {
        ramp_free(&ramp);
        return NULL;
    }
    ramps[sweep->n_ramps] = ramp;
    return &ramps[sweep->n_ramps++];
}

wt_strain_sweep *wt_sweep_add_strain_sweep(wt_sweep *sweep, size_t n)
{
    const size_t most = SIZE_MAX / sizeof *sweep->strain_sweeps - 1;
    if (n > SIZE_MAX / sizeof(double) || sweep->n_strain_sweeps >= most)
        return NULL;
    const size_t size = (n > 0 ? n : 1) * sizeof(double);
    wt_strain_sweep made = {.angular_frequency = (double)NAN,
                            .temperature = (double)NAN,
                            .n = n,
                            .strain = malloc(size),
                            .storage_modulus = malloc(size),
                            .loss_modulus = malloc(size)};
    wt_strain_sweep *const all =
        realloc(sweep->strain_sweeps, (sweep->n_strain_sweeps + 1) * sizeof *all);
    if (all != NULL)
        sweep->strain_sweeps = all;
    if (all == NULL || made.strain == NULL || made.storage_modulus == NULL ||
        made.loss_modulus == NULL) {
        strain_sweep_free(&made);
        return NULL;
    }
    all[sweep->n_strain_sweeps] = made;
    return &all[sweep->n_strain_sweeps++];
}

/* ---- order ----------------------------------------------------------------------------------- */

static int by_number(double a, double b) /* not known last */
{
    return isnan(a) || isnan(b) ? isnan(a) - isnan(b) : (a > b) - (a < b);
}

/* By temperature; equal ones by where they came from, steps in their number. */
static int by_temperature(const void *a, const void *b)
{
    const wt_isotherm *const p = a, *const q = b;
    const int order = by_number(p->temperature, q->temperature);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

static int compare_ramps(const void *a, const void *b)
{
    const wt_ramp *const p = a, *const q = b;
    const int order = by_number(p->angular_frequency, q->angular_frequency);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

static int compare_strain_sweeps(const void *a, const void *b)
{
    const wt_strain_sweep *const p = a, *const q = b;
    int order = by_number(p->temperature, q->temperature);
    if (order == 0)
        order = by_number(p->angular_frequency, q->angular_frequency);
    return order != 0 ? order : strverscmp(p->source, q->source);
}

/* Points in arrays that move together: in the order of the first. */
enum { ARRAYS = 5 };
typedef struct points {
    double *array[ARRAYS]; /* those that there are not are NULL */
} points;

static points of_isotherm(const wt_isotherm *t)
{
    return (points){
        {t->angular_frequency, t->storage_modulus, t->loss_modulus, t->strain, t->loss_factor}};
}

static void swap_points(const points *p, size_t i, size_t k)
{
    for (size_t j = 0; j < ARRAYS; j++) {
        if (p->array[j] == NULL)
            continue;
        const double kept = p->array[j][i];
        p->array[j][i] = p->array[j][k];
        p->array[j][k] = kept;
    }
}

static void sift_down(const points *p, size_t root, size_t n)
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

/* Sweeps are also measured from high to low. Heap sort, as it moves several arrays together and
 * needs no memory that could be refused. */
static void sort_points(const points *p, size_t n)
{
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
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const points p = of_isotherm(&sweep->isotherms[i]);
        sort_points(&p, sweep->isotherms[i].n);
    }
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        const wt_ramp *r = &sweep->ramps[i];
        const points p = {
            {r->temperature, r->storage_modulus, r->loss_modulus, r->strain, r->loss_factor}};
        sort_points(&p, r->n);
    }
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++) {
        const wt_strain_sweep *r = &sweep->strain_sweeps[i];
        const points p = {{r->strain, r->storage_modulus, r->loss_modulus}};
        sort_points(&p, r->n);
    }
    if (sweep->n_isotherms > 1)
        qsort(sweep->isotherms, sweep->n_isotherms, sizeof *sweep->isotherms, by_temperature);
    if (sweep->n_ramps > 1)
        qsort(sweep->ramps, sweep->n_ramps, sizeof *sweep->ramps, compare_ramps);
    if (sweep->n_strain_sweeps > 1)
        qsort(sweep->strain_sweeps, sweep->n_strain_sweeps, sizeof *sweep->strain_sweeps,
              compare_strain_sweeps);
}

/* ---- copies ---------------------------------------------------------------------------------- */

static bool same_sample(const char *a, const char *b)
{
    return strcmp(a != NULL ? a : "", b != NULL ? b : "") == 0;
}

/* Of arrays, or of none on both sides. */
static bool same_numbers(const double *a, const double *b, size_t n)
{
    if (a == NULL || b == NULL)
        return a == b;
    return memcmp(a, b, n * sizeof *a) == 0;
}

static bool is_copy(const wt_isotherm *a, const wt_isotherm *b)
{
    return a->n == b->n && same_sample(a->sample, b->sample) &&
           same_numbers(a->angular_frequency, b->angular_frequency, a->n) &&
           same_numbers(a->storage_modulus, b->storage_modulus, a->n) &&
           same_numbers(a->loss_modulus, b->loss_modulus, a->n) &&
           same_numbers(a->loss_factor, b->loss_factor, a->n);
}

static bool same_point(const wt_isotherm *t, size_t i, size_t k)
{
    return same_numbers(t->angular_frequency + i, t->angular_frequency + k, 1) &&
           same_numbers(t->storage_modulus + i, t->storage_modulus + k, 1) &&
           same_numbers(t->loss_modulus + i, t->loss_modulus + k, 1) &&
           (t->loss_factor == NULL || same_numbers(t->loss_factor + i, t->loss_factor + k, 1));
}

/* Points of one frequency stand together. */
static size_t drop_points(wt_isotherm *t)
{
    const points p = of_isotherm(t);
    size_t kept = 0;
    for (size_t i = 0; i < t->n; i++) {
        size_t before = kept;
        while (before > 0 && !same_point(t, before - 1, i) &&
               same_numbers(t->angular_frequency + before - 1, t->angular_frequency + i, 1))
            before--;
        if (before > 0 && same_point(t, before - 1, i))
            continue;
        swap_points(&p, kept++, i);
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

/* Those of one frequency stand together. */
static void drop_copies_of_ramps(wt_sweep *sweep, wt_parselog *log)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        wt_ramp *const t = &sweep->ramps[i];
        const wt_ramp *const b = kept > 0 ? &sweep->ramps[kept - 1] : NULL;
        if (b == NULL || b->n != t->n || b->angular_frequency != t->angular_frequency ||
            !same_sample(b->sample, t->sample) ||
            !same_numbers(b->temperature, t->temperature, t->n) ||
            !same_numbers(b->storage_modulus, t->storage_modulus, t->n) ||
            !same_numbers(b->loss_modulus, t->loss_modulus, t->n) ||
            !same_numbers(b->loss_factor, t->loss_factor, t->n)) {
            sweep->ramps[kept++] = *t;
            continue;
        }
        wt_parselog_add(log, WT_WARNING, t->source, NULL,
                        "this temperature sweep is a copy of that of %s and left out", b->source);
        ramp_free(t);
    }
    sweep->n_ramps = kept;
}

/* Those of one temperature and frequency stand together. */
static void drop_copies_of_strain_sweeps(wt_sweep *sweep, wt_parselog *log)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++) {
        wt_strain_sweep *const t = &sweep->strain_sweeps[i];
        const wt_strain_sweep *const b = kept > 0 ? &sweep->strain_sweeps[kept - 1] : NULL;
        if (b == NULL || b->n != t->n || b->angular_frequency != t->angular_frequency ||
            !same_sample(b->sample, t->sample) || !same_numbers(b->strain, t->strain, t->n) ||
            !same_numbers(b->storage_modulus, t->storage_modulus, t->n) ||
            !same_numbers(b->loss_modulus, t->loss_modulus, t->n)) {
            sweep->strain_sweeps[kept++] = *t;
            continue;
        }
        wt_parselog_add(log, WT_WARNING, t->source, NULL,
                        "this strain sweep is a copy of that of %s and left out", b->source);
        strain_sweep_free(t);
    }
    sweep->n_strain_sweeps = kept;
}

/* Another temperature may be a slip of the one who typed it. */
static void first_copy(const wt_isotherm *t, const wt_isotherm *original, char *text, size_t size)
{
    if (t->temperature == original->temperature)
        snprintf(text, size, "%s is %s", t->source, original->source);
    else
        clocale_print(text, size, "%s at %.1f degC is %s at %.1f degC", t->source,
                      t->temperature - WT_ZERO_CELSIUS, original->source,
                      original->temperature - WT_ZERO_CELSIUS);
}

/* Isotherms are few; those measured again at one temperature fewer. */
void wt_sweep_drop_copies(wt_sweep *sweep, wt_parselog *log)
{
    size_t kept = 0, n = 0;
    char first[2 * sizeof sweep->isotherms->source + 64] = "";
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
            first_copy(t, &sweep->isotherms[original], first, sizeof first);
        isotherm_free(t);
    }
    sweep->n_isotherms = kept;
    drop_copies_of_ramps(sweep, log);
    drop_copies_of_strain_sweeps(sweep, log);
    if (n > 0)
        wt_parselog_add(log, WT_WARNING, NULL, NULL, "%zu %s and left out; the first: %s", n,
                        n > 1 ? "isotherms are copies of others" : "isotherm is a copy of another",
                        first);
}

/* ---- samples --------------------------------------------------------------------------------- */

wt_status wt_sweep_keep_sample(wt_sweep *sweep, const char *name)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        if (same_sample(sweep->isotherms[i].sample, name))
            sweep->isotherms[kept++] = sweep->isotherms[i];
        else
            isotherm_free(&sweep->isotherms[i]);
    sweep->n_isotherms = kept;
    kept = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++)
        if (same_sample(sweep->ramps[i].sample, name))
            sweep->ramps[kept++] = sweep->ramps[i];
        else
            ramp_free(&sweep->ramps[i]);
    sweep->n_ramps = kept;
    kept = 0;
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        if (same_sample(sweep->strain_sweeps[i].sample, name))
            sweep->strain_sweeps[kept++] = sweep->strain_sweeps[i];
        else
            strain_sweep_free(&sweep->strain_sweeps[i]);
    sweep->n_strain_sweeps = kept;
    return sweep->n_isotherms + sweep->n_ramps + kept > 0 ? WT_OK : WT_E_NOT_FOUND;
}
