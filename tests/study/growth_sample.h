/* The case and the records of a scene of running-in. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_SAMPLE_H
#define STUDY_GROWTH_SAMPLE_H

#include "growth.h"
#include "growth_scene.h"
#include "random.h"

typedef struct growth_made {
    contact truth;
    growth_truth growth;
    double length; /* of the record [s] */
} growth_made;

/* What a scene has, or 1 for 0. */
double growth_or_one(double x);
/* False if there is no layer. */
bool growth_make(const growth_scene *s, random_source *random, growth_made *m);
bool growth_write_case(const growth_scene *s, const growth_made *m, const char *path);
bool growth_write_record(const growth_scene *s, const growth_made *m, const char *path,
                         random_source *random);

#endif
