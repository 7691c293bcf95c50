/* Parts of the comparison: thickness of the layer that the curves allow, and that of another
 * source. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TRACK_LAYER_H
#define WT_STUDY_TRACK_LAYER_H

#include "indentation/law/tip.h"
#include "weartrack/indentation.h"

/* Thickness from another source; the value is NaN if there is none. */
typedef struct alternative_thickness {
    wt_interval thickness;
    const char *from;  /* description of the source; "" if none */
    const char *lacks; /* missing component of its error, or NULL */
    bool given;        /* true if the user states it, false if it is that of the theory */
} alternative_thickness;

/* The reason why the curves are not used, with a remedy. NULL if they are used. */
typedef struct track_obstacle {
    const char *reason, *settled_by;
} track_obstacle;

typedef struct track_layer_result {
    wt_layer_profile profile;
    wt_layer_agreement agreement;
    alternative_thickness other;
    double ratio, ratio_error; /* ratio of the moduli; error of its logarithm; NaN if unknown */
    const wt_tip *tip;         /* of the track; NULL if unknown */
    track_obstacle obstacle;
} track_layer_result;

typedef struct track_layer_sentences {
    char allowed[480], agree[480], settled_by[400];
} track_layer_sentences;
void track_layer_write_sentences(const track_layer_result *found, track_layer_sentences *words);

#endif
