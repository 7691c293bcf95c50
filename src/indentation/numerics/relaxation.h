/* Means over approach, dwell and free part of the retract for the comparison with a model.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_NUMERICS_RELAXATION_H
#define WT_INDENTATION_NUMERICS_RELAXATION_H

#include "core/math/arena_gsl.h"
#include "weartrack/indentation.h"

/* Means in the order of time: baseline, contact of the approach, dwell, retract far from contact.
 * Times begin at the first sample. */
typedef struct dwell_nodes {
    size_t n, first_loading, first_dwell, first_free; /* first means of the parts */
    double *time, *position, *force;                  /* means */
    double *from, *to, *count;                        /* limits of the time, number of samples */
    gsl_matrix *factor; /* lower triangle: Cholesky factor of the covariance of the forces */
} dwell_nodes;

/* Computes the means. `stiffness` is dF/dz of cantilever and sample, by which motion of the height
 * causes noise in contact. Returns "" or the reason of a failure. */
const char *dwell_nodes_create(const wt_dwell_history *h, double stiffness, arena *memory,
                               dwell_nodes *nodes);

#endif
