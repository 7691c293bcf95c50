/* One figure under construction: its data (tables that become NAME.tsv), its gnuplot script and its
 * caption. Data are in SI units; the script has factors to display units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_DRAWING_H
#define WT_REPORT_DRAWING_H

#include "core/math/students_t.h"
#include "report/display_units.h"
#include "report/figure.h"
#include "report/report_tables.h"
#include "report/report_text.h"

enum {
    DRAWING_SECTIONS = 64,
    DRAWING_GROUPS = 6,
    NO_SECTION = -1,
    MAX_KEY_COLOURS = 3,
    DATA_DIGITS = 7, /* digits of the data of a figure, finer than its pictures at half the size;
                        the result has all digits */
    DRAWING_LABEL = 128
};

/* Smallest and largest of values between -1e100 and 1e100; low > high if empty. */
typedef struct value_span {
    double low, high;
} value_span;
#define EMPTY_SPAN                                                                                 \
    (value_span)                                                                                   \
    {                                                                                              \
        1, 0                                                                                       \
    }

/* Half width of a 95 % interval in standard errors, in scripts. Figures draw the intervals that the
 * tables of the page state; NORMAL_95 is the same number for ranges. */
#define HALF_95 "1.96"

/* A figure under construction. The first failure stays in `status`; later calls do nothing. */
typedef struct figure_drawing {
    const figure_description *figure;
    const figure_tables *tables;
    const table_view *table;            /* table of the figure */
    const char *groups[DRAWING_GROUPS]; /* names of the groups, borrowed; else "" */
    size_t n_groups;
    bool too_many;                    /* there are more groups, which are not drawn */
    unsigned columns[FIGURE_COLUMNS]; /* columns of the described data */
    size_t n_columns;
    wt_error *err;
    wt_status status;
    bool stacked;         /* panels stand one below the other, as in a column of a journal */
    double width, height; /* size of the picture in panels of the style */
    bool narrow;          /* the next axis has space for few numbers only */
    wt_table *sections[DRAWING_SECTIONS]; /* gnuplot's `index`; owned */
    size_t n_sections;
    int data[DRAWING_GROUPS];               /* section of each group as described, */
    value_span x, y[FIGURE_PANELS], colour; /* and the ranges of their values */
    const char *y_label;                    /* replaces the described label, or NULL */
    bool titled[FIGURE_CURVES];             /* the curve is in the key */
    bool band_titled;                       /* the first band is in the key */
    double colours[MAX_KEY_COLOURS];        /* colours in the key instead of a colour scale */
    size_t n_colours;                       /* 0: too many, or the colour has no meaning */
    text_buffer script;                     /* part of the script after loading the style */
    text_buffer caption;                    /* plain text */
    size_t n_items;                         /* items of the current plot command */
} figure_drawing;

/* True if the figure has panels side by side; on the page it then has the full width. */
bool drawing_is_wide(const figure_drawing *d);

/* Builds sections, script and caption. The script is empty if there is nothing to draw. Call
 * drawing_clear also after a failure. */
wt_status drawing_build(figure_drawing *d, const figure_description *figure,
                        const figure_tables *tables, bool stacked, wt_error *err) WT_NODISCARD;
void drawing_clear(figure_drawing *d);

/* ---- described parts, for the functions of figures ---------------------------------------------
 */

/* Sets the size of a picture of n panels, up to `columns` of this size side by side. Returns the
 * number of columns: 1 if they are stacked, and a panel has the full width then. */
size_t drawing_panels(figure_drawing *d, size_t n, size_t columns, double width, double height);
/* Lists the columns of the data of a figure in their order. Returns their number. */
size_t drawing_list_columns(const figure_description *figure, unsigned columns[FIGURE_COLUMNS]);
/* Builds the sections of all groups and their ranges; false if there is nothing to draw. */
bool drawing_build_data(figure_drawing *d);
/* Axes, with the colour scale. */
typedef enum drawing_axis_id { AXIS_X, AXIS_Y, AXIS_COLOUR } drawing_axis_id;
/* Writes an axis; `label` NULL = the described one. */
void drawing_axis(figure_drawing *d, drawing_axis_id id, const figure_axis *axis, const char *label,
                  value_span span);
/* Writes the x axis, the y axis of the first panel and, if the colour has a meaning, the colour
 * scale. Up to three colours are listed in the key instead, by drawing_colours in the plot command.
 */
void drawing_axes(figure_drawing *d);
void drawing_colours(figure_drawing *d, const char *with);
/* Writes a label such as "Angular frequency at 20 °C", or the label alone without a temperature. */
void drawing_temperature_label(char label[DRAWING_LABEL], const char *words, double temperature);
/* Returns the letter of the moduli, 'E' or 'G', from the deformation in a table. */
char modulus_letter(int deformation); /* a wt_deformation, or unknown */
/* Adds the described bands, then the curves, of one panel to the plot command. */
void drawing_bands(figure_drawing *d, size_t panel);
void drawing_curves(figure_drawing *d, size_t panel);

/* ---- data ----------------------------------------------------------------------------------- */

/* Selects rows where each of up to two text columns equals a text (NULL: any) and that `accepts`
 * accepts (NULL: all). */
typedef struct row_filter {
    unsigned column[2];
    const char *text[2];
    bool (*accepts)(const table_view *table, size_t row);
} row_filter;

/* Copies number columns of the rows to a new section and returns its index; NO_SECTION if no row
 * has a number in each of the first `needed` columns. Blocks are kept. */
int drawing_section(figure_drawing *d, const table_view *table, const char *title,
                    const row_filter *rows, const unsigned *columns, size_t n_columns,
                    size_t needed);
/* Creates a section from numbers, row by row, with a unit for each column; a NULL name ends the
 * columns. */
int drawing_number_section(figure_drawing *d, const char *title, const char *const *columns,
                           const char *const *units, const double *values, size_t n_rows);
size_t drawing_row_count(const figure_drawing *d, int section);
/* Returns n for drawing every n-th point, so that about `limit` remain; 1 = all. */
size_t drawing_stride(const figure_drawing *d, int section, size_t limit);
/* Returns the largest such n of the sections of all groups. */
size_t drawing_max_stride(const figure_drawing *d, size_t limit);
/* Returns the line style of group i: 1 bulk, 2 track, 3... the others. */
int drawing_group_style(const figure_drawing *d, size_t i);

/* ---- axes ----------------------------------------------------------------------------------- */

bool span_is_empty(const value_span *span);
void span_add(value_span *span, double value, bool positive_only);
void span_add_column(value_span *span, const table_view *table, unsigned column,
                     bool positive_only);
/* Extends the range by column `place` (from 0) of a section. */
void span_add_section(value_span *span, const figure_drawing *d, int section, size_t place,
                      bool positive_only);

/* Unit, range and step of the tics of a linear axis; the numbers are in the unit. */
typedef struct linear_axis {
    display_unit unit;
    double low, high, step;
} linear_axis;
linear_axis axis_choose_linear(const figure_drawing *d, const schema_field *column,
                               value_span span);
/* Writes label, range and tics of an axis and defines its factor, such as x_unit =
 * 1e9 (and x_offset for temperatures). The span is in the SI unit of the column and not empty. The
 * unit is appended to `label`. */
void axis_linear(figure_drawing *d, drawing_axis_id id, const char *label,
                 const schema_field *column, value_span span);
void axis_log(figure_drawing *d, drawing_axis_id id, const char *label, const schema_field *column,
              value_span span);

/* ---- plot command --------------------------------------------------------------------------- */

/* Begins an item: "'NAME.tsv' index SECTION using " and the formatted text. NO_SECTION writes
 * nothing. */
void plot_item(figure_drawing *d, int section, const char *format, ...) WT_PRINTF(3, 4);
/* Begins an item without data: a function or a key entry. */
void plot_expression(figure_drawing *d, const char *format, ...) WT_PRINTF(2, 3);
/* Ends the item with a title of the program, or without one for NULL. The text contains no
 * characters that gnuplot interprets. */
void plot_key(figure_drawing *d, const char *text);
/* Ends the item with a title from a file. */
void plot_title(figure_drawing *d, const char *title);
void plot_end(figure_drawing *d);
/* Sets the title of a panel. */
void plot_heading(figure_drawing *d, const char *title);

#endif
