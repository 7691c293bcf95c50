/* Friction during the growth of a layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_H
#define STUDY_GROWTH_H

#include "contact.h"

#include <stdbool.h>

/* Number of thicknesses up to the steady state. */
enum { GROWTH_POINTS = 160 };
typedef struct growth_truth {
    double start, end;                                   /* friction; start: on bare rubber */
    double begins;                                       /* time before any layer [s]; 0: none */
    double time[GROWTH_POINTS], friction[GROWTH_POINTS]; /* values after it */
    double settled; /* time when 5 % of the largest change remain [s] */
} growth_truth;

/* Values at the first velocity. `ratio` is that of E and shear stress of layer and rubber. With
 * `transport` rubber is modified where damage reaches 1, else formation and wear have rates.
 * Returns false without a layer. */
bool growth_solve(const contact *c, const rubber_state *state, double ratio, bool transport,
                  growth_truth *truth);
double growth_friction(const growth_truth *truth, double time);

#endif
