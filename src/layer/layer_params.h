/* Successive loads of a layer job. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_PARAMS_H
#define WT_LAYER_LAYER_PARAMS_H

#include "weartrack/layer.h"

/* NaN for the value of the sliding; an unset time of the last load means that it does not end. */
typedef struct layer_load {
    double time, pressure, velocity, temperature, specific_wear_rate;
} layer_load;

/* Parses load i of a job. Errors name the load and the invalid value. */
wt_status layer_load_parse(const wt_layer_job *job, size_t i, layer_load *load,
                           wt_error *err) WT_NODISCARD;

#endif
