/* Measured friction against a case, fixed before the method was tried on it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "validation_scene.h"

#define PROMISED .facts.intervals_promised = true, .facts.verdict_promised = true
#define NOT_NO .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)
#define NOT_YES .facts.right = RIGHT(NO) | RIGHT(INCONCLUSIVE)

const validation_scene validation_scenes[] = {
    {NAMED("M1", "the theory is right, inputs good to 2 %"), PROMISED, .facts.right = RIGHT(YES),
     .error = 0.02},
    {NAMED("M2", "the theory is right, inputs good to 10 %"), PROMISED, NOT_NO, .error = 0.1},
    {NAMED("M3", "friction 1.7 times that of the theory"), PROMISED, .facts.right = RIGHT(NO),
     .off = 1.7, .error = 0.02},
    {NAMED("M4", "friction that rises by 20 % a decade against the theory"), PROMISED,
     .facts.right = RIGHT(NO), .trend = 0.2, .error = 0.02},
    {NAMED("M5", "1.25 times, beyond the margin"), PROMISED, NOT_YES, .off = 1.25, .error = 0.03},
    {NAMED("M6", "1.15 times, within the margin"), PROMISED, NOT_NO, .off = 1.15, .error = 0.03},
    {NAMED("M7", "the theory is right, a shear stress good to 40 %"), PROMISED,
     .facts.right = RIGHT(INCONCLUSIVE), .error = 0.02, .of_shear = 0.4},
    {NAMED("M8", "the theory is right, velocities that scatter by 8 %"), PROMISED, NOT_NO,
     .error = 0.03, .scatter = 0.08},
    {NAMED("M9", "1.25 times, velocities that scatter by 8 %"), PROMISED, NOT_YES, .off = 1.25,
     .error = 0.02, .scatter = 0.08},
    {NAMED("M10", "one velocity"), PROMISED, NOT_NO, .error = 0.03, .velocities = 1},
    {NAMED("M11", "four velocities, laps that scatter by 10 %"), PROMISED, NOT_NO, .error = 0.05,
     .noise = 0.1, .velocities = 4},
    {NAMED("M12", "no shear stress in the case"), PROMISED, .facts.right = RIGHT(INCONCLUSIVE),
     .error = 0.05, .unsaid = true},
};
const int n_validation_scenes = sizeof validation_scenes / sizeof validation_scenes[0];
