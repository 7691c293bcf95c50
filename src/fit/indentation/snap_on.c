/* A snap-on of the approach: the pull right before the force rises.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/indentation/curve_fitting.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <string.h>

/* Of the indentation: how far from the contact point of a fit without adhesion a snap-on may lie;
 * beyond it is an event of the baseline. */
static const double gap_tolerance = 0.5;
/* Of the largest force: a smaller pull draws no baseline along so far that it does not stand out,
 * and what a line that is continued to twice its length misses is a bend of the baseline. */
static const double large_pull = 0.25;

/* That stands out of everything before it, above the baseline of p. */
WIDE_REGISTERS static bool stands_out(const curve_fitting *f, const double p[CURVE_N_PARAMETERS],
                                      curve_snap *found)
{
    const curve_samples *s = &f->input.samples;
    const curve_solution line = {
        .p = {[CURVE_C] = p[CURVE_C], [CURVE_F0] = p[CURVE_F0], [CURVE_T] = p[CURVE_T]}};
    double *restrict above = f->workspace->scratch;
    size_t deepest = 0;
    for (size_t i = 0; i < s->n; i++)
        above[i] = s->force[i] - curve_baseline(&line, s->position[i]);
    const double pull = -curve_span_of(above, s->n).low;
    while (-above[deepest] < pull)
        deepest++;
    size_t start = deepest, end = deepest;
    while (start > 0 && above[start - 1] < -2.0 * f->input.step_noise && above[start - 1] < 0.0)
        start--;
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
    const double reach = s->position[s->n - 1] - p[CURVE_C];
    *found = (curve_snap){start, deepest, end, pull};
    return pull > CURVE_PULL_NOISE * noise && pull > CURVE_PULL_REST * elsewhere &&
           fabs(after_contact) < gap_tolerance * reach && end < s->n &&
           s->n - (end - start) >= CURVE_MIN_SAMPLES;
}

/* A pull as large as the force draws the baseline of a fit without it along: the line through the
 * far half of what is before the lowest force is free of it, which is where the tip touches.
 * Returns its standard error there; INFINITY: there is no such line. */
static double far_baseline(const curve_fitting *f, double p[CURVE_N_PARAMETERS])
{
    const curve_samples *s = &f->input.samples;
    const double low = curve_span_of(s->force, s->n).low;
    double offset, tilt, cov00, cov01, cov11, rest, there, error;
    size_t deepest = 0;
    while (s->force[deepest] > low)
        deepest++;
    const size_t half = deepest / 2;
    if (half < CURVE_BASELINE_SAMPLES || f->kind.contact_fixed)
        return (double)INFINITY;
    (void)gsl_fit_linear(s->position, 1, s->force, 1, half, &offset, &tilt, &cov00, &cov01, &cov11,
                         &rest);
    if (!f->kind.tilt) {
        offset = curve_sum(s->force, half) / (double)half;
        cov00 = rest / (double)(half * half);
        tilt = cov01 = cov11 = 0.0;
    }
    p[CURVE_C] = s->position[deepest];
    (void)gsl_fit_linear_est(p[CURVE_C], offset, tilt, cov00, cov01, cov11, &there, &error);
    p[CURVE_F0] = there;
    p[CURVE_T] = tilt;
    return error;
}

bool curve_find_snap(curve_fitting *f, curve_snap *found)
{
    const curve_samples *s = &f->input.samples;
    double p[CURVE_N_PARAMETERS];
    if (stands_out(f, f->solution.p, found))
        return true;
    memcpy(p, f->solution.p, sizeof p);
    const double error = far_baseline(f, p);
    if (!isfinite(error) || !stands_out(f, p, found))
        return false;
    const double top = curve_span_of(f->workspace->scratch, s->n).high;
    if (s->position[found->deepest] < p[CURVE_C] || s->position[found->deepest] > p[CURVE_C] ||
        !(found->pull > CURVE_PULL_NOISE * error) || !(found->pull > large_pull * top))
        return false;
    memcpy(f->solution.p, p, sizeof p);
    return true;
}

void curve_leave_out(curve_fitting *f, size_t start, size_t end)
{
    curve_samples *s = &f->input.samples;
    const wt_indent_workspace *w = f->workspace;
    const size_t behind = f->input.n_all - f->n_snap - end;
    memmove(s->position + start, s->position + end, behind * sizeof *s->position);
    memmove(s->force + start, s->force + end, behind * sizeof *s->force);
    if (s->force != w->force) /* less a wave */
        memmove(w->force + start, w->force + end, behind * sizeof *w->force);
    s->n -= end - start;
    f->n_snap += end - start;
}
