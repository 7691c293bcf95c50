/* Material, roughness and conditions of one replicate of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/conditions.h"
#include "flow/job/draws.h"
#include "flow/job/tables.h"

#include <math.h>

wt_sliding wt_sliding_defaults(void)
{
    return (wt_sliding){
        .pressure = {(double)NAN, 0, 0, "Pa"},
        .temperature = {(double)NAN, 0, 0, "K"},
        .shear_stress = {(double)NAN, 0, 0, "Pa"},
        .gamma = 1,
        .reference_velocity = (double)NAN,
    };
}

wt_status flow_sliding_check(const wt_sliding *sliding, wt_error *err)
{
    if (sliding == NULL || sliding->rubber == NULL || sliding->surface == NULL ||
        sliding->velocity == NULL || sliding->n_velocity == 0)
        return wt_fail(err, WT_E_ARG, "sliding needs a rubber, a surface and velocities");
    if (!(sliding->pressure.value > 0) || !isfinite(sliding->pressure.value)) {
        wt_fail(err, WT_E_RANGE, "the nominal pressure is not positive");
        wt_error_found(err, "%g Pa", sliding->pressure.value);
        return WT_E_RANGE;
    }
    if (sliding->shear_stress.value < 0)
        return wt_fail(err, WT_E_RANGE, "the shear stress %g Pa is negative",
                       sliding->shear_stress.value);
    for (size_t i = 0; i < sliding->n_velocity; i++)
        if (!(sliding->velocity[i] > 0) || !isfinite(sliding->velocity[i]))
            return wt_fail(err, WT_E_RANGE, "the sliding velocity %g m/s is not positive",
                           sliding->velocity[i]);
    if (!isnan(sliding->reference_velocity) && !(sliding->reference_velocity > 0))
        return wt_fail(err, WT_E_RANGE, "the reference velocity %g m/s is not positive",
                       sliding->reference_velocity);
    return WT_OK;
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
    if (tolerance > 0)
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

bool flow_conditions_vary(const wt_sliding *sliding, const wt_job *common, char *words, size_t size)
{
    words[0] = '\0';
    if (common->replicates < 2)
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
