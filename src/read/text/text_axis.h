/* Places along a line that are equal steps. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_AXIS_H
#define WT_READ_TEXT_AXIS_H

#include "weartrack/base.h"

typedef struct text_axis {
    double first, step; /* step > 0 */
    size_t n;
    double rounded; /* places are rounded to this; 0 if that plays no part */
} text_axis;

/* The axis of places that rise from one to the next, `factor` their unit. With `holes` places may
 * be left out of it. False: they are no equal steps, *worst the place that fits them least. */
bool axis_find(const double *places, size_t n, double factor, bool holes, text_axis *axis,
               size_t *worst);
/* Which of its places a place is; it must be one of those that made the axis. */
size_t axis_index(const text_axis *axis, double place);

#endif
