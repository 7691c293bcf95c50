/* Physical constants and plausible ranges of quantities. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_BASE_QUANTITY_H
#define WT_CORE_BASE_QUANTITY_H

#include "weartrack/core.h"

/* Exact since the SI of 2019. */
#define GAS_CONSTANT 8.31446261815324 /* J/(mol K) */

/* Returns an example of a value as the user types it, such as "250nm". */
const char *quantity_example(wt_quantity quantity);
/* As wt_quantity_parse, wt_estimate_parse and wt_list_parse, with the example that a message shows;
 * NULL for that of the quantity. */
wt_status quantity_parse(const char *text, wt_quantity quantity, const char *example, double *value,
                         wt_error *err);
wt_status estimate_parse(const char *text, wt_quantity quantity, const char *example,
                         wt_estimate *estimate, wt_error *err);
wt_status list_parse(const char *text, wt_quantity quantity, const char *example, double **values,
                     size_t *n, wt_error *err);
/* Returns the largest plausible magnitude of a quantity. It is far above real values and far below
 * the overflow of a calculation. */
double quantity_plausible_maximum(wt_quantity quantity);
bool quantity_is_plausible(wt_quantity quantity, double value); /* false for NaN */
/* Creates the error WT_E_RANGE for a value that is not plausible. */
wt_status quantity_implausible_error(wt_quantity quantity, const char *found, wt_error *err);

#endif
