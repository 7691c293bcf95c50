/* Dwells. All but POWER were fixed before the fit was tried on them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dwell_scene.h"

#define STATED .facts.intervals_promised = true
#define DRIFTS .drift = 0.02, .tilt = 0.02

const dwell_scene dwell_scenes[] = {
    {NAMED("H1", "relaxation, a power of time"), STATED, .noise = 0.002},
    {NAMED("H2", "relaxation, a steep one"), STATED, .noise = 0.002, .rubber = RUBBER_STEEP},
    {NAMED("H3", "relaxation, seven Maxwell terms, one a decade"), .noise = 0.002,
     .rubber = RUBBER_MAXWELL},
    {NAMED("H4", "relaxation, Cole and Cole"), STATED, .noise = 0.002, .rubber = RUBBER_COLE_COLE},
    {NAMED("H5", "relaxation, hardly any"), STATED, .noise = 0.002, .rubber = RUBBER_PLATEAU},
    {NAMED("H6", "relaxation, any rubber, drift and tilt"), STATED, .noise = 0.002,
     .rubber = RUBBER_ANY, DRIFTS},
    {NAMED("H7", "relaxation, any rubber, drift and tilt, no retract"), STATED, .noise = 0.002,
     .rubber = RUBBER_ANY, DRIFTS, .no_retract = true},
    {NAMED("H8", "relaxation, any rubber, correlated 0.5 %"), STATED, .noise = 0.005,
     .kind = NOISE_CORRELATED, .rubber = RUBBER_ANY, DRIFTS},
    {NAMED("H9", "relaxation, any rubber, 1/f 0.5 %"), STATED, .facts.sometimes_silent = true,
     .noise = 0.005, .kind = NOISE_FLICKER, .rubber = RUBBER_ANY, DRIFTS},
    {NAMED("H10", "creep, any rubber, drift and tilt"), STATED, .noise = 0.002, .creep = true,
     .rubber = RUBBER_ANY, DRIFTS},
    {NAMED("H11", "creep, any rubber, noise of the height 0.3 nm"), STATED, .noise = 0.002,
     .creep = true, .rubber = RUBBER_ANY, .height_noise = 0.3e-9},
    {NAMED("H12", "relaxation under a soft lever, any rubber"), STATED, .noise = 0.002,
     .rubber = RUBBER_ANY, .spring_constant = 0.5},
    {NAMED("H13", "relaxation under a pyramid, any rubber"), STATED, .noise = 0.005,
     .rubber = RUBBER_ANY, .pyramid = true},
    {NAMED("H14", "a dwell of 1 s, any rubber"), STATED, .noise = 0.002, .rubber = RUBBER_ANY,
     .hold = 1},
    {NAMED("H15", "a modulation of 5 Hz, any rubber"), .noise = 0.002, .rubber = RUBBER_ANY,
     .modulation = 5},
    {NAMED("H16", "a modulation of 23 Hz, any rubber, drift, tilt, 1/f 0.5 %"), .noise = 0.005,
     .kind = NOISE_FLICKER, .rubber = RUBBER_ANY, DRIFTS, .modulation = 23},
    {NAMED("H17", "mean of six of 5 Hz, any rubber, scatter 3 %"), STATED, .noise = 0.002,
     .rubber = RUBBER_ANY, .modulation = 5, .files = 6, .scatter = 0.03},
    {NAMED("H18", "mean of six of 5 Hz, any rubber, no scatter"), .noise = 0.002,
     .rubber = RUBBER_ANY, .modulation = 5, .files = 6},
    {NAMED("H19", "mean of four of 23 Hz, any rubber, drift, tilt, 1/f 0.5 %, scatter 3 %"),
     .noise = 0.005, .kind = NOISE_FLICKER, .rubber = RUBBER_ANY, DRIFTS, .modulation = 23,
     .files = 4, .scatter = 0.03},
};
const int n_dwell_scenes = sizeof dwell_scenes / sizeof dwell_scenes[0];
