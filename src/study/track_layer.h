/* Parts of the comparison: thickness of the layer that the curves allow, and that of another
 * source. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TRACK_LAYER_H
#define WT_STUDY_TRACK_LAYER_H

#include "indentation/law/tip.h"
#include "weartrack/flow.h"

/* Thickness from another source; the value is NaN if there is none. */
typedef struct track_other {
    wt_interval thickness;
    const char *from;  /* description of the source; "" if none */
    const char *lacks; /* missing component of its error, or NULL */
    bool given;        /* true if the user states it, false if it is that of the theory */
} track_other;

/* The reason why the curves are not used, with a remedy. NULL if they are used. */
typedef struct track_obstacle {
    const char *why, *settled_by;
} track_obstacle;

typedef struct track_findings {
    wt_layer_profile profile;
    wt_layer_agreement agreement;
    track_other other;
    double ratio, ratio_error; /* ratio of the moduli; error of its logarithm; NaN if unknown */
    const wt_tip *tip;         /* of the track; NULL if unknown */
    track_obstacle obstacle;
} track_findings;

typedef struct track_text {
    char allowed[480], agree[480], settled_by[400];
} track_text;
void track_text_make(const track_findings *found, track_text *words);

#endif
