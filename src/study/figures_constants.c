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

/* Row of a table of pairs. */
typedef struct constant_estimates {
    double energy, energy_error, wear, wear_error, correlation;
    const char *by, *name;
    char room[128]; /* storage of the name */
} constant_estimates;

/* Returns the heading of a method. */
static const char *panel_heading(const char *by)
{
    static const char *const headings[] = {[BY_WEAR] = "wear rate",
                                           [BY_RATES] = "balance of rates",
                                           [BY_TRANSPORT] = "transport of damage"};
    const int method = closed_list_find(&identification_method_list, by);
    return method <= BY_TRANSPORT ? headings[method] : by;
}

static void read_identification(const table_view *t, size_t row, constant_estimates *p)
{
    *p = (constant_estimates){identification_get(t, row, IDENTIFICATION_ENERGY),
                              identification_get(t, row, IDENTIFICATION_ENERGY_STANDARD_ERROR),
                              identification_get(t, row, IDENTIFICATION_WEAR),
                              identification_get(t, row, IDENTIFICATION_WEAR_STANDARD_ERROR),
                              identification_get(t, row, IDENTIFICATION_CORRELATION),
                              "",
                              panel_heading(identification_text(t, row, IDENTIFICATION_BY)),
                              ""};
}

static void read_collected_constants(const table_view *t, size_t row, constant_estimates *p)
{
    const char *condition = collected_constants_text(t, row, COLLECTED_CONSTANTS_CONDITION);
    *p = (constant_estimates){
        collected_constants_get(t, row, COLLECTED_CONSTANTS_ENERGY),
        collected_constants_get(t, row, COLLECTED_CONSTANTS_ENERGY_STANDARD_ERROR),
        collected_constants_get(t, row, COLLECTED_CONSTANTS_WEAR),
        collected_constants_get(t, row, COLLECTED_CONSTANTS_WEAR_STANDARD_ERROR),
        collected_constants_get(t, row, COLLECTED_CONSTANTS_CORRELATION),
        collected_constants_text(t, row, COLLECTED_CONSTANTS_BY),
        NULL,
        ""};
    snprintf(p->room, sizeof p->room, "%s%s%s",
             collected_constants_text(t, row, COLLECTED_CONSTANTS_SAMPLE),
             condition[0] != '\0' ? ", " : "", condition);
    p->name = p->room;
}

typedef void read_estimates(const table_view *t, size_t row, constant_estimates *p);

/* Adds the points of the joint region. NO_SECTION if there is none. */
static int add_region(figure_drawing *d, const constant_estimates *p)
{
    static const char *const columns[] = {"critical_energy", "specific_wear_rate", NULL},
                             *const units[] = {"J/m^3", "m^2/N", NULL};
    double points[2 * POINTS];
    const double of_energy = radius_95 * p->energy_error / p->energy,
                 of_wear = radius_95 * p->wear_error / p->wear,
                 across = sqrt(1 - p->correlation * p->correlation);
    if (!isfinite(of_energy) || !isfinite(of_wear) || !isfinite(across))
        return NO_SECTION;
    for (size_t i = 0; i < POINTS; i++) {
        const double at = 2 * M_PI * (double)i / (POINTS - 1);
        points[2 * i] = p->energy * exp(of_energy * cos(at));
        points[2 * i + 1] = p->wear * exp(of_wear * (p->correlation * cos(at) + across * sin(at)));
    }
    return drawing_number_section(d, p->name, columns, units, points, POINTS);
}

typedef struct region {
    int section;
    size_t panel, row;
} region;

typedef struct regions {
    region of[REGIONS];
    const char *by[PANELS];
    size_t n, n_panels;
} regions;

static void find_regions(figure_drawing *d, read_estimates *read, regions *r)
{
    *r = (regions){.n = 0};
    for (size_t row = 0; row < d->table->n_rows && d->status == WT_OK; row++) {
        constant_estimates p;
        size_t panel = 0;
        read(d->table, row, &p);
        while (panel < r->n_panels && strcmp(r->by[panel], p.by) != 0)
            panel++;
        const int section = r->n < REGIONS && panel < PANELS ? add_region(d, &p) : NO_SECTION;
        if (section == NO_SECTION)
            continue;
        r->by[panel] = p.by;
        r->n_panels = panel == r->n_panels ? panel + 1 : r->n_panels;
        r->of[r->n++] = (region){section, panel, row};
    }
}

static void draw_region_panel(figure_drawing *d, read_estimates *read, const regions *r,
                              size_t panel)
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
    for (size_t i = 0; i < r->n; i++) {
        constant_estimates p;
        if (r->of[i].panel != panel)
            continue;
        read(d->table, r->of[i].row, &p);
        plot_item(d, r->of[i].section, "($1*x_unit):($2*y_unit) with lines ls %zu",
                  1 + shown % STYLES + (shown < STYLES ? 0 : DASHED));
        plot_title(d, p.name);
        shown++;
    }
    plot_end(d);
}

/* Draws a panel for each method, as their regions may be decades apart. The common legend is above
 * the first panel. */
static void draw_regions(figure_drawing *d, read_estimates *read)
{
    regions r;
    size_t names = 0;
    find_regions(d, read, &r);
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
        draw_region_panel(d, read, &r, panel);
    if (r.n_panels > 1)
        text_add(&d->script, "unset multiplot\n");
}

static void caption_regions(figure_drawing *d)
{
    if (d->n_sections == REGIONS)
        text_format(&d->caption, " The first %d only.", REGIONS);
}

static void draw_identification(figure_drawing *d)
{
    draw_regions(d, read_identification);
}

static void draw_collected(figure_drawing *d)
{
    draw_regions(d, read_collected_constants);
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
     .draw = draw_identification},
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
     .draw = draw_collected,
     .caption = caption_regions},
    {.name = NULL},
};
