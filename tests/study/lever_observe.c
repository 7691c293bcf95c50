/* Observes curves through indent and compare, with calibration errors of cantilevers and tips drawn
 * once for all curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "lever_observe.h"
#include "afm_sample.h"
#include "lever_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPOTS = 6, CURVES = 2 };
static const double bulk_modulus = 5e6, usual_ratio = 1.4, usual_scatter = 0.04, usual_lever = 0.5,
                    second_lever = 1.2, half_angle = 35, radius = 20e-9;
static const char *const zones[2] = {"bulk", "track"};

/* Ratios of true and stated values. */
typedef struct calibration {
    double stated; /* spring constant [N/m] */
    double cantilever, sensitivity, angle, radius;
} calibration;

static calibration draw_calibration(const lever_scene *s, int zone, random_source *random)
{
    calibration c = {.stated = s->spring_constant > 0 ? s->spring_constant : usual_lever};
    if (s->two && zone > 0)
        c.stated *= second_lever;
    c.cantilever = 1 + s->cantilever * random_normal(random);
    c.sensitivity = 1 + s->sensitivity * random_normal(random);
    c.angle = 1 + s->angle * random_normal(random);
    c.radius = 1 + s->radius * random_normal(random);
    return c;
}

/* The file has the deflection by the stated sensitivity and the force by the stated spring
 * constant. */
static afm_sample *make_sample(const lever_scene *s, int zone, const calibration *c,
                               random_source *random, afm_scene *here)
{
    const double ratio = s->ratio > 0 ? s->ratio : usual_ratio,
                 scatter = s->scatter > 0 ? s->scatter : usual_scatter;
    *here = (afm_scene){.noise = s->noise > 0 ? s->noise : 0.005,
                        .modulus = bulk_modulus * (zone > 0 ? ratio : 1) *
                                   exp(scatter * random_normal(random)),
                        .spring_constant = c->stated * c->cantilever,
                        .radius_factor = c->radius * (zone > 0 && s->worn > 0 ? s->worn : 1),
                        .angle_factor = c->angle,
                        .pull = zone > 0 ? s->pull : 0,
                        .reach = s->reach,
                        .depth = s->depth[zone]};
    afm_sample *sample = afm_sample_make(here);
    if (sample != NULL)
        afm_sample_as_stated(sample, c->cantilever, c->sensitivity);
    return sample;
}

/* Writes a file for each position. */
static int write_zone(const lever_scene *s, int zone, const calibration *c, random_source *random,
                      const char *const *paths)
{
    int bad = 0;
    for (int spot = 0; spot < SPOTS && !bad; spot++) {
        afm_scene here;
        afm_sample *sample = make_sample(s, zone, c, random, &here);
        FILE *file = sample != NULL ? fopen(paths[spot], "w") : NULL;
        bad = file == NULL;
        for (int i = 0; i < CURVES && !bad; i++)
            afm_sample_write(sample, &here, random, spot * CURVES + i, file);
        if (file != NULL)
            bad = ferror(file) != 0 || fclose(file) != 0 || bad;
        free(sample);
    }
    return bad ? -1 : 0;
}

static bool run_indent(const lever_scene *s, int zone, const calibration *c,
                       const char *const *paths, const char *made, scene_draw *t)
{
    char tip[128], cantilever[64], sensitivity[32];
    const char *arguments[SPOTS + 20] = {
        "indent",    "--tip", tip,  "--spring-constant", cantilever, "--group",
        zones[zone], "-o",    made, "--no-provenance"};
    int n = 10;
    snprintf(tip, sizeof tip, "pyramid:half-angle=%.9gdeg+-%.9g%%,radius=%.9gm+-%.9g%%", half_angle,
             100 * s->angle, radius, 100 * s->radius);
    snprintf(cantilever, sizeof cantilever, "%.9gN/m+-%.9g%%", c->stated, 100 * s->cantilever);
    if (s->sensitivity > 0) {
        snprintf(sensitivity, sizeof sensitivity, "%.9g", s->sensitivity);
        arguments[n++] = "--sensitivity-error";
        arguments[n++] = sensitivity;
    }
    for (int i = 0; i < SPOTS; i++)
        arguments[n++] = paths[i];
    return scene_draw_run(t, arguments);
}

static void read_budget(const lever_scene *s, int zone, const char *path, scene_draw *t)
{
    const double ratio = s->ratio > 0 ? s->ratio : usual_ratio;
    stream *found = stream_read(path);
    const estimate e = found != NULL ? place_key(found, &place_budget[zone]) : (estimate){0};
    /* without an accepted curve there is none: every curve reveals so wrong a tip */
    if (found == NULL)
        scene_draw_broke(t, "nothing was written");
    else if (!(e.value > 0))
        t->draw->outcome = OUTCOME_REFUSED;
    else
        scene_draw_add(t, Q_GROUP_MODULUS, bulk_modulus * (zone > 0 ? ratio : 1), e);
    stream_free(found);
}

static void read_ratio(const lever_scene *s, const char *path, scene_draw *t)
{
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_ratio.table) == 0) {
        scene_draw_broke(t, "no comparison in what was written");
    } else {
        const char *said = stream_key(found, place_ratio.table, PLACE_DIFFERS);
        t->draw->verdict = said == NULL                                       ? NO_VERDICT
                           : strncmp(said, PLACE_YES, strlen(PLACE_YES)) == 0 ? YES
                           : strncmp(said, PLACE_NO, strlen(PLACE_NO)) == 0   ? NO
                                                                              : INCONCLUSIVE;
        scene_draw_add(t, Q_RATIO, s->ratio > 0 ? s->ratio : usual_ratio,
                       place_row(found, &place_ratio, 0));
    }
    stream_free(found);
}

static const facts *scene_facts(int scene)
{
    return &lever_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const lever_scene *s = &lever_scenes[scene];
    const char *compared = scene_draw_file(t, "comparison.tsv"), *paths[SPOTS],
               *made[2] = {scene_draw_file(t, "bulk.tsv"), scene_draw_file(t, "track.tsv")};
    calibration c = draw_calibration(s, 0, random);
    char name[24];
    (void)prepared;
    for (int i = 0; i < SPOTS; i++) {
        snprintf(name, sizeof name, "spot%d.tsv", i + 1);
        paths[i] = scene_draw_file(t, name);
    }
    for (int zone = 0; zone < 2; zone++) {
        if (zone > 0 && s->two)
            c = draw_calibration(s, zone, random);
        if (write_zone(s, zone, &c, random, paths) != 0) {
            scene_draw_broke(t, "the curves cannot be written");
            return;
        }
        if (!run_indent(s, zone, &c, paths, made[zone], t))
            return;
        if (s->cantilever > 0 || s->sensitivity > 0 || s->angle > 0) /* otherwise there is none */
            read_budget(s, zone, made[zone], t);
    }
    const char *const arguments[] = {"compare", made[0],           made[1], "-o",
                                     compared,  "--no-provenance", NULL};
    if (scene_draw_run(t, arguments))
        read_ratio(s, compared, t);
}

family lever_family(void)
{
    return (family){
        .n = n_lever_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
