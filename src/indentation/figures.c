/* Figures of the indentation: the force curves, and the moduli by group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/curve_panel.h"
#include "report/drawing.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest number of points in one panel; more are not distinguishable. */
enum { LINE_POINTS = 1200, MARKER_POINTS = 220, CROWD_POINTS = 3000 };

/* ---- force against displacement, a panel for each group -------------------------------------- */

/* Returns the table with the keys of group i. */
static table_view group_keys(const figure_drawing *d, size_t i)
{
    table_view keys = *d->table;
    keys.suffix = d->groups[i];
    return keys;
}

static int segment_section(figure_drawing *d, size_t i, const char *segment)
{
    const row_filter rows = {
        {FORCE_DISPLACEMENT_GROUP, FORCE_DISPLACEMENT_SEGMENT}, {d->groups[i], segment}, NULL};
    int section =
        drawing_section(d, d->table, segment, &rows, d->columns, d->n_columns, d->n_columns);
    span_add_section(&d->x, d, section, 0, false);
    span_add_section(&d->y[0], d, section, 1, false);
    return section;
}

static int contact_section(figure_drawing *d, size_t i)
{
    static const char *const columns[] = {"contact_point", "contact_point_standard_error",
                                          "contact_force", NULL};
    static const char *const units[] = {"m", "m", "N", NULL};
    const table_view keys = group_keys(d, i);
    const wt_estimate contact =
        force_displacement_value(&keys, FORCE_DISPLACEMENT_KEY_CONTACT_POINT);
    const double force =
        force_displacement_value(&keys, FORCE_DISPLACEMENT_KEY_CONTACT_FORCE).value;
    const double values[] = {contact.value, contact.standard_error, force};
    return isfinite(contact.value) && isfinite(force)
               ? drawing_number_section(d, "contact point", columns, units, values, 1)
               : NO_SECTION;
}

static void plot_force(figure_drawing *d, int section, int style, const char *title)
{
    plot_item(d, section,
              "(($1-contact_point)*x_unit):($2*y_unit) every %zu with lines ls %d title '%s'",
              drawing_stride(d, section, LINE_POINTS), style, title);
}

static void draw_force_displacement(figure_drawing *d)
{
    int retract[DRAWING_GROUPS], contact[DRAWING_GROUPS];
    size_t n = 0;

    for (size_t i = 0; i < d->n_groups; i++) {
        d->data[i] = segment_section(d, i, "approach");
        retract[i] = segment_section(d, i, "retract");
        contact[i] = d->data[i] < 0 && retract[i] < 0 ? NO_SECTION : contact_section(d, i);
        n += d->data[i] >= 0 || retract[i] >= 0;
    }
    if (n == 0 || d->status != WT_OK)
        return;
    const size_t columns = drawing_panels(d, n, n, n == 1 ? 1 : 0.85, 0.9);
    drawing_axes(d);
    text_format(&d->script, "set multiplot layout %zu,%zu\n", n / columns, columns);
    for (size_t i = 0; i < d->n_groups; i++) {
        int style = drawing_group_style(d, i);
        if (d->data[i] < 0 && retract[i] < 0)
            continue;
        text_add(&d->script, "contact_point = 0  # m; the axis counts from it\n");
        plot_heading(d, d->groups[i]);
        text_add(&d->script, "unset arrow\n"
                             "set arrow from 0, graph 0 to 0, graph 1 nohead ls 12 back\n");
        plot_force(d, d->data[i], style, "approach");
        plot_force(d, retract[i], style + 30, "retract");
        plot_item(d, contact[i],
                  "(($1-contact_point)*x_unit):($3*y_unit):(" HALF_95
                  "*$2*x_unit) with xerrorbars ls 13 title "
                  "'contact'");
        plot_end(d);
    }
    text_add(&d->script, "unset multiplot\n");
}

static void caption_force_displacement(figure_drawing *d)
{
    for (size_t i = 0; i < d->n_groups; i++) {
        const table_view keys = group_keys(d, i);
        const char *curve = force_displacement_key_text(&keys, FORCE_DISPLACEMENT_KEY_CURVE);
        const double error =
            force_displacement_value(&keys, FORCE_DISPLACEMENT_KEY_CONTACT_POINT).standard_error;
        if (curve != NULL && error > 0)
            text_format(&d->caption, " %s: %s, contact point ± %s (95 %%).", d->groups[i], curve,
                        VALUE(WT_Q_LENGTH, NULL, NORMAL_95 * error));
        else if (curve != NULL)
            text_format(&d->caption, " %s: %s.", d->groups[i], curve);
    }
    text_add(&d->caption, " The vertical line is the fitted contact point; its horizontal bar is "
                          "its 95 % interval.");
    size_t every = drawing_max_stride(d, LINE_POINTS);
    if (every > 1)
        text_format(&d->caption, " One sample of %zu is drawn.", every);
}

/* ---- force against indentation --------------------------------------------------------------- */

static void caption_force_indentation(figure_drawing *d)
{
    value_span fit = EMPTY_SPAN;
    span_add_column(&fit, d->table, FORCE_INDENTATION_FITTED_FORCE, false);
    if (!span_is_empty(&fit))
        text_add(&d->caption, " Lines: contact model with the fitted modulus.");
    size_t every = drawing_max_stride(d, MARKER_POINTS);
    if (every > 1)
        text_format(&d->caption, " One sample of up to %zu is drawn.", every);
}

/* ---- modulus by group ------------------------------------------------------------------------ */

static wt_curve_verdict row_verdict(const table_view *table, size_t row)
{
    return (wt_curve_verdict)indentation_enum(table, row, INDENTATION_VERDICT);
}

static bool is_accepted_row(const table_view *table, size_t row)
{
    return row_verdict(table, row) == WT_CURVE_ACCEPTED;
}

/* Curves with a modulus that is wide or doubtful. */
static bool is_limited_row(const table_view *table, size_t row)
{
    return !is_accepted_row(table, row) && wt_curve_verdict_is_usable(row_verdict(table, row));
}

static bool is_rejected_row(const table_view *table, size_t row)
{
    return !wt_curve_verdict_is_usable(row_verdict(table, row));
}

/* Draws the accepted curves of each group next to its mean. */
static void draw_modulus_groups(figure_drawing *d)
{
    static const unsigned curve_columns[] = {INDENTATION_MODULUS,
                                             INDENTATION_MODULUS_STANDARD_ERROR};
    static const row_filter accepted = {.accepts = is_accepted_row},
                            limited = {.accepts = is_limited_row};
    const size_t n = d->n_groups;
    int mean[DRAWING_GROUPS], open[DRAWING_GROUPS];

    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{d->figure->group}, {d->groups[i]}, NULL};
        const table_view *curves = figure_tables_indentation(d->tables, d->groups[i]);
        d->data[i] = curves == NULL
                         ? NO_SECTION
                         : drawing_section(d, curves, d->groups[i], &accepted, curve_columns, 2, 1);
        open[i] = curves == NULL ? NO_SECTION
                                 : drawing_section(d, curves, "wide or doubtful", &limited,
                                                   curve_columns, 2, 1);
        span_add_section(&d->y[0], d, open[i], 0, true);
        mean[i] = drawing_section(d, d->table, d->groups[i], &rows, d->columns, d->n_columns, 1);
        span_add_section(&d->y[0], d, d->data[i], 0, true);
        for (size_t k = 0; k < d->n_columns; k++)
            span_add_section(&d->y[0], d, mean[i], k, true);
    }
    if (span_is_empty(&d->y[0]) || d->status != WT_OK)
        return;
    d->width = n <= 2 ? 0.8 : 1;
    drawing_axis(d, AXIS_Y, &d->figure->y[0], NULL, d->y[0]);
    text_format(&d->script, "set xrange [0.5:%zu.6]\nset xtics (", n);
    for (size_t i = 0; i < n; i++) {
        text_buffer label = {0};
        size_t row = 0; /* of the group */
        while (row + 1 < d->table->n_rows &&
               strcmp(modulus_groups_text(d->table, row, MODULUS_GROUPS_GROUP), d->groups[i]) != 0)
            row++;
        text_format(&label, "%s (n = %.0f)", d->groups[i],
                    modulus_groups_get(d->table, row, MODULUS_GROUPS_N));
        text_add(&d->script, i == 0 ? "" : ", ");
        text_tic_label(&d->script, text_string(&label));
        text_format(&d->script, " %zu", i + 1);
        text_free(&label);
    }
    text_add(&d->script,
             ") noenhanced scale 0\nunset key\n"
             "# Spread sideways by the golden section, so that it is the same every time.\n"
             "spread(i) = 0.36*((i+1)*0.6180339887 - floor((i+1)*0.6180339887) - 0.5)\n");
    for (size_t i = 0; i < n; i++) {
        plot_item(d, d->data[i],
                  "(%zu + spread($0)):($1*y_unit) every %zu with points ls %d ps 0.6", i + 1,
                  drawing_stride(d, d->data[i], CROWD_POINTS), drawing_group_style(d, i) + 40);
        plot_item(d, open[i],
                  "(%zu + spread($0)):($1*y_unit) every %zu with points ls %d pt 6 ps 0.6", i + 1,
                  drawing_stride(d, open[i], CROWD_POINTS), drawing_group_style(d, i) + 40);
        plot_item(d, mean[i], "(%zu.32):($1*y_unit):($2*y_unit):($3*y_unit) with yerrorbars ls 13",
                  i + 1);
    }
    plot_end(d);
}

static void caption_modulus_groups(figure_drawing *d)
{
    size_t every = drawing_max_stride(d, CROWD_POINTS);
    if (every > 1)
        text_format(&d->caption, " One curve of up to %zu is drawn.", every);
    const char *unit = comparison_key_text(&d->tables->comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    if (unit != NULL)
        text_format(&d->caption, " Unit of analysis of the interval: %s.", unit);
    for (size_t row = 0; row < d->table->n_rows; row++) {
        double all = modulus_groups_get(d->table, row, MODULUS_GROUPS_N),
               out = modulus_groups_get(d->table, row, MODULUS_GROUPS_N_REJECTED);
        if (isfinite(all) && isfinite(out))
            text_format(&d->caption, " %s: n = %.0f, rejected %.0f.",
                        modulus_groups_text(d->table, row, MODULUS_GROUPS_GROUP), all, out);
    }
}

/* ---- modulus against rate -------------------------------------------------------------------- */

static void caption_modulus_rate(figure_drawing *d)
{
    for (size_t i = 0; i < d->n_groups; i++) {
        bool first = true;
        text_format(&d->caption, "%s %s n = ", i == 0 ? "" : ";", d->groups[i]);
        for (size_t row = 0; row < d->table->n_rows; row++) {
            if (strcmp(modulus_rate_text(d->table, row, MODULUS_RATE_GROUP), d->groups[i]) != 0)
                continue;
            text_format(&d->caption, "%s%s", first ? "" : ", ",
                        SHORT_NUMBER(modulus_rate_get(d->table, row, MODULUS_RATE_N), 9));
            first = false;
        }
    }
    text_add(&d->caption, ".");
}

/* ---- modulus over the sample ----------------------------------------------------------------- */

enum { MAP_POINTS = 9, MAP_LIMIT = 70000 }; /* smallest and largest number of curves of a map */

/* Returns the smallest distance between two different positions, or 0 if there are none. Positions
 * closer than a thousandth of the range are equal. */
static double grid_step(const table_view *table, unsigned column)
{
    size_t n = table->n_rows;
    double *x = wt_alloc(n, sizeof *x), step = 0;
    for (size_t row = 0; row < n; row++)
        x[row] = view_number(table, table->schema, row, column);
    numbers_sort(x, n);
    for (size_t i = 1; i < n; i++) {
        double gap = x[i] - x[i - 1];
        if (gap > 1e-3 * (x[n - 1] - x[0]) && (step == 0 || gap < step))
            step = gap;
    }
    free(x);
    return step;
}

typedef struct map_panel {
    const char *group;
    const table_view *table;
    int accepted, limited, rejected;
    double step_x, step_y;
} map_panel;

/* True if all positions are known and come from one file. Several files need not share an origin.
 */
static bool has_map_positions(map_panel *panel)
{
    const table_view *table = panel->table;
    if (table == NULL || table->n_rows < MAP_POINTS || table->n_rows > MAP_LIMIT)
        return false;
    const char *file = indentation_text(table, 0, INDENTATION_FILE);
    for (size_t row = 0; row < table->n_rows; row++)
        if (!isfinite(indentation_get(table, row, INDENTATION_X)) ||
            !isfinite(indentation_get(table, row, INDENTATION_Y)) ||
            strcmp(indentation_text(table, row, INDENTATION_FILE), file) != 0)
            return false;
    panel->step_x = grid_step(table, INDENTATION_X);
    panel->step_y = grid_step(table, INDENTATION_Y);
    return table->column[INDENTATION_FILE] >= 0 && panel->step_x > 0 && panel->step_y > 0;
}

static void map_axis(figure_drawing *d, drawing_axis_id id, const map_panel *panel,
                     indentation_column column, double step)
{
    value_span span = EMPTY_SPAN;
    span_add_column(&span, panel->table, column, false);
    span = (value_span){span.low - step / 2, span.high + step / 2};
    axis_linear(d, id, id == AXIS_X ? "x" : "y", &indentation_schema.columns[column], span);
}

static void draw_modulus_panel(figure_drawing *d, const map_panel *panel)
{
    map_axis(d, AXIS_X, panel, INDENTATION_X, panel->step_x);
    map_axis(d, AXIS_Y, panel, INDENTATION_Y, panel->step_y);
    text_format(&d->script, "half_x = %s; half_y = %s  # m\n", LITERAL(panel->step_x / 2),
                LITERAL(panel->step_y / 2));
    plot_heading(d, panel->group);
    plot_item(d, panel->accepted,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_item(d, panel->limited,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_item(d, panel->limited, "($1*x_unit):($2*y_unit) with points ls 16 pt 6 notitle");
    plot_item(d, panel->limited, "($1*x_unit):($2*y_unit) with points ls 14 pt 6 notitle");
    plot_item(d, panel->rejected, "($1*x_unit):($2*y_unit) with points ls 14 pt 2 notitle");
    plot_end(d);
}

static void draw_modulus_map(figure_drawing *d)
{
    static const unsigned columns[] = {INDENTATION_X, INDENTATION_Y, INDENTATION_MODULUS};
    static const row_filter accepted = {.accepts = is_accepted_row},
                            limited = {.accepts = is_limited_row},
                            rejected = {.accepts = is_rejected_row};
    map_panel panels[DRAWING_GROUPS];
    size_t n = 0;
    value_span colour = EMPTY_SPAN;

    for (size_t i = 0; i < d->n_groups && d->status == WT_OK; i++) {
        map_panel panel = {.group = d->groups[i],
                           .table = figure_tables_indentation(d->tables, d->groups[i])};
        if (!has_map_positions(&panel))
            continue;
        panel.accepted = drawing_section(d, panel.table, panel.group, &accepted, columns, 3, 3);
        panel.limited =
            drawing_section(d, panel.table, "wide or doubtful", &limited, columns, 3, 3);
        panel.rejected = drawing_section(d, panel.table, "rejected", &rejected, columns, 3, 2);
        span_add_section(&colour, d, panel.accepted, 2, true);
        span_add_section(&colour, d, panel.limited, 2, true);
        if (panel.accepted >= 0 || panel.limited >= 0)
            panels[n++] = panel;
    }
    if (n == 0 || span_is_empty(&colour) || d->status != WT_OK)
        return;
    const size_t across = drawing_panels(d, n, n, 0.95, 1);
    axis_log(d, AXIS_COLOUR, "Modulus", &indentation_schema.columns[INDENTATION_MODULUS], colour);
    text_format(
        &d->script,
        "set size ratio -1\nset border 15\nset cblabel offset 1,0\nset multiplot layout %zu,%zu\n",
        n / across, across);
    for (size_t i = 0; i < n; i++)
        draw_modulus_panel(d, &panels[i]);
    text_add(&d->script, "unset multiplot\n");
}

/* ---- force curves ---------------------------------------------------------------------------- */

/* Largest number of curves on one sheet; weartrack view shows the rest. */
enum { SHEET_CURVES = 12, STACKED_CURVES = 4, SHEET_COLUMNS = 3 };

/* Returns the largest number of title lines in one row of panels. */
static size_t max_title_lines(const figure_drawing *d, const curve_list *list, size_t first,
                              size_t n)
{
    size_t most = 0;
    for (size_t i = first; i < first + n && i < list->n; i++) {
        const size_t lines = curve_panel_line_count(d, &list->curves[i]);
        most = lines > most ? lines : most;
    }
    return most;
}

static void draw_sheet(figure_drawing *d, const curve_list *list)
{
    const size_t most = d->stacked ? STACKED_CURVES : SHEET_CURVES,
                 n = list->n < most ? list->n : most,
                 columns = drawing_panels(d, n, SHEET_COLUMNS, 0.75, 0.85);
    text_format(&d->script, "set lmargin 9\nset rmargin 2\nset multiplot layout %zu,%zu\n",
                (n + columns - 1) / columns, columns);
    for (size_t i = 0; i < n; i++) {
        if (i % columns == 0)
            text_format(&d->script, "set tmargin %zu\n", max_title_lines(d, list, i, columns) + 1);
        draw_curve_panel(d, &list->curves[i]);
    }
    text_add(&d->script, "unset multiplot\n");
    text_format(&d->caption, " %s %zu of %zu curves.", curve_panel_legend, n, list->n_rows);
    if (n < list->n)
        text_add(&d->caption, " weartrack view shows the others, too.");
}

static void draw_curves(figure_drawing *d)
{
    curve_list list;
    curve_list_init(d->tables, &list);
    if (list.n > 0)
        draw_sheet(d, &list);
    curve_list_clear(&list);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_indentation[] = {
    {.name = "force_displacement",
     .in_depth = true,
     .title = "Force against displacement",
     .table = &force_displacement_schema,
     .by_group = true,
     .group = FORCE_DISPLACEMENT_GROUP,
     .x = {FORCE_DISPLACEMENT_DISPLACEMENT, AXIS_LINEAR, "Displacement from the contact point"},
     .y = {{FORCE_DISPLACEMENT_FORCE, AXIS_LINEAR, "Force"}},
     .curves = {CURVE(FORCE_DISPLACEMENT_FORCE, OWN)},
     .empty_reason = "no force curve has numbers",
     .caption_text = "The curve with the median modulus of each group, approach and retract.",
     .draw = draw_force_displacement,
     .caption = caption_force_displacement},
    {.name = "force_indentation",
     .title = "Force against indentation",
     .table = &force_indentation_schema,
     .by_group = true,
     .group = FORCE_INDENTATION_GROUP,
     .x = {FORCE_INDENTATION_INDENTATION, AXIS_LINEAR, "Indentation"},
     .y = {{FORCE_INDENTATION_FORCE, AXIS_LINEAR, "Force"}},
     .curves = {CURVE(FORCE_INDENTATION_FORCE, POINTS, .style = 40, .points = MARKER_POINTS),
                CURVE(FORCE_INDENTATION_FITTED_FORCE, FIT, .style = 11, .title = "fit")},
     .empty_reason = "no point of the contact part has numbers",
     .caption_text =
         "Loading part of the curve with the median modulus of each group, counted from its "
         "contact point.",
     .caption = caption_force_indentation},
    {.name = "modulus_groups",
     .title = "Modulus of each group",
     .table = &modulus_groups_schema,
     .other_tables = "comparison",
     .by_group = true,
     .group = MODULUS_GROUPS_GROUP,
     .y = {{MODULUS_GROUPS_GEOMETRIC_MEAN, AXIS_LOG, "Modulus"}},
     .curves = {CURVE(MODULUS_GROUPS_GEOMETRIC_MEAN, OWN, .with_errors = true)},
     .empty_reason = "no group has a modulus above zero",
     .caption_text =
         "Modulus of every curve used (open circles: wide or doubtful; spread sideways for "
         "sight only) and, to the right, "
         "the geometric mean of the group with its 95 % confidence interval; logarithmic "
         "axis.",
     .draw = draw_modulus_groups,
     .caption = caption_modulus_groups},
    {.name = "modulus_map",
     .title = "Map of the modulus",
     .table = &modulus_groups_schema,
     .by_group = true,
     .group = MODULUS_GROUPS_GROUP,
     .caption_text =
         "Modulus of the curves at their positions; circles: wide or doubtful, crosses: "
         "rejected curves. One "
         "scale of colour for all maps.",
     .draw = draw_modulus_map},
    {.name = "modulus_depth",
     .in_depth = true,
     .title = "Modulus against depth",
     .table = &modulus_depth_schema,
     .by_group = true,
     .group = MODULUS_DEPTH_GROUP,
     .x = {MODULUS_DEPTH_DEPTH, AXIS_LINEAR, "Indentation"},
     .y = {{MODULUS_DEPTH_MODULUS, AXIS_LOG, "Modulus at this depth"}},
     .curves = {CURVE(MODULUS_DEPTH_MODULUS, JOINED_BARS, .with_errors = true)},
     .empty_reason = "there are too few curves without adhesion for it",
     .caption_text =
         "Modulus of the homogeneous rubber that would give the force at this depth alone, of "
         "all curves of a group together, with their contact point fitted anew; bars: 95 % "
         "confidence interval."},
    {.name = "modulus_rate",
     .in_depth = true,
     .title = "Modulus against indentation rate",
     .table = &modulus_rate_schema,
     .by_group = true,
     .group = MODULUS_RATE_GROUP,
     .x = {MODULUS_RATE_RATE, AXIS_LOG, "Indentation rate"},
     .y = {{MODULUS_RATE_GEOMETRIC_MEAN, AXIS_LOG, "Modulus, geometric mean"}},
     .curves = {CURVE(MODULUS_RATE_GEOMETRIC_MEAN, JOINED_BARS, .with_errors = true)},
     .empty_reason = "no modulus with a known indentation rate",
     .caption_text =
         "Geometric mean of the modulus against indentation rate, binned by half a decade; "
         "bars: 95 % confidence interval. Curves in the bins:",
     .caption = caption_modulus_rate},
    {.name = "curves",
     .title = "Force curves to look at",
     .table = &curves_schema,
     .caption_text =
         "Force against displacement of single curves, refused ones first, then doubtful ones; "
         "counted from the contact point where there is one.",
     .empty_reason = "no curve has samples",
     .draw = draw_curves},
    {.name = NULL},
};
