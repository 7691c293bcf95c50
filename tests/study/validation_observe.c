/* Observes a case and a record through weartrack validate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "validation_observe.h"
#include "contact.h"
#include "sliding_case.h"
#include "validation_scene.h"

#include <math.h>
#include <stdio.h>

enum { STEPS_MAX = 8, LAPS = 100, SAMPLES = 4, INTERVALS = 60 };
static const double pi = 3.14159265358979323846, slowest = 1e-3, radius = 0.0125;

/* Stated values of the case, and their true values. */
static const contact stated = {.q0 = 2e3,
                               .qr = 4e3,
                               .q1 = 1e6,
                               .hurst = 0.8,
                               .c0 = 2e-19,
                               .pressure = 0.4e6,
                               .shear_stress = 3e6,
                               .poisson = 0.5,
                               .temperature = 20};

typedef struct made_friction {
    int steps;
    double velocity[STEPS_MAX], friction[STEPS_MAX];
    contact truth;
} made_friction;

static double shear_error(const validation_scene *s)
{
    return s->of_shear > 0 ? s->of_shear : s->error;
}

static made_friction make_friction(const validation_scene *s, random_source *random)
{
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    made_friction m = {.steps = s->velocities > 0 ? s->velocities : STEPS_MAX, .truth = stated};
    m.truth.pressure = random_about(stated.pressure, s->error, random);
    m.truth.c0 = random_about(stated.c0, s->error, random);
    m.truth.shear_stress = random_about(stated.shear_stress, shear_error(s), random);
    const double middle = 0.25 * (m.steps - 1); /* decades above the slowest velocity */
    for (int i = 0; i < m.steps; i++) {
        contact one = m.truth;
        m.velocity[i] = slowest * pow(10, 0.5 * i);
        one.velocities = 1;
        one.velocity[0] = m.velocity[i];
        one.wear_rate = one.critical_energy = 1; /* the layer is not requested */
        const contact_truth theory = contact_solve(&one, &state, INTERVALS);
        m.friction[i] = theory.friction[0] * (s->off > 0 ? s->off : 1) *
                        exp(s->trend * (0.5 * i - middle) + s->scatter * random_normal(random));
    }
    return m;
}

static bool write_case(const validation_scene *s, const char *path)
{
    FILE *out = sliding_case_begin(path, &stated, s->error);
    if (out == NULL)
        return false;
    fprintf(out, "<sliding><pressure>%gPa +- %g%%</pressure><velocity>1mm/s,1m/s</velocity>",
            stated.pressure, 100 * s->error);
    if (!s->unsaid)
        fprintf(out, "<shear-stress>%gPa +- %g%%</shear-stress>", stated.shear_stress,
                100 * shear_error(s));
    fprintf(out, "</sliding></case>\n");
    return ferror(out) == 0 && fclose(out) == 0;
}

static bool write_record(const validation_scene *s, const made_friction *m, const char *path,
                         random_source *random)
{
    const double noise = s->noise > 0 ? s->noise : 0.02;
    double time = 0, of_lap = 1;
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return false;
    fprintf(out, "time (s),laps,velocity (mm/s),mu\n");
    for (int i = 0; i < m->steps * LAPS * SAMPLES; i++) {
        const int step = i / (LAPS * SAMPLES);
        if (i % SAMPLES == 0)
            of_lap = 1 + noise * random_normal(random);
        fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", time, i / (double)SAMPLES, 1e3 * m->velocity[step],
                m->friction[step] * of_lap);
        time += 2 * pi * radius / m->velocity[step] / SAMPLES;
    }
    return ferror(out) == 0 && fclose(out) == 0;
}

static const facts *scene_facts(int scene)
{
    return &validation_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void read_found(const validation_scene *s, const made_friction *m, const char *path,
                       scene_draw *t)
{
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, PLACE_VALIDATION) != m->steps) {
        scene_draw_broke(t, "another number of steps");
    } else {
        t->draw->verdict = place_friction_verdict(found, PLACE_VALIDATION);
        if (!s->unsaid)
            scene_draw_add(t, Q_FRICTION_RATIO, s->off > 0 ? s->off : 1,
                           place_key(found, &place_friction_ratio));
        if (!(s->off > 0) && !(fabs(s->trend) > 0))
            scene_draw_add(t, Q_NEEDED_SHEAR, m->truth.shear_stress,
                           place_key(found, &place_needed_shear));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const validation_scene *s = &validation_scenes[scene];
    const char *the_case = scene_draw_file(t, "case.xml"),
               *record = scene_draw_file(t, "record.csv"), *made = scene_draw_file(t, "found.tsv");
    const char *const arguments[] = {"validate", the_case,          record, "-o",
                                     made,       "--no-provenance", NULL};
    (void)prepared;
    const made_friction m = make_friction(s, random);
    if (!write_case(s, the_case) || !write_record(s, &m, record, random))
        scene_draw_broke(t, "case or record cannot be written");
    else if (scene_draw_run(t, arguments))
        read_found(s, &m, made, t);
}

family validation_family(void)
{
    return (family){
        .n = n_validation_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
