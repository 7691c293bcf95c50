/* The shifts of ISO 18437-6, for comparison (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_SWEEPS_CLOSED_FORM_H
#define WEARTRACK_FIT_SWEEPS_CLOSED_FORM_H

#include "fit/sweeps/isotherm.h"

/* log10 a of every isotherm against the anchor; NaN where a neighbour on the way shares too little
 * of the storage modulus. log_a: [set->n]. */
void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a);

#endif
