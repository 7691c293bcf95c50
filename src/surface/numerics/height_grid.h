/* Internal interface: statistics of the heights of a surface without their form.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_NUMERICS_HEIGHT_GRID_H
#define WT_SURFACE_NUMERICS_HEIGHT_GRID_H

#include "weartrack/surface.h"

void surface_height_statistics(const wt_height_map *map, wt_surface_heights *to);
/* Returns a wavenumber [rad/m]. Its wavelength is the shortest second difference that stays
 * below half the curvature of the tip. It is 0 if none does. radius [m]. */
double surface_tip_limit(const wt_height_map *map, double radius);

#endif
