/* Writes the plot command of gnuplot.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

static void begin_plot_item(figure_drawing *d)
{
    text_add(&d->script, d->n_items++ == 0 ? "plot \\\n  " : ", \\\n  ");
}

void plot_item(figure_drawing *d, int section, const char *format, ...)
{
    if (section < 0)
        return;
    begin_plot_item(d);
    text_format(&d->script, "'%s.tsv' index %d using ", d->figure->name, section);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_expression(figure_drawing *d, const char *format, ...)
{
    begin_plot_item(d);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_title(figure_drawing *d, const char *title)
{
    text_add(&d->script, " title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced");
}

void plot_key(figure_drawing *d, const char *text)
{
    if (text == NULL)
        text_add(&d->script, " notitle");
    else
        text_format(&d->script, " title '%s'", text);
}

void plot_end(figure_drawing *d)
{
    text_add(&d->script, "\n");
    d->n_items = 0;
}

void plot_heading(figure_drawing *d, const char *title)
{
    text_add(&d->script, "set title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced\n");
}
