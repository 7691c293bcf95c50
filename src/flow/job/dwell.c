/* The job of dwells: relaxation at constant height and creep at constant force behind the approach
 * of every curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/dwell.h"
#include "base/param.h"
#include "flow/job/cost.h"
#include "flow/job/inputs.h"

#include "data/force_curve.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double depth_min = 1e-11, depth_max = 1e-4;
/* Below it noise does not make such a misfit. */
static const double least_chance = 0.01;

void wt_dwell_tables_clear(wt_dwell_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->dwell);
    wt_table_free(tables->dwell_points);
    wt_table_free(tables->dwell_moduli);
    *tables = (wt_dwell_tables){0};
}

typedef struct dwell_task {
    const wt_indent_job *job;
    const wt_job *work;
    wt_contact_table *contact;
    wt_indent_workspace *workspace;
    table_writer rows, points, moduli;
    size_t n_dwells;
} dwell_task;

/* Whether a fit, accepted or not, has a contact point. */
static bool is_placed(const wt_indent_fit *fit)
{
    return isfinite(fit->contact_point.value) && fit->fitted_modulus > 0;
}

static void put_points(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                       const wt_dwell *dwell)
{
    table_writer *t = &task->points;
    table_block(t);
    for (size_t i = 0; i < dwell->n_points; i++) {
        const wt_dwell_point *p = &dwell->point[i];
        table_row(t);
        dwell_points_put(t, DWELL_POINTS_TIME, p->time);
        dwell_points_put(t, DWELL_POINTS_FORCE, p->force);
        dwell_points_put(t, DWELL_POINTS_INDENTATION, p->indentation);
        dwell_points_put(t, DWELL_POINTS_MODULUS, p->modulus);
        dwell_points_put(t, DWELL_POINTS_FITTED, p->fitted);
        dwell_points_put_text(t, DWELL_POINTS_FILE, file->name);
        dwell_points_put(t, DWELL_POINTS_CURVE, (double)curve->index);
    }
}

static void put_moduli(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                       const wt_segment *s, const char *kind, const wt_dwell_moduli *m)
{
    table_writer *t = &task->moduli;
    table_row(t);
    dwell_moduli_put_text(t, DWELL_MODULI_FILE, file->name);
    dwell_moduli_put(t, DWELL_MODULI_CURVE, (double)curve->index);
    dwell_moduli_put(t, DWELL_MODULI_SEGMENT, (double)s->index);
    dwell_moduli_put_text(t, DWELL_MODULI_KIND, kind);
    dwell_moduli_put(t, DWELL_MODULI_ANGULAR_FREQUENCY, m->angular_frequency);
    dwell_moduli_put(t, DWELL_MODULI_STORAGE, m->storage.value);
    dwell_moduli_put(t, DWELL_MODULI_STORAGE_STANDARD_ERROR, m->storage.standard_error);
    dwell_moduli_put(t, DWELL_MODULI_STORAGE_COMMON, m->storage_common_error);
    dwell_moduli_put(t, DWELL_MODULI_LOSS, m->loss.value);
    dwell_moduli_put(t, DWELL_MODULI_LOSS_STANDARD_ERROR, m->loss.standard_error);
    dwell_moduli_put(t, DWELL_MODULI_LOSS_COMMON, m->loss_common_error);
}

/* Into the row of the dwell. */
static void put_row_moduli(table_writer *t, const wt_dwell_moduli *m)
{
    dwell_put(t, DWELL_ANGULAR_FREQUENCY, m->angular_frequency);
    dwell_put(t, DWELL_STORAGE, m->storage.value);
    dwell_put(t, DWELL_STORAGE_STANDARD_ERROR, m->storage.standard_error);
    dwell_put(t, DWELL_LOSS, m->loss.value);
    dwell_put(t, DWELL_LOSS_STANDARD_ERROR, m->loss.standard_error);
}

/* Samples of a segment behind those of a history, with times that go on; false where it lacks time,
 * height or force. `scratch`: for two arrays of its samples. */
static bool add_samples(const wt_segment *s, const wt_cantilever *lever, double direction,
                        double *scratch, double *const to[3], size_t *n)
{
    const double *time = segment_time(s, scratch), *height = segment_height(s),
                 *force = segment_force(s, lever, scratch + s->n_points);
    if (time == NULL || height == NULL || force == NULL || s->n_points < 2)
        return false;
    /* Times of a curve go on by themselves; those of a segment begin a step of the one before after
     * its last sample. */
    double shift = 0;
    if (*n > 1) {
        const double last = to[0][*n - 1], step = last - to[0][*n - 2];
        if (!(time[0] > last && time[0] < last + 100 * step))
            shift = last + step - time[0];
    }
    for (size_t i = 0; i < s->n_points; i++) {
        to[0][*n] = time[i] + shift;
        to[1][*n] = direction * height[i];
        to[2][(*n)++] = force[i];
    }
    return true;
}

/* The segments of a history: approach, dwell, and the next retract if there is one. */
static wt_status fit_dwell(const dwell_task *task, const wt_force_curve *curve,
                           const wt_segment *approach, const wt_segment *s,
                           const wt_indent_fit *fit, wt_dwell *dwell, wt_error *err)
{
    const wt_segment *const end = curve->segments + curve->n_segments, *retract = s + 1;
    while (retract < end && retract->kind != WT_SEGMENT_RETRACT)
        retract++;
    const size_t more = retract == s + 1 && retract < end ? retract->n_points : 0,
                 n = approach->n_points + s->n_points + more;
    const size_t longest = approach->n_points > s->n_points ? approach->n_points : s->n_points;
    double *room = malloc((3 * n + 2 * (longest > more ? longest : more)) * sizeof *room);
    if (room == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    double *const to[3] = {room, room + n, room + 2 * n}, *scratch = room + 3 * n;
    const wt_cantilever *lever = &curve->cantilever;
    wt_dwell_history h = {.time = to[0],
                          .position = to[1],
                          .force = to[2],
                          .spring_constant = lever->spring_constant,
                          .poisson_ratio = task->job->options.poisson_ratio,
                          .contact_point = fit->contact_point.value,
                          .modulus = fit->fitted_modulus,
                          .baseline_offset = fit->baseline_offset.value,
                          .baseline_tilt = fit->baseline_tilt};
    size_t used = 0;
    wt_status status = WT_OK;
    if (!add_samples(approach, lever, fit->direction, scratch, to, &used) ||
        !add_samples(s, lever, fit->direction, scratch, to, &used)) {
        *dwell = (wt_dwell){.why_not = "no time, height or force in it"};
    } else {
        h.n_approach = approach->n_points;
        h.n_dwell = s->n_points;
        if (more > 0 && add_samples(retract, lever, fit->direction, scratch, to, &used))
            h.n_retract = more;
        status = wt_dwell_fit(task->contact, &h, dwell, err);
    }
    free(room);
    return status;
}

static wt_status measure(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                         const wt_segment *approach, const wt_segment *s, const wt_indent_fit *fit,
                         wt_error *err)
{
    table_writer *t = &task->rows;
    wt_dwell d;
    wt_status status = fit_dwell(task, curve, approach, s, fit, &d, err);
    if (status != WT_OK)
        return status;
    const char *kind = d.n_points == 0 ? "" : d.creep ? "creep" : "relaxation";
    dwell_put_text(t, DWELL_KIND, kind);
    dwell_put_text(t, DWELL_NOTE,
                   !d.found ? d.why_not
                   : d.misfit_chance < least_chance
                       ? "a rubber of a broad spectrum does not describe "
                         "it; no errors are told"
                       : "");
    if (d.n_points == 0)
        return WT_OK;
    dwell_put(t, DWELL_LOAD_TIME, d.load_time);
    dwell_put(t, DWELL_DURATION, d.duration);
    dwell_put(t, DWELL_FORCE_START, d.point[0].force);
    dwell_put(t, DWELL_FORCE_END, d.point[d.n_points - 1].force);
    dwell_put(t, DWELL_INDENTATION_START, d.point[0].indentation);
    dwell_put(t, DWELL_INDENTATION_END, d.point[d.n_points - 1].indentation);
    dwell_put(t, DWELL_MISFIT, d.misfit);
    dwell_put(t, DWELL_MISFIT_CHANCE, d.misfit_chance);
    put_points(task, file, curve, &d);
    if (!d.found)
        return WT_OK;
    put_row_moduli(t, &d.moduli[d.n / 2]);
    table_block(&task->moduli);
    for (size_t i = 0; i < d.n; i++)
        put_moduli(task, file, curve, s, kind, &d.moduli[i]);
    return WT_OK;
}

/* The dwells behind the approach, up to the retract. */
static wt_status read_curve(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                            wt_error *err)
{
    const wt_segment *const approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *const end = curve->segments + curve->n_segments;
    wt_status status = WT_OK;
    wt_indent_fit fit;
    if (approach == NULL)
        return WT_OK;
    for (const wt_segment *s = approach + 1;
         s < end && s->kind != WT_SEGMENT_RETRACT && status == WT_OK; s++) {
        if (s->kind != WT_SEGMENT_DWELL || s->n_points == 0)
            continue;
        status = wt_indent_force_curve(task->contact, &task->job->options, curve, task->workspace,
                                       &fit, err);
        if (status != WT_OK)
            break;
        task->n_dwells++;
        table_row(&task->rows);
        dwell_put_text(&task->rows, DWELL_FILE, file->name);
        dwell_put(&task->rows, DWELL_CURVE, (double)curve->index);
        dwell_put(&task->rows, DWELL_SEGMENT, (double)s->index);
        if (is_placed(&fit)) {
            status = measure(task, file, curve, approach, s, &fit, err);
        } else {
            dwell_put_text(&task->rows, DWELL_KIND, "");
            dwell_put_text(&task->rows, DWELL_NOTE, fit.reason);
        }
        break; /* what follows has another history */
    }
    return status;
}

static wt_status read_file(dwell_task *task, flow_file *file, wt_error *err)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_status status = flow_open(task->work, file, "dwell", WT_KIND_FORCE, &input, err);
    wt_read_options options = file->read;
    options.want = WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) | WT_Q_BIT(WT_Q_FORCE) |
                   WT_Q_BIT(WT_Q_TIME);
    options.one_height = true;
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, task->work->log, &source, err);
    while (status == WT_OK) {
        status = wt_force_next(source, &curve, err);
        if (status == WT_OK)
            status = read_curve(task, file, &curve, err);
    }
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    wt_input_close(input);
    return status == WT_END ? WT_OK : status;
}

static wt_status read_files(dwell_task *task, const flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    size_t n_failed = 0;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        status = read_file(task, &files->file[i], &failure);
        if (status == WT_OK || flow_leave_out(task->work, &files->file[i], &failure)) {
            status = WT_OK;
            continue;
        }
        n_failed++;
        status = wt_job_failed(task->work, files->file[i].name, status, &failure, err);
    }
    if (status == WT_OK && task->n_dwells == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no curve dwells behind its approach");
        flow_tell_files(files, n_failed, err);
    }
    return status;
}

/* At the frequency that most dwells tell, of such the one in the middle. */
static wt_status set_keys(table_writer *t, const wt_table *moduli, wt_error *err)
{
    dwell_mean *means;
    size_t n, most = 0, first = 0, last = 0;
    const wt_status status = dwell_means(moduli, &means, &n, err);
    for (size_t i = 0; i < n; i++) {
        first = means[i].n > most ? i : first;
        last = means[i].n >= most ? i : last;
        most = means[i].n > most ? means[i].n : most;
    }
    if (n > 0) {
        const dwell_mean *m = &means[(first + last) / 2];
        dwell_set_value(t, DWELL_KEY_ANGULAR_FREQUENCY, m->angular_frequency, 0, 0);
        dwell_set_value(t, DWELL_KEY_STORAGE, m->storage.value, m->storage.standard_error, 0);
        dwell_set_value(t, DWELL_KEY_LOSS, m->loss.value, m->loss.standard_error, 0);
        dwell_set_print(t, DWELL_KEY_UNITS, "%zu", m->n_units);
    }
    free(means);
    return status;
}

wt_status wt_dwell_make(const wt_indent_job *job, const wt_job *work, wt_dwell_tables *tables,
                        wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of dwells");
    dwell_task task = {.job = job, .work = work};
    wt_dwell_tables made = {0};
    flow_files files = {NULL, 0, NULL};
    wt_status status = param_check(wt_indent_job_params(), job, err);
    if (status == WT_OK && (job->tip.half_angle_error > 0 || job->tip.radius_error > 0)) {
        status = wt_fail(err, WT_E_ARG, "an error of the tip would not be used");
        wt_error_advice(err, "leave out what follows +-");
    }
    if (status == WT_OK)
        status = wt_contact_table_new(&job->tip, depth_min, depth_max, &task.contact, err);
    if (status == WT_OK && (task.workspace = wt_indent_workspace_new()) == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    task.rows = table_begin(&dwell_schema, err);
    task.points = table_begin(&dwell_points_schema, err);
    task.moduli = table_begin(&dwell_moduli_schema, err);
    if (status == WT_OK)
        status = read_files(&task, &files, err);
    const wt_status third = table_end(&task.moduli, &made.dwell_moduli);
    if (status == WT_OK && third == WT_OK)
        status = set_keys(&task.rows, made.dwell_moduli, err);
    const wt_status first = table_end(&task.rows, &made.dwell),
                    second = table_end(&task.points, &made.dwell_points);
    if (status == WT_OK)
        status = first != WT_OK ? first : second != WT_OK ? second : third;
    if (status == WT_OK) {
        cost_say(work, (cost_summary){.items = (double)task.n_dwells});
        *tables = made;
        made = (wt_dwell_tables){0};
    }
    wt_dwell_tables_clear(&made);
    wt_indent_workspace_free(task.workspace);
    wt_contact_table_free(task.contact);
    flow_files_clear(&files);
    return status;
}
