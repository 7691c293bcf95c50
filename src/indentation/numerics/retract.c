/* Adhesion and losses of one force curve: snap-in of the approach, pull-off force and hysteresis
 * loss of the retract, and the fit of a contact law to the retract.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/math/students_t.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve_fitting.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

/* ---- snap-in of the approach ----------------------------------------------------------------- */

/* Largest distance of a snap-in from the contact point of a fit without adhesion, over the
 * indentation. A more distant pull is an event of the baseline. */
static const double gap_tolerance = 0.5;

/* Smallest pull over the largest force that may displace the baseline so much that the pull is
 * hidden. For a smaller pull the extrapolation error of the line exceeds it. */
static const double large_pull = 0.25;

/* Samples of the tail of a pull. Their mean is below the baseline by the standard deviation of one
 * sample; white noise does so at one of 400 positions. */
enum { TAIL_SAMPLES = 8 };

/* Returns the sample at which a pull begins that lasts to sample `at`. The first half of the forces
 * above the baseline must be free of it. noise: of successive samples. */
static size_t curve_tail_start(const double *above, size_t at, double noise)
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
    const double elsewhere = fmax(0.0, -curve_find_span(above, start).low),
                 noise = sqrt(curve_dot(above, above, start) / (double)start);
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

/* ---- fit of the retract ---------------------------------------------------------------------- */

/* Parameter of a law for the pull-off force; NaN if the law does not apply. */
static double pull_off_parameter(const curve_fitting *f, const curve_kind *kind, double reduced)
{
    if (kind->constant_pull)
        return f->pull_off;
    return sqrt(
        adhesion_work(f->table, reduced, f->unloading.samples.spring_constant, f->pull_off));
}

bool curve_fit_unloading(const curve_fitting *f, const curve_kind *kind, const curve_solution *in,
                         curve_solution *out)
{
    const curve_samples *s = &f->unloading.samples;
    const size_t jump = f->unloading.jump;
    const bool adhesive = jump > 0;
    const curve_kind fitted = {.tilt = kind->tilt,
                               .adhesive = adhesive,
                               .constant_pull = adhesive && kind->constant_pull,
                               .jump = jump};
    double p[CURVE_N_PARAMETERS] = {[CURVE_E] = in->p[CURVE_E], [CURVE_C] = in->p[CURVE_C]};
    if (s->n < CURVE_MIN_SAMPLES ||
        (adhesive && (jump < CURVE_BASELINE_SAMPLES || s->n - jump < CURVE_CONTACT_SAMPLES)))
        return false;
    if (fitted.adhesive && !fitted.constant_pull && !adhesion_applies(contact_table_tip(f->table)))
        return false;
    if (adhesive)
        p[CURVE_W] = pull_off_parameter(f, kind, p[CURVE_E]);
    if (isnan(p[CURVE_W]))
        return false;
    curve_refine(f->table, s, fitted, p, f->workspace, out);
    return out->effective_n > 0.0;
}

/* Fits the laws and returns the best. Returns false if none fits. */
static bool fit_best_law(const curve_fitting *f, curve_solution *best, curve_kind *kind)
{
    const bool adhesive = f->unloading.jump > 0;
    bool found = false;
    for (int pull = 0; pull <= adhesive; pull++) {
        const curve_kind law = {.tilt = f->kind.tilt,
                                .adhesive = adhesive,
                                .constant_pull = pull,
                                .jump = f->unloading.jump};
        curve_solution out;
        if (!curve_fit_unloading(f, &law, &f->solution, &out) || !out.converged ||
            (found && !(out.cost < best->cost)))
            continue;
        found = true;
        *best = out;
        *kind = law;
    }
    return found;
}

static void append_retract_modulus(const curve_fitting *f, wt_indent_fit *fit)
{
    const double error = hypot(fit->modulus.standard_error, fit->retract_modulus.standard_error);
    char text[160];
    if (!wt_curve_verdict_is_usable(fit->verdict) || !(fabs(f->loss) < CURVE_MIN_LOSS) ||
        !(fabs(fit->retract_modulus.value - fit->modulus.value) > NORMAL_95 * error))
        return;
    curve_set_reason(text, "; the retract gives %s +- %s",
                     curve_format_si(fit->retract_modulus.value, "Pa").buffer,
                     curve_format_si(fit->retract_modulus.standard_error, "Pa").buffer);
    curve_append_note(fit->reason, text);
}

void curve_report_unloading(curve_fitting *f, wt_indent_fit *fit)
{
    const double reduced = 1.0 - f->options->poisson_ratio * f->options->poisson_ratio;
    curve_fitting out = *f;
    if (!fit_best_law(f, &out.solution, &out.kind))
        return;
    out.input.samples = f->unloading.samples;
    out.snap_in_pull = 0.0;
    curve_add_misfit(&out);
    const curve_solution *s = &out.solution;
    fit->retract_modulus.value = reduced * s->p[CURVE_E];
    fit->retract_modulus.standard_error = reduced * s->standard_error[CURVE_E];
    const double root = s->p[CURVE_W], error = s->standard_error[CURVE_W];
    if (out.kind.constant_pull) {
        fit->retract_pull.value = root;
        fit->retract_pull.standard_error = error;
    } else if (out.kind.adhesive) {
        fit->retract_work.value = root * root;
        fit->retract_work.standard_error = 2.0 * root * error;
    }
    append_retract_modulus(f, fit);
}

/* ---- analysis of the retract ----------------------------------------------------------------- */

/* Duration of half a pull-off over the retract. A pull-off is a jump except for a few samples. */
static const double pull_off_share = 0.02;
/* Limit of the loss. The sample may also lose work of the cantilever. Twice the work indicates a
 * drift. */
static const double max_loss = 2.0;
enum { CANTILEVER_ROUNDS = 50 };

/* ---- pull-off -------------------------------------------------------------------------------- */

static double select_median(double *x, size_t n)
{
    const curve_span all = curve_find_span(x, n);
    for (size_t i = 0; i < n; i++)
        x[i] -= all.low;
    return all.low + curve_select(x, n, n / 2, all.high - all.low);
}

static double clamp_value(double x, double from, double to)
{
    return x < from ? from : x > to ? to : x;
}

/* Median of three without branches, which noise would make unpredictable. */
static double middle_value(double a, double b, double c)
{
    const double low = a < b ? a : b, high = a < b ? b : a;
    const double least = c < high ? c : high;
    return least > low ? least : low;
}

/* Returns the largest pull of n smoothed forces above the baseline if it is significant and ends
 * abruptly in `ends`; else 0. `width` is the width of the smoothing. The forces at the far end are
 * free of the sample and have the standard deviation `noise`. */
WIDE_REGISTERS static double find_sudden_pull(const double *smoothed, const double *ends, size_t n,
                                              size_t width, size_t n_free, double noise)
{
    const size_t back = n_free < n ? n_free : n;
    const double elsewhere = fmax(0.0, -curve_find_span(smoothed + n - back, back).low),
                 pull = fmax(0.0, -curve_find_span(smoothed, n).low);
    size_t deepest = 0;
    while (pull > 0.0 && -smoothed[deepest] < pull)
        deepest++;
    bool is_sudden = false;
    const size_t last = deepest + width + (size_t)(pull_off_share * (double)n);
    for (size_t i = deepest; i < last && i < n; i++)
        is_sudden |= -ends[i] < 0.5 * pull;
    return is_sudden && pull > CURVE_PULL_NOISE * noise && pull > CURVE_PULL_RATIO * elsewhere
               ? pull
               : 0.0;
}

/* Robust standard deviation of n values. The last argument is a scratch array [n]. */
static double robust_scatter(const double *x, size_t n, double *scratch_values)
{
    for (size_t i = 0; i < n; i++)
        scratch_values[i] = fabs(x[i]);
    return select_median(scratch_values, n) / 0.6744897501960817;
}

/* Finds the pull-off with medians of three. If there is none, means over more and more samples are
 * used, up to the length of a pull-off, because single samples do not show a weak one. Adjacent
 * means share three quarters of their samples. */
WIDE_REGISTERS static double find_pull_off(const double *above, size_t n, size_t n_free,
                                           double *restrict smoothed, double *scratch_values)
{
    for (size_t i = 1; i + 1 < n; i++)
        smoothed[i - 1] = middle_value(above[i - 1], above[i], above[i + 1]);
    double pull = find_sudden_pull(smoothed, above + 1, n - 2, 3, n_free,
                                   robust_scatter(above + n - n_free, n_free, scratch_values));
    for (double part = 0.25; part <= 1.0 && !(pull > 0.0); part *= 2.0) {
        const size_t width = (size_t)(part * pull_off_share * (double)n);
        if (width < 4 || n_free < 4 * width)
            continue;
        enum { OVERLAP = 4 }; /* means that contain one sample; more of them add little */
        const size_t step = width / OVERLAP, means = (n - width) / step + 1,
                     free = (n_free - width) / step + 1, from = (n - width) % step;
        for (size_t i = 0; i < means; i++)
            smoothed[i] = curve_sum(above + from + i * step, width) / (double)width;
        pull = find_sudden_pull(smoothed, smoothed, means, OVERLAP, free,
                                robust_scatter(smoothed + means - free, free, scratch_values));
    }
    return pull;
}

/* Work of the base between two positions. The difference between approach and retract is the loss.
 */
static double branch_work(const double *position, const double *force, size_t n, double from,
                          double to)
{
    size_t start = 1; /* samples below `from` at either end have no work */
    while (start < n && !(position[start] > from))
        start++;
    while (n > start && !(position[n - 1] > from) && !(position[n - 2] > from))
        n--;
    double sum = 0.0, last = n > 0 ? clamp_value(position[start - 1], from, to) : 0.0;
    for (size_t i = start; i < n; i++) {
        const double first = last;
        last = clamp_value(position[i], from, to);
        if (!(fabs(last - first) > 0.0))
            continue;
        const double before = force[i - 1] > 0.0 ? force[i - 1] : 0.0,
                     after = force[i] > 0.0 ? force[i] : 0.0;
        const double step = position[i] - position[i - 1];
        const double middle = (0.5 * (first + last) - position[i - 1]) / step;
        sum += (before + middle * (after - before)) * (last - first);
    }
    return fabs(sum);
}

/* Work stored in the cantilever at a position, from the fit. For a soft cantilever it is nearly all
 * the work, and the noise of a single force would appear as loss. */
static double cantilever_energy(const curve_fitting *f, double top)
{
    const double *p = f->solution.p, k = f->input.samples.spring_constant,
                 z = fmax(top - p[CURVE_C], 0.0);
    double depth = z, step = z;
    for (int i = 0; i < CANTILEVER_ROUNDS && fabs(step) > 1e-9 * z; i++) {
        double g, slope;
        wt_contact_table_eval(f->table, &depth, 1, &g, &slope);
        step = (k * (z - depth) - p[CURVE_E] * g) / (k + p[CURVE_E] * slope);
        depth = fmax(depth + step, 0.0);
    }
    const double force = k * (z - depth);
    return 0.5 * force * force / k;
}

/* Computes positions of the retract and forces above the baseline. Returns the number of finite
 * samples. */
WIDE_REGISTERS static size_t measure_retract(const curve_fitting *f, const double *height,
                                             const double *force, size_t n)
{
    double *above = f->workspace->retract_force, *position = f->workspace->retract_position;
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) {
        position[i] = f->input.direction * height[i] - f->input.position_origin;
        above[i] = force[i] - f->input.force_origin - curve_baseline(&f->solution, position[i]);
    }
    sum = curve_sum(position, n) + curve_sum(above, n);
    if (isfinite(sum))
        return n;
    size_t n_kept = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(position[i]) && isfinite(above[i])) {
            position[n_kept] = position[i];
            above[n_kept++] = above[i];
        }
    return n_kept;
}

/* Subtracts the wave of the approach from n forces above the baseline. The subtraction only applies
 * if it reduces the variance at the far end, which is free of the sample. */
static void subtract_wave(const curve_fitting *f, const double *position, double *above, size_t n,
                          size_t n_free)
{
    const curve_wave *wave = &f->solution.wave;
    const double number = wave->p[WAVE_NUMBER];
    double *part = f->workspace->scratch;
    for (size_t i = 0; i < n; i++) {
        const double bent = i < n - n_free && !wave->by_height
                                ? fmax(above[i], 0.0) / f->input.samples.spring_constant
                                : 0.0;
        const double angle = number * (position[i] - bent);
        part[i] = wave->p[WAVE_COSINE] * cos(angle) + wave->p[WAVE_SINE] * sin(angle);
    }
    const double with = gsl_stats_variance(above + n - n_free, 1, n_free);
    for (size_t i = 0; i < n; i++)
        part[i] = above[i] - part[i];
    if (gsl_stats_variance(part + n - n_free, 1, n_free) < with)
        memcpy(above, part, n * sizeof *above);
}

/* Returns the first sample in contact of the reversed retract, after the edge of the pull-off. It
 * maximises the sum of departures from half the pull-off. */
static size_t find_pull_off_edge(const curve_samples *s, double pull)
{
    const double low = curve_find_span(s->force, s->n).low;
    double sum = 0.0, most = -(double)INFINITY;
    size_t edge = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (sum > most) {
            most = sum;
            edge = i;
        }
        sum += s->force[i] + 0.5 * pull;
        if (!(s->force[i] > low))
            break;
    }
    return edge;
}

/* Stores the reversed retract for a fit, without the samples during the jump of the cantilever,
 * which exceed the noise. */
static void store_unloading(curve_fitting *f, size_t n)
{
    wt_indent_workspace *w = f->workspace;
    curve_samples *s = &f->unloading.samples;
    *s = (curve_samples){
        n, w->retract_position, w->retract_force, f->input.samples.spring_constant, 0, 0};
    for (size_t i = 0; i < n / 2; i++) {
        const size_t j = n - 1 - i;
        const double z = s->position[i], force = s->force[i];
        s->position[i] = s->position[j];
        s->force[i] = s->force[j];
        s->position[j] = z;
        s->force[j] = force;
    }
    if (!(f->pull_off > 0.0))
        return;
    const double noise = f->input.step_noise, low = curve_find_span(s->force, n).low;
    size_t jump = find_pull_off_edge(s, f->pull_off), end = jump;
    if (-low > CURVE_PULL_NOISE * noise) {
        jump = curve_tail_start(s->force, jump, noise);
        while (s->force[end] > low)
            end++;
        end++;
    }
    memmove(s->position + jump, s->position + end, (n - end) * sizeof *s->position);
    memmove(s->force + jump, s->force + end, (n - end) * sizeof *s->force);
    s->n -= end - jump;
    f->unloading.jump = jump;
}

void curve_read_retract(curve_fitting *f, const double *height, const double *force, size_t n)
{
    wt_indent_workspace *w = f->workspace;
    const curve_samples *s = &f->input.samples;
    const double c = f->solution.p[CURVE_C];
    double *above = w->retract_force, *position = w->retract_position, *scratch = w->scratch;
    const size_t n_kept = measure_retract(f, height, force, n);
    const size_t n_free = n_kept / 4;
    if (n_free < CURVE_BASELINE_SAMPLES)
        return;
    if (curve_has_wave(&f->solution.wave))
        subtract_wave(f, position, above, n_kept, n_free);
    /* The far end has its own baseline, because of drag and drift. */
    memcpy(scratch, above + n_kept - n_free, n_free * sizeof *scratch);
    const double level = select_median(scratch, n_free);
    for (size_t i = 0; i < n_kept; i++)
        above[i] -= level;
    f->pull_off = find_pull_off(above, n_kept, n_free, scratch, w->weight);
    /* The comparison covers the common range, because the retract may begin below the top of the
     * approach. */
    const double top = fmin(curve_find_span(position, n_kept).high,
                            curve_find_span(s->position, f->input.n_all).high);
    const double back = branch_work(position, above, n_kept, c, top);
    for (size_t i = 0; i < f->input.n_all; i++)
        scratch[i] = s->force[i] - curve_baseline(&f->solution, s->position[i]);
    const double in = branch_work(s->position, scratch, f->input.n_all, c, top);
    const double share = (in - back) / (in - cantilever_energy(f, top));
    /* Otherwise the sample received too little work for a result. */
    if (share > 1.0 - max_loss && share < max_loss)
        f->loss = share;
    const bool is_needed = f->snap_in_pull > 0.0 || f->pull_off > 0.0 || f->options->fit_retract;
    if (is_needed && !curve_has_wave(&f->solution.wave))
        store_unloading(f, n_kept);
}
