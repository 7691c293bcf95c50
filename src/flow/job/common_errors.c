/* What the errors that all curves of a group share do to their moduli: a few curves are fitted anew
 * with spring constant, sensitivity, half-angle or radius moved by a standard error down and up, so
 * no exponent of a contact law is taken for granted. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/common_errors.h"

#include "data/force_curve.h"
#include "fit/curve.h"
#include "flow/job/curve_set.h"
#include "model/tip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a source without a stated error is moved by, and the most that any is: beyond it a curve may
 * no longer be one that is accepted. */
static const double small_step = 0.01, most_step = 0.3;

const char *common_source_words(wt_common_source source)
{
    static const char *const words[WT_COMMON_SOURCES] = {
        [WT_COMMON_SPRING_CONSTANT] = "spring constant",
        [WT_COMMON_SENSITIVITY] = "deflection sensitivity",
        [WT_COMMON_HALF_ANGLE] = "half-angle of the tip",
        [WT_COMMON_RADIUS] = "radius of the tip"};
    return words[source];
}

static double relative(double value, double error)
{
    return error > 0 ? error / value : (double)NAN;
}

static double first_known(double a, double b)
{
    return isnan(a) && b > 0 ? b : a;
}

static wt_tip moved_tip(const wt_tip *tip, wt_common_source source, double factor)
{
    wt_tip moved = *tip;
    /* a cap that was tangent to the faces stays so */
    const bool tangent =
        tip->transition_radius > 0 &&
        tip->transition_radius == wt_tip_tangent_transition(tip->radius, tip->half_angle);
    *(source == WT_COMMON_RADIUS ? &moved.radius : &moved.half_angle) *= factor;
    const double smooth =
        moved.radius * tip_facet_factor(tip->sides) / tan(moved.half_angle); /* else concave */
    if (tangent)
        moved.transition_radius = wt_tip_tangent_transition(moved.radius, moved.half_angle);
    else if (tip->transition_radius > 0)
        moved.transition_radius = fmin(tip->transition_radius, smooth);
    moved.half_angle_error = moved.radius_error = 0;
    return moved;
}

/* Tables of the moved tips. A step beyond 90 degrees is halved. */
static wt_status move_tip(const wt_tip *tip, wt_common_source source, common_errors *to,
                          wt_error *err)
{
    wt_status status = WT_OK;
    if (source == WT_COMMON_HALF_ANGLE)
        while (tip->half_angle * exp(to->step[source]) >= M_PI_2)
            to->step[source] /= 2;
    for (int way = 0; status == WT_OK && way < 2; way++) {
        const wt_tip moved = moved_tip(tip, source, exp((2 * way - 1) * to->step[source]));
        status = flow_contact_table(&moved, &to->tip[source][way], err);
    }
    return status;
}

wt_status common_errors_begin(const wt_indent_job *job, common_errors *to, wt_error *err)
{
    const wt_tip *tip = &job->tip;
    const wt_estimate k = job->spring_constant, s = job->sensitivity;
    *to = (common_errors){
        .error = {[WT_COMMON_SPRING_CONSTANT] =
                      first_known(relative(k.value, k.standard_error), job->lever_error),
                  [WT_COMMON_SENSITIVITY] =
                      first_known(relative(s.value, s.standard_error), job->sensitivity_error),
                  [WT_COMMON_HALF_ANGLE] = relative(tip->half_angle, tip->half_angle_error),
                  [WT_COMMON_RADIUS] = relative(tip->radius, tip->radius_error)},
        .stride = 1};
    for (int i = 0; i < WT_COMMON_SOURCES; i++) {
        to->stated = to->stated || to->error[i] > 0;
        to->step[i] = fmin(to->error[i] > 0 ? to->error[i] : small_step, most_step);
    }
    if (!(tip->half_angle > 0))
        to->step[WT_COMMON_HALF_ANGLE] = 0;
    if (!(tip->radius > 0))
        to->step[WT_COMMON_RADIUS] = 0;
    wt_status status = WT_OK;
    for (int i = WT_COMMON_HALF_ANGLE; i <= WT_COMMON_RADIUS; i++)
        if (status == WT_OK && to->stated && to->step[i] > 0)
            status = move_tip(tip, (wt_common_source)i, to, err);
    return status;
}

void common_errors_clear(common_errors *errors)
{
    for (int i = 0; i < WT_COMMON_SOURCES; i++)
        for (int way = 0; way < 2; way++)
            wt_contact_table_free(errors->tip[i][way]);
    free(errors->scratch);
    *errors = (common_errors){0};
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* A branch as it was measured, and the place of its forces, which are to be scaled. */
typedef struct branch {
    const double *height, *force, *time;
    double *scaled;
    size_t n;
} branch;

static branch branch_of(const wt_force_curve *curve, wt_segment_kind kind, double *scratch)
{
    const wt_segment *segment = wt_force_curve_segment(curve, kind);
    branch b = {.scaled = scratch};
    if (segment == NULL)
        return b;
    b.height = segment_height(segment);
    b.force = segment_force(segment, &curve->cantilever, scratch + segment->n_points);
    b.time = segment_time(segment, scratch + 2 * segment->n_points);
    b.n = b.height != NULL && b.force != NULL ? segment->n_points : 0;
    return b;
}

static curve_branch scale(const branch *b, double factor)
{
    for (size_t i = 0; i < b->n; i++)
        b->scaled[i] = factor * b->force[i];
    return (curve_branch){b->height, b->scaled, b->time, b->n};
}

static wt_status reserve(common_errors *to, size_t n, wt_error *err)
{
    if (n <= to->capacity)
        return WT_OK;
    double *scratch = realloc(to->scratch, n * sizeof *scratch);
    if (scratch == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    to->scratch = scratch;
    to->capacity = n;
    return WT_OK;
}

static size_t points(const wt_force_curve *curve, wt_segment_kind kind)
{
    const wt_segment *segment = wt_force_curve_segment(curve, kind);
    return segment != NULL ? segment->n_points : 0;
}

/* Keeps every second of them: those that remain are as if there had been half as many from the
 * start. */
static void thin_out(common_errors *to)
{
    for (size_t i = 0; 2 * i < to->n; i++)
        memcpy(to->gain[i], to->gain[2 * i], sizeof to->gain[i]);
    to->n = (to->n + 1) / 2;
    to->stride *= 2;
}

/* d ln E of a step of one source each way. The modulus of a fit that no longer passes its tests is
 * told all the same. */
static wt_status move(const common_errors *to, wt_common_source source,
                      const wt_contact_table *contact, const wt_indent_options *options,
                      const branch *in, const branch *out, double k, wt_indent_workspace *workspace,
                      double *gain, wt_error *err)
{
    const double step = to->step[source];
    double log_modulus[2] = {0, 0};
    for (int way = 0; way < 2; way++) {
        const double factor = exp((2 * way - 1) * step);
        const bool lever = source == WT_COMMON_SPRING_CONSTANT,
                   signal = lever || source == WT_COMMON_SENSITIVITY;
        const curve_branch scaled[2] = {scale(in, signal ? factor : 1),
                                        scale(out, signal ? factor : 1)};
        wt_indent_fit fit;
        const wt_status status =
            curve_fit_branches(signal ? contact : to->tip[source][way], options, &scaled[0],
                               &scaled[1], lever ? k * factor : k, workspace, &fit, err);
        if (status != WT_OK)
            return status;
        log_modulus[way] = fit.fitted_modulus > 0 ? log(fit.fitted_modulus) : (double)NAN;
    }
    *gain = (log_modulus[1] - log_modulus[0]) / (2 * step);
    return WT_OK;
}

wt_status common_errors_add(common_errors *to, const wt_contact_table *contact,
                            const wt_indent_options *options, const wt_force_curve *curve,
                            wt_indent_workspace *workspace, wt_error *err)
{
    if (!to->stated || to->seen++ % to->stride != 0)
        return WT_OK;
    if (to->n == COMMON_CURVES) {
        thin_out(to);
        if ((to->seen - 1) % to->stride != 0)
            return WT_OK;
    }
    const size_t n_in = points(curve, WT_SEGMENT_APPROACH),
                 n_out = points(curve, WT_SEGMENT_RETRACT);
    wt_status status = reserve(to, 3 * (n_in + n_out), err);
    if (status != WT_OK)
        return status;
    const branch in = branch_of(curve, WT_SEGMENT_APPROACH, to->scratch),
                 out = branch_of(curve, WT_SEGMENT_RETRACT, to->scratch + 3 * n_in);
    const double k = curve->cantilever.spring_constant;
    for (int i = 0; status == WT_OK && i < WT_COMMON_SOURCES; i++) {
        to->gain[to->n][i] = (double)NAN;
        if (to->step[i] > 0)
            status = move(to, (wt_common_source)i, contact, options, &in, &out, k, workspace,
                          &to->gain[to->n][i], err);
    }
    to->n++;
    return status;
}

void common_errors_set_keys(const common_errors *of, table_writer *rows)
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
