/* One figure while it is made: its data (tables that become NAME.tsv), its gnuplot script and its
 * caption. Data stay in SI units; the script turns them into lab units by factors of its own.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_DRAWING_H
#define WT_REPORT_DRAWING_H

#include "report/text.h"
#include "report/units.h"
#include "weartrack/report.h"

enum { DRAWING_SECTIONS = 64, DRAWING_GROUPS = 6 };

/* Zero-initialised but for `result`, `name` and `err`. The first failure stays in `status`; later
 * calls do nothing. */
typedef struct figure_drawing {
    const wt_result *result;
    const char *name;
    wt_error *err;
    wt_status status;
    double width, height; /* of the picture, in sizes of one panel of the style; 0 = 1 */
    wt_table *sections[DRAWING_SECTIONS]; /* gnuplot's `index`; owned */
    size_t n_sections;
    growing_text script;  /* what follows the loading of the style */
    growing_text caption; /* plain text */
    growing_text omitted; /* why nothing can be drawn; plain text, empty where that is usual */
    size_t n_items;       /* of the plot command that is being written */
} figure_drawing;

void drawing_clear(figure_drawing *d);

/* ---- data ----------------------------------------------------------------------------------- */

/* Rows of a table where each of up to two text columns holds a text (does not hold it if `other`);
 * column NULL = no condition. */
typedef struct row_filter {
    const char *column[2], *text[2];
    bool other;
} row_filter;

enum { NO_SECTION = -1 };
/* Copies number columns (NULL-terminated; one that the table does not have becomes NaN) of the rows
 * into a new section and returns its index; NO_SECTION if no row has a number in each of the
 * first `needed` columns. Blocks are kept if asked for. */
int drawing_section(figure_drawing *d, const wt_table *table, const char *title,
                    const row_filter *rows, const char *const *columns, size_t needed, bool blocks);
/* A section of one row of numbers in a unit each. */
int drawing_point(figure_drawing *d, const char *title, const char *const *columns,
                  const char *const *units, const double *values);
size_t drawing_rows(const figure_drawing *d, int section);
/* Draw every n-th point only, so that about `limit` are left: 1 = all. */
size_t drawing_every(const figure_drawing *d, int section, size_t limit);

/* Names of groups in a text column, "bulk" and "track" first, then as they come. Returns how many,
 * at most DRAWING_GROUPS. The names are borrowed from the table. */
size_t drawing_groups(const wt_table *table, const char *column,
                      const char *groups[DRAWING_GROUPS]);
/* Line style of a group in the style file: 1 bulk, 2 track, 3... the others. */
int drawing_group_style(const char *group, size_t place);

/* ---- axes ----------------------------------------------------------------------------------- */

/* Smallest and largest of numbers between -1e100 and 1e100; low > high while empty. */
typedef struct value_span {
    double low, high;
} value_span;
#define SPAN_EMPTY                                                                                 \
    {                                                                                              \
        1, 0                                                                                       \
    }
bool span_empty(const value_span *span);
void span_add(value_span *span, double value, bool positive_only);
void span_add_column(value_span *span, const wt_table *table, const char *column,
                     bool positive_only);
/* A column of a section. */
void span_add_section(value_span *span, const figure_drawing *d, int section, const char *column,
                      bool positive_only);

/* Write label, range and tics of axis "x", "y" or "cb" and define its factor, e.g. x_unit = 1e9
 * (and x_offset for temperatures). The span is in SI and not empty; `label` is shown with the unit
 * behind it. */
lab_unit axis_linear(figure_drawing *d, const char *axis, const char *label, const char *unit,
                     const char *quantity, value_span span);
lab_unit axis_log(figure_drawing *d, const char *axis, const char *label, const char *unit,
                  value_span span);

/* ---- plot command --------------------------------------------------------------------------- */

void plot_begin(figure_drawing *d);
/* One more thing to plot: "'NAME.tsv' index SECTION using " and what the format says. Nothing is
 * written for NO_SECTION. */
void plot_item(figure_drawing *d, int section, const char *format, ...) WT_PRINTF(3, 4);
/* The same without data: a function or a key entry. */
void plot_other(figure_drawing *d, const char *format, ...) WT_PRINTF(2, 3);
/* Ends the item with a text that comes from a file as its title. */
void plot_title(figure_drawing *d, const char *title);
void plot_end(figure_drawing *d);

/* A finite number in a key, written as an estimate or as plain text. */
bool key_number(const wt_table *table, const char *key, double *value);

/* A value with its unit for a caption, up to 3 digits: "1.15 µm". */
void caption_value(figure_drawing *d, double value, const char *unit, const char *quantity);
/* "12.3 ± 0.4 MPa" with the standard error, the value alone without one. */
void caption_estimate(figure_drawing *d, const wt_estimate *estimate, const char *quantity);

#endif
