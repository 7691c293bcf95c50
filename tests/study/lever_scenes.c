/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lever_scene.h"

#define ALIKE (RIGHT(NO) | RIGHT(INCONCLUSIVE))
#define DIFFERS (RIGHT(YES) | RIGHT(INCONCLUSIVE))

const lever_scene lever_scenes[] = {
    {NAMED("IK1", "spring constant 10 %, one lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .cantilever = 0.1},
    {NAMED("IK2", "sensitivity 3 %, one soft lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .sensitivity = 0.03, .spring_constant = 0.2},
    {NAMED("IK3", "half-angle 3 %, radius 15 %, the track shallow"),
     .facts.intervals_promised = true, .facts.right = DIFFERS, .angle = 0.03, .radius = 0.15,
     .depth = {70e-9, 25e-9}},
    {NAMED("IK4", "all of them, one lever"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .cantilever = 0.08, .sensitivity = 0.02, .angle = 0.03,
     .radius = 0.15},
    {NAMED("IK5", "all of them, two levers"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .cantilever = 0.08, .sensitivity = 0.02, .angle = 0.03, .radius = 0.15,
     .two = true},
    {NAMED("IK6", "spring constant 3 %, spots 15 %"), .facts.intervals_promised = true,
     .facts.right = DIFFERS, .cantilever = 0.03, .scatter = 0.15},
    /* Unstated differences of bulk and track other than the rubber. */
    {NAMED("IN1", "a tip worn to 80 nm in the track"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .worn = 4},
    {NAMED("IN1.noisy", "the same under 3 % of noise"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .worn = 4, .noise = 0.03},
    {NAMED("IN2", "a tip worn to 40 nm in the track"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .worn = 2},
    {NAMED("IN2.noisy", "the same under 3 % of noise"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .worn = 2, .noise = 0.03},
    {NAMED("IN3", "a pull of 5 nN in the track"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .pull = 5e-9},
    {NAMED("IN4", "a pull of 10 nN over 5 nm in the track"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .pull = 10e-9, .reach = 5e-9},
    {NAMED("IN5", "a pull of 2 nN over 20 nm in the track"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1, .pull = 2e-9, .reach = 20e-9},
    {NAMED("IN6", "a soft track, the same tip"), .facts.verdict_promised = true,
     .facts.right = RIGHT(YES), .ratio = 0.64},
    {NAMED("IN6.noisy", "the same under 3 % of noise"), .facts.verdict_promised = true,
     .facts.right = RIGHT(YES), .ratio = 0.64, .noise = 0.03},
    {NAMED("IN7", "a track as the bulk, the same tip"), .facts.verdict_promised = true,
     .facts.right = ALIKE, .ratio = 1},
};
const int n_lever_scenes = sizeof lever_scenes / sizeof lever_scenes[0];
