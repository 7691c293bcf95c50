/* Curves of a group: reads them from their files, fits them in parallel and writes them in order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/curve_tables.h"
#include "indentation/indent_task.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"
#include "job/conditioning.h"
#include "read/force_assembler.h"

#include <math.h>
#include <string.h>

/* Largest number of samples in the queue once each thread has a curve. It bounds the memory. */
#define MAX_QUEUED_SAMPLES ((size_t)1 << 18)

wt_read_options indent_read_options(indent_task *task, const flow_file *file, bool time)
{
    const wt_indent_job *job = task->job;
    wt_read_options options = flow_read_options(file);
    if (!isnan(job->spring_constant.value))
        options.spring_constant = job->spring_constant.value;
    if (!isnan(job->sensitivity.value))
        options.sensitivity = job->sensitivity.value;
    task->file_contact = task->contact;
    task->file_tip = &job->tip;
    manual_overrides_apply_file(&task->choices, file, &options, &task->file_contact,
                                &task->file_tip);
    options.want &= WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) | WT_Q_BIT(WT_Q_FORCE) |
                    (time ? WT_Q_BIT(WT_Q_TIME) : 0);
    options.sensor_height_only = true;
    options.segments &= WT_SEGMENT_BIT(WT_SEGMENT_APPROACH) | WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
    return options;
}

wt_indent_options indent_curve_options(const indent_task *task, const curve_choice *choice)
{
    wt_indent_options options = task->options;
    if (!isnan(choice->contact_point))
        options.fixed_contact_point = choice->contact_point;
    if (!isnan(choice->baseline_from))
        options.baseline_from = choice->baseline_from;
    if (!isnan(choice->baseline_to))
        options.baseline_to = choice->baseline_to;
    return options;
}

/* ---- failures of curves ---------------------------------------------------------------------- */

static wt_status flush_failures(indent_task *task, wt_error *err)
{
    if (task->n_equal == 0)
        return WT_OK;
    wt_error failure = task->failure;
    if (task->n_equal > 1)
        wt_error_place(&failure, "curve %zu and %zu more", task->first_equal, task->n_equal - 1);
    else
        wt_error_place(&failure, "curve %zu", task->first_equal);
    task->n_equal = 0;
    task->n_failed++;
    return wt_job_add_failure(task->work, task->file->name, failure.status, &failure, err);
}

static wt_status record_curve_failure(indent_task *task, size_t curve, const wt_error *failure,
                                      wt_error *err)
{
    if (task->n_equal > 0 && wt_text_repeats(failure->message, task->failure.message)) {
        task->n_equal++;
        return WT_OK;
    }
    wt_status status = flush_failures(task, err);
    task->failure = *failure;
    task->first_equal = curve;
    task->n_equal = 1;
    return status;
}

/* ---- one curve ------------------------------------------------------------------------------- */

static bool may_read_curve(const indent_task *task)
{
    return task->n_busy < task->n_items &&
           (task->n_busy < task->n_workers || task->n_samples < MAX_QUEUED_SAMPLES);
}

/* Reads the next curve. Returns NULL if there is none. */
static queued_curve *read_next_curve(indent_task *task)
{
    while (task->status == WT_OK && task->source != NULL && !may_read_curve(task))
        (void)pthread_cond_wait(&task->written, &task->lock);
    if (task->status != WT_OK || task->source == NULL)
        return NULL;
    queued_curve *it = task->items;
    while (it->state != ITEM_FREE)
        it++;
    it->error = (wt_error)WT_ERROR_INIT;
    it->status = wt_force_next(task->source, &it->curve, &it->error);
    if (it->status == WT_END) {
        wt_force_close(task->source);
        task->source = NULL;
        return NULL;
    }
    it->samples = 0;
    for (size_t i = 0; it->status == WT_OK && i < it->curve.n_segments; i++)
        it->samples += it->curve.segments[i].n_points * it->curve.segments[i].n_channels;
    it->choice = manual_overrides_curve_choice(&task->choices, task->file, it->curve.index);
    it->state = ITEM_BUSY;
    it->order = task->n_read++;
    task->n_busy++;
    task->n_samples += it->samples;
    return it;
}

static void mark_unreadable(wt_indent_fit *fit, const wt_error *error)
{
    curve_fit_empty(fit);
    fit->verdict = WT_CURVE_UNREADABLE;
    utf8_copy(fit->reason, sizeof fit->reason, error->message);
}

static void store_modulus(indent_task *task, const queued_curve *it)
{
    task->moduli = array_grow(task->moduli, task->n_moduli, sizeof *task->moduli);
    task->moduli[task->n_moduli] = (accepted_modulus){.modulus = it->fit.modulus.value,
                                                      .file = task->file,
                                                      .curve = it->curve.index,
                                                      .choice = it->choice,
                                                      .order = task->n_moduli};
    task->n_moduli++;
    indent_summary_add(&task->summary, &it->fit, &task->options);
}

/* Records the calibration of the curve for the keys of the group. */
static void record_calibration(indent_task *task, const wt_cantilever *used)
{
    task->k_low = fmin(task->k_low, used->spring_constant);
    task->k_high = fmax(task->k_high, used->spring_constant);
    task->s_low = fmin(task->s_low, used->sensitivity);
    task->s_high = fmax(task->s_high, used->sensitivity);
    task->has_given_sensitivity = task->has_given_sensitivity || used->sensitivity_is_overridden;
    for (size_t i = 0; i < task->n_tips; i++)
        if (!tips_differ(task->tips[i], task->file_tip))
            return;
    task->tips = array_grow(task->tips, task->n_tips, sizeof(const wt_tip *));
    task->tips[task->n_tips++] = task->file_tip;
}

/* Writes the row of a curve. The row has data on depth only if the fit used the settings of the
 * job. */
static void write_row(indent_task *task, const queued_curve *it, const wt_indent_options *options,
                      bool has_job_settings, wt_error *err)
{
    const unsigned left_out = task->work->left_out;
    const bool columns = (left_out & WT_EXTRA_DEPTH_CURVES) == 0,
               table = (left_out & WT_EXTRA_MODULUS_DEPTH) == 0;
    const bool may_have_depth = has_job_settings && !options->plain_least_squares;
    wt_indent_job job = *task->job;
    wt_curve_residuals deep, shown;
    job.tip = *task->file_tip;
    job.options = *options;
    const bool has_depth = indent_depth_curve(&it->fit, &it->curve, may_have_depth && table, &deep);
    (void)indent_depth_curve(&it->fit, &it->curve, may_have_depth && columns, &shown);
    task->rows.err = err;
    flow_indentation_row_add(&task->rows, &job, task->file->name, task->spot, &it->curve, &it->fit,
                             &shown);
    if (has_depth)
        indent_depths_add(&task->depths, &deep, task->spot);
}

static wt_status write_item(indent_task *task, queued_curve *it, wt_error *err)
{
    wt_status status = WT_OK;
    if (it->status != WT_OK) {
        if (!flow_may_continue(task->work, it->status))
            return wt_job_add_failure(task->work, task->file->name, it->status, &it->error, err);
        mark_unreadable(&it->fit, &it->error);
        status = record_curve_failure(task, it->curve.index, &it->error, err);
    }
    const bool is_copied = it->status == WT_OK && task->job->only == NULL &&
                           flow_is_copied_curve(task->file, it->hash, &task->copies);
    if (status != WT_OK || is_copied)
        return status;
    const bool has_file_tip = task->file_contact != task->contact,
               has_fitted_contact = isnan(it->choice.contact_point);
    const bool has_job_settings = !has_file_tip && has_fitted_contact;
    const wt_indent_options options = indent_curve_options(task, &it->choice);
    task->n_curves++;
    write_row(task, it, &options, has_job_settings, err);
    curve_selection_add(&task->shown, task->file, &it->curve, &it->fit, task->file_contact,
                        &options);
    if (task->rows.status != WT_OK || !wt_curve_verdict_is_usable(it->fit.verdict))
        return task->rows.status;
    task->n_accepted++;
    task->n_wide += it->fit.verdict == WT_CURVE_WIDE;
    task->n_doubtful += it->fit.verdict == WT_CURVE_DOUBTFUL;
    record_calibration(task, &it->curve.cantilever);
    const double error = it->fit.modulus.standard_error / it->fit.modulus.value;
    task->sum_squared_errors += error * error;
    if (has_fitted_contact) /* shifted sources do not apply to a fixed contact point */
        calibration_errors_store(&task->calibration, &it->curve, &it->fit, task->file_contact);
    store_modulus(task, it);
    return WT_OK;
}

static bool is_cancelled(const indent_task *task)
{
    const wt_progress *progress = &task->work->progress;
    char stage[64] = "indentation: curve";
    if (progress->report == NULL)
        return false;
    if (task->n_files > 1)
        snprintf(stage, sizeof stage, "indentation: file %zu of %zu, curve", task->file_number,
                 task->n_files);
    return !progress->report(progress->user, stage, task->n_written + 1, task->n_expected);
}

/* Writes the finished curves that are next in order. */
static void write_finished_items(indent_task *task)
{
    for (size_t i = 0; task->status == WT_OK && i < task->n_items; i++) {
        queued_curve *it = &task->items[i];
        if (it->state != ITEM_DONE || it->order != task->n_written)
            continue;
        task->status = write_item(task, it, task->err);
        if (task->status == WT_OK && is_cancelled(task))
            task->status = wt_fail(task->err, WT_E_CANCELLED, "cancelled");
        it->state = ITEM_FREE;
        task->n_written++;
        task->n_busy--;
        task->n_samples -= it->samples;
        i = (size_t)-1; /* the next curve may have a lower index */
    }
    (void)pthread_cond_broadcast(&task->written);
}

static void fit_item(const indent_task *task, queued_curve *it, wt_indent_workspace *workspace)
{
    const wt_indent_options options = indent_curve_options(task, &it->choice);
    it->status = wt_indent_fit_force_curve(task->file_contact, &options, &it->curve, workspace,
                                           &it->fit, &it->error);
    /* Equal constant forces are no sign of a copy; two measured curves with a modulus are never
     * equal to the last bit. */
    const bool has_modulus = it->status == WT_OK && it->fit.modulus.value > 0;
    it->hash = has_modulus ? condition_hash_curve(task->file, &it->curve) : 0;
    if (it->status == WT_OK)
        manual_overrides_apply_fit(&it->choice, &it->fit);
}

static wt_status fit_curves(void *user, size_t i, unsigned worker)
{
    indent_task *task = user;
    queued_curve *it;
    if (i == 0 && task->paired_input != NULL)
        return flow_record_input(task->work, task->paired_input, task->file, WT_ROLE_GROUP,
                                 task->paired_err);
    (void)pthread_mutex_lock(&task->lock);
    while ((it = read_next_curve(task)) != NULL) {
        (void)pthread_mutex_unlock(&task->lock);
        if (it->status == WT_OK)
            fit_item(task, it, task->scratch[worker]);
        (void)pthread_mutex_lock(&task->lock);
        it->state = ITEM_DONE;
        write_finished_items(task);
    }
    (void)pthread_mutex_unlock(&task->lock);
    return WT_OK; /* task->status has the result */
}

/* ---- one file -------------------------------------------------------------------------------- */

static wt_status read_curve_file(indent_task *task, wt_error *err)
{
    wt_input *input = NULL;
    wt_error failure = WT_ERROR_INIT;
    wt_status status =
        flow_open_paired(task->work, task->file, WT_ROLE_GROUP, WT_KIND_FORCE, &input,
                         task->n_workers > 1 ? &task->paired_input : NULL, err);
    const wt_read_options options =
        indent_read_options(task, task->file, task->job->rates || task->options.spectrum != NULL);
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, task->work->log, &task->source,
                               err);
    if (status == WT_OK) {
        const size_t count = wt_force_count(task->source), n = count > 0 ? count : 1;
        for (size_t i = 0; i < task->n_items;
             i++) /* an earlier file may have failed in the middle */
            task->items[i].state = ITEM_FREE;
        task->n_expected = count;
        task->n_read = task->n_written = task->n_busy = task->n_samples = 0;
        task->copies = (copied_curves){0};
        task->status = WT_OK;
        task->err = err;
        task->paired_err = &failure;
        const size_t fits = n < task->n_workers ? n : task->n_workers;
        status = wt_parallel_for(fits + (task->paired_input != NULL), task->n_workers, fit_curves,
                                 task, NULL, "fitting curves");
        if (status == WT_OK || task->status != WT_OK)
            status = task->status;
        else
            *err = failure;
    }
    if (status == WT_OK)
        status = flush_failures(task, err);
    if (status == WT_OK)
        flow_log_copies(task->file, &task->copies, task->n_read, task->work);
    wt_force_close(task->source);
    task->source = NULL;
    wt_input_close(task->paired_input);
    task->paired_input = NULL;
    wt_input_close(input);
    return status;
}

/* ---- one curve alone ------------------------------------------------------------------------- */

/* Reads the single curve unless it was read with the same options. */
static wt_status read_single_curve(indent_task *task, wt_single_curve *one, wt_error *err)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_status status = flow_open(task->work, task->file, WT_ROLE_GROUP, WT_KIND_FORCE, &input, err);
    const wt_read_options options =
        indent_read_options(task, task->file, task->job->rates || task->options.spectrum != NULL);
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, task->work->log, &source, err);
    if (status == WT_OK)
        force_seek(source, one->index);
    do
        status = status == WT_OK ? wt_force_next(source, &one->curve, err) : status;
    while (status == WT_OK && one->curve.index < one->index);
    if (status == WT_END || (status == WT_OK && one->curve.index != one->index))
        status = wt_fail(err, WT_E_NOT_FOUND, "the file has no curve %zu", one->index);
    wt_force_close(source);
    wt_input_close(input);
    one->is_read = status == WT_OK;
    one->spring_constant = options.spring_constant;
    one->sensitivity = options.sensitivity;
    return status;
}

static wt_status fit_single_curve(indent_task *task, wt_error *err)
{
    wt_single_curve *one = task->job->only;
    const wt_read_options options = indent_read_options(task, task->file, false);
    queued_curve *it = &task->items[0];
    wt_status status = WT_OK;
    if (!one->is_read || !is_same_number(one->spring_constant, options.spring_constant) ||
        !is_same_number(one->sensitivity, options.sensitivity))
        status = read_single_curve(task, one, err);
    if (status != WT_OK)
        return status;
    const wt_force_curve spare = it->curve;
    it->curve = one->curve; /* lent for the fit */
    it->error = (wt_error)WT_ERROR_INIT;
    it->choice = manual_overrides_curve_choice(&task->choices, task->file, one->index);
    if (!isnan(task->options.fixed_contact_point))
        it->choice.contact_point = task->options.fixed_contact_point;
    if (!isnan(task->options.baseline_from))
        it->choice.baseline_from = task->options.baseline_from;
    if (!isnan(task->options.baseline_to))
        it->choice.baseline_to = task->options.baseline_to;
    fit_item(task, it, task->scratch[0]);
    status = write_item(task, it, err);
    it->curve = spare;
    return status;
}

static wt_status process_curve_file(void *user, flow_file *file, size_t i, wt_error *err)
{
    indent_task *task = user;
    task->file = file;
    file->group = task->job->group;
    task->file_number = i + 1;
    task->spot = file->set->spot != NULL ? file->set->spot : file->name;
    if (task->job->only == NULL)
        return read_curve_file(task, err);
    return strcmp(file->name, task->job->only->file) == 0 ? fit_single_curve(task, err) : WT_OK;
}

wt_status indent_read_files(indent_task *task, const flow_files *files, wt_error *err)
{
    size_t n_failed; /* in addition to the failed curves */
    task->n_files = files->n;
    const wt_status status =
        flow_files_process(files, task->work, process_curve_file, task, &n_failed, err);
    task->n_failed += n_failed;
    return status;
}
