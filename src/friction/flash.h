/* The flash temperature of a sliding contact in words. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_FLASH_H
#define WT_FRICTION_FLASH_H

#include "weartrack/flow.h"

/* What it is and where it has no solution or two; "" without one. */
void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256]);

#endif
