/* Figures of critical energy and wear rate: the 95 % region of each method of determination, for
 * one layer or for collected cases.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Radius that contains 95 % of a bivariate normal distribution: sqrt(-2 ln 0.05). */
static const double radius_95 = 2.4477;
/* Points of a region, and the largest number of distinguishable regions. */
enum { POINTS = 73, REGIONS = 36, PANELS = 3 };
/* Number of line styles, and offset of the dashed styles. */
enum { STYLES = 6, DASHED = 30 };

/* Columns of a table of pairs. */
typedef struct estimate_columns {
    unsigned energy, energy_error, wear, wear_error, correlation, by;
} estimate_columns;
static const estimate_columns
    of_one_layer = {IDENTIFICATION_ENERGY,      IDENTIFICATION_ENERGY_STANDARD_ERROR,
                    IDENTIFICATION_WEAR,        IDENTIFICATION_WEAR_STANDARD_ERROR,
                    IDENTIFICATION_CORRELATION, IDENTIFICATION_BY},
    of_cases = {COLLECTED_CONSTANTS_ENERGY,      COLLECTED_CONSTANTS_ENERGY_STANDARD_ERROR,
                COLLECTED_CONSTANTS_WEAR,        COLLECTED_CONSTANTS_WEAR_STANDARD_ERROR,
                COLLECTED_CONSTANTS_CORRELATION, COLLECTED_CONSTANTS_BY};

/* Returns the heading of a method. */
static const char *panel_heading(const char *by)
{
    static const char *const headings[] = {[BY_WEAR] = "wear rate",
                                           [BY_RATES] = "balance of rates",
                                           [BY_TRANSPORT] = "transport of damage"};
    const int method = closed_list_find(&identification_method_list, by);
    return method <= BY_TRANSPORT ? headings[method] : by;
}

/* Adds the points of the joint region. NO_SECTION if there is none. */
static int add_region(figure_drawing *d, size_t row, const estimate_columns *at, const char *name)
{
    static const char *const columns[] = {"critical_energy", "specific_wear_rate", NULL},
                             *const units[] = {"J/m^3", "m^2/N", NULL};
    const table_view *const t = d->table;
    double points[2 * POINTS];
    const double energy = view_number(t, t->schema, row, at->energy),
                 wear = view_number(t, t->schema, row, at->wear),
                 of_energy = radius_95 * view_number(t, t->schema, row, at->energy_error) / energy,
                 of_wear = radius_95 * view_number(t, t->schema, row, at->wear_error) / wear,
                 correlation = view_number(t, t->schema, row, at->correlation),
                 across = sqrt(1 - correlation * correlation);
    if (!isfinite(of_energy) || !isfinite(of_wear) || !isfinite(across))
        return NO_SECTION;
    for (size_t i = 0; i < POINTS; i++) {
        const double angle = 2 * M_PI * (double)i / (POINTS - 1);
        points[2 * i] = energy * exp(of_energy * cos(angle));
        points[2 * i + 1] = wear * exp(of_wear * (correlation * cos(angle) + across * sin(angle)));
    }
    return drawing_number_section(d, name, columns, units, points, POINTS);
}

typedef struct region {
    int section;
    size_t panel;
    char name[128];
} region;

typedef struct regions {
    region of[REGIONS];
    const char *by[PANELS];
    size_t n, n_panels;
} regions;

/* Regions of one layer have a common panel and the names of their methods, those of several cases a
 * panel for each method and the names of the cases. */
static void find_regions(figure_drawing *d, const estimate_columns *at, regions *r)
{
    *r = (regions){.n = 0};
    for (size_t row = 0; row < d->table->n_rows && d->status == WT_OK; row++) {
        const char *by = view_text(d->table, d->table->schema, row, at->by);
        region new_region;
        size_t panel = 0;
        if (at == &of_one_layer) {
            snprintf(new_region.name, sizeof new_region.name, "%s", panel_heading(by));
            by = "";
        } else {
            const char *condition =
                collected_constants_text(d->table, row, COLLECTED_CONSTANTS_CONDITION);
            snprintf(new_region.name, sizeof new_region.name, "%s%s%s",
                     collected_constants_text(d->table, row, COLLECTED_CONSTANTS_SAMPLE),
                     condition[0] != '\0' ? ", " : "", condition);
        }
        while (panel < r->n_panels && strcmp(r->by[panel], by) != 0)
            panel++;
        new_region.panel = panel;
        new_region.section =
            r->n < REGIONS && panel < PANELS ? add_region(d, row, at, new_region.name) : NO_SECTION;
        if (new_region.section == NO_SECTION)
            continue;
        r->by[panel] = by;
        r->n_panels = panel == r->n_panels ? panel + 1 : r->n_panels;
        r->of[r->n++] = new_region;
    }
}

static void draw_region_panel(figure_drawing *d, const regions *r, size_t panel)
{
    size_t shown = 0;
    d->x = d->y[0] = EMPTY_SPAN;
    for (size_t i = 0; i < r->n; i++)
        if (r->of[i].panel == panel) {
            span_add_section(&d->x, d, r->of[i].section, 0, true);
            span_add_section(&d->y[0], d, r->of[i].section, 1, true);
        }
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    if (r->n_panels > 1)
        plot_heading(d, panel_heading(r->by[panel]));
    text_add(&d->script, panel == 1 ? "unset key\n" : "");
    for (size_t i = 0; i < r->n; i++)
        if (r->of[i].panel == panel) {
            plot_item(d, r->of[i].section, "($1*x_unit):($2*y_unit) with lines ls %zu",
                      1 + shown % STYLES + (shown < STYLES ? 0 : DASHED));
            plot_title(d, r->of[i].name);
            shown++;
        }
    plot_end(d);
}

/* Draws a panel for each method, as their regions may be decades apart. The common legend is above
 * the first panel. */
static void draw_regions(figure_drawing *d)
{
    regions r;
    size_t names = 0;
    find_regions(d, d->table->schema == &identification_schema ? &of_one_layer : &of_cases, &r);
    if (d->status != WT_OK || r.n == 0)
        return;
    for (size_t i = 0; i < r.n; i++)
        names += r.of[i].panel == 0;
    d->width = r.n_panels > 1 ? 2 : 1;
    if (r.n_panels > 1)
        text_format(&d->script,
                    "set tmargin %zu\nset bmargin 6\nset multiplot layout 1,%zu\n"
                    "set xtics rotate by -40\n",
                    3 + names, r.n_panels);
    for (size_t panel = 0; panel < r.n_panels; panel++)
        draw_region_panel(d, &r, panel);
    if (r.n_panels > 1)
        text_add(&d->script, "unset multiplot\n");
}

static void caption_regions(figure_drawing *d)
{
    if (d->n_sections == REGIONS)
        text_format(&d->caption, " The first %d only.", REGIONS);
}

const figure_description figures_constants[] = {
    {.name = "identification",
     .title = "Critical energy and wear rate together",
     .table = &identification_schema,
     .x = {IDENTIFICATION_ENERGY, AXIS_LOG, "Critical energy U_c"},
     .y = {{IDENTIFICATION_WEAR, AXIS_LOG, "Specific wear rate k"}},
     .curves = {CURVE(IDENTIFICATION_WEAR, LINE)},
     .empty_reason = "no way to know both has an interval",
     .caption_text =
         "Regions that hold critical energy and specific wear rate together in 95 %, by what is "
         "known of the layer. What is long and narrow is known across, and hardly along.",
     .draw = draw_regions},
    {.name = "collected_constants",
     .title = "Critical energy and wear rate of the cases",
     .table = &collected_constants_schema,
     .x = {COLLECTED_CONSTANTS_ENERGY, AXIS_LOG, "Critical energy U_c"},
     .y = {{COLLECTED_CONSTANTS_WEAR, AXIS_LOG, "Specific wear rate k"}},
     .curves = {CURVE(COLLECTED_CONSTANTS_WEAR, LINE)},
     .empty_reason = "no case knows both with an interval",
     .caption_text =
         "Regions that hold critical energy and specific wear rate of a case together in 95 %, a "
         "panel for each way to know them. Whether one pair is behind them is in the table.",
     .draw = draw_regions,
     .caption = caption_regions},
    {.name = NULL},
};
