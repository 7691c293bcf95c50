/* Figure of the modulus over the sample.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FIGURES_MAP_H
#define WT_REPORT_FIGURES_MAP_H

#include "report/drawing.h"

/* Of each group whose curves lie on a grid; else nothing, and no word of it. */
void draw_modulus_map(figure_drawing *d);

#endif
