/* Figures of the modified layer: energy with depth, thickness in time.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>

void draw_energy_density(figure_drawing *d)
{
    static const char *const columns[] = {"depth", "energy_density", NULL};
    const wt_table *table = wt_result_find(d->result, "energy_density");
    int section = drawing_section(d, table, "energy density", NULL, columns, 2, true);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], true);
    span_add_section(&y, d, section, columns[1], true);
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no energy density above zero");
        return;
    }
    long column = number_column(table, "energy_density");
    axis_log(d, "x", "Depth below the surface", "m", x);
    axis_log(d, "y", "Dissipated power per volume", wt_table_column_unit(table, (size_t)column), y);
    text_add(&d->script, "unset key\n");
    plot_begin(d);
    plot_item(d, section, "($1*x_unit):($2*y_unit) with lines ls 21");
    plot_end(d);
    text_add(&d->caption, "Power per volume that sliding dissipates in the rubber, with depth.");
}

typedef struct layer_marks {
    wt_estimate balance;
    bool has_balance;
    double incubation, relaxation; /* [s], NaN if unknown */
} layer_marks;

static double positive_key(const wt_table *table, const char *key)
{
    double value;
    return key_number(table, key, &value) && value > 0 ? value : (double)NAN;
}

/* Whether the curve itself shows the incubation: without it in the model the layer grows from the
 * beginning, and a mark would contradict the curve. */
static bool shows_incubation(const wt_table *table, double incubation)
{
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        if (cell_number(table, row, "time") < incubation &&
            cell_number(table, row, "thickness") > 0)
            return false;
    return true;
}

static layer_marks read_marks(const wt_table *table)
{
    layer_marks marks = {.incubation = positive_key(table, "incubation_time"),
                         .relaxation = positive_key(table, "relaxation_time")};
    if (!shows_incubation(table, marks.incubation))
        marks.incubation = (double)NAN;
    marks.has_balance = wt_table_estimate(table, "balance_thickness", &marks.balance) &&
                        isfinite(marks.balance.value) && marks.balance.value > 0;
    return marks;
}

/* A vertical line at a time, named at `place` of the height. */
static void mark_time(figure_drawing *d, double time, const value_span *x, const char *label,
                      double place)
{
    if (!(time >= x->low && time <= x->high))
        return;
    text_add(&d->script, "set arrow from ");
    text_literal(&d->script, time);
    text_add(&d->script, "*x_unit, graph 0 to ");
    text_literal(&d->script, time);
    text_add(&d->script, "*x_unit, graph 1 nohead ls 12 back\n");
    if (label == NULL)
        return;
    text_format(&d->script, "set label '%s' at ", label);
    text_literal(&d->script, time);
    text_add(&d->script, "*x_unit, graph ");
    text_literal(&d->script, place);
    text_add(&d->script, " offset 0.6,0 left front\n");
}

/* Thickness and rates share the axis of time, one above the other. */
void draw_layer(figure_drawing *d)
{
    static const char *const columns[] = {"time",           "thickness", "thickness_standard_error",
                                          "formation_rate", "wear_rate", NULL};
    const wt_table *table = wt_result_find(d->result, "layer");
    int section = drawing_section(d, table, "layer", NULL, columns, 1, true);
    value_span x = SPAN_EMPTY, thickness = SPAN_EMPTY, rate = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], true);
    span_add_section(&thickness, d, section, columns[1], true);
    span_add_section(&rate, d, section, columns[3], true);
    span_add_section(&rate, d, section, columns[4], true);
    if (span_empty(&x) || (span_empty(&thickness) && span_empty(&rate)) || d->status != WT_OK) {
        text_add(&d->omitted, "no layer forms: no thickness above zero to draw on a logarithmic "
                              "axis");
        return;
    }
    layer_marks marks = read_marks(table);
    bool both = !span_empty(&thickness) && !span_empty(&rate);
    d->height = both ? 1.5 : 1;
    axis_log(d, "x", "Sliding time in contact", "s", x);
    if (both)
        text_add(&d->script, "set multiplot layout 2,1\n");
    if (!span_empty(&thickness)) {
        if (marks.has_balance)
            span_add(&thickness, marks.balance.value, true);
        axis_log(d, "y", "Layer thickness", "m", thickness);
        mark_time(d, marks.incubation, &x, "incubation", 0.75);
        mark_time(d, marks.relaxation, &x, "relaxation", 0.1);
        if (marks.has_balance) {
            text_add(&d->script, "balance = ");
            text_literal(&d->script, marks.balance.value);
            text_add(&d->script, "  # m\n");
        }
        plot_begin(d);
        plot_item(d, section,
                  "($1*x_unit):($2 > 0 ? ($2 > $3 ? $2-$3 : 1e-3*$2)*y_unit : NaN):"
                  "($2 > 0 ? ($2+$3)*y_unit : NaN) with filledcurves ls 71 notitle");
        if (marks.has_balance)
            plot_other(d, "balance*y_unit with lines ls 15 title 'balance'");
        plot_item(d, section,
                  "($1*x_unit):($2 > 0 ? $2*y_unit : NaN) with lines ls 21 title 'thickness'");
        plot_end(d);
    }
    if (!span_empty(&rate)) {
        text_add(&d->script, "unset arrow\nunset label\n");
        axis_log(d, "y", "Rate", "m/s", rate);
        mark_time(d, marks.incubation, &x, NULL, 0);
        mark_time(d, marks.relaxation, &x, NULL, 0);
        plot_begin(d);
        plot_item(d, section,
                  "($1*x_unit):($4 > 0 ? $4*y_unit : NaN) with lines ls 22 title "
                  "'formation'");
        plot_item(d, section,
                  "($1*x_unit):($5 > 0 ? $5*y_unit : NaN) with lines ls 23 title 'wear'");
        plot_end(d);
    }
    if (both)
        text_add(&d->script, "unset multiplot\n");

    text_add(&d->caption, "Thickness of the modified layer in time (band: one standard error) "
                          "and the rates of formation and wear that make it; balance is where "
                          "the two rates meet.");
    if (marks.has_balance) {
        text_add(&d->caption, " Balance thickness ");
        caption_estimate(d, &marks.balance, "");
        text_add(&d->caption, ".");
    }
    if (isfinite(marks.incubation)) {
        text_add(&d->caption, " Incubation time ");
        caption_value(d, marks.incubation, "s", "");
        text_add(&d->caption, ".");
    }
    if (isfinite(marks.relaxation)) {
        text_add(&d->caption, " Relaxation time ");
        caption_value(d, marks.relaxation, "s", "");
        text_add(&d->caption, ".");
    }
}
