/* Analysis of the retract of one force curve: pull-off force and hysteresis loss.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

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
WIDE_REGISTERS static double find_sudden_pull(const double *smooth, const double *ends, size_t n,
                                              size_t width, size_t n_free, double noise)
{
    const size_t back = n_free < n ? n_free : n;
    const double elsewhere = fmax(0.0, -curve_find_span(smooth + n - back, back).low),
                 pull = fmax(0.0, -curve_find_span(smooth, n).low);
    size_t deepest = 0;
    while (pull > 0.0 && -smooth[deepest] < pull)
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
 * used, up to the length of a pull-off, because single samples do not show a weak one. */
static double find_pull_off(const double *above, size_t n, size_t n_free, double *smooth,
                            double *scratch_values)
{
    for (size_t i = 1; i + 1 < n; i++)
        smooth[i - 1] = middle_value(above[i - 1], above[i], above[i + 1]);
    double pull = find_sudden_pull(smooth, above + 1, n - 2, 3, n_free,
                                   robust_scatter(above + n - n_free, n_free, scratch_values));
    for (double part = 0.25; part <= 1.0 && !(pull > 0.0); part *= 2.0) {
        const size_t width = (size_t)(part * pull_off_share * (double)n);
        if (width < 4 || n_free < 4 * width)
            continue;
        const size_t means = n - width + 1, free = n_free - width + 1;
        double sum = curve_sum(above, width);
        for (size_t i = 0; i < means; i++) {
            smooth[i] = sum / (double)width;
            sum += i + width < n ? above[i + width] - above[i] : 0.0;
        }
        pull = find_sudden_pull(smooth, smooth, means, width, free,
                                robust_scatter(smooth + means - free, free, scratch_values));
    }
    return pull;
}

/* Work of the base between two positions. The difference between approach and retract is the loss.
 */
static double branch_work(const double *position, const double *force, size_t n, double from,
                          double to)
{
    double sum = 0.0, last = n > 0 ? clamp_value(position[0], from, to) : 0.0;
    for (size_t i = 1; i < n; i++) {
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
    if (!curve_has_wave(&f->solution.wave))
        store_unloading(f, n_kept);
}
