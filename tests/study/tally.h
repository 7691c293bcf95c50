/* Statistics of the draws of a scene.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TALLY_H
#define STUDY_TALLY_H

#include "scene_draw.h"

#include <stdio.h>

/* Statistics of one quantity of one scene. */
typedef struct tally {
    int draws;         /* draws in which it could be stated */
    int draws_stated;  /* draws in which it was stated at least once */
    double stated;     /* share of the estimates with an interval */
    double coverage;   /* share of those that contain the truth; nan if there are none */
    double error;      /* binomial error of the coverage, one count per draw */
    double half_width; /* median; relative where errors are relative */
    double rms;        /* rms error of the estimates, in the same unit */
    double rms_stated; /* true over stated error (half width over 1.96) */
} tally;

tally tally_make(const draw *draws, int n, quantity q);
/* Probability of at most k of n with probability p each. */
double tally_at_most(int k, int n, double p);

typedef struct verdict_tally {
    int draws, said[VERDICT_COUNT], outcomes[OUTCOME_COUNT];
    int right, wrong_yes;
    double seconds; /* mean over a draw */
} verdict_tally;

verdict_tally tally_verdicts(const facts *s, const draw *draws, int n);

/* Intervals and verdicts of all promised scenes together, so that few draws per scene suffice. */
typedef struct pooled_tally {
    int draws[Q_COUNT], covered[Q_COUNT];
    int verdicts, right;
} pooled_tally;
void tally_add(const facts *s, const draw *draws, int n, pooled_tally *to);

/* Number of deviations that chance cannot explain, in a promised scene or in all together. `words`
 * receives the text, if there is space. */
int tally_complaints(const facts *s, const draw *draws, int n, FILE *words);
int tally_pool_complaints(const pooled_tally *p, FILE *words);

#endif
