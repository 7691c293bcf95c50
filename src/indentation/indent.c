/* Job of the indentation: the curves of a group, their combined results and tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "dma/rubber.h"
#include "indentation/curve_tables.h"
#include "indentation/indent_task.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "job/random_draws.h"

#include "core/base/number.h"
#include "core/table/registry.h"
#include "indentation/numerics/curve.h"
#include "read/force_assembler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of queued curves for each thread. Finished curves wait until all earlier curves are
 * written. */
#define CURVES_PER_WORKER 8
#define MAX_WORKERS 64

/* ---- the representative curve ---------------------------------------------------------------- */

static int compare_moduli(const void *a, const void *b)
{
    const accepted_modulus *x = a, *y = b;
    if (x->modulus < y->modulus || x->modulus > y->modulus)
        return x->modulus < y->modulus ? -1 : 1;
    return x->order < y->order ? -1 : x->order > y->order;
}

/* Reads the representative curve again, with its retract. It has the (lower) median modulus; the
 * first curve counts among equal moduli. */
static wt_status add_representative_curve(indent_task *task, wt_indent_tables *tables,
                                          wt_error *err)
{
    qsort(task->moduli, task->n_moduli, sizeof *task->moduli, compare_moduli);
    const accepted_modulus *median = &task->moduli[(task->n_moduli - 1) / 2];
    const flow_file *file = median->file;
    if (strcmp(file->path, "-") == 0)
        return WT_OK; /* a pipe cannot be read twice */
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve *curve = &task->items[0].curve;
    const wt_read_options options = indent_read_options(task, file, task->options.spectrum != NULL);
    wt_status status = wt_input_open(file->path, &input, err);
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, NULL, &source, err);
    if (status == WT_OK)
        force_seek(source, median->curve);
    while (status == WT_OK) {
        wt_error ignored = WT_ERROR_INIT;
        wt_status next = wt_force_next(source, curve, &ignored);
        if (next == WT_END)
            break;
        if (next != WT_OK || curve->index != median->curve)
            continue;
        wt_indent_fit fit;
        const wt_indent_options fit_options = indent_curve_options(task, &median->choice);
        status = wt_indent_fit_force_curve(task->file_contact, &fit_options, curve,
                                           task->scratch[0], &fit, err);
        if (status == WT_OK)
            status = flow_curve_tables_add(tables, task->job->group, file->name, curve, &fit,
                                           task->file_contact, &fit_options, err);
        break;
    }
    wt_force_close(source);
    wt_input_close(input);
    return status;
}

/* ---- the group ------------------------------------------------------------------------------- */

/* Describes the tips of the group. The text names only a few tips, so that it fits in one line. */
static void describe_tips(const indent_task *task, char *text, size_t size)
{
    enum { MAX_NAMED_TIPS = 3 }; /* each name fills a line of a terminal */
    char tip[256];
    size_t used = 0;
    if (task->n_tips < 2) {
        wt_tip_describe(task->n_tips > 0 ? task->tips[0] : &task->job->tip, text, size);
        return;
    }
    for (size_t i = 0; i < task->n_tips && i < MAX_NAMED_TIPS; i++) {
        wt_tip_describe(task->tips[i], tip, sizeof tip);
        used +=
            (size_t)snprintf(text + used, size - used, "%s%s%s",
                             i == 0 ? tip_form_text(SEVERAL_TIPS) : "", i == 0 ? ": " : "; ", tip);
    }
    if (task->n_tips > MAX_NAMED_TIPS)
        (void)snprintf(text + used, size - used, "; and %zu more", task->n_tips - MAX_NAMED_TIPS);
}

/* Returns the given value. If all curves had another value, returns this value with the relative
 * error of the given one. The files state no error. */
static wt_estimate used_value(wt_estimate given, double low, double high)
{
    const double relative = given.standard_error / given.value;
    if (low >= high && !(low == given.value))
        return (wt_estimate){low, relative * low, 0, given.unit};
    return given;
}

static void set_calibration_keys(const indent_task *task, table_writer *t)
{
    const wt_indent_job *job = task->job;
    wt_estimate k = used_value(job->spring_constant, task->k_low, task->k_high);
    const wt_estimate s = used_value(job->sensitivity, task->s_low, task->s_high);
    if (!(k.standard_error > 0))
        k.standard_error = job->lever_error * k.value;
    if (task->has_given_sensitivity && task->s_low < task->s_high)
        indentation_set_print(t, INDENTATION_KEY_SENSITIVITIES, "%s m/V",
                              format_range(task->s_low, task->s_high, 4).text);
    else if (task->has_given_sensitivity && !isnan(s.value))
        indentation_set(t, INDENTATION_KEY_SENSITIVITY, flow_stated_estimate(s));
    calibration_errors_set_keys(&task->calibration, t);
    if (!isnan(k.value))
        indentation_set(t, INDENTATION_KEY_SPRING_CONSTANT, flow_stated_estimate(k));
    if (task->k_low < task->k_high)
        indentation_set_print(t, INDENTATION_KEY_SPRING_CONSTANTS, "%s N/m",
                              format_range(task->k_low, task->k_high, 4).text);
}

static void set_indentation_keys(const indent_task *task, const flow_files *files, table_writer *t)
{
    const wt_indent_job *job = task->job;
    char tip[1024], range[256];
    size_t n_named = 0;
    for (size_t i = 0; i < files->n; i++)
        n_named += files->file[i].set->spot != NULL;
    const spot_naming spots = n_named == files->n ? SPOTS_NAMED
                              : n_named == 0      ? SPOTS_OF_FILES
                                                  : SPOTS_MIXED;
    describe_tips(task, tip, sizeof tip);
    if (!isnan(job->temperature.value))
        indentation_set(t, INDENTATION_KEY_TEMPERATURE, flow_stated_estimate(job->temperature));
    if (task->options.spectrum != NULL)
        indentation_set_value(t, INDENTATION_KEY_SPECTRUM_TEMPERATURE,
                              task->spectrum.reference_temperature, 0, 0);
    indentation_set_text(t, INDENTATION_KEY_TIP, tip);
    if (task->n_tips < 2)
        indent_set_tip_keys(task->n_tips > 0 ? task->tips[0] : &job->tip, t);
    indentation_set_print(t, INDENTATION_KEY_POISSON_RATIO, "%g", job->options.poisson_ratio);
    if (indent_range_text(&job->options, range, sizeof range))
        indentation_set_text(t, INDENTATION_KEY_FIT_RANGE, range);
    set_calibration_keys(task, t);
    indentation_set_print(t, INDENTATION_KEY_SPOTS, "%s%s", spot_naming_text(spots),
                          spots == SPOTS_NAMED   ? ""
                          : spots == SPOTS_MIXED ? ": some named, the others one for each file"
                                                 : ": each file is a spot, none were named");
    indentation_set_print(t, INDENTATION_KEY_N_USED, "%zu", task->n_accepted);
    indentation_set_print(t, INDENTATION_KEY_N_WIDE, "%zu", task->n_wide);
    indentation_set_print(t, INDENTATION_KEY_N_DOUBTFUL, "%zu", task->n_doubtful);
    indentation_set_print(t, INDENTATION_KEY_N_REJECTED, "%zu", task->n_curves - task->n_accepted);
}

/* Finds the relaxation spectrum of the rubber at the temperature of the curves, if it has one. */
static wt_status find_spectrum(indent_task *task, wt_error *err)
{
    const wt_indent_job *job = task->job;
    char statement[256];
    task->options = job->options;
    if (job->rubber == NULL)
        return WT_OK;
    if (job->rubber->kind != WT_RUBBER_SERIES && job->rubber->prony.n == 0) {
        wt_log_add(task->work->log, WT_NOTE, NULL, NULL,
                   "%s: the material has no relaxation spectrum (it is a table or a law), so "
                   "each curve has the modulus of its own rate",
                   job->group);
        return WT_OK;
    }
    const wt_status status =
        flow_rubber_spectrum(job->rubber, job->temperature.value, &task->spectrum, statement, err);
    if (status != WT_OK)
        return status;
    task->options.spectrum = &task->spectrum;
    if (statement[0] != '\0')
        wt_log_add(task->work->log, WT_WARNING, NULL, NULL, "spectrum of the %s: %s", job->group,
                   statement);
    return WT_OK;
}

static wt_status prepare_task(indent_task *task, wt_error *err)
{
    wt_status status = indent_job_check(task->job, err);
    if (status == WT_OK)
        status = curve_selection_begin(task->job, &task->shown, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), task->work, err);
    if (status == WT_OK)
        status = find_spectrum(task, err);
    if (status == WT_OK)
        status = indent_contact_table(&task->job->tip, &task->contact, err);
    if (status == WT_OK)
        status = manual_overrides_read(task->job, task->work, &task->choices, err);
    if (status != WT_OK)
        return status;
    if ((task->work->left_out & WT_EXTRA_SYSTEMATIC_ERRORS) == 0)
        calibration_errors_begin(task->job, &task->calibration);
    char title[96];
    snprintf(title, sizeof title, "%s, %s", indentation_schema.title, task->job->group);
    task->rows = table_begin_variant(
        &indentation_schema, (table_variant){.suffix = task->job->group, .title = title}, err);
    if (task->rows.status != WT_OK)
        return task->rows.status;
    task->n_workers = wt_thread_count(task->work->threads);
    if (task->n_workers > MAX_WORKERS)
        task->n_workers = MAX_WORKERS;
    task->scratch = wt_alloc(task->n_workers, sizeof(wt_indent_workspace *));
    task->n_items = task->n_workers > 1 ? (size_t)task->n_workers * CURVES_PER_WORKER : 1;
    task->items = wt_alloc(task->n_items, sizeof *task->items);
    for (unsigned i = 0; i < task->n_workers; i++)
        task->scratch[i] = wt_indent_workspace_new();
    return WT_OK;
}

static void release_task(indent_task *task)
{
    for (unsigned i = 0; task->scratch != NULL && i < task->n_workers; i++)
        wt_indent_workspace_free(task->scratch[i]);
    for (size_t i = 0; task->items != NULL && i < task->n_items; i++)
        wt_force_curve_clear(&task->items[i].curve);
    free(task->scratch);
    free(task->items);
    free(task->moduli);
    free(task->tips);
    indent_summary_clear(&task->summary);
    calibration_errors_clear(&task->calibration);
    indent_depths_clear(&task->depths);
    wt_prony_clear(&task->spectrum);
    wt_contact_table_free(task->contact);
    manual_overrides_clear(&task->choices);
    curve_selection_clear(&task->shown);
    wt_table_free(task->rows.table);
    (void)pthread_cond_destroy(&task->written);
    (void)pthread_mutex_destroy(&task->lock);
}

/* Reports the cost. The main number is the modulus of a curve, with the root mean square of its
 * relative errors. */
static void report_indentation_cost(const indent_task *task)
{
    cost_summary cost = {
        .items = (double)task->n_curves,
        .number = {1, sqrt(task->sum_squared_errors / (double)task->n_moduli), 0, "1"}};
    for (unsigned i = 0; i < task->n_workers; i++) {
        const wt_indent_workspace *w = task->scratch[i];
        cost_add_nodes(task->work->cost, w->evaluations);
        cost.tolerance_asked = fmax(cost.tolerance_asked, w->step_allowed);
        cost.error_estimated = fmax(cost.error_estimated, w->step_left);
    }
    cost_report(task->work, cost);
}

wt_status wt_indent_group(const wt_indent_job *job, const wt_job *work, wt_indent_tables *tables,
                          wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || job->group == NULL)
        return wt_fail(err, WT_E_ARG, "no indentation job");
    if (tables->indentation != NULL)
        return wt_fail(err, WT_E_ARG, "the indentation table of the group before is still there");
    indent_task task = {.job = job,
                        .work = work,
                        .lock = PTHREAD_MUTEX_INITIALIZER,
                        .written = PTHREAD_COND_INITIALIZER,
                        .k_low = (double)NAN,
                        .k_high = (double)NAN,
                        .s_low = (double)NAN,
                        .s_high = (double)NAN};
    flow_files files = {0};
    wt_status status = prepare_task(&task, err);
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK)
        status = manual_overrides_bind(&task.choices, &files, err);
    if (status == WT_OK)
        status = indent_read_files(&task, &files, err);
    if (status == WT_OK && task.n_curves == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no force curve could be read for \"%s\"", job->group);
        flow_error_add_files(&files, task.n_failed, err);
    }
    task.rows.err = err; /* the last row used the error of its file */
    if (status == WT_OK)
        status = calibration_errors_fit(&task.calibration, &job->tip, &task.options, task.n_workers,
                                        task.scratch, err);
    if (status == WT_OK) {
        set_indentation_keys(&task, &files, &task.rows);
        indent_summary_report(&task.summary, job, work, &task.rows);
    }
    if (status == WT_OK)
        status = indent_depths_table(&task.depths, job, task.contact, tables, err);
    if (status == WT_OK && job->only == NULL)
        status = manual_overrides_table(&task.choices, work, &tables->choices, err);
    if (status == WT_OK && task.shown.median && task.n_moduli > 0)
        status = add_representative_curve(&task, tables, err);
    if (status == WT_OK)
        status = curve_selection_table(&task.shown, job->group, &tables->curves, err);
    if (status == WT_OK) {
        status = table_end(&task.rows, &tables->indentation);
        task.rows.table = NULL;
        tables->n_files = files.n;
        tables->n_curves = task.n_curves;
        tables->n_accepted = task.n_accepted;
        tables->n_failed = task.n_failed;
        report_indentation_cost(&task);
    }
    release_task(&task);
    flow_files_clear(&files);
    return status;
}

void wt_indent_tables_clear(wt_indent_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->indentation);
    wt_table_free(tables->force_displacement);
    wt_table_free(tables->force_indentation);
    wt_table_free(tables->curves);
    wt_table_free(tables->choices);
    wt_table_free(tables->modulus_depth);
    *tables = (wt_indent_tables){0};
}
