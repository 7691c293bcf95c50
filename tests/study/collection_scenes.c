/* Whole studies of several compounds and severities, fixed before the method was tried on them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "collection_scene.h"

const collection_scene collection_scenes[] = {
    {NAMED("G1",
           "two compounds at two severities: soft tracks, one without a layer, one undecidable"),
     .facts.intervals_promised = true, .facts.right = RIGHT(YES), .lap_noise = 0.02,
     .cases = {{{0.82, 5, 0.04}, {0.64, 5, 0.04}}, {{1, 5, 0.04}, {0.64, 3, 0.25}}}},
    {NAMED("G2", "the same with the running-in of the record, the second compound by transport"),
     .facts.intervals_promised = true, .facts.right = RIGHT(YES), .lap_noise = 0.003,
     .running_in = true,
     .cases = {{{0.82, 5, 0.04}, {0.64, 5, 0.04}}, {{1, 5, 0.04}, {0.64, 3, 0.25}}}},
};
const int n_collection_scenes = sizeof collection_scenes / sizeof collection_scenes[0];
