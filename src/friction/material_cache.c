/* Cache of the materials of the replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/material_cache.h"
#include "core/base/number.h"
#include "job/random_draws.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Only this number of replicates is stored: the series of a Prony material takes 1 kB, that of a
 * table some 100 kB. */
enum { MAX_CACHED = 1024 };

typedef struct cached_material {
    replicate_material content;
    arena memory; /* memory of the series */
} cached_material;

typedef struct stated_material {
    const wt_rubber *rubber; /* NULL if not yet created */
    double temperature, tolerance;
    cached_material item;
    char statement[512];
    bool pinned;
} stated_material;

struct wt_material_cache {
    stated_material stated;  /* material for the stated values; all other members belong to the
                          replicates */
    const wt_rubber *rubber; /* rubber of the cached materials; NULL if none yet */
    wt_estimate temperature;
    uint64_t seed;
    bool is_single; /* no property of the material is drawn: all replicates share the first */
    size_t n;
    cached_material *items; /* [n] */
    double lowest, highest; /* range of the angular frequencies [rad/s] */
};

static void free_cached_material(cached_material *item)
{
    angular_clear(item->content.series);
    arena_free(&item->memory);
    wt_material_free(item->content.material);
    *item = (cached_material){0};
}

static void free_replicate_materials(wt_material_cache *d)
{
    for (size_t i = 0; i < d->n; i++)
        free_cached_material(&d->items[i]);
    free(d->items);
    *d = (wt_material_cache){.stated = d->stated};
}

wt_material_cache *material_cache_new(void)
{
    return wt_alloc(1, sizeof(wt_material_cache));
}

void material_cache_free(wt_material_cache *drawn)
{
    if (drawn != NULL) {
        free_cached_material(&drawn->stated.item);
        free_replicate_materials(drawn);
    }
    free(drawn);
}

static bool is_current(const wt_material_cache *d, const wt_sliding *s, const wt_job *work)
{
    return d->rubber == s->rubber && d->seed == work->seed &&
           is_same_number(d->temperature.value, s->temperature.value) &&
           is_same_number(d->temperature.standard_error, s->temperature.standard_error) &&
           (d->is_single || d->n == MAX_CACHED || d->n >= work->replicates);
}

static void reset_materials(wt_material_cache *d, const wt_sliding *sliding, const wt_job *work)
{
    const wt_rubber *rubber = sliding->rubber;
    const bool is_single = rubber->n_draws == 0 && !(rubber->c1_error > 0) &&
                           !(rubber->c2_error > 0) && !(sliding->temperature.standard_error > 0);
    const size_t n = work->replicates < MAX_CACHED ? work->replicates : MAX_CACHED;
    free_replicate_materials(d);
    *d = (wt_material_cache){.stated = d->stated,
                             .rubber = rubber,
                             .temperature = sliding->temperature,
                             .seed = work->seed,
                             .is_single = is_single,
                             .items = wt_alloc(is_single ? 1 : n + 1, sizeof *d->items)};
    d->n = is_single ? 1 : n;
}

wt_status material_cache_prepare(wt_material_cache *d, const wt_sliding *sliding,
                                 const wt_job *work, double slowest, double fastest, wt_error *err)
{
    wt_roughness *roughness = NULL;
    if (!is_current(d, sliding, work))
        reset_materials(d, sliding, work);
    const wt_status status = wt_surface_roughness(sliding->surface, 1, &roughness, err);
    if (status != WT_OK)
        return status;
    d->lowest = slowest * roughness->q0;
    d->highest = fastest * roughness->q1;
    wt_roughness_free(roughness);
    /* from here on, the threads only read it */
    replicate_material all;
    return d->is_single ? material_cache_get(d, 0, &all, err) : WT_OK;
}

static wt_status create_material(const wt_material_cache *d, size_t replicate,
                                 cached_material *item, wt_error *err)
{
    replicate_material *content = &item->content;
    wt_status status = wt_rubber_material(
        d->rubber, flow_draw_value(d->temperature, d->seed, replicate, FLOW_DRAW_TEMPERATURE),
        d->seed, replicate, &content->material, NULL, err);
    if (status == WT_OK)
        content->series = angular_new(content->material, REPLICATE_TOLERANCE, &item->memory);
    return status;
}

wt_status material_cache_get(wt_material_cache *d, size_t replicate, replicate_material *material,
                             wt_error *err)
{
    *material = (replicate_material){0};
    if (!d->is_single && replicate >= d->n)
        return WT_OK;
    cached_material *item = &d->items[d->is_single ? 0 : replicate];
    wt_status status =
        item->content.material == NULL ? create_material(d, replicate, item, err) : WT_OK;
    if (status == WT_OK) {
        angular_extend(item->content.series, d->lowest, d->highest);
        *material = item->content;
    }
    return status;
}

/* ---- stated values --------------------------------------------------------------------------- */

static wt_status create_stated_material(stated_material *stated, const wt_sliding *sliding,
                                        double tolerance, wt_error *err)
{
    cached_material *item = &stated->item;
    free_cached_material(item);
    *stated = (stated_material){.temperature = sliding->temperature.value, .tolerance = tolerance};
    wt_status status = wt_rubber_material(sliding->rubber, stated->temperature, 0, WT_NO_REPLICATE,
                                          &item->content.material, stated->statement, err);
    if (status == WT_OK && item->content.material->law->angular == NULL)
        item->content.series = angular_new(item->content.material, tolerance, &item->memory);
    if (status == WT_OK)
        stated->rubber = sliding->rubber;
    else
        free_cached_material(item);
    return status;
}

/* Extends the series to the wavenumbers of the surface. A range that the material cannot have is
 * left to the contact, which reports it. */
static wt_status extend_stated_series(stated_material *stated, const wt_sliding *sliding,
                                      double slowest, double fastest, wt_error *err)
{
    wt_roughness *roughness = NULL;
    wt_status status = wt_surface_roughness(sliding->surface, 1, &roughness, err);
    const double lowest = status == WT_OK ? slowest * roughness->q0 : 0,
                 highest = status == WT_OK ? fastest * roughness->q1 : 0;
    wt_roughness_free(roughness);
    const wt_material *m = stated->item.content.material;
    char ignored[256];
    if (status != WT_OK || !(lowest >= ANGULAR_MIN_FREQUENCY && highest <= DBL_MAX) ||
        (m->law->check != NULL && m->law->check(m, lowest, highest, ignored, NULL) != WT_OK))
        return status;
    angular_extend(stated->item.content.series, lowest, highest);
    return WT_OK;
}

wt_status material_cache_get_stated(wt_material_cache *drawn, const wt_sliding *sliding,
                                    double tolerance, double slowest, double fastest,
                                    shared_material *values, wt_error *err)
{
    *values = (shared_material){.statement = ""};
    if (drawn == NULL)
        return WT_OK;
    stated_material *stated = &drawn->stated;
    const bool matches = stated->rubber == sliding->rubber && stated->tolerance == tolerance &&
                         is_same_number(stated->temperature, sliding->temperature.value);
    if (stated->pinned && !matches)
        return WT_OK;
    wt_status status = matches ? WT_OK : create_stated_material(stated, sliding, tolerance, err);
    if (status == WT_OK && !stated->pinned && stated->item.content.series != NULL)
        status = extend_stated_series(stated, sliding, slowest, fastest, err);
    if (status == WT_OK)
        *values = (shared_material){stated->item.content, stated->statement};
    return status;
}

void material_cache_pin(wt_material_cache *drawn, bool pinned)
{
    if (drawn != NULL)
        drawn->stated.pinned = pinned;
}
