/* Parameters of the layer job, and their consistency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "dma/law_parse.h"
#include "layer/layer_energy.h"
#include "weartrack/layer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

wt_layer_job wt_layer_job_defaults(void)
{
    return (wt_layer_job){
        .critical_energy = {(double)NAN, 0, 0, "J/m^3"},
        .observed_thickness = {(double)NAN, 0, 0, "m"},
        .specific_wear_rate = {(double)NAN, 0, 0, "m^2/N"},
        .duty = wt_layer_defaults().duty,
        .incubation = true,
        .profile = WT_PROFILE_PERSSON,
        .velocity = (double)NAN,
        .energy = WT_LAYER_HYSTERESIS,
    };
}

static const wt_param rows[] = {
    {PARAM("critical-energy", wt_layer_job, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .value = "U", .unset = "",
     .help = "U_c, the energy per volume that modifies the rubber, such "
             "as 2e10J/m^3"},
    {PARAM("observed-thickness", wt_layer_job, observed_thickness, WT_Q_LENGTH, ABOVE(0)),
     .value = "D", .unset = "",
     .help = "of a layer, instead of the critical energy: this is to be "
             "the balance"},
    LAYER_WEAR_RATE(wt_layer_job, "as measured"),
    LAYER_DUTY(wt_layer_job),
    {PARAM_FLAG_OF("incubation", wt_layer_job, incubation),
     .help = "transport of damage (exact at constant load), without which the rates are balanced "
             "from the beginning"},
    {PARAM_CHOICE_OF("profile", wt_layer_job, profile, "persson|incompressible"),
     .flags = PARAM_ONLY_C, .help = "how the energy falls off with depth"},
    ENERGY_LOCAL_FRICTION(wt_layer_job),
    {PARAM_LIST_OF("times", wt_layer_job, time, n_time, WT_Q_TIME, AT_LEAST(0)), .value = "T",
     .unset = "around the time scales", .help = "such as 1:1e4s:log:40"},
    {PARAM("layer-velocity", wt_layer_job, velocity, WT_Q_VELOCITY, ABOVE(0)),
     .unset = "the reference velocity", .flags = PARAM_NO_OPTION,
     .help = "at which the track was worn"},
    {PARAM_CHOICE_OF("energy-from", wt_layer_job, energy, "hysteresis|shear|both"),
     .help = "what modifies the rubber: the hysteresis, the shearing of the real contact by the "
             "shear stress, or both; the shearing is taken to go as deep as the hysteresis "
             "(reconstructed)"},
};
PARAM_TABLE(wt_layer_job_params, wt_layer_job, rows, wt_layer_job_defaults, NO_PARTS)

wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err)
{
    const bool energy = !isnan(job->critical_energy.value);
    const bool observed = !isnan(job->observed_thickness.value);
    wt_status status = param_check(wt_layer_job_params(), job, err);
    if (status != WT_OK)
        return status;
    if (isnan(job->specific_wear_rate.value)) {
        status =
            wt_fail(err, WT_E_MISSING, "no specific wear rate is given, and none was measured");
        wt_error_advice(err, "give specific-wear-rate, such as \"1e-3mm^3/(N m)\", or what a "
                             "record tells of the wear");
        return status;
    }
    if (energy == observed) {
        status = wt_fail(err, energy ? WT_E_ARG : WT_E_MISSING,
                         "a layer has either a critical energy or an observed thickness");
        wt_error_expected(err, "one of critical-energy, observed-thickness");
        wt_error_found(err, energy ? "both" : "neither");
        wt_error_advice(err, "from an observed thickness the critical energy is calculated");
        return status;
    }
    if (observed && !(job->specific_wear_rate.value > 0)) {
        wt_fail(err, WT_E_RANGE, "an observed thickness is calibrated against wear");
        wt_error_place(err, "specific-wear-rate");
        wt_error_expected(err, "above 0");
        wt_error_found(err, "%g m^2/N", job->specific_wear_rate.value);
        return WT_E_RANGE;
    }
    return WT_OK;
}
