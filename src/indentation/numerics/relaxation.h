/* Inside the fit room: the means over which approach, dwell and what is free of the retract are
 * compared with their model.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_NUMERICS_RELAXATION_H
#define WT_INDENTATION_NUMERICS_RELAXATION_H

#include "core/math/arena_gsl.h"
#include "weartrack/fit.h"

/* In the order of time: the baseline, the contact of the approach, the dwell, the retract far from
 * contact. Times are from the first sample. */
typedef struct dwell_nodes {
    size_t n, first_pressed, first_held, first_free; /* where the parts begin */
    double *time, *position, *force;                 /* means */
    double *from, *to, *count;                       /* ends of the time, samples */
    gsl_matrix *factor; /* lower triangle: of the covariance of the forces, by Cholesky */
} dwell_nodes;

/* stiffness: dF/dz of the lever on the sample, of which what moves the height makes a noise in
 * contact. "", or why there are none; whether there was memory, the pool tells. */
const char *dwell_nodes_make(const wt_dwell_history *h, double stiffness, arena *memory,
                             dwell_nodes *nodes);

#endif
