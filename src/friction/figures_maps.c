/* Figures of friction maps: temperature collapse, maps over temperature and pressure, contribution
 * by decade of the wavenumber, sliding direction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative width of a figure with a colour bar, as in the figure engine. */
static const double width_with_colour_bar = 1.15;

/* ---- several temperatures -------------------------------------------------------------------- */

/* Returns the column of the total friction if it has values, else the column of the hysteresis
 * friction. */
static unsigned displayed_friction_column(const table_view *table)
{
    value_span total = EMPTY_SPAN;
    span_add_column(&total, table, FRICTION_MAP_TOTAL, false);
    return span_is_empty(&total) ? FRICTION_MAP_HYSTERESIS : FRICTION_MAP_TOTAL;
}

static const char *friction_label(unsigned column)
{
    return column == FRICTION_MAP_TOTAL ? "Friction coefficient μ"
                                        : "Hysteresis friction coefficient";
}

/* Adds the rows of the temperatures or of the pressures as a section. */
static int add_map_section(figure_drawing *d, const char *against, const unsigned *columns,
                           size_t n)
{
    const row_filter rows = {{FRICTION_MAP_AGAINST, 0}, {against, NULL}, NULL};
    return drawing_section(d, d->table, against, &rows, columns, n, n);
}

/* Columns of a section: velocity, reduced velocity, friction, and the value that sets the line
 * colour. */
enum { AT_VELOCITY = 1, AT_REDUCED, AT_FRICTION, AT_COLOUR };

static void draw_coloured_lines(figure_drawing *d, int section, int x, const char *label,
                                const schema_field *field)
{
    value_span span = EMPTY_SPAN;
    span_add_section(&span, d, section, (size_t)x - 1, true);
    axis_log(d, "x", label, field, span);
    plot_item(d, section,
              "($%d*x_unit):%d:($%d*cb_unit+cb_offset) with lines lw 1.8 lc palette notitle", x,
              AT_FRICTION, AT_COLOUR);
    plot_end(d);
}

static void draw_collapse(figure_drawing *d)
{
    const unsigned friction = displayed_friction_column(d->table);
    const unsigned columns[] = {FRICTION_MAP_VELOCITY, FRICTION_MAP_REDUCED_VELOCITY, friction,
                                FRICTION_MAP_TEMPERATURE};
    const schema_field *field = d->table->schema->columns;
    const int section = add_map_section(d, "temperature", columns, COUNT_OF(columns));
    value_span height = EMPTY_SPAN, colour = EMPTY_SPAN;
    if (section < 0)
        return;
    span_add(&height, 0, false);
    span_add_section(&height, d, section, AT_FRICTION - 1, false);
    span_add_section(&colour, d, section, AT_COLOUR - 1, false);
    d->width = width_with_colour_bar;
    d->height = 1.7;
    axis_linear(d, "cb", "Temperature", &field[FRICTION_MAP_TEMPERATURE], colour);
    text_add(&d->script, "set cblabel offset 1.5,0\nset multiplot layout 2,1\nunset key\n");
    axis_linear(d, "y", friction_label(friction), &field[friction], height);
    draw_coloured_lines(d, section, AT_VELOCITY, "Sliding velocity v",
                        &field[FRICTION_MAP_VELOCITY]);
    draw_coloured_lines(d, section, AT_REDUCED, "Reduced velocity v a_T",
                        &field[FRICTION_MAP_REDUCED_VELOCITY]);
    text_add(&d->script, "unset multiplot\n");
}

static void caption_collapse(figure_drawing *d)
{
    text_format(
        &d->caption, " Nominal pressure %s; a_T is 1 at %s.",
        VALUE(WT_Q_PRESSURE, NULL, friction_map_value(d->table, FRICTION_MAP_KEY_PRESSURE).value),
        VALUE(WT_Q_TEMPERATURE, NULL,
              friction_map_value(d->table, FRICTION_MAP_KEY_REFERENCE_TEMPERATURE).value));
    const char *extrapolation_note =
        friction_map_key_text(d->table, FRICTION_MAP_KEY_MATERIAL_STATEMENT);
    if (extrapolation_note != NULL && extrapolation_note[0] != '\0')
        text_format(&d->caption, " Note: %s.", extrapolation_note);
}

/* ---- maps ------------------------------------------------------------------------------------ */

/* A cell of the map is a box whose edges lie midway between its position and the neighbours. */
enum { BOX_FROM_X, BOX_TO_X, BOX_FROM_Y, BOX_TO_Y, BOX_VALUE, BOX_COLUMNS };
static const char *const box_names[] = {"velocity_from", "velocity_to", "from", "to",
                                        "value",         NULL};

typedef struct map_axis {
    unsigned column;
    bool is_log;
    const char *label;
} map_axis;

static double midpoint(double a, double b, bool is_log)
{
    return is_log ? sqrt(a * b) : 0.5 * (a + b);
}

/* Edge of a box towards a neighbour. A box at the border of the map is symmetric about its
 * position. */
static double box_edge(double here, double neighbour, double other, bool is_log)
{
    if (isfinite(neighbour))
        return midpoint(here, neighbour, is_log);
    const double end = midpoint(here, other, is_log);
    return is_log ? here * here / end : 2 * here - end;
}

/* Value of the same column `step` rows away; NaN if that row belongs to another map. With
 * `in_block` it must also belong to the same block of velocities. */
static double neighbour_value(const table_view *t, size_t row, long step, unsigned column,
                              bool in_block)
{
    const long there = (long)row + step;
    if (there < 0 || there >= (long)t->n_rows ||
        strcmp(friction_map_text(t, row, FRICTION_MAP_AGAINST),
               friction_map_text(t, (size_t)there, FRICTION_MAP_AGAINST)) != 0 ||
        (in_block && wt_table_block(t->table, row) != wt_table_block(t->table, (size_t)there)))
        return (double)NAN;
    return view_number(t, t->schema, (size_t)there, column);
}

/* Returns the number of rows of a block, which is the number of velocities. */
static size_t block_length(const table_view *t)
{
    size_t n = 1;
    while (n < t->n_rows && wt_table_block(t->table, n) == wt_table_block(t->table, 0))
        n++;
    return n;
}

static void fill_box(const table_view *t, size_t row, const map_axis *up, unsigned friction,
                     double box[BOX_COLUMNS])
{
    const long velocities = (long)block_length(t);
    const double x = friction_map_get(t, row, FRICTION_MAP_VELOCITY);
    const double left = neighbour_value(t, row, -1, FRICTION_MAP_VELOCITY, true),
                 right = neighbour_value(t, row, 1, FRICTION_MAP_VELOCITY, true);
    const double y = view_number(t, t->schema, row, up->column);
    const double below = neighbour_value(t, row, -velocities, up->column, false),
                 above = neighbour_value(t, row, velocities, up->column, false);
    box[BOX_FROM_X] = box_edge(x, left, right, true);
    box[BOX_TO_X] = box_edge(x, right, left, true);
    box[BOX_FROM_Y] = box_edge(y, below, above, up->is_log);
    box[BOX_TO_Y] = box_edge(y, above, below, up->is_log);
    box[BOX_VALUE] = view_number(t, t->schema, row, friction);
}

/* Adds the boxes as a section. There is no section if an axis has one position only, for that is no
 * map. */
static int add_box_section(figure_drawing *d, const char *against, const map_axis *up,
                           unsigned friction)
{
    const table_view *t = d->table;
    const schema_field *field = t->schema->columns;
    const char *const speed = schema_unit(&field[FRICTION_MAP_VELOCITY]),
                      *const upward = schema_unit(&field[up->column]);
    const char *const units[] = {speed, speed, upward, upward, "1"};
    double *boxes = wt_alloc(t->n_rows * BOX_COLUMNS, sizeof *boxes);
    size_t n = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        double *box = boxes + n * BOX_COLUMNS;
        if (strcmp(friction_map_text(t, row, FRICTION_MAP_AGAINST), against) != 0)
            continue;
        fill_box(t, row, up, friction, box);
        n += isfinite(box[BOX_TO_X]) && isfinite(box[BOX_TO_Y]) && isfinite(box[BOX_VALUE]);
    }
    const int section = drawing_number_section(d, against, box_names, units, boxes, n);
    free(boxes);
    return section;
}

static void draw_box_map(figure_drawing *d, const char *against, const map_axis *up)
{
    const unsigned friction = displayed_friction_column(d->table);
    const schema_field *field = d->table->schema->columns;
    const int section = add_box_section(d, against, up, friction);
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN, colour = EMPTY_SPAN;
    if (section < 0)
        return;
    for (size_t i = BOX_FROM_X; i <= BOX_TO_X; i++)
        span_add_section(&x, d, section, i, true);
    for (size_t i = BOX_FROM_Y; i <= BOX_TO_Y; i++)
        span_add_section(&y, d, section, i, up->is_log);
    span_add_section(&colour, d, section, BOX_VALUE, false);
    axis_log(d, "x", "Sliding velocity", &field[FRICTION_MAP_VELOCITY], x);
    (up->is_log ? axis_log : axis_linear)(d, "y", up->label, &field[up->column], y);
    axis_linear(d, "cb", friction_label(friction), &field[friction], colour);
    d->width = width_with_colour_bar;
    text_add(&d->script, "set cblabel offset 1.5,0\nunset key\nset border 15\n");
    const char *const offset = up->is_log ? "" : "+y_offset";
    plot_item(d, section,
              "(sqrt($1*$2)*x_unit):(($3+$4)/2*y_unit%s):($1*x_unit):($2*x_unit):($3*y_unit%s):"
              "($4*y_unit%s):5 with boxxyerror fc palette fs solid noborder notitle",
              offset, offset, offset);
    plot_end(d);
}

static void draw_temperature_map(figure_drawing *d)
{
    static const map_axis up = {FRICTION_MAP_TEMPERATURE, false, "Temperature"};
    draw_box_map(d, "temperature", &up);
}

static void draw_pressure_map(figure_drawing *d)
{
    static const map_axis up = {FRICTION_MAP_PRESSURE, true, "Nominal pressure"};
    draw_box_map(d, "pressure", &up);
}

static void caption_pressure_map(figure_drawing *d)
{
    const double temperature = friction_map_value(d->table, FRICTION_MAP_KEY_TEMPERATURE).value;
    if (isfinite(temperature))
        text_format(&d->caption, " Temperature %s.", VALUE(WT_Q_TEMPERATURE, NULL, temperature));
}

/* ---- decades --------------------------------------------------------------------------------- */

/* The table has at most three velocities, one block each. */
enum { MAX_VELOCITIES = 3 };

static size_t list_velocities(const table_view *table, double velocity[MAX_VELOCITIES])
{
    size_t n = 0;
    for (size_t row = 0; row < table->n_rows; row++) {
        const double v = friction_decades_get(table, row, FRICTION_DECADES_VELOCITY);
        if ((n == 0 || v != velocity[n - 1]) && n < MAX_VELOCITIES)
            velocity[n++] = v;
    }
    return n;
}

static void draw_decades(figure_drawing *d)
{
    static const unsigned columns[] = {FRICTION_DECADES_FROM, FRICTION_DECADES_TO,
                                       FRICTION_DECADES_HYSTERESIS, FRICTION_DECADES_VELOCITY};
    const schema_field *field = d->table->schema->columns;
    double velocity[MAX_VELOCITIES];
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN;
    const size_t n = list_velocities(d->table, velocity);
    const int section = drawing_section(d, d->table, "decades", NULL, columns, COUNT_OF(columns),
                                        COUNT_OF(columns));
    if (section < 0)
        return;
    span_add_section(&x, d, section, 0, true);
    span_add_section(&x, d, section, 1, true);
    span_add(&y, 0, false);
    span_add_section(&y, d, section, 2, false);
    axis_log(d, "x", "Wavenumber q", &field[FRICTION_DECADES_FROM], x);
    axis_linear(d, "y", "Hysteresis friction by the decade", &field[FRICTION_DECADES_HYSTERESIS],
                y);
    for (size_t k = 0; k < n; k++) {
        char title[48];
        wt_format_si(velocity[k], "m/s", 2, title, sizeof title);
        /* bars within a decade: from the first velocity on the left to the last on the right */
        plot_item(
            d, section,
            "(column(-1) == %zu ? sqrt($1*$2)*x_unit : NaN):($3/2):"
            "($1*($2/$1)**%.3f*x_unit):($1*($2/$1)**%.3f*x_unit):(0):3 with boxxyerror ls %zu "
            "fs solid 0.8 noborder",
            k, ((double)k + 0.1) / (double)n, ((double)k + 0.9) / (double)n, 21 + k);
        plot_title(d, title);
    }
    plot_end(d);
}

static void caption_decades(figure_drawing *d)
{
    text_format(&d->caption, " The most: %s.",
                friction_decades_key_text(d->table, FRICTION_DECADES_KEY_STRONGEST));
}

/* ---- direction of sliding -------------------------------------------------------------------- */

static void caption_anisotropy(figure_drawing *d)
{
    text_format(&d->caption,
                " Power spectrum over its mean at an angle phi from the velocity: 1 + "
                "%s. %s.",
                anisotropy_key_text(d->table, ANISOTROPY_KEY_TEXTURE),
                anisotropy_key_text(d->table, ANISOTROPY_KEY_EFFECT));
}

const figure_description figures_friction_maps[] = {
    {.name = "friction_collapse",
     .title = "Friction at several temperatures",
     .table = &friction_map_schema,
     .caption_text =
         "Friction against sliding velocity at each temperature and, below, against the "
         "velocity times the shift factor a_T of the material: where moduli follow "
         "time-temperature superposition without a vertical shift, the hysteresis friction of "
         "all temperatures is one curve.",
     .draw = draw_collapse,
     .caption = caption_collapse},
    {.name = "friction_temperature_map",
     .title = "Friction over velocity and temperature",
     .table = &friction_map_schema,
     .caption_text = "Friction coefficient over sliding velocity and temperature of the rubber.",
     .draw = draw_temperature_map,
     .caption = caption_collapse},
    {.name = "friction_pressure_map",
     .title = "Friction over velocity and pressure",
     .table = &friction_map_schema,
     .caption_text = "Friction coefficient over sliding velocity and nominal pressure.",
     .draw = draw_pressure_map,
     .caption = caption_pressure_map},
    {.name = "friction_decades",
     .title = "Which decades of the wavenumber make the friction",
     .table = &friction_decades_schema,
     .empty_reason = "no hysteresis friction of a decade is a number",
     .caption_text =
         "What the roughness of each decade of the wavenumber makes of the hysteresis friction "
         "coefficient, at the slowest, the reference and the fastest velocity. The first and "
         "the last decade may be cut by the ends of the power spectrum.",
     .draw = draw_decades,
     .caption = caption_decades},
    {.name = "anisotropy",
     .title = "What the direction of sliding does",
     .table = &anisotropy_schema,
     .data_title = "hysteresis",
     .x = {ANISOTROPY_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{ANISOTROPY_HYSTERESIS, AXIS_FROM_ZERO, "Hysteresis friction coefficient"}},
     .curves = {CURVE(ANISOTROPY_HYSTERESIS, LINE, .style = 21, .title = "against the velocity"),
                CURVE(ANISOTROPY_SIDE, LINE, .style = 22, .title = "to the side"),
                CURVE(ANISOTROPY_HYSTERESIS_WITHOUT, LINE, .style = 24,
                      .title = "the same roughness in all directions")},
     .empty_reason = "no hysteresis friction is a number",
     .caption_text =
         "Hysteresis part of the friction coefficient against sliding velocity on roughness "
         "with a preferred direction, the force to its side over the load, and the friction "
         "on roughness that is the same in all directions.",
     .caption = caption_anisotropy},
    {.name = NULL},
};
