/* Running-in of a record against a growing layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_SCENE_H
#define STUDY_GROWTH_SCENE_H

#include "facts.h"

/* Kind of a row of a record: several means per lap, one per lap at its start, middle or end, or
 * friction at one time. Of the latter, the first is on the bare surface. */
typedef enum growth_rows { ROWS_IN_LAP, ROWS_FROM, ROWS_ABOUT, ROWS_UNTIL, ROWS_AT } growth_rows;

/* A pin on a disc of fresh rubber. A layer that grows by formation and wear determines friction;
 * where the theory is wrong, the time or the change differs. The case states its inputs with
 * errors, from which the truth is drawn. */
typedef struct growth_scene {
    facts facts;
    double off_time, off_change; /* true values relative to the theory; 0: 1 */
    double of_inputs;            /* stated relative errors of pressure, C0 and shear stress */
    double of_layer;             /* of wear rate and critical energy */
    double of_ratio;             /* of the modulus ratio */
    double noise;                /* scatter of a lap; 0: 0.002 */
    double slow;                 /* part of it with a period of 20 laps */
    /* length of the record over the settling time of the theory; 0: 4 */
    double lengths;
    double weighed;    /* error of the mass loss; 0: not stated */
    int laps, samples; /* 0: 600, and 8 per lap */
    int records;       /* 0: 1 */
    growth_rows rows;
    bool transport; /* transport of damage with an incubation, else rates */
    bool flat;      /* friction does not change */
    bool unsaid;    /* the case has no shear stress */
} growth_scene;

extern const growth_scene growth_scenes[];
extern const int n_growth_scenes;

#endif
