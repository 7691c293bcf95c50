/* Observes the running-in that weartrack validate predicts for a case with a layer, and finds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_observe.h"
#include "growth_sample.h"

static const facts *scene_facts(int scene)
{
    return &growth_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void read_found(const growth_scene *s, const growth_made *m, const char *path, scene_draw *t)
{
    const double time = s->off_time > 0 ? s->off_time : 1;
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, PLACE_VALIDATION_RUNNING_IN) != 1)
        scene_draw_broke(t, "another number of records");
    else {
        scene_draw_add(t, Q_SETTLED, m->growth.settled,
                       place_row(found, &place_settled_predicted, 0));
        scene_draw_add(t, Q_MEASURED_TIME, m->growth.settled * time,
                       place_row(found, &place_settled_measured, 0));
        scene_draw_add(t, Q_TIME_RATIO, time, place_row(found, &place_time_ratio, 0));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const growth_scene *s = &growth_scenes[scene];
    const char *the_case = scene_draw_file(t, "case.xml"),
               *record = scene_draw_file(t, "record.csv"),
               *written = scene_draw_file(t, "found.tsv");
    /* number of replicates of the error estimate, so that a run is short */
    const char *arguments[] = {"validate",        the_case,       record, "-o", written,
                               "--no-provenance", "--replicates", "60",   NULL};
    growth_made m;
    (void)prepared;
    if (!growth_make(s, random, &m) || !growth_write_case(s, &m, the_case) ||
        !growth_write_record(s, &m, record, random))
        scene_draw_broke(t, "there is no layer, or a file cannot be written");
    else if (scene_draw_run(t, arguments))
        read_found(s, &m, written, t);
}

family growth_family(void)
{
    return (family){
        .n = n_growth_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
