/* Moduli by levers and tips that are not quite what is stated of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_LEVER_SCENE_H
#define STUDY_LEVER_SCENE_H

#include "afm_scene.h"

/* Six spots of two curves in bulk and track. The relative errors are drawn once for a draw, or once
 * for each of two levers. */
typedef struct lever_scene {
    facts facts;
    double lever, sensitivity, angle, radius; /* relative errors, stated */
    double ratio;                             /* of the moduli; 0: 1.4 */
    double spring_constant;                   /* 0: 0.5 N/m */
    double depth[2];                          /* bulk and track [m]; 0: 70 nm */
    double scatter;                           /* of spots; 0: 0.04 */
    double noise;                             /* of the largest force; 0: 0.005 */
    bool two;                                 /* levers */
    double worn;        /* radius of the tip in the track over that in the bulk, unsaid; 0: 1 */
    double pull, reach; /* in the track only, as in afm_scene */
} lever_scene;

extern const lever_scene lever_scenes[];
extern const int n_lever_scenes;

#endif
