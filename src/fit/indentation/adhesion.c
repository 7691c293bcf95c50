/* Adhesion of one force curve: a snap-on of the approach, the pull-off of the retract, and the fit
 * of adhesive contact where there is one of them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/indentation/curve_fitting.h"

#include "model/adhesion.h"
#include "model/tip.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A pull, in noise of the baseline: white noise gets there once in 1e9 samples, and maps have 1e8.
 */
static const double snap_noise = 6.0;
/* And against the deepest pull elsewhere: two waves of one drift differ by less. */
static const double snap_rest = 1.5;
/* Of the indentation: how far from the contact point of a fit without adhesion a snap-on may lie;
 * beyond it is an event of the baseline. */
static const double gap_tolerance = 0.5;
/* The root of a work of adhesion, in its standard errors; a pull counts like the work. */
static const double work_errors = 3.0;
static const double kink_left = 1e-3;  /* of a standard error: a step beyond ends at a kink */
static const double better_chi2 = 9.0; /* 2 ln(likelihood ratio) against no adhesion: the same */
/* Halfway, as a logarithm, from DMT (0.1) to JKR (5) is 0.7 (Johnson and Greenwood, J. Colloid
 * Interface Sci. 192 (1997) 326). */
static const double least_tabor = 1.0;
/* Of the retract: in it half of a pull-off is over, which is a jump but for the samples in it. */
static const double let_go = 0.02;
/* Rubber loses of what the lever gives back, too; twice what it took is no loss but a drift. */
static const double most_loss = 2.0;
/* A constant pull, in that which is seen at the end of the way out: over as many samples as a
 * pull-off may take the mean of a pull is two thirds of its largest. */
static const double most_pull = 1.5;
enum {
    MAX_ROUNDS = 3,
    MAX_MOVES = 8,
    LEVER_ROUNDS = 50,
    START_SAMPLES = 100 /* of the contact, to start a fit */
};

/* ---- snap-on --------------------------------------------------------------------------------- */

typedef struct snap {
    size_t start, deepest, end; /* the first sample below the baseline, and the first above again */
    double pull;
} snap;

/* A pull right before the force rises that stands out of everything before it. */
WIDE_REGISTERS static bool find_snap(const curve_fitting *f, snap *found)
{
    const curve_samples *s = &f->input.samples;
    const curve_solution *fit = &f->solution;
    double *restrict above = f->workspace->scratch;
    size_t deepest = 0;
    for (size_t i = 0; i < s->n; i++)
        above[i] = s->force[i] - curve_baseline(fit, s->position[i]);
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
    const double after_contact = s->position[start] - fit->p[CURVE_C];
    const double reach = s->position[s->n - 1] - fit->p[CURVE_C];
    *found = (snap){start, deepest, end, pull};
    return pull > snap_noise * noise && pull > snap_rest * elsewhere &&
           fabs(after_contact) < gap_tolerance * reach && end < s->n &&
           s->n - (end - start) >= CURVE_MIN_SAMPLES;
}

static void leave_out(curve_fitting *f, size_t start, size_t end)
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

/* ---- pull-off -------------------------------------------------------------------------------- */

static double median(double *x, size_t n)
{
    const curve_span all = curve_span_of(x, n);
    for (size_t i = 0; i < n; i++)
        x[i] -= all.low;
    return all.low + curve_select(x, n, n / 2, all.high - all.low);
}

static double within(double x, double from, double to)
{
    return x < from ? from : x > to ? to : x;
}

/* Without branches, which noise would take at random. */
static double middle_of(double a, double b, double c)
{
    const double low = a < b ? a : b, high = a < b ? b : a;
    const double least = c < high ? c : high;
    return least > low ? least : low;
}

/* The largest pull of n forces above the baseline, smoothed over `width` samples, the last `far` of
 * which are free of the sample, if it stands out of them, of which `noise` is the scatter, and ends
 * at once; else 0. */
WIDE_REGISTERS static double sudden_pull(const double *smooth, size_t n, size_t width, size_t far,
                                         double noise)
{
    const size_t back = far < n ? far : n;
    const double elsewhere = fmax(0.0, -curve_span_of(smooth + n - back, back).low),
                 pull = fmax(0.0, -curve_span_of(smooth, n).low);
    size_t deepest = 0;
    while (pull > 0.0 && -smooth[deepest] < pull)
        deepest++;
    bool sudden = false;
    const size_t last = deepest + width + (size_t)(let_go * (double)n);
    for (size_t i = deepest; i < last && i < n; i++)
        sudden |= -smooth[i] < 0.5 * pull;
    return sudden && pull > snap_noise * noise && pull > snap_rest * elsewhere ? pull : 0.0;
}

/* Of the last n of x, which has room for them behind them. */
static double scatter_of(const double *x, size_t n, double *room)
{
    for (size_t i = 0; i < n; i++)
        room[i] = fabs(x[i]);
    return median(room, n) / 0.6744897501960817;
}

/* By medians of three, and if there is none by means over ever more samples up to as many as a
 * pull-off may take: a weak one is not seen on a sample. */
static double find_pull_off(const double *above, size_t n, size_t far, double *smooth, double *room)
{
    for (size_t i = 1; i + 1 < n; i++)
        smooth[i - 1] = middle_of(above[i - 1], above[i], above[i + 1]);
    double pull = sudden_pull(smooth, n - 2, 3, far, scatter_of(above + n - far, far, room));
    for (double part = 0.25; part <= 1.0 && !(pull > 0.0); part *= 2.0) {
        const size_t width = (size_t)(part * let_go * (double)n);
        if (width < 4 || far < 4 * width)
            continue;
        const size_t means = n - width + 1, free = far - width + 1;
        double sum = curve_sum(above, width);
        for (size_t i = 0; i < means; i++) {
            smooth[i] = sum / (double)width;
            sum += i + width < n ? above[i + width] - above[i] : 0.0;
        }
        pull =
            sudden_pull(smooth, means, width, free, scatter_of(smooth + means - free, free, room));
    }
    return pull;
}

/* Work against the lever and the sample between two positions of the base: the loop is the loss. */
static double work_along(const double *position, const double *force, size_t n, double from,
                         double to)
{
    double sum = 0.0, last = n > 0 ? within(position[0], from, to) : 0.0;
    for (size_t i = 1; i < n; i++) {
        const double first = last;
        last = within(position[i], from, to);
        if (!(fabs(last - first) > 0.0))
            continue;
        const double before = force[i - 1] > 0.0 ? force[i - 1] : 0.0,
                     behind = force[i] > 0.0 ? force[i] : 0.0;
        const double step = position[i] - position[i - 1];
        const double middle = (0.5 * (first + last) - position[i - 1]) / step;
        sum += (before + middle * (behind - before)) * (last - first);
    }
    return fabs(sum);
}

/* What the lever holds of it at a position, by the fit: of a soft one it is nearly all, and noise
 * of one force would make loss. */
static double lever_work(const curve_fitting *f, double top)
{
    const double *p = f->solution.p, k = f->input.samples.spring_constant,
                 z = fmax(top - p[CURVE_C], 0.0);
    double depth = z, step = z;
    for (int i = 0; i < LEVER_ROUNDS && fabs(step) > 1e-9 * z; i++) {
        double g, slope;
        wt_contact_table_eval(f->table, &depth, 1, &g, &slope);
        step = (k * (z - depth) - p[CURVE_E] * g) / (k + p[CURVE_E] * slope);
        depth = fmax(depth + step, 0.0);
    }
    const double force = k * (z - depth);
    return 0.5 * force * force / k;
}

/* Positions of the retract and forces above the baseline; returns how many are numbers. */
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
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(position[i]) && isfinite(above[i])) {
            position[kept] = position[i];
            above[kept++] = above[i];
        }
    return kept;
}

/* Takes the wave of the way in out of n forces above the baseline, of which the last `far` are free
 * of the sample, if it is there, too. */
static void take_out_wave(const curve_fitting *f, const double *position, double *above, size_t n,
                          size_t far)
{
    const curve_wave *wave = &f->solution.wave;
    const double number = wave->p[WAVE_NUMBER];
    double *part = f->workspace->scratch;
    for (size_t i = 0; i < n; i++) {
        const double bent = i < n - far && !wave->by_height
                                ? fmax(above[i], 0.0) / f->input.samples.spring_constant
                                : 0.0;
        const double angle = number * (position[i] - bent);
        part[i] = wave->p[WAVE_COSINE] * cos(angle) + wave->p[WAVE_SINE] * sin(angle);
    }
    const double with = gsl_stats_variance(above + n - far, 1, far);
    for (size_t i = 0; i < n; i++)
        part[i] = above[i] - part[i];
    if (gsl_stats_variance(part + n - far, 1, far) < with)
        memcpy(above, part, n * sizeof *above);
}

void curve_read_retract(curve_fitting *f, const double *height, const double *force, size_t n)
{
    wt_indent_workspace *w = f->workspace;
    const curve_samples *s = &f->input.samples;
    const double c = f->solution.p[CURVE_C];
    double *above = w->retract_force, *position = w->retract_position, *scratch = w->scratch;
    const size_t kept = measure_retract(f, height, force, n);
    const size_t far = kept / 4;
    if (far < CURVE_BASELINE_SAMPLES)
        return;
    if (curve_has_wave(&f->solution.wave))
        take_out_wave(f, position, above, kept, far);
    /* The far end is its own baseline: drag and drift part it from that of the approach. */
    memcpy(scratch, above + kept - far, far * sizeof *scratch);
    const double level = median(scratch, far);
    for (size_t i = 0; i < kept; i++)
        above[i] -= level;
    f->pull_off = find_pull_off(above, kept, far, scratch, w->weight);
    /* A way out may begin below the top of the way in: what both have is compared. */
    const double top =
        fmin(curve_span_of(position, kept).high, curve_span_of(s->position, f->input.n_all).high);
    const double back = work_along(position, above, kept, c, top);
    for (size_t i = 0; i < f->input.n_all; i++)
        scratch[i] = s->force[i] - curve_baseline(&f->solution, s->position[i]);
    const double in = work_along(s->position, scratch, f->input.n_all, c, top);
    const double share = (in - back) / (in - lever_work(f, top));
    /* Else the sample took too little of the work to say. */
    if (share > 1.0 - most_loss && share < most_loss)
        f->loss = share;
}

/* ---- adhesive contact ------------------------------------------------------------------------ */

static size_t first_beyond(const curve_samples *s, double position)
{
    size_t i = 0;
    while (i < s->n && !(s->position[i] > position))
        i++;
    return i;
}

static void refine(curve_fitting *f, curve_solution *s)
{
    curve_refine(f->table, &f->input.samples, f->kind, s->p, f->workspace, s);
}

/* Means of some samples of a jump's baseline and contact each, for fits that only start others: a
 * start needs no more of them. False if they are few. */
static bool thin(const curve_fitting *f, size_t jump, curve_samples *to, size_t *to_jump)
{
    const curve_samples *s = &f->input.samples;
    const size_t length = (s->n - jump) / START_SAMPLES;
    if (length < 2 || jump / length < CURVE_BASELINE_SAMPLES || s->gap_to > s->gap_from ||
        curve_has_wave(&f->kind.wave))
        return false;
    /* Nothing needs the way out after curve_read_retract. */
    *to = (curve_samples){.position = f->workspace->retract_position,
                          .force = f->workspace->retract_force,
                          .spring_constant = s->spring_constant};
    *to_jump = jump / length;
    for (size_t i = jump % length; i + length <= s->n; i += length) {
        to->position[to->n] = curve_sum(s->position + i, length) / (double)length;
        to->force[to->n++] = curve_sum(s->force + i, length) / (double)length;
    }
    return true;
}

/* The cost has a kink wherever the sample that jumps is another one: to its lowest. */
static void move_jump(curve_fitting *f, curve_solution *s)
{
    const size_t n = f->input.samples.n;
    for (int way = -1; way <= 1; way += 2)
        for (int i = 0; i < MAX_MOVES; i++) {
            curve_solution moved = *s;
            const size_t jump = f->kind.jump;
            f->kind.jump = way < 0 ? jump - 1 : jump + 1;
            if (f->kind.jump >= CURVE_BASELINE_SAMPLES &&
                n - f->kind.jump >= CURVE_BASELINE_SAMPLES)
                refine(f, &moved);
            if (!(moved.cost < s->cost)) {
                f->kind.jump = jump;
                break;
            }
            *s = moved;
        }
}

/* With a free contact point, the jump where the tip touches if it follows. */
static void refine_jump(curve_fitting *f, curve_solution *s, bool follows)
{
    const curve_samples *samples = &f->input.samples;
    curve_solution best = {.cost = (double)INFINITY};
    size_t jump_of_best = f->kind.jump;
    for (int round = 0; round < MAX_ROUNDS; round++) {
        refine(f, s);
        if (!(s->cost < best.cost))
            break;
        best = *s;
        jump_of_best = f->kind.jump;
        const size_t jump = first_beyond(samples, s->p[CURVE_C]);
        if (!follows || jump == f->kind.jump || jump < CURVE_BASELINE_SAMPLES ||
            samples->n - jump < CURVE_BASELINE_SAMPLES)
            break;
        f->kind.jump = jump;
    }
    f->kind.jump = jump_of_best;
    *s = best;
    if (follows && !f->kind.rough)
        move_jump(f, s);
}

/* From a jump: first with the contact point there, then with a free one, for from the wrong side of
 * the jump the fit does not find the way. follows: the jump stays where the tip touches. */
static curve_solution refine_from(curve_fitting *f, curve_solution s, size_t jump, bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    curve_samples some;
    if (!fixed)
        s.p[CURVE_C] = all.position[jump];
    f->kind.jump = jump;
    if (thin(f, jump, &some, &f->kind.jump))
        f->input.samples = some;
    f->kind.contact_fixed = f->kind.rough = true;
    refine(f, &s);
    f->kind.contact_fixed = fixed;
    if (!fixed)
        refine_jump(f, &s, follows);
    f->input.samples = all;
    f->kind.rough = false;
    f->kind.jump = jump;
    if (follows && !fixed) {
        const size_t touched = first_beyond(&all, s.p[CURVE_C]);
        if (touched >= CURVE_BASELINE_SAMPLES && all.n - touched >= CURVE_BASELINE_SAMPLES)
            f->kind.jump = touched;
    }
    if (fixed)
        refine(f, &s);
    else
        refine_jump(f, &s, follows);
    f->kind.jump = s.first_contact;
    return s;
}

/* How much larger than the noise the residual is, and so the errors are: any parameter more lowers
 * the cost of a law that does not describe the curve. */
static double residual_over_noise(const curve_solution *s)
{
    return sqrt(fmax(1.0, s->lack.statistic));
}

static bool is_adhesive(const curve_fitting *f)
{
    const curve_solution *s = &f->solution;
    const double root = s->p[CURVE_W];
    const adhesion law = {f->table, s->p[CURVE_E], root * root};
    /* A snap-on that is seen can be left out, which is better than a law that does not fit. */
    const bool strict = f->snap_on > 0.0 && !curve_fits(f);
    const bool at_kink = s->step_left * s->p[CURVE_E] > kink_left * s->standard_error[CURVE_E];
    const double errors = f->kind.constant_pull && !strict ? 0.5 * work_errors : work_errors;
    return s->converged && !(strict && at_kink) &&
           root > errors * residual_over_noise(s) * s->standard_error[CURVE_W] &&
           (f->kind.constant_pull || !(adhesion_tabor(&law) < least_tabor));
}

/* jump: the first sample in contact, or 0: where the tip touches, which lies some of the depths of
 * a jump before the contact point without adhesion. The solution is that of the kind then. */
static bool fit_adhesion_from(curve_fitting *f, curve_solution start, double depth, size_t jump)
{
    static const double depths[] = {2.0, 1.0, 4.0};
    const curve_samples *samples = &f->input.samples;
    const bool follows = jump == 0;
    for (size_t i = 0; i < (follows ? sizeof depths / sizeof depths[0] : 1); i++) {
        if (follows)
            jump = first_beyond(samples, start.p[CURVE_C] - depths[i] * depth);
        if (jump < CURVE_BASELINE_SAMPLES || samples->n - jump < CURVE_BASELINE_SAMPLES)
            continue;
        f->solution = refine_from(f, start, jump, follows);
        /* Another minimum has the tip touch far from where the force rises. */
        const bool near = !follows || f->solution.cost < start.cost;
        if (near && is_adhesive(f))
            return true;
        if (near && f->solution.converged) /* to next to no adhesion */
            break;
    }
    return false;
}

static bool fit_jkr(curve_fitting *f, double pull, size_t jump)
{
    const double k = f->input.samples.spring_constant;
    curve_solution start = f->solution;
    const adhesion law = {f->table, start.p[CURVE_E],
                          adhesion_work(f->table, start.p[CURVE_E], k, pull)};
    if (isnan(law.work) || !adhesion_applies(contact_table_tip(f->table)))
        return false;
    const double touch = 0.0;
    double bare;
    adhesion_balance(&law, k, adhesion_release(&law, k), &touch, 1, &bare);
    const double depth = adhesion_at(&law, bare).depth;
    start.p[CURVE_W] = sqrt(law.work);
    f->kind.adhesive = true;
    return fit_adhesion_from(f, start, depth, jump);
}

static bool fit_constant_pull(curve_fitting *f, double pull, size_t jump)
{
    curve_solution start = f->solution;
    start.p[CURVE_W] = pull;
    f->kind.adhesive = f->kind.constant_pull = true;
    return fit_adhesion_from(f, start, pull / f->input.samples.spring_constant, jump);
}

/* A fit, and the kind that it is of. */
typedef struct outcome {
    curve_solution solution;
    curve_kind kind;
    bool found, likely;
} outcome;
enum { CONSTANT_PULL, JKR, JKR_FROM_PULL, LAWS };

/* Is the pull of this fit one that the way out shows? Rubber lets go with no less than it is
 * touched with. */
static bool pull_is_likely(const curve_fitting *f, const curve_solution *elastic)
{
    const double root = f->solution.p[CURVE_W], most = most_pull * f->pull_off;
    if (!(f->pull_off > 0.0))
        return true;
    if (f->kind.constant_pull)
        return root <= most;
    return !(root * root >
             adhesion_work(f->table, elastic->p[CURVE_E], f->input.samples.spring_constant, most));
}

static bool better_law(const outcome *a, const outcome *b, bool lossy)
{
    if (!a->found || !b->found || a->likely != b->likely)
        return a->found && (!b->found || a->likely);
    if (lossy && a->kind.constant_pull != b->kind.constant_pull)
        return b->kind.constant_pull;
    return a->solution.cost < b->solution.cost;
}

/* What another fit, better by chi2, would make of the modulus, as far as it is likely. */
static double by_other(const curve_fitting *f, const curve_solution *other, double chi2)
{
    const double share = 1.0 / (1.0 + exp(-0.5 * chi2));
    return sqrt(share) * fabs(other->p[CURVE_E] / f->solution.p[CURVE_E] - 1.0);
}

/* By how much `other` is likelier than the solution, as 2 ln of the ratio. */
static double gain_of(const curve_fitting *f, const curve_solution *other)
{
    return f->solution.effective_n * log(f->solution.cost / other->cost) /
           fmax(1.0, f->solution.lack.statistic);
}

/* The better one of the laws of adhesion; what the others would give is in the error, as far as it
 * is likely. False if there is none: then all is as it was. */
static bool fit_adhesion_laws(curve_fitting *f, double pull, size_t jump)
{
    const outcome before = {f->solution, f->kind, true, true};
    outcome law[LAWS] = {{.found = false}};
    const outcome *best = &law[0];
    /* Work that is lost looks like a constant pull, neither law describes it, and costs do not
     * tell: rubber has short forces. */
    const bool lossy = jump == 0 && f->loss > CURVE_LEAST_LOSS;
    for (int i = 0; i < LAWS; i++) {
        f->solution = before.solution;
        f->kind = before.kind;
        law[i].found =
            i == CONSTANT_PULL ? fit_constant_pull(f, pull, jump) : fit_jkr(f, pull, jump);
        law[i] = (outcome){f->solution, f->kind, law[i].found,
                           jump > 0 || pull_is_likely(f, &before.solution)};
        if (better_law(&law[i], best, lossy))
            best = &law[i];
        /* From where samples let go costs have kinks: once more from the pull that was found. */
        if (i == JKR)
            pull = law[CONSTANT_PULL].solution.p[CURVE_W];
        if (i == JKR && !(jump == 0 && pull > 0.0))
            break;
    }
    const outcome *to = best->found ? best : &before;
    f->solution = to->solution;
    f->kind = to->kind;
    f->kind.wave = to->solution.wave;
    /* Forces without a wave, depths and residuals shall be of that solution, too. */
    refine(f, &f->solution);
    f->solution = to->solution;
    f->kind = to->kind;
    f->other_law = 0.0;
    for (int i = 0; i < LAWS && best->found; i++)
        if (law[i].found && &law[i] != best) {
            const curve_solution *other = &law[i].solution;
            const double gain = fmin(0.0, gain_of(f, other));
            f->other_law = fmax(f->other_law, by_other(f, other, gain));
        }
    return best->found;
}

bool curve_fit_adhesion(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    const curve_kind plainly = f->kind;
    const bool try_it =
        !f->options->plain_least_squares && !(contact_table_tip(f->table)->sample_thickness > 0.0);
    snap found;
    if (find_snap(f, &found)) {
        f->snap_on = found.pull;
        if (try_it) { /* from the deepest on: before, the lever jumps, or is attracted */
            leave_out(f, found.start, found.deepest + 1);
            if (fit_adhesion_laws(f, found.pull, found.start))
                return true;
            found.end -= found.deepest + 1 - found.start;
            found.deepest = found.start;
        }
        f->kind = plainly;
        leave_out(f, found.start, found.end);
        curve_begin_wave(f, &plainly.wave);
        return curve_scan_and_refine(f);
    }
    /* Rubber lets go with far more than it is touched with, of which no snap-on was seen. */
    if (!(f->pull_off > 0.0) || !try_it)
        return true;
    if (!fit_adhesion_laws(f, fmin(f->pull_off, snap_noise * f->input.step_noise), 0))
        return true;
    const double gain = -gain_of(f, &elastic);
    if (gain > better_chi2)
        return true;
    const curve_solution law = f->solution;
    f->kind = plainly;
    f->solution = elastic;
    f->kind.wave = elastic.wave;
    refine(f, &f->solution);
    f->kind = plainly;
    f->solution = elastic;
    f->other_law = by_other(f, &law, gain);
    return true;
}
