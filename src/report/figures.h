/* The figures: what each needs and how it is drawn.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FIGURES_H
#define WT_REPORT_FIGURES_H

#include "report/drawing.h"

/* Fills sections, script and caption of a zeroed drawing; the tables it needs are there. Without
 * anything to draw it leaves no script and says why in `omitted`. */
typedef void (*draw_fn)(figure_drawing *d);
draw_fn figure_draw(size_t i);

void draw_force_displacement(figure_drawing *d);
void draw_force_indentation(figure_drawing *d);
void draw_modulus_groups(figure_drawing *d);
void draw_modulus_map(figure_drawing *d);
void draw_modulus_rate(figure_drawing *d);
void draw_dma_comparison(figure_drawing *d);
void draw_master_curve(figure_drawing *d);
void draw_shift_factors(figure_drawing *d);
void draw_power_spectrum(figure_drawing *d);
void draw_friction(figure_drawing *d);
void draw_contact_area(figure_drawing *d);
void draw_friction_scales(figure_drawing *d);
void draw_energy_density(figure_drawing *d);
void draw_layer(figure_drawing *d);

#endif
