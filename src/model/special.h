/* Inside the library: special functions for the rooms above.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_MODEL_SPECIAL_H
#define WT_MODEL_SPECIAL_H

/* psi(x) = d ln Gamma/dx for x > 0; NaN elsewhere. */
double digamma(double x);

#endif
