/* Observes whole studies through run and collect.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "collection_observe.h"
#include "collection_sample.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Smallest relative difference that counts; the default of collect. */
static const double margin = 0.2;

/* Subject of a row of a study. */
typedef struct study_place {
    int compound, severity;
} study_place;

static const facts *scene_facts(int scene)
{
    return &collection_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return study_prepare();
}

static bool find_case(const stream *found, const char *table, int row, study_place *at)
{
    for (int c = 0; c < COMPOUNDS; c++)
        for (int k = 0; k < SEVERITIES; k++)
            if (stream_is(found, table, PLACE_SAMPLE, row, study_compound[c]) &&
                stream_is(found, table, PLACE_CONDITION, row, study_severity[k])) {
                *at = (study_place){c, k};
                return true;
            }
    return false;
}

/* "Yes" is right if the ratio is not 1, "no" if it is within the margin. */
static void read_verdict(scene_draw *t, quantity q, double ratio, const stream *found,
                         const char *table, const char *column, int row)
{
    const bool yes = stream_is(found, table, column, row, PLACE_YES) != 0,
               no = stream_is(found, table, column, row, PLACE_NO) != 0;
    const bool right = yes  ? fabs(log(ratio)) > 0
                       : no ? fabs(log(ratio)) < log1p(margin)
                            : stream_is(found, table, column, row, PLACE_INCONCLUSIVE) != 0;
    const double said = yes || no || !right ? 0 : (double)NAN;
    scene_draw_add(t, q, right ? 0 : 1, (estimate){0, said, said});
    if (!right)
        t->draw->verdict = NO;
}

/* ---- output of collect ----------------------------------------------------------------------- */

static int read_cases(const collection_scene *s, const study_truth *truth, const stream *found,
                      scene_draw *t)
{
    const char *table = place_collected_ratio.table;
    const int n = stream_rows(found, table);
    enum { REFERENCE = 2 };
    for (int row = 0; row < n; row++) {
        study_place at;
        if (!find_case(found, table, row, &at))
            return -1;
        const contact_truth *bare = &truth->contact[at.compound][at.severity];
        const double ratio = s->cases[at.compound][at.severity].ratio;
        scene_draw_add(t, Q_RATIO, ratio, place_row(found, &place_collected_ratio, row));
        scene_draw_add(t, Q_THICKNESS, bare->thickness,
                       place_row(found, &place_collected_thickness, row));
        scene_draw_add(
            t, Q_CHANGE,
            truth->with_layer[at.compound][at.severity][REFERENCE] / bare->friction[REFERENCE] - 1,
            place_row(found, &place_collected_change, row));
        read_verdict(t, Q_SAID_DIFFERS, ratio, found, table, PLACE_DIFFERS, row);
    }
    return n == COMPOUNDS * SEVERITIES ? 0 : -1;
}

static int nearest(double value, const double *of, int n)
{
    int best = 0;
    for (int i = 1; i < n; i++)
        if (fabs(log(value / of[i])) < fabs(log(value / of[best])))
            best = i;
    return best;
}

static int read_moduli(const collection_scene *s, const study_prepared *p, const stream *found,
                       scene_draw *t)
{
    static const double rate[STUDY_RATES] = {1e-7, 1e-6, 1e-5};
    const char *table = place_collected_modulus.table;
    const int n = stream_rows(found, table);
    for (int row = 0; row < n; row++) {
        study_place at;
        if (!find_case(found, table, row, &at))
            return -1;
        const bool bulk = stream_is(found, table, PLACE_ZONE, row, "bulk") != 0;
        const int k = nearest(stream_cell(found, table, PLACE_RATE, row), rate, STUDY_RATES);
        scene_draw_add(t, Q_GROUP_MODULUS,
                       p->compound[at.compound].modulus[k] *
                           (bulk ? 1 : s->cases[at.compound][at.severity].ratio),
                       place_row(found, &place_collected_modulus, row));
    }
    return n == COMPOUNDS * SEVERITIES * 2 * STUDY_RATES ? 0 : -1;
}

static int read_friction(const study_truth *truth, const stream *found, scene_draw *t)
{
    const char *table = place_collected_friction.table;
    const int n = stream_rows(found, table);
    for (int row = 0; row < n; row++) {
        study_place at;
        if (!find_case(found, table, row, &at))
            return -1;
        const int v = nearest(stream_cell(found, table, PLACE_VELOCITY, row), study_velocity,
                              STUDY_VELOCITIES);
        scene_draw_add(t, Q_FRICTION, truth->contact[at.compound][at.severity].friction[v],
                       place_row(found, &place_collected_friction, row));
    }
    return n == COMPOUNDS * SEVERITIES * STUDY_VELOCITIES ? 0 : -1;
}

static int place_of(const char *const *names, int n, const stream *found, const char *table,
                    const char *column, int row)
{
    for (int i = 0; i < n; i++)
        if (stream_is(found, table, column, row, names[i]))
            return i;
    return -1;
}

/* Two severities of a compound, or two compounds of a severity. */
static int read_translations(const collection_scene *s, const stream *found, scene_draw *t)
{
    const int n = stream_rows(found, place_pair.table);
    for (int row = 0; row < n; row++) {
        const int c = place_of(study_compound, COMPOUNDS, found, place_pair.table, PLACE_PAIR_OF,
                               row),
                  k = place_of(study_severity, SEVERITIES, found, place_pair.table, PLACE_PAIR_OF,
                               row);
        const char *const *names = c >= 0 ? study_severity : study_compound;
        const int first = place_of(names, 2, found, place_pair.table, PLACE_PAIR_FIRST, row),
                  second = place_of(names, 2, found, place_pair.table, PLACE_PAIR_SECOND, row);
        if ((c < 0 && k < 0) || first < 0 || second < 0)
            return -1;
        const double ratio = c >= 0 ? s->cases[c][first].ratio / s->cases[c][second].ratio
                                    : s->cases[first][k].ratio / s->cases[second][k].ratio;
        scene_draw_add(t, Q_RATIO_PAIR, ratio, place_row(found, &place_pair, row));
        read_verdict(t, Q_SAID_PAIR, ratio, found, place_pair.table, PLACE_PAIR_DIFFER, row);
    }
    return n == 2 * COMPOUNDS ? 0 : -1;
}

static void read_collected(const collection_scene *s, const study_prepared *p,
                           const study_truth *truth, const char *path, scene_draw *t)
{
    stream *found = stream_read(path);
    if (found == NULL || read_cases(s, truth, found, t) != 0)
        scene_draw_broke(t, "other cases than were collected");
    else if (read_moduli(s, p, found, t) != 0)
        scene_draw_broke(t, "other moduli than were collected");
    else if (read_friction(truth, found, t) != 0)
        scene_draw_broke(t, "other frictions than were collected");
    else if (read_translations(s, found, t) != 0)
        scene_draw_broke(t, "other pairs of cases than there are");
    stream_free(found);
}

/* ---- results of a case ----------------------------------------------------------------------- */

/* Table of a result; free it. NULL if there is none. */
static stream *read_result_table(const char *result, const char *name, const char *path,
                                 scene_draw *t)
{
    const char *const arguments[] = {"table", result, name, "--format", "stream", "-o", path, NULL};
    return scene_draw_run(t, arguments) ? stream_read(path) : NULL;
}

/* "Does not" and "contradicts" are wrong, because the layer of the record follows the theory. */
static void read_certain(scene_draw *t, quantity q, bool wrong, bool is_certain)
{
    const double stated = is_certain ? 0 : (double)NAN;
    scene_draw_add(t, q, wrong ? 1 : 0, (estimate){0, stated, stated});
    if (wrong)
        t->draw->verdict = NO;
}

/* The record follows the theory, so that it always explains it. */
static bool read_validation(const study_truth *truth, const char *result, const char *path,
                            scene_draw *t)
{
    stream *found = read_result_table(result, PLACE_VALIDATION, path, t);
    const verdict said =
        found != NULL ? place_friction_verdict(found, PLACE_VALIDATION) : NO_VERDICT;
    if (said != NO_VERDICT) {
        read_certain(t, Q_SAID_RECORD, said == NO, said != INCONCLUSIVE);
        scene_draw_add(t, Q_FRICTION_RATIO, 1, place_key(found, &place_friction_ratio));
        scene_draw_add(t, Q_NEEDED_SHEAR, truth->shear_stress,
                       place_key(found, &place_needed_shear));
    }
    stream_free(found);
    return said != NO_VERDICT;
}

/* Without a layer (`soft` is not set) there is no change and no time. */
static bool read_running_in(const study_truth *truth, int c, int k, const char *result,
                            const char *path, scene_draw *t)
{
    stream *found = read_result_table(result, PLACE_VALIDATION_RUNNING_IN, path, t);
    if (found != NULL)
        scene_draw_add(t, Q_SETTLED, truth->growth[c][k].settled,
                       place_row(found, &place_settled_predicted, 0));
    stream_free(found);
    return found != NULL;
}

static bool read_record(const collection_scene *s, const study_truth *truth, int c, int k,
                        const char *result, const char *path, scene_draw *t)
{
    stream *found = read_result_table(result, place_steady.table, path, t);
    const bool whole = found != NULL && stream_rows(found, place_steady.table) == STUDY_VELOCITIES;
    for (int v = 0; whole && v < STUDY_VELOCITIES; v++)
        scene_draw_add(t, Q_STEADY, truth->with_layer[c][k][study_step(s, v)],
                       place_row(found, &place_steady, v));
    stream_free(found);
    found = whole ? read_result_table(result, place_wear_rate.table, path, t) : NULL;
    const bool worn = found != NULL && stream_rows(found, place_wear_rate.table) > 0;
    if (worn)
        scene_draw_add(t, Q_WEAR_RATE, truth->wear_rate[k], place_row(found, &place_wear_rate, 0));
    stream_free(found);
    return worn;
}

/* True if friction uses the wavenumbers for which the truth is known. */
static bool is_surface(const char *result, const char *path, scene_draw *t)
{
    const double near = 1e-3;
    stream *found = read_result_table(result, PLACE_ROUGHNESS, path, t);
    const int n = found != NULL ? stream_rows(found, PLACE_ROUGHNESS) : 0;
    const bool is =
        n > 1 &&
        fabs(stream_cell(found, PLACE_ROUGHNESS, PLACE_WAVENUMBER, 0) / study_q0 - 1) < near &&
        fabs(stream_cell(found, PLACE_ROUGHNESS, PLACE_WAVENUMBER, n - 1) / study_q1 - 1) < near;
    stream_free(found);
    return is;
}

static bool read_case(const collection_scene *s, const study_truth *truth, int c, int k,
                      const char *result, scene_draw *t)
{
    const char *path = scene_draw_file(t, "table.tsv");
    if (!is_surface(result, path, t))
        scene_draw_broke(t, "a surface of other wavenumbers");
    else if (!read_record(s, truth, c, k, result, path, t))
        scene_draw_broke(t, "another number of steps, or no wear");
    else if (!read_validation(truth, result, path, t))
        scene_draw_broke(t, "no verdict on the record");
    else if (s->running_in && s->cases[c][k].ratio < 1 &&
             !read_running_in(truth, c, k, result, path, t))
        scene_draw_broke(t, "no running-in");
    return t->draw->outcome == OUTCOME_GOOD;
}

static bool run_case(const collection_scene *s, const study_prepared *p, const study_truth *truth,
                     const study_files *files, int c, int k, random_source *random,
                     const char *result, scene_draw *t)
{
    char name[24];
    snprintf(name, sizeof name, "%s-%s.xml", study_compound[c], study_severity[k]);
    const char *path = scene_draw_file(t, name);
    /* a running-in uses the replicates of the error estimate, so that a run is short */
    const char *const arguments[] = {
        "run",         path,        "-o", result,
        "--no-report", "--threads", "1",  s->running_in ? "--replicates" : NULL,
        "60",          NULL};
    if (study_write_case(s, p, truth, files, c, k, random, t, path) != 0) {
        scene_draw_broke(t, "the files of a case cannot be written");
        return false;
    }
    return scene_draw_run(t, arguments) && read_case(s, truth, c, k, result, t);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const collection_scene *s = &collection_scenes[scene];
    const study_prepared *p = prepared;
    const char *collected = scene_draw_file(t, "collected.tsv"), *results[COMPOUNDS * SEVERITIES];
    const study_files files = {
        {scene_draw_file(t, "wide1.gsf"), scene_draw_file(t, "wide2.gsf"),
         scene_draw_file(t, "near1.gsf"), scene_draw_file(t, "near2.gsf")},
        {scene_draw_file(t, "dma-HC.csv"), scene_draw_file(t, "dma-HS.csv")}};
    const study_truth truth = study_draw(s, p, random);
    t->draw->verdict = YES;
    if (study_write_common(p, random, &files) != 0) {
        scene_draw_broke(t, "the files of a study cannot be written");
        return;
    }
    for (int i = 0; i < COMPOUNDS * SEVERITIES; i++) {
        char name[24];
        const int c = i / SEVERITIES, k = i % SEVERITIES;
        snprintf(name, sizeof name, "%s-%s.h5", study_compound[c], study_severity[k]);
        results[i] = scene_draw_file(t, name);
        if (!run_case(s, p, &truth, &files, c, k, random, results[i], t))
            return;
    }
    const char *const arguments[] = {"collect",  results[0],        results[1],
                                     results[2], results[3],        "-o",
                                     collected,  "--no-provenance", NULL};
    if (scene_draw_run(t, arguments))
        read_collected(s, p, &truth, collected, t);
}

family collection_family(void)
{
    return (family){
        .n = n_collection_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
