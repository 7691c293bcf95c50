/* Figures of collected cases: a panel per sample with moduli against the rate and with force
 * curves, a panel per condition with friction, a line per value of a shared constant, and the 95 %
 * region of critical energy and wear rate by each method of determination.
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
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
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
        drawing_axis(d, "x", &d->figure->x, NULL, d->x);
        drawing_axis(d, "y", &d->figure->y[panel], label, d->y[panel]);
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

/* ---- shared constants ------------------------------------------------------------------------ */

/* Rows of one constant and one name, below a line with both. */
typedef struct constant_block {
    const char *constant, *of;
    int section;
    size_t line; /* of the heading */
} constant_block;

/* Lines of the figure, and sizes in parts of a panel of the style. */
enum { CONSTANT_LINES = 120, CONSTANT_BLOCKS = 30 };
static const double line_height = 0.05, axis_height = 0.25;

typedef struct constant_blocks {
    constant_block of[CONSTANT_BLOCKS];
    size_t n, lines;
    bool too_many;
} constant_blocks;

static void find_constants(figure_drawing *d, constant_blocks *b)
{
    static const unsigned data[] = {SHARED_MEMBERS_NUMBER, SHARED_MEMBERS_RATIO,
                                    SHARED_MEMBERS_RATIO_LOW, SHARED_MEMBERS_RATIO_HIGH};
    for (size_t row = 0; row < d->table->n_rows; row++) {
        const char *constant = shared_members_text(d->table, row, SHARED_MEMBERS_CONSTANT),
                   *of = shared_members_text(d->table, row, SHARED_MEMBERS_OF);
        bool seen = false;
        for (size_t i = 0; i < b->n && !seen; i++)
            seen = strcmp(b->of[i].constant, constant) == 0 && strcmp(b->of[i].of, of) == 0;
        b->too_many =
            b->too_many || (!seen && (b->n == CONSTANT_BLOCKS || b->lines > CONSTANT_LINES));
        if (seen || b->too_many)
            continue;
        const row_filter rows = {
            {SHARED_MEMBERS_CONSTANT, SHARED_MEMBERS_OF}, {constant, of}, NULL};
        const int section = drawing_section(d, d->table, constant, &rows, data, 4, 2);
        for (size_t c = 1; c < 4; c++)
            span_add_section(&d->y[0], d, section, c, true);
        b->of[b->n++] = (constant_block){constant, of, section, b->lines};
        b->lines += 1 + (section == NO_SECTION ? 0 : drawing_row_count(d, section));
    }
}

/* Longest name of a member [bytes]. */
enum { NAME = 32 };

/* Writes the names of the members beside their lines and the heading above them, and the mark of
 * the shared value. */
static void draw_names(figure_drawing *d, const constant_blocks *b, size_t i)
{
    const constant_block *block = &b->of[i];
    const size_t next = i + 1 < b->n ? b->of[i + 1].line : b->lines;
    text_buffer heading = {0};
    text_format(&heading, "%s%s%s", block->constant, block->of[0] != '\0' ? ", " : ", all cases",
                block->of);
    text_add(&d->script, "set label ");
    text_quoted(&d->script, text_string(&heading));
    text_format(&d->script,
                " at graph 0.01, first %zu left noenhanced\n"
                "set arrow from x_unit, first %zu.5 to x_unit, first %zu.5 nohead back ls 12\n",
                block->line, block->line, next - 1);
    text_free(&heading);
    for (size_t row = 0; row < d->table->n_rows; row++) {
        if (strcmp(shared_members_text(d->table, row, SHARED_MEMBERS_CONSTANT), block->constant) !=
                0 ||
            strcmp(shared_members_text(d->table, row, SHARED_MEMBERS_OF), block->of) != 0)
            continue;
        text_buffer name = {0};
        text_file_name(&name, shared_members_text(d->table, row, SHARED_MEMBERS_MEMBER), NAME);
        text_add(&d->script, "set ytics add (");
        text_tic_label(&d->script, text_string(&name));
        text_free(&name);
        text_format(&d->script, " %.0f)\n",
                    (double)block->line + shared_members_get(d->table, row, SHARED_MEMBERS_NUMBER));
    }
}

/* One below the other, as the names of cases are long. */
static void draw_constants(figure_drawing *d)
{
    constant_blocks b = {.n = 0};
    d->y[0] = EMPTY_SPAN;
    find_constants(d, &b);
    if (d->status != WT_OK || span_is_empty(&d->y[0]))
        return;
    d->height = axis_height + line_height * (double)b.lines;
    text_format(&d->script,
                "unset key\nunset lmargin\nset ytics () noenhanced scale 0\n"
                "set yrange [%zu.5:-0.8]\n",
                b.lines - 1);
    drawing_axis(d, "x", &d->figure->y[0], NULL, d->y[0]);
    for (size_t i = 0; i < b.n; i++)
        draw_names(d, &b, i);
    for (size_t i = 0; i < b.n; i++) {
        plot_item(d, b.of[i].section,
                  "($2*x_unit):(%zu+$1):($3*x_unit):($4*x_unit) with xerrorbars ls 1",
                  b.of[i].line);
        plot_key(d, NULL);
    }
    plot_end(d);
    if (b.too_many)
        text_format(&d->caption, " The first %zu only.", b.n);
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
    {.name = "shared_constants",
     .title = "Constants that cases may have in common",
     .table = &shared_members_schema,
     .x = {SHARED_MEMBERS_NUMBER, AXIS_NUMBER, "Case"},
     .y = {{SHARED_MEMBERS_RATIO, AXIS_LOG, "Over the shared value"}},
     .curves = {CURVE(SHARED_MEMBERS_RATIO, OWN, .with_errors = true)},
     .empty_reason = "no two cases have the same constant",
     .caption_text =
         "Value of each case over the one that they share, for each constant and what it may be "
         "common to (bars: intervals that hold together in 95 %; dotted: the shared value). "
         "Whether one value suffices is in the table.",
     .draw = draw_constants},
    {.name = NULL},
};

/* ---- critical energy and wear rate ----------------------------------------------------------- */

/* Radius that contains 95 % of a bivariate normal distribution: sqrt(-2 ln 0.05). */
static const double radius_95 = 2.4477;
/* Points of a region, and the largest number of distinguishable regions. */
enum { POINTS = 73, REGIONS = 36, REGION_PANELS = 3 };
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
    const char *by[REGION_PANELS];
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
        new_region.section = r->n < REGIONS && panel < REGION_PANELS
                                 ? add_region(d, row, at, new_region.name)
                                 : NO_SECTION;
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
         "Regions that contain critical energy and specific wear rate together in 95 %, for "
         "each combination of known data of the layer. A long and narrow region is well "
         "determined across and hardly along its axis.",
     .draw = draw_regions},
    {.name = "collected_constants",
     .title = "Critical energy and wear rate of the cases",
     .table = &collected_constants_schema,
     .x = {COLLECTED_CONSTANTS_ENERGY, AXIS_LOG, "Critical energy U_c"},
     .y = {{COLLECTED_CONSTANTS_WEAR, AXIS_LOG, "Specific wear rate k"}},
     .curves = {CURVE(COLLECTED_CONSTANTS_WEAR, LINE)},
     .empty_reason = "no case knows both with an interval",
     .caption_text =
         "Regions that contain critical energy and specific wear rate of a case together in 95 "
         "%, a panel for each way to determine them. The table says whether one pair explains "
         "all of them.",
     .draw = draw_regions,
     .caption = caption_regions},
    {.name = NULL},
};
