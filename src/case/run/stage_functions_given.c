/* Stages of a rubber, a counter surface and a softening that the case states.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/run/stage_functions.h"

#include "dma/rubber.h"
#include "friction/counter_surface.h"
#include "job/cost.h"
#include "job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the only file of the role. It borrows *path, which the caller frees with free(). */
static flow_file find_stated_file(const case_files *files, char **path)
{
    const wt_file_set *const set = &files->sets[0];
    *path = wt_path_join(set->folder, set->patterns[0]);
    return (flow_file){.path = *path, .name = set->patterns[0], .set = set};
}

/* ---- material -------------------------------------------------------------------------------- */

static wt_status create_stated_series(const wt_case *c, wt_rubber *rubber)
{
    wt_prony_alloc(&rubber->prony, c->prony.n);
    rubber->prony.deformation = c->prony.deformation;
    rubber->prony.equilibrium_modulus = c->prony.equilibrium_modulus;
    rubber->prony.frequency_min = c->prony.frequency_min;
    rubber->prony.frequency_max = c->prony.frequency_max;
    memcpy(rubber->prony.relaxation_time, c->prony.relaxation_time, c->prony.n * sizeof(double));
    memcpy(rubber->prony.modulus, c->prony.modulus, c->prony.n * sizeof(double));
    rubber->poisson_ratio = c->master.poisson_ratio;
    rubber->temperature_min = rubber->temperature_max = (double)NAN;
    return WT_OK;
}

static wt_status read_stated_points(const wt_case *c, const wt_job *work, wt_rubber *rubber,
                                    wt_error *err)
{
    char *path;
    flow_file file = find_stated_file(&c->points, &path);
    const wt_status status = flow_rubber_read(&file, c->master.poisson_ratio, work, rubber, err);
    free(path);
    return status;
}

/* Creates the stated rubber of a case or of its layer material. */
static wt_status flow_run_create_stated_rubber(const wt_case *c, const wt_job *work,
                                               wt_rubber *rubber, wt_error *err)
{
    const double reference = c->master.fit.reference_temperature;
    wt_status status = c->kind == WT_RUBBER_TABLE ? read_stated_points(c, work, rubber, err)
                       : c->kind == WT_RUBBER_ZENER
                           ? flow_rubber_zener(&c->zener, c->master.poisson_ratio, rubber, err)
                           : create_stated_series(c, rubber);
    if (status != WT_OK)
        return status;
    if (!isnan(reference))
        rubber->prony.reference_temperature = reference;
    rubber->law = (wt_shift_law){.kind = c->has_wlf ? WT_LAW_WLF : WT_LAW_NONE,
                                 .wlf = {reference, c->wlf.c1.value, c->wlf.c2.value}};
    rubber->c1_error = c->wlf.c1.standard_error;
    rubber->c2_error = c->wlf.c2.standard_error;
    return WT_OK;
}

void flow_run_set_direction(flow_run *run)
{
    run->rubber.is_transverse = run->c->is_transverse;
    run->rubber.transverse = run->c->transverse;
}

wt_status flow_step_given_material(flow_run *run, wt_error *err)
{
    const wt_status status = flow_run_create_stated_rubber(run->c, &run->job, &run->rubber, err);
    flow_run_set_direction(run);
    if (status == WT_OK)
        wt_rubber_add_cost(&run->rubber, &run->job);
    return status;
}

/* ---- counter surface ------------------------------------------------------------------------- */

static wt_status measure_surface(const wt_topography_job *job, const wt_job *work,
                                 wt_surface *surface, wt_topography_tables *tables, wt_error *err)
{
    wt_surface measured = {0};
    wt_status status = flow_surface_measure(job, work, &measured, tables, err);
    if (status == WT_OK)
        status = flow_surface_check(&measured, err);
    if (status == WT_OK)
        *surface = measured;
    else
        wt_surface_clear(&measured);
    return status;
}

static wt_status create_stated_surface(const wt_case *c, const wt_job *work, wt_surface *surface,
                                       wt_error *err)
{
    if (c->has_self_affine) {
        *surface = c->surface;
        return WT_OK;
    }
    wt_surface opened = {0};
    if (c->height_maps.n > 0)
        return measure_surface(&c->topography, work, surface, NULL, err);
    char *path;
    flow_file file = find_stated_file(&c->spectrum, &path);
    wt_status status = flow_surface_read(&file, work, &opened, err);
    if (status == WT_OK) {
        opened.q0 = c->surface.q0;
        opened.q1 = c->surface.q1;
        if (c->surface.c0.standard_error > 0)
            opened.c0.standard_error = c->surface.c0.standard_error;
        status = flow_surface_check(&opened, err); /* checks the cut-offs */
    }
    if (status == WT_OK)
        *surface = opened;
    else
        wt_surface_clear(&opened);
    free(path);
    return status;
}

wt_status flow_step_roughness(flow_run *run, wt_error *err)
{
    wt_status status = create_stated_surface(run->c, &run->job, &run->surface, err);
    if (status == WT_OK)
        flow_surface_report_cost(&run->surface, &run->job);
    if (status == WT_OK && (run->plan.required & FLOW_BIT(FLOW_ROUGHNESS)) != 0)
        status = wt_surface_table(&run->surface, &run->table[FLOW_ROUGHNESS], err);
    return status;
}

wt_status flow_step_topography(flow_run *run, wt_error *err)
{
    const flow_resource_set heights = FLOW_BIT(FLOW_HEIGHT_MAP) | FLOW_BIT(FLOW_HEIGHT_PROFILE);
    wt_topography_tables made = {.power_spectrum = NULL};
    wt_topography_job job = run->c->topography;
    job.heights = (run->plan.required & heights) != 0;
    wt_status status = measure_surface(&job, &run->job, &run->surface, &made, err);
    if (status == WT_OK && (run->plan.required & FLOW_BIT(FLOW_ROUGHNESS)) != 0)
        status = wt_surface_table(&run->surface, &run->table[FLOW_ROUGHNESS], err);
    run->table[FLOW_POWER_SPECTRUM] = made.power_spectrum;
    run->table[FLOW_PLACE_ERRORS] = made.place_errors;
    run->table[FLOW_ANGULAR_SPECTRUM] = made.angular_spectrum;
    run->table[FLOW_SURFACES] = made.surfaces;
    run->table[FLOW_HEIGHT_MAP] = made.height_map;
    run->table[FLOW_HEIGHT_PROFILE] = made.height_profile;
    return status;
}

/* ---- softening with strain ------------------------------------------------------------------- */

wt_status flow_step_given_softening(flow_run *run, wt_error *err)
{
    char *path;
    const flow_file file = find_stated_file(&run->c->softening, &path);
    const wt_status status =
        wt_strain_softening_read(path, file.name, wt_strain_softening_choice_defaults(), &run->job,
                                 &run->strain_softening, err);
    if (status == WT_OK)
        cost_report(&run->job, (cost_summary){.items = (double)run->strain_softening.table.n});
    free(path);
    return status;
}

wt_status flow_step_swept_softening(flow_run *run, wt_error *err)
{
    const wt_status status = wt_strain_softening_from_table(run->table[FLOW_PAYNE_SWEEP],
                                                            wt_strain_softening_choice_defaults(),
                                                            &run->strain_softening, err);
    if (status == WT_OK)
        cost_report(&run->job, (cost_summary){.items = (double)run->strain_softening.table.n});
    return status;
}
