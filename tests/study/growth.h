/* Friction while a layer grows. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_H
#define STUDY_GROWTH_H

#include "contact.h"

#include <stdbool.h>

/* Thicknesses that are followed, towards the balance. */
enum { GROWTH_POINTS = 160 };
typedef struct growth_truth {
    double start, end;                                   /* friction; start: of the bare rubber */
    double begins;                                       /* time before any layer [s]; 0: none */
    double time[GROWTH_POINTS], friction[GROWTH_POINTS]; /* behind it */
    double settled; /* when 5 % of the largest change that is left at any time are left [s] */
} growth_truth;

/* At the first velocity. `ratio`: E, and shear stress, of the layer over those of the rubber.
 * `transport`: what is modified is where damage has come to 1, else formation against wear by their
 * rates. False if there is no layer. */
bool growth_solve(const contact *c, const rubber_state *state, double ratio, bool transport,
                  growth_truth *truth);
double growth_friction(const growth_truth *truth, double time);

#endif
