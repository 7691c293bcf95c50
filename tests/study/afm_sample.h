/* The curve of a scene, and what an instrument makes of it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_SAMPLE_H
#define STUDY_AFM_SAMPLE_H

#include "afm_physics.h"
#include "afm_scene.h"
#include "random.h"

#include <stdio.h>

/* Way in and way out; contact in the middle of the way in. */
enum { AFM_BRANCH = 900, AFM_SAMPLES = 2 * AFM_BRANCH };
typedef struct afm_sample {
    double spring_constant, largest;
    double base[AFM_SAMPLES], time[AFM_SAMPLES], force[AFM_SAMPLES];
    double modulus; /* the truth: of the rubber, |E*(1/t_c)|, or that at the largest depth */
} afm_sample;

/* The tip of a scene; what it is pressed into left out. */
afm_tip afm_true_tip(const afm_scene *s);
/* Without noise. NULL if memory runs out. */
afm_sample *afm_sample_make(const afm_scene *s);
/* What the tip as stated makes of the force at a share of the largest depth; |E*| for loss. */
double afm_apparent(const afm_scene *s, const afm_sample *sample, double share);
enum { AFM_DEPTHS = 5 };
/* E(t) of a scene with loss [Pa]. */
relaxation afm_relaxation(const afm_scene *s);
/* One curve of it as a table of a text stream. */
void afm_sample_write(const afm_sample *sample, const afm_scene *s, random_source *random,
                      int curve, FILE *file);

#endif
