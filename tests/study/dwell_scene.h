/* Force curves that are held. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DWELL_SCENE_H
#define STUDY_DWELL_SCENE_H

#include "afm_scene.h"

/* The last one is another in each draw. */
typedef enum dwell_rubber {
    RUBBER_POWER,     /* of time, exponent 0.12 */
    RUBBER_STEEP,     /* exponent 0.35 */
    RUBBER_MAXWELL,   /* seven terms, one a decade */
    RUBBER_COLE_COLE, /* with its peak near the dwell */
    RUBBER_PLATEAU,   /* tan delta 0.03 at 1 rad/s */
    RUBBER_ANY
} dwell_rubber;

/* A paraboloid of 5 um pressed 400 nm into rubber of about 1 MPa in 0.5 s by a lever of 5 N/m and
 * held for 8 s, unless a member says otherwise. */
typedef struct dwell_scene {
    facts facts;
    dwell_rubber rubber;
    afm_noise kind;
    double noise;        /* of the largest force */
    double height_noise; /* [m] of the sensor */
    bool creep;          /* the force is held */
    double drift, tilt;  /* of the largest force, over the curve and the baseline, sd of draws */
    bool no_retract;
    double spring_constant; /* 0: 5 N/m */
    bool pyramid;           /* the blunted one of 20 nm, 150 nm deep, lever of 0.5 N/m */
    double hold;            /* [s]; 0: 8 s */
    double modulation;      /* frequency [Hz] of the height while it is held, 1 % of the depth */
    int files;              /* of a curve each, whose means are judged; 0: one curve by itself */
    double scatter;         /* of their moduli */
} dwell_scene;

extern const dwell_scene dwell_scenes[];
extern const int n_dwell_scenes;

#endif
