/* Moduli of curves in and outside a wear track.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TRACK_SCENE_H
#define STUDY_TRACK_SCENE_H

#include "facts.h"

/* Temperatures that the command gets: one; both; both with the slope of ln E against temperature;
 * none but the DMA; or none. */
typedef enum warmth {
    NOT_WARMER,
    WARMER,
    WARMER_SLOPE_KNOWN,
    WARMER_UNSAID,
    WARMER_UNSAID_ALONE,
    NOT_WARMER_UNSAID
} warmth;

/* ln E = zone (ln(ratio) + ratio_slope ln(rate/0.6 um/s)) + rate_slope ln(rate/0.6 um/s) + position
 * + curve + cantilevers. */
typedef struct track_scene {
    facts facts;
    double ratio;
    double ratio_slope;             /* the ratio depends on the rate; `ratio` is at 0.6 um/s */
    int spots[2];                   /* bulk, track */
    double spot_scatter[2];         /* standard deviation of ln E */
    bool scatter_is_stated;         /* the command gets that of the bulk */
    bool heavy_tails;               /* positions and curves scatter as Student's t with 3 degrees */
    double rate_slope, rates[2][2]; /* um/s */
    /* odd positions have the first rate only, even ones the second */
    bool one_rate_a_spot;
    bool cells_missing; /* none to three curves per cell in place of four */
    bool maps;          /* each position is a file of curves at different points */
    /* number of these positions whose file is copied to the track */
    int copies;
    bool copy_across;         /* the track contains the first position of the bulk, too */
    double lever_error[2];    /* relative error of the spring constants */
    double sensitivity_error; /* stated relative error */
    bool levers_separate;
    /* track warmer by 10 +- 1 K, d ln E/dT -.012 +- .002; unstated 17 K, by the law that relates
     * the rate slope to temperature */
    warmth warmth;
    bool through_friction;
} track_scene;

extern const track_scene track_scenes[];
extern const int n_track_scenes;

#endif
