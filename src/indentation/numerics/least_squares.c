/* Least squares of one force curve in modulus, contact point, baseline offset and tilt
 * (Levenberg-Marquardt), and the errors of the result:
 *
 *     covariance = (J'J)^-1 [ covariance of J'e ] (J'J)^-1
 *
 * with the correlations of the noise e of the baseline (curve_noise.c), and the error by the misfit
 * of the law from the spread of the result over ranges of the force.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

/* Limits of the iterations. Adhesive fits may not converge because of kinks, and each iteration
 * costs more. */
enum { N = CURVE_N_PARAMETERS, MAX_ITERATIONS = 60, MAX_ADHESIVE = 25 };

/* p values of a straight baseline below which it is reported as bent, and below which the errors
 * include it. */
static const double bent_chance = 0.01, possible_bend_chance = 0.05;

/* ---- model of the sine ----------------------------------------------------------------------- */

/* Model of a sine in the force that is fitted together with the other parameters.
 *
 * Interference adds to the detector signal a sine of the optical path between cantilever and
 * sample. Out of contact the path is that of the piezo. In contact it changes by the indentation
 * alone, and the period is longer for a stiffer sample. The phase is taken as that of the tip, z -
 * P/k with the contact force P. Amplitude and period are constant; the motion of the laser spot on
 * the detector and the rotation of the cantilever are neglected. A disturbance with another origin
 * depends on the height; curve_refine tests both.
 *
 * The derivatives by the other parameters exclude their projection on the wave. Steps, errors and
 * gains then follow as without a wave (Frisch and Waugh). */

enum { M = WAVE_PARAMETERS };

/* Subtracts the wave from the forces after an evaluation at p, and returns the sum of squares. */
static double wave_cost(const curve_law *m, const double p[N], const curve_wave *wave)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    const double a = wave->p[WAVE_COSINE], b = wave->p[WAVE_SINE], number = wave->p[WAVE_NUMBER];
    double sum = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        const bool with_tip = !wave->by_height && fabs(w->g[i]) > 0.0;
        const double path = with_tip ? p[CURVE_C] + w->delta[i] : s->position[i];
        const double cosine = cos(number * path), sine = sin(number * path);
        const double phase_derivative = b * cosine - a * sine;
        const double baseline = p[CURVE_F0] + p[CURVE_T] * (s->position[i] - p[CURVE_C]);
        w->wave_column[WAVE_COSINE][i] = cosine;
        w->wave_column[WAVE_SINE][i] = sine;
        w->wave_column[WAVE_NUMBER][i] = path * phase_derivative;
        w->wave_response[i] = with_tip ? 1.0 - number * phase_derivative / s->spring_constant : 1.0;
        s->force[i] = w->force[i] - a * cosine - b * sine;
        w->residual[i] =
            curve_is_in_gap(s, i) ? 0.0 : s->force[i] - baseline - p[CURVE_E] * w->g[i];
        sum += w->residual[i] * w->residual[i];
    }
    return sum;
}

/* Projection of the derivatives on the wave and the step of the wave. */
typedef struct wave_step {
    double step[WAVE_PARAMETERS]; /* step to the minimum with the other parameters fixed */
    double gain;                  /* decrease of the sum of squares by that step */
} wave_step;

/* Computes the projection at the latest evaluation and wave. Returns false if the wave is not
 * determined. */
static bool project_wave(curve_law *m, const double p[N], wave_step *to)
{
    const curve_samples *s = m->samples;
    double *const *column = m->workspace->wave_column;
    double ww[M][M] = {{0.0}}, wj[M][N] = {{0.0}}, wr[M] = {0.0}, scale[M], scaled[M * M];
    memset(m->wave_projection, 0, sizeof m->wave_projection);
    for (size_t i = 0; i < s->n; i++) {
        if (curve_is_in_gap(s, i))
            continue;
        double row[N];
        curve_model_row(m, p, i, row);
        for (size_t j = 0; j < M; j++) {
            for (size_t l = 0; l < M; l++)
                ww[j][l] += column[j][i] * column[l][i];
            for (size_t a = 0; a < N; a++)
                wj[j][a] += column[j][i] * row[a];
            wr[j] += column[j][i] * m->workspace->residual[i];
        }
    }
    for (size_t j = 0; j < M; j++) {
        if (!(ww[j][j] > 0.0))
            return false;
        scale[j] = 1.0 / sqrt(ww[j][j]);
    }
    for (size_t j = 0; j < M; j++)
        for (size_t l = 0; l < M; l++)
            scaled[j * M + l] = ww[j][l] * scale[j] * scale[l];
    gsl_matrix_view matrix = gsl_matrix_view_array(scaled, M, M);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS)
        return false;
    to->gain = 0.0;
    for (size_t a = 0; a <= N; a++) { /* the last column is the step */
        double x[M];
        for (size_t j = 0; j < M; j++)
            x[j] = scale[j] * (a < N ? wj[j][a] : wr[j]);
        gsl_vector_view vector = gsl_vector_view_array(x, M);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector) != GSL_SUCCESS)
            return false;
        for (size_t j = 0; j < M; j++) {
            x[j] *= scale[j];
            if (a < N)
                m->wave_projection[j][a] = x[j];
            else
                to->gain += x[j] * wr[j];
        }
        if (a == N)
            memcpy(to->step, x, sizeof x);
    }
    return true;
}

/* ---- minimum --------------------------------------------------------------------------------- */

/* Solves (J'J + damping diag) x = y for several y with columns scaled to 1. */
static bool solve_normal_equations(const normal_equations *e, double damping, double (*y)[N],
                                   size_t n_y)
{
    double scaled[N * N], scale[N];
    for (size_t a = 0; a < N; a++) {
        if (!(e->jj[a][a] > 0.0))
            return false;
        scale[a] = 1.0 / sqrt(e->jj[a][a]);
    }
    for (size_t a = 0; a < N; a++)
        for (size_t b = 0; b < N; b++)
            scaled[a * N + b] = e->jj[a][b] * scale[a] * scale[b] + (a == b ? damping : 0.0);
    gsl_matrix_view matrix = gsl_matrix_view_array(scaled, N, N);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS)
        return false;
    for (size_t j = 0; j < n_y; j++) {
        for (size_t a = 0; a < N; a++)
            y[j][a] *= scale[a];
        gsl_vector_view x = gsl_vector_view_array(y[j], N);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
            return false;
        for (size_t a = 0; a < N; a++)
            y[j][a] *= scale[a];
    }
    return true;
}

static double parameter_dot(const double a[N], const double b[N])
{
    double sum = 0.0;
    for (size_t i = 0; i < N; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Smallest step, in standard errors, that decreases the cost significantly. */
static const double least_step = 1e-5;

/* Factor on the smallest decrease for approximate convergence: a thousandth of a standard error. */
static const double near_minimum_factor = 1e4;
static const double stalled_factor = 1e8; /* a tenth of a standard error */
static const double kink_factor =
    1e10; /* one standard error; limit of the gain that a sample at a kink prevents */
static const double least_damping = 1e-3;
/* Largest ratio of the decrease of the cost in a whole fit to the predicted decrease of a step.
 * Near convergence it is one, also with a jump shifted by one sample. */
static const double max_promise_factor = 10.0;

static double step_cost(const curve_samples *s, double cost)
{
    return least_step * least_step / (double)s->n * cost;
}

WIDE_REGISTERS static double rounding_cost(const curve_samples *s)
{
    return 1e-28 * curve_dot(s->force, s->force, s->n);
}

static double evaluate_cost(curve_law *m, const double p[N], const curve_wave *wave)
{
    const double cost = curve_model_cost(m, p);
    return m->wave ? wave_cost(m, p, wave) : cost;
}

/* Parameters of the wave after a step of the other parameters. */
static curve_wave step_wave(const curve_law *m, const curve_wave *wave, const wave_step *wave_only,
                            const double step[N], double damping)
{
    curve_wave to = *wave;
    for (size_t j = 0; j < WAVE_PARAMETERS && m->wave; j++)
        to.p[j] +=
            wave_only->step[j] / (1.0 + damping) - parameter_dot(m->wave_projection[j], step);
    return to;
}

/* Minimises the cost. The model is evaluated at p and the wave afterwards. */
static bool minimise(curve_law *m, double p[N], curve_wave *wave, double *cost)
{
    const curve_samples *s = m->samples;
    double expected = (double)INFINITY, kept_damping = 0.0; /* damping at the start of a step */
    const double rounding = rounding_cost(s), close = m->is_approximate ? near_minimum_factor : 1.0;
    wave_step wave_only = {.gain = 0.0};
    curve_model_start(m, p);
    *cost = evaluate_cost(m, p, wave);
    for (int iteration = 0; iteration < (m->adhesive ? MAX_ADHESIVE : MAX_ITERATIONS);
         iteration++) {
        normal_equations e;
        if (m->wave && !project_wave(m, p, &wave_only))
            return false;
        curve_model_normal(m, p, &e);
        bool moved = false;
        for (double damping = 0.0; !moved;
             damping = damping > 0.0 ? 10.0 * damping : fmax(kept_damping, least_damping)) {
            double step[1][N], candidate[N];
            memcpy(step[0], e.jr, sizeof e.jr);
            bool solved = solve_normal_equations(&e, damping, step, 1);
            if (damping == 0.0) {
                expected =
                    solved ? parameter_dot(step[0], e.jr) + wave_only.gain : (double)INFINITY;
                if (expected <= close * step_cost(s, *cost) || expected <= rounding)
                    return true;
                if (*cost - max_promise_factor * expected > m->cost_limit && m->cost_limit > 0.0)
                    return false;
            }
            for (size_t a = 0; a < N; a++)
                candidate[a] = p[a] + step[0][a];
            const curve_wave trial_wave = step_wave(m, wave, &wave_only, step[0], damping);
            const double before = *cost;
            const bool is_near_minimum = expected < fmax(1e-9 * before, 1e-14 * m->ff);
            const bool is_too_long = damping == 0.0 && kept_damping > 0.0 && !is_near_minimum;
            if (solved && !is_too_long && candidate[CURVE_E] > 0.0 && candidate[CURVE_W] >= 0.0 &&
                (!m->wave || trial_wave.p[WAVE_NUMBER] > 0.0)) {
                double trial_cost = evaluate_cost(m, candidate, &trial_wave);
                /* Near the minimum the decrease is below the rounding error of the cost. */
                if (trial_cost < before || (damping == 0.0 && is_near_minimum)) {
                    *cost = trial_cost;
                    memcpy(p, candidate, sizeof candidate);
                    *wave = trial_wave;
                    moved = true;
                    if (damping <= kept_damping) /* accepted at the first attempt */
                        kept_damping = 0.1 * damping < least_damping ? 0.0 : 0.1 * damping;
                    else
                        kept_damping = damping;
                }
            }
            /* A kink, where a sample pulls off, prevents any further decrease, however large the
             * predicted one. */
            if (moved && m->adhesive && damping > 0.0 &&
                before - *cost < stalled_factor * step_cost(s, before))
                return expected <= kink_factor * step_cost(s, before);
            if (damping > 1e8) { /* no descent: converged within rounding unless a larger decrease
                                    was predicted */
                *cost = evaluate_cost(m, p, wave);
                return expected <= 1e6 * rounding;
            }
        }
    }
    return expected <= near_minimum_factor * step_cost(s, *cost);
}

static size_t first_contact(const curve_law *m, const double p[N])
{
    const curve_samples *s = m->samples;
    size_t first = 0;
    while (first < s->n && (m->jump > 0 ? first < m->jump : s->position[first] < p[CURVE_C]))
        first++;
    return first;
}

/* ---- spread of the result over the range of the fit ------------------------------------------ */

/* Shares of the largest force that divide the contact into parts, and the parts of the ranges that
 * are compared with the fit of all parts: 0 to 50 %, 30 to 100 % and 15 to 70 % of the force. */
enum { PARTS = 5 };
static const double part_end[PARTS - 1] = {0.15, 0.3, 0.5, 0.7};
static const int range_parts[WT_FIT_RANGES][2] = {{0, 3}, {2, PARTS}, {1, 4}};

typedef struct force_parts {
    normal_equations of[PARTS]; /* upper triangles */
    size_t n[PARTS];
} force_parts;

/* Divides the contact into parts, at the last sample with a modelled force below each limit. */
static void divide_contact(const curve_law *m, const double p[N], size_t first, force_parts *parts)
{
    const curve_samples *s = m->samples;
    const double *g = m->workspace->g, largest = g[s->n - 1];
    size_t to = s->n;
    for (int part = PARTS; part-- > 0;) {
        size_t from = part > 0 ? to : first;
        while (part > 0 && from > first && g[from - 1] > part_end[part - 1] * largest)
            from--;
        curve_model_add_rows(m, p, from, to, &parts->of[part]);
        for (size_t i = from; i < to; i++)
            parts->n[part] += !curve_is_in_gap(s, i);
        to = from;
    }
}

/* Solves for the step of the parameters to a range, and for the inverse of its matrix. */
static bool solve_range(const force_parts *parts, const normal_equations *all, const int range[2],
                        double (*inverse)[N], double step[N])
{
    normal_equations e = *all;
    double x[N + 1][N] = {{0.0}};
    size_t n = 0;
    for (int part = 0; part < PARTS; part++) {
        if (part >= range[0] && part < range[1]) {
            n += parts->n[part];
            continue;
        }
        for (size_t a = 0; a < N; a++) {
            e.jr[a] -= parts->of[part].jr[a];
            for (size_t b = a; b < N; b++)
                e.jj[b][a] = e.jj[a][b] -= parts->of[part].jj[a][b];
        }
    }
    for (size_t a = 0; a < N; a++)
        x[a][a] = 1.0;
    memcpy(x[N], e.jr, sizeof e.jr);
    if (n < CURVE_CONTACT_SAMPLES || !solve_normal_equations(&e, 0.0, x, N + 1))
        return false;
    memcpy(inverse, x, N * sizeof x[0]);
    memcpy(step, x[N], sizeof x[N]);
    return true;
}

/* Error by the misfit of the law: half of the spread of each parameter over the ranges, without the
 * part that noise makes. A law that holds gives each range the same result within the noise. The
 * result of a range is one step from the fit of all samples. The noise of a step is that of the
 * fit times the loss of precision by the samples that the range lacks. */
static void compute_range_spread(const force_parts *parts, const normal_equations *all,
                                 double (*inverse)[N], curve_solution *s)
{
    double low[N] = {0.0}, high[N] = {0.0}, noise[N] = {0.0}, in_range[N][N], step[N];
    bool is_known = false;
    for (int range = 0; range < WT_FIT_RANGES; range++) {
        s->range_shift[range] = s->range_error[range] = (double)NAN;
        if (!solve_range(parts, all, range_parts[range], in_range, step))
            continue;
        is_known = true;
        for (size_t a = 0; a < N; a++) {
            const double loss = fmax(in_range[a][a] / inverse[a][a] - 1.0, 0.0);
            low[a] = fmin(low[a], step[a]);
            high[a] = fmax(high[a], step[a]);
            noise[a] = fmax(noise[a], s->standard_error[a] * s->standard_error[a] * loss);
            if (a == CURVE_E) {
                s->range_shift[range] = step[a] / s->p[a];
                s->range_error[range] = s->standard_error[a] * sqrt(loss) / s->p[a];
            }
        }
    }
    for (size_t a = 0; a < N; a++)
        s->misfit_error[a] =
            is_known ? sqrt(fmax(0.25 * pow(high[a] - low[a], 2) - noise[a], 0.0)) : (double)NAN;
}

void curve_add_misfit(curve_fitting *f)
{
    curve_solution *s = &f->solution;
    const bool is_used = !f->kind.plain && f->options->misfit_p_threshold > 0.0 && s->converged;
    for (size_t i = 0; i < CURVE_N_PARAMETERS; i++) {
        if (!is_used)
            s->misfit_error[i] = (double)NAN;
        s->standard_error[i] = hypot(s->standard_error[i], fmax(s->misfit_error[i], 0.0));
    }
}

WIDE_REGISTERS static void compute_statistics(const curve_law *m, curve_solution *s)
{
    const curve_samples *samples = m->samples;
    wt_indent_workspace *w = m->workspace;
    const double *p = s->p;
    const size_t n = samples->n;

    const size_t first = s->first_contact;

    /* A sensitivity that is larger by a share u acts like a noise of u times the force f. On the
     * baseline, which is noise alone, J'f equals J'r. */
    normal_equations e;
    curve_model_normal(m, p, &e);
    double row[N], gain[N];
    memcpy(gain, e.jr, sizeof gain);
    s->max_indentation = fmax(0.0, curve_find_span(w->delta, n).high);
    force_parts parts = {0};
    memcpy(w->scratch, w->residual, m->n_baseline * sizeof *w->scratch);
    for (size_t i = m->n_baseline; i < n; i++) {
        const double r = w->residual[i], h = curve_model_row(m, p, i, row);
        const double f =
            samples->force[i] - p[CURVE_F0] - p[CURVE_T] * (samples->position[i] - p[CURVE_C]);
        w->scratch[i] = r / h; /* e */
        for (size_t a = 0; a < N; a++)
            gain[a] += row[a] * (h * f - r);
    }
    s->lack = curve_lack_of_fit(m, p, w->scratch);
    s->bent = s->lack.baseline_p < bent_chance;
    const curve_noise noise =
        curve_estimate_noise(m, p, w->scratch, first, s->lack.baseline_p < possible_bend_chance);
    s->noise = sqrt(noise.variance);
    s->correlation_length = noise.correlation_length;
    s->effective_n = (double)(n - (samples->gap_to - samples->gap_from)) / noise.correlation_length;

    double inverse[N + 2][N] = {{0.0}};
    for (size_t a = 0; a < N; a++)
        inverse[a][a] = 1.0;
    memcpy(inverse[N], gain, sizeof gain);
    memcpy(inverse[N + 1], e.jr, sizeof e.jr); /* step to the minimum */
    bool solved = solve_normal_equations(&e, 0.0, inverse, N + 2);
    for (size_t a = 0; a < N; a++) {
        double variance = 0.0;
        for (size_t b = 0; b < N; b++)
            for (size_t c = 0; c < N; c++)
                variance += inverse[a][b] * noise.scatter[b][c] * inverse[a][c];
        s->standard_error[a] = !m->free[a] ? 0.0 : solved ? sqrt(variance) : (double)NAN;
    }
    divide_contact(m, p, first, &parts);
    if (solved)
        compute_range_spread(&parts, &e, inverse, s);
    /* A step with a smaller predicted decrease changes the modulus by less. */
    const double allowed = fmax(step_cost(samples, s->cost), rounding_cost(samples));
    s->step_allowed = sqrt(allowed * inverse[CURVE_E][CURVE_E]) / p[CURVE_E];
    s->step_left =
        sqrt(parameter_dot(inverse[N + 1], e.jr) * inverse[CURVE_E][CURVE_E]) / p[CURVE_E];
    s->curvature = noise.curvature;
    s->bend_shift = solved ? parameter_dot(inverse[CURVE_E], noise.bend) : (double)NAN;
    s->sensitivity_gain = solved ? inverse[N][CURVE_E] / p[CURVE_E] : (double)NAN;
}

curve_law curve_law_create(const wt_contact_table *table, const curve_samples *samples,
                           const curve_kind *kind, wt_indent_workspace *workspace)
{
    return (curve_law){.table = table,
                       .samples = samples,
                       .workspace = workspace,
                       .free = {true, !kind->contact_fixed, true, kind->tilt, kind->adhesive},
                       .plain = kind->plain,
                       .adhesive = kind->adhesive,
                       .constant_pull = kind->constant_pull,
                       .memory = kind->memory && !kind->adhesive,
                       .wave = curve_has_wave(&kind->wave),
                       .is_approximate = kind->is_approximate && !curve_has_wave(&kind->wave),
                       .cost_limit = kind->cost_limit,
                       .jump = kind->jump};
}

void curve_law_evaluate(curve_law *m, const double p[N], const curve_wave *wave)
{
    wave_step ignored;
    curve_model_resume(m, p);
    (void)evaluate_cost(m, p, wave);
    if (m->wave)
        (void)project_wave(m, p, &ignored);
    curve_model_complete(m, p);
}

/* Variant of curve_refine for one kind of wave, or without a wave. */
static void refine_single_kind(const wt_contact_table *table, const curve_samples *samples,
                               const curve_kind *kind, const double p[N],
                               wt_indent_workspace *workspace, curve_solution *solution)
{
    curve_law m = curve_law_create(table, samples, kind, workspace);
    curve_solution s = {.p = {p[CURVE_E], p[CURVE_C], p[CURVE_F0], kind->tilt ? p[CURVE_T] : 0.0,
                              kind->adhesive ? p[CURVE_W] : 0.0},
                        .wave = kind->wave};
    wave_step ignored;
    s.converged = minimise(&m, s.p, &s.wave, &s.cost);
    if (m.wave)
        s.converged = project_wave(&m, s.p, &ignored) && s.converged;
    s.first_contact = first_contact(&m, s.p);
    if (!m.is_approximate) {
        curve_model_complete(&m, s.p);
        compute_statistics(&m, &s);
    }
    *solution = s;
}

/* Score test of one difference at the latest evaluation. */
static bool score_difference(const curve_law *m, const curve_solution *at,
                             const normal_equations *e, const double *difference,
                             curve_score_result *to)
{
    const curve_samples *s = m->samples;
    double towards[N] = {0.0}, along[1][N], row[N], dd = 0.0, dr = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        const double d = difference[i];
        if (!(fabs(d) > 0.0))
            continue;
        (void)curve_model_row(m, at->p, i, row);
        dd += d * d;
        dr += d * m->workspace->residual[i];
        for (size_t a = 0; a < N; a++)
            towards[a] += row[a] * d;
    }
    memcpy(along[0], towards, sizeof towards);
    if (!solve_normal_equations(e, 0.0, along, 1))
        return false;
    dd -= parameter_dot(along[0], towards);
    dr -= parameter_dot(along[0], e->jr);
    if (!(dd > 0.0) || !(dr * dr / dd < at->cost))
        return false;
    to->share = dr / dd;
    to->gain = -at->effective_n * log1p(-dr * to->share / at->cost);
    to->modulus = -to->share * along[0][CURVE_E] / at->p[CURVE_E];
    return true;
}

void curve_score(const wt_contact_table *table, const curve_samples *samples,
                 const curve_kind *kind, const curve_solution *at, double *const *difference,
                 size_t n, wt_indent_workspace *workspace, curve_score_result *to)
{
    curve_law m = curve_law_create(table, samples, kind, workspace);
    normal_equations e;
    curve_law_evaluate(&m, at->p, &at->wave);
    curve_model_normal(&m, at->p, &e);
    for (size_t j = 0; j < n; j++)
        if (!score_difference(&m, at, &e, difference[j], &to[j]))
            to[j] = (curve_score_result){0.0, 0.0, 0.0};
}

static bool is_better_solution(const curve_solution *a, const curve_solution *b)
{
    return a->converged && (!b->converged || a->cost < b->cost);
}

void curve_refine(const wt_contact_table *table, const curve_samples *samples, curve_kind kind,
                  const double p[N], wt_indent_workspace *workspace, curve_solution *solution)
{
    if (!curve_has_wave(&kind.wave)) {
        refine_single_kind(table, samples, &kind, p, workspace, solution);
        return;
    }
    curve_solution solution_by_kind[2],
        other; /* wave as a function of tip position, and of height */
    for (int h = 0; h < 2; h++) {
        kind.wave.by_height = h;
        refine_single_kind(table, samples, &kind, p, workspace, &solution_by_kind[h]);
    }
    for (int h = 0; h < 2;
         h++) { /* starts from the other solution, because there are several minima */
        curve_kind from = kind;
        from.wave = solution_by_kind[1 - h].wave;
        from.wave.by_height = h;
        refine_single_kind(table, samples, &from, solution_by_kind[1 - h].p, workspace, &other);
        solution_by_kind[h] =
            is_better_solution(&other, &solution_by_kind[h]) ? other : solution_by_kind[h];
    }
    const double chi2 =
        solution_by_kind[0].effective_n * log(solution_by_kind[1].cost / solution_by_kind[0].cost);
    const int best = is_better_solution(&solution_by_kind[1], &solution_by_kind[0]);
    kind.wave = solution_by_kind[best].wave; /* restores the workspace of the solution */
    refine_single_kind(table, samples, &kind, solution_by_kind[best].p, workspace, solution);
    const double share = 1.0 / (1.0 + exp(0.5 * fabs(chi2))); /* likelihood of the other kind */
    for (size_t a = 0; a < N; a++)
        solution->standard_error[a] =
            hypot(solution->standard_error[a],
                  sqrt(share) * (solution_by_kind[0].p[a] - solution_by_kind[1].p[a]));
}
