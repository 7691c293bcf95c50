/* Tables of indented curves through compare. SPDX-License-Identifier: GPL-3.0-or-later */
#include "track_observe.h"
#include "track_scene.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

static const double curve_scatter = 0.04, bulk_modulus = 8e6, middle_rate = 0.6;
static const char *const zones[2] = {"bulk", "track"};

/* The rows of one spot. */
static void write_spot(FILE *file, const track_scene *s, int zone, int spot, double ln_lever,
                       random_source *random)
{
    const double here = s->spot_scatter[zone] * random_normal(random);
    for (int rate = 0; rate < 2; rate++) {
        const int curves = s->cells_missing ? (int)(4 * random_uniform(random)) : 4;
        for (int curve = 0; curve < curves; curve++) {
            const double v = s->rates[zone][rate];
            const double y = zone * log(s->ratio) + s->rate_slope * log(v / middle_rate) + here +
                             ln_lever + curve_scatter * random_normal(random);
            fprintf(file, "%s-%d.jpk\t%d\t%s-%d\taccepted\taccepted\t%.9g\t%.9g\t%.9g\t%.9g\n",
                    zones[zone], spot, 4 * rate + curve, zones[zone], spot, bulk_modulus * exp(y),
                    1e-6 * v, 1e-6 * v, 60 / (v / 0.1));
        }
    }
}

/* What weartrack indent would have written. */
static int write_zone(const track_scene *s, int zone, double ln_lever, random_source *random,
                      const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fprintf(file, "## table: indentation/%s\n## title: Indentation of every curve, %s\n",
            zones[zone], zones[zone]);
    fprintf(file,
            "## spring_constant: 0.3 standard_error=%.9g numerical_error=0 unit=N/m\n"
            "## spots: named\n",
            0.3 * s->lever_error);
    fputs("# file[text]\tcurve[1]\tspot[text]\tverdict[text]\treason[text]\tmodulus[Pa]\t"
          "piezo_rate[m/s]\tindentation_rate[m/s]\tload_time[s]\n",
          file);
    for (int spot = 1; spot <= s->spots[zone]; spot++)
        write_spot(file, s, zone, spot, ln_lever, random);
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* A difference is claimed where the interval leaves 1 out. */
static verdict claimed(const estimate *ratio)
{
    if (isnan(ratio->low) || isnan(ratio->high))
        return CANNOT_SAY;
    return ratio->low > 1 || ratio->high < 1 ? YES : NO;
}

static void compare_ratio(const char *path, const track_scene *s, trial *t)
{
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_ratio.table) == 0) {
        trial_broke(t, "no comparison in what was written");
    } else {
        const estimate ratio = place_row(found, &place_ratio, 0);
        t->draw->verdict = claimed(&ratio);
        trial_add(t, Q_RATIO, s->ratio, ratio);
    }
    stream_free(found);
}

static const facts *scene_facts(int scene)
{
    return &track_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    const track_scene *s = &track_scenes[scene];
    const char *made = trial_file(t, "comparison.tsv"), *files[2];
    double ln_lever = 0;
    (void)prepared;
    for (int zone = 0; zone < 2; zone++) {
        files[zone] = trial_file(t, zone == 0 ? "bulk.tsv" : "track.tsv");
        if (zone == 0 || s->levers_separate)
            ln_lever = s->lever_error * random_normal(random);
        if (write_zone(s, zone, ln_lever, random, files[zone]) != 0)
            trial_broke(t, "the curves cannot be written");
    }
    const char *const arguments[] = {"compare", files[0],          files[1], "-o",
                                     made,      "--no-provenance", NULL};
    if (t->draw->outcome == OUTCOME_GOOD && trial_run(t, arguments))
        compare_ratio(made, s, t);
}

family track_family(void)
{
    return (family){
        .n = n_track_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
