/* Job for dwells: relaxation at constant height and creep at constant force after the approach of
 * each curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/dwell.h"
#include "core/base/array.h"
#include "core/base/param.h"
#include "indentation/indent.h"
#include "job/cost.h"
#include "job/inputs.h"

#include "core/table/table_rows.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Customary significance level of the misfit. Below it wt_dwell states no standard errors. */
static const double misfit_p_threshold = 0.01;

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
    dwell_curve curve; /* latest curve */
} dwell_task;

/* Returns NaN for a tensile force and for a depth outside the range of the contact law. */
static double point_modulus(const dwell_task *task, const wt_dwell_point *p, double modulus)
{
    const bool is_valid = p->force > 0 && modulus > 0 && p->indentation > 0 &&
                          contact_law_is_valid(&task->job->tip, p->indentation);
    return is_valid ? modulus : (double)NAN;
}

TABLE_ROW(dwell_points, DWELL_POINTS, double time, force, indentation, modulus, fitted_modulus;
          const char *file; size_t curve;)

static void add_dwell_points(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                             const wt_dwell *dwell)
{
    table_writer *t = &task->points;
    table_block(t);
    for (size_t i = 0; i < dwell->n_points; i++) {
        const wt_dwell_point *p = &dwell->point[i];
        TABLE_ADD(dwell_points, t, p->time, p->force, p->indentation,
                  point_modulus(task, p, p->modulus), point_modulus(task, p, p->fitted), file->name,
                  curve->index);
    }
}

TABLE_ROW(dwell_moduli, DWELL_MODULI, const char *file; size_t curve, segment; const char *kind;
          wt_dwell_moduli moduli;)

/* Writes the moduli to the row of the dwell. */
static void set_row_moduli(table_writer *t, const wt_dwell_moduli *m)
{
    dwell_put(t, DWELL_ANGULAR_FREQUENCY, m->angular_frequency);
    dwell_put(t, DWELL_STORAGE, m->storage.value);
    dwell_put(t, DWELL_STORAGE_STANDARD_ERROR, m->storage.standard_error);
    dwell_put(t, DWELL_LOSS, m->loss.value);
    dwell_put(t, DWELL_LOSS_STANDARD_ERROR, m->loss.standard_error);
}

static void begin_dwell_row(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                            const wt_segment *s, const char *kind, const char *note)
{
    table_writer *t = &task->rows;
    table_row(t);
    dwell_put_text(t, DWELL_FILE, file->name);
    dwell_put(t, DWELL_CURVE, (double)curve->index);
    dwell_put(t, DWELL_SEGMENT, (double)s->index);
    dwell_put_text(t, DWELL_KIND, kind);
    dwell_put_text(t, DWELL_NOTE, note);
}

/* Writes the remarks on a dwell, or the reason why it has no moduli. */
static void format_dwell_note(const wt_dwell *d, char note[256])
{
    const char *misfit =
        d->misfit_p < misfit_p_threshold
            ? "a rubber of a broad spectrum does not describe it; no errors are told"
        : isnan(d->misfit_p) ? "whether a rubber of a broad spectrum describes it could not be "
                               "tested; no errors are told"
                             : "";
    bool all = true, is_repulsive = true;
    for (size_t i = 0; i < d->n; i++)
        all = all && dwell_is_valid_modulus(&d->moduli[i]);
    for (size_t i = 0; i < d->n_points; i++)
        is_repulsive = is_repulsive && d->point[i].force > 0;
    const char *const parts[] = {d->found ? misfit : d->reason,
                                 all ? "" : "moduli that are not positive were left out",
                                 is_repulsive ? "" : "the force falls below the baseline in it"};
    note[0] = '\0';
    for (size_t i = 0; i < COUNT_OF(parts); i++) {
        const size_t used = strlen(note);
        snprintf(note + used, 256 - used, "%s%s", used > 0 && parts[i][0] != '\0' ? "; " : "",
                 parts[i]);
    }
}

static void add_measured_dwell(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                               const wt_segment *s, const wt_dwell *d)
{
    table_writer *t = &task->rows;
    const char *kind = d->n_points == 0 ? "" : d->creep ? "creep" : "relaxation";
    char note[256];
    format_dwell_note(d, note);
    begin_dwell_row(task, file, curve, s, kind, note);
    if (d->n_points == 0)
        return;
    dwell_put(t, DWELL_LOAD_TIME, d->load_time);
    dwell_put(t, DWELL_DURATION, d->duration);
    dwell_put(t, DWELL_FORCE_START, d->point[0].force);
    dwell_put(t, DWELL_FORCE_END, d->point[d->n_points - 1].force);
    dwell_put(t, DWELL_INDENTATION_START, d->point[0].indentation);
    dwell_put(t, DWELL_INDENTATION_END, d->point[d->n_points - 1].indentation);
    dwell_put(t, DWELL_MISFIT, d->misfit);
    dwell_put(t, DWELL_MISFIT_CHANCE, d->misfit_p);
    add_dwell_points(task, file, curve, d);
    if (!d->found)
        return;
    if (dwell_is_valid_modulus(&d->moduli[d->n / 2]))
        set_row_moduli(t, &d->moduli[d->n / 2]);
    for (size_t i = 0; i < d->n; i++)
        if (dwell_is_valid_modulus(&d->moduli[i]))
            TABLE_ADD(dwell_moduli, &task->moduli, file->name, curve->index, s->index, kind,
                      d->moduli[i]);
}

static void add_modulation_row(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                               const dwell_modulation *m)
{
    table_writer *t = &task->rows;
    begin_dwell_row(task, file, curve, m->segment, "modulation", m->note);
    if (!m->found)
        return;
    dwell_put(t, DWELL_FORCE_START, m->above);
    dwell_put(t, DWELL_INDENTATION_START, m->indentation);
    dwell_put(t, DWELL_AMPLITUDE, m->amplitude);
    set_row_moduli(t, &m->moduli);
    TABLE_ADD(dwell_moduli, &task->moduli, file->name, curve->index, m->segment->index,
              "modulation", m->moduli);
}

/* Fits the held segments after the approach, up to the retract or another motion. */
static wt_status read_dwell_curve(dwell_task *task, const flow_file *file,
                                  const wt_force_curve *curve, wt_error *err)
{
    const wt_segment *const approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *const end = curve->segments + curve->n_segments;
    if (approach == NULL)
        return WT_OK;
    const wt_segment *first = approach + 1;
    while (first < end && first->kind != WT_SEGMENT_RETRACT && !dwell_is_hold_segment(first))
        first++;
    if (first == end || !dwell_is_hold_segment(first))
        return WT_OK;
    wt_indent_fit fit;
    wt_status status = wt_indent_fit_force_curve(task->contact, &task->job->options, curve,
                                                 task->workspace, &fit, err);
    if (status != WT_OK)
        return status;
    task->n_dwells++;
    if (!isfinite(fit.contact_point.value) || !(fit.modulus.value > 0)) {
        begin_dwell_row(task, file, curve, first, "", fit.reason);
        return WT_OK;
    }
    status = dwell_curve_fit(task->contact, task->job->options.poisson_ratio, curve, approach,
                             first, &fit, &task->curve, err);
    if (status != WT_OK)
        return status;
    table_block(&task->moduli);
    add_measured_dwell(task, file, curve, first, &task->curve.dwell);
    for (size_t i = 0; i < task->curve.n; i++)
        add_modulation_row(task, file, curve, &task->curve.modulations[i]);
    return WT_OK;
}

static wt_status read_dwell_file(void *user, flow_file *file, size_t i, wt_error *err)
{
    dwell_task *task = user;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    (void)i;
    wt_status status = flow_open(task->work, file, "dwell", WT_KIND_FORCE, &input, err);
    wt_read_options options = flow_read_options(file);
    options.want = WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) | WT_Q_BIT(WT_Q_FORCE) |
                   WT_Q_BIT(WT_Q_TIME);
    options.sensor_height_only = true;
    if (status == WT_OK)
        status = wt_force_open(task->work->formats, input, &options, task->work->log, &source, err);
    while (status == WT_OK) {
        status = wt_force_next(source, &curve, err);
        if (status == WT_OK)
            status = read_dwell_curve(task, file, &curve, err);
    }
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    wt_input_close(input);
    return status == WT_END ? WT_OK : status;
}

static wt_status read_dwell_files(dwell_task *task, const flow_files *files, wt_error *err)
{
    size_t n_failed;
    wt_status status = flow_files_process(files, task->work, read_dwell_file, task, &n_failed, err);
    if (status == WT_OK && task->n_dwells == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no curve dwells behind its approach");
        flow_error_add_files(files, n_failed, err);
    }
    return status;
}

/* Writes the keys for the frequency that most dwells cover. If several frequencies qualify, the
 * middle one is used. */
static wt_status set_dwell_keys(table_writer *t, const wt_table *moduli, wt_error *err)
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

wt_status wt_dwell_compute(const wt_indent_job *job, const wt_job *work, wt_dwell_tables *tables,
                           wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of dwells");
    dwell_task task = {.job = job, .work = work};
    wt_dwell_tables result = {0};
    flow_files files = {NULL, 0};
    wt_status status = param_check(wt_indent_job_params(), job, err);
    if (status == WT_OK && (job->tip.half_angle_error > 0 || job->tip.radius_error > 0)) {
        status = wt_fail(err, WT_E_ARG, "an error of the tip would not be used");
        wt_error_advice(err, "leave out what follows +-");
    }
    if (status == WT_OK)
        status = indent_contact_table(&job->tip, &task.contact, err);
    task.workspace = wt_indent_workspace_new();
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    task.rows = table_begin(&dwell_schema, err);
    task.points = table_begin(&dwell_points_schema, err);
    task.moduli = table_begin(&dwell_moduli_schema, err);
    if (status == WT_OK)
        status = read_dwell_files(&task, &files, err);
    const wt_status third = table_end(&task.moduli, &result.dwell_moduli);
    if (status == WT_OK && third == WT_OK)
        status = set_dwell_keys(&task.rows, result.dwell_moduli, err);
    const wt_status first = table_end(&task.rows, &result.dwell),
                    second = table_end(&task.points, &result.dwell_points);
    if (status == WT_OK)
        status = first != WT_OK ? first : second != WT_OK ? second : third;
    if (status == WT_OK) {
        cost_report(work, (cost_summary){.items = (double)task.n_dwells});
        *tables = result;
        result = (wt_dwell_tables){0};
    }
    wt_dwell_tables_clear(&result);
    wt_indent_workspace_free(task.workspace);
    wt_contact_table_free(task.contact);
    flow_files_clear(&files);
    return status;
}
