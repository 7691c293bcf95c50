/* A track with a layer on the rubber of the bulk, indented in both zones, and a thickness from
 * another source.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_THICKNESS_SCENE_H
#define STUDY_THICKNESS_SCENE_H

#include "afm_scene.h"

typedef struct thickness_scene {
    facts facts;
    afm_scene curves;       /* scene of the bulk, and of the track for tip, noise and depth */
    double ratio;           /* modulus ratio of layer and bulk */
    double thickness;       /* [m]; 0: the whole track is modified */
    double spot_scatter;    /* scatter of ln E */
    double other;           /* stated over true thickness of the other source */
    double other_error;     /* its relative standard error; 0: not stated */
    double other_thickness; /* [m], if the whole track is modified */
} thickness_scene;

extern const thickness_scene thickness_scenes[];
extern const int n_thickness_scenes;

#endif
