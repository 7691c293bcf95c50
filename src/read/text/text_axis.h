/* Declares axes of equal steps. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_AXIS_H
#define WT_READ_TEXT_AXIS_H

#include "weartrack/core.h"

typedef struct text_axis {
    double first, step; /* step > 0 */
    size_t n;
    double rounded; /* rounding of the positions; 0 if it has no effect */
} text_axis;

/* Finds the axis of increasing positions; `factor` is their unit. The last flag allows gaps.
 * Returns false if the steps are not equal; *worst is the position that deviates most. */
bool axis_find(const double *positions, size_t n, double factor, bool allows_gaps, text_axis *axis,
               size_t *worst);
/* Returns the index of a position, which must be one of those that define the axis. */
size_t axis_index(const text_axis *axis, double position);

#endif
