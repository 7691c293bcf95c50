/* Text about model options of a layer that differ from the default. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_TEXT_H
#define WT_LAYER_LAYER_TEXT_H

#include "layer/layer_energy.h"

/* A text is "" for a default option. */
typedef struct layer_description {
    char energy[256], severity[256];
} layer_description;

void layer_describe(const wt_layer_job *job, const layer_energy *energy,
                    const wt_layer_parameters *parameters, layer_description *words);

#endif
