/* Registry of all figures, in the order of the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure.h"

#include "core/base/array.h"
#include "weartrack/report.h"

typedef struct figure_list {
    const figure_description *figures; /* ends with a row without a name */
    page_section section;
} figure_list;

static const figure_list lists[] = {{figures_indentation, SECTION_INDENTATION},
                                    {figures_surface, SECTION_SURFACE},
                                    {figures_master, SECTION_MATERIAL},
                                    {figures_dma, SECTION_INDENTATION},
                                    {figures_payne, SECTION_MATERIAL},
                                    {figures_friction, SECTION_FRICTION},
                                    {figures_record, SECTION_FRICTION},
                                    {figures_validation, SECTION_FRICTION},
                                    {figures_layer, SECTION_LAYER},
                                    {figures_constants, SECTION_LAYER},
                                    {figures_what_if, SECTION_UNCERTAINTY},
                                    {figures_collection, SECTION_COLLECTION},
                                    {figures_accuracy, SECTION_UNCERTAINTY}};

/* Returns the figure, and the list that has it. */
static const figure_description *find_in_lists(size_t i, const figure_list **list)
{
    for (*list = lists; *list < lists + COUNT_OF(lists); ++*list)
        for (const figure_description *figure = (*list)->figures; figure->name != NULL; figure++)
            if (i-- == 0)
                return figure;
    return NULL;
}

const figure_description *figure_find(size_t i)
{
    const figure_list *list;
    return find_in_lists(i, &list);
}

page_section figure_section(size_t i)
{
    const figure_list *list;
    return find_in_lists(i, &list) != NULL ? list->section : PAGE_SECTIONS;
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
