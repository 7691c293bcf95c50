/* Viscoelastic contact. The elastic force is E f(t). The viscoelastic force is the integral of E(t
 * - t') df(t') with E(t) = rest + sum E_i exp(-t/tau_i) (Lee and Radok). When the contact area
 * shrinks, only the loading before the same area on approach contributes (Ting). Internal to the
 * library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_HEREDITARY_H
#define WT_INDENTATION_LAW_HEREDITARY_H

#include "weartrack/indentation.h"

/* Prony series prepared for the steps of one motion. */
typedef struct hereditary {
    double
        equilibrium;  /* equilibrium modulus, with the terms that do not relax within the motion */
    double viscosity; /* sum of modulus times relaxation time over the terms that relax within a
                         step */
    size_t n;         /* remaining terms */
    double *modulus, *time;
    double step;              /* length of the step for the next members */
    double *decay;            /* factor by which each term decays in a step */
    double *gain, total_gain; /* increase of each term per unit change over a step, and their sum */
    double *memory[3];        /* [n] each; states that the caller advances along the motion */
    double *block;
    size_t capacity;
} hereditary;

/* Reserves space for the terms of a series. An empty structure is zero. */
void hereditary_reserve(hereditary *m, size_t terms);
void hereditary_clear(hereditary *m);
/* Sets the moduli times `scale`. `shortest` is the shortest step, `longest` the duration of the
 * motion. */
void hereditary_begin(hereditary *m, const wt_prony *series, double scale, double shortest,
                      double longest);
/* Prepares a step of this length. An unchanged length costs nothing. */
void hereditary_set_step(hereditary *m, double step);
/* Advances a state [n] over the step and returns its sum. */
double hereditary_decay(const hereditary *m, double *memory);
/* Adds an even change of f during the step. */
void hereditary_add_change(const hereditary *m, double *memory, double change);
/* Force at the end of a step in which f changed from `before` to `f`. `faded` is the result of
 * hereditary_decay. */
static inline double hereditary_force(const hereditary *m, double faded, double before, double f)
{
    return m->equilibrium * f + faded + (m->total_gain + m->viscosity / m->step) * (f - before);
}

/* Computes the forces of a tip at n times. The base rises from contact (the first position) to one
 * maximum and falls again. With a compliance of 0 the base is the depth. */
wt_status hereditary_loop(hereditary *law, const wt_contact_table *table, double compliance,
                          const double *time, const double *base, size_t n, double *force,
                          wt_error *err) WT_NODISCARD;

/* Returns |E*| of a series. */
double hereditary_modulus(const wt_prony *series, double angular_frequency);

#endif
