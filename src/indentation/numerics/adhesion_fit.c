/* Adhesion of one force curve: the fit of adhesive contact where the approach snaps on (snap_on.c),
 * or the way out shows a pull-off (retract.c).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/curve_model.h"

#include "core/math/normal_quantile.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <string.h>

/* The root of a work of adhesion, in its standard errors; a pull counts like the work. */
static const double work_errors = 3.0;
static const double kink_left = 1e-3;  /* of a standard error: a step beyond ends at a kink */
static const double better_chi2 = 9.0; /* 2 ln(likelihood ratio) against no adhesion: the same */
/* Halfway, as a logarithm, from DMT (0.1) to JKR (5) is 0.7 (Johnson and Greenwood, J. Colloid
 * Interface Sci. 192 (1997) 326). */
static const double least_tabor = 1.0;
/* A constant pull, in that which is seen at the end of the way out: over as many samples as a
 * pull-off may take the mean of a pull is two thirds of its largest. */
static const double most_pull = 1.5;
/* Of that, in a score: a law that has not the work and the contact point of its best fit still
 * shows most of it. */
static const double near_gain = 0.5;
/* Of the largest pull that was not seen, works of adhesion to look for: a score that is linear in
 * the work still tells one from four times as much. */
static const double some_pulls[] = {1.0, 0.25};
/* Depths of a jump before the contact point without adhesion, where a tip may touch: its offset and
 * tilt hide one of them, and the fits find a minimum from within a factor of two. */
static const double some_jumps[] = {2.0, 1.0, 4.0};
enum {
    MAX_ROUNDS = 3,     /* with the jump where the tip touches: each leaves less than a tenth */
    MAX_MOVES = 8,      /* of the jump each way: noise hides it in fewer samples */
    START_SAMPLES = 100 /* of the contact, to start a fit: it knows the modulus to a few per cent */
};

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
    *to = (curve_samples){.position = f->workspace->start_position,
                          .force = f->workspace->start_force,
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
            f->kind.below = s->cost;
            if (f->kind.jump >= CURVE_BASELINE_SAMPLES &&
                n - f->kind.jump >= CURVE_BASELINE_SAMPLES)
                refine(f, &moved);
            f->kind.below = 0.0;
            if (!(moved.cost < s->cost)) {
                f->kind.jump = jump;
                break;
            }
            *s = moved;
        }
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
    if (follows && !f->kind.rough)
        move_jump(f, s);
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
    return !(there > most);
}

/* follows: the jump stays where the tip touches. */
static curve_solution refine_from(curve_fitting *f, curve_solution s, double pull, size_t jump,
                                  bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    if (!start_from(f, &s, pull, jump, follows)) {
        s.converged = false;
        return s;
    }
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
static bool fit_adhesion_from(curve_fitting *f, curve_solution start, double pull, double depth,
                              size_t jump)
{
    const curve_samples *samples = &f->input.samples;
    const bool follows = jump == 0;
    for (size_t i = 0; i < (follows ? sizeof some_jumps / sizeof some_jumps[0] : 1); i++) {
        if (follows)
            jump = first_beyond(samples, start.p[CURVE_C] - some_jumps[i] * depth);
        if (jump < CURVE_BASELINE_SAMPLES || samples->n - jump < CURVE_BASELINE_SAMPLES)
            continue;
        f->solution = refine_from(f, start, pull, jump, follows);
        /* Another minimum has the tip touch far from where the force rises. */
        const bool near = !follows || f->solution.cost < start.cost;
        if (near && is_adhesive(f))
            return true;
        if (near && f->solution.converged) /* to next to no adhesion */
            break;
    }
    return false;
}

/* JKR with this pull; false where that law does not hold. */
static bool law_of_pull(const curve_fitting *f, double pull, adhesion *law)
{
    const double reduced = f->solution.p[CURVE_E], k = f->input.samples.spring_constant;
    *law = (adhesion){f->table, reduced, adhesion_work(f->table, reduced, k, pull)};
    return !isnan(law->work) && adhesion_applies(contact_table_tip(f->table));
}

/* Where the tip touches. */
static double jump_depth(const curve_fitting *f, const adhesion *law)
{
    const double k = f->input.samples.spring_constant, touch = 0.0;
    double bare;
    adhesion_balance(law, k, adhesion_release(law, k), &touch, 1, &bare);
    return adhesion_at(law, bare).depth;
}

static bool fit_jkr(curve_fitting *f, double pull, size_t jump)
{
    curve_solution start = f->solution;
    adhesion law;
    if (!law_of_pull(f, pull, &law))
        return false;
    start.p[CURVE_W] = sqrt(law.work);
    f->kind.adhesive = true;
    return fit_adhesion_from(f, start, pull, jump_depth(f, &law), jump);
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
    bool found, likely;
    double evidence; /* twice the logarithm of its likelihood, way in and out */
} outcome;
enum { CONSTANT_PULL, JKR, JKR_FROM_PULL, LAWS };

/* Is the pull of this fit, within its errors, one that the way out shows? Rubber lets go with no
 * less than it is touched with. */
static bool pull_is_likely(const curve_fitting *f)
{
    const double root = fmax(0.0, f->solution.p[CURVE_W] -
                                      NORMAL_95 * f->solution.standard_error[CURVE_W]),
                 most = most_pull * f->pull_off;
    if (!(f->pull_off > 0.0))
        return true;
    if (f->kind.constant_pull)
        return root <= most;
    return !(root * root > adhesion_work(f->table, f->solution.p[CURVE_E],
                                         f->input.samples.spring_constant, most));
}

/* By how much `other` is likelier than a solution, as 2 ln of the ratio. */
static double evidence_of(const curve_solution *than, const curve_solution *other)
{
    return than->effective_n * log(than->cost / other->cost) / fmax(1.0, than->lack.statistic);
}

static double gain_of(const curve_fitting *f, const curve_solution *other)
{
    return evidence_of(&f->solution, other);
}

/* Does the tip let go, but for the errors of the fit, where it has touched on its way in or later?
 * There it was in contact, and rubber holds on the way out no shorter. */
static bool lets_go_late(const curve_fitting *f, const curve_solution *out)
{
    const double *position = f->way_out.samples.position;
    const size_t jump = f->way_out.jump;
    const double between = position[jump + 1] - position[jump];
    return !(position[jump] > out->p[CURVE_C] + NORMAL_95 * out->standard_error[CURVE_C] + between);
}

/* Of the laws that were found. Where no work is lost the way out is another contact by the same
 * law: neck and pull-off part laws that the way in does not. */
static void weigh(curve_fitting *f, outcome law[LAWS])
{
    const curve_solution *best = NULL;
    curve_solution out[LAWS];
    bool fitted = f->loss < CURVE_LEAST_LOSS && law[CONSTANT_PULL].found;
    for (int i = 0; i < LAWS; i++) {
        if (!law[i].found)
            continue;
        if (best == NULL || law[i].solution.cost < best->cost)
            best = &law[i].solution;
        fitted = fitted && curve_fit_way_out(f, &law[i].kind, &law[i].solution, &out[i]);
    }
    const curve_solution *least = NULL;
    for (int i = 0; i < LAWS && fitted; i++)
        if (law[i].found && (least == NULL || out[i].cost < least->cost))
            least = &out[i];
    for (int i = 0; i < LAWS; i++) {
        if (!law[i].found)
            continue;
        law[i].evidence = evidence_of(best, &law[i].solution);
        if (fitted) {
            law[i].evidence += evidence_of(least, &out[i]);
            law[i].likely = law[i].likely && (!out[i].converged || lets_go_late(f, &out[i]));
        }
    }
}

static bool better_law(const outcome *a, const outcome *b, bool lossy)
{
    if (!a->found || !b->found || a->likely != b->likely)
        return a->found && (!b->found || a->likely);
    if (lossy && a->kind.constant_pull != b->kind.constant_pull)
        return b->kind.constant_pull;
    return a->evidence > b->evidence;
}

/* Another law that is likelier by chi2. */
static curve_other by_likelihood(double chi2, double moved)
{
    return (curve_other){moved, 1.0 / (1.0 + exp(-0.5 * chi2))};
}

static curve_other by_other(const curve_fitting *f, const curve_solution *other, double chi2)
{
    return by_likelihood(chi2, other->p[CURVE_E] / f->solution.p[CURVE_E] - 1.0);
}

static double weight_of(const curve_other *o)
{
    return o->chance * o->moved * o->moved;
}

/* The better one of the laws of adhesion; what the others would give is in the error, as far as it
 * is likely. False if there is none: then all is as it was. pull_alone: no other law than that of a
 * constant pull can be the one to take, unless that is. */
static bool fit_adhesion_laws(curve_fitting *f, double pull, size_t jump, bool pull_alone)
{
    const outcome before = {f->solution, f->kind, true, true, 0.0};
    outcome law[LAWS] = {{.found = false}};
    const outcome *best = &law[0];
    /* Work that is lost looks like a constant pull, neither law describes it, and costs do not
     * tell: rubber has short forces. */
    const bool lossy = jump == 0 && f->loss > CURVE_LEAST_LOSS;
    for (int i = 0; i < LAWS; i++) {
        f->solution = before.solution;
        f->kind = before.kind;
        const bool found =
            i == CONSTANT_PULL ? fit_constant_pull(f, pull, jump) : fit_jkr(f, pull, jump);
        law[i] = (outcome){f->solution, f->kind, found, pull_is_likely(f), 0.0};
        if (i == CONSTANT_PULL && pull_alone &&
            !(law[i].found && -gain_of(f, &before.solution) > better_chi2))
            break;
        /* From where samples let go costs have kinks: once more from the pull that was found. */
        if (i == JKR)
            pull = law[CONSTANT_PULL].solution.p[CURVE_W];
        if (i == JKR && !(jump == 0 && pull > 0.0))
            break;
    }
    weigh(f, law);
    for (int i = 1; i < LAWS; i++)
        if (better_law(&law[i], best, lossy))
            best = &law[i];
    const outcome *to = best->found ? best : &before;
    f->solution = to->solution;
    f->kind = to->kind;
    f->kind.wave = to->solution.wave;
    f->other_law = (curve_other){0.0, 0.0};
    for (int i = 0; i < LAWS && best->found; i++)
        if (law[i].found && &law[i] != best && (law[i].likely || !best->likely)) {
            const curve_solution *other = &law[i].solution;
            const double gain = fmin(0.0, law[i].evidence - best->evidence);
            const curve_other moved = by_other(f, other, gain);
            if (weight_of(&moved) > weight_of(&f->other_law))
                f->other_law = moved;
        }
    return best->found;
}

/* ---- score: does adhesion matter? ------------------------------------------------------------ */

/* Residuals of a law at p. */
static void residuals_of(const curve_fitting *f, const curve_kind *kind,
                         const double p[CURVE_N_PARAMETERS], double *to)
{
    curve_law m = curve_law_of(f->table, &f->input.samples, kind, f->workspace);
    curve_law_evaluate(&m, p, &kind->wave);
    memcpy(to, f->workspace->residual, f->input.samples.n * sizeof *to);
}

/* From the forces without adhesion, whose residuals are given, to those of a law with this pull.
 * False where that does not hold. */
static bool difference_of(const curve_fitting *f, bool constant_pull, double pull,
                          const double *without, double *to)
{
    curve_kind kind = {.tilt = f->kind.tilt, .adhesive = true, .constant_pull = constant_pull};
    double p[CURVE_N_PARAMETERS];
    adhesion law;
    memcpy(p, f->solution.p, sizeof p);
    p[CURVE_W] = pull;
    if (!constant_pull) {
        if (!law_of_pull(f, pull, &law))
            return false;
        p[CURVE_W] = sqrt(law.work);
        if (!f->kind.contact_fixed)
            p[CURVE_C] -= some_jumps[0] * jump_depth(f, &law);
        p[CURVE_F0] = curve_baseline(&f->solution, p[CURVE_C]); /* the same line */
    }
    residuals_of(f, &kind, p, to);
    const size_t touched = first_beyond(&f->input.samples, p[CURVE_C]);
    for (size_t i = 0; i < f->input.samples.n; i++)
        to[i] = i < touched ? 0.0 : without[i] - to[i];
    return true;
}

/* At a solution that describes the curve: can a law of adhesion be so much better that it is the
 * one to take? If not, what a pull that is likely would make of the modulus is in the error. Leaves
 * the workspace as that of the solution. pull_alone: a constant pull can, no other law. */
static bool adhesion_matters(curve_fitting *f, double most, bool *pull_alone)
{
    const curve_kind plainly = {.tilt = f->kind.tilt};
    wt_indent_workspace *w = f->workspace;
    /* Nothing needs the scan's arrays after the scan. */
    double *const difference[] = {w->start_position, w->start_force, w->tip};
    enum { SCORES = sizeof difference / sizeof difference[0] };
    curve_step step[SCORES];
    residuals_of(f, &plainly, f->solution.p, w->weight);
    /* A constant pull changes forces by as much: any that is small. */
    (void)difference_of(f, true, f->input.step_noise, w->weight, difference[0]);
    size_t n = 1;
    for (size_t i = 0; i < sizeof some_pulls / sizeof some_pulls[0]; i++)
        if (difference_of(f, false, some_pulls[i] * most, w->weight, difference[n]))
            n++;
    curve_score(f->table, &f->input.samples, &f->kind, &f->solution, difference, n, w, step);
    bool matters = false;
    for (size_t i = n; i-- > 0;)
        if (step[i].share > 0.0 && step[i].gain > near_gain * better_chi2) {
            *pull_alone = !matters && i == 0;
            matters = true;
        }
    if (matters)
        return true;
    if (step[0].share > 0.0 && step[0].gain > 0.25 * work_errors * work_errors)
        f->other_law = by_likelihood(step[0].gain, step[0].modulus);
    return false;
}

/* ---------------------------------------------------------------------------------------------- */

bool curve_fit_adhesion(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    const curve_kind plainly = f->kind;
    const bool try_it =
        !f->options->plain_least_squares && !(contact_table_tip(f->table)->sample_thickness > 0.0);
    curve_snap found = f->snap;
    if (f->snap_on > 0.0) {
        if (try_it) { /* from the deepest on: before, the lever jumps, or is attracted */
            curve_leave_out(f, found.start, found.deepest + 1);
            if (fit_adhesion_laws(f, found.pull, found.start, false)) {
                evaluate(f);
                return true;
            }
            found.end -= found.deepest + 1 - found.start;
            found.deepest = found.start;
        }
        f->kind = plainly;
        curve_leave_out(f, found.start, found.end);
        curve_begin_wave(f, &plainly.wave);
        return curve_scan_and_refine(f);
    }
    /* Rubber lets go with far more than it is touched with, of which no snap-on was seen. */
    if (!(f->pull_off > 0.0) || !try_it)
        return true;
    const double most = fmin(f->pull_off, CURVE_PULL_NOISE * f->input.step_noise);
    const bool quick = curve_fits(f) && !curve_has_wave(&elastic.wave);
    bool pull_alone = false;
    if (quick && !adhesion_matters(f, most, &pull_alone))
        return true;
    if (!fit_adhesion_laws(f, most, 0, pull_alone)) {
        evaluate(f);
        return true;
    }
    const double gain = -gain_of(f, &elastic);
    if (gain > better_chi2) {
        evaluate(f);
        return true;
    }
    const curve_solution law = f->solution;
    f->kind = plainly;
    f->solution = elastic;
    f->kind.wave = elastic.wave;
    evaluate(f);
    f->other_law = by_other(f, &law, gain);
    return true;
}
