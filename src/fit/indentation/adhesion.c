/* Adhesion of one force curve: a snap-on of the approach, the pull-off of the retract, and the fit
 * of adhesive contact where there is one of them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/indentation/curve_fitting.h"
#include "fit/indentation/curve_model.h"

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
static const double work_errors = 3.0; /* a work of adhesion, in its standard errors: 0.3 % */
static const double better_chi2 = 9.0; /* 2 ln(likelihood ratio) against no adhesion: the same */
/* Halfway, as a logarithm, from DMT (0.1) to JKR (5) is 0.7 (Johnson and Greenwood, J. Colloid
 * Interface Sci. 192 (1997) 326). */
static const double least_tabor = 1.0;
/* Of the retract: in it half of a pull-off is over, which is a jump but for the samples in it. */
static const double let_go = 0.02;
/* Rubber loses of what the lever gives back, too; twice what it took is no loss but a drift. */
static const double most_loss = 2.0;
enum {
    MAX_ROUNDS = 3,
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

/* The largest pull of n forces above the baseline, the last of which are far from the sample, if it
 * stands out of them and ends at once; else 0. */
WIDE_REGISTERS static double sudden_pull(const double *above, size_t n, size_t far, double noise,
                                         double *restrict middle)
{
    for (size_t i = 1; i + 1 < n; i++)
        middle[i] = middle_of(above[i - 1], above[i], above[i + 1]);
    const double elsewhere = fmax(0.0, -curve_span_of(middle + n - far, far - 1).low),
                 pull = fmax(0.0, -curve_span_of(middle + 1, n - far - 1).low);
    size_t deepest = pull > 0.0 ? 1 : 0;
    while (pull > 0.0 && -middle[deepest] < pull)
        deepest++;
    bool sudden = false;
    const size_t last = deepest + (size_t)(let_go * (double)n) + 3;
    for (size_t i = deepest; i < last && i < n; i++)
        sudden |= -above[i] < 0.5 * pull;
    return sudden && pull > snap_noise * noise && pull > snap_rest * elsewhere ? pull : 0.0;
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
    for (size_t i = 0; i < far; i++)
        scratch[i] = fabs(above[kept - far + i]);
    const double noise = median(scratch, far) / 0.6744897501960817;
    f->pull_off = sudden_pull(above, kept, far, noise, scratch);
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

/* Forces without a wave, depths and residuals of the workspace are those of the solution then. */
static void evaluate(const curve_fitting *f)
{
    curve_law m = curve_law_of(f->table, &f->input.samples, &f->kind, f->workspace);
    curve_law_evaluate(&m, f->solution.p, &f->solution.wave);
}

/* Of the samples as they are now. */
static double cost_without_adhesion(const curve_fitting *f, const double p[CURVE_N_PARAMETERS])
{
    const curve_kind plainly = {.tilt = f->kind.tilt};
    curve_law m = curve_law_of(f->table, &f->input.samples, &plainly, f->workspace);
    curve_model_start(&m, p);
    return curve_model_cost(&m, p);
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

/* With a free contact point, the jump where the tip touches if it follows. Returns the cost there,
 * which may be another jump than that of the solution. */
static double refine_jump(curve_fitting *f, curve_solution *s, bool follows)
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
    const double there = s->cost;
    f->kind.jump = jump_of_best;
    *s = best;
    return there;
}

/* From a jump to where a fit of all samples can begin: first with the contact point there, then
 * with a free one, for from the wrong side of the jump the fit does not find the way. False if that
 * leads nowhere: where the tip would touch, the samples that start a fit are farther from it than
 * without adhesion, by more than the pull of one that is on the wrong side of the jump. */
static bool start_from(curve_fitting *f, curve_solution *s, double pull, size_t jump, bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    const curve_solution elastic = *s;
    curve_samples some;
    double there = 0.0, most = (double)INFINITY;
    if (!fixed)
        s->p[CURVE_C] = all.position[jump];
    f->kind.jump = jump;
    if (thin(f, jump, &some, &f->kind.jump)) {
        f->input.samples = some;
        most = cost_without_adhesion(f, elastic.p) + pull * pull;
    }
    f->kind.contact_fixed = f->kind.rough = true;
    refine(f, s);
    f->kind.contact_fixed = fixed;
    if (!fixed)
        there = refine_jump(f, s, follows);
    f->input.samples = all;
    f->kind.rough = false;
    s->converged = s->converged && !(there > most);
    return s->converged;
}

/* follows: the jump stays where the tip touches. */
static curve_solution refine_from(curve_fitting *f, curve_solution s, double pull, size_t jump,
                                  bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    if (!start_from(f, &s, pull, jump, follows))
        return s;
    f->kind.jump = jump;
    if (follows && !fixed) {
        const size_t touched = first_beyond(&all, s.p[CURVE_C]);
        if (touched >= CURVE_BASELINE_SAMPLES && all.n - touched >= CURVE_BASELINE_SAMPLES)
            f->kind.jump = touched;
    }
    if (!fixed) {
        f->kind.no_errors = true;
        (void)refine_jump(f, &s, follows);
        f->kind.no_errors = false;
    }
    if (fixed || s.converged)
        refine(f, &s);
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
    return s->converged &&
           root > work_errors * residual_over_noise(s) * s->standard_error[CURVE_W] &&
           (f->kind.constant_pull || !(adhesion_tabor(&law) < least_tabor));
}

/* jump: the first sample in contact, or 0: where the tip touches, which lies some of the depths of
 * a jump before the contact point without adhesion. The solution is that of the kind then. */
static bool fit_adhesion_from(curve_fitting *f, curve_solution start, double pull, double depth,
                              size_t jump)
{
    static const double depths[] = {2.0, 1.0, 4.0};
    const curve_samples *samples = &f->input.samples;
    const bool follows = jump == 0;
    for (size_t i = 0; i < (follows ? sizeof depths / sizeof depths[0] : 1); i++) {
        if (follows)
            jump = first_beyond(samples, start.p[CURVE_C] - depths[i] * depth);
        if (jump < CURVE_BASELINE_SAMPLES || samples->n - jump < CURVE_BASELINE_SAMPLES)
            continue;
        f->solution = refine_from(f, start, pull, jump, follows);
        if (is_adhesive(f))
            return true;
        if (f->solution.converged) /* to next to no adhesion */
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
    return fit_adhesion_from(f, start, pull, depth, jump);
}

static bool fit_constant_pull(curve_fitting *f, double pull, size_t jump)
{
    curve_solution start = f->solution;
    start.p[CURVE_W] = pull;
    f->kind.adhesive = f->kind.constant_pull = true;
    return fit_adhesion_from(f, start, pull, pull / f->input.samples.spring_constant, jump);
}

/* A fit, and the kind that it is of. */
typedef struct outcome {
    curve_solution solution;
    curve_kind kind;
    bool found;
} outcome;

/* The better one of two laws of adhesion; what the other would give is in the error, as far as it
 * is likely. False if there is none: then all is as it was. */
static bool fit_adhesion_laws(curve_fitting *f, double pull, size_t jump)
{
    const outcome before = {f->solution, f->kind, true};
    outcome law[2] = {{.found = false}, {.found = false}};
    for (int i = 0; i < 2; i++) {
        f->solution = before.solution;
        f->kind = before.kind;
        const bool found = i == 0 ? fit_constant_pull(f, pull, jump) : fit_jkr(f, pull, jump);
        law[i] = (outcome){f->solution, f->kind, found};
    }
    const int best = law[1].found && (!law[0].found || law[1].solution.cost < law[0].solution.cost);
    const outcome *to = law[best].found ? &law[best] : &before;
    f->solution = to->solution;
    f->kind = to->kind;
    f->kind.wave = to->solution.wave;
    if (law[0].found && law[1].found) {
        const curve_solution *other = &law[1 - best].solution;
        const double chi2 = f->solution.effective_n * log(other->cost / f->solution.cost) /
                            fmax(1.0, f->solution.lack.statistic);
        const double share = 1.0 / (1.0 + exp(0.5 * fmax(chi2, 0.0)));
        f->other_law = sqrt(share) * fabs(other->p[CURVE_E] / f->solution.p[CURVE_E] - 1.0);
    }
    return law[best].found;
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
            if (fit_adhesion_laws(f, found.pull, found.start)) {
                evaluate(f);
                return true;
            }
            found.end -= found.deepest + 1 - found.start;
            found.deepest = found.start;
        }
        f->kind = plainly;
        leave_out(f, found.start, found.end);
        curve_begin_wave(f, &plainly.wave);
        return curve_scan_and_refine(f);
    }
    /* Where the law without adhesion describes the curve it has none to speak of. */
    if (!(f->pull_off > 0.0) || !try_it || curve_fits(f))
        return true;
    if (fit_adhesion_laws(f, f->pull_off, 0) &&
        f->solution.effective_n * log(elastic.cost / f->solution.cost) >
            better_chi2 * fmax(1.0, f->solution.lack.statistic)) {
        evaluate(f);
        return true;
    }
    f->kind = plainly;
    f->solution = elastic;
    f->kind.wave = elastic.wave;
    evaluate(f);
    f->other_law = 0.0;
    return true;
}
