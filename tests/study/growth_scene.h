/* The running-in of a record against a growing layer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_SCENE_H
#define STUDY_GROWTH_SCENE_H

#include "facts.h"

/* What a row of a record is: several means in a lap, or one in a lap, at its start, middle or end,
 * or friction at one time, of which the first is that of the bare surface. */
typedef enum growth_rows { ROWS_IN_LAP, ROWS_FROM, ROWS_ABOUT, ROWS_UNTIL, ROWS_AT } growth_rows;

/* A pin on a disc of fresh rubber, whose friction is that of a layer which grows by formation and
 * wear, in another time and by another change where the theory is wrong. The case states its inputs
 * with errors, from which the truth is drawn. */
typedef struct growth_scene {
    facts facts;
    double off_time, off_change; /* true over that of the theory; 0: 1 */
    double of_inputs;            /* relative and stated, of pressure, C0 and shear stress */
    double of_layer;             /* of wear rate and critical energy */
    double of_ratio;             /* of the modulus ratio */
    double noise;                /* scatter of a lap; 0: 0.002 */
    double slow;                 /* of it that comes and goes in 20 laps */
    double lengths;              /* of the record, settled times of the theory; 0: 4 */
    double weighed;              /* error of the mass that was lost; 0: it was not */
    int laps, samples;           /* 0: 600, and 8 in a lap */
    int records;                 /* 0: 1 */
    growth_rows rows;
    bool transport; /* of damage, with an incubation; else by rates */
    bool flat;      /* friction does not change */
    bool unsaid;    /* the case has no shear stress */
} growth_scene;

extern const growth_scene growth_scenes[];
extern const int n_growth_scenes;

#endif
