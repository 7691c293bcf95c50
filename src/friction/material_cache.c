/* Cache of the materials of the replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/material_cache.h"
#include "job/random_draws.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Only this number of replicates is stored: the series of a Prony material takes 1 kB, that of a
 * table some 100 kB. */
enum { MOST_KEPT = 1024 };

typedef struct drawn_item {
    drawn_material of;
    arena memory; /* memory of the series */
} drawn_item;

typedef struct own_material {
    const wt_rubber *rubber; /* NULL if not yet created */
    double temperature, tolerance;
    drawn_item item;
    char statement[512];
    bool held;
} own_material;

struct wt_material_cache {
    own_material own;        /* material for the stated values; all other members belong to the
                                replicates */
    const wt_rubber *rubber; /* rubber of the cached materials; NULL if none yet */
    wt_estimate temperature;
    uint64_t seed;
    bool one; /* no property of the material is drawn: all replicates share the first */
    size_t n;
    drawn_item *items;      /* [n] */
    double lowest, highest; /* range of the angular frequencies [rad/s] */
};

static void drop_item(drawn_item *item)
{
    angular_clear(item->of.series);
    arena_free(&item->memory);
    wt_material_free(item->of.material);
    *item = (drawn_item){0};
}

static void drop_materials(wt_material_cache *d)
{
    for (size_t i = 0; i < d->n; i++)
        drop_item(&d->items[i]);
    free(d->items);
    *d = (wt_material_cache){.own = d->own};
}

wt_material_cache *material_cache_new(void)
{
    return calloc(1, sizeof(wt_material_cache));
}

void material_cache_free(wt_material_cache *drawn)
{
    if (drawn != NULL) {
        drop_item(&drawn->own.item);
        drop_materials(drawn);
    }
    free(drawn);
}

static bool is_that(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static bool is_of(const wt_material_cache *d, const wt_sliding *s, const wt_job *work)
{
    return d->rubber == s->rubber && d->seed == work->seed &&
           is_that(d->temperature.value, s->temperature.value) &&
           is_that(d->temperature.standard_error, s->temperature.standard_error) &&
           (d->one || d->n == MOST_KEPT || d->n >= work->replicates);
}

static wt_status start_materials(wt_material_cache *d, const wt_sliding *sliding,
                                 const wt_job *work, wt_error *err)
{
    const wt_rubber *rubber = sliding->rubber;
    const bool one = rubber->n_draws == 0 && !(rubber->c1_error > 0) && !(rubber->c2_error > 0) &&
                     !(sliding->temperature.standard_error > 0);
    const size_t n = work->replicates < MOST_KEPT ? work->replicates : MOST_KEPT;
    drop_materials(d);
    *d = (wt_material_cache){.own = d->own,
                             .rubber = rubber,
                             .temperature = sliding->temperature,
                             .seed = work->seed,
                             .one = one,
                             .items = calloc(one ? 1 : n + 1, sizeof *d->items)};
    if (d->items == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for the materials of the replicates");
    d->n = one ? 1 : n;
    return WT_OK;
}

wt_status material_cache_begin(wt_material_cache *d, const wt_sliding *sliding, const wt_job *work,
                               double slowest, double fastest, wt_error *err)
{
    wt_roughness *road = NULL;
    wt_status status = is_of(d, sliding, work) ? WT_OK : start_materials(d, sliding, work, err);
    if (status == WT_OK)
        status = wt_surface_roughness(sliding->surface, 1, &road, err);
    if (status != WT_OK)
        return status;
    d->lowest = slowest * road->q0;
    d->highest = fastest * road->q1;
    wt_roughness_free(road);
    /* from here on, the threads only read it */
    drawn_material all;
    return d->one ? material_cache_get(d, 0, &all, err) : WT_OK;
}

static wt_status make_material(const wt_material_cache *d, size_t replicate, drawn_item *item,
                               wt_error *err)
{
    drawn_material *of = &item->of;
    wt_status status = wt_rubber_at(
        d->rubber, flow_draw_value(d->temperature, d->seed, replicate, FLOW_DRAW_TEMPERATURE),
        d->seed, replicate, &of->material, NULL, err);
    if (status == WT_OK)
        status = angular_new(of->material, REPLICATE_TOLERANCE, &item->memory, &of->series, err);
    if (status != WT_OK) { /* the next contact reports the error again */
        wt_material_free(of->material);
        arena_free(&item->memory);
        *item = (drawn_item){0};
    }
    return status;
}

wt_status material_cache_get(wt_material_cache *d, size_t replicate, drawn_material *material,
                             wt_error *err)
{
    *material = (drawn_material){0};
    if (!d->one && replicate >= d->n)
        return WT_OK;
    drawn_item *item = &d->items[d->one ? 0 : replicate];
    wt_status status = item->of.material == NULL ? make_material(d, replicate, item, err) : WT_OK;
    if (status == WT_OK)
        status = angular_cover(item->of.series, d->lowest, d->highest, err);
    if (status == WT_OK)
        *material = item->of;
    return status;
}

/* ---- stated values --------------------------------------------------------------------------- */

static wt_status make_own(own_material *own, const wt_sliding *sliding, double tolerance,
                          wt_error *err)
{
    drawn_item *item = &own->item;
    drop_item(item);
    *own = (own_material){.temperature = sliding->temperature.value, .tolerance = tolerance};
    wt_status status = wt_rubber_at(sliding->rubber, own->temperature, 0, WT_NO_REPLICATE,
                                    &item->of.material, own->statement, err);
    if (status == WT_OK && item->of.material->law->angular == NULL)
        status = angular_new(item->of.material, tolerance, &item->memory, &item->of.series, err);
    if (status == WT_OK)
        own->rubber = sliding->rubber;
    else
        drop_item(item);
    return status;
}

/* Extends the series to the wavenumbers of the surface. A range that the material cannot have is
 * left to the contact, which reports it. */
static wt_status cover_own(own_material *own, const wt_sliding *sliding, double slowest,
                           double fastest, wt_error *err)
{
    wt_roughness *road = NULL;
    wt_status status = wt_surface_roughness(sliding->surface, 1, &road, err);
    const double lowest = status == WT_OK ? slowest * road->q0 : 0,
                 highest = status == WT_OK ? fastest * road->q1 : 0;
    wt_roughness_free(road);
    const wt_material *m = own->item.of.material;
    char ignored[256];
    if (status != WT_OK || !(lowest >= ANGULAR_LEAST && highest <= DBL_MAX) ||
        (m->law->check != NULL && m->law->check(m, lowest, highest, ignored, NULL) != WT_OK))
        return status;
    return angular_cover(own->item.of.series, lowest, highest, err);
}

wt_status drawn_values_get(wt_material_cache *drawn, const wt_sliding *sliding, double tolerance,
                           double slowest, double fastest, drawn_values *values, wt_error *err)
{
    *values = (drawn_values){.statement = ""};
    if (drawn == NULL)
        return WT_OK;
    own_material *own = &drawn->own;
    const bool is_it = own->rubber == sliding->rubber && own->tolerance == tolerance &&
                       is_that(own->temperature, sliding->temperature.value);
    if (own->held && !is_it)
        return WT_OK;
    wt_status status = is_it ? WT_OK : make_own(own, sliding, tolerance, err);
    if (status == WT_OK && !own->held && own->item.of.series != NULL)
        status = cover_own(own, sliding, slowest, fastest, err);
    if (status == WT_OK)
        *values = (drawn_values){own->item.of, own->statement};
    return status;
}

void material_cache_pin(wt_material_cache *drawn, bool held)
{
    if (drawn != NULL)
        drawn->own.held = held;
}
