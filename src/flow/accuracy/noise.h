/* Normal numbers that depend on their place alone. Internal to flow/accuracy.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_ACCURACY_NOISE_H
#define WEARTRACK_FLOW_ACCURACY_NOISE_H

#include "flow/job/draws.h"

static inline double accuracy_noise(uint64_t series, uint64_t i)
{
    return flow_draw_normal(series, i, FLOW_DRAW_PRESSURE);
}

#endif
