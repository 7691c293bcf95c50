/* One draw of a scene through the command, each stated interval beside the truth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TRIAL_H
#define STUDY_TRIAL_H

#include "facts.h"
#include "places.h"
#include "random.h"

typedef struct observation {
    quantity quantity;
    double truth;
    estimate found;
} observation;

/* What came of the command: well, an error that it explained, or something it should never do. */
typedef enum outcome { OUTCOME_GOOD, OUTCOME_REFUSED, OUTCOME_BROKEN, OUTCOME_COUNT } outcome;

#define OBSERVATIONS_MAX 200
typedef struct draw {
    int n;
    observation observations[OBSERVATIONS_MAX];
    verdict verdict;
    outcome outcome;
    double seconds;  /* of the command */
    char words[200]; /* the first line of the first error */
} draw;

typedef struct stage {
    const char *program; /* weartrack */
    const char *folder;  /* to work in */
    uint64_t seed;
    bool keep; /* the files stay */
} stage;

#define TRIAL_FILES_MAX 80 /* of a whole study */
typedef struct trial {
    const stage *stage;
    const char *scene;
    int number;
    char files[TRIAL_FILES_MAX][512];
    int n_files;
    draw *draw;
} trial;

/* Scenes of one kind: what is drawn and how it is observed. */
typedef struct family {
    int n;
    const facts *(*facts)(int scene);
    void *(*prepare)(int scene); /* what all draws of a scene need; to be freed */
    void (*observe)(int scene, const void *prepared, random_source *random, trial *t);
} family;

void model_variant_fit(const family *f, int scene, const void *prepared, const stage *st,
                       int number, draw *to);

/* The path of a file of this trial, which goes with it. */
const char *trial_file(trial *t, const char *name);
/* Arguments after the program, the last one NULL. True if the command was well. */
bool trial_run(trial *t, const char *const *arguments);
void trial_add(trial *t, quantity q, double truth, estimate found);
/* What was written is not what was asked for. */
void trial_broke(trial *t, const char *words);

#endif
