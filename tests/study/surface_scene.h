/* Measured surfaces. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SURFACE_SCENE_H
#define STUDY_SURFACE_SCENE_H

#include "facts.h"

/* Scans of 112 x 112 points and 87.5 um, cut out of surfaces of 256 x 256 that go on beyond them,
 * of 1e-25 m^4 below a roll-off and H 0.8, unless a member says otherwise. */
typedef struct surface_scene {
    facts facts;
    int places;      /* scans; 0: one */
    int near_by;     /* more of them, smaller */
    int nearest;     /* and more, smaller again */
    double smaller;  /* by this; 0: ten times */
    int profiles;    /* lines of 250 points instead, each of another surface */
    double hurst;    /* 0: 0.8 */
    double roll_off; /* [rad/m]; 0: 6e5, in the range */
    double scatter;  /* of ln C from place to place */
    double missing;  /* share of the heights, anywhere */
    double form;     /* of a bowl and a tilt under it, rms of the surface */
    double end;      /* of the spectrum, by its law [rad/m]; 0: that of the reliable range */
    double stretch;  /* of order 2, amplitude */
    double texture;  /* and its direction [rad] */
} surface_scene;

extern const surface_scene surface_scenes[];
extern const int n_surface_scenes;

#endif
