/* Case and records of a running-in scene.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_SAMPLE_H
#define STUDY_GROWTH_SAMPLE_H

#include "growth.h"
#include "growth_scene.h"
#include "random.h"

typedef struct growth_made {
    contact truth;
    growth_truth growth;
    double length; /* time of the record [s] */
} growth_made;

/* Returns false without a layer. */
bool growth_make(const growth_scene *s, random_source *random, growth_made *m);
bool growth_write_case(const growth_scene *s, const growth_made *m, const char *path);
bool growth_write_record(const growth_scene *s, const growth_made *m, const char *path,
                         random_source *random);

#endif
