/* Registry of all figures, in the order of the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure.h"

#include "weartrack/report.h"

const figure_description *figure_find(size_t i)
{
    static const figure_description *const lists[] = {
        figures_indentation, figures_curves,        figures_spot,    figures_surface,
        figures_materials,   figures_master,        figures_dma,     figures_payne,
        figures_friction,    figures_friction_maps, figures_record,  figures_validation,
        figures_layer,       figures_existence,     figures_what_if, figures_collection,
        figures_constants,   figures_accuracy};
    for (size_t list = 0; list < sizeof lists / sizeof *lists; list++)
        for (const figure_description *figure = lists[list]; figure->name != NULL; figure++)
            if (i-- == 0)
                return figure;
    return NULL;
}

size_t wt_figure_count(void)
{
    size_t n = 0;
    while (figure_find(n) != NULL)
        n++;
    return n;
}

wt_figure_info wt_figure_get(size_t i)
{
    const figure_description *figure = figure_find(i);
    return figure == NULL
               ? (wt_figure_info){NULL, NULL, NULL, NULL}
               : (wt_figure_info){figure->name, figure->title, figure->table->name,
                                  figure->other_tables != NULL ? figure->other_tables : ""};
}
