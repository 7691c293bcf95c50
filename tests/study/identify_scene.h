/* A layer of known thickness under known wear. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_IDENTIFY_SCENE_H
#define STUDY_IDENTIFY_SCENE_H

#include "facts.h"

/* Relative errors, which are stated, of what is measured. */
typedef struct identify_scene {
    facts facts;
    double of_thickness, of_wear;
    double of_inputs;       /* of pressure and C0 */
    double critical_energy; /* U_c [J/m^3], times e^(0.2 z) */
    int cases;              /* 0: one, by itself; else each in a case of its own, and collected */
    double energy_factor, wear_factor; /* of every second case over the others; 0: 1 */
} identify_scene;

enum { IDENTIFY_CASES = 4 };

extern const identify_scene identify_scenes[];
extern const int n_identify_scenes;

#endif
