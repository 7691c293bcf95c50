/* Text that describes the flash temperature of a sliding contact. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_FLASH_H
#define WT_FRICTION_FLASH_H

#include "weartrack/friction.h"

/* Writes the model, and the velocities with no solution or with two. The text is "" without a flash
 * temperature. */
void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256]);

#endif
