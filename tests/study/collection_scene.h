/* Whole studies of several compounds and severities.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_COLLECTION_SCENE_H
#define STUDY_COLLECTION_SCENE_H

#include "facts.h"

/* A case of a study. */
typedef struct study_case {
    double ratio;        /* modulus ratio of track and bulk; 1: no layer */
    int spots;           /* number in bulk and in track */
    double spot_scatter; /* standard deviation of ln E */
} study_case;

enum { COMPOUNDS = 2, SEVERITIES = 2, STUDY_SPOTS_MAX = 6 };

/* Each compound at each severity has force curves at three rates, isotherms, scans of the counter
 * surface and a record of friction and wear. */
typedef struct collection_scene {
    facts facts;
    double lap_noise; /* relative scatter of the coefficient of a lap */
    bool running_in;  /* the record begins on fresh rubber, at the velocity that forms the layer */
    study_case cases[COMPOUNDS][SEVERITIES]; /* mild, severe */
} collection_scene;

extern const collection_scene collection_scenes[];
extern const int n_collection_scenes;

#endif
