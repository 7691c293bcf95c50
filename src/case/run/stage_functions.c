/* Functions of the stages. Each takes its inputs from the case and from earlier stages, and runs
 * one job. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/run/stage_functions.h"
#include "core/table/registry.h"
#include "job/cost.h"
#include "record/record.h"

#include <math.h>

void flow_run_clear(flow_run *run)
{
    for (size_t i = 0; i < FLOW_N_RESOURCES; i++)
        wt_table_free(run->table[i]);
    wt_indent_tables_clear(&run->curves);
    wt_rubber_clear(&run->rubber);
    wt_surface_clear(&run->surface);
    wt_strain_softening_clear(&run->strain_softening);
    *run = (flow_run){0};
}

/* Moves a table into the run. A table from an earlier attempt is freed. */
static void flow_run_store_table(flow_run *run, flow_resource resource, wt_table **table)
{
    wt_table_free(run->table[resource]);
    run->table[resource] = *table;
    *table = NULL;
}

/* Reports the number of rows as the cost of a stage whose job reports none. */
static void report_row_count(const flow_run *run, const wt_table *table)
{
    cost_report(&run->job, (cost_summary){.items = (double)wt_table_n_rows(table)});
}

/* ---- indentation ----------------------------------------------------------------------------- */

/* Returns the temperature at which a group was indented. */
static wt_estimate indentation_temperature_of_group(const wt_case *c, int g)
{
    const wt_compare_job *job = &c->compare;
    return g > 0 && !isnan(job->track_temperature.value) ? job->track_temperature
                                                         : job->temperature;
}

wt_indent_job flow_group_job(const flow_run *run, int g)
{
    static const flow_resource curve[2] = {FLOW_CURVE_BULK, FLOW_CURVE_TRACK};
    static const char *const names[2] = {"bulk", "track"};
    const case_files *files = g == 0 ? &run->c->bulk : &run->c->track;
    wt_indent_job job = run->c->indent;
    job.group = names[g];
    job.sets = files->sets;
    job.n_sets = files->n;
    job.spring_constant = files->spring_constant;
    job.sensitivity = files->sensitivity;
    job.lever_error = files->lever_error > 0 ? files->lever_error : run->c->compare.lever_error;
    job.sensitivity_error =
        files->sensitivity_error > 0 ? files->sensitivity_error : run->c->compare.sensitivity_error;
    job.rates =
        (run->plan.required & (FLOW_BIT(FLOW_MODULUS_RATE) | FLOW_BIT(FLOW_DMA_COMPARISON))) != 0;
    job.median_curve = (run->plan.wanted & FLOW_BIT(curve[g])) != 0;
    job.rubber = run->level > 0 ? &run->rubber : NULL;
    job.temperature = indentation_temperature_of_group(run->c, g);
    return job;
}

static wt_status indent_group(flow_run *run, int g, wt_error *err)
{
    const wt_indent_job job = flow_group_job(run, g);
    wt_status status = wt_indent_group(&job, &run->job, &run->curves, err);
    flow_run_store_table(run, g == 0 ? FLOW_INDENTATION_BULK : FLOW_INDENTATION_TRACK,
                         &run->curves.indentation);
    return status;
}

wt_status flow_step_bulk(flow_run *run, wt_error *err)
{
    return indent_group(run, 0, err);
}

wt_status flow_step_track(flow_run *run, wt_error *err)
{
    return indent_group(run, 1, err);
}

/* ---- comparison ------------------------------------------------------------------------------ */

static wt_status compare_case_groups(flow_run *run, bool groups_only, wt_error *err)
{
    wt_compare_tables tables = {0};
    wt_compare_job job = run->c->compare;
    job.bulk = run->table[FLOW_INDENTATION_BULK];
    job.track = run->table[FLOW_INDENTATION_TRACK];
    job.rates = (run->plan.required & FLOW_BIT(FLOW_MODULUS_RATE)) != 0;
    job.groups_only = groups_only;
    job.rubber = run->level > 0 ? &run->rubber : NULL;
    wt_status status = wt_compare_groups(&job, &run->job, &tables, err);
    if (status == WT_OK)
        report_row_count(run, tables.modulus_groups);
    flow_run_store_table(run, FLOW_MODULUS_GROUPS, &tables.modulus_groups);
    flow_run_store_table(run, FLOW_MODULUS_BUDGET, &tables.modulus_budget);
    flow_run_store_table(run, FLOW_COMPARISON, &tables.comparison);
    flow_run_store_table(run, FLOW_MODULUS_RATE, &tables.modulus_rate);
    wt_tables_clear(&tables,
                    sizeof tables); /* The stage of the DMA comparison creates its own tables. */
    return status;
}

wt_status flow_step_compare(flow_run *run, wt_error *err)
{
    table_view comparison;
    wt_status status = compare_case_groups(run, false, err);
    if (status == WT_OK)
        status = table_bind(run->table[FLOW_COMPARISON], &comparison_schema, "", &comparison, err);
    if (status != WT_OK)
        return status;
    run->modulus_ratio = comparison_value(&comparison, COMPARISON_KEY_MODULUS_RATIO);
    run->modulus_ratio.unit = "1"; /* replaces the unit of the table, which is freed */
    const double df = comparison_value(&comparison, COMPARISON_KEY_MODULUS_RATIO_DF).value;
    run->modulus_ratio_df = isnan(df) ? 0 : df;
    const double share = comparison_value(&comparison, COMPARISON_KEY_CALIBRATION_SHARE).value;
    run->calibration_share = isnan(share) ? 0 : share;
    cost_report(&run->job, (cost_summary){.items = 2, .number = run->modulus_ratio});
    return WT_OK;
}

/* The stage runs with the groups that are available. */
wt_status flow_step_groups(flow_run *run, wt_error *err)
{
    return compare_case_groups(run, true, err);
}

wt_status flow_step_dma_comparison(flow_run *run, wt_error *err)
{
    wt_compare_tables tables = {0};
    wt_compare_job job = run->c->compare;
    job.bulk = run->table[FLOW_INDENTATION_BULK];
    job.track = run->table[FLOW_INDENTATION_TRACK];
    job.rubber = &run->rubber;
    job.groups_only = true;
    /* The comparison stage has already reported the warnings of the comparison. */
    wt_job quiet = run->job;
    quiet.log = NULL;
    wt_status status = wt_compare_groups(&job, &quiet, &tables, err);
    if (status == WT_OK && tables.dma_comparison == NULL)
        status =
            wt_fail(err, WT_E_MISSING,
                    "the curves have no indentation rate, so no frequency corresponds to them");
    if (status == WT_OK) {
        report_row_count(run, tables.dma_comparison);
        flow_run_store_table(run, FLOW_DMA_COMPARISON, &tables.dma_comparison);
    }
    wt_tables_clear(&tables, sizeof tables);
    return status;
}

wt_status flow_step_given_ratio(flow_run *run, wt_error *err)
{
    (void)err;
    run->modulus_ratio = run->c->layer_observation.modulus_ratio;
    run->modulus_ratio_df = run->c->layer_observation.modulus_ratio_df;
    cost_report(&run->job, (cost_summary){.items = 1, .number = run->modulus_ratio});
    return WT_OK;
}

/* ---- material -------------------------------------------------------------------------------- */

/* Computes the master curve from the DMA files of a case. */
static wt_status read_master(const wt_case *c, const wt_job *work, wt_master_tables *tables,
                             wt_rubber *rubber, wt_error *err)
{
    wt_master_job job = c->master;
    job.sets = c->dma.sets;
    job.n_sets = c->dma.n;
    return wt_master_compute(&job, work, tables, rubber, err);
}

wt_status flow_step_master(flow_run *run, wt_error *err)
{
    wt_master_tables tables = {0};
    const wt_status status = read_master(run->c, &run->job, &tables, &run->rubber, err);
    flow_run_set_direction(run);
    flow_run_store_table(run, FLOW_SHIFT_FACTORS, &tables.shift_factors);
    flow_run_store_table(run, FLOW_MASTER_CURVE, &tables.master_curve);
    flow_run_store_table(run, FLOW_PRONY, &tables.prony);
    flow_run_store_table(run, FLOW_PRONY_REDUCED, &tables.prony_reduced);
    flow_run_store_table(run, FLOW_RELAXATION_SPECTRUM, &tables.relaxation_spectrum);
    flow_run_store_table(run, FLOW_INFLUENCES, &tables.influences);
    flow_run_store_table(run, FLOW_MATERIAL_DRAWS, &tables.material_draws);
    flow_run_store_table(run, FLOW_SERIES_DRAWS, &tables.series_draws);
    wt_master_tables_clear(&tables); /* the remaining members belong to the fit */
    return status;
}

wt_status flow_step_ramp(flow_run *run, wt_error *err)
{
    wt_ramp_tables tables = {0};
    wt_ramp_job job = run->c->ramp;
    wt_job work = run->job;
    if ((run->plan.wanted & FLOW_BIT(FLOW_MODULI_AT)) != 0 && job.n_temperatures == 0) {
        wt_fail(err, WT_E_MISSING, "no temperatures at which the moduli are asked for");
        wt_error_expected(err, "<at> in <dma>, such as 25degC,60degC");
        return WT_E_MISSING;
    }
    if ((run->plan.required & FLOW_BIT(FLOW_MODULI_AT)) == 0)
        job.n_temperatures = 0;
    job.sets = run->c->dma.sets;
    job.n_sets = run->c->dma.n;
    wt_table *again = NULL;
    if (run->plan.chosen[FLOW_STAGE_MASTER_CURVE]) {
        work.log = NULL;
        work.provenance = NULL;
        work.failures = again = wt_failures_new();
    }
    const wt_status status = wt_ramp_compute(&job, &work, &tables, err);
    wt_table_free(again);
    flow_run_store_table(run, FLOW_RAMP, &tables.ramp);
    flow_run_store_table(run, FLOW_GLASS_TRANSITION, &tables.glass_transition);
    flow_run_store_table(run, FLOW_MODULI_AT, &tables.moduli_at);
    return status;
}

wt_status flow_step_payne(flow_run *run, wt_error *err)
{
    wt_payne_tables tables = {0};
    wt_payne_job job = wt_payne_job_defaults();
    job.sets = run->c->dma.sets;
    job.n_sets = run->c->dma.n;
    const wt_status status = wt_payne_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_PAYNE, &tables.payne);
    flow_run_store_table(run, FLOW_PAYNE_SWEEP, &tables.payne_sweep);
    return status;
}

/* ---- records --------------------------------------------------------------------------------- */

static wt_status run_record_job(flow_run *run, wt_record_job job, wt_error *err)
{
    wt_record_tables tables = {0};
    job.sets = run->c->record.sets;
    job.n_sets = run->c->record.n;
    const wt_status status = wt_record_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_RECORD, &tables.record);
    flow_run_store_table(run, FLOW_RECORD_CYCLES, &tables.record_cycles);
    flow_run_store_table(run, FLOW_WEAR, &tables.wear);
    return status;
}

/* Returns true if the case lists a result that requires the wear. */
static bool is_wear_required(const flow_run *run)
{
    flow_resource_set resting = FLOW_BIT(FLOW_WEAR);
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        if (run->plan.chosen[i] && (flow_plan_needs(&run->plan, i, 0) & FLOW_BIT(FLOW_WEAR)) != 0)
            resting |= flow_stages[i].outputs;
    return run->c->has_requests && !run->c->is_explicit_request &&
           (run->c->requested & resting) != 0;
}

/* Records without wear still have friction. What depends on the wear is excluded. */
static wt_status exclude_wear(flow_run *run, const char *lacks, wt_error *err)
{
    static const char advice[] = "give <profile>, <track-area> or <mass-loss> in <record>, or "
                                 "<specific-wear-rate> in <layer>";
    if (is_wear_required(run)) {
        wt_fail(err, WT_E_MISSING, "%s", lacks);
        wt_error_advice(err, "%s", advice);
        return WT_E_MISSING;
    }
    run->plan.unmeasured |= FLOW_BIT(FLOW_WEAR);
    snprintf(run->plan.unmeasured_reason, sizeof run->plan.unmeasured_reason, "%s; %s", lacks,
             advice);
    wt_log_add(run->job.log, WT_WARNING, NULL, NULL, "the layer is left out, for %s",
               run->plan.unmeasured_reason);
    return WT_OK;
}

wt_status flow_step_wear(flow_run *run, wt_error *err)
{
    const wt_status status = run_record_job(run, run->c->records, err);
    wt_estimate measured;
    if (status != WT_OK)
        return status;
    if (run->table[FLOW_WEAR] == NULL)
        return exclude_wear(run, "the records contain nothing about the wear", err);
    if (!isnan(run->layer.specific_wear_rate.value) || !run->c->has_layer)
        return WT_OK;
    if (!wt_table_estimate(run->table[FLOW_WEAR], "specific_wear_rate", &measured) ||
        isnan(measured.value))
        return exclude_wear(run, "the records give no wear rate; the table wear says why", err);
    run->layer.specific_wear_rate = measured;
    return WT_OK;
}

wt_status flow_step_record(flow_run *run, wt_error *err)
{
    return run_record_job(run, wear_without_inputs(run->c->records), err);
}

/* ---- friction and layer ---------------------------------------------------------------------- */

wt_sliding flow_run_sliding(const flow_run *run)
{
    wt_sliding sliding = run->c->sliding;
    sliding.rubber = &run->rubber;
    sliding.surface = &run->surface;
    if (isnan(sliding.reference_velocity))
        sliding.reference_velocity = run->c->layer.velocity;
    sliding.strain_softening = run->strain_softening.table.n > 0 ? &run->strain_softening : NULL;
    return sliding;
}

wt_status flow_step_layer(flow_run *run, wt_error *err)
{
    wt_sliding sliding = flow_run_sliding(run);
    wt_layer_tables tables = {0};
    wt_status status = wt_layer_thickness_compute(&sliding, &run->layer, &run->job, &tables, err);
    if (status != WT_OK)
        return status;
    run->thickness = tables.thickness;
    flow_run_store_table(run, FLOW_LAYER, &tables.layer);
    return WT_OK;
}

wt_status flow_step_track_layer(flow_run *run, wt_error *err)
{
    wt_compare_job job = run->c->compare;
    job.bulk = run->table[FLOW_INDENTATION_BULK];
    job.track = run->table[FLOW_INDENTATION_TRACK];
    job.rubber = (run->plan.achieved_level[FLOW_STAGE_COMPARISON] > 0) ? &run->rubber : NULL;
    const wt_status status =
        wt_track_layer_compute(&job, run->level > 0 ? run->table[FLOW_LAYER] : NULL, &run->job,
                               &run->table[FLOW_TRACK_LAYER], err);
    if (status == WT_OK && run->table[FLOW_TRACK_LAYER] != NULL)
        report_row_count(run, run->table[FLOW_TRACK_LAYER]);
    return status;
}

wt_status flow_step_energy_density(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_energy_density_compute(&sliding, &run->layer, &run->job,
                                     &run->table[FLOW_ENERGY_DENSITY], err);
}

static wt_status flow_run_layer_observation(const flow_run *run, wt_layer_observation *observation,
                                            wt_error *err)
{
    *observation = run->c->layer_observation;
    observation->thickness = run->thickness;
    observation->modulus_ratio = run->modulus_ratio;
    observation->modulus_ratio_df = run->modulus_ratio_df;
    observation->calibration_share = run->calibration_share;
    if (!isnan(observation->modulus_ratio.value) && observation->by_rate) {
        if (isnan(observation->ratio_temperature))
            observation->ratio_temperature = run->c->compare.temperature.value;
        return wt_layer_observation_from_rates(run->table[FLOW_COMPARISON],
                                               run->table[FLOW_MODULUS_RATE], observation, err);
    }
    if (!isnan(observation->modulus_ratio.value))
        return WT_OK;
    wt_fail(err, WT_E_MISSING, "the modulus ratio of track and bulk is not known");
    wt_error_advice(err, "the table comparison says why, and how to decide it; or give the "
                         "ratio as modulus-ratio of the layer");
    return WT_E_MISSING;
}

wt_status flow_step_contact_area(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_contact_area_compute(&sliding, &run->job, &run->table[FLOW_CONTACT_AREA], err);
}

/* The layer of a stage whose only optional input is the layer: NULL at level 0. */
static wt_status load_optional_layer(const flow_run *run, wt_layer_observation *storage,
                                     const wt_layer_observation **layer, wt_error *err)
{
    *layer = run->level > 0 ? storage : NULL;
    return run->level > 0 ? flow_run_layer_observation(run, storage, err) : WT_OK;
}

wt_status flow_step_friction(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    const wt_layer_observation *layer;
    wt_layer_observation storage;
    wt_friction_tables tables = {0};
    wt_status status = load_optional_layer(run, &storage, &layer, err);
    if (status == WT_OK)
        status = wt_sliding_friction_compute(&sliding, layer, &run->job, &tables, err);
    if (status == WT_OK)
        flow_run_store_table(run, FLOW_FRICTION, &tables.friction);
    return status;
}

wt_status flow_step_directions(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_transverse_isotropy_compute(&sliding, &run->job,
                                          &run->table[FLOW_TRANSVERSE_ISOTROPY], err);
}

wt_status flow_step_softening_effect(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_softened_friction_compute(&sliding, &run->job, &run->table[FLOW_SOFTENING_EFFECT],
                                        err);
}

wt_status flow_step_friction_decades(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_friction_by_scale_compute(&sliding, &run->job, &run->table[FLOW_FRICTION_DECADES],
                                        err);
}

wt_status flow_step_flash_effect(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_flash_temperature_compute(&sliding, &run->job, &run->table[FLOW_FLASH_EFFECT], err);
}

/* ---- what if, error budget, error against run time ---------------------------------------- */

/* Optional inputs of a stage beyond friction: the layer at level 1, then its observations at level
 * 2. */
typedef struct layer_inputs {
    const wt_layer_job *layer;               /* NULL at level 0 */
    const wt_layer_observation *observation; /* NULL below level 2 */
    wt_layer_observation storage;
} layer_inputs;

static wt_status load_layer_inputs(const flow_run *run, layer_inputs *parts, wt_error *err)
{
    *parts = (layer_inputs){.layer = run->level > 0 ? &run->layer : NULL};
    if (run->level < 2)
        return WT_OK;
    parts->observation = &parts->storage;
    return flow_run_layer_observation(run, &parts->storage, err);
}

wt_status flow_step_what_if(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    layer_inputs parts;
    const wt_status status = load_layer_inputs(run, &parts, err);
    return status == WT_OK ? wt_model_sensitivity_compute(&sliding, parts.layer, parts.observation,
                                                          &run->job, &run->table[FLOW_WHAT_IF], err)
                           : status;
}

wt_status flow_step_budget(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    layer_inputs parts;
    const wt_status status = load_layer_inputs(run, &parts, err);
    return status == WT_OK ? wt_error_budget_compute(&sliding, parts.layer, parts.observation,
                                                     run->table[FLOW_WHAT_IF], &run->job,
                                                     &run->table[FLOW_ERROR_BUDGET], err)
                           : status;
}

wt_status flow_step_precision(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    layer_inputs parts;
    const wt_status status = load_layer_inputs(run, &parts, err);
    return status == WT_OK ? wt_case_precision_compute(&sliding, parts.layer, parts.observation,
                                                       &run->precision, &run->job,
                                                       &run->table[FLOW_WORK_PRECISION], err)
                           : status;
}

/* ---- comparison with the records ------------------------------------------------------------- */

wt_status flow_step_validation(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_observation layer;
    wt_validation_tables tables = {0};
    wt_validation_job job = run->c->validation;
    wt_status status = run->level > 0 ? flow_run_layer_observation(run, &layer, err) : WT_OK;
    job.sliding = &sliding;
    job.layer =
        run->c->has_layer && !isnan(run->layer.specific_wear_rate.value) ? &run->layer : NULL;
    job.layer_observation = run->level > 0 ? &layer : NULL;
    job.record = run->table[FLOW_RECORD];
    job.wear = run->table[FLOW_WEAR];
    if (status == WT_OK)
        status = wt_validation_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_VALIDATION, &tables.validation);
    flow_run_store_table(run, FLOW_VALIDATION_SOURCES, &tables.sources);
    return status;
}

wt_status flow_step_validation_running_in(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_observation layer;
    wt_running_in_tables tables = {0};
    wt_validation_job job = run->c->validation;
    wt_status status = flow_run_layer_observation(run, &layer, err);
    job.sliding = &sliding;
    job.layer = &run->layer;
    job.layer_observation = &layer;
    job.record = run->table[FLOW_RECORD];
    job.cycles = run->table[FLOW_RECORD_CYCLES];
    job.wear = run->table[FLOW_WEAR];
    if (status == WT_OK)
        status = wt_running_in_validation_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_VALIDATION_RUNNING_IN, &tables.running_in);
    flow_run_store_table(run, FLOW_VALIDATION_COURSE, &tables.running_in_curve);
    return status;
}

/* The wear rate stated for the identification takes precedence over that of the records. */
wt_status flow_step_identification(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_identify_job job = run->c->identify;
    wt_estimate measured;
    if (run->level > 0 && isnan(job.specific_wear_rate.value) &&
        wt_table_estimate(run->table[FLOW_WEAR], "specific_wear_rate", &measured))
        job.specific_wear_rate = measured;
    return wt_identification_compute(&sliding, &job, &run->job, &run->table[FLOW_IDENTIFICATION],
                                     err);
}
