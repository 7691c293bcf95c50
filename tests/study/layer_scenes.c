/* Layers in time. Fixed before the errors were tried on any of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer_scene.h"

const layer_context layer_scenes[] = {
    {NAMED("Y1", "a mild, a severe and a mild load"), .facts.intervals_promised = true,
     .of_load = 0.02, .of_surface = 0.05, .of_wear = 0.1, .of_energy = 0.1, .of_shear = 0.1,
     .of_ratio = 0.05, .wear_rate = 1e-12, .critical_energy = 2e10, .ratio = 0.6, .loads = 3,
     .load = {{200, 1, 0.02}, {5, 2, 1}, {2000, 1, 0.02}}},
    {NAMED("Y2", "nothing is modified before the second load; large errors"),
     .facts.intervals_promised = true, .of_load = 0.05, .of_surface = 0.05, .of_wear = 0.25,
     .of_energy = 0.25, .of_shear = 0.2, .of_ratio = 0.1, .wear_rate = 1e-12,
     .critical_energy = 2e10, .ratio = 0.5, .loads = 2, .load = {{10, 0.5, 0.01}, {300, 1, 1}}},
    {NAMED("Y3", "wear that grows with the power: a layer up to a velocity"),
     .facts.intervals_promised = true, .of_load = 0.02, .of_surface = 0.05, .of_wear = 0.1,
     .of_energy = 0.1, .of_shear = 0.1, .of_ratio = 0.05, .wear_rate = 1e-12,
     .critical_energy = 2e10, .ratio = 0.6, .severity = 1e4, .loads = 2,
     .load = {{100, 1, 0.1}, {100, 1, 0.3}}},
    {NAMED("Y4", "a stiff layer; wear that grows with the power, large errors"),
     .facts.intervals_promised = true, .of_load = 0.05, .of_surface = 0.05, .of_wear = 0.2,
     .of_energy = 0.2, .of_shear = 0.1, .of_ratio = 0.1, .wear_rate = 5e-13,
     .critical_energy = 4e10, .ratio = 2, .severity = 2e4, .loads = 2,
     .load = {{50, 1, 0.3}, {500, 0.5, 0.1}}},
    {NAMED("Y5", "a layer whose modulus goes with the frequency in its own way"),
     .facts.intervals_promised = true, .of_load = 0.02, .of_surface = 0.05, .of_wear = 0.1,
     .of_energy = 0.1, .of_shear = 0.1, .of_ratio = 0.05, .wear_rate = 1e-12,
     .critical_energy = 2e10, .ratio = 0.6, .own = {1, 0.12, 30, 3, 3e5}, .of_slope = 0.03,
     .loads = 2, .load = {{200, 1, 0.02}, {2000, 1, 0.02}}},
    {NAMED("Y6", "the same, said to have one ratio"), .of_load = 0.02, .of_surface = 0.05,
     .of_wear = 0.1, .of_energy = 0.1, .of_shear = 0.1, .of_ratio = 0.05, .wear_rate = 1e-12,
     .critical_energy = 2e10, .ratio = 0.6, .own = {1, 0.12, 30, 3, 3e5}, .of_slope = 0.03,
     .as_one = true, .loads = 2, .load = {{200, 1, 0.02}, {2000, 1, 0.02}}},
};
const int n_layer_scenes = sizeof layer_scenes / sizeof layer_scenes[0];
