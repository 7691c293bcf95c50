/* Observes a case with a layer and the running-in of records through weartrack validate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_observe.h"
#include "growth_sample.h"

enum { MOST_RECORDS = 3 };

static const facts *scene_facts(int scene)
{
    return &growth_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void read_found(const growth_scene *s, const growth_made *m, int records, const char *path,
                       trial *t)
{
    const double time = growth_or_one(s->off_time),
                 change = s->flat ? 0 : growth_or_one(s->off_change);
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, PLACE_VALIDATION_RUNNING_IN) != records) {
        trial_broke(t, "another number of records");
    } else {
        t->draw->verdict = place_friction_verdict(found, PLACE_VALIDATION_RUNNING_IN);
        if (!s->unsaid)
            trial_add(t, Q_CHANGE_RATIO, change, place_key(found, &place_change_ratio));
        if (!s->unsaid && !s->flat) {
            trial_add(t, Q_TIME_RATIO, time, place_key(found, &place_time_ratio));
            trial_add(t, Q_NEEDED_WEAR, m->truth.wear_rate / time,
                      place_key(found, &place_needed_wear));
            trial_add(t, Q_NEEDED_ENERGY, m->truth.critical_energy * time,
                      place_key(found, &place_needed_energy));
            trial_add(t, Q_SETTLED, m->growth.settled * time,
                      place_row(found, &place_settled_measured, 0));
        }
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    static const char *const names[MOST_RECORDS] = {"record.csv", "again.csv", "third.csv"};
    const growth_scene *s = &growth_scenes[scene];
    const int records = s->records > 0 ? s->records : 1;
    const char *the_case = trial_file(t, "case.xml"), *written = trial_file(t, "found.tsv");
    const char *arguments[9 + MOST_RECORDS] = {"validate", the_case};
    int n = 2;
    growth_made m;
    bool good = growth_make(s, random, &m) && growth_write_case(s, &m, the_case);
    (void)prepared;
    for (int i = 0; good && i < records; i++) {
        arguments[n] = trial_file(t, names[i]);
        good = growth_write_record(s, &m, arguments[n++], random);
    }
    arguments[n++] = "-o";
    arguments[n++] = written;
    arguments[n++] = "--no-provenance";
    /* number of replicates of the error estimate, so that a run is short */
    arguments[n++] = "--replicates";
    arguments[n++] = "60";
    arguments[n] = NULL;
    if (!good)
        trial_broke(t, "there is no layer, or a file cannot be written");
    else if (trial_run(t, arguments))
        read_found(s, &m, records, written, t);
}

family growth_family(void)
{
    return (family){
        .n = n_growth_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
