/* Loads that follow one another, as a job has them. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_LOADS_H
#define WT_LAYER_LAYER_LOADS_H

#include "weartrack/flow.h"

/* NaN: that of the sliding; the time of the last: for ever. */
typedef struct layer_load {
    double time, pressure, velocity, temperature, specific_wear_rate;
} layer_load;

/* WT_E_ARG and others, naming the load and what is wrong with it. */
wt_status layer_load_parse(const wt_layer_job *job, size_t i, layer_load *load,
                           wt_error *err) WT_NODISCARD;

#endif
