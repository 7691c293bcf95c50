/* Records of friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_RECORD_SCENE_H
#define STUDY_RECORD_SCENE_H

#include "facts.h"

typedef enum running_in_form {
    NO_RUNNING_IN,
    A_JUMP,      /* another constant before */
    A_LINE,      /* that ends at the steady value */
    A_HUMP,      /* half a wave above it, that ends there with a slope */
    EXPONENTIAL, /* has no end */
    RUNNING_IN_FORMS
} running_in_form;

typedef enum pause_form {
    NO_PAUSE,
    A_REST, /* recorded: velocity and time alone are written, no laps */
    A_GAP,  /* nothing is recorded, laps go on behind it */
} pause_form;

/* A pin on a disc, of which laps, time and the coefficient are written, or a slider that goes there
 * and back. Scatter is of a lap, as a part of the coefficient. */
typedef struct record_scene {
    facts facts;
    running_in_form form;
    int laps;           /* 0: 800 */
    double height;      /* of the running-in over the scatter of a lap; 0: 4 */
    double length;      /* of it, of the record; 0: 0.2 to 0.4, drawn */
    double scatter;     /* 0: 0.02 */
    double slow;        /* share of its variance that is slow */
    double memory;      /* laps that it lasts; 0: 8 */
    double moving;      /* share of a random walk's step, for scatter that is of another kind */
    double drift;       /* from end to end of the record, over the scatter */
    int samples;        /* in a lap; 0: 25 */
    double wave;        /* amplitude of that of the lap, as a part of the coefficient */
    bool strokes;       /* there and back, with a zero of 0.1 of the friction */
    bool changing_rate; /* no laps are written, and half-way samples come five times as often */
    int steps;          /* of velocity; 0: one */
    double area_error;  /* relative, stated; the specific wear rate is asked for */
    double mass_error;  /* likewise */
    pause_form pause;   /* in mid-record, of drawn place and length */
} record_scene;

extern const record_scene record_scenes[];
extern const int n_record_scenes;

#endif
