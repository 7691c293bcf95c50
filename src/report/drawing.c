/* Data of one figure under construction, and its axes: ranges, round tics and conversion to display
 * units.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool drawing_is_wide(const figure_drawing *d)
{
    return d->width > 1.2;
}

size_t drawing_panels(figure_drawing *d, size_t n, size_t columns, double width, double height)
{
    columns = d->stacked ? 1 : columns < n ? columns : n;
    d->width = d->stacked ? 1 : width * (double)columns;
    d->height = height * (double)((n + columns - 1) / columns);
    return columns;
}

int drawing_group_style(const figure_drawing *d, size_t i)
{
    if (!d->figure->by_group)
        return 0;
    if (strcmp(d->groups[i], "bulk") == 0)
        return 1;
    if (strcmp(d->groups[i], "track") == 0)
        return 2;
    return i < 2 ? 3 + (int)i : 1 + (int)i;
}

/* ---- sections -------------------------------------------------------------------------------- */

static bool row_matches(const table_view *table, size_t row, const row_filter *rows)
{
    for (int i = 0; rows != NULL && i < 2; i++)
        if (rows->text[i] != NULL &&
            strcmp(view_text(table, table->schema, row, rows->column[i]), rows->text[i]) != 0)
            return false;
    return rows == NULL || rows->accepts == NULL || rows->accepts(table, row);
}

/* Creates a section table with the name of the figure and a number. */
static wt_table *create_section(figure_drawing *d, const char *title)
{
    char name[96];
    (void)snprintf(name, sizeof name, "%s/%zu", d->figure->name, d->n_sections);
    return wt_table_new(name, title);
}

/* Stores a section with data and returns its index; else frees it and returns NO_SECTION. */
static int store_data_section(figure_drawing *d, wt_table *section, bool any)
{
    if (d->status == WT_OK && any && d->n_sections == DRAWING_SECTIONS)
        d->status = wt_fail(d->err, WT_E_INTERNAL, "figure %s has too many parts", d->figure->name);
    if (d->status == WT_OK && any) {
        d->sections[d->n_sections] = section;
        return (int)d->n_sections++;
    }
    wt_table_free(section);
    return NO_SECTION;
}

int drawing_section(figure_drawing *d, const table_view *table, const char *title,
                    const row_filter *rows, const unsigned *columns, size_t n_columns,
                    size_t needed)
{
    size_t last_block = 0;
    bool any = false, first = true;
    if (d->status != WT_OK)
        return NO_SECTION;
    wt_table *section = create_section(d, title);
    for (size_t i = 0; i < n_columns && d->status == WT_OK; i++) {
        const schema_field *column = &table->schema->columns[columns[i]];
        d->status = wt_table_add_column(section, column->name, schema_unit(column),
                                        column->long_name, d->err);
    }
    for (size_t row = 0; row < table->n_rows && d->status == WT_OK; row++) {
        if (!row_matches(table, row, rows))
            continue;
        size_t block = wt_table_block(table->table, row);
        if (!first && block != last_block)
            wt_table_new_block(section);
        d->status = wt_table_add_row(section, d->err);
        if (d->status != WT_OK)
            break;
        first = false;
        last_block = block;
        bool complete = true;
        for (size_t i = 0; i < n_columns; i++) {
            double value = view_number(table, table->schema, row, columns[i]);
            // An infinite value cannot be drawn.
            wt_table_set_number(
                section, i, isfinite(value) ? number_to_digits(value, DATA_DIGITS) : (double)NAN);
            complete = complete && (i >= needed || isfinite(value));
        }
        any = any || complete;
    }
    return store_data_section(d, section, any);
}

int drawing_number_section(figure_drawing *d, const char *title, const char *const *columns,
                           const char *const *units, const double *values, size_t n_rows)
{
    if (d->status != WT_OK || n_rows == 0)
        return NO_SECTION;
    wt_table *section = create_section(d, title);
    for (size_t i = 0; d->status == WT_OK && columns[i] != NULL; i++)
        d->status = wt_table_add_column(section, columns[i], units[i], "", d->err);
    for (size_t row = 0; d->status == WT_OK && row < n_rows; row++) {
        d->status = wt_table_add_row(section, d->err);
        for (size_t i = 0; d->status == WT_OK && columns[i] != NULL; i++)
            wt_table_set_number(section, i, number_to_digits(*values++, DATA_DIGITS));
    }
    return store_data_section(d, section, true);
}

size_t drawing_row_count(const figure_drawing *d, int section)
{
    return section < 0 ? 0 : wt_table_n_rows(d->sections[section]);
}

size_t drawing_stride(const figure_drawing *d, int section, size_t limit)
{
    size_t rows = drawing_row_count(d, section);
    return rows <= limit ? 1 : (rows + limit - 1) / limit;
}

size_t drawing_max_stride(const figure_drawing *d, size_t limit)
{
    size_t most = 1;
    for (size_t i = 0; i < d->n_groups; i++) {
        size_t every = drawing_stride(d, d->data[i], limit);
        most = every > most ? every : most;
    }
    return most;
}

static void begin_plot_item(figure_drawing *d)
{
    text_add(&d->script, d->n_items++ == 0 ? "plot \\\n  " : ", \\\n  ");
}

void plot_item(figure_drawing *d, int section, const char *format, ...)
{
    if (section < 0)
        return;
    begin_plot_item(d);
    text_format(&d->script, "'%s.tsv' index %d using ", d->figure->name, section);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_expression(figure_drawing *d, const char *format, ...)
{
    begin_plot_item(d);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_title(figure_drawing *d, const char *title)
{
    text_add(&d->script, " title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced");
}

void plot_key(figure_drawing *d, const char *text)
{
    if (text == NULL)
        text_add(&d->script, " notitle");
    else
        text_format(&d->script, " title '%s'", text);
}

void plot_end(figure_drawing *d)
{
    text_add(&d->script, "\n");
    d->n_items = 0;
}

void plot_heading(figure_drawing *d, const char *title)
{
    text_add(&d->script, "set title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced\n");
}

/* ---- axes ------------------------------------------------------------------------------------ */

bool span_is_empty(const value_span *span)
{
    return !(span->low <= span->high);
}

void span_add(value_span *span, double value, bool positive_only)
{
    // Values beyond a hundred decades are not plotted.
    if (!(fabs(value) < 1e100) || (positive_only && !(value > 1e-100)))
        return;
    if (span_is_empty(span))
        span->low = span->high = value;
    span->low = fmin(span->low, value);
    span->high = fmax(span->high, value);
}

void span_add_column(value_span *span, const table_view *table, unsigned column, bool positive_only)
{
    for (size_t row = 0; row < table->n_rows; row++)
        span_add(span, view_number(table, table->schema, row, column), positive_only);
}

void span_add_section(value_span *span, const figure_drawing *d, int section, size_t place,
                      bool positive_only)
{
    for (size_t row = 0; row < drawing_row_count(d, section); row++)
        span_add(span, wt_table_number(d->sections[section], row, place), positive_only);
}

/* Names of the axes in a script. */
static const char *const axis_names[] = {[AXIS_X] = "x", [AXIS_Y] = "y", [AXIS_COLOUR] = "cb"};

static void write_label(figure_drawing *d, drawing_axis_id id, const char *label,
                        const display_unit *lab)
{
    text_buffer words = {0};
    text_add(&words, label);
    if (lab->label[0] != '\0')
        text_format(&words, " (%s)", lab->label);
    if (id == AXIS_COLOUR) // room for the label of the colour scale at the right
        text_add(&d->script, "set rmargin 12\n");
    text_format(&d->script, "set %slabel ", axis_names[id]);
    text_quoted(&d->script, text_string(&words));
    text_add(&d->script, "\n");
    text_free(&words);
}

static void write_unit(figure_drawing *d, const char *axis, const char *unit,
                       const display_unit *lab)
{
    text_buffer words = {0};
    text_format(&d->script, "%s_unit = %s", axis, LITERAL(lab->factor));
    if (lab->offset != 0)
        text_format(&d->script, "; %s_offset = %s", axis, LITERAL(lab->offset));
    text_format(&words, "from %s to %s", unit, lab->label[0] != '\0' ? lab->label : "1");
    text_add(&d->script, "  ");
    text_comment(&d->script, text_string(&words));
    text_free(&words);
}

static void write_range(figure_drawing *d, const char *axis, double low, double high)
{
    text_format(&d->script, "set %srange [%s:%s]\n", axis, LITERAL(low), LITERAL(high));
}

/* Number of tic intervals of a linear axis, and of one in a narrow panel. */
enum { PARTS = 5, FEW_PARTS = 3 };

/* Returns a step of 1, 2, 2.5 or 5 times a power of ten for about `parts` intervals. */
static double tic_step(double width, int parts)
{
    double raw = width / parts, power = pow(10, floor(log10(raw))), part = raw / power;
    return (part < 1.5 ? 1 : part < 2.25 ? 2 : part < 3.5 ? 2.5 : part < 7.5 ? 5 : 10) * power;
}

/* Returns a step for degrees: a fraction of a turn. */
static double angle_tic_step(double width)
{
    return width > 270   ? 90
           : width > 135 ? 45
           : width > 90  ? 30
           : width > 45  ? 15
                         : tic_step(width, PARTS);
}

/* Tic labels of this width [characters] fit into the margin of the styles, together with the axis
 * label. */
enum { LABEL_WIDTH = 5, LABEL_MARGIN = 5 };

/* Widens the left margin for wider tic labels: gnuplot would place the axis label outside of the
 * page. */
static void write_left_margin(figure_drawing *d, double low, double high, double step)
{
    const double size = fmax(fabs(low), fabs(high));
    int decimals = 0;
    for (double shown = step; decimals < LABEL_WIDTH && fabs(shown - rint(shown)) > 1e-6;
         shown *= 10)
        decimals++;
    const int whole = size < 10 ? 1 : 1 + (int)log10(size);
    const int width = (low < 0) + whole + (decimals > 0) + decimals;
    if (width > LABEL_WIDTH)
        text_format(&d->script, "set lmargin %d\n", width + LABEL_MARGIN);
}

linear_axis axis_choose_linear(const figure_drawing *d, const schema_field *column, value_span span)
{
    linear_axis a = {.unit = select_display_unit(column->quantity, schema_unit(column),
                                                 fmax(fabs(span.low), fabs(span.high)) / 2)};
    a.low = to_display_value(&a.unit, span.low), a.high = to_display_value(&a.unit, span.high);
    const double size = fmax(fabs(a.high), fabs(a.low));
    if (!(a.high - a.low > fmax(1e-12 * size, 1e-100))) { // a single value: a range around it
        const double half = size > 1e-100 ? size / 2 : 1;
        a.low -= half;
        a.high += half;
    }
    a.step = column->quantity == WT_Q_ANGLE
                 ? angle_tic_step(a.high - a.low)
                 : tic_step(a.high - a.low, d->narrow ? FEW_PARTS : PARTS);
    // If the data end at zero, the axis ends there, too.
    const double margin = 0.04 * (a.high - a.low);
    a.low = a.low == 0 ? 0 : a.low - margin;
    a.high = a.high == 0 ? 0 : a.high + margin;
    return a;
}

void axis_linear(figure_drawing *d, drawing_axis_id id, const char *label,
                 const schema_field *column, value_span span)
{
    const char *const axis = axis_names[id];
    const linear_axis a = axis_choose_linear(d, column, span);
    write_unit(d, axis, schema_unit(column), &a.unit);
    write_label(d, id, label, &a.unit);
    text_format(&d->script, "unset logscale %s\n", axis);
    write_range(d, axis, a.low, a.high);
    text_format(&d->script, "set %stics %s\nset format %s '%%g'\n", axis, LITERAL(a.step), axis);
    if (id == AXIS_Y)
        write_left_margin(d, a.low, a.high, a.step);
}

/* True for decades whose tic labels need a power of ten. */
static bool uses_power_label(int decade)
{
    return decade < -3 || decade > 4;
}

/* Writes one tic from its mantissa and decade. */
static void write_tic(figure_drawing *d, const char *comma, double mantissa, int decade)
{
    text_add(&d->script, comma);
    if (uses_power_label(decade))
        text_format(&d->script, "'%s·10^{%d}' ", SHORT_NUMBER(mantissa, 2), decade);
    text_add(&d->script, LITERAL(mantissa * pow(10, decade)));
}

/* Writes a logarithmic axis of at most 2.2 decades: 1-2-5 tics with plain numbers. */
static void write_short_log_axis(figure_drawing *d, drawing_axis_id id, double low, double high,
                                 double width)
{
    const char *const axis = axis_names[id];
    double margin = pow(10, fmax(0.05 * width, 0.02));
    low /= margin;
    high *= margin;
    static const double few[] = {1, 2, 5}, many[] = {1, 1.5, 2, 3, 4, 5, 6, 8};
    const double *digits = width < 0.7 ? many : few;
    size_t n = width < 0.7 ? sizeof many / sizeof many[0] : sizeof few / sizeof few[0];
    const char *comma = "";
    write_range(d, axis, low, high);
    text_format(&d->script, "unset m%stics\nset %stics (", axis, axis);
    if (width < 0.15) { // less than a factor of 1.4: tics as on a linear axis
        double step = tic_step(high - low, PARTS);
        for (int i = (int)ceil(low / step); i <= (int)floor(high / step); i++) {
            text_format(&d->script, "%s%s", comma, LITERAL(i * step));
            comma = ", ";
        }
    } else
        for (int decade = (int)floor(log10(low)); decade <= (int)floor(log10(high)); decade++)
            for (size_t i = 0; i < n; i++) {
                double tic = digits[i] * pow(10, decade);
                if (tic < low || tic > high)
                    continue;
                write_tic(d, comma, digits[i], decade);
                comma = ", ";
            }
    text_format(&d->script, ")\nset format %s '%%g'\n", axis);
    if (id == AXIS_Y &&
        (uses_power_label((int)floor(log10(low))) || uses_power_label((int)floor(log10(high)))))
        text_format(&d->script, "set lmargin %d\n", LABEL_WIDTH + 2 + LABEL_MARGIN); /* 2·10^{-7} */
}

void axis_log(figure_drawing *d, drawing_axis_id id, const char *label, const schema_field *column,
              value_span span)
{
    const char *const axis = axis_names[id];
    const char *unit = schema_unit(column);
    double decades = log10(span.high / span.low);
    // The unit suits three times the geometric mean. Over many decades, times and velocities are
    // shown in SI units, moduli in MPa.
    double size = 3 * sqrt(span.low) * sqrt(span.high);
    if (decades > 2.5 && (strcmp(unit, "s") == 0 || strcmp(unit, "m/s") == 0))
        size = 1;
    else if (decades > 2.5 && strcmp(unit, "Pa") == 0)
        size = 1e6;
    display_unit lab = select_display_unit(column->quantity, unit, size);
    double low = span.low * lab.factor, high = span.high * lab.factor;
    write_unit(d, axis, unit, &lab);
    write_label(d, id, label, &lab);
    text_format(&d->script, "set logscale %s\n", axis);
    if (decades < 2.2) {
        write_short_log_axis(d, id, low, high, decades);
        return;
    }
    double margin = pow(10, 0.03 * decades);
    low /= margin;
    high *= margin;
    write_range(d, axis, low, high);
    // At most seven labels. The first tic is given, as gnuplot would count from the end of the
    // axis, which is no whole decade.
    int step = 1 + (int)(decades / 6), first = (int)ceil(log10(low));
    text_format(&d->script, "set %stics 1e%d,1e%d\n", axis, first, step);
    text_format(&d->script, step == 1 ? "set m%stics 10\n" : "unset m%stics\n", axis);
    text_format(&d->script, "set format %s '10^{%%T}'\n", axis);
}
