/* Running-in against a growing layer: what is predicted and measured of it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_scene.h"

const growth_scene growth_scenes[] = {
    {NAMED("R1", "inputs good to 3 %"), .facts.intervals_promised = true, .of_inputs = 0.03,
     .of_layer = 0.03, .of_ratio = 0.03},
    {NAMED("R2", "wear and energy good to 20 %"), .facts.intervals_promised = true,
     .of_inputs = 0.05, .of_layer = 0.2, .of_ratio = 0.05},
    {NAMED("R3", "by transport of damage, inputs good to 5 %"), .facts.intervals_promised = true,
     .of_inputs = 0.05, .of_layer = 0.05, .of_ratio = 0.05, .transport = true},
    {NAMED("R4", "five times as slow as the theory"), .facts.intervals_promised = true,
     .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03, .off_time = 5, .lengths = 20},
    {NAMED("R5", "in a fifth of the time"), .facts.intervals_promised = true, .of_inputs = 0.03,
     .of_layer = 0.05, .of_ratio = 0.03, .off_time = 0.2},
    {NAMED("R6", "by transport, 2.2 times as slow"), .facts.intervals_promised = true,
     .of_inputs = 0.05, .of_layer = 0.1, .of_ratio = 0.05, .off_time = 2.2, .lengths = 10,
     .transport = true},
};
const int n_growth_scenes = sizeof growth_scenes / sizeof growth_scenes[0];
