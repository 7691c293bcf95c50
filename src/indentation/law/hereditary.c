/* Viscoelastic contact: recursion of a Prony series over time steps. f is linear within a step,
 * for which the recursion is exact.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/hereditary.h"

#include "dma/law/prony_law.h"

#include <math.h>
#include <stdlib.h>

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

double hereditary_decay(const hereditary *m, double *memory)
{
    double sum = 0.0;
    for (size_t i = 0; i < m->n; i++) {
        memory[i] *= m->decay[i];
        sum += memory[i];
    }
    return sum;
}

void hereditary_add_change(const hereditary *m, double *memory, double change)
{
    for (size_t i = 0; i < m->n; i++)
        memory[i] += m->gain[i] * change;
}

double hereditary_modulus(const wt_prony *series, double omega)
{
    double storage, loss;
    prony_moduli(series, omega, &storage, &loss);
    return hypot(storage, loss);
}
