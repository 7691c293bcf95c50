/* Samples that were read, by their hash, and which file they came from first. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_SAMPLE_SET_H
#define WT_JOB_SAMPLE_SET_H

#include <stddef.h>
#include <stdint.h>

typedef struct sample_slot {
    uint64_t hash;
    const void *owner; /* NULL: the slot is free */
} sample_slot;

/* Hash table with open addressing: a map has a million curves, of which each is looked up once. */
typedef struct sample_set {
    sample_slot *slot; /* [size] */
    size_t size, n;    /* size is 0 or a power of two */
} sample_set;

/* Adds samples of `owner`, unless there are some of the same hash. Returns the first owner. */
const void *sample_set_add(sample_set *set, uint64_t hash, const void *owner);
void sample_set_clear(sample_set *set);

#endif
