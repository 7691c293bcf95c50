/* Material, roughness and load of one replicate of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "core/base/shared_params.h"
#include "dma/rubber.h"
#include "dma/strain_softening.h"
#include "friction/counter_surface.h"
#include "friction/numerics/friction_kernel.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include <math.h>
#include <string.h>

wt_sliding wt_sliding_defaults(void)
{
    return (wt_sliding){
        .pressure = {(double)NAN, 0, 0, "Pa"},
        .temperature = {(double)NAN, 0, 0, "K"},
        .shear_stress = {(double)NAN, 0, 0, "Pa"},
        .gamma = wt_friction_defaults().gamma,
        .reference_velocity = (double)NAN,
        .strain_factor = wt_friction_defaults().strain_factor,
        .flash = wt_flash_defaults(),
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
     .help = "of the rubber while it slides, or of its surroundings with a flash temperature; "
             "another one than the reference needs a WLF law"},
    {PARAM("shear-stress", wt_sliding, shear_stress, WT_Q_STRESS, AT_LEAST(0)), .value = "TAU",
     .unset = "",
     .help = "tau_f of the real contact, such as 5MPa; without it there is no total "
             "friction"},
    FRICTION_GAMMA(wt_sliding),
    FRICTION_STRAIN_FACTOR(wt_sliding),
    FRICTION_ANISOTROPY(wt_sliding),
    {PARAM_LIST_OF("temperatures", wt_sliding, temperatures, n_temperatures, WT_Q_TEMPERATURE,
                   ABOVE(0)),
     .value = "T", .unset = "",
     .help = "also a map of the friction at these temperatures of the rubber, such as "
             "-20degC:60degC:lin:9 or a list; needs a WLF law"},
    {PARAM_LIST_OF("pressures", wt_sliding, pressures, n_pressures, WT_Q_PRESSURE, ABOVE(0)),
     .value = "P", .unset = "",
     .help = "also a map of the friction at these nominal pressures, such as 0.1:1MPa:log:9 or a "
             "list"},
    {PARAM_FLAG_OF("decades", wt_sliding, decades),
     .help = "also what each decade of the wavenumber makes of the friction"},
    FLASH_ROWS(wt_sliding, flash.),
};
PARAM_TABLE(wt_sliding_params, wt_sliding, rows, wt_sliding_defaults, NO_PARTS)

/* Upper limit for a plausible pressure: tyres have less than 1 MPa, seals and bearings less than
 * 100 MPa; rubber fails above. */
static const double max_rubber_pressure = 100e6; /* [Pa] */

wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work, wt_error *err)
{
    if (sliding == NULL || sliding->rubber == NULL || sliding->surface == NULL)
        return wt_fail(err, WT_E_ARG, "sliding needs a rubber and a surface");
    wt_status status = param_check(wt_sliding_params(), sliding, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), work, err);
    if (status == WT_OK)
        status = wt_anisotropy_check(&sliding->anisotropy, err);
    if (status == WT_OK && sliding->pressure.value > max_rubber_pressure)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the nominal pressure of %.4g MPa is above the %.4g MPa that rubber bears: "
                   "is its unit right?",
                   1e-6 * sliding->pressure.value, 1e-6 * max_rubber_pressure);
    return status;
}

double flow_reference_velocity(const wt_sliding *sliding)
{
    return isnan(sliding->reference_velocity) ? sliding->velocity[sliding->n_velocity / 2]
                                              : sliding->reference_velocity;
}

/* Creates the workspace with the strain softening of the replicate. */
static wt_status create_workspace(const wt_sliding *sliding, wt_friction_options options,
                                  uint64_t seed, size_t replicate, sliding_contact *c,
                                  wt_error *err)
{
    wt_strain_softening strain_softening = {0};
    if (sliding->strain_softening != NULL) {
        strain_softening = strain_softening_draw(sliding->strain_softening, seed, replicate);
        options.softening = &strain_softening.table;
        options.strain_factor = sliding->strain_factor;
    }
    const wt_status status =
        wt_friction_workspace_new(c->material, c->roughness, &options, &c->workspace, err);
    wt_strain_softening_clear(&strain_softening);
    return status;
}

/* Checks the validity of the material at the frequencies of the velocities, and appends a statement
 * about it. */
static wt_status check_material_range(const wt_sliding *sliding, sliding_contact *c, wt_error *err)
{
    const wt_material_law *law = c->material->law;
    char words[256] = "";
    if (law->check == NULL)
        return WT_OK;
    const wt_status status =
        law->check(c->material, c->roughness->q0 * sliding->velocity[0],
                   c->roughness->q1 * sliding->velocity[sliding->n_velocity - 1], words, err);
    const size_t used = strlen(c->statement);
    snprintf(c->statement + used, sizeof c->statement - used, "%s%s",
             used > 0 && words[0] != '\0' ? "; " : "", words);
    return status;
}

/* Uses the cached material for the stated values, if the jobs share it. */
static wt_status use_shared_material(const wt_sliding *sliding, const wt_job *work,
                                     replicate_material *cached, sliding_contact *c, wt_error *err)
{
    const double *v = sliding->velocity, reference = flow_reference_velocity(sliding);
    shared_material values;
    const wt_status status =
        material_cache_get_stated(work->drawn, sliding, work->tolerance, fmin(v[0], reference),
                                  fmax(v[sliding->n_velocity - 1], reference), &values, err);
    *cached = values.content;
    snprintf(c->statement, sizeof c->statement, "%s", values.statement);
    return status;
}

wt_status sliding_contact_create(const wt_sliding *sliding, const wt_job *work, size_t replicate,
                                 wt_material_cache *shared, wt_layer_state layer,
                                 sliding_contact *contact, wt_error *err)
{
    sliding_contact c = {.cost = work->cost};
    const uint64_t seed = work->seed;
    const bool drawn = replicate != WT_NO_REPLICATE;
    double temperature =
        flow_draw_value(sliding->temperature, seed, replicate, FLOW_DRAW_TEMPERATURE);
    wt_estimate density = {1, sliding->surface->c0.standard_error / sliding->surface->c0.value, 0,
                           "1"};
    double factor = flow_draw_positive(density, seed, replicate, FLOW_DRAW_DENSITY);
    c.pressure = flow_draw_positive(sliding->pressure, seed, replicate, FLOW_DRAW_PRESSURE);
    c.shear_stress =
        flow_draw_positive(sliding->shear_stress, seed, replicate, FLOW_DRAW_SHEAR_STRESS);
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = drawn ? REPLICATE_TOLERANCE : work->tolerance;
    options.gamma = sliding->gamma;
    options.anisotropy = sliding->anisotropy;
    options.flash = sliding->flash;
    options.shift = flow_rubber_shift_law(sliding->rubber, seed, replicate);
    options.temperature = c.temperature =
        isnan(temperature) ? sliding->rubber->prony.reference_temperature : temperature;
    options.threads = drawn ? 1 : work->threads;
    options.layer = layer;
    options.skip_extrapolated_share = drawn || (layer.thickness > 0 && layer.slope.exponent == 0) ||
                                      (work->left_out & WT_EXTRA_EXTRAPOLATED_SHARE) != 0;
    replicate_material cached = {0};
    wt_status status = shared != NULL ? material_cache_get(shared, replicate, &cached, err)
                       : drawn        ? WT_OK
                                      : use_shared_material(sliding, work, &cached, &c, err);
    c.shared = cached.material != NULL;
    c.material = cached.material;
    options.series = cached.series;
    if (status == WT_OK && !c.shared)
        status = wt_rubber_material(sliding->rubber, temperature, seed, replicate, &c.material,
                                    c.statement, err);
    if (status == WT_OK)
        status = flow_surface_draw(sliding->surface, factor, seed, replicate, &c.roughness, err);
    if (status == WT_OK)
        status = check_material_range(sliding, &c, err);
    if (status == WT_OK)
        status = create_workspace(sliding, options, seed, replicate, &c, err);
    if (status != WT_OK) {
        sliding_contact_clear(&c);
        return status;
    }
    *contact = c;
    return WT_OK;
}

wt_status sliding_contact_create_stated(const wt_sliding *sliding, const wt_job *work,
                                        sliding_contact *contact, wt_error *err)
{
    wt_job alone = *work;
    alone.left_out = WT_EXTRA_ALL;
    return sliding_contact_create(sliding, &alone, WT_NO_REPLICATE, NULL,
                                  (wt_layer_state){.modulus_ratio = 1}, contact, err);
}

wt_layer_state sliding_layer_at_shear_rate(const sliding_contact *contact, wt_layer_state layer,
                                           double velocity)
{
    const double rate = fabs(velocity) / layer.thickness;
    if (contact->workspace->layer != NULL && rate > 0)
        layer.modulus_ratio = wt_friction_layer_ratio(contact->workspace, rate);
    return layer;
}

void sliding_contact_clear(sliding_contact *contact)
{
    if (contact->workspace != NULL)
        cost_add_nodes(contact->cost, friction_node_count(contact->workspace));
    wt_friction_workspace_free(contact->workspace);
    wt_roughness_free(contact->roughness);
    if (!contact->shared)
        wt_material_free(contact->material);
    *contact = (sliding_contact){0};
}
