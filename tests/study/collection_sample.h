/* Truth of a whole study, and its files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_COLLECTION_SAMPLE_H
#define STUDY_COLLECTION_SAMPLE_H

#include "afm_sample.h"
#include "collection_scene.h"
#include "contact.h"
#include "dma_scene.h"
#include "growth.h"
#include "material.h"
#include "scene_draw.h"

enum { STUDY_RATES = 3, STUDY_VELOCITIES = 4 };
extern const double study_velocity[STUDY_VELOCITIES]; /* [m/s] */
extern const double study_q0, study_q1;               /* resolved range of the scans [rad/m] */
extern const char *const study_compound[COMPOUNDS], *const study_severity[SEVERITIES];

/* Data of a compound: the rubber of its isotherms, and the curve at each rate with a rigid
 * cantilever, as base positions and forces. */
typedef struct study_compound_truth {
    rubber rubber;
    double modulus[STUDY_RATES]; /* |E*| at 1/(loading time) [Pa] */
    afm_sample *curve[STUDY_RATES];
} study_compound_truth;

typedef struct study_prepared {
    study_compound_truth compound[COMPOUNDS];
} study_prepared;

/* Data that all draws share, in one allocation. */
study_prepared *study_prepare(void);

/* Truth of one study, and the derived values of each case. */
typedef struct study_truth {
    double shear_stress, cantilever, wear_rate[SEVERITIES], critical_energy[COMPOUNDS];
    contact_truth contact[COMPOUNDS][SEVERITIES]; /* without the layer */
    double with_layer[COMPOUNDS][SEVERITIES][STUDY_VELOCITIES];
    growth_truth growth[COMPOUNDS][SEVERITIES]; /* growth of a layer, if there is a running-in */
} study_truth;

/* Velocity of a step of a record, as an index of `study_velocity`. */
int study_step(const collection_scene *s, int step);
study_truth study_draw(const collection_scene *s, const study_prepared *p, random_source *random);

/* Measurement of the isotherms of a rubber. */
extern const dma_scene study_isotherms;

/* Writes the files of the counter surface and of the isotherms, which the cases share. */
typedef struct study_files {
    const char *scans[4], *sweep[COMPOUNDS];
} study_files;

int study_write_common(const study_prepared *p, random_source *random, const study_files *files);
/* Writes the case file of a compound and a severity, its curves and its record; returns 0 or -1. */
int study_write_case(const collection_scene *s, const study_prepared *p, const study_truth *truth,
                     const study_files *files, int compound, int severity, random_source *random,
                     scene_draw *t, const char *path);

#endif
