/* Figure of the model choices: the range of each number over each choice, with its standard
 * error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BARS = 16, TRIED = 256, PANELS = 3 };

/* Range of a number over a choice. */
typedef struct bar {
    const char *choice;
    char tried[TRIED];
    double low, high;
} bar;

typedef struct panel {
    what_if_column column;
    const char *label;
    wt_estimate used; /* with its standard error */
    bar bars[MOST_BARS];
    size_t n;
} panel;

static int compare_widths(const void *a, const void *b)
{
    const bar *p = a, *q = b;
    const double more = (p->high - p->low) - (q->high - q->low);
    return more > 0 ? 1 : more < 0 ? -1 : strcmp(q->choice, p->choice);
}

/* Appends "2e5; 2e7 rad/m": the unit appears once. */
static void append_tried(bar *b, const char *tried)
{
    size_t length = strlen(b->tried);
    const char *unit = strrchr(tried, ' ');
    const size_t of_unit = unit != NULL ? strlen(unit) : 0;
    if (of_unit > 0 && of_unit < length && strcmp(b->tried + length - of_unit, unit) == 0)
        length -= of_unit;
    (void)snprintf(b->tried + length, TRIED - length, "%s%s", length > 0 ? "; " : "", tried);
}

/* Collects the adjacent rows of each choice. A choice without an effect has no bar. The widest bar
 * comes last, at the top. */
static void fill_panel(panel *p, const table_view *table)
{
    for (size_t row = 1; row < table->n_rows; row++) {
        const char *choice = what_if_text(table, row, WHAT_IF_CHOICE);
        const double value = what_if_get(table, row, p->column);
        const bool same = p->n > 0 && strcmp(p->bars[p->n - 1].choice, choice) == 0;
        if (!isfinite(value) || (!same && p->n == MOST_BARS))
            continue;
        if (!same)
            p->bars[p->n++] = (bar){.choice = choice, .low = p->used.value, .high = p->used.value};
        bar *b = &p->bars[p->n - 1];
        b->low = fmin(b->low, value);
        b->high = fmax(b->high, value);
        append_tried(b, what_if_text(table, row, WHAT_IF_TRIED));
    }
    qsort(p->bars, p->n, sizeof *p->bars, compare_widths);
    size_t still = 0;
    while (still < p->n && !(p->bars[still].high > p->bars[still].low))
        still++;
    memmove(p->bars, p->bars + still, (p->n - still) * sizeof *p->bars);
    p->n -= still;
}

/* Finds the panels: friction, or its hysteresis part if friction is unknown, and the effects of the
 * layer. */
static size_t find_choice_panels(const figure_drawing *d, panel panels[PANELS])
{
    const table_view *friction = &d->tables->friction, *layer = &d->tables->layer;
    const bool total = isfinite(what_if_get(d->table, 0, WHAT_IF_FRICTION));
    const panel possible[PANELS] = {
        {.column = total ? WHAT_IF_FRICTION : WHAT_IF_HYSTERESIS,
         .label = total ? "Friction coefficient μ" : "Hysteresis friction coefficient",
         .used = friction_value(friction, total ? FRICTION_KEY_FRICTION : FRICTION_KEY_HYSTERESIS)},
        {.column = WHAT_IF_WITH_LAYER,
         .label = "Friction coefficient μ with layer",
         .used = friction_value(friction, FRICTION_KEY_WITH_LAYER)},
        {.column = WHAT_IF_THICKNESS,
         .label = "Layer thickness",
         .used = layer_value(layer, LAYER_KEY_BALANCE_THICKNESS)}};
    size_t n = 0;
    for (size_t i = 0; i < PANELS; i++) {
        panels[n] = possible[i];
        panels[n].used.value = what_if_get(d->table, 0, possible[i].column);
        if (isfinite(panels[n].used.value))
            fill_panel(&panels[n], d->table);
        n += panels[n].n > 0;
    }
    return n;
}

/* Adds two lines of text at a position of the y axis. The second may be empty. */
static void add_axis_name(figure_drawing *d, size_t place, const char *first, const char *second)
{
    text_add(&d->script, place > 0 ? ", " : "");
    text_tic_label(&d->script, first);
    text_format(&d->script, " %zu.2, ", place);
    text_tic_label(&d->script, second);
    text_format(&d->script, " %s", LITERAL((double)place - 0.2));
}

static int add_bar_section(figure_drawing *d, const panel *p, const char *title, double low,
                           double high)
{
    static const char *const columns[] = {"used", "low", "high", NULL};
    const char *unit = schema_unit(&d->table->schema->columns[p->column]);
    const char *const units[] = {unit, unit, unit, NULL};
    const double values[] = {p->used.value, low, high};
    return drawing_number_section(d, title, columns, units, values, 1);
}

static void draw_choice_panel(figure_drawing *d, const panel *p)
{
    const double two_sided = 1.959964 * p->used.standard_error;
    const bool chance = two_sided > 0 && isfinite(two_sided);
    value_span span = EMPTY_SPAN;
    span_add(&span, 0, false);
    span_add(&span, p->used.value, false);
    span_add(&span, p->used.value + (chance ? two_sided : 0), false);
    for (size_t i = 0; i < p->n; i++) {
        span_add(&span, p->bars[i].low, false);
        span_add(&span, p->bars[i].high, false);
    }
    axis_linear(d, "x", p->label, &d->table->schema->columns[p->column], span);
    text_format(&d->script, "set yrange [-0.6:%zu.6]\nset ytics (", p->n - 1 + chance);
    for (size_t i = 0; i < p->n; i++)
        add_axis_name(d, i, p->bars[i].choice, p->bars[i].tried);
    if (chance)
        add_axis_name(d, p->n, "errors that are known", "95 % interval");
    text_format(&d->script,
                ") noenhanced scale 0\nunset arrow\n"
                "set arrow from %s*x_unit, graph 0 to %s*x_unit, graph 1 nohead ls 12 back\n",
                LITERAL(p->used.value), LITERAL(p->used.value));
    for (size_t i = 0; i < p->n; i++)
        plot_item(d, add_bar_section(d, p, p->bars[i].choice, p->bars[i].low, p->bars[i].high),
                  "($1*x_unit):(%zu):($2*x_unit):($3*x_unit):(%zu-0.26):(%zu+0.26) with "
                  "boxxyerror ls 1",
                  i, i, i);
    if (chance)
        plot_item(d,
                  add_bar_section(d, p, "errors that are known", p->used.value - two_sided,
                                  p->used.value + two_sided),
                  "($1*x_unit):(%zu):($2*x_unit):($3*x_unit) with xerrorbars ls 13", p->n);
    plot_end(d);
}

/* Height relative to one panel of the style. */
static double panel_height(const panel *p)
{
    return 0.25 + 0.11 * (double)(p->n + 1);
}

static void draw_what_if(figure_drawing *d)
{
    panel *panels = wt_alloc(PANELS, sizeof *panels);
    const size_t n = find_choice_panels(d, panels);
    double margin = 26, top = 0; /* the margin is in character cells, which are wider than an
                                    average letter */
    d->height = 0;
    for (size_t i = 0; i < n; i++) {
        d->height += panel_height(&panels[i]);
        for (size_t k = 0; k < panels[i].n; k++)
            margin = fmax(margin, 2 + 0.83 * (double)strlen(panels[i].bars[k].tried));
    }
    d->width = 0.8 + 0.017 * margin;
    if (n > 0)
        text_format(&d->script, "set lmargin %s\nunset key\nset border 1\nset multiplot\n",
                    LITERAL(margin));
    for (size_t i = 0; i < n; i++) {
        const double height = panel_height(&panels[i]) / d->height;
        top += height;
        text_format(&d->script, "set size 1,%s\nset origin 0,%s\n", LITERAL(height),
                    LITERAL(1 - top));
        draw_choice_panel(d, &panels[i]);
    }
    if (n > 0)
        text_add(&d->script, "unset multiplot\n");
    free(panels);
}

const figure_description figures_what_if[] = {
    {.name = "what_if",
     .title = "What if a choice of the model were another",
     .table = &what_if_schema,
     .other_tables = "friction layer",
     .empty_reason = "no choice of the model moves a number",
     .caption_text =
         "How far each choice of the model moves the numbers at the reference velocity: a bar "
         "goes from the lowest to the highest one, with everything else as used (dashed "
         "line); below its name is what was tried. On top: the 95 % interval of the errors "
         "that are measured or stated.",
     .draw = draw_what_if},
    {.name = NULL},
};
