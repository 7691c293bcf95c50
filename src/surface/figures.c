/* Figures of a measured surface: heights, power spectrum with errors and law, and angular
 * spectrum.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- heights --------------------------------------------------------------------------------- */

/* Maximum number of drawn scans, and panels in a row. */
enum { MOST_SCANS = 6, PANELS_PER_ROW = 2 };

/* One scan; its rows in the table are consecutive. */
typedef struct drawn_scan {
    const char *name;
    int section;
    value_span x, y, height;
    double step_x, step_y; /* step of a map [m] */
} drawn_scan;

static const char *file_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static const char *scan_file_name(const figure_drawing *d, double scan)
{
    const table_view *surfaces = &d->tables->surfaces;
    const bool known = surfaces->table != NULL && scan >= 1 &&
                       scan < (double)surfaces->n_rows + 1; /* false for NaN */
    return known ? file_base_name(surfaces_text(surfaces, (size_t)scan - 1, SURFACES_FILE)) : "";
}

/* Loads rows [row, end) as data of the figure. */
typedef void load_scan_rows(figure_drawing *d, size_t row, size_t end, drawn_scan *to);

/* Loads the scans of a table, up to MOST_SCANS. The column `scan` has the number of the scan. */
static size_t load_scans(figure_drawing *d, unsigned scan, load_scan_rows *load,
                         drawn_scan scans[MOST_SCANS])
{
    const table_view *t = d->table;
    size_t n = 0, end = 0, undrawn = 0;
    for (size_t row = 0; row < t->n_rows && n < MOST_SCANS && d->status == WT_OK; row = end) {
        const double number = view_number(t, t->schema, row, scan);
        while (end < t->n_rows && view_number(t, t->schema, end, scan) == number)
            end++;
        if (end == row) /* the scan number is NaN */
            end++;
        scans[n] = (drawn_scan){.name = scan_file_name(d, number),
                                .section = NO_SECTION,
                                .x = EMPTY_SPAN,
                                .y = EMPTY_SPAN,
                                .height = EMPTY_SPAN};
        load(d, row, end, &scans[n]);
        undrawn += scans[n].section < 0;
        n += scans[n].section >= 0 ? 1 : 0;
    }
    if (undrawn > 0 && n > 0 && d->status == WT_OK)
        text_format(&d->caption,
                    " Not drawn: %zu of the scans, whose points are no grid or have no height.",
                    undrawn);
    if (end < t->n_rows && d->status == WT_OK)
        text_format(&d->caption, " Of more scans the first %zu.", n);
    return d->status == WT_OK ? n : 0;
}

static void begin_scan_panels(figure_drawing *d, size_t n, double height)
{
    const size_t beside = n < PANELS_PER_ROW ? n : PANELS_PER_ROW,
                 below = (n + PANELS_PER_ROW - 1) / PANELS_PER_ROW;
    d->width = 0.95 * (double)beside;
    d->height = fmax(1, height * (double)below);
    text_format(&d->script, "set border 15\nset multiplot layout %zu,%zu\n", below, beside);
}

/* Draws a scale bar below a map: the longest of 1, 2, 5 times a power of ten within a third of
 * its width. */
static void draw_scale_bar(figure_drawing *d, double width)
{
    const double decade = pow(10, floor(log10(width / 3))), times = width / 3 / decade;
    const double bar = decade * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
    text_format(&d->script,
                "set arrow 1 from first 0, graph -0.06 to first %s/step_x, graph -0.06 nohead lw 3 "
                "front\nset label 1 ",
                LITERAL(bar));
    text_quoted(&d->script, VALUE(WT_Q_LENGTH, NULL, bar));
    text_format(&d->script,
                " at first %s/step_x, graph -0.06 offset char 1,0 left noenhanced front\n",
                LITERAL(bar));
}

/* Returns the points in a row of the map that begins at `row`, or 0 if the rows up to `end` are
 * no grid. */
static size_t map_width(const table_view *t, size_t row, size_t end)
{
    size_t nx = 1;
    while (row + nx < end &&
           height_map_get(t, row + nx, HEIGHT_MAP_Y) == height_map_get(t, row, HEIGHT_MAP_Y))
        nx++;
    for (size_t i = row; i < end; i++)
        if (height_map_get(t, i, HEIGHT_MAP_X) !=
                height_map_get(t, row + (i - row) % nx, HEIGHT_MAP_X) ||
            height_map_get(t, i, HEIGHT_MAP_Y) !=
                height_map_get(t, i - (i - row) % nx, HEIGHT_MAP_Y))
            return 0;
    return (end - row) % nx == 0 ? nx : 0;
}

/* Loads a map as a matrix of heights, one row for each row of the map. It needs a third of the
 * space of three numbers for each point. */
static void load_map(figure_drawing *d, size_t row, size_t end, drawn_scan *to)
{
    const table_view *t = d->table;
    const size_t nx = map_width(t, row, end);
    if (nx == 0)
        return;
    for (size_t i = row; i < end; i++) {
        span_add(&to->x, height_map_get(t, i, HEIGHT_MAP_X), false);
        span_add(&to->y, height_map_get(t, i, HEIGHT_MAP_Y), false);
        span_add(&to->height, height_map_get(t, i, HEIGHT_MAP_HEIGHT), false);
    }
    enum { NAME = 24 };
    double *heights = wt_alloc(end - row, sizeof *heights);
    char(*words)[NAME] = wt_alloc(nx, sizeof *words);
    const char **names = wt_alloc(nx + 1, sizeof *names), **units = wt_alloc(nx + 1, sizeof *units);
    const double largest = fmax(fabs(to->height.low), fabs(to->height.high));
    /* A colour scale shows a thousandth of the largest height. DATA_DIGITS of the data removes
     * further decimals. */
    const double step = largest > 0 ? pow(10, floor(log10(largest)) - 3) : 1;
    for (size_t i = row; i < end; i++)
        heights[i - row] = rint(height_map_get(t, i, HEIGHT_MAP_HEIGHT) / step) * step;
    for (size_t i = 0; i < nx; i++) {
        (void)snprintf(words[i], NAME, "h%zu", i + 1);
        names[i] = words[i];
        units[i] = "m";
    }
    to->step_x = (to->x.high - to->x.low) / (double)(nx > 1 ? nx - 1 : 1);
    to->step_y =
        (to->y.high - to->y.low) / (double)((end - row) / nx > 1 ? (end - row) / nx - 1 : 1);
    if (!span_is_empty(&to->height) && to->step_x > 0 && to->step_y > 0)
        to->section = drawing_number_section(d, to->name, names, units, heights, (end - row) / nx);
    free(heights);
    free(words);
    free(names);
    free(units);
}

static void draw_height_map(figure_drawing *d, const drawn_scan *s)
{
    const schema_field *field = height_map_schema.columns;
    axis_linear(d, AXIS_COLOUR, "Height", &field[HEIGHT_MAP_HEIGHT], s->height);
    /* The axes count columns, rows and metres: an expression for each point would take five times
     * as long as the drawing. The tics have the unit, and the bar replaces those of a length. */
    const linear_axis h = axis_choose_linear(d, &field[HEIGHT_MAP_HEIGHT], s->height);
    text_format(&d->script,
                "set cbrange [%s/cb_unit:%s/cb_unit]\nset cbtics ()\n"
                "set for [i=%.0f:%.0f] cbtics add (sprintf('%%g', %s*i) %s*i/cb_unit)\n",
                LITERAL(h.low), LITERAL(h.high), ceil(h.low / h.step), floor(h.high / h.step),
                LITERAL(h.step), LITERAL(h.step));
    text_format(&d->script,
                "step_x = %s; step_y = %s  # m, of the columns and rows of the data\n"
                "set size ratio -step_y/step_x\n"
                "set xrange [0:%s/step_x]\nset yrange [0:%s/step_y]\n",
                LITERAL(s->step_x), LITERAL(s->step_y), LITERAL(s->x.high - s->x.low),
                LITERAL(s->y.high - s->y.low));
    draw_scale_bar(d, s->x.high - s->x.low);
    plot_heading(d, s->name);
    plot_expression(d, "'%s.tsv' index %d matrix using 1:2:3 with image notitle", d->figure->name,
                    s->section);
    plot_end(d);
}

static void draw_height_maps(figure_drawing *d)
{
    drawn_scan scans[MOST_SCANS];
    const size_t n = load_scans(d, HEIGHT_MAP_SCAN, load_map, scans);
    if (n == 0)
        return;
    begin_scan_panels(d, n, 1);
    text_add(&d->script, "set bmargin 2.2\nunset key\nunset xtics\nunset ytics\n");
    for (size_t i = 0; i < n; i++)
        draw_height_map(d, &scans[i]);
    text_add(&d->script, "unset multiplot\n");
}

static void load_profile(figure_drawing *d, size_t row, size_t end, drawn_scan *to)
{
    static const char *const names[] = {"x", "height", NULL}, *const metres[] = {"m", "m"};
    double *values = wt_alloc((end - row) * 2, sizeof *values), *value = values;
    for (size_t i = row; i < end; i++) {
        *value++ = height_profile_get(d->table, i, HEIGHT_PROFILE_X);
        *value++ = height_profile_get(d->table, i, HEIGHT_PROFILE_HEIGHT);
        span_add(&to->x, value[-2], false);
        span_add(&to->height, value[-1], false);
    }
    if (!span_is_empty(&to->height))
        to->section = drawing_number_section(d, to->name, names, metres, values, end - row);
    free(values);
}

static void draw_profiles(figure_drawing *d)
{
    const schema_field *field = height_profile_schema.columns;
    drawn_scan scans[MOST_SCANS];
    const size_t n = load_scans(d, HEIGHT_PROFILE_SCAN, load_profile, scans);
    if (n == 0)
        return;
    begin_scan_panels(d, n, 0.75);
    text_add(&d->script, "unset key\n");
    for (size_t i = 0; i < n; i++) {
        axis_linear(d, AXIS_X, "x", &field[HEIGHT_PROFILE_X], scans[i].x);
        axis_linear(d, AXIS_Y, "Height", &field[HEIGHT_PROFILE_HEIGHT], scans[i].height);
        plot_heading(d, scans[i].name);
        plot_item(d, scans[i].section, "($1*x_unit):($2*y_unit) with lines ls 21 notitle");
        plot_end(d);
    }
    text_add(&d->script, "unset multiplot\n");
}

/* ---- spectra --------------------------------------------------------------------------------- */

static void caption_measured(figure_drawing *d)
{
    const wt_estimate height = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_RMS_HEIGHT),
                      slope = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_RMS_SLOPE);
    const row_number hurst = rows_of_keys(d->table, POWER_SPECTRUM_KEY_HURST);
    const double share = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_SHARE).value;
    const char *const law = power_spectrum_key_text(d->table, POWER_SPECTRUM_KEY_LAW);
    text_format(&d->caption, " Root-mean-square height %s. Root-mean-square slope %s.",
                ESTIMATE(&height), ESTIMATE(&slope));
    if (isfinite(hurst.value))
        text_format(&d->caption, " Self-affine law: H = %s%s%s.", format_display_row(hurst).chars,
                    law != NULL ? ", " : "", law != NULL ? law : "");
    if (isfinite(share))
        text_format(&d->caption,
                    " Beyond the points with bars the spectrum is that of the law: %s %% of the "
                    "squared slope.",
                    NUMBER(100 * share, 2));
}

static void caption_angular(figure_drawing *d)
{
    const double chance = angular_spectrum_value(d->table, ANGULAR_SPECTRUM_KEY_CHANCE).value,
                 fourth =
                     angular_spectrum_value(d->table, ANGULAR_SPECTRUM_KEY_CHANCE_FOURTH).value;
    text_format(&d->caption,
                " Chance that scatter alone makes directions differ as much: %s (half a turn), %s "
                "(a quarter).",
                NUMBER(chance, 2), NUMBER(fourth, 2));
}

const figure_description figures_surface[] = {
    {.name = "height_map",
     .title = "Heights of a measured surface",
     .table = &height_map_schema,
     .other_tables = "surfaces",
     .empty_reason = "no scan has a height",
     .caption_text =
         "Heights of the scans of a surface less their form, every so many points, each on its "
         "own scale of length and colour; white: missing. Its data are heights to a thousandth of "
         "the largest one, a row for a row of the map.",
     .draw = draw_height_maps},
    {.name = "height_profile",
     .title = "Profiles of a measured surface",
     .table = &height_profile_schema,
     .other_tables = "surfaces",
     .empty_reason = "no scan has a height",
     .caption_text =
         "Heights of the scans of a surface less their form along x; of a map the line in its "
         "middle.",
     .draw = draw_profiles},
    {.name = "measured_spectrum",
     .title = "Power spectrum of a measured surface",
     .table = &power_spectrum_schema,
     .data_title = "measured spectrum",
     .x = {POWER_SPECTRUM_WAVENUMBER, AXIS_LOG, "Wavenumber q"},
     .y = {{POWER_SPECTRUM_DENSITY, AXIS_LOG, "Power spectrum C(q)"}},
     .curves = {CURVE(POWER_SPECTRUM_DENSITY, BARS, .style = 1, .title = "measured",
                      .with_errors = true),
                CURVE(POWER_SPECTRUM_LAW, FIT, .style = 11, .title = "self-affine law")},
     .empty_reason = "no density above zero",
     .caption_text =
         "Power spectrum of a surface, means over bins with their 95 % intervals, within the "
         "range where scans are reliable.",
     .caption = caption_measured},
    {.name = "angular_spectrum",
     .title = "Angular spectrum of a measured surface",
     .table = &angular_spectrum_schema,
     .data_title = "angular spectrum",
     .x = {ANGULAR_SPECTRUM_DIRECTION, AXIS_LINEAR, "Direction from x"},
     .y = {{ANGULAR_SPECTRUM_RATIO, AXIS_FROM_ZERO, "C(q) over that of all directions"}},
     .curves = {CURVE(ANGULAR_SPECTRUM_RATIO, BARS, .style = 1, .title = "measured",
                      .with_errors = true),
                CURVE(ANGULAR_SPECTRUM_TERMS, FIT, .style = 11, .title = "two terms")},
     .empty_reason = "no direction has a density",
     .caption_text = "Power spectrum of a surface by the direction of its waves over that of all "
                     "directions, means over the range where scans are reliable with their 95 % "
                     "intervals, and its terms cos 2 phi and cos 4 phi.",
     .caption = caption_angular},
    {.name = NULL},
};
