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

static layer_load load_defaults(void)
{
    const double unset = (double)NAN;
    return (layer_load){unset, unset, unset, unset, unset};
}

static const wt_param load_rows[] = {
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

PARAM_LOCAL_TABLE(load_params, layer_load, load_rows, load_defaults, NO_PARTS)

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

wt_layer_job wt_layer_job_defaults(void)
{
    return (wt_layer_job){
        .critical_energy = {(double)NAN, 0, 0, "J/m^3"},
        .observed_thickness = {(double)NAN, 0, 0, "m"},
        .specific_wear_rate = {(double)NAN, 0, 0, "m^2/N"},
        .damage = wt_layer_defaults().damage,
        .duty = wt_layer_defaults().duty,
        .incubation = true,
        .profile = WT_PROFILE_PERSSON,
        .velocity = (double)NAN,
        .energy = WT_LAYER_HYSTERESIS,
        .severity_exponent = wt_layer_defaults().severity_exponent,
        .shear = wt_layer_shear_defaults(),
    };
}

/* Reads a power per area. It equals a power per volume times a length, so that its unit is checked
 * as power density times metre. */
static wt_status read_power(const char *text, void *member, wt_error *err)
{
    char volume[64];
    double value = (double)NAN;
    wt_error ignored = WT_ERROR_INIT;
    snprintf(volume, sizeof volume, "%.60s/m", text);
    if (strcmp(text, "0") == 0) {
        *(double *)member = 0;
        return WT_OK;
    }
    if (wt_quantity_parse(volume, WT_Q_POWER_DENSITY, &value, &ignored) != WT_OK || !(value >= 0)) {
        wt_fail(err, WT_E_ARG, "'%s' is not a power per area", text);
        wt_error_expected(err, "such as 25kW/m^2, or 0");
        return WT_E_ARG;
    }
    *(double *)member = value;
    return WT_OK;
}

static wt_status check_power(const void *member, wt_error *err)
{
    const double value = *(const double *)member;
    return value >= 0 && isfinite(value)
               ? WT_OK
               : range_error("severity-power", value, "finite and >= 0 W/m^2", err);
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
    LAYER_ROWS(wt_layer_job, "as measured"),
    ENERGY_PROFILE(wt_layer_job),
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
    {PARAM_OTHER_OF("severity-power", wt_layer_job, severity_power, read_power),
     .check = check_power, .value = "E", .unset = "",
     .help = "such as 25kW/m^2: E_c of a specific wear rate that grows with the power E that "
             "modifies the rubber, k (1 + (E/E_c)^m) (reconstructed); without it k is constant"},
    LAYER_SEVERITY_EXPONENT(wt_layer_job),
    {PARAM_FLAG_OF("bands", wt_layer_job, bands),
     .help = "also the upper and lower edges of the modified rubber in time, and when bands begin, "
             "reach the surface and merge"},
    {PARAM_TEXTS_OF("loads", wt_layer_job, loads, n_loads), .value = "NAME=VALUE,...", .unset = "",
     .help = "also the modified rubber under loads that follow one another, each such as "
             "time=900s,pressure=0.4MPa,velocity=5mm/s,temperature=20degC,specific-wear-rate="
             "1e-3mm^3/(N m), several parted by ';'; what is left out is that of the sliding, and "
             "the last lasts for ever"},
    {PARAM_FLAG_OF("running-in-friction", wt_layer_job, running_in),
     .help = "also friction in time while the layer grows; needs the modulus ratio"},
    {PARAM_FLAG_OF("feedback", wt_layer_job, has_feedback), .former = "acts-back",
     .help = "also all balances of a layer whose own modulus changes the energy that makes it, "
             "their stability and folds; needs the modulus ratio"},
    {PARAM_FLAG_OF("regime-map", wt_layer_job, existence), .former = "existence",
     .help = "also where a layer exists: thickness against the power, at every velocity and "
             "pressure of the lists"},
    {PARAM("shear-exponent", wt_layer_job, shear.exponent, WT_Q_NONE, FROM_TO(-10, 10)),
     .value = "M", .flags = PARAM_ONLY_C,
     .help = "of the modulus ratio, whose power times the shear stress is that of the layer "
             "(reconstructed)"},
    {PARAM("shear-decay-length", wt_layer_job, shear.transition_thickness, WT_Q_LENGTH,
           AT_LEAST(0)),
     .former = "shear-reach", .value = "D",
     .help = "thickness over which the shear stress goes over to that of the layer, as 1 - "
             "exp(-d/D) (reconstructed); 0: at once"},
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
    for (size_t i = 0; status == WT_OK && i < job->n_loads; i++) {
        layer_load load;
        status = layer_load_parse(job, i, &load, err);
    }
    if (status != WT_OK)
        return status;
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
