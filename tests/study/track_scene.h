/* Moduli of curves in and beside a wear track. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TRACK_SCENE_H
#define STUDY_TRACK_SCENE_H

#include "facts.h"

/* What the command is told of it: one temperature, both, the slope of ln E against temperature
 * beside them, no temperature but the DMA, or nothing. */
typedef enum warmth {
    NOT_WARMER,
    WARMER,
    WARMER_SLOPE_KNOWN,
    WARMER_UNSAID,
    WARMER_UNSAID_ALONE,
    NOT_WARMER_UNSAID
} warmth;

/* ln E = zone (ln(ratio) + ratio_slope ln(rate/0.6 um/s)) + rate_slope ln(rate/0.6 um/s) + spot
 *        + curve + levers. */
typedef struct track_scene {
    facts facts;
    double ratio;
    double ratio_slope;             /* the ratio depends on the rate; 0.6 um/s has `ratio` */
    int spots[2];                   /* bulk, track */
    double spot_scatter[2];         /* standard deviation of ln E */
    bool scatter_is_stated;         /* that of the bulk, to the command */
    bool heavy_tails;               /* spots and curves scatter as Student's t with 3 degrees */
    double rate_slope, rates[2][2]; /* um/s */
    bool one_rate_a_spot;           /* spots of odd number have the first rate alone, the others
                                       the second */
    bool cells_missing;             /* none to three curves in a cell instead of four */
    bool maps;                      /* each spot is a file of curves at places of their own */
    int copies;                     /* of these spots the track has the file again */
    bool copy_across;               /* the first spot of the bulk is in the track, too */
    double lever_error[2];          /* relative, of the spring constants */
    double sensitivity_error;       /* relative; stated */
    bool levers_separate;
    warmth warmth; /* the track 10 +- 1 K warmer, d ln E/dT -.012 +- .002; unsaid 17 K, by the law
                      that takes the rate slope to another temperature */
    bool through_friction;
} track_scene;

extern const track_scene track_scenes[];
extern const int n_track_scenes;

#endif
