/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dwell_observe.h"
#include "dwell_sample.h"

#include <math.h>
#include <stdlib.h>

static const double same = 0.002;

static const facts *scene_facts(int scene)
{
    return &dwell_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

/* With a drive [rad/s], not 0: of its row alone, whose frequency is found to less than `same`. */
static void read_moduli(const char *path, const relaxation *r, double drive, trial *t)
{
    stream *found = stream_read(path);
    const int n = found != NULL ? stream_rows(found, place_dwell_storage.table) : 0;
    if (n < 1)
        trial_broke(t, "no moduli of a dwell");
    for (int i = 0; i < n; i++) {
        double tan_delta;
        const double omega = stream_cell(found, place_dwell_storage.table, PLACE_FREQUENCY, i);
        if (drive > 0 && !(fabs(omega - drive) < same * drive))
            continue;
        const double modulus = relaxation_modulus(r, omega, &tan_delta),
                     storage = modulus / hypot(1, tan_delta);
        trial_add(t, Q_DWELL_STORAGE, storage, place_row(found, &place_dwell_storage, i));
        trial_add(t, Q_DWELL_LOSS, storage * tan_delta, place_row(found, &place_dwell_loss, i));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    const dwell_scene *s = &dwell_scenes[scene];
    const relaxation r = dwell_relaxation(s, random);
    const char *curve = trial_file(t, "dwell.tsv"), *made = trial_file(t, "moduli.tsv");
    const char *const arguments[] = {"dwell",
                                     "--tip",
                                     s->pyramid ? "pyramid:half-angle=35deg,radius=20nm"
                                                : "paraboloid:radius=5um",
                                     curve,
                                     "-o",
                                     made,
                                     "--no-provenance",
                                     NULL};
    (void)prepared;
    if (dwell_sample_write(s, &r, random, curve) != 0)
        trial_broke(t, "the curve cannot be written");
    else if (trial_run(t, arguments))
        read_moduli(made, &r, 2 * M_PI * s->modulation, t);
}

family dwell_family(void)
{
    return (family){
        .n = n_dwell_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
