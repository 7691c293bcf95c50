/* Figures of collected cases: a panel per sample with moduli against the rate and with force
 * curves, a panel per condition with friction, and the 95 % region of critical energy and wear rate
 * of a layer by each method of determination.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "report/drawing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* All groups may have a section in each panel. */
enum { PANELS = 9 };

typedef struct panel_names {
    const char *name[PANELS];
    size_t n;
    bool too_many;
} panel_names;

/* Collects the distinct texts of a column in the order of the table, which is sorted by sample. */
static panel_names find_collection_panels(const table_view *table, unsigned column)
{
    panel_names found = {.n = 0};
    for (size_t row = 0; row < table->n_rows; row++) {
        const char *name = view_text(table, table->schema, row, column);
        bool seen = false;
        for (size_t i = 0; i < found.n && !seen; i++)
            seen = strcmp(found.name[i], name) == 0;
        found.too_many = found.too_many || (!seen && found.n == PANELS);
        if (!seen && found.n < PANELS)
            found.name[found.n++] = name;
    }
    return found;
}

/* Common layout of all figures: adjacent panels with one scale. */
typedef struct panel_grid {
    panel_names of;
    unsigned panel; /* column of the table with the names of the panels */
    bool joined;    /* points with intervals, connected by lines */
    int section[PANELS][DRAWING_GROUPS];
} panel_grid;

/* Column of the panels of each table; the others follow from the description of the figure. */
static const struct {
    const table_schema *table;
    unsigned panel;
} grids[] = {{&collected_modulus_schema, COLLECTED_MODULUS_SAMPLE},
             {&collected_friction_schema, COLLECTED_FRICTION_CONDITION},
             {&collected_force_schema, COLLECTED_FORCE_SAMPLE}};

/* False if there is nothing to draw. */
static bool find_panel_sections(figure_drawing *d, panel_grid *g)
{
    d->x = d->y[0] = EMPTY_SPAN;
    for (size_t i = 0; i < g->of.n; i++)
        for (size_t k = 0; k < d->n_groups; k++) {
            const row_filter rows = {
                {g->panel, d->figure->group}, {g->of.name[i], d->groups[k]}, NULL};
            g->section[i][k] =
                drawing_section(d, d->table, d->groups[k], &rows, d->columns, d->n_columns, 2);
            span_add_section(&d->x, d, g->section[i][k], 0, d->figure->x.scale == AXIS_LOG);
            for (size_t c = 1; c < d->n_columns; c++)
                span_add_section(&d->y[0], d, g->section[i][k], c, g->joined);
        }
    return d->status == WT_OK && !span_is_empty(&d->x) && !span_is_empty(&d->y[0]);
}

/* Sets the size of a figure of n panels. Returns the number of columns. */
static size_t set_grid_size(figure_drawing *d, size_t n, double height)
{
    const size_t columns = n < 3 ? n : n == 4 ? 2 : 3;
    d->width = columns == 1 ? 1 : columns == 2 ? 1.6 : 2;
    d->height = height * (double)((n + columns - 1) / columns);
    return columns;
}

static void begin_grid(figure_drawing *d, const panel_grid *g)
{
    const size_t columns = set_grid_size(d, g->of.n, 0.95),
                 lines = (g->of.n + columns - 1) / columns;
    /* margin for the legend above the first panel, two names in a line; the other panels have the
     * same size */
    text_format(&d->script, "set tmargin %zu\nset key width 1\nset multiplot layout %zu,%zu\n",
                3 + (d->n_groups + 1) / 2, lines, columns);
    drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
    drawing_axis(d, AXIS_Y, &d->figure->y[0], NULL, d->y[0]);
}

/* Draws a panel. The legend of the first panel also lists groups that it does not contain. */
static void draw_collection_panel(figure_drawing *d, const panel_grid *g, size_t i)
{
    if (g->of.name[i][0] != '\0')
        plot_heading(d, g->of.name[i]);
    text_add(&d->script, i == 0 ? "" : "unset key\n");
    for (size_t k = 0; k < d->n_groups; k++) {
        const int section = g->section[i][k];
        if (section < 0 && i > 0)
            continue;
        if (section < 0)
            plot_expression(d, g->joined ? "NaN with yerrorlines ls %zu" : "NaN with lines ls %zu",
                            k + 1);
        else if (g->joined)
            plot_item(d, section,
                      "($1*x_unit):($2*y_unit):($3*y_unit):($4*y_unit) with yerrorlines ls %zu",
                      k + 1);
        else
            plot_item(d, section, "($1*x_unit):($2*y_unit) with %s ls %zu",
                      drawing_row_count(d, section) > 1 ? "lines" : "points", k + 1);
        if (i == 0)
            plot_title(d, d->groups[k]);
        else
            text_add(&d->script, " notitle");
    }
    plot_end(d);
}

static void draw_grid(figure_drawing *d)
{
    panel_grid g = {.joined = d->n_columns > 2};
    for (size_t i = 0; i < COUNT_OF(grids); i++)
        g.panel = grids[i].table == d->table->schema ? grids[i].panel : g.panel;
    g.of = find_collection_panels(d->table, g.panel);
    if (!find_panel_sections(d, &g))
        return;
    begin_grid(d, &g);
    for (size_t i = 0; i < g.of.n; i++)
        draw_collection_panel(d, &g, i);
    text_add(&d->script, "unset multiplot\n");
    if (g.of.too_many)
        text_format(&d->caption, " The first %d only.", PANELS);
}

/* The upper panel shows the storage modulus, the lower panel the loss modulus. */
static void draw_ramps(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    const char letter =
        modulus_letter(collected_ramp_key_enum(d->table, COLLECTED_RAMP_KEY_DEFORMATION));
    d->height = 1.6;
    text_format(&d->script, "set tmargin %zu\nset multiplot layout 2,1\n",
                1 + (d->n_groups + 1) / 2);
    for (size_t panel = 0; panel < FIGURE_PANELS; panel++) {
        char label[64];
        (void)snprintf(label, sizeof label, "%s modulus %c%s", panel == 0 ? "Storage" : "Loss",
                       letter, panel == 0 ? "′" : "″");
        drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
        drawing_axis(d, AXIS_Y, &d->figure->y[panel], label, d->y[panel]);
        for (size_t k = 0; k < d->n_groups; k++) {
            plot_item(d, d->data[k], "($1+x_offset):($%zu*y_unit) with linespoints ls %zu",
                      panel + 2, k + 1);
            plot_title(d, d->groups[k]);
        }
        plot_end(d);
        text_add(&d->script, "unset key\n");
    }
    text_add(&d->script, "unset multiplot\n");
}

static void caption_collected_friction(figure_drawing *d)
{
    if (collected_friction_key_enum(d->table, COLLECTED_FRICTION_KEY_PART) == HYSTERESIS_ALONE)
        text_add(&d->caption, " Of hysteresis alone: not all cases have a shear stress.");
}

const figure_description figures_collection[] = {
    {.name = "collected_modulus",
     .title = "Modulus of bulk and wear tracks against the indentation rate",
     .table = &collected_modulus_schema,
     .by_group = true,
     .group = COLLECTED_MODULUS_PLACE,
     .x = {COLLECTED_MODULUS_RATE, AXIS_LOG, "Indentation rate"},
     .y = {{COLLECTED_MODULUS_MODULUS, AXIS_LOG, "Modulus E"}},
     .curves = {CURVE(COLLECTED_MODULUS_MODULUS, OWN, .with_errors = true)},
     .empty_reason = "no case has moduli at known indentation rates",
     .caption_text =
         "Geometric mean of the modulus at each indentation rate, a panel for each sample "
         "(bars: 95 % intervals, with what is stated of cantilevers and tips).",
     .draw = draw_grid},
    {.name = "collected_friction",
     .title = "Friction of all samples against velocity",
     .table = &collected_friction_schema,
     .by_group = true,
     .group = COLLECTED_FRICTION_SAMPLE,
     .x = {COLLECTED_FRICTION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{COLLECTED_FRICTION_FRICTION, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(COLLECTED_FRICTION_FRICTION, OWN)},
     .empty_reason = "no case has friction",
     .caption_text =
         "Friction coefficient of every sample without the modified layer, a panel for each "
         "condition.",
     .draw = draw_grid,
     .caption = caption_collected_friction},
    {.name = "collected_area",
     .title = "Contact area of all samples against velocity",
     .table = &collected_friction_schema,
     .by_group = true,
     .group = COLLECTED_FRICTION_SAMPLE,
     .x = {COLLECTED_FRICTION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{COLLECTED_FRICTION_AREA_RATIO, AXIS_FROM_ZERO, "Contact area A/A₀"}},
     .curves = {CURVE(COLLECTED_FRICTION_AREA_RATIO, OWN)},
     .empty_reason = "no case has a contact area",
     .caption_text =
         "Real over nominal contact area of every sample without the modified layer, a panel for "
         "each condition.",
     .draw = draw_grid},
    {.name = "collected_ramp",
     .title = "Moduli of all samples against temperature",
     .table = &collected_ramp_schema,
     .by_group = true,
     .group = COLLECTED_RAMP_SAMPLE,
     .x = {COLLECTED_RAMP_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{COLLECTED_RAMP_STORAGE_MODULUS, AXIS_LOG, "Storage modulus"},
           {COLLECTED_RAMP_LOSS_MODULUS, AXIS_LOG, "Loss modulus"}},
     .curves = {CURVE(COLLECTED_RAMP_STORAGE_MODULUS, OWN),
                CURVE(COLLECTED_RAMP_LOSS_MODULUS, OWN, .panel = 1)},
     .empty_reason = "no modulus above zero at any temperature",
     .caption_text =
         "Storage and loss modulus of every sample against temperature, at frequencies as near to "
         "each other as their sweeps have them.",
     .draw = draw_ramps},
    {.name = "collected_force",
     .title = "Force against indentation of bulk, wear tracks and other groups",
     .table = &collected_force_schema,
     .by_group = true,
     .group = COLLECTED_FORCE_PLACE,
     .x = {COLLECTED_FORCE_INDENTATION, AXIS_LINEAR, "Indentation"},
     .y = {{COLLECTED_FORCE_FORCE, AXIS_LINEAR, "Force"}},
     .curves = {CURVE(COLLECTED_FORCE_FORCE, OWN)},
     .empty_reason = "no case has a force curve",
     .caption_text =
         "Loading part of the curve with the median modulus of each group, counted from its "
         "contact point, a panel for each sample.",
     .draw = draw_grid},
    {.name = NULL},
};

/* ---- critical energy and wear rate ----------------------------------------------------------- */

/* Radius that contains 95 % of a bivariate normal distribution: sqrt(-2 ln 0.05). */
static const double radius_95 = 2.4477;
/* Points of a region. */
enum { POINTS = 73 };

/* Adds the points of the joint region. NO_SECTION if there is none. */
static int add_region(figure_drawing *d, size_t row, const char *name)
{
    static const char *const columns[] = {"critical_energy", "specific_wear_rate", NULL},
                             *const units[] = {"J/m^3", "m^2/N", NULL};
    const table_view *const t = d->table;
    double points[2 * POINTS];
    const double energy = identification_get(t, row, IDENTIFICATION_ENERGY),
                 wear = identification_get(t, row, IDENTIFICATION_WEAR),
                 of_energy = radius_95 *
                             identification_get(t, row, IDENTIFICATION_ENERGY_STANDARD_ERROR) /
                             energy,
                 of_wear = radius_95 *
                           identification_get(t, row, IDENTIFICATION_WEAR_STANDARD_ERROR) / wear,
                 correlation = identification_get(t, row, IDENTIFICATION_CORRELATION),
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

/* Draws the region of each method, which has one row. */
static void draw_regions(figure_drawing *d)
{
    static const char *const names[] = {[BY_WEAR] = "wear rate",
                                        [BY_RATES] = "balance of rates",
                                        [BY_TRANSPORT] = "transport of damage"};
    int section[COUNT_OF(names)];
    for (size_t k = 0; k < COUNT_OF(names); k++)
        section[k] = NO_SECTION;
    d->x = d->y[0] = EMPTY_SPAN;
    for (size_t row = 0; row < d->table->n_rows && d->status == WT_OK; row++) {
        const int by = identification_enum(d->table, row, IDENTIFICATION_BY);
        if (by > BY_TRANSPORT)
            continue;
        section[by] = add_region(d, row, names[by]);
        span_add_section(&d->x, d, section[by], 0, true);
        span_add_section(&d->y[0], d, section[by], 1, true);
    }
    if (d->status != WT_OK || span_is_empty(&d->x))
        return;
    drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
    drawing_axis(d, AXIS_Y, &d->figure->y[0], NULL, d->y[0]);
    for (size_t k = 0, shown = 0; k < COUNT_OF(names); k++)
        if (section[k] != NO_SECTION) {
            plot_item(d, section[k], "($1*x_unit):($2*y_unit) with lines ls %zu", ++shown);
            plot_title(d, names[k]);
        }
    plot_end(d);
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
         "Regions that contain critical energy and specific wear rate together in 95 %, for "
         "each combination of known data of the layer. A long and narrow region is well "
         "determined across and hardly along its axis.",
     .draw = draw_regions},
    {.name = NULL},
};
