/* Force curve of a scene, with the errors of the instrument.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_SAMPLE_H
#define STUDY_AFM_SAMPLE_H

#include "afm_physics.h"
#include "afm_scene.h"
#include "random.h"

#include <stdio.h>

/* Approach and retraction; contact is in the middle of the approach. */
enum { AFM_BRANCH = 900, AFM_SAMPLES = 2 * AFM_BRANCH };
typedef struct afm_sample {
    double spring_constant, largest;
    double base[AFM_SAMPLES], time[AFM_SAMPLES], force[AFM_SAMPLES];
    double modulus; /* true modulus: of the rubber, |E*(1/t_c)|, or that at the largest depth */
} afm_sample;

/* Tip of a scene, without its sample. */
afm_tip afm_true_tip(const afm_scene *s);
/* Curve without noise; NULL without memory. */
afm_sample *afm_sample_make(const afm_scene *s);
/* Curve as a file states it if spring constant and sensitivity are these multiples of the stated
 * ones. */
void afm_sample_as_stated(afm_sample *sample, double cantilever, double sensitivity);
/* Modulus from the force at a share of the largest depth with the stated tip; |E*| with loss. */
double afm_apparent(const afm_scene *s, const afm_sample *sample, double share);
enum { AFM_DEPTHS = 5 };
/* E(t) of a viscoelastic scene [Pa]. */
relaxation afm_relaxation(const afm_scene *s);
/* Writes one curve as a table of a text stream. */
void afm_sample_write(const afm_sample *sample, const afm_scene *s, random_source *random,
                      int curve, FILE *file);

#endif
