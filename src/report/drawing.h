/* One figure while it is made: its data (tables that become NAME.tsv), its gnuplot script and its
 * caption. Data stay in SI units; the script turns them into lab units by factors of its own.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_DRAWING_H
#define WT_REPORT_DRAWING_H

#include "report/display_units.h"
#include "report/figure.h"
#include "report/number_format.h"
#include "report/report_tables.h"
#include "report/report_text.h"

enum {
    DRAWING_SECTIONS = 64,
    DRAWING_GROUPS = 6,
    NO_SECTION = -1,
    FEW_COLOURS = 3,
    DATA_DIGITS = 7, /* of the numbers of a figure: finer than any of its pictures, and in half the
                        bytes; all digits are in the result */
    DRAWING_LABEL = 128
};

/* Smallest and largest of numbers between -1e100 and 1e100; low > high while empty. */
typedef struct value_span {
    double low, high;
} value_span;
#define SPAN_EMPTY                                                                                 \
    (value_span)                                                                                   \
    {                                                                                              \
        1, 0                                                                                       \
    }

/* The first failure stays in `status`; later calls do nothing. */
typedef struct figure_drawing {
    const figure_description *figure;
    const figure_tables *tables;
    const language *language;           /* of all that is read in the picture; NULL: English */
    const table_view *table;            /* that of the figure */
    const char *groups[DRAWING_GROUPS]; /* of a figure by groups: their names, borrowed; else "" */
    size_t n_groups;
    bool too_many;                    /* groups: the others are not drawn */
    unsigned columns[FIGURE_COLUMNS]; /* of the data as described */
    size_t n_columns;
    wt_error *err;
    wt_status status;
    double width, height;                 /* of the picture, in sizes of one panel of the style */
    bool narrow;                          /* the next axis has room for few numbers */
    wt_table *sections[DRAWING_SECTIONS]; /* gnuplot's `index`; owned */
    size_t n_sections;
    int data[DRAWING_GROUPS]; /* the section of each group as the figure describes it, */
    value_span x, y[FIGURE_PANELS], colour; /* and what they span */
    const char *y_label;                    /* in the place of the one described, or NULL */
    bool titled[FIGURE_CURVES];             /* the curve is in the key */
    bool band_titled;                       /* and so is the first band */
    double colours[FEW_COLOURS];            /* those that the key names in the place of a scale */
    size_t n_colours;                       /* 0: there are more, or the colour says nothing */
    text_buffer script;                     /* what follows the loading of the style */
    text_buffer caption;                    /* plain text */
    size_t n_items;                         /* of the plot command that is being written */
} figure_drawing;

/* Whether it has panels beside each other: on the page it has no other figure beside it. */
bool drawing_is_wide(const figure_drawing *d);

/* Fills sections, script and caption; without anything to draw it leaves no script. drawing_clear
 * also after a failure. */
wt_status drawing_make(figure_drawing *d, const figure_description *figure,
                       const figure_tables *tables, const language *l, wt_error *err) WT_NODISCARD;
void drawing_clear(figure_drawing *d);

/* ---- what the description says, for the functions of figures --------------------------------- */

/* The columns in the data of a figure, in their order. Returns how many. */
size_t drawing_columns(const figure_description *figure, unsigned columns[FIGURE_COLUMNS]);
/* Makes the sections of all groups and finds what they span; false if there is nothing to draw. */
bool drawing_data(figure_drawing *d);
/* Axis "x", "y" or "cb"; `label` NULL = the one described. */
void drawing_axis(figure_drawing *d, const char *letter, const figure_axis *axis, const char *label,
                  value_span span);
/* x, y of the first panel and, if it says something, the scale of colour beside the picture: of two
 * or three colours alone the key names them, where drawing_colours stands in the plot command. */
void drawing_axes(figure_drawing *d);
void drawing_colours(figure_drawing *d, const char *with);
/* "Angular frequency at 20 °C", or the label alone without a temperature. */
void drawing_label_at(const figure_drawing *d, char label[DRAWING_LABEL], const char *words,
                      double temperature);
/* Of the moduli, by the words of a table for its deformation. */
char drawing_letter(const char *deformation);
/* All that is described of one panel, in a plot command: the bands, then the curves. */
void drawing_bands(figure_drawing *d, size_t panel);
void drawing_curves(figure_drawing *d, size_t panel);

/* ---- data ----------------------------------------------------------------------------------- */

/* Rows of a table where each of up to two text columns holds a text (does not hold it if `other`);
 * text NULL = no condition. */
typedef struct row_filter {
    unsigned column[2];
    const char *text[2];
    bool other;
} row_filter;

/* Copies number columns of the rows into a new section and returns its index; NO_SECTION if no row
 * has a number in each of the first `needed` columns. Blocks are kept. */
int drawing_section(figure_drawing *d, const table_view *table, const char *title,
                    const row_filter *rows, const unsigned *columns, size_t n_columns,
                    size_t needed);
/* A section of rows of numbers, one after the other, in columns with a unit each; NULL ends them.
 */
int drawing_numbers(figure_drawing *d, const char *title, const char *const *columns,
                    const char *const *units, const double *values, size_t n_rows);
size_t drawing_rows(const figure_drawing *d, int section);
/* Draw every n-th point only, so that about `limit` are left: 1 = all. */
size_t drawing_every(const figure_drawing *d, int section, size_t limit);
/* The largest such n of the sections of all groups. */
size_t drawing_thinning(const figure_drawing *d, size_t limit);
/* What the usual groups, bulk and track, are called in the language; any other name stays. */
const char *drawing_group_name(const figure_drawing *d, const char *name);
/* Line style of group i in the style file: 1 bulk, 2 track, 3... the others. */
int drawing_group_style(const figure_drawing *d, size_t i);

/* ---- axes ----------------------------------------------------------------------------------- */

bool span_empty(const value_span *span);
void span_add(value_span *span, double value, bool positive_only);
void span_add_column(value_span *span, const table_view *table, unsigned column,
                     bool positive_only);
/* Column `place` of a section, from 0. */
void span_add_section(value_span *span, const figure_drawing *d, int section, size_t place,
                      bool positive_only);

/* Write label, range and tics of axis "x", "y" or "cb" and define its factor, e.g. x_unit = 1e9
 * (and x_offset for temperatures). The span is in the SI unit of the column and not empty; `label`
 * is shown with the unit behind it. */
void axis_linear(figure_drawing *d, const char *axis, const char *label, const schema_field *column,
                 value_span span);
void axis_log(figure_drawing *d, const char *axis, const char *label, const schema_field *column,
              value_span span);

/* ---- plot command --------------------------------------------------------------------------- */

/* One more thing to plot: "'NAME.tsv' index SECTION using " and what the format says. Nothing is
 * written for NO_SECTION. */
void plot_item(figure_drawing *d, int section, const char *format, ...) WT_PRINTF(3, 4);
/* The same without data: a function or a key entry. */
void plot_other(figure_drawing *d, const char *format, ...) WT_PRINTF(2, 3);
/* Ends the item with a title of ours, or NULL without one. Such a text has nothing in it that
 * gnuplot would take for more, and its translations have not, either. */
void plot_key(figure_drawing *d, const char *english);
/* Ends the item with a text that comes from a file as its title. */
void plot_title(figure_drawing *d, const char *title);
void plot_end(figure_drawing *d);
/* Title of a panel. */
void plot_heading(figure_drawing *d, const char *title);

#endif
