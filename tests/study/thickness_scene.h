/* A track with a layer on rubber of the bulk, indented beside it, and a thickness that another
 * source states. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_THICKNESS_SCENE_H
#define STUDY_THICKNESS_SCENE_H

#include "afm_scene.h"

typedef struct thickness_scene {
    facts facts;
    afm_scene curves;       /* of the bulk, and what the track has from it: tip, noise, depth */
    double ratio;           /* E of the layer over that of the bulk */
    double thickness;       /* [m]; 0: the whole track */
    double spot_scatter;    /* of ln E */
    double other;           /* thickness of the other source over the true one, */
    double other_error;     /* and its relative standard error; 0: there is none */
    double other_thickness; /* [m], where the whole track is one rubber */
} thickness_scene;

extern const thickness_scene thickness_scenes[];
extern const int n_thickness_scenes;

#endif
