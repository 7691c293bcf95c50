/* Measured surfaces. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SURFACE_SCENE_H
#define STUDY_SURFACE_SCENE_H

#include "facts.h"

/* Defaults: scans of 112 x 112 points and 87.5 um, parts of surfaces of 256 x 256 points with 1e-25
 * m^4 below the roll-off and H 0.8. */
typedef struct surface_scene {
    facts facts;
    int places;      /* number of scans; 0: one */
    int near_by;     /* number of smaller scans */
    int nearest;     /* number of still smaller scans */
    double smaller;  /* size ratio; 0: ten */
    int profiles;    /* lines of 250 points, each of another surface */
    double hurst;    /* 0: 0.8 */
    double roll_off; /* [rad/m]; 0: 6e5, within the range */
    double scatter;  /* of ln C between positions */
    double missing;  /* share of the heights, at random */
    double form;     /* bowl and tilt of the form, relative to the rms of the surface */
    /* upper limit of the extrapolated spectrum [rad/m]; 0: that of the reliable range */
    double end;
    double stretch; /* amplitude of order 2 */
    double texture; /* its direction [rad] */
} surface_scene;

extern const surface_scene surface_scenes[];
extern const int n_surface_scenes;

#endif
