/* One draw of a scene through the command, each stated interval beside the truth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_OBSERVE_H
#define STUDY_OBSERVE_H

#include "places.h"
#include "scene.h"

#include <stdint.h>

typedef struct observation {
    quantity quantity;
    double truth;
    estimate found;
} observation;

#define OBSERVATIONS_MAX 160
/* What came of the command: well, an error that it explained, or something it should never do. */
typedef enum outcome { OUTCOME_GOOD, OUTCOME_REFUSED, OUTCOME_BROKEN, OUTCOME_COUNT } outcome;

typedef struct draw {
    int n;
    observation observations[OBSERVATIONS_MAX];
    verdict verdict;
    outcome outcome;
    int status; /* the first exit status that was not 0 */
    double seconds;
    char words[200]; /* the first line of the error */
} draw;

typedef struct stage {
    const char *program; /* weartrack */
    const char *folder;  /* to work in */
    uint64_t seed;
    int keep; /* the files stay */
} stage;

/* `truth`: of the scene's contact, if it has one. */
void observe(const stage *st, const scene *s, const rubber *r, const contact_truth *truth,
             int number, draw *to);

#endif
