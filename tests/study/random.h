/* Pseudo-random numbers of the study. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_RANDOM_H
#define STUDY_RANDOM_H

#include <stdint.h>

/* xoshiro256** of Blackman and Vigna. */
typedef struct random_source {
    uint64_t state[4];
} random_source;

/* Reproducible stream for each name and number. */
random_source random_for(uint64_t seed, const char *name, uint64_t number);
double random_uniform(random_source *source); /* uniform in ]0, 1[ */
double random_normal(random_source *source);
/* Factor of a value with a relative error. */
double random_about(double value, double error, random_source *source);

#endif
