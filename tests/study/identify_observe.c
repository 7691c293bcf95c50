/* Observes a thickness and a wear rate through weartrack identify.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "identify_observe.h"
#include "collection_sample.h"
#include "contact.h"
#include "dma_sample.h"
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

static void read_found(const contact *truth, const char *path, trial *t)
{
    enum { BY_WEAR = 1 }; /* the first row uses the thickness alone */
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_energy.table) != 2) {
        trial_broke(t, "another number of rows");
    } else {
        trial_add(t, Q_CRITICAL_ENERGY, truth->critical_energy,
                  place_row(found, &place_energy, BY_WEAR));
        trial_add(t, Q_WEAR_RATE, truth->wear_rate, place_row(found, &place_energy_wear, BY_WEAR));
    }
    stream_free(found);
}

/* ---- several cases --------------------------------------------------------------------------- */

/* Isotherms as in whole studies, because a verdict needs the whole error. */
static const double of_temperature = 0.2; /* [K] */

static bool write_isotherms(const rubber *r, random_source *random, const char *path)
{
    sample *measured = calloc(1, sizeof *measured);
    if (measured == NULL)
        return false;
    sample_draw(&study_isotherms, r, random, measured);
    const bool written = sample_write(&study_isotherms, measured, path) == 0;
    free(measured);
    return written;
}

/* Measured values of a layer, with the stated errors. */
static bool write_case(const identify_scene *s, const char *sweep, const contact *truth,
                       double thickness, int number, random_source *random, const char *path)
{
    const char *slash = strrchr(sweep, '/');
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return false;
    fprintf(
        out,
        "<case version=\"1\"><sample>HC</sample><condition>%d</condition>\n<dma><poisson-ratio>%g"
        "</poisson-ratio><reference-temperature>%gdegC</reference-temperature><files>%s</files>"
        "</dma>\n",
        number, stated.poisson, study_isotherms.reference, slash != NULL ? slash + 1 : sweep);
    fprintf(out,
            "<roughness><self-affine><q0>%grad/m</q0><qr>%grad/m</qr><q1>%grad/m</q1>"
            "<hurst>%g</hurst><c0>%gm^4 +- %g%%</c0></self-affine></roughness>\n<sliding><pressure>"
            "%gPa +- %g%%</pressure><temperature>%gdegC +- %gK</temperature><velocity>%gm/s"
            "</velocity></sliding>\n",
            stated.q0, stated.qr, stated.q1, stated.hurst, stated.c0, 100 * s->of_inputs,
            stated.pressure, 100 * s->of_inputs, stated.temperature, of_temperature,
            stated.velocity[0]);
    fprintf(out,
            "<identify><observed-thickness>%.9gm +- %g%%</observed-thickness><specific-wear-rate>"
            "%.9gm^2/N +- %g%%</specific-wear-rate></identify></case>\n",
            random_about(thickness, s->of_thickness, random), 100 * s->of_thickness,
            random_about(truth->wear_rate, s->of_wear, random), 100 * s->of_wear);
    const bool bad = ferror(out) != 0;
    return fclose(out) == 0 && !bad;
}

/* "Differs" is wrong for equal values, and "one" for different ones. */
static void read_verdict(trial *t, bool is_one, const stream *found, const char *column)
{
    const char *table = place_common_energy.table;
    const bool one = stream_is(found, table, column, 0, PLACE_ONE) != 0,
               differs = stream_is(found, table, column, 0, PLACE_SHARED_DIFFERS) != 0,
               wrong = is_one ? differs : one;
    const double said = one || differs ? 0 : (double)NAN;
    trial_add(t, Q_SAID_SHARED, wrong ? 1 : 0, (estimate){0, said, said});
}

static void read_collected(const identify_scene *s, const contact *truth, const char *path,
                           trial *t)
{
    const bool one_energy = !(s->energy_factor > 0), one_wear = !(s->wear_factor > 0);
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_common_energy.table) != 1) {
        trial_broke(t, "another number of pairs");
    } else {
        read_verdict(t, one_energy, found, PLACE_ONE_ENERGY);
        read_verdict(t, one_wear, found, PLACE_ONE_WEAR);
        read_verdict(t, one_energy && one_wear, found, PLACE_ONE_PAIR);
        if (one_energy && one_wear) {
            trial_add(t, Q_CRITICAL_ENERGY, truth->critical_energy,
                      place_row(found, &place_common_energy, 0));
            trial_add(t, Q_WEAR_RATE, truth->wear_rate, place_row(found, &place_common_wear, 0));
        }
    }
    stream_free(found);
}

/* All share the surface; each pressure is set separately. */
static void collect_cases(const identify_scene *s, const contact *common, random_source *random,
                          trial *t)
{
    const rubber broad = rubber_make(RUBBER_BROAD);
    const char *sweep = trial_file(t, "dma.csv");
    const char *arguments[IDENTIFY_CASES + 5] = {"collect"}, *made = trial_file(t, "pairs.tsv");
    if (!write_isotherms(&broad, random, sweep)) {
        trial_broke(t, "the isotherms cannot be written");
        return;
    }
    for (int i = 0; i < s->cases; i++) {
        char name[24];
        snprintf(name, sizeof name, "case%d.xml", i);
        const char *path = trial_file(t, name);
        snprintf(name, sizeof name, "case%d.h5", i);
        const char *result = trial_file(t, name);
        contact truth = *common;
        truth.pressure = random_about(stated.pressure, s->of_inputs, random);
        if (i % 2 > 0) {
            truth.critical_energy *= s->energy_factor > 0 ? s->energy_factor : 1;
            truth.wear_rate *= s->wear_factor > 0 ? s->wear_factor : 1;
        }
        const rubber_state state = dma_state(
            &study_isotherms, &broad, stated.temperature + of_temperature * random_normal(random));
        const double thickness = contact_solve(&truth, &state, INTERVALS).thickness;
        const char *const run[] = {"run",         path,        "-o", result,
                                   "--no-report", "--threads", "1",  NULL};
        if (!(thickness > 0) || !write_case(s, sweep, &truth, thickness, i, random, path)) {
            trial_broke(t, "there is no layer, or no file of it");
            return;
        }
        if (!trial_run(t, run))
            return;
        arguments[1 + i] = result;
    }
    arguments[1 + s->cases] = "-o";
    arguments[2 + s->cases] = made;
    arguments[3 + s->cases] = "--no-provenance";
    if (trial_run(t, arguments))
        read_collected(s, common, made, t);
}

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    const identify_scene *s = &identify_scenes[scene];
    const char *material = trial_file(t, "material.tsv"), *made = trial_file(t, "found.tsv");
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    char surface[160], pressure[64], thickness[64], wear[64];
    contact truth = stated;
    (void)prepared;
    truth.pressure = random_about(stated.pressure, s->of_inputs, random);
    truth.c0 = random_about(stated.c0, s->of_inputs, random);
    truth.wear_rate = random_about(stated.wear_rate, 0.2, random);
    truth.critical_energy = random_about(s->critical_energy, 0.2, random);
    if (s->cases > 0) {
        collect_cases(s, &truth, random, t);
        return;
    }
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
        trial_broke(t, "there is no layer");
    else if (!rubber_write(&lines, material))
        trial_broke(t, "the material cannot be written");
    else if (trial_run(t, arguments))
        read_found(&truth, made, t);
}

family identify_family(void)
{
    return (family){
        .n = n_identify_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
