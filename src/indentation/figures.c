/* Figures of the indentation: the force curves, and the moduli by group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>
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
        {FORCE_DISPLACEMENT_GROUP, FORCE_DISPLACEMENT_SEGMENT}, {d->groups[i], segment}, false};
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
    d->width = n == 1 ? 1 : 0.85 * (double)n;
    d->height = 0.9;
    drawing_axes(d);
    text_format(&d->script, "set multiplot layout 1,%zu\n", n);
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
                  "(($1-contact_point)*x_unit):($3*y_unit):($2*x_unit) with xerrorbars ls 13 title "
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
            text_format(&d->caption, " %s: %s, standard error of the contact point %s.",
                        d->groups[i], curve, VALUE(WT_Q_LENGTH, NULL, error));
        else if (curve != NULL)
            text_format(&d->caption, " %s: %s.", d->groups[i], curve);
    }
    text_add(&d->caption, " The vertical line is the fitted contact point; its horizontal bar is "
                          "one standard error.");
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

/* Draws the accepted curves of each group next to its mean. */
static void draw_modulus_groups(figure_drawing *d)
{
    static const unsigned curve_columns[] = {INDENTATION_MODULUS,
                                             INDENTATION_MODULUS_STANDARD_ERROR};
    static const row_filter accepted = {{INDENTATION_VERDICT}, {"accepted"}, false},
                            doubtful = {{INDENTATION_VERDICT}, {"doubtful"}, false};
    const size_t n = d->n_groups;
    int mean[DRAWING_GROUPS], open[DRAWING_GROUPS];

    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{d->figure->group}, {d->groups[i]}, false};
        const table_view *curves = figure_tables_indentation(d->tables, d->groups[i]);
        d->data[i] = curves == NULL
                         ? NO_SECTION
                         : drawing_section(d, curves, d->groups[i], &accepted, curve_columns, 2, 1);
        open[i] = curves == NULL
                      ? NO_SECTION
                      : drawing_section(d, curves, "doubtful", &doubtful, curve_columns, 2, 1);
        span_add_section(&d->y[0], d, open[i], 0, true);
        mean[i] = drawing_section(d, d->table, d->groups[i], &rows, d->columns, d->n_columns, 1);
        span_add_section(&d->y[0], d, d->data[i], 0, true);
        for (size_t k = 0; k < d->n_columns; k++)
            span_add_section(&d->y[0], d, mean[i], k, true);
    }
    if (span_is_empty(&d->y[0]) || d->status != WT_OK)
        return;
    d->width = n <= 2 ? 0.8 : 1;
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    text_format(&d->script, "set xrange [0.5:%zu.6]\nset xtics (", n);
    for (size_t i = 0; i < n; i++) {
        text_buffer label = {0};
        text_format(&label, "%s (n = %zu)", d->groups[i],
                    drawing_row_count(d, d->data[i]) + drawing_row_count(d, open[i]));
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
         "Modulus of every accepted curve (open circles: doubtful; spread sideways for sight "
         "only) and, to the right, "
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
         "Modulus of the curves at their positions; circles: doubtful, crosses: rejected "
         "curves. One "
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
     .empty_reason = "too few curves without adhesion tell it",
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
    {.name = NULL},
};
