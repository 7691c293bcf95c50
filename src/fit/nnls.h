/* Non-negative linear least squares (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_NNLS_H
#define WT_FIT_NNLS_H

#include "weartrack/base.h"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

/* x >= 0 with |A x - b| smallest. A: rows >= columns; both A and b are overwritten. Columns are
 * scaled to unit norm inside, so they may differ by many orders; a column of zeros gets x = 0.
 * Lawson and Hanson, Solving Least Squares Problems (1974), chapter 23. */
wt_status nnls(gsl_matrix *a, gsl_vector *b, double *x, wt_error *err) WT_NODISCARD;

#endif
