/* Equilibrium of cantilever and viscoelastic rubber at the height of each sample in turn. Earlier
 * loading contributes a decaying force. The elastic force changes linearly in time between
 * samples. The recursion includes the derivatives, which depend on earlier values too.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_model.h"

#include <math.h>
#include <string.h>

enum { MAX_NEWTON = 30 }; /* from the previous step; bisection reaches 1e-9 */
/* Relative tolerance of equal time steps, because files store few digits. */
static const double same_step = 1e-3;

/* States of the elastic force over modulus and of its derivatives. */
enum { FORCE, BY_MODULUS, BY_CONTACT, N_MEMORIES };

double curve_balanced_depth(const wt_contact_table *table, double k, double z, double e,
                            double past, double now, double start, double *g, double *slope)
{
    const double most = z - e * past / k;
    double x = start > 0.0 && start < most ? start : most;
    for (int i = 0; i < MAX_NEWTON; i++) {
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

void curve_balance_hereditary(const curve_law *m, const double p[CURVE_N_PARAMETERS], size_t first)
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
