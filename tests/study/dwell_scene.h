/* Held force curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DWELL_SCENE_H
#define STUDY_DWELL_SCENE_H

#include "afm_scene.h"

/* The last law differs in each draw. */
typedef enum dwell_rubber {
    RUBBER_POWER,     /* power law of time, exponent 0.12 */
    RUBBER_STEEP,     /* exponent 0.35 */
    RUBBER_MAXWELL,   /* seven terms, one per decade */
    RUBBER_COLE_COLE, /* peak near the dwell */
    RUBBER_PLATEAU,   /* tan delta 0.03 at 1 rad/s */
    RUBBER_ANY
} dwell_rubber;

/* Defaults: a paraboloid of 5 um indents rubber of about 1 MPa by 400 nm in 0.5 s with a spring
 * constant of 5 N/m and is held for 8 s. */
typedef struct dwell_scene {
    facts facts;
    dwell_rubber rubber;
    afm_noise kind;
    double noise;        /* relative to the largest force */
    double height_noise; /* noise of the sensor [m] */
    bool creep;          /* constant force, else constant height */
    /* relative to the largest force, over the curve and the baseline, standard deviation of the
     * draws */
    double drift, tilt;
    bool no_retract;
    double spring_constant; /* 0: 5 N/m */
    bool pyramid;           /* blunted tip of 20 nm, 150 nm deep, 0.5 N/m */
    double hold;            /* [s]; 0: 8 s */
    /* frequency [Hz] of a modulation of the held height, 1 % of the depth */
    double modulation;
    /* number of samples with a curve each, whose means are tested; 0: one curve */
    int files;
    double scatter; /* scatter of their moduli */
} dwell_scene;

extern const dwell_scene dwell_scenes[];
extern const int n_dwell_scenes;

#endif
