/* Layers of known thickness, fixed before the method was tried on them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "identify_scene.h"

#define PROMISED .facts.intervals_promised = true

const identify_scene identify_scenes[] = {
    {NAMED("U1", "thickness 10 %, wear 10 %"), PROMISED, .of_thickness = 0.1, .of_wear = 0.1,
     .of_inputs = 0.02, .critical_energy = 2e10},
    {NAMED("U2", "thickness 30 %, wear 15 %"), PROMISED, .of_thickness = 0.3, .of_wear = 0.15,
     .of_inputs = 0.05, .critical_energy = 2e10},
    {NAMED("U3", "a thin layer, thickness 20 %"), PROMISED, .of_thickness = 0.2, .of_wear = 0.1,
     .of_inputs = 0.05, .critical_energy = 1e11},
    {NAMED("U4", "thickness 3 %, wear 30 %"), PROMISED, .of_thickness = 0.03, .of_wear = 0.3,
     .of_inputs = 0.02, .critical_energy = 2e10},
};
const int n_identify_scenes = sizeof identify_scenes / sizeof identify_scenes[0];
