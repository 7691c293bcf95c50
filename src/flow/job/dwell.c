/* The job of dwells: relaxation at constant height and creep at constant force behind the approach
 * of every curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/param.h"
#include "flow/job/cost.h"
#include "flow/job/inputs.h"

#include "base/array.h"
#include "data/force_curve.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Means of a dwell, and by which part of it the first one is shorter. */
enum { BINS = 24 };
/* Terms of the series that stands for a power law, how often the approach is fitted with it, and
 * below which exponent it is elastic. */
enum { TERMS = 32, PASSES = 3 };
static const double least_exponent = 2e-3;
static const double first_share = 1e-3;
static const double depth_min = 1e-11, depth_max = 1e-4, pi = 3.14159265358979323846;

void wt_dwell_tables_clear(wt_dwell_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->dwell);
    wt_table_free(tables->dwell_points);
    *tables = (wt_dwell_tables){0};
}

typedef struct dwell_task {
    const wt_indent_job *job;
    const wt_job *work;
    wt_contact_table *contact;
    wt_indent_workspace *workspace;
    table_writer rows, points;
    double *exponents, *moduli; /* [n] of the dwells with a law, and the files that they are of */
    long *units;
    size_t n, n_dwells;
} dwell_task;

/* The samples of a dwell in bins. */
typedef struct held {
    double time[BINS], force[BINS], indentation[BINS], modulus[BINS], height[BINS];
    size_t n;
    double duration, load_time, power; /* power: of the force with time at the dwell's depth */
    bool creep;
    wt_dwell law;
} held;

/* Whether a fit, accepted or not, has a contact point. */
static bool is_placed(const wt_indent_fit *fit)
{
    return isfinite(fit->contact_point.value) && fit->fitted_modulus > 0;
}

/* Time from contact, force above the baseline and indentation of one sample. */
static void bin_samples(const wt_segment *s, const double *time, const double *height,
                        const double *force, const wt_indent_fit *fit, double k, held *h)
{
    const double step = (time[s->n_points - 1] - time[0]) / (double)(s->n_points - 1);
    const double first = fmax(step, first_share * h->duration), ratio = log(h->duration / first);
    double count[BINS] = {0};
    for (size_t i = 0; i < s->n_points; i++) {
        const double t = time[i] - time[0] + step,
                     z = fit->direction * height[i] - fit->contact_point.value;
        const double f = force[i] - fit->baseline_offset.value - fit->baseline_tilt.value * z;
        if (!isfinite(z) || !isfinite(f) || t < first)
            continue;
        const double place = floor(log(t / first) / ratio * BINS);
        const size_t b = place < BINS ? (size_t)place : BINS - 1;
        count[b]++;
        h->time[b] += fit->load_time + t;
        h->force[b] += f;
        h->height[b] += z;
        h->indentation[b] += tip_position(z, f, k);
    }
    for (size_t b = 0; b < BINS; b++) {
        if (!(count[b] > 0))
            continue;
        h->time[h->n] = h->time[b] / count[b];
        h->force[h->n] = h->force[b] / count[b];
        h->height[h->n] = h->height[b] / count[b];
        h->indentation[h->n++] = h->indentation[b] / count[b];
    }
}

static void put_points(dwell_task *task, const flow_file *file, const wt_force_curve *curve,
                       const held *h)
{
    const wt_dwell *law = &h->law;
    table_writer *t = &task->points;
    table_block(t);
    for (size_t i = 0; i < h->n; i++) {
        table_row(t);
        dwell_points_put(t, DWELL_POINTS_TIME, h->time[i]);
        dwell_points_put(t, DWELL_POINTS_FORCE, h->force[i]);
        dwell_points_put(t, DWELL_POINTS_INDENTATION, h->indentation[i]);
        dwell_points_put(t, DWELL_POINTS_MODULUS, h->modulus[i]);
        dwell_points_put(t, DWELL_POINTS_ANGULAR_FREQUENCY, 1 / h->time[i]);
        if (law->found) {
            const double absolute =
                law->modulus * tgamma(1 - law->exponent) * pow(h->time[i], -law->exponent);
            dwell_points_put(t, DWELL_POINTS_FITTED,
                             wt_dwell_modulus(law->modulus, law->exponent, h->time[i], h->load_time,
                                              h->power, h->creep));
            dwell_points_put(t, DWELL_POINTS_STORAGE, absolute * cos(0.5 * pi * law->exponent));
            dwell_points_put(t, DWELL_POINTS_LOSS, absolute * sin(0.5 * pi * law->exponent));
        }
        dwell_points_put_text(t, DWELL_POINTS_FILE, file->name);
        dwell_points_put(t, DWELL_POINTS_CURVE, (double)curve->index);
    }
}

static wt_status keep(dwell_task *task, const wt_dwell *law, long unit, wt_error *err)
{
    double *exponents = array_grow(task->exponents, task->n, sizeof *exponents);
    task->exponents = exponents != NULL ? exponents : task->exponents;
    double *moduli = array_grow(task->moduli, task->n, sizeof *moduli);
    task->moduli = moduli != NULL ? moduli : task->moduli;
    long *units = array_grow(task->units, task->n, sizeof *units);
    task->units = units != NULL ? units : task->units;
    if (exponents == NULL || moduli == NULL || units == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    exponents[task->n] = law->exponent;
    moduli[task->n] = log(law->modulus);
    units[task->n++] = unit;
    return WT_OK;
}

/* The law of a dwell behind an approach that was fitted; nothing in it without time, height or
 * force. */
static wt_status lay(const dwell_task *task, const wt_force_curve *curve, const wt_segment *s,
                     const wt_indent_fit *fit, double *room, held *h, wt_error *err)
{
    const double k = curve->cantilever.spring_constant;
    const double poisson = task->job->options.poisson_ratio;
    const double *time = segment_time(s, room), *height = segment_height(s);
    const double *force = segment_force(s, &curve->cantilever, room + s->n_points);
    *h = (held){.law = {.why_not = "no time, height or force in it"}};
    if (time == NULL || height == NULL || force == NULL || s->n_points <= BINS ||
        !(fit->load_time > 0))
        return WT_OK;
    h->load_time = fit->load_time;
    h->duration = time[s->n_points - 1] - time[0];
    bin_samples(s, time, height, force, fit, k, h);
    for (size_t i = 0; i < h->n; i++) {
        double g, slope;
        wt_contact_table_eval(task->contact, &h->indentation[i], 1, &g, &slope);
        h->modulus[i] = h->force[i] * (1 - poisson * poisson) / g;
        h->power = h->indentation[i] * slope / g;
    }
    if (h->n > 1)
        h->creep =
            fabs(h->height[h->n - 1] - h->height[0]) > fabs(h->force[h->n - 1] - h->force[0]) / k;
    return wt_dwell_fit(h->time, h->modulus, h->n, h->load_time, h->power, h->creep, &h->law, err);
}

/* The contact point of an elastic fit lies too far out if the rubber relaxes, and with it the time
 * of loading: the approach is fitted again with the power law, as a spectrum, until both agree. */
static wt_status lay_again(const dwell_task *task, const wt_force_curve *curve, const wt_segment *s,
                           wt_indent_fit *fit, double *room, held *h, wt_error *err)
{
    double time[TERMS], modulus[TERMS];
    wt_prony spectrum = {.reference_temperature = (double)NAN,
                         .n = TERMS,
                         .relaxation_time = time,
                         .modulus = modulus,
                         .frequency_min = (double)NAN,
                         .frequency_max = (double)NAN};
    wt_indent_options options = task->job->options;
    wt_status status = WT_OK;
    for (int pass = 0; pass < PASSES && status == WT_OK && h->law.found; pass++) {
        const double n = h->law.exponent, first = h->load_time * 1e-3,
                     ratio = log(1e6 * (1 + h->duration / h->load_time)) / (TERMS - 1);
        held again;
        wt_indent_fit refitted;
        if (!(n > least_exponent))
            break;
        for (size_t i = 0; i < TERMS; i++) {
            time[i] = first * exp(ratio * (double)i);
            modulus[i] = h->law.modulus * pow(time[i], -n) * ratio / tgamma(n);
        }
        options.spectrum = &spectrum;
        status =
            wt_indent_force_curve(task->contact, &options, curve, task->workspace, &refitted, err);
        if (status != WT_OK || !is_placed(&refitted) || !(refitted.load_time > 0))
            break;
        status = lay(task, curve, s, &refitted, room, &again, err);
        if (status != WT_OK || !again.law.found)
            break;
        *fit = refitted;
        *h = again;
    }
    return status;
}

static wt_status measure(dwell_task *task, const flow_file *file, long unit,
                         const wt_force_curve *curve, const wt_segment *s, wt_indent_fit *fit,
                         double *room, wt_error *err)
{
    table_writer *t = &task->rows;
    held h;
    wt_status status = lay(task, curve, s, fit, room, &h, err);
    if (status == WT_OK)
        status = lay_again(task, curve, s, fit, room, &h, err);
    if (status != WT_OK)
        return status;
    dwell_put_text(t, DWELL_KIND, h.n == 0 ? "" : h.creep ? "creep" : "relaxation");
    if (h.law.why_not[0] != '\0')
        dwell_put_text(t, DWELL_NOTE, h.law.why_not);
    if (h.n == 0)
        return WT_OK;
    dwell_put(t, DWELL_LOAD_TIME, h.load_time);
    dwell_put(t, DWELL_DURATION, h.duration);
    dwell_put(t, DWELL_FORCE_START, h.force[0]);
    dwell_put(t, DWELL_FORCE_END, h.force[h.n - 1]);
    dwell_put(t, DWELL_INDENTATION_START, h.indentation[0]);
    dwell_put(t, DWELL_INDENTATION_END, h.indentation[h.n - 1]);
    put_points(task, file, curve, &h);
    if (!h.law.found)
        return WT_OK;
    dwell_put(t, DWELL_EXPONENT, h.law.exponent);
    dwell_put(t, DWELL_MODULUS, h.law.modulus);
    dwell_put(t, DWELL_LOSS_FACTOR, tan(0.5 * pi * h.law.exponent));
    dwell_put(t, DWELL_MISFIT, h.law.misfit);
    return keep(task, &h.law, unit, err);
}

/* The dwells behind the approach, up to the retract. */
static wt_status read_curve(dwell_task *task, const flow_file *file, long unit,
                            const wt_force_curve *curve, wt_error *err)
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
        char note[200] = "";
        if (fit.verdict != WT_CURVE_ACCEPTED)
            snprintf(note, sizeof note, "approach: %s", fit.reason);
        dwell_put_text(&task->rows, DWELL_NOTE, note);
        if (!is_placed(&fit)) {
            dwell_put_text(&task->rows, DWELL_KIND, "");
            continue;
        }
        double *room = malloc(2 * s->n_points * sizeof *room);
        if (room == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        status = measure(task, file, unit, curve, s, &fit, room, err);
        free(room);
        break; /* what follows has another history */
    }
    return status;
}

static wt_status read_file(dwell_task *task, flow_file *file, long unit, wt_error *err)
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
            status = read_curve(task, file, unit, &curve, err);
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
        status = read_file(task, &files->file[i], (long)i, &failure);
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

static void set_keys(dwell_task *task)
{
    size_t n_units = 0;
    if (task->n == 0)
        return;
    const wt_interval exponent = wt_student_mean(task->exponents, task->units, task->n, &n_units);
    const wt_interval modulus = wt_student_mean(task->moduli, task->units, task->n, &n_units);
    const double mean = exp(modulus.value);
    dwell_set_value(&task->rows, DWELL_KEY_EXPONENT, exponent.value, exponent.standard_error, 0);
    dwell_set_value(&task->rows, DWELL_KEY_MODULUS, mean, mean * modulus.standard_error, 0);
    dwell_set_print(&task->rows, DWELL_KEY_UNITS, "%zu", n_units);
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
    if (status == WT_OK)
        status = wt_contact_table_new(&job->tip, depth_min, depth_max, &task.contact, err);
    if (status == WT_OK && (task.workspace = wt_indent_workspace_new()) == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    task.rows = table_begin(&dwell_schema, err);
    task.points = table_begin(&dwell_points_schema, err);
    if (status == WT_OK)
        status = read_files(&task, &files, err);
    set_keys(&task);
    const wt_status first = table_end(&task.rows, &made.dwell),
                    second = table_end(&task.points, &made.dwell_points);
    if (status == WT_OK)
        status = first != WT_OK ? first : second;
    if (status == WT_OK) {
        cost_say(work, (cost_summary){.items = (double)task.n_dwells});
        *tables = made;
        made = (wt_dwell_tables){0};
    }
    wt_dwell_tables_clear(&made);
    free(task.exponents);
    free(task.moduli);
    free(task.units);
    wt_indent_workspace_free(task.workspace);
    wt_contact_table_free(task.contact);
    flow_files_clear(&files);
    return status;
}
