/* Friction as measured against a case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_VALIDATION_SCENE_H
#define STUDY_VALIDATION_SCENE_H

#include "facts.h"

/* A pin on a disc at several velocities whose friction is that of Persson's theory, times what the
 * theory does not know of. The case states its inputs with errors, from which the truth is drawn.
 */
typedef struct validation_scene {
    facts facts;
    double off;      /* friction over that of the theory; 0: 1 */
    double trend;    /* ln of the same for each decade of velocity */
    double error;    /* relative and stated, of pressure, C0 and, without the next, shear stress */
    double of_shear; /* of the shear stress */
    double noise;    /* scatter of a lap; 0: 0.02 */
    double scatter;  /* of a velocity, that nothing states */
    int velocities;  /* 0: 8, from 1 mm/s in half decades */
    bool unsaid;     /* the case has no shear stress */
} validation_scene;

extern const validation_scene validation_scenes[];
extern const int n_validation_scenes;

#endif
