/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lever_scene.h"

#define DIFFERS (RIGHT(YES) | RIGHT(CANNOT_SAY))

const lever_scene lever_scenes[] = {
    {NAMED("IK1", "spring constant 10 %, one lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .lever = 0.1},
    {NAMED("IK2", "sensitivity 3 %, one soft lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .sensitivity = 0.03, .spring_constant = 0.2},
    {NAMED("IK3", "half-angle 3 %, radius 15 %, the track shallow"),
     .facts.intervals_promised = true, .facts.right = DIFFERS, .angle = 0.03, .radius = 0.15,
     .depth = {70e-9, 25e-9}},
    {NAMED("IK4", "all of them, one lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .lever = 0.08, .sensitivity = 0.02, .angle = 0.03, .radius = 0.15},
    {NAMED("IK5", "all of them, two levers"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .lever = 0.08, .sensitivity = 0.02, .angle = 0.03, .radius = 0.15,
     .two = true},
    {NAMED("IK6", "spring constant 3 %, spots 15 %"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .lever = 0.03, .scatter = 0.15},
};
const int n_lever_scenes = sizeof lever_scenes / sizeof lever_scenes[0];
