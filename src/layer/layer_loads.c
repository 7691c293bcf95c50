/* Parser of successive loads: "time=900s,pressure=0.4MPa,velocity=5mm/s".
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_loads.h"
#include "dma/law_parse.h"

#include "core/base/param.h"

#include <math.h>

static layer_load load_defaults(void)
{
    const double unset = (double)NAN;
    return (layer_load){unset, unset, unset, unset, unset};
}

static const wt_param rows[] = {
    {PARAM("time", layer_load, time, WT_Q_TIME, AT_LEAST(0)), .unset = "", .flags = PARAM_NO_OPTION,
     .help = "that the load lasts"},
    {PARAM("pressure", layer_load, pressure, WT_Q_PRESSURE, ABOVE(0)), .unset = "",
     .flags = PARAM_NO_OPTION, .help = "nominal pressure"},
    {PARAM("velocity", layer_load, velocity, WT_Q_VELOCITY, ABOVE(0)), .unset = "",
     .flags = PARAM_NO_OPTION, .help = "of sliding"},
    {PARAM("temperature", layer_load, temperature, WT_Q_TEMPERATURE, ABOVE(0)), .unset = "",
     .flags = PARAM_NO_OPTION, .help = "of the rubber"},
    {PARAM("specific-wear-rate", layer_load, specific_wear_rate, WT_Q_WEAR_RATE, AT_LEAST(0)),
     .unset = "", .flags = PARAM_NO_OPTION, .help = "k"},
};
PARAM_LOCAL_TABLE(load_params, layer_load, rows, load_defaults, NO_PARTS)

static const flow_law_text load_text = {.prefix = "",
                                        .name = "load",
                                        .what = "a load",
                                        .example = "time=900s,pressure=0.4MPa,velocity=5mm/s",
                                        .params = load_params};

wt_status layer_load_parse(const wt_layer_job *job, size_t i, layer_load *load, wt_error *err)
{
    layer_load l = load_defaults();
    wt_status status = flow_law_parse(&load_text, job->loads[i], &l, err);
    if (status == WT_OK && isnan(l.time) && i + 1 < job->n_loads) {
        status = wt_fail(err, WT_E_MISSING, "a load that another one follows needs its time");
        wt_error_expected(err, "time=900s");
    }
    if (status != WT_OK)
        wt_error_place(err, "load %zu of %zu", i + 1, job->n_loads);
    *load = l;
    return status;
}
