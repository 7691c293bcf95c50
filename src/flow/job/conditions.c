/* Material, roughness and conditions of one replicate of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/conditions.h"
#include "flow/job/draws.h"
#include "kernel/params.h"

#include <math.h>
#include <string.h>

void flow_add_words(char *words, size_t size, const char *what)
{
    size_t used = strlen(words);
    snprintf(words + used, size - used, "%s%s", used > 0 ? ", " : "", what);
}

wt_sliding wt_sliding_defaults(void)
{
    return (wt_sliding){
        .pressure = {(double)NAN, 0, 0, "Pa"},
        .temperature = {(double)NAN, 0, 0, "K"},
        .shear_stress = {(double)NAN, 0, 0, "Pa"},
        .gamma = wt_friction_defaults().gamma,
        .reference_velocity = (double)NAN,
    };
}

static const wt_param rows[] = {
    {PARAM("pressure", wt_sliding, pressure, WT_Q_PRESSURE, ABOVE(0)), .value = "P", .letter = 'p',
     .flags = PARAM_REQUIRED, .help = "nominal pressure, such as 0.4MPa or \"0.4MPa +- 5%\""},
    {PARAM_LIST_OF("velocity", wt_sliding, velocity, n_velocity, WT_Q_VELOCITY, ABOVE(0)),
     .value = "V", .letter = 'v', .flags = PARAM_REQUIRED,
     .help = "0.3m/s, a list 1mm/s,1cm/s or a range 1e-4:10m/s:log:40 (or lin) of 40 values"},
    {PARAM("reference-velocity", wt_sliding, reference_velocity, WT_Q_VELOCITY, ABOVE(0)),
     .unset = "that of the layer, else the middle of the list", .flags = PARAM_NO_OPTION,
     .help = "velocity of the answer"},
    {PARAM("sliding-temperature", wt_sliding, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .letter = 't', .unset = "the reference temperature of the material",
     .help = "of the rubber while it slides; another one than the reference needs a WLF law"},
    {PARAM("shear-stress", wt_sliding, shear_stress, WT_Q_STRESS, AT_LEAST(0)), .value = "TAU",
     .unset = "",
     .help = "tau_f of the real contact, such as 5MPa; without it there is no total "
             "friction"},
    FRICTION_GAMMA(wt_sliding),
};
PARAM_TABLE(wt_sliding_params, wt_sliding, rows, wt_sliding_defaults, NO_PARTS)

wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work, wt_error *err)
{
    if (sliding == NULL || sliding->rubber == NULL || sliding->surface == NULL)
        return wt_fail(err, WT_E_ARG, "sliding needs a rubber and a surface");
    wt_status status = param_check(wt_sliding_params(), sliding, err);
    return status == WT_OK ? param_check(wt_job_params(), work, err) : status;
}

double flow_reference_velocity(const wt_sliding *sliding)
{
    return isnan(sliding->reference_velocity) ? sliding->velocity[sliding->n_velocity / 2]
                                              : sliding->reference_velocity;
}

wt_status flow_conditions_make(const wt_sliding *sliding, uint64_t seed, size_t replicate,
                               double tolerance, unsigned threads, wt_layer_state layer,
                               flow_conditions *conditions, wt_error *err)
{
    flow_conditions c = {0};
    double temperature =
        flow_draw_value(sliding->temperature, seed, replicate, FLOW_DRAW_TEMPERATURE);
    wt_estimate density = {1, sliding->surface->c0.standard_error / sliding->surface->c0.value, 0,
                           "1"};
    double factor = flow_draw_positive(density, seed, replicate, FLOW_DRAW_DENSITY);
    c.pressure = flow_draw_positive(sliding->pressure, seed, replicate, FLOW_DRAW_PRESSURE);
    c.shear_stress =
        flow_draw_positive(sliding->shear_stress, seed, replicate, FLOW_DRAW_SHEAR_STRESS);
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = tolerance;
    options.gamma = sliding->gamma;
    options.threads = threads;
    options.layer = layer;
    wt_status status =
        wt_rubber_at(sliding->rubber, temperature, seed, replicate, &c.material, c.statement, err);
    if (status == WT_OK)
        status = wt_surface_roughness(sliding->surface, factor, &c.roughness, err);
    if (status == WT_OK)
        status = wt_friction_workspace_new(c.material, c.roughness, &options, &c.workspace, err);
    if (status != WT_OK) {
        flow_conditions_clear(&c);
        return status;
    }
    *conditions = c;
    return WT_OK;
}

void flow_conditions_clear(flow_conditions *conditions)
{
    wt_friction_workspace_free(conditions->workspace);
    wt_roughness_free(conditions->roughness);
    wt_material_free(conditions->material);
    *conditions = (flow_conditions){0};
}

void flow_conditions_lack(const wt_sliding *sliding, char *words, size_t size)
{
    words[0] = '\0';
    if (!(sliding->pressure.standard_error > 0))
        flow_add_words(words, size, "pressure");
    if (!(sliding->temperature.standard_error > 0))
        flow_add_words(words, size, "temperature");
    if (!(sliding->surface->c0.standard_error > 0))
        flow_add_words(words, size, "roughness");
}

bool flow_conditions_vary(const wt_sliding *sliding, const wt_job *work, char *words, size_t size)
{
    words[0] = '\0';
    if (work->replicates < 2)
        return false;
    if (sliding->rubber->has_master)
        flow_add_words(words, size, "material (isotherms resampled)");
    if (sliding->rubber->c1_error > 0 || sliding->rubber->c2_error > 0 ||
        sliding->rubber->slope_error > 0)
        flow_add_words(words, size, "shift law");
    if (sliding->pressure.standard_error > 0)
        flow_add_words(words, size, "pressure");
    if (sliding->temperature.standard_error > 0)
        flow_add_words(words, size, "temperature");
    if (sliding->surface->c0.standard_error > 0)
        flow_add_words(words, size, "roughness");
    return words[0] != '\0';
}
