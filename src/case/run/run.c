/* Runs a case: the stages of the plan in order, their cost, their failures and the tables of the
 * result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer.h"
#include "case/run/stage_functions.h"
#include "core/base/array.h"
#include "core/base/param.h"
#include "core/table/registry.h"
#include "friction/material_cache.h"
#include "job/cost.h"
#include "job/inputs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool is_case_param(const wt_params *params, const char *name, size_t length)
{
    for (size_t i = 0; i < wt_params_count(params); i++) {
        const wt_param *p = wt_params_get(params, i);
        if ((p->flags & PARAM_NO_CASE) == 0 && strlen(p->name) == length &&
            strncmp(p->name, name, length) == 0)
            return true;
    }
    return false;
}

/* Extends advice that names an option by the spelling in a case file. The options are cleared, so
 * that an error that is passed on is extended once. */
static void flow_add_case_advice(wt_error *failure)
{
    char name[sizeof failure->options], hint[96] = "";
    memcpy(name, failure->options, sizeof name);
    const size_t length = strcspn(name, " "), end = strlen(failure->advice);
    failure->options[0] = '\0';
    if (is_case_param(wt_read_params(), name, length))
        snprintf(hint, sizeof hint,
                 " (in a case: the attribute %.*s=\"...\" where the file is named)", (int)length,
                 name);
    else if (is_case_param(wt_master_job_params(), name, length))
        snprintf(hint, sizeof hint, " (in a case: <%.*s> in <dma>)", (int)length, name);
    if (strlen(hint) < sizeof failure->advice - end) /* truncated advice would be misleading */
        memcpy(failure->advice + end, hint, strlen(hint) + 1);
}

wt_run_options wt_run_defaults(void)
{
    const wt_job job = wt_job_defaults();
    return (wt_run_options){.tolerance = job.tolerance,
                            .seed = job.seed,
                            .replicates = job.replicates,
                            .precision = wt_accuracy_job_defaults()};
}

static const wt_param rows[] = {JOB_ROWS(wt_run_options)};
PARAM_TABLE(wt_run_params, wt_run_options, rows, wt_run_defaults, NO_PARTS)

/* State of a run. */
typedef struct run_execution {
    flow_run run;
    flow_resource_set available;
    wt_status failure; /* status of the last stage that failed */
    wt_formats *formats;
    wt_log *own_log;
    wt_result *result;
    wt_table *failures;
    wt_cost *cost;
    wt_material_cache *drawn;
    wt_sweep dma;
    flow_kept *kept; /* NULL: nothing is kept */
} run_execution;

/* ---- what is kept from an earlier run ---------------------------------------------------------
 */

void flow_kept_clear(flow_kept *kept)
{
    wt_rubber_clear(&kept->rubber);
    wt_surface_clear(&kept->surface);
    *kept = (flow_kept){0};
}

/* Takes what a stage would compute. False if it is not kept, or if a table of the stage is
 * required.
 */
static bool take_kept(run_execution *d, size_t stage)
{
    flow_kept *kept = d->kept;
    if (kept == NULL || (flow_stages[stage].outputs & d->run.plan.required & FLOW_TABLES) != 0)
        return false;
    if (stage == FLOW_STAGE_MASTER_CURVE && kept->has_rubber) {
        d->run.rubber = kept->rubber;
        kept->rubber = (wt_rubber){0};
        flow_run_set_direction(&d->run);
        return true;
    }
    if (stage == FLOW_STAGE_TOPOGRAPHY && kept->has_surface) {
        d->run.surface = kept->surface;
        kept->surface = (wt_surface){0};
        return true;
    }
    return false;
}

static void keep(run_execution *d)
{
    if (d->kept == NULL)
        return;
    if (d->run.plan.outcome[FLOW_STAGE_MASTER_CURVE] == FLOW_DONE) {
        wt_rubber_clear(&d->kept->rubber);
        d->kept->rubber = d->run.rubber;
        d->kept->has_rubber = true;
        d->run.rubber = (wt_rubber){0};
    }
    if (d->run.plan.outcome[FLOW_STAGE_TOPOGRAPHY] == FLOW_DONE) {
        wt_surface_clear(&d->kept->surface);
        d->kept->surface = d->run.surface;
        d->kept->has_surface = true;
        d->run.surface = (wt_surface){0};
    }
}

/* ---- one stage ------------------------------------------------------------------------------- */

#define STAGE_FUNCTION(id, name, title, needs, any, additions, outputs, step) step,
static wt_status (*const steps[FLOW_N_STAGES])(flow_run *, wt_error *) = {STAGES(STAGE_FUNCTION)};

/* Returns true if a stage that was not chosen must replace a more complete one that did not
 * succeed. */
static bool must_substitute(const run_execution *d, size_t i)
{
    const flow_plan *plan = &d->run.plan;
    flow_resource_set lacking = flow_stages[i].outputs & plan->required & ~d->available;
    if (plan->chosen[i] || lacking == 0 || !flow_stage_can_run(plan, i, 0, d->available))
        return false;
    for (size_t k = 0; k < i; k++)
        if ((plan->outcome[k] == FLOW_FAILED || plan->outcome[k] == FLOW_BLOCKED) &&
            (flow_stages[k].outputs & lacking) != 0)
            return true;
    return false;
}

static wt_status report_stage_progress(const run_execution *d, size_t stage, const char *what,
                                       wt_error *err)
{
    const wt_progress *progress = &d->run.job.progress;
    size_t number = 0, n = 0;
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        n += d->run.plan.chosen[i];
        number += i <= stage && d->run.plan.chosen[i];
    }
    if (progress->report != NULL && !progress->report(progress->user, what, number, n))
        return wt_fail(err, WT_E_CANCELLED, "cancelled");
    return WT_OK;
}

/* Stages that fail for the same reason have one row in the table of failures. */
static bool is_failure_listed(const run_execution *d, const wt_error *failure)
{
    char message[2048];
    wt_error_format(failure, message, sizeof message);
    for (size_t row = 0; row < wt_table_n_rows(d->failures); row++)
        if (wt_text_repeats(message, wt_table_text(d->failures, row, FAILURES_MESSAGE)))
            return true;
    return false;
}

/* A lower level does not help if the data are missing. */
static bool may_retry(const run_execution *d, unsigned level)
{
    return level > 0 && d->failure != WT_E_EMPTY;
}

static wt_status run_stage(run_execution *d, size_t i, unsigned level, const char *because,
                           wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    flow_plan *plan = &d->run.plan;
    char title[160], stage[96], text[384];
    flow_stage_title(i, level, title, sizeof title);
    wt_status status = report_stage_progress(d, i, title, err);
    if (status != WT_OK)
        return status;
    const bool curves = i == FLOW_STAGE_INDENTATION_BULK || i == FLOW_STAGE_INDENTATION_TRACK;
    cost_begin(d->cost, flow_stages[i].id, curves ? COST_INDENTATION : COST_OTHER, because);
    d->run.level = plan->achieved_level[i] = level;
    status = take_kept(d, i) ? WT_OK : steps[i](&d->run, &failure);
    cost_end(d->cost);
    if (status == WT_OK) {
        plan->outcome[i] = FLOW_DONE;
        d->available |= flow_stages[i].outputs & ~plan->unmeasured;
        return WT_OK;
    }
    if (!flow_may_continue(&d->run.job, status)) {
        if (err != NULL)
            *err = failure;
        return status;
    }
    plan->outcome[i] = FLOW_FAILED;
    d->failure = status;
    flow_add_case_advice(&failure);
    wt_error_format(&failure, plan->failure[i], sizeof plan->failure[i]);
    const bool again = may_retry(d, level);
    snprintf(stage, sizeof stage, "stage %s%s%s", flow_stages[i].id, again ? " with " : "",
             again ? flow_stages[i].optional_inputs[level - 1].label : "");
    snprintf(text, sizeof text, "%s, and failed", because);
    cost_set_reason(d->cost, text);
    return is_failure_listed(d, &failure) ? WT_OK
                                          : flow_add_failure(&d->run.job, stage, &failure, err);
}

/* Returns true if a missing input of the stage is not in the files. */
static bool lacks_measured_data(const run_execution *d, size_t i, unsigned level)
{
    const flow_plan *plan = &d->run.plan;
    return (flow_plan_needs(plan, i, level) & ~d->available & plan->unmeasured) != 0;
}

/* Runs a stage at the highest possible level. If it fails, the next lower level is tried. */
static wt_status run_fullest_level(run_execution *d, size_t i, const char *because, wt_error *err)
{
    flow_plan *plan = &d->run.plan;
    unsigned level = plan->level[i];
    char text[384];
    while (level > 0 && !flow_stage_can_run(plan, i, level, d->available))
        level--;
    if (level < plan->level[i]) {
        const bool unmeasured = lacks_measured_data(d, i, level + 1);
        plan->full_outcome[i] = unmeasured ? FLOW_UNMEASURED : FLOW_BLOCKED;
        snprintf(text, sizeof text, "%s; without %s, %s%s", because,
                 flow_stages[i].optional_inputs[level].label,
                 unmeasured ? "for " : "which a stage before did not give",
                 unmeasured ? plan->unmeasured_reason : "");
    } else
        snprintf(text, sizeof text, "%s", because);
    wt_status status = run_stage(d, i, level, text, err);
    while (status == WT_OK && plan->outcome[i] == FLOW_FAILED && may_retry(d, level)) {
        plan->full_outcome[i] = FLOW_FAILED;
        level--;
        snprintf(text, sizeof text, "runs because it did not succeed with %s",
                 flow_stages[i].optional_inputs[level].label);
        status = run_stage(d, i, level, text, err);
    }
    return status;
}

static wt_status process_stage(run_execution *d, size_t i, wt_error *err)
{
    flow_plan *plan = &d->run.plan;
    char missing[160], because[FLOW_REASON_SIZE];
    flow_plan_reason(plan, i, because, sizeof because);
    if (must_substitute(d, i))
        return run_fullest_level(d, i, "runs because the stage that gives more did not succeed",
                                 err);
    if (!plan->chosen[i]) {
        cost_skip_stage(d->cost, flow_stages[i].id, because);
        return WT_OK;
    }
    if (flow_stage_can_run(plan, i, 0, d->available))
        return run_fullest_level(d, i, because, err);
    if (lacks_measured_data(d, i, 0)) {
        plan->outcome[i] = FLOW_UNMEASURED;
        plan->unmeasured |= flow_stages[i].outputs & ~d->available;
        snprintf(because, sizeof because, "left out because %s", plan->unmeasured_reason);
    } else {
        plan->outcome[i] = FLOW_BLOCKED;
        const flow_resource_set needs = flow_plan_needs(plan, i, 0) | flow_stages[i].alternatives;
        flow_resources_list(needs & ~d->available, missing, sizeof missing);
        snprintf(because, sizeof because, "left out because a stage before failed to give its %s",
                 missing);
    }
    cost_skip_stage(d->cost, flow_stages[i].id, because);
    return WT_OK;
}

/* ---- tables ---------------------------------------------------------------------------------- */

/* Moves a table into the result. */
static wt_status publish_table(run_execution *d, wt_table **table, wt_error *err)
{
    if (*table == NULL)
        return WT_OK;
    wt_table *taken = *table;
    *table = NULL;
    return wt_result_add(d->result, taken, err);
}

/* Adds the tables of the stages in the order of their declaration. Tables that are not required
 * stay out of the result. */
static wt_status publish_stages(run_execution *d, wt_error *err)
{
    flow_run *r = &d->run;
    const flow_resource_set curves = FLOW_BIT(FLOW_CURVE_BULK) | FLOW_BIT(FLOW_CURVE_TRACK);
    const flow_resource_set fits =
        FLOW_BIT(FLOW_INDENTATION_BULK) | FLOW_BIT(FLOW_INDENTATION_TRACK);
    const struct {
        const table_schema *schema;
        flow_resource_set resources;
        wt_table **table;
    } of_both[] = {{&overrides_schema, fits, &r->curves.choices},
                   {&curves_schema, fits, &r->curves.curves},
                   {&force_displacement_schema, curves, &r->curves.force_displacement},
                   {&force_indentation_schema, curves, &r->curves.force_indentation},
                   {&modulus_depth_schema, FLOW_BIT(FLOW_DEPTH_BULK) | FLOW_BIT(FLOW_DEPTH_TRACK),
                    &r->curves.modulus_depth}};
    wt_status status = WT_OK;
    for (size_t i = 0; i < table_n_schemas; i++) {
        for (unsigned k = FLOW_FIRST_TABLE; status == WT_OK && k < FLOW_FIRST_INNER; k++)
            if (flow_resource_rows[k].schema == table_schemas[i] &&
                (r->plan.required & FLOW_BIT(k)))
                status = publish_table(d, &r->table[k], err);
        for (size_t k = 0; status == WT_OK && k < COUNT_OF(of_both); k++)
            if (of_both[k].schema == table_schemas[i] && (r->plan.required & of_both[k].resources))
                status = publish_table(d, of_both[k].table, err);
    }
    return status;
}

/* Two names for the same bytes count twice in a statistic. */
static void warn_duplicate_inputs(const run_execution *d)
{
    const wt_provenance *p = wt_result_provenance_const(d->result);
    size_t n = wt_provenance_n_inputs(p);
    for (size_t i = 0; i < n; i++) {
        const wt_provenance_input *a = wt_provenance_get_input(p, i);
        for (size_t k = i + 1; k < n; k++) {
            const wt_provenance_input *b = wt_provenance_get_input(p, k);
            const bool again = a->role == b->role && strcmp(a->path, b->path) == 0 &&
                               strcmp(a->group, b->group) == 0;
            if (!again && a->bytes == b->bytes && a->fingerprint == b->fingerprint)
                wt_log_action(d->run.job.log, WT_WARNING, WT_COPIED, 1, NULL, b->path, NULL,
                              "the same bytes as %s (%s and %s)", a->path,
                              wt_provenance_input_role(a), wt_provenance_input_role(b));
        }
    }
}

static wt_status finish_result(run_execution *d, wt_error *err)
{
    wt_table *answer = NULL, *limits = NULL, *inputs = NULL, *methods = NULL, *quality = NULL,
             *notes = NULL, *cost = NULL;
    wt_table **const last[] = {&answer,  &limits, &inputs,      &methods,
                               &quality, &notes,  &d->failures, &cost};
    const wt_provenance *provenance = wt_result_provenance_const(d->result);
    warn_duplicate_inputs(d);
    wt_status status = publish_stages(d, err);
    if (status == WT_OK && wt_table_n_rows(d->failures) > 0)
        status = wt_failures_set_status(
            d->failures, wt_result_n_tables(d->result) > 0 ? WT_RESULT_PARTIAL : WT_RESULT_EMPTY,
            err);
    if (status == WT_OK)
        status = flow_answer(d->run.c, &d->run.plan, d->result, d->failures, &answer, &limits, err);
    if (status == WT_OK)
        wt_result_log_remarks(d->result, d->run.job.log);
    if (status == WT_OK)
        status = wt_provenance_table(provenance, "inputs", &inputs, err);
    if (status == WT_OK)
        status = wt_methods_table(d->result, &methods, err);
    if (status == WT_OK)
        status = wt_data_quality_table(d->run.job.log, d->run.c->folder, &quality, err);
    if (status == WT_OK)
        status = wt_notes_table(d->run.job.log, d->run.c->folder, &notes, err);
    if (status == WT_OK)
        status = wt_cost_table(d->cost, &cost, err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(last); i++)
        status = publish_table(d, last[i], err);
    for (size_t i = 0; i < COUNT_OF(last); i++) {
        wt_table_free(*last[i]);
        *last[i] = NULL;
    }
    return status;
}

/* ---- the run --------------------------------------------------------------------------------- */

/* Returns true if a stage uses Monte Carlo draws of the material. */
static bool needs_material_draws(const flow_plan *plan, size_t replicates)
{
    const flow_resource_set compared = FLOW_BIT(FLOW_COMPARISON) | FLOW_BIT(FLOW_DMA_COMPARISON);
    const flow_resource_set replicated =
        FLOW_BIT(FLOW_LAYER) | FLOW_BIT(FLOW_FRICTION) | FLOW_BIT(FLOW_ERROR_BUDGET);
    const flow_resource_set drawn = compared | (replicates >= 2 ? replicated : 0);
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        if (plan->chosen[i] &&
            (flow_plan_needs(plan, i, plan->level[i]) & FLOW_BIT(FLOW_RUBBER)) != 0 &&
            (flow_stages[i].outputs & drawn) != 0)
            return true;
    return false;
}

/* Returns true if several stages read the DMA files. */
static bool is_dma_shared(const flow_plan *plan)
{
    size_t n = 0;
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        n += plan->chosen[i] && (flow_plan_needs(plan, i, 0) & FLOW_BIT(FLOW_DMA_FILES)) != 0;
    return n > 1;
}

/* Returns the optional outputs that no required table needs. */
static unsigned find_excluded_outputs(const flow_plan *plan, const wt_run_options *options)
{
    static const struct {
        unsigned extra;
        flow_resource_set shown_in;
    } extras[] = {
        {WT_EXTRA_EXTRAPOLATED_SHARE, FLOW_BIT(FLOW_FRICTION)},
        {WT_EXTRA_MODULUS_DEPTH, FLOW_BIT(FLOW_DEPTH_BULK) | FLOW_BIT(FLOW_DEPTH_TRACK)},
        {WT_EXTRA_DEPTH_CURVES, FLOW_BIT(FLOW_TRACK_LAYER)},
        {WT_EXTRA_DRAWS, FLOW_BIT(FLOW_MATERIAL_DRAWS) | FLOW_BIT(FLOW_SERIES_DRAWS)},
        {WT_EXTRA_MASTER_CURVE, FLOW_BIT(FLOW_MASTER_CURVE)},
        {WT_EXTRA_SPECTRUM, FLOW_BIT(FLOW_RELAXATION_SPECTRUM)},
        {WT_EXTRA_REDUCED_SERIES, FLOW_BIT(FLOW_PRONY_REDUCED)},
        {WT_EXTRA_INFLUENCES, FLOW_BIT(FLOW_INFLUENCES)},
        {WT_EXTRA_SYSTEMATIC_ERRORS, FLOW_BIT(FLOW_MODULUS_BUDGET) | FLOW_BIT(FLOW_MODULUS_GROUPS) |
                                         FLOW_BIT(FLOW_COMPARISON) | FLOW_BIT(FLOW_MODULUS_RATIO)},
        {WT_EXTRA_TRANSITION, FLOW_BIT(FLOW_GLASS_TRANSITION)}};
    unsigned left_out = options->no_provenance ? WT_EXTRA_DIGESTS : 0;
    for (size_t i = 0; i < COUNT_OF(extras); i++)
        if ((plan->required & extras[i].shown_in) == 0)
            left_out |= extras[i].extra;
    if (needs_material_draws(plan, options->replicates))
        left_out &= ~(unsigned)WT_EXTRA_DRAWS;
    return left_out;
}

static void add_case_input(run_execution *d)
{
    const wt_case *c = d->run.c;
    wt_provenance_input input = {.path = wt_path_base(c->path),
                                 .role = WT_ROLE_CASE,
                                 .format = "weartrack-case 1",
                                 .bytes = c->xml_length};
    if (!d->run.no_provenance)
        wt_sha256(c->xml, c->xml_length, input.sha256);
    wt_provenance_add_input(d->run.job.provenance, &input);
    wt_result_set_case(d->result, c->xml, c->xml_length);
}

static wt_status prepare_execution(run_execution *d, const wt_run_options *options, wt_log *log,
                                   wt_error *err)
{
    if (log == NULL)
        log = d->own_log = wt_log_new();
    d->run.no_provenance = options->no_provenance;
    d->run.precision = options->precision;
    d->result = wt_result_new();
    d->failures = wt_failures_new();
    d->cost = wt_cost_new(!options->no_provenance, options->threads);
    d->drawn = material_cache_new();
    wt_status status = wt_formats_new(options->formats, &d->formats, log, err);
    if (status == WT_OK)
        status = wt_formats_add_columns(d->formats, options->columns, options->n_columns, err);
    d->run.job = (wt_job){
        .formats = d->formats,
        .threads = options->threads,
        .tolerance = options->tolerance,
        .seed = options->seed,
        .replicates = options->replicates,
        .progress = options->progress,
        .log = log,
        .provenance = wt_result_provenance(d->result),
        .failures = d->failures,
        .cost = d->cost,
        .drawn = d->drawn,
    };
    add_case_input(d);
    return status;
}

wt_status wt_run_case(const wt_case *c, const wt_run_options *options, wt_log *log,
                      wt_result **result, size_t *n_failed, wt_error *err)
{
    return flow_run_case(c, options, NULL, log, result, n_failed, err);
}

wt_status flow_run_case(const wt_case *c, const wt_run_options *options, flow_kept *kept,
                        wt_log *log, wt_result **result, size_t *n_failed, wt_error *err)
{
    if (c == NULL || result == NULL)
        return wt_fail(err, WT_E_ARG, "no case");
    wt_run_options defaults = wt_run_defaults();
    run_execution d = {.run = {.c = c, .layer = c->layer}, .kept = kept};
    if (options == NULL)
        options = &defaults;
    wt_status status = param_check(wt_run_params(), options, err);
    if (status == WT_OK)
        status = prepare_execution(&d, options, log, err);
    if (status == WT_OK) {
        flow_plan_create(c, &d.run.plan);
        d.run.job.dma = is_dma_shared(&d.run.plan) ? &d.dma : NULL;
        d.run.job.case_advice = flow_add_case_advice;
        d.run.job.left_out = find_excluded_outputs(&d.run.plan, options);
        d.available = d.run.plan.sources;
    }
    for (size_t i = 0; status == WT_OK && i < FLOW_N_STAGES; i++)
        status = process_stage(&d, i, err);
    const size_t failed = status == WT_OK ? wt_table_n_rows(d.failures) : 0;
    if (status == WT_OK)
        status = finish_result(&d, err);
    if (status == WT_OK) {
        *result = d.result;
        d.result = NULL;
        if (n_failed != NULL)
            *n_failed = failed;
    }
    keep(&d);
    flow_run_clear(&d.run);
    wt_formats_free(d.formats);
    wt_result_free(d.result);
    wt_table_free(d.failures);
    wt_cost_free(d.cost);
    material_cache_free(d.drawn);
    wt_sweep_clear(&d.dma);
    wt_log_free(d.own_log);
    return status;
}
