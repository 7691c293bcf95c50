/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_observe.h"
#include "afm_sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CURVES = 30, SPOTS = 6, FURTHER = 3 };
static const double level = 0.01, share_needed = 0.9;

/* Curves of one draw: a sample and a file for each position. */
typedef struct spots {
    int n;
    const afm_sample *sample[SPOTS];
    afm_sample *own[SPOTS]; /* allocated */
    const char *path[SPOTS];
} spots;

static int write_curves(const afm_sample *sample, const afm_scene *s, random_source *random,
                        int first, int n, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    for (int curve = first; curve < first + n; curve++)
        afm_sample_write(sample, s, random, curve, file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* Sample of one position: the common one, or one of its own. */
static const afm_sample *make_sample(spots *to, int i, const afm_sample *common, afm_scene *here,
                                     random_source *random)
{
    if (here->calibration == CALIBRATION_DRAWN && i > 0)
        return to->sample[0];
    if (here->calibration == CALIBRATION_DRAWN) {
        const double cantilever = 1 + 0.1 * random_normal(random),
                     sensitivity = 1 + 0.03 * random_normal(random);
        here->spring_constant =
            cantilever * (here->spring_constant > 0 ? here->spring_constant : 0.5);
        here->angle_factor = 1 + random_normal(random) / 35;
        here->radius_factor = 1 + 0.1 * random_normal(random);
        to->own[i] = afm_sample_make(here);
        if (to->own[i] != NULL)
            afm_sample_as_stated(to->own[i], cantilever, sensitivity);
    } else if (here->spots > 0) {
        here->modulus =
            (here->modulus > 0 ? here->modulus : 5e6) * exp(here->spots * random_normal(random));
        to->own[i] = afm_sample_make(here);
    }
    return to->own[i] != NULL ? to->own[i] : common;
}

static int make_spots(spots *to, const afm_sample *sample, const afm_scene *s,
                      random_source *random, scene_draw *t)
{
    int bad = sample == NULL;
    *to = (spots){.n = SPOTS};
    for (int i = 0; i < to->n && !bad; i++) {
        char name[24];
        afm_scene here = *s;
        snprintf(name, sizeof name, "curves%d.tsv", i + 1);
        to->path[i] = scene_draw_file(t, name);
        to->sample[i] = make_sample(to, i, sample, &here, random);
        bad =
            to->sample[i] == NULL || write_curves(to->sample[i], &here, random, i * CURVES / to->n,
                                                  CURVES / to->n, to->path[i]) != 0;
    }
    return bad ? -1 : 0;
}

/* Writes the Prony series of a DMA whose moduli are too small by the factor of the scene. */
static int write_spectrum(const afm_scene *s, const char *path)
{
    const relaxation r = afm_relaxation(s);
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fprintf(file,
            "## table: " PLACE_PRONY "\n## deformation: tension\n"
            "## equilibrium_modulus: %.17g standard_error=nan numerical_error=0 unit=Pa\n"
            "## reference_temperature: 296.15 standard_error=0 numerical_error=0 unit=K\n"
            "# " PLACE_PRONY_TIME "[s]\t" PLACE_PRONY_MODULUS "[Pa]\n",
            r.rest / s->dma);
    for (size_t i = 0; i < r.n; i++)
        fprintf(file, "%.17g\t%.17g\n", r.tau[i], r.e[i] / s->dma);
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* True if most curves are accepted and all curves together show no lack of fit. */
static void read_curves(const char *path, const afm_scene *s, const afm_sample *sample,
                        const spots *from, scene_draw *t)
{
    stream *found = stream_read(path);
    const bool drawn = s->calibration == CALIBRATION_DRAWN;
    if (found == NULL || stream_rows(found, place_modulus.table) != CURVES) {
        scene_draw_broke(t, "not as many curves as there were");
    } else {
        int accepted = 0;
        for (int i = 0; i < CURVES; i++) {
            estimate e = place_row(found, &place_modulus, i);
            const char *table = place_modulus.table;
            const int good = stream_is(found, table, PLACE_CURVE, i, PLACE_ACCEPTED);
            accepted += good;
            if (!good && !stream_is(found, table, PLACE_CURVE, i, PLACE_WIDE) &&
                !stream_is(found, table, PLACE_CURVE, i, PLACE_DOUBTFUL))
                e.value = e.low = e.high = (double)NAN;
            if (!drawn) /* the errors of a curve do not hold those that all curves share */
                scene_draw_add(t, Q_MODULUS, from->sample[i * from->n / CURVES]->modulus, e);
            if (s->dma > 0)
                scene_draw_add(t, Q_FACTOR, s->dma, place_row(found, &place_factor, i));
        }
        const estimate group = place_key(found, &place_budget[0]);
        if (!(s->spots > 0) && group.value > 0) /* otherwise the positions share no modulus */
            scene_draw_add(t, Q_GROUP_MODULUS, from->sample[0]->modulus, group);
        const double chance = stream_number(found, place_modulus.table, PLACE_POOLED_CHANCE, NULL);
        const char *changes = stream_key(found, PLACE_DEPTH, PLACE_DEPTH_CHANGES);
        const bool silent = changes != NULL &&
                            strncmp(changes, PLACE_INCONCLUSIVE, strlen(PLACE_INCONCLUSIVE)) == 0;
        const bool shown = changes != NULL && strncmp(changes, PLACE_YES, strlen(PLACE_YES)) == 0;
        t->draw->verdict = accepted < share_needed * CURVES || chance < level || shown ? NO
                           : isnan(chance) || silent ? INCONCLUSIVE
                                                     : YES;
        for (int i = 0; i < AFM_DEPTHS && changes != NULL && s->tip != TIP_PUNCH && !drawn; i++)
            scene_draw_add(t, Q_DEPTH, afm_apparent(s, sample, (i + 1.0) / AFM_DEPTHS),
                           place_row(found, &place_depth, i));
    }
    stream_free(found);
}

static const facts *scene_facts(int scene)
{
    return &afm_scenes[scene].facts;
}

static void *prepare(int scene)
{
    return afm_sample_make(&afm_scenes[scene]);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    static const char *const tip[] = {[TIP_PYRAMID] = "pyramid:half-angle=35deg,radius=20nm",
                                      [TIP_SHARP] = "pyramid:half-angle=35deg,radius=0nm",
                                      [TIP_THREE_SIDES] =
                                          "pyramid:half-angle=35deg,radius=20nm,sides=3",
                                      [TIP_CONE] = "cone:half-angle=35deg",
                                      [TIP_BLUNT_CONE] = "cone:half-angle=35deg,radius=20nm",
                                      [TIP_PARABOLOID] = "paraboloid:radius=100nm",
                                      [TIP_SPHERE] = "sphere:radius=100nm",
                                      [TIP_PUNCH] = "punch:radius=100nm"};
    const afm_scene *s = &afm_scenes[scene];
    const afm_sample *sample = prepared;
    const char *made = scene_draw_file(t, "indentation.tsv");
    const char *spectrum = s->dma > 0 ? scene_draw_file(t, "spectrum.tsv") : NULL;
    char told[128], cantilever[32];
    snprintf(told, sizeof told, "%s", tip[s->tip]);
    if (s->radius_stated > 0) /* at a depth of 50 nm */
        snprintf(told, sizeof told, "pyramid:half-angle=35deg+-%.9g%%,radius=50nm+-%.9g%%",
                 100 * s->angle_stated, 100 * s->radius_stated);
    if (s->calibration >= CALIBRATION_EXACT) /* the tip of these scenes is a blunted pyramid */
        snprintf(told, sizeof told, "pyramid:half-angle=35deg+-0.01%%,radius=20nm+-0.01%%");
    const char *arguments[SPOTS + 32] = {"indent"};
    char values[FURTHER][32];
    spots from;
    int n = 1;
    if (make_spots(&from, sample, s, random, t) != 0 ||
        (spectrum != NULL && write_spectrum(s, spectrum) != 0)) {
        scene_draw_broke(t, "the curves cannot be written");
    } else {
        const char *const options[] = {
            "--tip", told, "--group",         "bulk",
            "-o",    made, "--no-provenance", spectrum != NULL ? "--master" : NULL,
            spectrum};
        for (int i = 0; i < from.n; i++)
            arguments[n++] = from.path[i];
        for (size_t i = 0; i < sizeof options / sizeof options[0] && options[i] != NULL; i++)
            arguments[n++] = options[i];
        const struct {
            const char *name, *unit;
            double value;
        } further[FURTHER] = {{"--sample-thickness", "m", s->untold ? 0 : s->thickness},
                              {"--fit-depth-from", "m", s->depth_from},
                              {"--fit-force-fraction", "", s->force_to}};
        for (size_t i = 0; i < FURTHER; i++)
            if (further[i].value > 0) {
                snprintf(values[i], sizeof values[i], "%.9g%s", further[i].value, further[i].unit);
                arguments[n++] = further[i].name;
                arguments[n++] = values[i];
            }
        if (s->unbonded)
            arguments[n++] = "--unbonded";
        if (s->calibration >= CALIBRATION_EXACT) {
            snprintf(cantilever, sizeof cantilever, "%.9gN/m+-0.01%%", sample->spring_constant);
            const char *const exact[] = {"--spring-constant",
                                         cantilever,
                                         "--sensitivity-error",
                                         "1e-4",
                                         "--thick-sample",
                                         "--piezo-nonlinearity",
                                         "1e-4",
                                         "--detector-nonlinearity",
                                         "1e-4"};
            const size_t stated = s->calibration == CALIBRATION_UNTOLD ? 4 : 9;
            for (size_t i = 0; i < stated; i++)
                arguments[n++] = exact[i];
        }
        if (scene_draw_run(t, arguments))
            read_curves(made, s, sample, &from, t);
    }
    for (int i = 0; i < from.n; i++)
        free(from.own[i]);
}

family afm_family(void)
{
    return (family){
        .n = n_afm_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
