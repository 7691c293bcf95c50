/* The figures this library knows, in the order of the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

typedef struct figure {
    wt_figure_info info;
    draw_fn draw;
} figure;

#define NEEDS(...)                                                                                 \
    (const char *const[])                                                                          \
    {                                                                                              \
        __VA_ARGS__, NULL                                                                          \
    }

static const figure figures[] = {
    {{"force_displacement", "Force against displacement", NEEDS("force_displacement")},
     draw_force_displacement},
    {{"force_indentation", "Force against indentation", NEEDS("force_indentation")},
     draw_force_indentation},
    {{"modulus_groups", "Modulus in and beside the wear track", NEEDS("modulus_groups")},
     draw_modulus_groups},
    {{"modulus_map", "Map of the modulus", NEEDS("modulus_groups")}, draw_modulus_map},
    {{"modulus_rate", "Modulus against indentation rate", NEEDS("modulus_rate")},
     draw_modulus_rate},
    {{"dma_comparison", "Indentation against DMA", NEEDS("dma_comparison")}, draw_dma_comparison},
    {{"master_curve", "Master curve", NEEDS("master_curve")}, draw_master_curve},
    {{"shift_factors", "Shift factors", NEEDS("shift_factors")}, draw_shift_factors},
    {{"power_spectrum", "Power spectrum of the counter surface", NEEDS("roughness")},
     draw_power_spectrum},
    {{"friction", "Friction against sliding velocity", NEEDS("friction")}, draw_friction},
    {{"contact_area", "Real contact area against magnification", NEEDS("contact_area")},
     draw_contact_area},
    {{"friction_scales", "Which length scales make the friction", NEEDS("contact_area")},
     draw_friction_scales},
    {{"energy_density", "Dissipated energy with depth", NEEDS("energy_density")},
     draw_energy_density},
    {{"layer", "Thickness of the modified layer", NEEDS("layer")}, draw_layer},
};

size_t wt_figure_count(void)
{
    return sizeof figures / sizeof figures[0];
}

const wt_figure_info *wt_figure_get(size_t i)
{
    return i < wt_figure_count() ? &figures[i].info : NULL;
}

draw_fn figure_draw(size_t i)
{
    return i < wt_figure_count() ? figures[i].draw : NULL;
}
