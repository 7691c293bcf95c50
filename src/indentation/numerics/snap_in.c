/* Snap-in of the approach: a pull just before the force rises.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include "core/math/students_t.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <string.h>

/* Largest distance of a snap-in from the contact point of a fit without adhesion, over the
 * indentation. A more distant pull is an event of the baseline. */
static const double gap_tolerance = 0.5;
/* Smallest pull over the largest force that may displace the baseline so much that the pull is
 * hidden. For a smaller pull the extrapolation error of the line exceeds it. */
static const double large_pull = 0.25;

/* Samples of the tail of a pull. Their mean is below the baseline by the standard deviation of one
 * sample; white noise does so at one of 400 positions. */
enum { TAIL_SAMPLES = 8 };

size_t curve_tail_start(const double *above, size_t at, double noise)
{
    const size_t half = at / 2;
    const double scatter = half > 0 ? sqrt(curve_dot(above, above, half) / (double)half) : noise;
    while (at > 0 && above[at - 1] < -2.0 * noise && above[at - 1] < 0.0)
        at--;
    while (at >= TAIL_SAMPLES &&
           curve_sum(above + at - TAIL_SAMPLES, TAIL_SAMPLES) < -TAIL_SAMPLES * scatter)
        at--;
    return at;
}

/* Finds a pull relative to the baseline of p. Returns true if it exceeds everything before it
 * significantly. */
WIDE_REGISTERS static bool
find_prominent_pull(const curve_fitting *f, const double p[CURVE_N_PARAMETERS], curve_snap *found)
{
    const curve_samples *s = &f->input.samples;
    const curve_solution line = {
        .p = {[CURVE_C] = p[CURVE_C], [CURVE_F0] = p[CURVE_F0], [CURVE_T] = p[CURVE_T]}};
    double *restrict above = f->workspace->scratch;
    size_t deepest = 0;
    for (size_t i = 0; i < s->n; i++)
        above[i] = s->force[i] - curve_baseline(&line, s->position[i]);
    const double pull = -curve_find_span(above, s->n).low;
    while (-above[deepest] < pull)
        deepest++;
    const size_t start = curve_tail_start(above, deepest, f->input.step_noise);
    size_t end = deepest;
    while (end < s->n && above[end] < 0.0)
        end++;
    if (start < CURVE_BASELINE_SAMPLES)
        return false;
    double elsewhere = 0.0, noise = 0.0;
    for (size_t i = 0; i < start; i++) {
        elsewhere = -above[i] > elsewhere ? -above[i] : elsewhere;
        noise += above[i] * above[i];
    }
    noise = sqrt(noise / (double)start);
    const double after_contact = s->position[start] - p[CURVE_C];
    const double max_travel = s->position[s->n - 1] - p[CURVE_C];
    *found = (curve_snap){start, deepest, end, pull};
    return pull > CURVE_PULL_NOISE * noise && pull > CURVE_PULL_RATIO * elsewhere &&
           fabs(after_contact) < gap_tolerance * max_travel && end < s->n &&
           s->n - (end - start) >= CURVE_MIN_SAMPLES;
}

/* Sets the baseline of p to the line through the first n samples. Returns its standard error at the
 * contact point. */
static double fit_baseline_line(const curve_fitting *f, size_t n, double p[CURVE_N_PARAMETERS])
{
    const curve_samples *s = &f->input.samples;
    double offset, tilt, cov00, cov01, cov11, rest, baseline_force, error;
    (void)gsl_fit_linear(s->position, 1, s->force, 1, n, &offset, &tilt, &cov00, &cov01, &cov11,
                         &rest);
    if (!f->kind.tilt) {
        offset = curve_sum(s->force, n) / (double)n;
        cov00 = rest / (double)(n * n);
        tilt = cov01 = cov11 = 0.0;
    }
    (void)gsl_fit_linear_est(p[CURVE_C], offset, tilt, cov00, cov01, cov11, &baseline_force,
                             &error);
    p[CURVE_F0] = baseline_force;
    p[CURVE_T] = tilt;
    return error;
}

/* Finds a pull as large as the force, which displaces the baseline of a fit without it. The
 * reference is a line through the far half of the samples before the lowest force, at which contact
 * begins. */
static bool find_large_pull(const curve_fitting *f, double p[CURVE_N_PARAMETERS], curve_snap *found)
{
    const curve_samples *s = &f->input.samples;
    const double low = curve_find_span(s->force, s->n).low;
    size_t deepest = 0;
    while (s->force[deepest] > low)
        deepest++;
    const size_t half = deepest / 2;
    if (half < CURVE_BASELINE_SAMPLES || f->kind.contact_fixed)
        return false;
    p[CURVE_C] = s->position[deepest];
    const double error = fit_baseline_line(f, half, p);
    if (!find_prominent_pull(f, p, found))
        return false;
    const double top = curve_find_span(f->workspace->scratch, s->n).high;
    return found->deepest == deepest && found->pull > CURVE_PULL_NOISE * error &&
           found->pull > large_pull * top;
}

bool curve_find_snap_in(curve_fitting *f, curve_snap *found)
{
    double p[CURVE_N_PARAMETERS];
    memcpy(p, f->solution.p, sizeof p);
    if (!find_prominent_pull(f, p, found) && !find_large_pull(f, p, found)) {
        *found = (curve_snap){.pull = 0.0};
        return false;
    }
    (void)fit_baseline_line(f, found->start, p);
    memcpy(f->solution.p, p, sizeof p);
    return true;
}

void curve_exclude_samples(curve_fitting *f, size_t start, size_t end)
{
    curve_samples *s = &f->input.samples;
    const wt_indent_workspace *w = f->workspace;
    const size_t n_after = f->input.n_all - f->n_snap - end;
    memmove(s->position + start, s->position + end, n_after * sizeof *s->position);
    memmove(s->force + start, s->force + end, n_after * sizeof *s->force);
    if (s->force != w->force) /* the forces exclude a wave */
        memmove(w->force + start, w->force + end, n_after * sizeof *w->force);
    s->n -= end - start;
    f->n_snap += end - start;
}

/* Smallest pull over the largest force that changes a fit without it. */
static const double small_pull = 0.1;

double curve_left_out_pull(const wt_indent_fit *fit)
{
    const bool is_described =
        !isnan(fit->work_of_adhesion.value) || !isnan(fit->contact_pull.value);
    const double pull = fmax(fit->adhesion_force, fit->pull_off_force); /* fmax ignores NaN */
    return fit->adhesion_force > 0.0 && !is_described && pull > small_pull * fit->max_force ? pull
                                                                                            : 0.0;
}

double curve_left_out_error(const wt_indent_fit *fit)
{
    const double pull = curve_left_out_pull(fit);
    return pull > 0.0 ? pull / fit->max_force / NORMAL_95 : 0.0;
}
