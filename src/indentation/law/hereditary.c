/* Viscoelastic contact: recursion of a Prony series over time steps. f is linear within a step,
 * for which the recursion is exact.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/hereditary.h"
#include "core/math/root.h"
#include "core/math/simd.h"
#include "dma/law/prony_law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NEWTON = 60 }; /* limit of Newton's steps */

static const double close = 1e-15; /* tolerance of t1 in steps */

/* Step in relaxation times after which the decay is below the precision of a double. */
static const double long_step = 36.0;

/* ---- loading and unloading ------------------------------------------------------------------- */

/* Loading and unloading of a viscoelastic half-space by a tip (Lee and Radok; Ting). During
 * unloading the contact has the size that it had at an earlier time t1 of loading. The integral of
 * E(t - t') ddelta from t1 to t is zero, and only the loading before t1 contributes to the force.
 * t1 falls with time, and the search follows it backwards through the steps of loading. */

/* History of loading and state of unloading. */
typedef struct indentation_loop {
    hereditary *law;
    const wt_contact_table *table;
    double compliance;
    const double *time;
    double *depth, *f;      /* [steps] of loading */
    double *pushed, *moved; /* [steps][terms] states of f and of the depth */
    size_t step;            /* t1 lies in the step that ends here */
    double step_time;       /* time since that step began */
    double *step_decay;     /* [terms] decay since that step began */
    double *now;            /* [terms] state of the depth */
} indentation_loop;

/* Solves base = depth + compliance (past + now f(depth)) with Newton's method from above. */
static double loading_depth(const wt_contact_table *table, double compliance, double base,
                            double past, double now, double *f)
{
    const double most = base - compliance * past;
    double x = fmax(most, 0.0), slope;
    for (int i = 0; i < MAX_NEWTON && x > 0.0; i++) {
        wt_contact_table_eval(table, &x, 1, f, &slope);
        const double step = (most - x - compliance * now * *f) / (1.0 + compliance * now * slope);
        x = fmax(x + step, 0.0);
        if (fabs(step) <= 1e-15 * x)
            break;
    }
    wt_contact_table_eval(table, &x, 1, f, &slope);
    return x;
}

static double advance_loading(indentation_loop *l, size_t i, double base)
{
    hereditary *law = l->law;
    const size_t n = law->n;
    double *pushed = l->pushed + i * n, *moved = l->moved + i * n;
    memcpy(pushed, pushed - n, n * sizeof *pushed);
    memcpy(moved, moved - n, n * sizeof *moved);
    const double faded = hereditary_decay(law, pushed), before = l->f[i - 1];
    hereditary_decay(law, moved);
    const double past = hereditary_force(law, faded, before, 0.0);
    const double now = hereditary_force(law, 0.0, 0.0, 1.0);
    l->depth[i] = loading_depth(l->table, l->compliance, base, past, now, &l->f[i]);
    hereditary_add_change(law, pushed, l->f[i] - before);
    hereditary_add_change(law, moved, l->depth[i] - l->depth[i - 1]);
    return past + now * l->f[i];
}

static void begin_unloading_step(indentation_loop *l, double t)
{
    l->step_time = l->step > 0 ? t - l->time[l->step - 1] : 0.0;
    for (size_t i = 0; i < l->law->n && l->step > 0; i++)
        l->step_decay[i] = exp(-l->step_time / l->law->time[i]);
}

/* Force if t1 lies a share of the step after its start. `open` receives the part of the integral
 * since t1 that loading contributes. */
static double unloading_force(const indentation_loop *l, double share, double *depth, double *open)
{
    const hereditary *law = l->law;
    const size_t j = l->step;
    const double part = share * (l->time[j] - l->time[j - 1]), step_time = l->step_time - part;
    const double moved = share * (l->depth[j] - l->depth[j - 1]);
    double f, slope, force = 0.0;
    *depth = l->depth[j - 1] + moved;
    *open = 0.0;
    wt_contact_table_eval(l->table, depth, 1, &f, &slope);
    for (size_t i = 0; i < law->n; i++) {
        const double x = part / law->time[i];
        const double risen =
            x < long_step ? l->step_decay[i] * expm1(x) : exp(-step_time / law->time[i]);
        const double gain = law->modulus[i] * (x > 0.0 ? risen / x : l->step_decay[i]);
        const size_t at = (j - 1) * law->n + i;
        force += l->step_decay[i] * l->pushed[at] + gain * (f - l->f[j - 1]);
        *open -= l->step_decay[i] * l->moved[at] + gain * moved;
    }
    return law->equilibrium * f + force;
}

/* State at one time of unloading, with the depth at the end of the previous step. */
typedef struct unloading_state {
    const indentation_loop *l;
    double base, before, faded;
    double force, depth; /* for the latest t1 */
} unloading_state;

/* Integral since t1, which is a share of the step. It falls as t1 rises, and its root determines
 * the contact. */
static double depth_integral(double share, void *user)
{
    unloading_state *m = user;
    const indentation_loop *l = m->l;
    const hereditary *law = l->law;
    double then, open;
    m->force = unloading_force(l, share, &then, &open);
    m->depth = m->base - l->compliance * m->force;
    return law->equilibrium * (m->depth - then) + open + m->faded +
           (law->total_gain + law->viscosity / law->step) * (m->depth - m->before);
}

static wt_status advance_unloading(indentation_loop *l, double t, double base, double *depth,
                                   double *force, wt_error *err)
{
    unloading_state m = {
        .l = l, .base = base, .before = *depth, .faded = hereditary_decay(l->law, l->now)};
    *depth = base;
    *force = 0.0;
    begin_unloading_step(l, t);
    while (l->step > 0 && depth_integral(0.0, &m) <= 0.0) {
        l->step--;
        begin_unloading_step(l, t);
    }
    if (l->step == 0)
        return WT_OK;
    /* if not below zero, the contact keeps its radius */
    double share = 1.0;
    if (depth_integral(1.0, &m) < 0.0) {
        const wt_status status = root_find(depth_integral, &m, 0.0, 1.0, close, &share, err);
        if (status != WT_OK)
            return status;
        (void)depth_integral(share, &m);
    }
    hereditary_add_change(l->law, l->now, m.depth - m.before);
    *depth = m.depth;
    *force = m.force;
    return WT_OK;
}

wt_status hereditary_loop(hereditary *law, const wt_contact_table *table, double compliance,
                          const double *time, const double *base, size_t n, double *force,
                          wt_error *err)
{
    const size_t terms = law->n;
    double *block = wt_alloc(n * (2 + 2 * terms) + 2 * terms + 1, sizeof *block);
    indentation_loop l = {.law = law,
                          .table = table,
                          .compliance = compliance,
                          .time = time,
                          .depth = block,
                          .f = block + n,
                          .pushed = block + 2 * n,
                          .moved = block + (2 + terms) * n,
                          .step_decay = block + (2 + 2 * terms) * n,
                          .now = block + (2 + 2 * terms) * n + terms};
    double depth = 0.0;
    bool is_unloading = false;
    wt_status status = WT_OK;
    force[0] = 0.0;
    for (size_t i = 1; i < n && status == WT_OK; i++) {
        hereditary_set_step(law, time[i] - time[i - 1]);
        if (!is_unloading) { /* with a cantilever the depth still rises shortly after the base has
                                turned */
            force[i] = advance_loading(&l, i, base[i]);
            if (l.depth[i] >= l.depth[i - 1])
                continue;
            is_unloading = true;
            l.step = i - 1;
            depth = l.depth[i - 1];
            memcpy(l.now, l.moved + (i - 1) * terms, terms * sizeof *l.now);
        }
        status = advance_unloading(&l, time[i], base[i], &depth, &force[i], err);
    }
    free(block);
    return status;
}

/* ---- recursion ------------------------------------------------------------------------------- */

/* Limits of the relaxation times, in steps and in durations of the motion, beyond which a term is a
 * dashpot or a spring. The relative error is exp(-20) and 1e-5. */
static const double quickest = 0.05, slowest = 1e5;

void hereditary_reserve(hereditary *m, size_t terms)
{
    enum { N_ARRAYS = 7 }; /* number of the arrays below */
    if (terms <= m->capacity && m->block != NULL)
        return;
    double *block = wt_alloc(N_ARRAYS * (terms + 1), sizeof *block);
    free(m->block);
    *m = (hereditary){.block = block, .capacity = terms};
    double **const arrays[N_ARRAYS] = {&m->modulus,   &m->time,      &m->decay,    &m->gain,
                                       &m->memory[0], &m->memory[1], &m->memory[2]};
    for (size_t i = 0; i < N_ARRAYS; i++)
        *arrays[i] = block + i * (terms + 1);
}

void hereditary_clear(hereditary *m)
{
    free(m->block);
    *m = (hereditary){0};
}

void hereditary_begin(hereditary *m, const wt_prony *series, double scale, double shortest,
                      double longest)
{
    m->n = 0;
    m->equilibrium = scale * series->equilibrium_modulus;
    m->viscosity = m->step = 0.0;
    for (size_t i = 0; i < series->n; i++) {
        const double e = scale * series->modulus[i], tau = series->relaxation_time[i];
        if (tau > slowest * longest) {
            m->equilibrium += e;
        } else if (tau < quickest * shortest) {
            m->viscosity += e * tau;
        } else {
            m->modulus[m->n] = e;
            m->time[m->n++] = tau;
        }
    }
}

void hereditary_set_step(hereditary *m, double step)
{
    if (step <= m->step && step >= m->step)
        return;
    m->step = step;
    m->total_gain = 0.0;
    for (size_t i = 0; i < m->n; i++) {
        const double x = step / m->time[i];
        m->decay[i] = exp(-x);
        m->gain[i] = m->modulus[i] * (x > 0.0 ? -expm1(-x) / x : 1.0);
        m->total_gain += m->gain[i];
    }
}

WIDE_REGISTERS double hereditary_decay(const hereditary *m, double *memory)
{
    double sum = 0.0;
    size_t i = 0;
    for (; i + WIDE <= m->n; i += WIDE) {
        wide state, decay;
        simd_load(&state, memory + i);
        simd_load(&decay, m->decay + i);
        state *= decay;
        simd_store(memory + i, &state);
        sum = (((sum + state[0]) + state[1]) + state[2]) + state[3];
    }
    for (; i < m->n; i++) {
        memory[i] *= m->decay[i];
        sum += memory[i];
    }
    return sum;
}

WIDE_REGISTERS void hereditary_add_change(const hereditary *m, double *memory, double change)
{
    size_t i = 0;
    for (; i + WIDE <= m->n; i += WIDE) {
        wide state, gain;
        simd_load(&state, memory + i);
        simd_load(&gain, m->gain + i);
        state += gain * change;
        simd_store(memory + i, &state);
    }
    for (; i < m->n; i++)
        memory[i] += m->gain[i] * change;
}

double hereditary_modulus(const wt_prony *series, double omega)
{
    double storage, loss;
    prony_moduli(series, omega, &storage, &loss);
    return hypot(storage, loss);
}
