/* Moduli of curves in and beside a wear track. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TRACK_SCENE_H
#define STUDY_TRACK_SCENE_H

#include "facts.h"

/* ln E = zone ln(ratio) + rate_slope ln(rate/0.6 um/s) + spot + curve. */
typedef struct track_scene {
    facts facts;
    double ratio;
    int spots[2];                   /* bulk, track */
    double spot_scatter[2];         /* standard deviation of ln E */
    double rate_slope, rates[2][2]; /* um/s */
    bool cells_missing;             /* none to three curves in a cell instead of four */
    double lever_error;             /* relative, of the spring constant */
    bool levers_separate;
} track_scene;

extern const track_scene track_scenes[];
extern const int n_track_scenes;

#endif
