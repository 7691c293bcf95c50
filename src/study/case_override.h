/* Everything that friction and layer rest on, to be computed again with one thing changed. Internal
 * to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_CASE_OVERRIDE_H
#define WT_STUDY_CASE_OVERRIDE_H

#include "weartrack/flow.h"

/* What the hysteresis changes by with one of these, as d ln mu / d ln. */
enum { SENSITIVITIES = 4 };
extern const char *const setting_sensitivities[SENSITIVITIES];

typedef struct setting {
    wt_sliding sliding; /* of the velocity, rubber and surface below */
    double velocity;
    wt_rubber rubber;       /* borrowed, or another one */
    const wt_rubber *given; /* whose copy `rubber` is; NULL once something of it is changed */
    wt_surface surface;     /* borrowed; its cut-offs are numbers */
    bool has_softness, has_layer_rubber;
    wt_strain_softening softness; /* borrowed */
    wt_rubber layer_rubber;       /* likewise, that of the layer */
    bool has_layer, has_known;
    wt_layer_job layer;
    wt_layer_observation known;
    wt_vertical_shift vertical;
    /* after setting_compute: what is to be said of the material, and what share of the hysteresis
     * comes from outside its frequencies (NaN: not asked for) */
    char statement[512];
    double extrapolated_share;
    double by[SENSITIVITIES]; /* if sliding.sensitivities; see setting_sensitivities */
} setting;

/* What comes of it, at the reference velocity. */
typedef enum setting_number {
    SETTING_HYSTERESIS,
    SETTING_AREA_RATIO,
    SETTING_FRICTION,
    SETTING_THICKNESS,
    SETTING_WITH_LAYER,
    SETTING_NUMBERS
} setting_number;
extern const char *const setting_words[SETTING_NUMBERS];

/* `layer` NULL: no thickness; `known` NULL: no friction with a layer. With both, the thickness is
 * that which `layer` gives. */
wt_status setting_make(const wt_sliding *sliding, const wt_layer_job *layer,
                       const wt_layer_observation *known, const wt_job *work, setting *s,
                       wt_error *err) WT_NODISCARD;
/* number: [SETTING_NUMBERS]; those that do not apply stay as they are. */
wt_status setting_compute(setting *s, const wt_job *work, wt_estimate *number,
                          wt_error *err) WT_NODISCARD;

#endif
