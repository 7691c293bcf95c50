/* Measured surfaces. SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface_scene.h"

#define STATED .facts.intervals_promised = true

const surface_scene surface_scenes[] = {
    {NAMED("S1", "one scan"), STATED},
    {NAMED("S2", "one scan of a bowl"), STATED, .form = 5},
    {NAMED("S3", "two places and two near by"), STATED, .places = 2, .near_by = 2},
    {NAMED("S4", "six places that scatter by 0.3"), STATED, .places = 6, .scatter = 0.3},
    {NAMED("S5", "six places that do not"), STATED, .places = 6},
    {NAMED("S6", "one scan, longer waves than it"), STATED, .roll_off = 3e4},
    {NAMED("S7", "one scan, H 0.4"), STATED, .hurst = 0.4},
    {NAMED("S8", "one scan, 5 % of it missing"), .missing = 0.05},
    {NAMED("S9", "ten profiles"), STATED, .profiles = 10},
    {NAMED("S10", "one scan, a decade beyond it"), STATED, .end = 1.6e7},
    {NAMED("S11", "two places and two near by, beyond them"), STATED, .places = 2, .near_by = 2,
     .end = 1.6e8},
    {NAMED("S12", "six places that scatter, beyond them"), STATED, .places = 6, .scatter = 0.3,
     .end = 1.6e7},
    {NAMED("S20", "two places that scatter by 0.3"), STATED, .places = 2, .scatter = 0.3},
    {NAMED("S15", "four places and four near by that scatter"), STATED, .places = 4, .near_by = 4,
     .scatter = 0.3},
    {NAMED("S17", "four places and four a quarter as large that scatter"), .places = 4,
     .near_by = 4, .smaller = 4, .scatter = 0.5},
    {NAMED("S18", "three places, three a quarter as large and three a sixteenth that scatter"),
     STATED, .places = 3, .near_by = 3, .nearest = 3, .smaller = 4, .scatter = 0.3},
    {NAMED("S19", "three places of each of three sizes, each ten times as small"), STATED,
     .places = 3, .near_by = 3, .nearest = 3, .scatter = 0.3},
    {NAMED("S13", "texture of 0.4 at 35 deg"), STATED, .stretch = 0.4, .texture = 0.6},
    {NAMED("S14", "texture of 0.8 along x, two places"), STATED, .places = 2, .stretch = 0.8},
    {NAMED("S16", "texture of 0.4 at 35 deg, six places"), STATED, .places = 6, .stretch = 0.4,
     .texture = 0.6},
};
const int n_surface_scenes = sizeof surface_scenes / sizeof surface_scenes[0];
