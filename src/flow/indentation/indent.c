/* The indentation job: every curve of every file of a group, streamed, fitted in parallel, written
 * in order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/indentation/indent.h"
#include "base/param.h"
#include "flow/indentation/common_errors.h"
#include "flow/indentation/curve_set.h"
#include "flow/indentation/curve_tables.h"
#include "flow/materials/rubber.h"
#include "flow/work/cost.h"
#include "flow/work/draws.h"
#include "flow/work/inputs.h"

#include "base/array.h"
#include "data/tables/tables.h"
#include "fit/indentation/curve.h"
#include "read/force_source.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Curves at once for each thread: those that are done wait for one before them that takes long. */
#define CURVES_EACH 8
#define MOST_WORKERS 64
/* Of curves at once, if every thread has one: it bounds memory. */
#define MOST_SAMPLES ((size_t)1 << 18)

typedef enum item_state { ITEM_FREE, ITEM_TAKEN, ITEM_DONE } item_state;

typedef struct item {
    item_state state;
    size_t order; /* of all curves of the file */
    size_t samples;
    wt_force_curve curve;
    wt_status status;
    wt_error error;
    wt_indent_fit fit;
} item;

typedef struct accepted {
    double modulus;
    const flow_file *file;
    size_t curve, order;
} accepted;

typedef struct indent_task {
    const wt_indent_job *job;
    wt_indent_options options; /* of the job, with the spectrum */
    wt_prony spectrum;
    const wt_job *work;
    flow_file *file;
    const char *spot; /* of the set, or the file */
    wt_contact_table *contact;
    wt_indent_workspace **scratch; /* [n_workers] */
    unsigned n_workers;
    /* Each thread takes a curve, fits it, and writes what is done and next in order; all but the
     * fit under the lock. */
    pthread_mutex_t lock;
    pthread_cond_t written;
    wt_force_source *source; /* NULL: nothing is left to read */
    wt_input *beside; /* the file for its digest, which one of them makes first; NULL: made */
    wt_error *beside_err;
    item *items;              /* [n_items] */
    size_t n_items, n_taken;  /* of them, those that are not free */
    size_t n_samples;         /* in those */
    size_t n_read, n_written; /* curves of the file */
    size_t n_of_file;         /* as many as it says, 0 if it does not */
    size_t n_files, file_number;
    wt_status status;
    wt_error *err;
    table_writer rows;
    size_t n_curves, n_accepted, n_doubtful, n_failed; /* accepted: doubtful ones, too */
    /* equal failures of one file make one row */
    wt_error failure;
    size_t n_equal, first_equal;
    /* accepted moduli with the curve they are of, for the representative curve */
    accepted *moduli;
    size_t n_moduli;
    indent_together together;
    common_errors common;
    indent_depths depths;
    double k_low, k_high; /* spring constants of the accepted curves [N/m] */
    bool by_sensitivity;  /* that of the job made a force */
    double squares;       /* of relative standard errors of their moduli */
} indent_task;

/* What the fit uses, and nothing else. */
static wt_read_options wanted_channels(const flow_file *file, const wt_indent_job *job, bool time)
{
    wt_read_options options = flow_read_options(file);
    if (!isnan(job->spring_constant.value))
        options.spring_constant = job->spring_constant.value;
    if (!isnan(job->sensitivity.value))
        options.sensitivity = job->sensitivity.value;
    options.want &= WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) | WT_Q_BIT(WT_Q_FORCE) |
                    (time ? WT_Q_BIT(WT_Q_TIME) : 0);
    options.one_height = true;
    options.segments &= WT_SEGMENT_BIT(WT_SEGMENT_APPROACH) | WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
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
    return wt_job_failed(task->work, task->file->name, failure.status, &failure, err);
}

static wt_status note_failure(indent_task *task, size_t curve, const wt_error *failure,
                              wt_error *err)
{
    if (task->n_equal > 0 && strcmp(failure->message, task->failure.message) == 0) {
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

static bool has_room(const indent_task *task)
{
    return task->n_taken < task->n_items &&
           (task->n_taken < task->n_workers || task->n_samples < MOST_SAMPLES);
}

/* Reads the next curve; NULL if there is none. */
static item *take_curve(indent_task *task)
{
    while (task->status == WT_OK && task->source != NULL && !has_room(task))
        (void)pthread_cond_wait(&task->written, &task->lock);
    if (task->status != WT_OK || task->source == NULL)
        return NULL;
    item *it = task->items;
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
    it->state = ITEM_TAKEN;
    it->order = task->n_read++;
    task->n_taken++;
    task->n_samples += it->samples;
    return it;
}

static void mark_unreadable(wt_indent_fit *fit, const wt_error *error)
{
    curve_fit_empty(fit);
    fit->verdict = WT_CURVE_UNREADABLE;
    snprintf(fit->reason, sizeof fit->reason, "%.159s", error->message);
}

static wt_status keep_modulus(indent_task *task, const item *it, wt_error *err)
{
    accepted *moduli = array_grow(task->moduli, task->n_moduli, sizeof *moduli);
    if (moduli == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    task->moduli = moduli;
    task->moduli[task->n_moduli] = (accepted){.modulus = it->fit.modulus.value,
                                              .file = task->file,
                                              .curve = it->curve.index,
                                              .order = task->n_moduli};
    task->n_moduli++;
    return indent_together_add(&task->together, &it->fit, &task->options, err);
}

static wt_status write_item(indent_task *task, item *it, wt_error *err)
{
    wt_status status = WT_OK;
    if (it->status != WT_OK) {
        if (!flow_goes_on(task->work, it->status))
            return wt_job_failed(task->work, task->file->name, it->status, &it->error, err);
        mark_unreadable(&it->fit, &it->error);
        status = note_failure(task, it->curve.index, &it->error, err);
    }
    if (status != WT_OK)
        return status;
    task->rows.err = err;
    flow_indentation_row(&task->rows, task->job, task->file->name, task->spot, &it->curve,
                         &it->fit);
    task->n_curves++;
    if ((task->work->left_out & WT_EXTRA_MODULUS_DEPTH) == 0)
        status = indent_depths_add(&task->depths, &it->fit, &it->curve, task->spot, err);
    if (status != WT_OK)
        return status;
    if (task->rows.status != WT_OK || !wt_curve_usable(it->fit.verdict))
        return task->rows.status;
    task->n_accepted++;
    task->n_doubtful += it->fit.verdict == WT_CURVE_DOUBTFUL;
    task->k_low = fmin(task->k_low, it->curve.cantilever.spring_constant);
    task->k_high = fmax(task->k_high, it->curve.cantilever.spring_constant);
    task->by_sensitivity = task->by_sensitivity || it->curve.cantilever.sensitivity_given;
    const double error = it->fit.modulus.standard_error / it->fit.modulus.value;
    task->squares += error * error;
    status = common_errors_keep(&task->common, &it->curve, err);
    if (status == WT_OK && task->job->keep != NULL)
        status = curve_set_add(task->job->keep, &it->curve, &it->fit, err);
    return status == WT_OK ? keep_modulus(task, it, err) : status;
}

static bool is_cancelled(const indent_task *task)
{
    const wt_progress *progress = &task->work->progress;
    char what[64] = "indentation: curve";
    if (progress->report == NULL)
        return false;
    if (task->n_files > 1)
        snprintf(what, sizeof what, "indentation: file %zu of %zu, curve", task->file_number,
                 task->n_files);
    return !progress->report(progress->user, what, task->n_written + 1, task->n_of_file);
}

/* Those that are next in order. */
static void write_done(indent_task *task)
{
    for (size_t i = 0; task->status == WT_OK && i < task->n_items; i++) {
        item *it = &task->items[i];
        if (it->state != ITEM_DONE || it->order != task->n_written)
            continue;
        task->status = write_item(task, it, task->err);
        if (task->status == WT_OK && is_cancelled(task))
            task->status = wt_fail(task->err, WT_E_CANCELLED, "cancelled");
        it->state = ITEM_FREE;
        task->n_written++;
        task->n_taken--;
        task->n_samples -= it->samples;
        i = (size_t)-1; /* the next may stand before it */
    }
    (void)pthread_cond_broadcast(&task->written);
}

static wt_status fit_curves(void *user, size_t i, unsigned worker)
{
    indent_task *task = user;
    item *it;
    if (i == 0 && task->beside != NULL)
        return flow_record(task->work, task->beside, task->file, task->job->group,
                           task->beside_err);
    (void)pthread_mutex_lock(&task->lock);
    while ((it = take_curve(task)) != NULL) {
        (void)pthread_mutex_unlock(&task->lock);
        if (it->status == WT_OK)
            it->status = wt_indent_force_curve(task->contact, &task->options, &it->curve,
                                               task->scratch[worker], &it->fit, &it->error);
        (void)pthread_mutex_lock(&task->lock);
        it->state = ITEM_DONE;
        write_done(task);
    }
    (void)pthread_mutex_unlock(&task->lock);
    return WT_OK; /* that of the task says more */
}

/* ---- one file -------------------------------------------------------------------------------- */

static wt_status read_file(indent_task *task, wt_error *err)
{
    wt_input *input = NULL;
    wt_error failure = WT_ERROR_INIT;
    wt_status status = flow_open_beside(task->work, task->file, task->job->group, WT_KIND_FORCE,
                                        &input, task->n_workers > 1 ? &task->beside : NULL, err);
    const wt_read_options options =
        wanted_channels(task->file, task->job, task->job->rates || task->options.spectrum != NULL);
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, task->work->log, &task->source,
                               err);
    if (status == WT_OK) {
        const size_t count = wt_force_count(task->source), n = count > 0 ? count : 1;
        for (size_t i = 0; i < task->n_items; i++) /* a file before may have failed half-way */
            task->items[i].state = ITEM_FREE;
        task->n_of_file = count;
        task->n_read = task->n_written = task->n_taken = task->n_samples = 0;
        task->status = WT_OK;
        task->err = err;
        task->beside_err = &failure;
        const size_t fits = n < task->n_workers ? n : task->n_workers;
        status = wt_parallel_for(fits + (task->beside != NULL), task->n_workers, fit_curves, task,
                                 NULL, "fitting curves");
        if (status == WT_OK || task->status != WT_OK)
            status = task->status;
        else
            *err = failure;
    }
    if (status == WT_OK)
        status = flush_failures(task, err);
    wt_force_close(task->source);
    task->source = NULL;
    wt_input_close(task->beside);
    task->beside = NULL;
    wt_input_close(input);
    return status;
}

static wt_status read_files(indent_task *task, const flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    task->n_files = files->n;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        task->file = &files->file[i];
        task->file_number = i + 1;
        task->spot = task->file->set->spot != NULL ? task->file->set->spot : task->file->name;
        status = read_file(task, &failure);
        if (status == WT_OK || flow_leave_out(task->work, task->file, &failure)) {
            status = WT_OK;
            continue;
        }
        task->n_failed++;
        status = wt_job_failed(task->work, task->file->name, status, &failure, err);
    }
    return status;
}

/* ---- the representative curve ---------------------------------------------------------------- */

static int by_modulus(const void *a, const void *b)
{
    const accepted *x = a, *y = b;
    if (x->modulus < y->modulus || x->modulus > y->modulus)
        return x->modulus < y->modulus ? -1 : 1;
    return x->order < y->order ? -1 : x->order > y->order;
}

/* Reads the curve with the (lower) median modulus, the first one of equal moduli, again, now with
 * its retract segment. */
static wt_status add_representative(indent_task *task, wt_indent_tables *tables, wt_error *err)
{
    qsort(task->moduli, task->n_moduli, sizeof *task->moduli, by_modulus);
    const accepted *median = &task->moduli[(task->n_moduli - 1) / 2];
    const flow_file *file = median->file;
    if (strcmp(file->path, "-") == 0)
        return WT_OK; /* a pipe cannot be read twice */
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve *curve = &task->items[0].curve;
    const wt_read_options options =
        wanted_channels(file, task->job, task->options.spectrum != NULL);
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
        if (next == WT_E_MEMORY)
            status = wt_fail(err, next, "no memory for the representative curve");
        if (next != WT_OK || curve->index != median->curve)
            continue;
        wt_indent_fit fit;
        status = wt_indent_force_curve(task->contact, &task->options, curve, task->scratch[0], &fit,
                                       err);
        if (status == WT_OK)
            status = flow_curve_tables_add(tables, task->job->group, file->name, curve, &fit,
                                           task->contact, &task->options, err);
        break;
    }
    wt_force_close(source);
    wt_input_close(input);
    return status;
}

/* ---- the group ------------------------------------------------------------------------------- */

static void set_keys(indent_task *task, const flow_files *files)
{
    const wt_indent_job *job = task->job;
    table_writer *t = &task->rows;
    char tip[256], range[256];
    size_t named = 0;
    for (size_t i = 0; i < files->n; i++)
        named += files->file[i].set->spot != NULL;
    const char *spots = "mixed: some named, the others one for each file";
    if (named == files->n)
        spots = "named";
    else if (named == 0)
        spots = "file: each file is a spot, none were named";
    wt_tip_describe(&job->tip, tip, sizeof tip);
    if (task->options.spectrum != NULL)
        indentation_set_value(t, INDENTATION_KEY_SPECTRUM_TEMPERATURE,
                              task->spectrum.reference_temperature, 0, 0);
    indentation_set_text(t, INDENTATION_KEY_TIP, tip);
    indentation_set_print(t, INDENTATION_KEY_POISSON_RATIO, "%g", job->options.poisson_ratio);
    if (indent_range_text(&job->options, range, sizeof range))
        indentation_set_text(t, INDENTATION_KEY_FIT_RANGE, range);
    /* that of the user; else that of the files, whose error they do not say */
    wt_estimate k = job->spring_constant;
    if (isnan(k.value) && task->k_low >= task->k_high)
        k = (wt_estimate){task->k_low, 0, 0, "N/m"};
    if (!(k.standard_error > 0))
        k.standard_error = job->lever_error * k.value;
    if (task->by_sensitivity && !isnan(job->sensitivity.value))
        indentation_set(t, INDENTATION_KEY_SENSITIVITY, flow_as_stated(job->sensitivity));
    common_errors_set_keys(&task->common, t);
    if (!isnan(k.value))
        indentation_set(t, INDENTATION_KEY_SPRING_CONSTANT, flow_as_stated(k));
    if (task->k_low < task->k_high)
        indentation_set_print(t, INDENTATION_KEY_SPRING_CONSTANTS, "%.4g to %.4g N/m", task->k_low,
                              task->k_high);
    indentation_set_text(t, INDENTATION_KEY_SPOTS, spots);
    indentation_set_print(t, INDENTATION_KEY_N_ACCEPTED, "%zu", task->n_accepted);
    indentation_set_print(t, INDENTATION_KEY_N_DOUBTFUL, "%zu", task->n_doubtful);
    indentation_set_print(t, INDENTATION_KEY_N_REJECTED, "%zu", task->n_curves - task->n_accepted);
}

/* The spectrum of the rubber at the temperature of the curves, if it is known by one. */
static wt_status find_spectrum(indent_task *task, wt_error *err)
{
    const wt_indent_job *job = task->job;
    char statement[256];
    task->options = job->options;
    if (job->rubber == NULL)
        return WT_OK;
    if (job->rubber->kind != WT_RUBBER_SERIES && job->rubber->prony.n == 0) {
        wt_parselog_add(task->work->log, WT_NOTE, NULL, NULL,
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
        wt_parselog_add(task->work->log, WT_WARNING, NULL, NULL, "spectrum of the %s: %s",
                        job->group, statement);
    return WT_OK;
}

static wt_status prepare_task(indent_task *task, wt_error *err)
{
    wt_status status = indent_job_check(task->job, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), task->work, err);
    if (status == WT_OK)
        status = find_spectrum(task, err);
    if (status == WT_OK)
        status = indent_contact_table(&task->job->tip, &task->contact, err);
    if (status == WT_OK && (task->work->left_out & WT_EXTRA_COMMON) == 0)
        status = common_errors_begin(task->job, &task->common, err);
    if (status != WT_OK)
        return status;
    char title[96];
    snprintf(title, sizeof title, "%s, %s", indentation_schema.title, task->job->group);
    task->rows = table_begin_variant(
        &indentation_schema, (table_variant){.suffix = task->job->group, .title = title}, err);
    if (task->rows.status != WT_OK)
        return task->rows.status;
    if (task->job->keep != NULL)
        curve_set_begin(task->job->keep, task->job);
    task->n_workers = wt_thread_count(task->work->threads);
    if (task->n_workers > MOST_WORKERS)
        task->n_workers = MOST_WORKERS;
    task->scratch = calloc(task->n_workers, sizeof(wt_indent_workspace *));
    task->n_items = task->n_workers > 1 ? (size_t)task->n_workers * CURVES_EACH : 1;
    task->items = calloc(task->n_items, sizeof *task->items);
    if (task->scratch == NULL || task->items == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (unsigned i = 0; i < task->n_workers; i++) {
        if ((task->scratch[i] = wt_indent_workspace_new()) == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        common_errors_tell(&task->common, task->scratch[i]);
    }
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
    indent_together_clear(&task->together);
    common_errors_clear(&task->common);
    indent_depths_clear(&task->depths);
    wt_prony_clear(&task->spectrum);
    wt_contact_table_free(task->contact);
    wt_table_free(task->rows.table);
    (void)pthread_cond_destroy(&task->written);
    (void)pthread_mutex_destroy(&task->lock);
}

/* The main number is the modulus of a curve, with the root mean square of its errors. */
static void say_cost(const indent_task *task)
{
    cost_summary cost = {.items = (double)task->n_curves,
                         .number = {1, sqrt(task->squares / (double)task->n_moduli), 0, "1"}};
    for (unsigned i = 0; i < task->n_workers; i++) {
        const wt_indent_workspace *w = task->scratch[i];
        cost_add_nodes(task->work->cost, w->evaluations);
        cost.tolerance_asked = fmax(cost.tolerance_asked, w->step_allowed);
        cost.error_estimated = fmax(cost.error_estimated, w->step_left);
    }
    cost_say(task->work, cost);
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
                        .k_high = (double)NAN};
    flow_files files = {NULL, 0, NULL};
    wt_status status = prepare_task(&task, err);
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK)
        status = read_files(&task, &files, err);
    if (status == WT_OK && task.n_curves == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no force curve could be read for \"%s\"", job->group);
        flow_tell_files(&files, task.n_failed, err);
    }
    task.rows.err = err; /* that of the last row was the error of its file */
    if (status == WT_OK)
        status = common_errors_fit(&task.common, task.contact, &task.options, task.n_workers,
                                   task.scratch, err);
    if (status == WT_OK) {
        set_keys(&task, &files);
        status = indent_say_together(&task.together, job, work, &task.rows, err);
    }
    if (status == WT_OK)
        status = indent_depths_table(&task.depths, job, task.contact, tables, err);
    if (status == WT_OK && job->curves && task.n_moduli > 0)
        status = add_representative(&task, tables, err);
    if (status == WT_OK) {
        status = table_end(&task.rows, &tables->indentation);
        task.rows.table = NULL;
        tables->n_files = files.n;
        tables->n_curves = task.n_curves;
        tables->n_accepted = task.n_accepted;
        tables->n_failed = task.n_failed;
        say_cost(&task);
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
    wt_table_free(tables->modulus_depth);
    *tables = (wt_indent_tables){0};
}
