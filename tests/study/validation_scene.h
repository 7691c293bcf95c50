/* Measured friction against a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_VALIDATION_SCENE_H
#define STUDY_VALIDATION_SCENE_H

#include "facts.h"

/* A pin on a disc at several velocities. Friction is that of Persson's theory with a factor that
 * the theory does not contain. The case states its inputs with errors, from which the truth is
 * drawn. */
typedef struct validation_scene {
    facts facts;
    double off;   /* friction relative to the theory; 0: 1 */
    double trend; /* ln of this factor per decade of velocity */
    /* stated relative errors of pressure, C0 and, without the next, shear stress */
    double error;
    double of_shear; /* error of the shear stress */
    double noise;    /* scatter of a lap; 0: 0.02 */
    double scatter;  /* unstated scatter of a velocity */
    int velocities;  /* 0: 8, from 1 mm/s in half decades */
    bool unsaid;     /* the case has no shear stress */
} validation_scene;

extern const validation_scene validation_scenes[];
extern const int n_validation_scenes;

#endif
