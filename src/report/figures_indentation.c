/* Figures of the indentation: the force curves, and the moduli by group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures_map.h"

#include <math.h>
#include <string.h>

/* More points than that cannot be told apart in one panel. */
enum { LINE_POINTS = 1200, MARKER_POINTS = 220, CROWD_POINTS = 3000 };

/* ---- force against displacement, a panel for each group -------------------------------------- */

typedef struct force_panel {
    const char *group;
    table_view table;                    /* with the keys of the group */
    double contact_point, contact_error; /* [m], NaN if unknown */
    int approach, retract, contact;      /* sections */
} force_panel;

/* Without its sections. */
static force_panel panel_of(const figure_drawing *d, const char *group)
{
    force_panel panel = {.group = group, .table = *d->table};
    panel.table.suffix = group;
    wt_estimate contact =
        force_displacement_value(&panel.table, FORCE_DISPLACEMENT_KEY_CONTACT_POINT);
    panel.contact_point = contact.value;
    panel.contact_error = contact.standard_error;
    return panel;
}

static bool has_contact(const force_panel *panel)
{
    return isfinite(panel->contact_point);
}

static int segment_section(figure_drawing *d, const char *group, const char *segment)
{
    const row_filter rows = {
        {FORCE_DISPLACEMENT_GROUP, FORCE_DISPLACEMENT_SEGMENT}, {group, segment}, false};
    unsigned columns[FIGURE_COLUMNS];
    const size_t n = drawing_columns(d->figure, columns);
    return drawing_section(d, d->table, segment, &rows, columns, n, n);
}

static int contact_section(figure_drawing *d, const force_panel *panel)
{
    static const char *const columns[] = {"contact_point", "contact_point_standard_error",
                                          "contact_force", NULL};
    static const char *const units[] = {"m", "m", "N", NULL};
    const double values[] = {
        panel->contact_point, panel->contact_error,
        force_displacement_value(&panel->table, FORCE_DISPLACEMENT_KEY_CONTACT_FORCE).value};
    return isfinite(values[0]) && isfinite(values[2])
               ? drawing_point(d, "contact point", columns, units, values)
               : NO_SECTION;
}

static double origin_of(const force_panel *panel)
{
    return has_contact(panel) ? panel->contact_point : 0;
}

/* Extent of a section measured from the contact point. */
static void span_from_contact(figure_drawing *d, const force_panel *panel, int section)
{
    value_span own = SPAN_EMPTY;
    span_add_section(&own, d, section, 0, false);
    if (span_empty(&own))
        return;
    span_add(&d->x, own.low - origin_of(panel), false);
    span_add(&d->x, own.high - origin_of(panel), false);
    span_add_section(&d->y[0], d, section, 1, false);
}

static void plot_force(figure_drawing *d, int section, int style, const char *title)
{
    plot_item(d, section,
              "(($1-contact_point)*x_unit):($2*y_unit) every %zu with lines ls %d title '%s'",
              drawing_every(d, section, LINE_POINTS), style, title);
}

static void draw_force_panel(figure_drawing *d, const force_panel *panel, int style)
{
    text_add(&d->script, "contact_point = ");
    text_literal(&d->script, origin_of(panel));
    text_add(&d->script, "  # m; the axis counts from it\n");
    plot_heading(d, panel->group);
    text_add(&d->script, "unset arrow\n");
    if (has_contact(panel))
        text_add(&d->script, "set arrow from 0, graph 0 to 0, graph 1 nohead ls 12 back\n");
    plot_begin(d);
    plot_force(d, panel->approach, style, "approach");
    plot_force(d, panel->retract, style + 30, "retract");
    plot_item(d, panel->contact,
              "(($1-contact_point)*x_unit):($3*y_unit):($2*x_unit) with xerrorbars ls 13 title "
              "'contact'");
    plot_end(d);
}

/* Of the groups that have a number. */
static bool all_have_contact(const figure_drawing *d)
{
    for (size_t i = 0; i < d->n_groups; i++) {
        const force_panel panel = panel_of(d, d->groups[i]);
        if (d->data[i] >= 0 && !has_contact(&panel))
            return false;
    }
    return true;
}

static void draw_force_displacement(figure_drawing *d)
{
    force_panel panels[DRAWING_GROUPS];
    size_t n = 0;

    d->x = d->y[0] = SPAN_EMPTY;
    for (size_t i = 0; i < d->n_groups; i++) {
        force_panel *panel = &panels[i];
        *panel = panel_of(d, d->groups[i]);
        panel->approach = segment_section(d, d->groups[i], "approach");
        panel->retract = segment_section(d, d->groups[i], "retract");
        d->data[i] = panel->approach >= 0 ? panel->approach : panel->retract;
        if (d->data[i] < 0)
            continue;
        panel->contact = contact_section(d, panel);
        span_from_contact(d, panel, panel->approach);
        span_from_contact(d, panel, panel->retract);
        n++;
    }
    if (n == 0 || d->status != WT_OK) {
        drawing_nothing(d);
        return;
    }
    d->width = n == 1 ? 1 : 0.85 * (double)n;
    d->height = 0.9;
    drawing_axis(d, "x", &d->figure->x,
                 all_have_contact(d) ? "Displacement from the contact point" : NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    text_format(&d->script, "set multiplot layout 1,%zu\n", n);
    for (size_t i = 0; i < d->n_groups; i++)
        if (d->data[i] >= 0)
            draw_force_panel(d, &panels[i], drawing_group_style(d, i));
    text_add(&d->script, "unset multiplot\n");
}

static void caption_force_panel(figure_drawing *d, const force_panel *panel)
{
    const char *curve = force_displacement_words(&panel->table, FORCE_DISPLACEMENT_KEY_CURVE);
    bool error = has_contact(panel) && panel->contact_error > 0;
    if (curve == NULL && !error)
        return;
    text_format(&d->caption, " %s:%s%s", panel->group, curve != NULL ? " " : "",
                curve != NULL ? curve : "");
    if (error) {
        text_format(&d->caption, "%s standard error of the contact point ",
                    curve != NULL ? "," : "");
        caption_value(d, WT_Q_LENGTH, NULL, panel->contact_error);
    }
    text_add(&d->caption, ".");
}

static void caption_force_displacement(figure_drawing *d)
{
    for (size_t i = 0; i < d->n_groups; i++) {
        const force_panel panel = panel_of(d, d->groups[i]);
        if (d->data[i] >= 0)
            caption_force_panel(d, &panel);
    }
    if (all_have_contact(d))
        text_add(&d->caption, " The vertical line is the fitted contact point; its horizontal "
                              "bar is one standard error.");
    size_t every = drawing_thinning(d, LINE_POINTS);
    if (every > 1)
        text_format(&d->caption, " One sample of %zu is drawn.", every);
}

/* ---- force against indentation --------------------------------------------------------------- */

static void caption_force_indentation(figure_drawing *d)
{
    value_span fit = SPAN_EMPTY;
    span_add_column(&fit, d->table, FORCE_INDENTATION_FITTED_FORCE, false);
    if (!span_empty(&fit))
        text_add(&d->caption, " Lines: contact model with the fitted modulus.");
    size_t every = drawing_thinning(d, MARKER_POINTS);
    if (every > 1)
        text_format(&d->caption, " One sample of up to %zu is drawn.", every);
}

/* ---- modulus by group ------------------------------------------------------------------------ */

/* The accepted curves of each group beside its mean. */
static void draw_modulus_groups(figure_drawing *d)
{
    static const unsigned of_curve[] = {INDENTATION_MODULUS, INDENTATION_MODULUS_STANDARD_ERROR};
    static const row_filter accepted = {{INDENTATION_VERDICT}, {"accepted"}, false};
    unsigned of_mean[FIGURE_COLUMNS];
    const size_t n = d->n_groups, n_mean = drawing_columns(d->figure, of_mean);
    int mean[DRAWING_GROUPS];

    d->y[0] = SPAN_EMPTY;
    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{d->figure->group}, {d->groups[i]}, false};
        const table_view *curves = bound_indentation(d->tables, d->groups[i]);
        d->data[i] = curves == NULL
                         ? NO_SECTION
                         : drawing_section(d, curves, d->groups[i], &accepted, of_curve, 2, 1);
        mean[i] = drawing_section(d, d->table, d->groups[i], &rows, of_mean, n_mean, 1);
        span_add_section(&d->y[0], d, d->data[i], 0, true);
        for (size_t k = 0; k < n_mean; k++)
            span_add_section(&d->y[0], d, mean[i], k, true);
    }
    if (span_empty(&d->y[0]) || d->status != WT_OK) {
        drawing_nothing(d);
        return;
    }
    d->width = n <= 2 ? 0.8 : 1;
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    text_format(&d->script, "set xrange [0.5:%zu.6]\nset xtics (", n);
    for (size_t i = 0; i < n; i++) {
        growing_text label = {0};
        text_format(&label, "%s (n = %zu)", d->groups[i], drawing_rows(d, d->data[i]));
        text_add(&d->script, i == 0 ? "" : ", ");
        text_quoted(&d->script, text_string(&label));
        text_format(&d->script, " %zu", i + 1);
        text_free(&label);
    }
    text_add(&d->script,
             ") noenhanced scale 0\nunset key\n"
             "# Spread sideways by the golden section, so that it is the same every time.\n"
             "spread(i) = 0.36*((i+1)*0.6180339887 - floor((i+1)*0.6180339887) - 0.5)\n");
    plot_begin(d);
    for (size_t i = 0; i < n; i++) {
        plot_item(d, d->data[i],
                  "(%zu + spread($0)):($1*y_unit) every %zu with points ls %d ps 0.6", i + 1,
                  drawing_every(d, d->data[i], CROWD_POINTS), drawing_group_style(d, i) + 40);
        plot_item(d, mean[i], "(%zu.32):($1*y_unit):($2*y_unit):($3*y_unit) with yerrorbars ls 13",
                  i + 1);
    }
    plot_end(d);
}

static void caption_modulus_groups(figure_drawing *d)
{
    size_t every = drawing_thinning(d, CROWD_POINTS);
    if (every > 1)
        text_format(&d->caption, " One curve of up to %zu is drawn.", every);
    const char *unit = comparison_words(&d->tables->comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS);
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
            text_add(&d->caption, first ? "" : ", ");
            text_short(&d->caption, modulus_rate_get(d->table, row, MODULUS_RATE_N), 9);
            first = false;
        }
    }
    text_add(&d->caption, ".");
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_indentation[] = {
    {.name = "force_displacement",
     .title = "Force against displacement",
     .table = &force_displacement_schema,
     .by_group = true,
     .group = FORCE_DISPLACEMENT_GROUP,
     .x = {FORCE_DISPLACEMENT_DISPLACEMENT, AXIS_LINEAR, "Displacement"},
     .y = {{FORCE_DISPLACEMENT_FORCE, AXIS_LINEAR, "Force"}},
     .curves = {{.column = FORCE_DISPLACEMENT_FORCE, .form = CURVE_OWN}},
     .nothing = "no force curve has numbers",
     .words = "The curve with the median modulus of each group, approach and retract.",
     .draw = draw_force_displacement,
     .caption = caption_force_displacement},
    {.name = "force_indentation",
     .title = "Force against indentation",
     .table = &force_indentation_schema,
     .by_group = true,
     .group = FORCE_INDENTATION_GROUP,
     .x = {FORCE_INDENTATION_INDENTATION, AXIS_LINEAR, "Indentation"},
     .y = {{FORCE_INDENTATION_FORCE, AXIS_LINEAR, "Force"}},
     .curves = {{.column = FORCE_INDENTATION_FORCE,
                 .form = CURVE_POINTS,
                 .style = 40,
                 .points = MARKER_POINTS},
                {.column = FORCE_INDENTATION_FITTED_FORCE,
                 .form = CURVE_FIT,
                 .style = 11,
                 .title = "fit"}},
     .nothing = "no point of the contact part has numbers",
     .words = "Loading part of the curve with the median modulus of each group, counted from its "
              "contact point.",
     .caption = caption_force_indentation},
    {.name = "modulus_groups",
     .title = "Modulus in and beside the wear track",
     .table = &modulus_groups_schema,
     .by_group = true,
     .group = MODULUS_GROUPS_GROUP,
     .y = {{MODULUS_GROUPS_GEOMETRIC_MEAN, AXIS_LOG, "Modulus"}},
     .curves = {{.column = MODULUS_GROUPS_GEOMETRIC_MEAN,
                 .form = CURVE_OWN,
                 .low = MODULUS_GROUPS_LOW,
                 .high = MODULUS_GROUPS_HIGH}},
     .nothing = "no group has a modulus above zero",
     .words = "Modulus of every accepted curve (spread sideways for sight only) and, to the right, "
              "the geometric mean of the group with its 95 % confidence interval; logarithmic "
              "axis.",
     .draw = draw_modulus_groups,
     .caption = caption_modulus_groups},
    {.name = "modulus_map",
     .title = "Map of the modulus",
     .table = &modulus_groups_schema,
     .by_group = true,
     .group = MODULUS_GROUPS_GROUP,
     .words = "Modulus of the accepted curves at their positions; crosses: rejected curves. One "
              "scale of colour for all maps.",
     .draw = draw_modulus_map},
    {.name = "modulus_rate",
     .title = "Modulus against indentation rate",
     .table = &modulus_rate_schema,
     .by_group = true,
     .group = MODULUS_RATE_GROUP,
     .x = {MODULUS_RATE_RATE, AXIS_LOG, "Indentation rate"},
     .y = {{MODULUS_RATE_GEOMETRIC_MEAN, AXIS_LOG, "Modulus, geometric mean"}},
     .curves = {{.column = MODULUS_RATE_GEOMETRIC_MEAN,
                 .form = CURVE_JOINED_BARS,
                 .low = MODULUS_RATE_LOW,
                 .high = MODULUS_RATE_HIGH}},
     .nothing = "no modulus with a known indentation rate",
     .words = "Geometric mean of the modulus against indentation rate, binned by half a decade; "
              "bars: 95 % confidence interval. Curves in the bins:",
     .caption = caption_modulus_rate},
    {.name = NULL},
};
