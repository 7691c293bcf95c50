/* What the draws of a scene come to. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TALLY_H
#define STUDY_TALLY_H

#include "trial.h"

#include <stdio.h>

/* Of one quantity of one scene. */
typedef struct tally {
    int draws;         /* in which it could have been stated */
    int draws_stated;  /* in which it was, at least once */
    double stated;     /* share of the estimates with an interval */
    double coverage;   /* share of those that hold the truth; nan if there are none */
    double error;      /* binomial one of the coverage, a draw counted once */
    double half_width; /* median; in parts of the estimate where errors are relative */
    double rms;        /* true error of the estimates, in the same unit */
    double rms_stated; /* error over the stated one (half width over 1.96): 1 if that is right */
} tally;

tally tally_make(const draw *draws, int n, quantity q);
/* Probability of at most k in n where each comes with probability p. */
double tally_at_most(int k, int n, double p);

typedef struct verdict_tally {
    int draws, said[VERDICT_COUNT], outcomes[OUTCOME_COUNT];
    int right, wrong_yes;
    double seconds; /* mean of a draw */
} verdict_tally;

verdict_tally tally_verdicts(const facts *s, const draw *draws, int n);

/* Intervals and verdicts of all promised scenes together, so that few draws of each are enough. */
typedef struct pool {
    int draws[Q_COUNT], covered[Q_COUNT];
    int verdicts, right;
} pool;
void tally_add(const facts *s, const draw *draws, int n, pool *to);

/* What chance cannot explain, in a promised scene or in all of them together: how many things, and
 * said in words, if there is where. */
int tally_complaints(const facts *s, const draw *draws, int n, FILE *words);
int tally_pool_complaints(const pool *p, FILE *words);

#endif
