/* Standard errors at many velocities: from those at some of them. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_ERROR_INTERPOLATION_H
#define WT_FRICTION_ERROR_INTERPOLATION_H

#include "weartrack/base.h"

/* Up to this many velocities the replicates are computed at each; of more, at as many that lie
 * evenly in ln v. Over 20 decades their distance h is 0.05: a line between two is off by h^2/8, or
 * 3e-4, of an error that changes e-fold with v, while that of 200 replicates is known to 5e-2. */
enum { ERROR_NODES = 1000 };

/* Velocities v [n], which rise but for the last, the reference: *nodes [*m] to compute the
 * replicates at, the reference the last; NULL if these are v itself. */
wt_status error_nodes_make(const double *v, size_t n, double **nodes, size_t *m,
                           wt_error *err) WT_NODISCARD;
/* error [n] at v from at_nodes [m]: by lines in ln v, the last as it is. */
void error_nodes_spread(const double *nodes, size_t m, const double *at_nodes, const double *v,
                        size_t n, double *error);

#endif
