/* The flash temperature of a sliding contact in words. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SLIDING_FLASH_H
#define WEARTRACK_FLOW_SLIDING_FLASH_H

#include "weartrack/flow.h"

/* What it is and where it has no solution or two; "" without one. */
void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256]);

#endif
