/* Figures of a measured surface: its heights, its power spectrum with errors and law, and what of
 * it depends on the direction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- heights --------------------------------------------------------------------------------- */

/* Scans that are drawn, and how many stand side by side. */
enum { MOST_SCANS = 6, SIDE_BY_SIDE = 2 };

/* One scan, whose rows of a table follow one another. */
typedef struct drawn_scan {
    const char *name;
    int section;
    value_span x, y, height;
} drawn_scan;

/* What of a table is drawn: the scan, the columns of the data, the height last. */
typedef struct scan_columns {
    unsigned scan, column[3];
    size_t n;
    const char *names[4];
} scan_columns;

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static const char *name_of(const figure_drawing *d, double scan)
{
    const table_view *surfaces = &d->tables->surfaces;
    const bool known = surfaces->table != NULL && scan >= 1 &&
                       scan < (double)surfaces->n_rows + 1; /* NaN is not */
    return known ? base_name(surfaces_text(surfaces, (size_t)scan - 1, SURFACES_FILE)) : "";
}

/* Rows [row, end) as data of the figure. */
static drawn_scan take_scan(figure_drawing *d, const scan_columns *c, size_t row, size_t end)
{
    static const char *const metres[] = {"m", "m", "m"};
    const table_view *t = d->table;
    const double scan = view_number(t, t->schema, row, c->scan);
    drawn_scan s = {name_of(d, scan), NO_SECTION, SPAN_EMPTY, SPAN_EMPTY, SPAN_EMPTY};
    double *values = malloc((end - row) * c->n * sizeof *values), *to = values;
    if (values == NULL) {
        d->status = wt_fail(d->err, WT_E_MEMORY, "out of memory");
        return s;
    }
    for (size_t i = row; i < end; i++) {
        for (size_t k = 0; k < c->n; k++)
            *to++ = view_number(t, t->schema, i, c->column[k]);
        span_add(&s.x, to[-(long)c->n], false);
        span_add(&s.y, to[1 - (long)c->n], false);
        span_add(&s.height, to[-1], false);
    }
    if (!span_empty(&s.height))
        s.section = drawing_numbers(d, s.name, c->names, metres, values, end - row);
    free(values);
    return s;
}

/* All scans of a table, up to the most. */
static size_t take_scans(figure_drawing *d, const scan_columns *c, drawn_scan scans[MOST_SCANS])
{
    const table_view *t = d->table;
    size_t n = 0, end = 0;
    for (size_t row = 0; row < t->n_rows && n < MOST_SCANS && d->status == WT_OK; row = end) {
        const double scan = view_number(t, t->schema, row, c->scan);
        while (end < t->n_rows && view_number(t, t->schema, end, c->scan) == scan)
            end++;
        if (end == row) /* no number */
            end++;
        scans[n] = take_scan(d, c, row, end);
        n += scans[n].section >= 0 ? 1 : 0;
    }
    if (end < t->n_rows && d->status == WT_OK)
        text_format(&d->caption, " Of more scans the first %zu.", n);
    return d->status == WT_OK ? n : 0;
}

static void begin_panels(figure_drawing *d, size_t n, double height)
{
    const size_t beside = n < SIDE_BY_SIDE ? n : SIDE_BY_SIDE,
                 below = (n + SIDE_BY_SIDE - 1) / SIDE_BY_SIDE;
    d->width = 0.95 * (double)beside;
    d->height = fmax(1, height * (double)below);
    text_format(&d->script, "set border 15\nset multiplot layout %zu,%zu\n", below, beside);
}

/* Below a map: the longest of 1, 2, 5 times a power of ten within a third of its width. */
static void draw_scale_bar(figure_drawing *d, double width)
{
    const double decade = pow(10, floor(log10(width / 3))), times = width / 3 / decade;
    const double bar = decade * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
    text_format(&d->script,
                "set arrow 1 from first 0, graph -0.06 to first %s*x_unit, graph -0.06 nohead lw 3 "
                "front\nset label 1 ",
                LITERAL(bar));
    text_quoted(&d->script, VALUE(WT_Q_LENGTH, NULL, bar));
    text_format(&d->script,
                " at first %s*x_unit, graph -0.06 offset char 1,0 left noenhanced front\n",
                LITERAL(bar));
}

static void draw_map(figure_drawing *d, const drawn_scan *s)
{
    const schema_field *field = height_map_schema.columns;
    axis_linear(d, "x", "x", &field[HEIGHT_MAP_X], s->x);
    axis_linear(d, "y", "y", &field[HEIGHT_MAP_Y], s->y);
    axis_linear(d, "cb", "Height", &field[HEIGHT_MAP_HEIGHT], s->height);
    /* the bar tells the scale */
    text_format(&d->script,
                "set xrange [%s*x_unit:%s*x_unit]\nset yrange [%s*y_unit:%s*y_unit]\n"
                "unset xtics\nunset ytics\nset xlabel ''\nset ylabel ''\n",
                LITERAL(s->x.low), LITERAL(s->x.high), LITERAL(s->y.low), LITERAL(s->y.high));
    draw_scale_bar(d, s->x.high - s->x.low);
    plot_heading(d, s->name);
    plot_item(d, s->section, "($1*x_unit):($2*y_unit):($3*cb_unit) with image notitle");
    plot_end(d);
}

static void draw_maps(figure_drawing *d)
{
    static const scan_columns columns = {HEIGHT_MAP_SCAN,
                                         {HEIGHT_MAP_X, HEIGHT_MAP_Y, HEIGHT_MAP_HEIGHT},
                                         3,
                                         {"x", "y", "height", NULL}};
    drawn_scan scans[MOST_SCANS];
    const size_t n = take_scans(d, &columns, scans);
    if (n == 0)
        return;
    begin_panels(d, n, 1.1);
    text_add(&d->script, "set size ratio -1\nunset key\n");
    for (size_t i = 0; i < n; i++)
        draw_map(d, &scans[i]);
    text_add(&d->script, "unset multiplot\n");
}

static void draw_profiles(figure_drawing *d)
{
    static const scan_columns columns = {
        HEIGHT_PROFILE_SCAN, {HEIGHT_PROFILE_X, HEIGHT_PROFILE_HEIGHT}, 2, {"x", "height", NULL}};
    const schema_field *field = height_profile_schema.columns;
    drawn_scan scans[MOST_SCANS];
    const size_t n = take_scans(d, &columns, scans);
    if (n == 0)
        return;
    begin_panels(d, n, 0.75);
    text_add(&d->script, "unset key\n");
    for (size_t i = 0; i < n; i++) {
        axis_linear(d, "x", "x", &field[HEIGHT_PROFILE_X], scans[i].x);
        axis_linear(d, "y", "Height", &field[HEIGHT_PROFILE_HEIGHT], scans[i].height);
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
                      slope = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_RMS_SLOPE),
                      hurst = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_HURST);
    const double share = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_SHARE).value;
    text_format(&d->caption, " Root-mean-square height %s. Root-mean-square slope %s.",
                ESTIMATE(&height), ESTIMATE(&slope));
    if (isfinite(hurst.value))
        text_format(&d->caption, " Self-affine law: H = %s.", ESTIMATE(&hurst));
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
     .beside = "surfaces",
     .nothing = "no scan has a height",
     .words =
         "Heights of the scans of a surface less their form, every so many points, each on its "
         "own scale of length and colour; white: missing.",
     .draw = draw_maps},
    {.name = "height_profile",
     .title = "Profiles of a measured surface",
     .table = &height_profile_schema,
     .beside = "surfaces",
     .nothing = "no scan has a height",
     .words = "Heights of the scans of a surface less their form along x; of a map the line in its "
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
     .nothing = "no density above zero",
     .words = "Power spectrum of a surface, means over bins with their 95 % intervals, within the "
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
     .nothing = "no direction has a density",
     .words = "Power spectrum of a surface by the direction of its waves over that of all "
              "directions, means over the range where scans are reliable with their 95 % "
              "intervals, and its terms cos 2 phi and cos 4 phi.",
     .caption = caption_angular},
    {.name = NULL},
};
