/* Moduli from cantilevers and tips with calibration errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_LEVER_SCENE_H
#define STUDY_LEVER_SCENE_H

#include "afm_scene.h"

/* Six positions of two curves in bulk and track. The relative errors are drawn once for a draw, or
 * once for each of two cantilevers. */
typedef struct lever_scene {
    facts facts;
    double cantilever, sensitivity, angle, radius; /* stated relative errors */
    double ratio;                                  /* modulus ratio; 0: 1.4 */
    double spring_constant;                        /* 0: 0.5 N/m */
    double depth[2];                               /* bulk and track [m]; 0: 70 nm */
    double scatter;                                /* scatter between positions; 0: 0.04 */
    double noise;                                  /* relative to the largest force; 0: 0.005 */
    bool two;                                      /* two cantilevers */
    double worn;        /* tip radius ratio of track and bulk, not stated; 0: 1 */
    double pull, reach; /* in the track only, as in afm_scene */
} lever_scene;

extern const lever_scene lever_scenes[];
extern const int n_lever_scenes;

#endif
