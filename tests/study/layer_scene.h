/* A layer under loads in turn, with its friction, and where it ends. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef STUDY_LAYER_SCENE_H
#define STUDY_LAYER_SCENE_H

#include "facts.h"
#include "layer_physics.h"

typedef struct layer_load {
    double lasts;              /* [s]; of the last one: when the layer is looked at */
    double pressure, velocity; /* over those of the contact */
} layer_load;

/* Relative errors, which are stated. */
typedef struct layer_context {
    facts facts;
    double of_load, of_surface, of_wear, of_energy, of_shear, of_ratio;
    double wear_rate, critical_energy, ratio; /* nominal, times e^(0.1 z) */
    double severity;                          /* power [W/m^2], 0: none; then it has an edge */
    own_ratio own;   /* slope 0: one ratio; its ratio is that of the draw */
    double of_slope; /* the error of the slope, not relative */
    bool as_one;     /* the command is told of one ratio all the same */
    int loads;
    layer_load load[LOADS_MAX];
} layer_context;

extern const layer_context layer_scenes[];
extern const int n_layer_scenes;

#endif
