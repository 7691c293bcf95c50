/* Friction and layer thickness of a case variant.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/case_override.h"
#include "friction/sliding_contact.h"

#include "core/table/registry.h"

#include <math.h>

const char *const case_quantity_names[CASE_QUANTITIES] = {
    [CASE_QUANTITY_HYSTERESIS] = "hysteresis part",
    [CASE_QUANTITY_AREA_RATIO] = "real over nominal contact area",
    [CASE_QUANTITY_FRICTION] = "friction coefficient",
    [CASE_QUANTITY_THICKNESS] = "layer thickness",
    [CASE_QUANTITY_WITH_LAYER] = "friction coefficient with layer"};

wt_status case_variant_create(const wt_sliding *sliding, const wt_layer_job *layer,
                              const wt_layer_observation *observation, const wt_job *work,
                              case_variant *s, wt_error *err)
{
    wt_roughness *law = NULL;
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_surface_roughness(sliding->surface, 1, &law, err);
    if (status != WT_OK)
        return status;
    *s = (case_variant){.sliding = *sliding,
                        .velocity = flow_reference_velocity(sliding),
                        .rubber = *sliding->rubber,
                        .given = sliding->rubber,
                        .surface = *sliding->surface,
                        .has_softness = sliding->strain_softening != NULL,
                        .has_layer = layer != NULL,
                        .has_known = observation != NULL,
                        .vertical = sliding->rubber->fit.vertical};
    s->sliding.n_velocity = 1;
    s->sliding.reference_velocity = s->velocity;
    s->surface.q0 = law->q0;
    s->surface.q1 = law->q1;
    if (s->has_softness)
        s->strain_softening = *sliding->strain_softening;
    if (layer != NULL)
        s->layer = *layer;
    if (observation != NULL)
        s->layer_observation = *observation;
    wt_roughness_free(law);
    return WT_OK;
}

static wt_status compute_layer(const case_variant *s, const wt_job *work,
                               wt_layer_observation *observation, wt_error *err)
{
    static const double start = 0; /* only the steady-state thickness is requested */
    wt_layer_job job = s->layer;
    wt_layer_tables tables = {0};
    job.time = &start;
    job.n_time = 1;
    const wt_status status = wt_layer_thickness_compute(&s->sliding, &job, work, &tables, err);
    if (status == WT_OK)
        observation->thickness = tables.thickness;
    wt_table_free(tables.layer);
    return status;
}

static wt_status compute_variant_friction(case_variant *s, const wt_layer_observation *observation,
                                          const wt_job *work, wt_estimate *number, wt_error *err)
{
    wt_friction_tables tables = {0};
    table_view view;
    wt_status status = wt_sliding_friction_compute(&s->sliding, observation, work, &tables, err);
    if (status == WT_OK)
        status = table_bind(tables.friction, &friction_schema, "", &view, err);
    if (status == WT_OK) {
        number[CASE_QUANTITY_HYSTERESIS] = friction_value(&view, FRICTION_KEY_HYSTERESIS);
        number[CASE_QUANTITY_AREA_RATIO] = friction_value(&view, FRICTION_KEY_AREA_RATIO);
        number[CASE_QUANTITY_FRICTION] = friction_value(&view, FRICTION_KEY_FRICTION);
        number[CASE_QUANTITY_WITH_LAYER] = friction_value(&view, FRICTION_KEY_WITH_LAYER);
        const char *statement = friction_key_text(&view, FRICTION_KEY_MATERIAL_STATEMENT);
        snprintf(s->statement, sizeof s->statement, "%s", statement != NULL ? statement : "");
        s->extrapolated_share = friction_get(&view, 0, FRICTION_EXTRAPOLATED_SHARE);
    }
    wt_table_free(tables.friction);
    return status;
}

/* Lets the sliding refer to the velocity, rubber and surface of the variant. */
static void case_variant_bind(case_variant *s)
{
    s->sliding.rubber = s->given != NULL ? s->given : &s->rubber;
    s->sliding.surface = &s->surface;
    s->sliding.strain_softening = s->has_softness ? &s->strain_softening : NULL;
    s->sliding.velocity = &s->velocity;
}

double case_variant_highest_wavenumber(const case_variant *s)
{
    const double shortest_wave = 1e-9; /* [m] the size of a molecule */
    const wt_power_spectrum *const p = &s->surface.spectrum;
    const double known = s->surface.self_affine ? (double)INFINITY : p->wavenumber[p->n - 1];
    return fmin(2 * M_PI / shortest_wave, known);
}

wt_status case_variant_compute(case_variant *s, const wt_job *work, wt_estimate *number,
                               wt_error *err)
{
    wt_layer_observation observation = s->layer_observation;
    case_variant_bind(s);
    wt_status status = s->has_layer ? compute_layer(s, work, &observation, err) : WT_OK;
    if (status == WT_OK && s->has_layer)
        number[CASE_QUANTITY_THICKNESS] = observation.thickness;
    if (isnan(observation.thickness.standard_error))
        observation.thickness.standard_error = 0; /* an unknown error is not drawn */
    /* a layer that grows without limit has no friction */
    const bool layered = s->has_known && isfinite(observation.thickness.value);
    return status == WT_OK
               ? compute_variant_friction(s, layered ? &observation : NULL, work, number, err)
               : status;
}
