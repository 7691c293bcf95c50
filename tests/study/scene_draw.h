/* One draw of a scene through the command; each stated interval is compared with the truth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SCENE_DRAW_H
#define STUDY_SCENE_DRAW_H

#include "facts.h"
#include "places.h"
#include "random.h"

typedef struct observation {
    quantity quantity;
    double truth;
    estimate found;
} observation;

/* Outcome of the command: success, an explained error, or a failure that must never occur. */
typedef enum outcome { OUTCOME_GOOD, OUTCOME_REFUSED, OUTCOME_BROKEN, OUTCOME_COUNT } outcome;

#define OBSERVATIONS_MAX 200
typedef struct draw {
    int n;
    observation observations[OBSERVATIONS_MAX];
    verdict verdict;
    outcome outcome;
    double seconds;  /* duration of the command */
    char words[200]; /* first line of the first error */
} draw;

typedef struct stage {
    const char *program; /* weartrack */
    const char *folder;  /* work folder */
    uint64_t seed;
    bool keep; /* keeps the files */
} stage;

#define SCENE_DRAW_FILES_MAX 80 /* enough for a whole study */
typedef struct scene_draw {
    const stage *stage;
    const char *scene;
    int number;
    char files[SCENE_DRAW_FILES_MAX][512];
    int n_files;
    bool reads_part; /* an answer in part (exit status 3) is read like a whole one */
    draw *draw;
} scene_draw;

/* Scenes of one kind, with functions that draw and observe them. */
typedef struct family {
    int n;
    const facts *(*facts)(int scene);
    void *(*prepare)(int scene); /* allocated data that all draws of a scene share */
    void (*observe)(int scene, const void *prepared, random_source *random, scene_draw *t);
} family;

void model_variant_fit(const family *f, int scene, const void *prepared, const stage *st,
                       int number, draw *to);

/* Path of a file of this draw, which is removed with it. */
const char *scene_draw_file(scene_draw *t, const char *name);
/* Arguments after the program; the last one is NULL. Returns true on success. */
bool scene_draw_run(scene_draw *t, const char *const *arguments);
void scene_draw_add(scene_draw *t, quantity q, double truth, estimate found);
/* Reports output other than requested. */
void scene_draw_broke(scene_draw *t, const char *words);

#endif
