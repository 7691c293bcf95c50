/* Observes a thickness and a wear rate through weartrack identify.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "identify_observe.h"
#include "contact.h"
#include "identify_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INTERVALS = 100 };
static const contact stated = {.q0 = 2e3,
                               .qr = 4e3,
                               .q1 = 1e6,
                               .hurst = 0.8,
                               .c0 = 2e-17,
                               .pressure = 0.4e6,
                               .poisson = 0.5,
                               .temperature = 20,
                               .velocities = 1,
                               .velocity = {0.3},
                               .wear_rate = 1e-12};

static const facts *scene_facts(int scene)
{
    return &identify_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void read_found(const contact *truth, const char *path, scene_draw *t)
{
    enum { BY_WEAR = 1 }; /* the first row uses the thickness alone */
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_energy.table) != 2) {
        scene_draw_broke(t, "another number of rows");
    } else {
        scene_draw_add(t, Q_CRITICAL_ENERGY, truth->critical_energy,
                       place_row(found, &place_energy, BY_WEAR));
        scene_draw_add(t, Q_WEAR_RATE, truth->wear_rate,
                       place_row(found, &place_energy_wear, BY_WEAR));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const identify_scene *s = &identify_scenes[scene];
    const char *material = scene_draw_file(t, "material.tsv"),
               *made = scene_draw_file(t, "found.tsv");
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    char surface[160], pressure[64], thickness[64], wear[64];
    contact truth = stated;
    (void)prepared;
    truth.pressure = random_about(stated.pressure, s->of_inputs, random);
    truth.c0 = random_about(stated.c0, s->of_inputs, random);
    truth.wear_rate = random_about(stated.wear_rate, 0.2, random);
    truth.critical_energy = random_about(s->critical_energy, 0.2, random);
    const contact_truth layer = contact_solve(&truth, &state, INTERVALS);
    snprintf(surface, sizeof surface,
             "self-affine:q0=%grad/m,qr=%grad/m,q1=%grad/m,hurst=%g,c0="
             "%gm^4+-%g%%",
             stated.q0, stated.qr, stated.q1, stated.hurst, stated.c0, 100 * s->of_inputs);
    snprintf(pressure, sizeof pressure, "%gPa+-%g%%", stated.pressure, 100 * s->of_inputs);
    snprintf(thickness, sizeof thickness, "%.9gm+-%g%%",
             random_about(layer.thickness, s->of_thickness, random), 100 * s->of_thickness);
    snprintf(wear, sizeof wear, "%.9gm^2/N+-%g%%",
             random_about(truth.wear_rate, s->of_wear, random), 100 * s->of_wear);
    const char *const arguments[] = {"identify", "--material",
                                     material,   "--roughness",
                                     surface,    "--pressure",
                                     pressure,   "--velocity",
                                     "0.3m/s",   "--observed-thickness",
                                     thickness,  "--specific-wear-rate",
                                     wear,       "-o",
                                     made,       "--no-provenance",
                                     NULL};
    if (!(layer.thickness > 0))
        scene_draw_broke(t, "there is no layer");
    else if (!rubber_write(&lines, material))
        scene_draw_broke(t, "the material cannot be written");
    else if (scene_draw_run(t, arguments))
        read_found(&truth, made, t);
}

family identify_family(void)
{
    return (family){
        .n = n_identify_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
