/* What can be said of any value of a quantity. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_QUANTITY_H
#define WT_CORE_BASE_QUANTITY_H

#include "weartrack/base.h"

/* Exact since 2019. */
#define GAS_CONSTANT 8.31446261815324  /* J/(mol K) */
#define BOLTZMANN 1.380649e-23         /* J/K */
#define ELECTRONVOLT 1.602176634e-19   /* J */
#define PLANCK 6.62607015e-34          /* J s */
#define REDUCED_PLANCK 1.054571817e-34 /* J s, the digits that CODATA 2018 prints */

/* As it is written: "250nm". */
const char *quantity_example(wt_quantity quantity);
/* No larger value, of either sign, is given to this program in earnest. It is far beyond what there
 * is, and far from where a calculation overflows. */
double quantity_most(wt_quantity quantity);
bool quantity_is_possible(wt_quantity quantity, double value); /* false for NaN */
/* The error of one that is not: WT_E_RANGE. */
wt_status quantity_impossible(wt_quantity quantity, const char *found, wt_error *err);

#endif
