/* Running-in of a record against a growing layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_SCENE_H
#define STUDY_GROWTH_SCENE_H

#include "facts.h"

/* A pin on a disc of fresh rubber. A layer that grows by formation and wear determines friction.
 * The case states its inputs with errors, from which the truth is drawn. */
typedef struct growth_scene {
    facts facts;
    double of_inputs;  /* stated relative errors of pressure, C0 and shear stress */
    double of_layer;   /* of wear rate and critical energy */
    double of_ratio;   /* of the modulus ratio */
    double off_time;   /* true over predicted time; 0: 1 */
    double lengths;    /* of the record, in predicted times; 0: 4 */
    double weighed;    /* error of the mass loss; 0: not stated */
    int laps, samples; /* 0: 600, and 8 per lap */
    bool transport;    /* transport of damage with an incubation, else rates */
} growth_scene;

extern const growth_scene growth_scenes[];
extern const int n_growth_scenes;

#endif
