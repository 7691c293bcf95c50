/* The figures: what each needs and how it is drawn.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FIGURES_H
#define WT_REPORT_FIGURES_H

#include "report/drawing.h"

/* Fills sections, script and caption of a zeroed drawing; the tables it needs are there. Without
 * anything to draw it leaves no script and says why in `omitted`. */
typedef void (*wt_draw_fn)(wt_drawing *d);
wt_draw_fn wt_figure_draw(size_t i);

void wt_draw_force_displacement(wt_drawing *d);
void wt_draw_force_indentation(wt_drawing *d);
void wt_draw_modulus_groups(wt_drawing *d);
void wt_draw_modulus_map(wt_drawing *d);
void wt_draw_modulus_rate(wt_drawing *d);
void wt_draw_dma_comparison(wt_drawing *d);
void wt_draw_master_curve(wt_drawing *d);
void wt_draw_shift_factors(wt_drawing *d);
void wt_draw_power_spectrum(wt_drawing *d);
void wt_draw_friction(wt_drawing *d);
void wt_draw_contact_area(wt_drawing *d);
void wt_draw_friction_scales(wt_drawing *d);
void wt_draw_energy_density(wt_drawing *d);
void wt_draw_layer(wt_drawing *d);

#endif
