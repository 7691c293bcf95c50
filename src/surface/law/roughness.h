/* Internal interface: moments of a power spectrum.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_LAW_ROUGHNESS_H
#define WT_SURFACE_LAW_ROUGHNESS_H

#include "weartrack/surface.h"

/* Returns int_q0^q k^m C dk for m = 1 or 3 and q from q0 to q1 [rad/m]. */
double roughness_moment(const wt_roughness *roughness, int m, double q);

#endif
