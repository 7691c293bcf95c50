/* Interpolation of standard errors from a subset of the velocities to all of them. Internal to
 * friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_ERROR_INTERPOLATION_H
#define WT_FRICTION_ERROR_INTERPOLATION_H

#include "weartrack/core.h"

/* Up to this number of velocities, the replicates are computed at each. A longer list uses this
 * number of nodes, equally spaced in ln v. Over 20 decades the spacing h is 0.05. Linear
 * interpolation then has the error h^2/8, or 3e-4, if the standard error changes e-fold with v. The
 * standard error of 200 replicates has an uncertainty of 5e-2. */
enum { ERROR_NODES = 1000 };

/* Creates the nodes for the replicates. The velocities v [n] rise, except the last, which is the
 * reference. The nodes [*m] end with the reference; the caller frees them. NULL means that the
 * nodes are v. */
double *error_nodes_create(const double *v, size_t n, size_t *m);
/* Interpolates the errors from at_nodes [m] to error [n] at v, linearly in ln v. The last value is
 * copied. */
void error_nodes_interpolate(const double *nodes, size_t m, const double *at_nodes, const double *v,
                             size_t n, double *error);

#endif
