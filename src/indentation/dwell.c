/* Job for dwells: relaxation at constant height and creep at constant force after the approach of
 * each curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/dwell.h"
#include "core/base/array.h"
#include "core/base/param.h"
#include "core/data/force_curve.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846; /* double precision */

/* Relative difference of two frequencies of one drive in contact and in air. Largest amplitude over
 * indentation: at a fifth, a force ~ depth^(3/2) changes the sine by 0.1 %. */
static const double same_drive_frequency = 0.01, small_amplitude = 0.2;

/* ---- held segments of one curve -------------------------------------------------------------- */

typedef struct segment_history {
    double *time, *position, *force, *scratch;
    size_t n;
} segment_history;

/* True for a dwell or a modulation with samples. */
static bool dwell_is_hold_segment(const wt_segment *s)
{
    return (s->kind == WT_SEGMENT_DWELL || s->kind == WT_SEGMENT_MODULATION) && s->n_points > 1;
}

/* Appends the samples of a segment with continuous times. Returns false if the segment lacks time,
 * height or force. */
static bool append_segment_samples(const wt_segment *s, const wt_cantilever *cantilever,
                                   double direction, segment_history *to)
{
    const double *time = segment_time(s, to->scratch), *height = segment_height(s),
                 *force = segment_force(s, cantilever, to->scratch + s->n_points);
    if (time == NULL || height == NULL || force == NULL || s->n_points < 2)
        return false;
    /* Times of a curve are continuous already. Times of a segment continue one time step after the
     * last sample of the previous segment. */
    double shift = 0;
    if (to->n > 1) {
        const double last = to->time[to->n - 1], step = last - to->time[to->n - 2];
        if (!(time[0] > last && time[0] < last + 100 * step))
            shift = last + step - time[0];
    }
    for (size_t i = 0; i < s->n_points; i++) {
        to->time[to->n] = time[i] + shift;
        to->position[to->n] = direction * height[i];
        to->force[to->n++] = force[i];
    }
    return true;
}

static void reserve_history(segment_history *h, const wt_force_curve *curve)
{
    size_t n = 0, longest = 0;
    for (size_t i = 0; i < curve->n_segments; i++) {
        n += curve->segments[i].n_points;
        longest = curve->segments[i].n_points > longest ? curve->segments[i].n_points : longest;
    }
    double *block = wt_alloc(3 * n + 2 * longest + 1, sizeof *block);
    *h = (segment_history){block, block + n, block + 2 * n, block + 3 * n, 0};
}

/* Fits the sine in the samples from `from` on, at the frequency of the file or else at the
 * strongest one. */
static wt_status fit_segment_sine(const wt_segment *s, const segment_history *h, size_t from,
                                  dwell_modulation *to, wt_error *err)
{
    const size_t n = h->n - from;
    *to = (dwell_modulation){.segment = s, .note = ""};
    wt_status status = wt_modulation_fit(h->time + from, h->position + from, h->force + from, n,
                                         2 * pi * s->frequency, &to->sine, err);
    if (status == WT_OK && !to->sine.found && s->frequency > 0)
        status = wt_modulation_fit(h->time + from, h->position + from, h->force + from, n,
                                   (double)NAN, &to->sine, err);
    if (status != WT_OK || !to->sine.found)
        return status;
    wt_modulation_remove(&to->sine, h->time + from, n, h->position + from, h->force + from);
    return WT_OK;
}

/* Finds modulations out of contact, before the approach or after the retract. */
static wt_status find_air_modulations(const wt_force_curve *curve, const wt_segment *approach,
                                      double direction, segment_history *h, dwell_curve *to,
                                      wt_error *err)
{
    bool is_held = false;
    wt_status status = WT_OK;
    for (const wt_segment *s = curve->segments;
         status == WT_OK && s < curve->segments + curve->n_segments; s++) {
        is_held = s >= approach && (is_held || s->kind == WT_SEGMENT_APPROACH) &&
                  s->kind != WT_SEGMENT_RETRACT;
        if (is_held || s->kind != WT_SEGMENT_MODULATION || to->n_air == DWELL_MAX_MODULATIONS)
            continue;
        h->n = 0;
        if (!append_segment_samples(s, &curve->cantilever, direction, h))
            continue;
        status = fit_segment_sine(s, h, 0, &to->air[to->n_air], err);
        to->n_air += status == WT_OK && to->air[to->n_air].sine.found ? 1 : 0;
    }
    h->n = 0;
    return status;
}

/* Slope of the contact function at a mean depth, over 1 - nu^2. */
static double contact_slope(const wt_contact_table *contact, double depth, double poisson)
{
    double g, slope;
    wt_contact_table_eval(contact, &depth, 1, &g, &slope);
    return slope / (1 - poisson * poisson);
}

/* True if E' is positive and E'' is positive or compatible with 0. Other values indicate a wrong
 * model. Values of E'' near 0 are valid, because their exclusion would bias the means of many
 * curves. */
static bool dwell_is_valid_modulus(const wt_dwell_moduli *m)
{
    return m->storage.value > 0 &&
           (m->loss.value > 0 || m->loss.value > -NORMAL_95 * m->loss.standard_error);
}

static wt_status compute_modulation_moduli(const wt_contact_table *contact, double poisson,
                                           double spring_constant, const wt_indent_fit *fit,
                                           const dwell_curve *c, dwell_modulation *m, wt_error *err)
{
    const wt_dwell *d = &c->dwell;
    const bool has_dwell_fit = d->found;
    const double z =
        m->sine.mean[0] - (has_dwell_fit ? d->contact_point : fit->contact_point.value);
    m->above = m->sine.mean[1] - (has_dwell_fit
                                      ? d->baseline_offset + d->baseline_tilt * z +
                                            d->drift * (m->sine.mean_time - d->drift_start)
                                      : fit->baseline_offset.value + fit->baseline_tilt.value * z);
    m->indentation = tip_position(z, m->above, spring_constant);
    if (!(m->indentation > 0) || !(m->above > 0)) {
        m->note = "not in contact, or it pulls";
        return WT_OK;
    }
    if (!contact_law_is_valid(contact_table_tip(contact), m->indentation)) {
        m->note = "deeper than the contact law of the tip holds";
        return WT_OK;
    }
    const double slope = contact_slope(contact, m->indentation, poisson);
    const double common = has_dwell_fit ? d->indentation_common_error : (double)NAN;
    const bool described = isfinite(common);
    const dwell_modulation *air = NULL;
    for (size_t i = 0; i < c->n_air; i++)
        if (fabs(c->air[i].sine.angular_frequency - m->sine.angular_frequency) <
            same_drive_frequency * m->sine.angular_frequency)
            air = &c->air[i];
    const double *a = m->sine.amplitude;
    m->amplitude = hypot(a[0] - a[2] / spring_constant, a[1] - a[3] / spring_constant);
    m->note = !has_dwell_fit ? "the contact point is that of an elastic fit"
              : !described   ? "the dwell is not described, nor is the contact point"
              : m->amplitude > small_amplitude * m->indentation
                  ? "the amplitude is more than a fifth of the indentation"
              : air == NULL ? "it contains drag and the lag of the instrument: there is no "
                              "modulation in air"
                            : "";
    const wt_status status = wt_modulation_moduli(&m->sine, air != NULL ? &air->sine : NULL,
                                                  spring_constant, slope, &m->moduli, err);
    const double share =
        described ? contact_slope(contact, m->indentation + common, poisson) / slope - 1 : common;
    m->moduli.storage_common_error = fabs(share * m->moduli.storage.value);
    m->moduli.loss_common_error = fabs(share * m->moduli.loss.value);
    m->found = dwell_is_valid_modulus(&m->moduli);
    if (!m->found)
        m->note = "E' or E'' is not positive: no modulus; the lag of the instrument may be "
                  "larger than that of the sample (a modulation in air shows it)";
    return status;
}

/* Collects the approach and the held segments, without their sines. */
static wt_status collect_history(const wt_force_curve *curve, const wt_segment *approach,
                                 const wt_segment *first, double direction, segment_history *h,
                                 wt_dwell_history *of, dwell_curve *to, wt_error *err)
{
    const wt_segment *const end = curve->segments + curve->n_segments, *s = first;
    wt_status status = WT_OK;
    if (!append_segment_samples(approach, &curve->cantilever, direction, h))
        return WT_OK;
    of->n_approach = h->n;
    for (; s < end && dwell_is_hold_segment(s) && status == WT_OK; s++) {
        const size_t from = h->n;
        if (!append_segment_samples(s, &curve->cantilever, direction, h))
            break;
        if (to->n == DWELL_MAX_MODULATIONS)
            continue;
        status = fit_segment_sine(s, h, from, &to->modulations[to->n], err);
        if (to->modulations[to->n].sine.found || s->kind == WT_SEGMENT_MODULATION)
            to->n++;
    }
    of->n_dwell = h->n - of->n_approach;
    if (status == WT_OK && s < end && s->kind == WT_SEGMENT_RETRACT &&
        append_segment_samples(s, &curve->cantilever, direction, h))
        of->n_retract = h->n - of->n_approach - of->n_dwell;
    return status;
}

/* Fits the segments from `first` to the retract, after an approach that was fitted. */
static wt_status dwell_curve_fit(const wt_contact_table *contact, double poisson,
                                 const wt_force_curve *curve, const wt_segment *approach,
                                 const wt_segment *first, const wt_indent_fit *fit, dwell_curve *to,
                                 wt_error *err)
{
    const double k = curve->cantilever.spring_constant;
    segment_history h = {0};
    *to = (dwell_curve){.dwell.reason = "no time, height or force in it"};
    reserve_history(&h, curve);
    double *const block = h.time;
    wt_dwell_history of = {.time = h.time,
                           .position = h.position,
                           .force = h.force,
                           .spring_constant = k,
                           .poisson_ratio = poisson,
                           .contact_point = fit->contact_point.value,
                           .modulus = fit->modulus.value,
                           .baseline_offset = fit->baseline_offset.value,
                           .baseline_tilt = fit->baseline_tilt};
    wt_status status = find_air_modulations(curve, approach, fit->direction, &h, to, err);
    if (status == WT_OK)
        status = collect_history(curve, approach, first, fit->direction, &h, &of, to, err);
    if (status == WT_OK && of.n_dwell > 0)
        status = wt_dwell_fit(contact, &of, &to->dwell, err);
    for (size_t i = 0; status == WT_OK && i < to->n; i++) {
        if (to->modulations[i].sine.found)
            status =
                compute_modulation_moduli(contact, poisson, k, fit, to, &to->modulations[i], err);
        else
            to->modulations[i].note = to->modulations[i].sine.reason;
    }
    free(block);
    return status;
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Customary significance level of the misfit. Below it wt_dwell states no standard errors. */
static const double misfit_p_threshold = 0.01;

typedef struct dwell_task {
    const wt_indent_job *job;
    const wt_job *work;
    wt_contact_table *contact;
    wt_indent_workspace *workspace;
    table_writer rows, points, moduli;
    size_t n_dwells;
    size_t n_held;        /* curves of the file with a dwell */
    copied_curves copies; /* among them */
    dwell_curve curve;    /* latest curve */
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
            ? "a rubber with a broad spectrum does not describe it; no errors are reported"
        : isnan(d->misfit_p) ? "whether a rubber with a broad spectrum describes it could not "
                               "be tested; no errors are reported"
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
static wt_status read_dwell_curve(dwell_task *task, flow_file *file, const wt_force_curve *curve,
                                  wt_error *err)
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
    task->n_held++;
    if (fit.modulus.value > 0 &&
        flow_is_copied_curve(file, condition_hash_curve(file, curve), &task->copies))
        return WT_OK;
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
    task->n_held = 0;
    task->copies = (copied_curves){0};
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
    flow_log_copies(file, &task->copies, task->n_held, task->work);
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
    flow_files files = {0};
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
    wt_tables_clear(&result, sizeof result);
    wt_indent_workspace_free(task.workspace);
    wt_contact_table_free(task.contact);
    flow_files_clear(&files);
    return status;
}
