/* Records of friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_RECORD_SCENE_H
#define STUDY_RECORD_SCENE_H

#include "facts.h"

typedef enum running_in_form {
    NO_RUNNING_IN,
    A_JUMP,      /* a different constant before */
    A_LINE,      /* a line to the steady value */
    A_HUMP,      /* half a wave above it, with a slope at its end */
    EXPONENTIAL, /* without an end */
    RUNNING_IN_FORMS
} running_in_form;

typedef enum pause_form {
    NO_PAUSE,
    A_REST, /* recorded: velocity and time only, no laps */
    A_GAP,  /* not recorded; laps continue */
} pause_form;

/* A pin on a disc with recorded laps, time and coefficient, or a reciprocating slider. Scatter is
 * that of a lap, relative to the coefficient. */
typedef struct record_scene {
    facts facts;
    running_in_form form;
    int laps;           /* 0: 800 */
    double height;      /* height of the running-in over the scatter of a lap; 0: 4 */
    double length;      /* its length relative to the record; 0: 0.2 to 0.4, drawn */
    double scatter;     /* 0: 0.02 */
    double slow;        /* slow share of its variance */
    double memory;      /* correlation length in laps; 0: 8 */
    double moving;      /* share of a random walk's step, for scatter of another kind */
    double drift;       /* over the record, relative to the scatter */
    int samples;        /* per lap; 0: 25 */
    double wave;        /* amplitude with the period of the lap, relative to the coefficient */
    bool strokes;       /* reciprocating, with a zero of 0.1 of the friction */
    bool changing_rate; /* no laps are recorded; the sampling rate changes fivefold halfway */
    int steps;          /* velocity steps; 0: one */
    double area_error;  /* stated relative error; the specific wear rate is requested */
    double mass_error;  /* the same for the mass */
    pause_form pause;   /* within the record, at a random position and length */
} record_scene;

extern const record_scene record_scenes[];
extern const int n_record_scenes;

#endif
