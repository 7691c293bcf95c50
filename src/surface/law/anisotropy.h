/* Orders of an anisotropic roughness: the power spectrum varies as cos(m (phi - angle)).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_SURFACE_LAW_ANISOTROPY_H
#define WT_SURFACE_LAW_ANISOTROPY_H

#include "weartrack/core.h"

#include <stddef.h>

/* Returns the angular order m of amplitude k: 2, 4, 6 or 8. */
static inline double anisotropy_order(size_t k)
{
    return 2 * (double)(k + 1);
}

#endif
