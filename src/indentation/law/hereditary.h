/* Internal to the library: rubber with memory. The force of a contact whose elastic force would be
 * E f(t) is the integral of E(t - t') df(t') with E(t) = rest + sum E_i exp(-t/tau_i) (Lee and
 * Radok); once the contact area shrinks, only what was pressed in before the same area was reached
 * on the way in remains (Ting).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_HEREDITARY_H
#define WT_INDENTATION_LAW_HEREDITARY_H

#include "weartrack/model.h"

/* A series as the steps of one motion see it. */
typedef struct hereditary {
    double rest;      /* with what does not relax within the motion */
    double viscosity; /* of what relaxes within a step, times the time */
    size_t n;         /* terms between the two */
    double *modulus, *time;
    double step;         /* what the next three are for */
    double *fade;        /* what a step leaves of a memory */
    double *gain, gains; /* what a change of 1 over a step adds to it, and to all of them */
    double *memory[3];   /* [n] each, for whoever goes along the motion */
    double *block;
    size_t capacity;
} hereditary;

/* An empty one is zero. Room for the terms of a series; WT_E_MEMORY. */
wt_status hereditary_reserve(hereditary *m, size_t terms, wt_error *err) WT_NODISCARD;
void hereditary_clear(hereditary *m);
/* Moduli times `scale`, for steps that are not shorter than one and a motion that is not longer
 * than the other. */
void hereditary_begin(hereditary *m, const wt_prony *series, double scale, double shortest,
                      double longest);
/* Prepares for steps of this length; quick where it is that of the step before. */
void hereditary_step(hereditary *m, double step);
/* Brings a memory [n] to the end of the step; returns what it holds then. */
double hereditary_fade(const hereditary *m, double *memory);
/* f changed by that much in the step, evenly. */
void hereditary_add(const hereditary *m, double *memory, double change);
/* Force at the end of a step in which f went from one value to another, `faded` from the memory. */
static inline double hereditary_force(const hereditary *m, double faded, double before, double f)
{
    return m->rest * f + faded + (m->gains + m->viscosity / m->step) * (f - before);
}

/* Forces of a tip at n times and positions of its base, which rises from contact, the first one, to
 * one maximum and falls again; compliance of the lever, 0: the base is the depth. WT_E_MEMORY. */
wt_status hereditary_loop(hereditary *law, const wt_contact_table *table, double compliance,
                          const double *time, const double *base, size_t n, double *force,
                          wt_error *err) WT_NODISCARD;

/* |E*| of a series. */
double hereditary_modulus(const wt_prony *series, double angular_frequency);

#endif
