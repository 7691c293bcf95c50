/* Inside the fit room: what the heights of a surface are, less their form.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_NUMERICS_HEIGHT_GRID_H
#define WT_SURFACE_NUMERICS_HEIGHT_GRID_H

#include "weartrack/fit.h"

void surface_heights_find(const wt_height_map *map, wt_surface_heights *to);
/* The wavenumber [rad/m] whose wave is as long as the shortest second difference that stays below
 * half the curvature of the tip; 0 if none does. */
double surface_tip_limit(const wt_height_map *map, double radius);

#endif
