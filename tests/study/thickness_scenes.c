/* Layer thickness from curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "thickness_scene.h"

#define PROMISED .facts.intervals_promised = true, .facts.verdict_promised = true
/* The other source is right or wrong. */
#define RIGHT_SOURCE .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)
#define WRONG_SOURCE .facts.right = RIGHT(NO) | RIGHT(INCONCLUSIVE)
#define WHITE .curves.noise = .005
#define SPOTS .spot_scatter = .05

const thickness_scene thickness_scenes[] = {
    {NAMED("TH1", "soft layer of 30 nm, source right"), PROMISED, RIGHT_SOURCE, WHITE, SPOTS,
     .ratio = .5, .thickness = 30e-9, .other = 1, .other_error = .15},
    {NAMED("TH2", "soft layer of 30 nm, source 4 times as thick"), PROMISED, WRONG_SOURCE, WHITE,
     SPOTS, .ratio = .5, .thickness = 30e-9, .other = 4, .other_error = .15},
    {NAMED("TH3", "stiff layer of 30 nm, source right"), PROMISED, RIGHT_SOURCE, WHITE, SPOTS,
     .ratio = 2, .thickness = 30e-9, .other = 1, .other_error = .15},
    {NAMED("TH4", "soft layer of 1000 nm, source right"), PROMISED, RIGHT_SOURCE, WHITE, SPOTS,
     .ratio = .64, .thickness = 1e-6, .other = 1, .other_error = .2},
    {NAMED("TH5", "soft layer of 1000 nm, a tenth in the source"), PROMISED, WRONG_SOURCE, WHITE,
     SPOTS, .ratio = .64, .thickness = 1e-6, .other = .1, .other_error = .15},
    {NAMED("TH6", "the whole track is softer, source 50 nm"), PROMISED, WRONG_SOURCE, WHITE, SPOTS,
     .ratio = .64, .other_thickness = 50e-9, .other_error = .15},
    {NAMED("TH7", "track like bulk, source 50 nm"), .facts.verdict_promised = true,
     .facts.right = RIGHT(INCONCLUSIVE), WHITE, SPOTS, .ratio = 1, .other_thickness = 50e-9,
     .other_error = .15},
    {NAMED("TH8", "soft layer of 40 nm, correlated 2 %"), PROMISED, RIGHT_SOURCE,
     .curves.noise = .02, .curves.kind = NOISE_CORRELATED, SPOTS, .ratio = .5, .thickness = 40e-9,
     .other = 1, .other_error = .2},
    {NAMED("TH9", "soft layer of 100 nm, source right"), PROMISED, RIGHT_SOURCE, WHITE, SPOTS,
     .ratio = .64, .thickness = 100e-9, .other = 1, .other_error = .15},
    {NAMED("TH10", "soft layer of 40 nm, tip 1.3 times as blunt"), RIGHT_SOURCE, WHITE, SPOTS,
     .curves.radius_factor = 1.3, .ratio = .5, .thickness = 40e-9, .other = 1, .other_error = .2},
    {NAMED("TH11", "the whole track is softer, tip 1.3 times as blunt"), WRONG_SOURCE, WHITE, SPOTS,
     .curves.radius_factor = 1.3, .ratio = .64, .other_thickness = 50e-9, .other_error = .15},
    {NAMED("TH12", "soft layer of 60 nm, paraboloid of 100 nm"), PROMISED, RIGHT_SOURCE, WHITE,
     SPOTS, .curves.tip = TIP_PARABOLOID, .ratio = .6, .thickness = 60e-9, .other = 1,
     .other_error = .15},
};
const int n_thickness_scenes = sizeof thickness_scenes / sizeof thickness_scenes[0];
