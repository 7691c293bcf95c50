/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dwell_observe.h"
#include "dwell_sample.h"

#include <math.h>
#include <stdio.h>
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

/* With a drive [rad/s] not 0: only the row of the drive, whose frequency is found to less than
 * `same`. */
static void read_moduli(const char *path, const place of[2], const relaxation *r, double drive,
                        trial *t)
{
    stream *found = stream_read(path);
    const int n = found != NULL ? stream_rows(found, of[0].table) : 0;
    if (n < 1)
        trial_broke(t, "no moduli of a dwell");
    for (int i = 0; i < n; i++) {
        double tan_delta;
        const double omega = stream_cell(found, of[0].table, PLACE_FREQUENCY, i);
        if (drive > 0 && !(fabs(omega - drive) < same * drive))
            continue;
        const double modulus = relaxation_modulus(r, omega, &tan_delta),
                     storage = modulus / hypot(1, tan_delta);
        trial_add(t, Q_DWELL_STORAGE, storage, place_row(found, &of[0], i));
        trial_add(t, Q_DWELL_LOSS, storage * tan_delta, place_row(found, &of[1], i));
    }
    stream_free(found);
}

/* Prony series of the rubber, against which the means are tested. */
static int write_series(const relaxation *r, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fprintf(file,
            "## table: " PLACE_PRONY "\n## deformation: tension\n"
            "## equilibrium_modulus: %.17g standard_error=nan numerical_error=0 unit=Pa\n"
            "## reference_temperature: 296.15 standard_error=0 numerical_error=0 unit=K\n"
            "# " PLACE_PRONY_TIME "[s]\t" PLACE_PRONY_MODULUS "[Pa]\n",
            r->rest);
    for (size_t i = 0; i < r->n; i++)
        fprintf(file, "%.17g\t%.17g\n", r->tau[i], r->e[i]);
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* A sample of the rubber, softer or stiffer than the mean. */
static relaxation sample_of(const relaxation *r, double factor)
{
    relaxation one = *r;
    one.rest *= factor;
    for (size_t i = 0; i < one.n; i++)
        one.e[i] *= factor;
    return one;
}

enum { MOST_FILES = 6 };

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    const dwell_scene *s = &dwell_scenes[scene];
    const relaxation r = dwell_relaxation(s, random);
    const char *made = trial_file(t, "moduli.tsv");
    const char *arguments[MOST_FILES + 8] = {
        "dwell",
        "--tip",
        s->pyramid ? "pyramid:half-angle=35deg,radius=20nm" : "paraboloid:radius=5um",
        "-o",
        made,
        "--no-provenance"};
    int bad = 0, n = 6;
    (void)prepared;
    for (int i = 0; i < (s->files > 0 ? s->files : 1) && !bad; i++) {
        char name[24];
        const double factor = s->scatter > 0 ? exp(s->scatter * random_normal(random)) : 1;
        const relaxation one = sample_of(&r, factor);
        snprintf(name, sizeof name, "dwell%d.tsv", i + 1);
        arguments[n] = trial_file(t, name);
        bad = dwell_sample_write(s, &one, random, arguments[n++]) != 0;
    }
    if (bad)
        trial_broke(t, "the curve cannot be written");
    else if (trial_run(t, arguments) && s->files == 0)
        read_moduli(made, place_dwell, &r, 2 * M_PI * s->modulation, t);
    if (bad || s->files == 0 || t->draw->outcome != OUTCOME_GOOD)
        return;
    const char *series = trial_file(t, "series.tsv"), *means = trial_file(t, "means.tsv");
    const char *const compare[] = {"compare", "--master",        series, made, "-o",
                                   means,     "--no-provenance", NULL};
    if (write_series(&r, series) != 0)
        trial_broke(t, "the series cannot be written");
    else if (trial_run(t, compare))
        read_moduli(means, place_dwell_mean, &r, 2 * M_PI * s->modulation, t);
}

family dwell_family(void)
{
    return (family){
        .n = n_dwell_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
