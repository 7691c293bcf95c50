/* A layer of known thickness with a known wear rate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_IDENTIFY_SCENE_H
#define STUDY_IDENTIFY_SCENE_H

#include "facts.h"

/* Stated relative errors of measured values. */
typedef struct identify_scene {
    facts facts;
    double of_thickness, of_wear;
    double of_inputs;       /* of pressure and C0 */
    double critical_energy; /* U_c [J/m^3], with a factor e^(0.2 z) */
} identify_scene;

extern const identify_scene identify_scenes[];
extern const int n_identify_scenes;

#endif
