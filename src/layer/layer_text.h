/* What must be said of a layer whose model is not the plain one. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_TEXT_H
#define WT_LAYER_LAYER_TEXT_H

#include "layer/layer_energy.h"

/* "" for what is as it is without the option. */
typedef struct layer_saying {
    char energy[256], closure[320], severity[256];
} layer_saying;

void layer_describe(const wt_layer_job *job, const layer_energy *energy,
                    const wt_layer_parameters *parameters, layer_saying *words);
/* Where the rubber would not keep on the shelf. */
void layer_warn(const wt_layer_job *job, const wt_layer_parameters *parameters, wt_log *log);

#endif
