/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "thickness_observe.h"

#include "afm_sample.h"
#include "thickness_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPOTS = 4, CURVES = 8 }; /* positions in a zone; curves at a position */
static const char *const zones[2] = {"bulk", "track"};
static const double bulk_modulus = 5e6;
static const double nanometre = 1e-9;

/* ---- curves ---------------------------------------------------------------------------------- */

static int write_spot(const thickness_scene *s, const thin_sample *layer, int zone, int spot,
                      random_source *random, const char *path)
{
    afm_scene here = s->curves;
    FILE *file = fopen(path, "w");
    here.modulus =
        bulk_modulus * (zone > 0 ? s->ratio : 1) * exp(s->spot_scatter * random_normal(random));
    here.layered = zone > 0 ? layer : NULL;
    afm_sample *sample = afm_sample_make(&here);
    for (int i = 0; file != NULL && sample != NULL && i < CURVES; i++)
        afm_sample_write(sample, &here, random, spot * CURVES + i, file);
    const int bad = sample == NULL || file == NULL || ferror(file);
    free(sample);
    return (file != NULL && fclose(file) != 0) || bad ? -1 : 0;
}

/* Table of a zone; NULL if the command failed. */
static const char *indent_zone(const thickness_scene *s, const thin_sample *layer, int zone,
                               random_source *random, scene_draw *t)
{
    char name[32];
    const char *paths[SPOTS];
    snprintf(name, sizeof name, "%s.tsv", zones[zone]);
    const char *const made = scene_draw_file(t, name);
    for (int spot = 0; spot < SPOTS; spot++) {
        snprintf(name, sizeof name, "%s-%d.tsv", zones[zone], spot + 1);
        paths[spot] = scene_draw_file(t, name);
        if (write_spot(s, layer, zone, spot, random, paths[spot]) != 0) {
            scene_draw_broke(t, "the curves cannot be written");
            return NULL;
        }
    }
    const char *const arguments[] = {"indent",
                                     "--tip",
                                     s->curves.tip == TIP_PARABOLOID
                                         ? "paraboloid:radius=100nm"
                                         : "pyramid:half-angle=35deg,radius=20nm",
                                     "--group",
                                     zones[zone],
                                     "-o",
                                     made,
                                     "--no-provenance",
                                     "--threads",
                                     "1",
                                     paths[0],
                                     paths[1],
                                     paths[2],
                                     paths[3],
                                     NULL};
    return scene_draw_run(t, arguments) ? made : NULL;
}

/* ---- output ---------------------------------------------------------------------------------- */

static bool begins(const char *said, const char *word)
{
    return said != NULL && strncmp(said, word, strlen(word)) == 0;
}

/* ln of the limits; an absent limit is beyond any thickness. */
static estimate range_of(const stream *found, const char *low, const char *high)
{
    const double far = 20; /* ln of nanometres */
    estimate e = {0, log(stream_number(found, PLACE_LAYER, low, NULL) / nanometre),
                  log(stream_number(found, PLACE_LAYER, high, NULL) / nanometre)};
    if (isnan(e.low))
        e.low = -far;
    if (isnan(e.high))
        e.high = far;
    e.value = 0.5 * (e.low + e.high);
    return e;
}

static void read_layer(const char *path, const thickness_scene *s, scene_draw *t)
{
    stream *found = stream_read(path);
    const char *allowed =
        found != NULL ? stream_key(found, PLACE_LAYER, PLACE_LAYER_ALLOWED) : NULL;
    const char *agree = found != NULL ? stream_key(found, PLACE_LAYER, PLACE_LAYER_AGREE) : NULL;
    if (allowed == NULL || agree == NULL) {
        scene_draw_broke(t, "no thickness in what was written");
    } else {
        /* a track of one rubber is thicker than any indentation */
        const double whole = 15, truth = s->thickness > 0 ? log(s->thickness / nanometre) : whole;
        estimate e = range_of(found, PLACE_LAYER_LOW, PLACE_LAYER_HIGH);
        if (begins(allowed, PLACE_NONE)) /* stated, but contains no value */
            e.low = e.high = e.value = -1;
        if (begins(allowed, PLACE_INCONCLUSIVE))
            e.low = e.high = (double)NAN;
        scene_draw_add(t, Q_ALLOWED, truth, e);
        if (s->other == 1) /* range in which the other source is right */
            scene_draw_add(t, Q_BOTH, truth,
                           stream_key(found, PLACE_LAYER, PLACE_LAYER_BOTH_LOW) != NULL
                               ? range_of(found, PLACE_LAYER_BOTH_LOW, PLACE_LAYER_BOTH_HIGH)
                               : (estimate){-1, -1, -1});
        t->draw->verdict = begins(agree, PLACE_YES)            ? YES
                           : begins(agree, PLACE_INCONCLUSIVE) ? INCONCLUSIVE
                           : begins(agree, PLACE_NO)           ? NO
                                                               : NO_VERDICT;
    }
    stream_free(found);
}

/* ---- one draw -------------------------------------------------------------------------------- */

static const facts *scene_facts(int scene)
{
    return &thickness_scenes[scene].facts;
}

/* The layer, which all positions share. */
static void *prepare(int scene)
{
    const thickness_scene *s = &thickness_scenes[scene];
    const afm_tip tip = afm_true_tip(&s->curves);
    const double deepest = 300e-9; /* [m], larger than any indentation */
    return s->thickness > 0 ? layer_make(&tip, s->thickness, s->ratio,
                                         fmin(5 * s->thickness, tip_contact_radius(&tip, deepest)))
                            : NULL;
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const thickness_scene *s = &thickness_scenes[scene];
    const double mean = s->thickness > 0 ? s->other * s->thickness : s->other_thickness;
    const double other = mean * exp(s->other_error * random_normal(random));
    char told[64];
    const char *made[2];
    for (int zone = 0; zone < 2; zone++)
        if ((made[zone] = indent_zone(s, prepared, zone, random, t)) == NULL)
            return;
    snprintf(told, sizeof told, "%.9gnm +- %.9gnm", other / nanometre,
             s->other_error * other / nanometre);
    const char *compared = scene_draw_file(t, "layer.tsv");
    const char *const arguments[] = {
        "compare", made[0], made[1],  "--expected-thickness", told, "--indentation-temperature",
        "23degC",  "-o",    compared, "--no-provenance",      NULL};
    if (scene_draw_run(t, arguments))
        read_layer(compared, s, t);
}

family thickness_family(void)
{
    return (family){
        .n = n_thickness_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
