/* Fit of adhesive contact to one force curve. The fit is tried if the approach has a snap-in
 * or the retract a pull-off (retract.c).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/curve_model.h"

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <string.h>

/* Smallest significant root of a work of adhesion, in its standard errors. The same limit applies
 * to a constant pull. */
static const double work_errors = 3.0;
static const double kink_step =
    1e-3; /* in standard errors; a larger remaining step ends at a kink */
static const double better_chi2 =
    9.0; /* smallest 2 ln(likelihood ratio) against no adhesion, equivalent to 3 standard errors */
static const double hopeless_chi2 =
    20.0; /* 2 ln(likelihood ratio) of means of the samples against the law that is found */
/* Smallest Tabor parameter of the JKR law. The logarithmic mean of DMT (0.1) and JKR (5) is 0.7
 * (Johnson and Greenwood, J. Colloid Interface Sci. 192 (1997) 326). */
static const double min_tabor = 1.0;
/* Largest constant pull over the pull measured at the end of the retract. The mean over the samples
 * of a pull-off is two thirds of its largest value. */
static const double max_pull_ratio = 1.5;
/* Share of the improvement that a score must predict. A law without its best work and contact point
 * still shows most of it. */
static const double score_share = 0.5;
/* Trial works of adhesion as shares of the largest pull that is not detected. A score is linear in
 * the work and also detects a work four times as large. */
static const double trial_pulls[] = {1.0, 0.25};
/* Trial positions of first contact before the contact point without adhesion, in depths of a jump.
 * Offset and tilt hide about one depth. The fits converge from within a factor of two. */
static const double trial_jumps[] = {2.0, 1.0, 4.0};
enum {
    MAX_ROUNDS = 3, /* with the jump at the contact point; each round reduces the error to less than
                       a tenth */
    MAX_MOVES = 8,  /* of the jump in each direction; noise affects fewer samples */
    START_SAMPLES = 100 /* samples in contact for a starting fit; they determine the modulus to a
                           few per cent */
};

/* ---- adhesive contact ------------------------------------------------------------------------ */

static size_t find_position(const curve_samples *s, double position)
{
    size_t i = 0;
    while (i < s->n && !(s->position[i] > position))
        i++;
    return i;
}

static void refine_adhesion_fit(curve_fitting *f, curve_solution *s)
{
    curve_refine(f->table, &f->input.samples, f->kind, s->p, f->workspace, s);
}

/* Evaluates the law at the solution. The forces without the wave, the depths and the residuals of
 * the workspace are then those of the solution. */
static void evaluate_solution(const curve_fitting *f)
{
    curve_law m = curve_law_create(f->table, &f->input.samples, &f->kind, f->workspace);
    curve_law_evaluate(&m, f->solution.p, &f->solution.wave);
}

/* Cost of the current samples without adhesion. */
static double cost_without_adhesion(const curve_fitting *f, const double p[CURVE_N_PARAMETERS])
{
    const curve_kind plainly = {.tilt = f->kind.tilt};
    curve_law m = curve_law_create(f->table, &f->input.samples, &plainly, f->workspace);
    curve_model_start(&m, p);
    return curve_model_cost(&m, p);
}

/* Averages the samples before and after a jump for a starting fit, which needs few samples. Returns
 * false if there are too few. */
static bool average_start_samples(const curve_fitting *f, size_t jump, curve_samples *to,
                                  size_t *to_jump)
{
    const curve_samples *s = &f->input.samples;
    const size_t length = (s->n - jump) / START_SAMPLES;
    if (length < 2 || jump / length < CURVE_BASELINE_SAMPLES || s->gap_to > s->gap_from ||
        curve_has_wave(&f->kind.wave))
        return false;
    *to = curve_average_samples(s, jump, length, f->workspace);
    *to_jump = jump / length;
    return true;
}

/* Moves the jump to the sample with the lowest cost. The cost has a kink where the jump moves to
 * another sample. */
static void shift_jump(curve_fitting *f, curve_solution *s)
{
    const size_t n = f->input.samples.n;
    for (int direction = -1; direction <= 1; direction += 2)
        for (int i = 0; i < MAX_MOVES; i++) {
            curve_solution moved = *s;
            const size_t jump = f->kind.jump;
            f->kind.jump = direction < 0 ? jump - 1 : jump + 1;
            f->kind.cost_limit = s->cost;
            if (f->kind.jump >= CURVE_BASELINE_SAMPLES &&
                n - f->kind.jump >= CURVE_BASELINE_SAMPLES)
                refine_adhesion_fit(f, &moved);
            f->kind.cost_limit = 0.0;
            if (!(moved.cost < s->cost)) {
                f->kind.jump = jump;
                break;
            }
            *s = moved;
        }
}

/* Refines a fit with a free contact point. If `follows`, the jump moves with the contact point.
 * Returns the last cost, which may belong to another jump than the solution. */
static double refine_jump(curve_fitting *f, curve_solution *s, bool follows)
{
    const curve_samples *samples = &f->input.samples;
    curve_solution best = {.cost = (double)INFINITY};
    size_t jump_of_best = f->kind.jump;
    for (int round = 0; round < MAX_ROUNDS; round++) {
        refine_adhesion_fit(f, s);
        if (!(s->cost < best.cost))
            break;
        best = *s;
        jump_of_best = f->kind.jump;
        const size_t jump = find_position(samples, s->p[CURVE_C]);
        if (!follows || jump == f->kind.jump || jump < CURVE_BASELINE_SAMPLES ||
            samples->n - jump < CURVE_BASELINE_SAMPLES)
            break;
        f->kind.jump = jump;
    }
    const double final_cost = s->cost;
    f->kind.jump = jump_of_best;
    *s = best;
    return final_cost;
}

/* Starts a fit from a jump. The contact point is fixed first and free afterwards, because a fit
 * from the wrong side of the jump does not converge. Returns false if the start fails: the averaged
 * samples have a larger cost than without adhesion, by more than one sample on the wrong side of
 * the jump causes, or than a law that can win. */
static bool start_adhesion_fit(curve_fitting *f, curve_solution *s, double pull, size_t jump,
                               bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    const curve_solution elastic = *s;
    curve_samples thinned;
    double final_cost = 0.0, most = (double)INFINITY;
    if (!fixed)
        s->p[CURVE_C] = all.position[jump];
    f->kind.jump = jump;
    if (average_start_samples(f, jump, &thinned, &f->kind.jump)) {
        f->input.samples = thinned;
        most = fmin(cost_without_adhesion(f, elastic.p) + pull * pull,
                    f->largest_cost * (double)thinned.n / (double)all.n);
    }
    f->kind.contact_fixed = f->kind.is_approximate = true;
    refine_adhesion_fit(f, s);
    f->kind.contact_fixed = fixed;
    f->kind.cost_limit = most;
    if (!fixed)
        final_cost = refine_jump(f, s, follows);
    f->kind.cost_limit = 0.0;
    f->input.samples = all;
    f->kind.is_approximate = false;
    return !(final_cost > most);
}

/* Refines a fit from a jump. If `follows`, the jump stays at the contact point. */
static curve_solution refine_adhesion_start(curve_fitting *f, curve_solution s, double pull,
                                            size_t jump, bool follows)
{
    const bool fixed = f->kind.contact_fixed;
    const curve_samples all = f->input.samples;
    if (!start_adhesion_fit(f, &s, pull, jump, follows)) {
        s.converged = false;
        return s;
    }
    f->kind.jump = jump;
    if (!fixed) {
        const size_t touched = follows ? find_position(&all, s.p[CURVE_C]) : 0;
        if (touched >= CURVE_BASELINE_SAMPLES && all.n - touched >= CURVE_BASELINE_SAMPLES)
            f->kind.jump = touched;
        f->kind.is_approximate = true;
        (void)refine_jump(f, &s, follows);
        if (follows)
            shift_jump(f, &s);
        f->kind.is_approximate = false;
    }
    if (fixed || s.converged)
        refine_adhesion_fit(f, &s);
    f->kind.jump = s.first_contact;
    return s;
}

/* Ratio of the residual to the noise, at least 1. The errors grow by it, because any additional
 * parameter reduces the cost of a law that does not describe the curve. */
static double residual_over_noise(const curve_solution *s)
{
    return sqrt(fmax(1.0, s->lack.statistic));
}

static bool is_adhesive(const curve_fitting *f)
{
    const curve_solution *s = &f->solution;
    const double root = s->p[CURVE_W];
    const adhesion law = {f->table, s->p[CURVE_E], root * root};
    /* A detected snap-in can be excluded, which is better than a law that does not fit. */
    const bool strict = f->snap_in_pull > 0.0 && !curve_passes_misfit_test(f);
    const bool at_kink = s->step_left * s->p[CURVE_E] > kink_step * s->standard_error[CURVE_E];
    const double errors = f->kind.constant_pull && !strict ? 0.5 * work_errors : work_errors;
    return s->converged && !(strict && at_kink) &&
           root > errors * residual_over_noise(s) * s->standard_error[CURVE_W] &&
           (f->kind.constant_pull || !(adhesion_tabor(&law) < min_tabor));
}

/* Fits adhesive contact from several starts. `jump` is the first sample in contact. If it is 0, the
 * contact begins some depths of a jump before the contact point without adhesion. The solution has
 * the kind of this fit afterwards. */
static bool search_adhesion_fit(curve_fitting *f, curve_solution start, double pull, double depth,
                                size_t jump)
{
    const curve_samples *samples = &f->input.samples;
    const bool follows = jump == 0;
    for (size_t i = 0; i < (follows ? sizeof trial_jumps / sizeof trial_jumps[0] : 1); i++) {
        if (follows)
            jump = find_position(samples, start.p[CURVE_C] - trial_jumps[i] * depth);
        if (jump < CURVE_BASELINE_SAMPLES || samples->n - jump < CURVE_BASELINE_SAMPLES)
            continue;
        f->solution = refine_adhesion_start(f, start, pull, jump, follows);
        /* In a wrong minimum, contact begins far from where the force rises. */
        const bool is_near_start = !follows || f->solution.cost < start.cost;
        if (is_near_start && is_adhesive(f))
            return true;
        if (is_near_start && f->solution.converged) /* the fit converged to almost no adhesion */
            break;
    }
    return false;
}

/* Finds the JKR law with this pull-off force. Returns false if no such law applies. */
static bool find_jkr_law(const curve_fitting *f, double pull, adhesion *law)
{
    const double reduced = f->solution.p[CURVE_E], k = f->input.samples.spring_constant;
    *law = (adhesion){f->table, reduced, adhesion_work(f->table, reduced, k, pull)};
    return !isnan(law->work) && adhesion_applies(contact_table_tip(f->table));
}

/* Depth at first contact. */
static double jump_depth(const curve_fitting *f, const adhesion *law)
{
    const double k = f->input.samples.spring_constant, touch = 0.0;
    double bare;
    adhesion_balance(law, k, adhesion_release(law, k), &touch, 1, &bare);
    return adhesion_contact_value(law, bare).depth;
}

static bool fit_jkr(curve_fitting *f, double pull, size_t jump)
{
    curve_solution start = f->solution;
    adhesion law;
    if (!find_jkr_law(f, pull, &law))
        return false;
    start.p[CURVE_W] = sqrt(law.work);
    f->kind.adhesive = true;
    return search_adhesion_fit(f, start, pull, jump_depth(f, &law), jump);
}

static bool fit_constant_pull(curve_fitting *f, double pull, size_t jump)
{
    curve_solution start = f->solution;
    start.p[CURVE_W] = pull;
    f->kind.adhesive = f->kind.constant_pull = true;
    return search_adhesion_fit(f, start, pull, pull / f->input.samples.spring_constant, jump);
}

/* Fit of one law and its kind. */
typedef struct adhesive_law_fit {
    curve_solution solution;
    curve_kind kind;
    bool found, is_plausible;
    double evidence; /* twice the log likelihood of approach and retract */
} adhesive_law_fit;
enum { CONSTANT_PULL, JKR, JKR_REFINED, LAWS };

/* True if the pull of this fit, within its errors, is compatible with the retract. The pull-off of
 * rubber is at least as strong as its snap-in. */
static bool pull_is_plausible(const curve_fitting *f)
{
    const double root = fmax(0.0, f->solution.p[CURVE_W] -
                                      NORMAL_95 * f->solution.standard_error[CURVE_W]),
                 most = max_pull_ratio * f->pull_off;
    if (!(f->pull_off > 0.0))
        return true;
    if (f->kind.constant_pull)
        return root <= most;
    return !(root * root > adhesion_work(f->table, f->solution.p[CURVE_E],
                                         f->input.samples.spring_constant, most));
}

/* Log likelihood ratio 2 ln of `other` over a solution. */
static double log_evidence(const curve_solution *than, const curve_solution *other)
{
    return than->effective_n * log(than->cost / other->cost) / fmax(1.0, than->lack.statistic);
}

/* True if the tip pulls off, within the errors of the fit, at the position of first contact or
 * later. Rubber keeps contact at least up to that position during the retract. */
static bool pull_off_is_late(const curve_fitting *f, const curve_solution *out)
{
    const double *position = f->unloading.samples.position;
    const size_t jump = f->unloading.jump;
    const double between = position[jump + 1] - position[jump];
    return !(position[jump] > out->p[CURVE_C] + NORMAL_95 * out->standard_error[CURVE_C] + between);
}

/* Computes the evidence of the laws found. Without loss the retract follows the same law, and its
 * neck and pull-off distinguish laws that the approach does not. */
static void weigh_laws(curve_fitting *f, adhesive_law_fit law[LAWS])
{
    const curve_solution *best = NULL;
    curve_solution out[LAWS];
    bool fitted = f->loss < CURVE_MIN_LOSS && law[CONSTANT_PULL].found;
    for (int i = 0; i < LAWS; i++) {
        if (!law[i].found)
            continue;
        if (best == NULL || law[i].solution.cost < best->cost)
            best = &law[i].solution;
        fitted = fitted && curve_fit_unloading(f, &law[i].kind, &law[i].solution, &out[i]);
    }
    const curve_solution *least = NULL;
    for (int i = 0; i < LAWS && fitted; i++)
        if (law[i].found && (least == NULL || out[i].cost < least->cost))
            least = &out[i];
    for (int i = 0; i < LAWS; i++) {
        if (!law[i].found)
            continue;
        law[i].evidence = log_evidence(best, &law[i].solution);
        if (fitted) {
            law[i].evidence += log_evidence(least, &out[i]);
            law[i].is_plausible =
                law[i].is_plausible && (!out[i].converged || pull_off_is_late(f, &out[i]));
        }
    }
}

static bool is_better_law(const adhesive_law_fit *a, const adhesive_law_fit *b, bool lossy)
{
    if (!a->found || !b->found || a->is_plausible != b->is_plausible)
        return a->found && (!b->found || a->is_plausible);
    if (lossy && a->kind.constant_pull != b->kind.constant_pull)
        return b->kind.constant_pull;
    return a->evidence > b->evidence;
}

static double other_law_error(const curve_fitting *f, const curve_solution *other, double chi2)
{
    return curve_alternative_error(chi2, other->p[CURVE_E] / f->solution.p[CURVE_E] - 1.0);
}

/* Fits the laws of adhesion and selects the best. The other laws add to the error according to
 * their likelihood. Returns false and restores the fit if no law is found. `pull_alone` states that
 * only a constant pull can win; other laws are then tried only if it does. */
static bool fit_adhesion_laws(curve_fitting *f, double pull, size_t jump, bool pull_alone)
{
    const adhesive_law_fit before = {f->solution, f->kind, true, true, 0.0};
    adhesive_law_fit law[LAWS] = {{.found = false}};
    const adhesive_law_fit *best = &law[0];
    /* Loss resembles a constant pull, and neither law describes it, so costs do not decide. Forces
     * on rubber have a short range. */
    const bool lossy = jump == 0 && f->loss > CURVE_MIN_LOSS;
    f->largest_cost = (double)INFINITY;
    for (int i = 0; i < LAWS; i++) {
        f->solution = before.solution;
        f->kind = before.kind;
        const bool found =
            i == CONSTANT_PULL ? fit_constant_pull(f, pull, jump) : fit_jkr(f, pull, jump);
        law[i] = (adhesive_law_fit){f->solution, f->kind, found, pull_is_plausible(f), 0.0};
        if (i == CONSTANT_PULL && pull_alone &&
            !(law[i].found && -log_evidence(&f->solution, &before.solution) > better_chi2))
            break;
        if (i == CONSTANT_PULL && found && law[i].is_plausible && !lossy)
            f->largest_cost =
                f->solution.cost * exp(hopeless_chi2 * fmax(1.0, f->solution.lack.statistic) /
                                       f->solution.effective_n);
        /* The cost has kinks where samples pull off. A second start uses the fitted constant pull.
         */
        if (i == JKR)
            pull = law[CONSTANT_PULL].solution.p[CURVE_W];
        if (i == JKR && !(jump == 0 && pull > 0.0))
            break;
    }
    weigh_laws(f, law);
    for (int i = 1; i < LAWS; i++)
        if (is_better_law(&law[i], best, lossy))
            best = &law[i];
    const adhesive_law_fit *to = best->found ? best : &before;
    f->solution = to->solution;
    f->kind = to->kind;
    f->kind.wave = to->solution.wave;
    f->law_error = 0.0;
    for (int i = 0; i < LAWS && best->found; i++)
        if (law[i].found && &law[i] != best && (law[i].is_plausible || !best->is_plausible)) {
            const double gain = fmin(0.0, law[i].evidence - best->evidence);
            f->law_error = fmax(f->law_error, other_law_error(f, &law[i].solution, gain));
        }
    return best->found;
}

/* ---- score test for adhesion ----------------------------------------------------------------- */

/* Computes the residuals of a law at p. */
static void compute_residuals(const curve_fitting *f, const curve_kind *kind,
                              const double p[CURVE_N_PARAMETERS], double *to)
{
    curve_law m = curve_law_create(f->table, &f->input.samples, kind, f->workspace);
    curve_law_evaluate(&m, p, &kind->wave);
    memcpy(to, f->workspace->residual, f->input.samples.n * sizeof *to);
}

/* Computes the difference of the forces with and without adhesion of this pull. `without` has the
 * residuals without adhesion. Returns false if the law does not apply. */
static bool law_force_difference(const curve_fitting *f, bool constant_pull, double pull,
                                 const double *without, double *to)
{
    curve_kind kind = {.tilt = f->kind.tilt, .adhesive = true, .constant_pull = constant_pull};
    double p[CURVE_N_PARAMETERS];
    adhesion law;
    memcpy(p, f->solution.p, sizeof p);
    p[CURVE_W] = pull;
    if (!constant_pull) {
        if (!find_jkr_law(f, pull, &law))
            return false;
        p[CURVE_W] = sqrt(law.work);
        if (!f->kind.contact_fixed)
            p[CURVE_C] -= trial_jumps[0] * jump_depth(f, &law);
        p[CURVE_F0] = curve_baseline(&f->solution, p[CURVE_C]); /* keeps the baseline unchanged */
    }
    compute_residuals(f, &kind, p, to);
    const size_t touched = find_position(&f->input.samples, p[CURVE_C]);
    for (size_t i = 0; i < f->input.samples.n; i++)
        to[i] = i < touched ? 0.0 : without[i] - to[i];
    return true;
}

enum { SCORES = 1 + COUNT_OF(trial_pulls) }; /* a constant pull and the pulls to try */

/* Score tests with means of the samples: a constant pull, then some pulls of the JKR law. Returns
 * their number. */
static size_t score_laws(curve_fitting *f, double most, curve_score_result step[SCORES])
{
    const curve_kind plainly = {.tilt = f->kind.tilt};
    const curve_samples all = f->input.samples;
    const size_t length = curve_average_length(&all);
    wt_indent_workspace *w = f->workspace;
    curve_solution at = f->solution;
    double *const *const difference = w->wave_column; /* free without a wave */
    at.cost /= (double)length;
    f->input.samples = curve_average_samples(&all, all.n, length, w);
    compute_residuals(f, &plainly, f->solution.p, w->weight);
    /* The force is linear in a constant pull, so any small pull will do. */
    (void)law_force_difference(f, true, f->input.step_noise, w->weight, difference[0]);
    size_t n = 1;
    for (size_t i = 0; i < sizeof trial_pulls / sizeof trial_pulls[0]; i++)
        if (law_force_difference(f, false, trial_pulls[i] * most, w->weight, difference[n]))
            n++;
    curve_score(f->table, &f->input.samples, &f->kind, &at, difference, n, w, step);
    f->input.samples = all;
    return n;
}

/* Tests if a law of adhesion could improve a fit that describes the curve enough to replace it.
 * Otherwise the effect of a plausible pull on the modulus adds to the error. The workspace is that
 * of the solution afterwards. `pull_alone` is true if only a constant pull could replace the fit.
 */
static bool adhesion_may_improve(curve_fitting *f, double most, bool *pull_alone)
{
    curve_score_result step[SCORES];
    bool may_improve = false;
    const size_t n = score_laws(f, most, step);
    evaluate_solution(f);
    for (size_t i = n; i-- > 0;)
        if (step[i].share > 0.0 && step[i].gain > score_share * better_chi2) {
            *pull_alone = !may_improve && i == 0;
            may_improve = true;
        }
    if (may_improve)
        return true;
    if (step[0].share > 0.0 && step[0].gain > 0.25 * work_errors * work_errors)
        f->law_error = curve_alternative_error(step[0].gain, step[0].modulus);
    return false;
}

/* ---------------------------------------------------------------------------------------------- */

bool curve_fit_adhesion(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    const curve_kind plainly = f->kind;
    const bool is_adhesion_tried =
        !f->options->plain_least_squares && !f->without_adhesion && !curve_is_thin(f);
    curve_snap snap = f->snap;
    if (f->snap_in_pull > 0.0) {
        if (is_adhesion_tried) { /* starts at the deepest sample; before it the cantilever jumps or
                         is attracted */
            curve_exclude_samples(f, snap.start, snap.deepest + 1);
            if (fit_adhesion_laws(f, snap.pull, snap.start, false)) {
                evaluate_solution(f);
                return true;
            }
            snap.end -= snap.deepest + 1 - snap.start;
            snap.deepest = snap.start;
        }
        f->kind = plainly;
        curve_exclude_samples(f, snap.start, snap.end);
        curve_subtract_wave(f, &plainly.wave);
        return curve_scan_and_refine(f);
    }
    /* The pull-off of rubber is much stronger than its snap-in, which was not detected. */
    if (!(f->pull_off > 0.0) || !is_adhesion_tried)
        return true;
    const double most = fmin(f->pull_off, CURVE_PULL_NOISE * f->input.step_noise);
    const bool quick = curve_passes_misfit_test(f) && !curve_has_wave(&elastic.wave);
    bool pull_alone = false;
    if (quick && !adhesion_may_improve(f, most, &pull_alone))
        return true;
    const bool found = fit_adhesion_laws(f, most, 0, pull_alone);
    const double gain = found ? -log_evidence(&f->solution, &elastic) : (double)INFINITY;
    if (gain > better_chi2) {
        evaluate_solution(f);
        return true;
    }
    const curve_solution law = f->solution;
    f->kind = plainly;
    f->solution = elastic;
    f->kind.wave = elastic.wave;
    evaluate_solution(f);
    f->law_error = other_law_error(f, &law, gain);
    return true;
}
