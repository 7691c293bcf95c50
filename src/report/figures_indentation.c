/* Figures of the indentation: the force curves, and the moduli by group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>
#include <string.h>

/* More points than that cannot be told apart in one panel. */
enum { LINE_POINTS = 1200, MARKER_POINTS = 220, CROWD_POINTS = 3000 };

static const char *const force_columns[] = {"displacement", "force", NULL};

static void set_title(figure_drawing *d, const char *group)
{
    text_add(&d->script, "set title ");
    text_quoted(&d->script, group);
    text_add(&d->script, " noenhanced\n");
}

static bool group_estimate(const wt_table *table, const char *key, const char *group,
                           wt_estimate *estimate)
{
    char name[128];
    (void)snprintf(name, sizeof name, "%s_%s", key, group);
    return wt_table_estimate(table, name, estimate) && isfinite(estimate->value);
}

static const char *group_text(const wt_table *table, const char *key, const char *group)
{
    char name[128];
    (void)snprintf(name, sizeof name, "%s_%s", key, group);
    return wt_table_key(table, name);
}

typedef struct force_panel {
    const char *group;
    int approach, retract, contact; /* sections */
    bool has_contact;
    wt_estimate contact_point;
} force_panel;

static void add_contact(figure_drawing *d, const wt_table *table, force_panel *panel)
{
    panel->has_contact =
        group_estimate(table, "contact_point", panel->group, &panel->contact_point);
    panel->contact = NO_SECTION;
    wt_estimate force;
    if (!panel->has_contact || !group_estimate(table, "contact_force", panel->group, &force))
        return;
    static const char *const columns[] = {"contact_point", "contact_point_standard_error",
                                          "contact_force", NULL};
    static const char *const units[] = {"m", "m", "N", NULL};
    const double values[] = {panel->contact_point.value, panel->contact_point.standard_error,
                             force.value};
    panel->contact = drawing_point(d, "contact point", columns, units, values);
}

/* Extent of a panel measured from its contact point. */
static void span_from_contact(figure_drawing *d, const force_panel *panel, int section,
                              value_span *x, value_span *y)
{
    value_span own = SPAN_EMPTY;
    span_add_section(&own, d, section, "displacement", false);
    if (span_empty(&own))
        return;
    double origin = panel->has_contact ? panel->contact_point.value : 0;
    span_add(x, own.low - origin, false);
    span_add(x, own.high - origin, false);
    span_add_section(y, d, section, "force", false);
}

static void draw_force_panel(figure_drawing *d, const force_panel *panel, int style)
{
    size_t every = drawing_every(d, panel->approach, LINE_POINTS);
    text_add(&d->script, "contact_point = ");
    text_literal(&d->script, panel->has_contact ? panel->contact_point.value : 0);
    text_add(&d->script, "  # m; the axis counts from it\n");
    set_title(d, panel->group);
    text_add(&d->script, "unset arrow\n");
    if (panel->has_contact)
        text_add(&d->script, "set arrow from 0, graph 0 to 0, graph 1 nohead ls 12 back\n");
    plot_begin(d);
    plot_item(d, panel->approach,
              "(($1-contact_point)*x_unit):($2*y_unit) every %zu with lines ls %d title "
              "'approach'",
              every, style);
    plot_item(d, panel->retract,
              "(($1-contact_point)*x_unit):($2*y_unit) every %zu with lines ls %d title "
              "'retract'",
              drawing_every(d, panel->retract, LINE_POINTS), style + 30);
    plot_item(d, panel->contact,
              "(($1-contact_point)*x_unit):($3*y_unit):($2*x_unit) with xerrorbars ls 13 title "
              "'contact'");
    plot_end(d);
}

void draw_force_displacement(figure_drawing *d)
{
    const wt_table *table = wt_result_find(d->result, "force_displacement");
    const char *groups[DRAWING_GROUPS];
    size_t n_groups = drawing_groups(table, "group", groups), n = 0, every = 1;
    force_panel panels[DRAWING_GROUPS];
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    bool contacts = true;

    for (size_t i = 0; i < n_groups; i++) {
        force_panel *panel = &panels[n];
        panel->group = groups[i];
        row_filter rows = {{"group", "segment"}, {groups[i], "approach"}, false};
        panel->approach = drawing_section(d, table, "approach", &rows, force_columns, 2, false);
        rows.text[1] = "retract";
        panel->retract = drawing_section(d, table, "retract", &rows, force_columns, 2, false);
        if (panel->approach < 0 && panel->retract < 0)
            continue;
        add_contact(d, table, panel);
        contacts = contacts && panel->has_contact;
        span_from_contact(d, panel, panel->approach, &x, &y);
        span_from_contact(d, panel, panel->retract, &x, &y);
        size_t one = drawing_every(d, panel->approach, LINE_POINTS);
        every = one > every ? one : every;
        n++;
    }
    if (n == 0 || d->status != WT_OK) {
        text_add(&d->omitted, "no force curve has numbers");
        return;
    }
    d->width = n == 1 ? 1 : 0.85 * (double)n;
    d->height = 0.9;
    axis_linear(d, "x", contacts ? "Displacement from the contact point" : "Displacement", "m", "",
                x);
    axis_linear(d, "y", "Force", "N", "", y);
    text_format(&d->script, "set multiplot layout 1,%zu\n", n);
    for (size_t i = 0; i < n; i++)
        draw_force_panel(d, &panels[i], drawing_group_style(panels[i].group, i));
    text_add(&d->script, "unset multiplot\n");

    text_add(&d->caption, "The curve with the median modulus of each group, approach and "
                          "retract.");
    for (size_t i = 0; i < n; i++) {
        const char *curve = group_text(table, "curve", panels[i].group);
        double error = panels[i].has_contact ? panels[i].contact_point.standard_error : 0;
        if (curve == NULL && !(error > 0))
            continue;
        text_format(&d->caption, " %s:%s%s", panels[i].group, curve != NULL ? " " : "",
                    curve != NULL ? curve : "");
        if (error > 0) {
            text_format(&d->caption, "%s standard error of the contact point ",
                        curve != NULL ? "," : "");
            caption_value(d, error, "m", "");
        }
        text_add(&d->caption, ".");
    }
    if (contacts)
        text_add(&d->caption, " The vertical line is the fitted contact point; its horizontal "
                              "bar is one standard error.");
    if (every > 1)
        text_format(&d->caption, " One sample of %zu is drawn.", every);
}

void draw_force_indentation(figure_drawing *d)
{
    static const char *const columns[] = {"indentation", "force", "fitted_force", NULL};
    const wt_table *table = wt_result_find(d->result, "force_indentation");
    const char *groups[DRAWING_GROUPS];
    size_t n = drawing_groups(table, "group", groups), every = 1;
    int section[DRAWING_GROUPS];
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;

    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{"group", NULL}, {groups[i], NULL}, false};
        section[i] = drawing_section(d, table, groups[i], &rows, columns, 2, true);
        span_add_section(&x, d, section[i], "indentation", false);
        span_add_section(&y, d, section[i], "force", false);
        size_t one = drawing_every(d, section[i], MARKER_POINTS);
        every = one > every ? one : every;
    }
    if (span_empty(&x) || d->status != WT_OK) {
        text_add(&d->omitted, "no point of the contact part has numbers");
        return;
    }
    axis_linear(d, "x", "Indentation", "m", "", x);
    axis_linear(d, "y", "Force", "N", "", y);
    plot_begin(d);
    bool fitted = false;
    for (size_t i = 0; i < n; i++) {
        if (section[i] < 0)
            continue;
        plot_item(d, section[i], "($1*x_unit):($2*y_unit) every %zu with points ls %d",
                  drawing_every(d, section[i], MARKER_POINTS),
                  drawing_group_style(groups[i], i) + 40);
        plot_title(d, groups[i]);
        value_span fit = SPAN_EMPTY;
        span_add_section(&fit, d, section[i], "fitted_force", false);
        if (span_empty(&fit))
            continue;
        plot_item(d, section[i], "($1*x_unit):($3*y_unit) with lines ls 11 %s",
                  fitted ? "notitle" : "title 'fit'");
        fitted = true;
    }
    plot_end(d);
    text_add(&d->caption, "Loading part of the curve with the median modulus of each group, "
                          "counted from its contact point.");
    if (fitted)
        text_add(&d->caption, " Lines: contact model with the fitted modulus.");
    if (every > 1)
        text_format(&d->caption, " One sample of up to %zu is drawn.", every);
}

/* "indentation/GROUP" */
static const wt_table *indentation_of(const figure_drawing *d, const char *group)
{
    char name[128];
    (void)snprintf(name, sizeof name, "indentation/%s", group);
    return wt_result_find(d->result, name);
}

void draw_modulus_groups(figure_drawing *d)
{
    static const char *const curve_columns[] = {"modulus", "modulus_standard_error", NULL};
    static const char *const mean_columns[] = {"geometric_mean", "low", "high", NULL};
    const wt_table *summary = wt_result_find(d->result, "modulus_groups");
    const char *groups[DRAWING_GROUPS];
    size_t n = drawing_groups(summary, "group", groups);
    int curves[DRAWING_GROUPS], mean[DRAWING_GROUPS];
    value_span y = SPAN_EMPTY;
    size_t every = 1;

    for (size_t i = 0; i < n; i++) {
        const row_filter accepted = {{"verdict", NULL}, {"accepted", NULL}, false};
        const row_filter rows = {{"group", NULL}, {groups[i], NULL}, false};
        const wt_table *table = indentation_of(d, groups[i]);
        curves[i] = table == NULL
                        ? NO_SECTION
                        : drawing_section(d, table, groups[i], &accepted, curve_columns, 1, false);
        mean[i] = drawing_section(d, summary, groups[i], &rows, mean_columns, 1, false);
        span_add_section(&y, d, curves[i], "modulus", true);
        for (size_t k = 0; k < 3; k++)
            span_add_section(&y, d, mean[i], mean_columns[k], true);
    }
    if (span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no group has a modulus above zero");
        return;
    }
    d->width = n <= 2 ? 0.8 : 1;
    axis_log(d, "y", "Modulus", "Pa", y);
    text_format(&d->script, "set xrange [0.5:%zu.6]\nset xtics (", n);
    for (size_t i = 0; i < n; i++) {
        growing_text label = {0};
        text_format(&label, "%s (n = %zu)", groups[i], drawing_rows(d, curves[i]));
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
        int style = drawing_group_style(groups[i], i);
        size_t one = drawing_every(d, curves[i], CROWD_POINTS);
        every = one > every ? one : every;
        plot_item(d, curves[i], "(%zu + spread($0)):($1*y_unit) every %zu with points ls %d ps 0.6",
                  i + 1, one, style + 40);
        plot_item(d, mean[i], "(%zu.32):($1*y_unit):($2*y_unit):($3*y_unit) with yerrorbars ls 13",
                  i + 1);
    }
    plot_end(d);

    text_add(&d->caption, "Modulus of every accepted curve (spread sideways for sight only) and, "
                          "to the right, the geometric mean of the group with its 95 % "
                          "confidence interval; logarithmic axis.");
    if (every > 1)
        text_format(&d->caption, " One curve of up to %zu is drawn.", every);
    const wt_table *comparison = wt_result_find(d->result, "comparison");
    const char *unit = comparison != NULL ? wt_table_key(comparison, "unit_of_analysis") : NULL;
    if (unit != NULL)
        text_format(&d->caption, " Unit of analysis of the interval: %s.", unit);
    for (size_t row = 0; row < wt_table_n_rows(summary); row++) {
        double all = cell_number(summary, row, "n"), out = cell_number(summary, row, "n_rejected");
        if (isfinite(all) && isfinite(out))
            text_format(&d->caption, " %s: n = %.0f, rejected %.0f.",
                        cell_text(summary, row, "group"), all, out);
    }
}

void draw_modulus_rate(figure_drawing *d)
{
    static const char *const columns[] = {"indentation_rate", "geometric_mean", "low", "high",
                                          NULL};
    const wt_table *table = wt_result_find(d->result, "modulus_rate");
    const char *groups[DRAWING_GROUPS];
    size_t n = drawing_groups(table, "group", groups);
    int section[DRAWING_GROUPS];
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;

    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{"group", NULL}, {groups[i], NULL}, false};
        section[i] = drawing_section(d, table, groups[i], &rows, columns, 2, false);
        span_add_section(&x, d, section[i], columns[0], true);
        for (size_t k = 1; k < 4; k++)
            span_add_section(&y, d, section[i], columns[k], true);
    }
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no modulus with a known indentation rate");
        return;
    }
    axis_log(d, "x", "Indentation rate", "m/s", x);
    axis_log(d, "y", "Modulus, geometric mean", "Pa", y);
    plot_begin(d);
    for (size_t i = 0; i < n; i++) {
        if (section[i] < 0)
            continue;
        plot_item(d, section[i],
                  "($1*x_unit):($2*y_unit):($3*y_unit):($4*y_unit) with yerrorlines ls %d",
                  drawing_group_style(groups[i], i));
        plot_title(d, groups[i]);
    }
    plot_end(d);
    text_add(&d->caption, "Geometric mean of the modulus against indentation rate, binned by "
                          "half a decade; bars: 95 % confidence interval. Curves in the bins:");
    for (size_t i = 0; i < n; i++) {
        bool first = true;
        text_format(&d->caption, "%s %s n = ", i == 0 ? "" : ";", groups[i]);
        for (size_t row = 0; row < wt_table_n_rows(table); row++) {
            if (strcmp(cell_text(table, row, "group"), groups[i]) != 0)
                continue;
            text_add(&d->caption, first ? "" : ", ");
            text_short(&d->caption, cell_number(table, row, "n"), 9);
            first = false;
        }
    }
    text_add(&d->caption, ".");
}
