/* Force in the equilibrium of cantilever and sample at the height of each sample.
 *
 * The noise is in the force, and the tip position includes the force. A noise e therefore appears
 * in "force minus E* G(measured indentation)" as h e with h = 1 + S/k (S = contact stiffness, k =
 * spring constant). For rubber of 20 MPa and a cantilever of 0.1 N/m it is 13 times larger in
 * contact than before it, and correlated with the abscissa. Least squares in that residual are
 * neither efficient nor unbiased. This file compares the force with the equilibrium force at the
 * height of the sample, k (z - delta) = E* G(delta), which does not change e. The plain residual
 * that most programs use is available for comparison.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_model.h"

#include "indentation/law/adhesion.h"

#include <math.h>
#include <string.h>

enum { N = CURVE_N_PARAMETERS, MAX_NEWTON = 50 /* bisection alone reaches 1e-15 */ };

/* Distance before contact from which samples are evaluated one by one, over the depth. */
static const double margin = 0.1;

WIDE_REGISTERS static void sum_baseline(curve_law *m, size_t n)
{
    const curve_samples *s = m->samples;
    m->n_baseline = n;
    m->baseline_end = n > 0 ? curve_find_span(s->position, n).high : -(double)INFINITY;
    m->z0 = n > 0 ? curve_sum(s->position, n) / (double)n : 0.0;
    m->f0 = n > 0 ? curve_sum(s->force, n) / (double)n : 0.0;
    wide z = {0.0}, zz = z, f = z, zf = z, ff = z;
    for (size_t i = 0; i < n; i += WIDE) {
        wide position = m->z0 - (wide){0.0}, force = m->f0 - (wide){0.0};
        if (i + WIDE <= n) {
            simd_load(&position, s->position + i);
            simd_load(&force, s->force + i);
        }
        for (size_t j = i; j < n && i + WIDE > n; j++) {
            position[j - i] = s->position[j];
            force[j - i] = s->force[j];
        }
        position -= m->z0;
        force -= m->f0;
        z += position;
        zz += position * position;
        f += force;
        zf += position * force;
        ff += force * force;
    }
    m->z = simd_sum(&z);
    m->zz = simd_sum(&zz);
    m->f = simd_sum(&f);
    m->zf = simd_sum(&zf);
    m->ff = simd_sum(&ff);
}

/* Number of samples that enter by sums alone. It is 0 for the plain residual, where noise decides
 * which samples are in contact, and with a wave, which changes all samples. */
static size_t count_baseline(const curve_law *m, double c)
{
    const curve_samples *s = m->samples;
    if (m->wave)
        return 0;
    if (m->jump > 0)
        return m->jump;
    const double limit = c - margin * fabs(s->position[s->n - 1] - c);
    const size_t most = s->gap_to > s->gap_from ? s->gap_from : s->n;
    size_t n = 0;
    while (!m->plain && n < most && s->position[n] < limit)
        n++;
    return n;
}

/* Computes the measured indentations. */
static void measure_indentations(curve_law *m, const double p[N], size_t first)
{
    m->balanced = false;
    const curve_samples *s = m->samples;
    const double k = s->spring_constant, stretch = 1.0 + p[CURVE_T] / k;
    for (size_t i = first; i < s->n; i++)
        m->workspace->delta[i] =
            (s->position[i] - p[CURVE_C]) * stretch - (s->force[i] - p[CURVE_F0]) / k;
}

/* Performs a Newton step for each sample in contact and returns the largest step. */
WIDE_REGISTERS static double newton_step(const curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    const wt_indent_workspace *w = m->workspace;
    const double k = s->spring_constant, e = p[CURVE_E];
    wide most = {0.0};
    double largest = 0.0;
    size_t i = first;
    for (; i + WIDE <= s->n; i += WIDE) {
        wide z, delta, g, slope;
        simd_load(&z, s->position + i);
        simd_load(&delta, w->delta + i);
        simd_load(&g, w->g + i);
        simd_load(&slope, w->slope + i);
        z -= p[CURVE_C];
        const wide out = -delta;
        wide step = (k * (z - delta) - e * g) / (k + e * slope);
        wide_maximum(&step, &out);
        step = (wide)((wide_bits)step & (z > 0.0));
        const wide back = -step;
        wide_maximum(&most, &step);
        wide_maximum(&most, &back);
        g += slope * step;
        delta += step;
        simd_store(w->g + i, &g);
        simd_store(w->delta + i, &delta);
    }
    for (size_t j = 0; j < WIDE; j++)
        largest = most[j] > largest ? most[j] : largest;
    for (; i < s->n; i++) {
        const double z = s->position[i] - p[CURVE_C];
        double step = (k * (z - w->delta[i]) - e * w->g[i]) / (k + e * w->slope[i]);
        if (step < -w->delta[i])
            step = -w->delta[i];
        if (z <= 0.0)
            step = 0.0;
        if (fabs(step) > largest)
            largest = fabs(step);
        w->g[i] += w->slope[i] * step;
        w->delta[i] += step;
    }
    return largest;
}

/* Replaces the indentations of the workspace by those in equilibrium, with G and G'. k (z - x) - E*
 * G(x) falls and is concave in x, so Newton's method converges from any start. The indentations of
 * the previous evaluation are a good start. */
WIDE_REGISTERS static void balance_elastic(curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    if (m->balanced) /* starts with the previous values of G and G' */
        (void)newton_step(m, p, first);
    m->balanced = true;
    for (size_t i = first; i < s->n; i++) {
        const double z = s->position[i] - p[CURVE_C], delta = w->delta[i];
        const bool inside = (delta > 0.0) & (delta < z); /* no branch, because noise decides */
        w->delta[i] = inside ? delta : z;
    }
    const double deepest = /* not negative for a curve without contact */
        first < s->n
            ? fmax(0.0, curve_find_span(s->position + first, s->n - first).high - p[CURVE_C])
            : 0.0;
    /* The error after a step of 1e-5 is of the order of its square. */
    double largest_step = (double)INFINITY;
    for (int i = 0; i < MAX_NEWTON && largest_step > 1e-5 * deepest; i++) {
        wt_contact_table_eval(m->table, w->delta + first, s->n - first, w->g + first,
                              w->slope + first);
        largest_step = newton_step(m, p, first);
    }
}

/* Evaluates a block of the branch. Samples at the end of the branch are all equal. */
static void evaluate_branch_block(const adhesion *law, const double *bare, size_t n,
                                  adhesive_contacts *to)
{
    size_t same = 1;
    while (same < n && !(bare[same] > bare[0]) && !(bare[same] < bare[0]))
        same++;
    adhesion_contacts(law, bare, same == n ? 1 : n, to);
    for (size_t j = 1; j < n && same == n; j++) {
        to->depth[j] = to->depth[0];
        to->force[j] = to->force[0];
        to->stiffness[j] = to->stiffness[0];
        to->by_modulus[j] = to->by_modulus[0];
        to->by_work[j] = to->by_work[0];
    }
}

/* Equilibrium with adhesive contact on the branch of large radii. A sample is on it from its jump
 * on, or from first contact. */
/* Depth beyond which a step of the fit is refused instead of evaluated: no tip is as large. */
static const double max_bare_depth = 1e-4;

static void balance_adhesive(const curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    const double k = s->spring_constant, e = p[CURVE_E], root = p[CURVE_W];
    const adhesion law = {m->table, e, root * root};
    const double release = adhesion_release(&law, k);
    double *const z = w->residual, *const bare = w->delta; /* inputs of both results */
    if (release > max_bare_depth) {
        for (size_t i = first; i < s->n; i++)
            w->g[i] = (double)INFINITY;
        return;
    }
    for (size_t i = first; i < s->n; i++) {
        z[i] = s->position[i] - p[CURVE_C];
        w->delta[i] = w->g[i] = w->slope[i] = w->by_modulus[i] = w->by_work[i] = 0.0;
    }
    while (first < s->n && (m->jump > 0 ? first < m->jump : !(z[first] > 0.0)))
        first++;
    adhesion_balance(&law, k, release, z + first, s->n - first, bare + first);
    for (size_t i = first; i < s->n; i += ADHESION_BLOCK) {
        const size_t n = s->n - i < ADHESION_BLOCK ? s->n - i : ADHESION_BLOCK;
        adhesive_contacts c;
        evaluate_branch_block(&law, bare + i, n, &c);
        for (size_t j = 0; j < n; j++) {
            const bool touches = m->jump > 0 || z[i + j] > 0.0;
            const bool moves =
                touches &&
                bare[i + j] >
                    release * (1.0 + 1e-9); /* other samples are at the end of the branch */
            w->delta[i + j] = touches ? c.depth[j] : 0.0;
            w->g[i + j] = touches ? c.force[j] / e : 0.0;
            w->slope[i + j] = moves ? c.stiffness[j] / e : 0.0;
            w->by_modulus[i + j] = moves ? c.by_modulus[j] : 0.0;
            w->by_work[i + j] = moves && root > 0.0 ? 2.0 * root * c.by_work[j] : 0.0;
        }
    }
}

/* Equilibrium with a constant pull P, which is equivalent to a height increased by P/k. */
static void balance_constant_pull(curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    const double k = s->spring_constant, e = p[CURVE_E], pull = p[CURVE_W];
    double higher[N];
    memcpy(higher, p, sizeof higher);
    higher[CURVE_C] -= pull / k;
    m->balanced = false; /* the previous forces include the pull */
    balance_elastic(m, higher, first);
    for (size_t i = first; i < s->n; i++) {
        const double z = s->position[i] - p[CURVE_C], g = w->g[i];
        const bool touches = m->jump > 0 ? i >= m->jump : z > 0.0, rests = z + pull / k > 0.0;
        const bool presses = touches && rests;
        w->delta[i] = presses ? w->delta[i] : 0.0;
        w->g[i] = !touches ? 0.0 : presses ? g - pull / e : k * z / e;
        w->slope[i] = presses ? w->slope[i] : 0.0;
        w->by_modulus[i] = presses ? g : 0.0;
        w->by_work[i] = presses ? -1.0 : 0.0;
    }
}

/* ---- equilibrium of cantilever and viscoelastic rubber --------------------------------------- */

/* Equilibrium of cantilever and viscoelastic rubber at the height of each sample in turn. Earlier
 * loading contributes a decaying force. The elastic force changes linearly in time between
 * samples. The recursion includes the derivatives, which depend on earlier values too. */

enum { MAX_LOSSY_STEPS = 30 }; /* from the previous step; bisection reaches 1e-9 */

/* Relative tolerance of equal time steps, because files store few digits. */
static const double same_step = 1e-3;

/* States of the elastic force over modulus and of its derivatives. */
enum { FORCE, BY_MODULUS, BY_CONTACT, N_MEMORIES };

/* Solves k (z - x) = E (past + now G(x)) for the depth x if k z > E past, and returns G and its
 * slope there. `start` is an initial value or 0. The left side minus the right side falls and is
 * concave. */
static double curve_balanced_depth(const wt_contact_table *table, double k, double z, double e,
                                   double past, double now, double start, double *g, double *slope)
{
    const double most = z - e * past / k;
    double x = start > 0.0 && start < most ? start : most;
    for (int i = 0; i < MAX_LOSSY_STEPS; i++) {
        wt_contact_table_eval(table, &x, 1, g, slope);
        double step = (k * (most - x) - e * now * *g) / (k + e * now * *slope);
        if (step < -x)
            step = -0.5 * x;
        x += step;
        *g += *slope * step;
        if (fabs(step) <= 1e-9 * most)
            break;
    }
    return x;
}

/* Computes the equilibrium for the samples from `first` on; earlier samples are out of contact. The
 * results are depth, force over modulus with its instantaneous slope, and the derivatives by
 * modulus and contact point times h. */
static void balance_hereditary(const curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    hereditary *law = &w->memory;
    const double k = s->spring_constant, e = p[CURVE_E];
    double before[N_MEMORIES] = {0.0};
    bool touched = false;
    for (size_t j = 0; j < N_MEMORIES; j++)
        memset(law->memory[j], 0, law->n * sizeof *law->memory[j]);
    for (size_t i = first; i < s->n; i++) {
        const double z = s->position[i] - p[CURVE_C], start = w->delta[i];
        w->delta[i] = w->g[i] = w->slope[i] = w->by_modulus[i] = w->by_contact[i] = 0.0;
        touched = touched || (z > 0.0 && i > 0);
        if (!touched)
            continue;
        const double step = w->time[i] - w->time[i - 1];
        if (!(fabs(step - law->step) < same_step * step))
            hereditary_set_step(law, step);
        const double now = hereditary_force(law, 0.0, 0.0, 1.0);
        double past[N_MEMORIES], f[N_MEMORIES] = {0.0};
        for (size_t j = 0; j < N_MEMORIES; j++)
            past[j] = hereditary_force(law, hereditary_decay(law, law->memory[j]), before[j], 0.0);
        if (k * z > e * past[FORCE]) {
            double slope;
            w->delta[i] =
                curve_balanced_depth(m->table, k, z, e, past[FORCE], now, start, &f[FORCE], &slope);
            const double force = past[FORCE] + now * f[FORCE], stiffness = k + e * now * slope;
            const double by_modulus = -(force + e * past[BY_MODULUS]) / stiffness,
                         by_contact = -(k + e * past[BY_CONTACT]) / stiffness;
            f[BY_MODULUS] = slope * by_modulus;
            f[BY_CONTACT] = slope * by_contact;
            w->g[i] = force;
            w->slope[i] = now * slope;
            w->by_modulus[i] = -by_modulus * stiffness;
            w->by_contact[i] = -(1.0 + by_contact) * stiffness;
        }
        for (size_t j = 0; j < N_MEMORIES; j++) {
            hereditary_add_change(law, law->memory[j], f[j] - before[j]);
            before[j] = f[j];
        }
    }
}

/* ---- evaluation ------------------------------------------------------------------------------ */

WIDE_REGISTERS static double evaluate_model(curve_law *m, const double p[N], size_t first)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    w->evaluations++;
    if (m->plain) {
        measure_indentations(m, p, first);
        wt_contact_table_eval(m->table, w->delta + first, s->n - first, w->g + first,
                              w->slope + first);
    } else if (m->adhesive && m->constant_pull) {
        balance_constant_pull(m, p, first);
    } else if (m->adhesive) {
        balance_adhesive(m, p, first);
    } else if (m->memory) {
        balance_hereditary(m, p, first);
    } else {
        balance_elastic(m, p, first);
    }
    const double e = p[CURVE_E], c = p[CURVE_C], f0 = p[CURVE_F0], t = p[CURVE_T];
    const double *position = s->position, *force = s->force, *g = w->g;
    double *restrict residual = w->residual;
    for (size_t i = first; i < s->n; i++)
        residual[i] = force[i] - f0 - t * (position[i] - c) - e * g[i];
    for (size_t i = s->gap_from > first ? s->gap_from : first; i < s->gap_to && i < s->n; i++)
        residual[i] = 0.0;
    return curve_dot(residual + first, residual + first, s->n - first);
}

void curve_model_resume(curve_law *m, const double p[N])
{
    sum_baseline(m, count_baseline(m, p[CURVE_C]));
}

void curve_model_start(curve_law *m, const double p[N])
{
    curve_model_resume(m, p);
    measure_indentations(m, p, m->n_baseline);
}

double curve_model_cost(curve_law *m, const double p[N])
{
    if (m->jump == 0 && m->n_baseline > 0 && p[CURVE_C] < m->baseline_end) {
        sum_baseline(m, count_baseline(m, p[CURVE_C]));
        measure_indentations(m, p, m->n_baseline);
    }
    double n = (double)m->n_baseline, t = p[CURVE_T];
    double offset = m->f0 - p[CURVE_F0] - t * (m->z0 - p[CURVE_C]);
    double baseline = m->ff + t * t * m->zz - 2.0 * t * m->zf +
                      offset * (n * offset + 2.0 * m->f - 2.0 * t * m->z);
    return baseline + evaluate_model(m, p, m->n_baseline);
}

void curve_model_complete(const curve_law *m, const double p[N])
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    for (size_t i = 0; i < m->n_baseline; i++) {
        const double z = s->position[i] - p[CURVE_C];
        w->delta[i] = z;
        w->g[i] = w->slope[i] = 0.0;
        w->residual[i] = s->force[i] - p[CURVE_F0] - p[CURVE_T] * z;
    }
    for (size_t i = 0; i < m->n_baseline && (m->adhesive || m->memory); i++)
        w->by_modulus[i] = w->by_contact[i] = w->by_work[i] = 0.0;
}

/* Adds a row for the first n parameters. */
static inline void add_equation_row(normal_equations *e, const double row[N], double r, size_t n)
{
    for (size_t a = 0; a < n; a++) {
        for (size_t b = a; b < n; b++)
            e->jj[a][b] += row[a] * row[b];
        e->jr[a] += row[a] * r;
    }
}

/* Adds the rows of curve_model_row for non-viscoelastic contact with all samples compared, four at
 * a time. Returns the next sample. */
WIDE_REGISTERS static size_t sum_rows_simd(const curve_law *m, const double p[N], size_t from,
                                           size_t end, normal_equations *to)
{
    const curve_samples *s = m->samples;
    const wt_indent_workspace *w = m->workspace;
    const double compliance_factor = p[CURVE_E] / s->spring_constant,
                 with_c = m->free[CURVE_C] ? -1.0 : 0.0, with_t = m->free[CURVE_T] ? 1.0 : 0.0;
    const double *const by_modulus = m->adhesive ? w->by_modulus : w->g;
    wide ee = {0.0}, ec = ee, ef = ee, et = ee, cc = ee, cf = ee, ct = ee, tf = ee, tt = ee,
         er = ee, cr = ee, fr = ee, tr = ee, ew = ee, cw = ee, fw = ee, tw = ee, ww = ee, wr = ee;
    size_t i = from;
    for (; i + WIDE <= end; i += WIDE) {
        wide slope, g, r, z;
        simd_load(&slope, w->slope + i);
        simd_load(&g, by_modulus + i);
        simd_load(&r, w->residual + i);
        simd_load(&z, s->position + i);
        const wide balanced = 1.0 / (1.0 + compliance_factor * slope), by_e = g * balanced,
                   by_c = with_c * (p[CURVE_T] + p[CURVE_E] * slope * balanced),
                   by_t = with_t * (z - p[CURVE_C]);
        ee += by_e * by_e;
        ec += by_e * by_c;
        ef += by_e;
        et += by_e * by_t;
        cc += by_c * by_c;
        cf += by_c;
        ct += by_c * by_t;
        tf += by_t;
        tt += by_t * by_t;
        er += by_e * r;
        cr += by_c * r;
        fr += r;
        tr += by_t * r;
        if (!m->adhesive)
            continue;
        wide by_w;
        simd_load(&by_w, w->by_work + i);
        by_w *= balanced;
        ew += by_e * by_w;
        cw += by_c * by_w;
        fw += by_w;
        tw += by_t * by_w;
        ww += by_w * by_w;
        wr += by_w * r;
    }
    to->jj[CURVE_E][CURVE_E] += simd_sum(&ee);
    to->jj[CURVE_E][CURVE_C] += simd_sum(&ec);
    to->jj[CURVE_E][CURVE_F0] += simd_sum(&ef);
    to->jj[CURVE_E][CURVE_T] += simd_sum(&et);
    to->jj[CURVE_C][CURVE_C] += simd_sum(&cc);
    to->jj[CURVE_C][CURVE_F0] += simd_sum(&cf);
    to->jj[CURVE_C][CURVE_T] += simd_sum(&ct);
    to->jj[CURVE_F0][CURVE_F0] += (double)(i - from);
    to->jj[CURVE_F0][CURVE_T] += simd_sum(&tf);
    to->jj[CURVE_T][CURVE_T] += simd_sum(&tt);
    to->jj[CURVE_E][CURVE_W] += simd_sum(&ew);
    to->jj[CURVE_C][CURVE_W] += simd_sum(&cw);
    to->jj[CURVE_F0][CURVE_W] += simd_sum(&fw);
    to->jj[CURVE_T][CURVE_W] += simd_sum(&tw);
    to->jj[CURVE_W][CURVE_W] += simd_sum(&ww);
    to->jr[CURVE_E] += simd_sum(&er);
    to->jr[CURVE_C] += simd_sum(&cr);
    to->jr[CURVE_F0] += simd_sum(&fr);
    to->jr[CURVE_T] += simd_sum(&tr);
    to->jr[CURVE_W] += simd_sum(&wr);
    return i;
}

void curve_model_add_rows(const curve_law *m, const double p[N], size_t from, size_t end,
                          normal_equations *to)
{
    const curve_samples *s = m->samples;
    const bool simple = !m->plain && !m->memory && !m->wave && s->gap_to <= s->gap_from;
    const size_t first = simple ? sum_rows_simd(m, p, from, end, to) : from;
    normal_equations e = *to; /* a local copy keeps the sums in registers */
    for (size_t i = first; i < end; i++) {
        double row[N], r = m->workspace->residual[i];
        curve_model_row(m, p, i, row);
        add_equation_row(&e, row, r, CURVE_W);
        if (m->adhesive) {
            for (size_t a = 0; a < N; a++)
                e.jj[a][CURVE_W] += row[a] * row[CURVE_W];
            e.jr[CURVE_W] += row[CURVE_W] * r;
        }
    }
    *to = e;
}

void curve_model_normal(const curve_law *m, const double p[N], normal_equations *e)
{
    memset(e, 0, sizeof *e);
    /* Rows before contact are (0, -t, 1, z - c), and r = f - f0 - t (z - c). */
    const double n = (double)m->n_baseline, t = p[CURVE_T], shift = m->z0 - p[CURVE_C];
    const double offset = m->f0 - p[CURVE_F0] - t * shift;
    const double sz = m->z + n * shift, szz = m->zz + shift * (2.0 * m->z + n * shift);
    const double sr = m->f - t * m->z + n * offset;
    const double szr = m->zf - t * m->zz + offset * m->z + shift * sr;
    if (m->free[CURVE_C]) {
        e->jj[CURVE_C][CURVE_C] = t * t * n;
        e->jj[CURVE_C][CURVE_F0] = -t * n;
        e->jr[CURVE_C] = -t * sr;
        if (m->free[CURVE_T])
            e->jj[CURVE_C][CURVE_T] = -t * sz;
    }
    e->jj[CURVE_F0][CURVE_F0] = n;
    e->jr[CURVE_F0] = sr;
    if (m->free[CURVE_T]) {
        e->jj[CURVE_F0][CURVE_T] = sz;
        e->jj[CURVE_T][CURVE_T] = szz;
        e->jr[CURVE_T] = szr;
    }
    curve_model_add_rows(m, p, m->n_baseline, m->samples->n, e);
    for (size_t a = 0; a < N; a++) {
        for (size_t b = 0; b < a; b++)
            e->jj[a][b] = e->jj[b][a];
        if (!m->free[a])
            e->jj[a][a] = 1.0;
    }
}
