/* Inside the comparison: the thickness that curves allow beside another one. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TRACK_LAYER_H
#define WT_STUDY_TRACK_LAYER_H

#include "indentation/law/tip.h"
#include "weartrack/flow.h"

/* Known otherwise; the value NaN: nothing is. */
typedef struct track_other {
    wt_interval thickness;
    const char *from;  /* where from, in words; "" = nowhere */
    const char *lacks; /* of what its error lacks, or NULL */
    bool given;        /* by the user; else by the theory */
} track_other;

/* Why the curves are not asked, and what would let them be; NULL: they are. */
typedef struct track_obstacle {
    const char *why, *settled_by;
} track_obstacle;

typedef struct track_findings {
    wt_layer_profile profile;
    wt_layer_agreement agreement;
    track_other other;
    double ratio, ratio_error; /* of the moduli, ln of it its error; NaN: not known */
    const wt_tip *tip;         /* of the track; NULL: not known */
    track_obstacle obstacle;
} track_findings;

typedef struct track_text {
    char allowed[480], agree[480], settled_by[400];
} track_text;
void track_text_make(const track_findings *found, track_text *words);

#endif
