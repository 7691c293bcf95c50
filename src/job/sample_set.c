/* Hash table of samples that were read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/sample_set.h"
#include "core/base/memory.h"

static sample_slot *find_slot(const sample_set *set, uint64_t hash)
{
    size_t i = (size_t)hash & (set->size - 1);
    while (set->slot[i].owner != NULL && set->slot[i].hash != hash)
        i = (i + 1) & (set->size - 1);
    return &set->slot[i];
}

static void grow(sample_set *set)
{
    const sample_set old = *set;
    set->size = old.size > 0 ? 2 * old.size : 16;
    set->slot = wt_alloc(set->size, sizeof *set->slot);
    for (size_t i = 0; i < old.size; i++)
        if (old.slot[i].owner != NULL)
            *find_slot(set, old.slot[i].hash) = old.slot[i];
    free(old.slot);
}

const void *sample_set_add(sample_set *set, uint64_t hash, const void *owner)
{
    if (2 * set->n >= set->size)
        grow(set);
    sample_slot *const slot = find_slot(set, hash);
    if (slot->owner == NULL) {
        *slot = (sample_slot){hash, owner};
        set->n++;
    }
    return slot->owner;
}

void sample_set_clear(sample_set *set)
{
    free(set->slot);
    *set = (sample_set){0};
}
