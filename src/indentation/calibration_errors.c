/* Propagation of shared calibration errors to the moduli of a group. A few curves are fitted again
 * with spring constant, sensitivity, half-angle or radius shifted down and up by one standard
 * error. The method assumes no exponent of a contact law.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/calibration_errors.h"
#include "indentation/indent.h"

#include "core/data/force_curve.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative shift of a source without a stated error, and upper limit of each shift. A curve may no
 * longer be accepted after a larger shift. */
static const double small_step = 0.01, most_step = 0.3;

const char *calibration_source_text(wt_shared_law_source source)
{
    static const char *const words[WT_COMMON_SOURCES] = {
        [WT_COMMON_SPRING_CONSTANT] = "spring constant",
        [WT_COMMON_SENSITIVITY] = "deflection sensitivity",
        [WT_COMMON_HALF_ANGLE] = "half-angle of the tip",
        [WT_COMMON_RADIUS] = "radius of the tip"};
    return words[source];
}

static double relative_error(double value, double error)
{
    return error > 0 ? error / value : (double)NAN;
}

static double first_known(double a, double b)
{
    return isnan(a) && b > 0 ? b : a;
}

static wt_tip moved_tip(const wt_tip *tip, wt_shared_law_source source, double factor)
{
    wt_tip moved = *tip;
    /* A cap that was tangent to the faces stays tangent. */
    const bool tangent =
        tip->transition_radius > 0 &&
        tip->transition_radius == wt_tip_tangent_transition(tip->radius, tip->half_angle);
    *(source == WT_COMMON_RADIUS ? &moved.radius : &moved.half_angle) *= factor;
    const double smooth =
        moved.radius * tip_facet_factor(tip->sides) /
        tan(moved.half_angle); /* a larger transition radius makes the tip concave */
    if (tangent)
        moved.transition_radius = wt_tip_tangent_transition(moved.radius, moved.half_angle);
    else if (tip->transition_radius > 0)
        moved.transition_radius = fmin(tip->transition_radius, smooth);
    moved.half_angle_error = moved.radius_error = 0;
    return moved;
}

/* Creates the contact tables of the shifted tips. A step beyond 90 degrees is halved. */
static wt_status move_tip(const wt_tip *tip, wt_shared_law_source source, calibration_errors *to,
                          wt_error *err)
{
    wt_status status = WT_OK;
    if (source == WT_COMMON_HALF_ANGLE)
        while (tip->half_angle * exp(to->step[source]) >= M_PI_2)
            to->step[source] /= 2;
    for (int way = 0; status == WT_OK && way < 2; way++) {
        const wt_tip moved = moved_tip(tip, source, exp((2 * way - 1) * to->step[source]));
        status = indent_contact_table(&moved, &to->tip[source][way], err);
    }
    return status;
}

wt_status calibration_errors_begin(const wt_indent_job *job, calibration_errors *to, wt_error *err)
{
    const wt_tip *tip = &job->tip;
    const wt_estimate k = job->spring_constant, s = job->sensitivity;
    *to = (calibration_errors){
        .error = {[WT_COMMON_SPRING_CONSTANT] =
                      first_known(relative_error(k.value, k.standard_error), job->lever_error),
                  [WT_COMMON_SENSITIVITY] = first_known(relative_error(s.value, s.standard_error),
                                                        job->sensitivity_error),
                  [WT_COMMON_HALF_ANGLE] = relative_error(tip->half_angle, tip->half_angle_error),
                  [WT_COMMON_RADIUS] = relative_error(tip->radius, tip->radius_error)},
        .stride = 1};
    for (int i = 0; i < WT_COMMON_SOURCES; i++) {
        to->stated = to->stated || to->error[i] > 0;
        to->step[i] = fmin(to->error[i] > 0 ? to->error[i] : small_step, most_step);
    }
    if (!(tip->half_angle > 0))
        to->step[WT_COMMON_HALF_ANGLE] = 0;
    if (!(tip->radius > 0))
        to->step[WT_COMMON_RADIUS] = 0;
    const bool tells_misfit =
        job->options.least_chance > 0; /* the misfit test needs the effect of an unstated radius */
    wt_status status = WT_OK;
    for (int i = WT_COMMON_HALF_ANGLE; i <= WT_COMMON_RADIUS; i++)
        if (status == WT_OK && to->step[i] > 0 &&
            (to->stated || (i == WT_COMMON_RADIUS && tells_misfit)))
            status = move_tip(tip, (wt_shared_law_source)i, to, err);
    return status;
}

void calibration_errors_apply(const calibration_errors *of, wt_indent_workspace *workspace)
{
    size_t n = 0;
    for (int i = WT_COMMON_HALF_ANGLE; i <= WT_COMMON_RADIUS; i++)
        if (of->error[i] > 0 && of->tip[i][1] != NULL)
            workspace->tip_move[n++] =
                (tip_move){of->tip[i][0], of->tip[i][1], of->error[i] / of->step[i]};
    const double step = of->step[WT_COMMON_RADIUS];
    if (!(of->error[WT_COMMON_RADIUS] > 0) && of->tip[WT_COMMON_RADIUS][1] != NULL)
        workspace->any_radius =
            (tip_move){of->tip[WT_COMMON_RADIUS][0], of->tip[WT_COMMON_RADIUS][1], 1 / step};
}

cached_tips calibration_errors_reset(wt_indent_workspace *workspace)
{
    cached_tips told = {.any_radius = workspace->any_radius};
    memcpy(told.moves, workspace->tip_move, sizeof told.moves);
    memset(workspace->tip_move, 0, sizeof workspace->tip_move);
    workspace->any_radius = (tip_move){0};
    return told;
}

void calibration_errors_apply_cached(const cached_tips *told, wt_indent_workspace *workspace)
{
    memcpy(workspace->tip_move, told->moves, sizeof told->moves);
    workspace->any_radius = told->any_radius;
}

static void clear_curve(common_curve *curve)
{
    for (int i = 0; i < 2; i++)
        free(curve->branch[i].height);
    *curve = (common_curve){0};
}

void calibration_errors_clear(calibration_errors *errors)
{
    for (int i = 0; i < WT_COMMON_SOURCES; i++)
        for (int way = 0; way < 2; way++)
            wt_contact_table_free(errors->tip[i][way]);
    for (size_t i = 0; i < errors->n; i++)
        clear_curve(&errors->curve[i]);
    *errors = (calibration_errors){0};
}

/* ---- curves ---------------------------------------------------------------------------------- */

static wt_status copy_branch(const wt_force_curve *curve, wt_segment_kind kind, common_branch *to,
                             wt_error *err)
{
    const wt_segment *segment = wt_force_curve_segment(curve, kind);
    if (segment == NULL || segment->n_points == 0)
        return WT_OK;
    const size_t n = segment->n_points, bytes = n * sizeof(double);
    double *store = malloc(3 * bytes);
    if (store == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *to = (common_branch){.height = store, .force = store + n};
    const double *height = segment_height(segment),
                 *force = segment_force(segment, &curve->cantilever, to->force),
                 *time = segment_time(segment, store + 2 * n);
    if (height == NULL || force == NULL)
        return WT_OK;
    memcpy(to->height, height, bytes);
    memmove(to->force, force, bytes);
    if (time != NULL)
        to->time = memmove(store + 2 * n, time, bytes);
    to->n = n;
    return WT_OK;
}

/* Keeps every second curve. The remaining curves are those that twice the stride selects from the
 * start. */
static void thin_out(calibration_errors *to)
{
    size_t kept = 0;
    for (size_t i = 0; i < to->n; i++)
        if (i % 2 == 0)
            to->curve[kept++] = to->curve[i];
        else
            clear_curve(&to->curve[i]);
    to->n = kept;
    to->stride *= 2;
}

wt_status calibration_errors_store(calibration_errors *to, const wt_force_curve *curve,
                                   const wt_contact_table *contact, bool own_tip, wt_error *err)
{
    if (!to->stated || to->seen++ % to->stride != 0)
        return WT_OK;
    if (to->n == COMMON_CURVES) {
        thin_out(to);
        if ((to->seen - 1) % to->stride != 0)
            return WT_OK;
    }
    common_curve *kept = &to->curve[to->n++];
    *kept = (common_curve){.spring_constant = curve->cantilever.spring_constant,
                           .contact = contact,
                           .own_tip = own_tip};
    const wt_status status = copy_branch(curve, WT_SEGMENT_APPROACH, &kept->branch[0], err);
    return status == WT_OK ? copy_branch(curve, WT_SEGMENT_RETRACT, &kept->branch[1], err) : status;
}

/* ---- fits ------------------------------------------------------------------------------------ */

typedef struct refit {
    calibration_errors *to;
    const wt_indent_options *options;
    wt_indent_workspace *const *workspaces;
    double *scratch; /* scaled forces, [capacity] for each thread */
    size_t room;
    wt_error *errors; /* one error for each item */
} refit;

static curve_branch scale_branch(const common_branch *b, double factor, double *scaled)
{
    for (size_t i = 0; i < b->n; i++)
        scaled[i] = factor * b->force[i];
    return (curve_branch){b->height, scaled, b->time, b->n};
}

/* Computes the logarithm of the modulus of a curve with a shifted source. The source scales the
 * forces or changes the tip. A fit that no longer passes its tests counts as well. */
static wt_status fit_moved(const refit *f, size_t item, int way, unsigned worker,
                           double *log_modulus)
{
    const calibration_errors *to = f->to;
    const wt_shared_law_source source = (wt_shared_law_source)(item % WT_COMMON_SOURCES);
    const common_curve *curve = &to->curve[item / WT_COMMON_SOURCES];
    const double factor = exp((2 * way - 1) * to->step[source]);
    double *scratch = f->scratch + worker * f->room;
    const bool lever = source == WT_COMMON_SPRING_CONSTANT,
               signal = lever || source == WT_COMMON_SENSITIVITY;
    const curve_branch scaled[2] = {
        scale_branch(&curve->branch[0], signal ? factor : 1, scratch),
        scale_branch(&curve->branch[1], signal ? factor : 1, scratch + curve->branch[0].n)};
    wt_indent_workspace *workspace = f->workspaces[worker];
    cached_tips told;
    wt_indent_fit fit;
    if (curve->own_tip)
        told = calibration_errors_reset(workspace);
    const wt_status status = curve_fit_branches(
        signal ? curve->contact : to->tip[source][way], f->options, &scaled[0], &scaled[1],
        curve->spring_constant * (lever ? factor : 1), workspace, &fit, &f->errors[item]);
    if (curve->own_tip)
        calibration_errors_apply_cached(&told, workspace);
    if (status == WT_OK)
        *log_modulus = fit.modulus.value > 0 ? log(fit.modulus.value) : (double)NAN;
    return status;
}

/* Computes d ln E / d ln source from one step in each direction. The tip of a single file has no
 * stated error, so its sources are not shifted. */
static wt_status move_source(void *user, size_t item, unsigned worker)
{
    const refit *f = user;
    calibration_errors *to = f->to;
    const size_t at = item / WT_COMMON_SOURCES;
    const wt_shared_law_source source = (wt_shared_law_source)(item % WT_COMMON_SOURCES);
    const bool of_tip = source == WT_COMMON_HALF_ANGLE || source == WT_COMMON_RADIUS;
    const double step = of_tip && to->curve[at].own_tip ? 0 : to->step[source];
    double log_modulus[2] = {0, 0};
    to->gain[at][source] = (double)NAN;
    for (int way = 0; way < 2 && step > 0; way++) {
        const wt_status status = fit_moved(f, item, way, worker, &log_modulus[way]);
        if (status != WT_OK)
            return status;
    }
    if (step > 0)
        to->gain[at][source] = (log_modulus[1] - log_modulus[0]) / (2 * step);
    return WT_OK;
}

wt_status calibration_errors_fit(calibration_errors *to, const wt_indent_options *options,
                                 unsigned threads, wt_indent_workspace *const *workspaces,
                                 wt_error *err)
{
    const size_t n = to->n * WT_COMMON_SOURCES;
    refit f = {.to = to, .options = options, .workspaces = workspaces};
    if (n == 0)
        return WT_OK;
    for (size_t i = 0; i < to->n; i++)
        if (f.room < to->curve[i].branch[0].n + to->curve[i].branch[1].n)
            f.room = to->curve[i].branch[0].n + to->curve[i].branch[1].n;
    f.scratch = calloc(threads * f.room, sizeof *f.scratch);
    f.errors = calloc(n, sizeof *f.errors);
    wt_status status = WT_E_MEMORY;
    if (f.scratch == NULL || f.errors == NULL) {
        status = wt_fail(err, status, "out of memory");
    } else {
        status = wt_parallel_for(n, threads, move_source, &f, NULL, "fitting curves anew");
        size_t first = 0;
        while (first < n && f.errors[first].status == WT_OK)
            first++;
        if (status != WT_OK && first == n)
            (void)wt_fail(err, status, "fitting in parallel failed");
        else if (status != WT_OK && err != NULL)
            *err = f.errors[first];
    }
    free(f.scratch);
    free(f.errors);
    return status;
}

void calibration_errors_set_keys(const calibration_errors *of, table_writer *rows)
{
    for (int i = 0; i < WT_COMMON_SOURCES && of->stated; i++) {
        const indentation_key error = (indentation_key)(INDENTATION_KEY_LEVER_ERROR + i),
                              gain = (indentation_key)(INDENTATION_KEY_LEVER_GAIN + i);
        double sum = 0, squares = 0;
        size_t n = 0;
        for (size_t j = 0; j < of->n; j++) {
            if (isnan(of->gain[j][i]))
                continue;
            const double step = of->gain[j][i] - sum;
            sum += step / (double)++n;
            squares += step * (of->gain[j][i] - sum);
        }
        if (of->error[i] > 0)
            indentation_set_value(rows, error, of->error[i], 0, 0);
        if (n > 0)
            indentation_set_value(rows, gain, sum,
                                  n > 1 ? sqrt(squares / (double)((n - 1) * n)) : (double)NAN, 0);
    }
}
