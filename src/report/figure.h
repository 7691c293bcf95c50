/* Description of a figure: table, axes, curves and caption. Functions draw what a description
 * cannot express (marks, maps, panels).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_FIGURE_H
#define WT_REPORT_FIGURE_H

#include "core/table/schema.h"

struct figure_drawing;

typedef enum axis_scale {
    AXIS_NONE,
    AXIS_LINEAR,
    AXIS_FROM_ZERO, /* linear, includes zero */
    AXIS_NUMBER,    /* linear, numbers without a display unit */
    AXIS_LOG
} axis_scale;

/* An axis; its unit is that of the column. */
typedef struct figure_axis {
    unsigned column;
    axis_scale scale;
    const char *label;
} figure_axis;

typedef enum curve_form {
    CURVE_NONE,
    CURVE_LINE,
    CURVE_POINTS,
    CURVE_BARS,        /* points with their 95 % interval */
    CURVE_JOINED_BARS, /* the same, connected by a line */
    CURVE_FIT,         /* a fitted law; does not extend the axis */
    CURVE_OWN,         /* drawn by the function of the figure */
    CURVE_DATA         /* only in the data of the figure */
} curve_form;

/* A curve: one column against that of the x axis. It is not drawn without a number. */
typedef struct figure_curve {
    unsigned column;
    curve_form form;
    int style;         /* line of the style file; with groups, added to that of the group */
    const char *title; /* title in the key; with groups, the name of the group; NULL = none */
    bool with_errors;  /* the data include its standard error and interval */
    int band;          /* style of a band of the 95 % interval, 0 = none */
    bool dashed;       /* a line whose colour has a meaning; else the style says it */
    bool above_zero;   /* drawn only where it is positive */
    size_t points;     /* about this number of points is drawn; 0 = all */
    size_t panel;      /* panel of its y axis */
} figure_curve;
/* CURVE(LAYER_WEAR_RATE, LINE, .style = 23): column, form, further members. */
#define CURVE(which, ...)                                                                          \
    {                                                                                              \
        .column = which, .form = CURVE_##__VA_ARGS__                                               \
    }

enum { FIGURE_PANELS = 2, FIGURE_CURVES = 8, FIGURE_COLUMNS = 16 };

typedef struct figure_description {
    const char *name, *title;
    const table_schema *table; /* drawn if this table has a row */
    const char *other_tables;  /* names of further tables that it uses; NULL: none */
    const char *data_title;    /* title of its data; with groups, the name of the group */
    bool by_group;             /* a curve for each text in the column `group` */
    unsigned group;
    figure_axis x, y[FIGURE_PANELS], colour;
    bool in_depth;                      /* folded on the page, after the main figures */
    bool needs_several_x;               /* drawn only with several values of x */
    figure_curve curves[FIGURE_CURVES]; /* ends with CURVE_NONE */
    const char *empty_reason; /* reason on the page if nothing can be drawn; NULL = no text */
    const char *caption_text; /* the caption */
    void (*prepare)(struct figure_drawing *d); /* changes ranges or labels; NULL: nothing */
    void (*draw)(struct figure_drawing *d);    /* NULL: as described */
    void (*caption)(struct figure_drawing *d); /* extends the caption; NULL: nothing */
} figure_description;

/* Sections of the page, one for each subject. */
typedef enum page_section {
    SECTION_INDENTATION,
    SECTION_MATERIAL,
    SECTION_SURFACE,
    SECTION_FRICTION,
    SECTION_LAYER,
    SECTION_COLLECTION,
    SECTION_UNCERTAINTY,
    PAGE_SECTIONS
} page_section;

/* Figures in the order of the page; each list ends with a row without a name. */
extern const figure_description figures_indentation[], figures_surface[], figures_master[],
    figures_dma[], figures_payne[], figures_friction[], figures_record[], figures_validation[],
    figures_layer[], figures_what_if[], figures_accuracy[], figures_collection[],
    figures_constants[];
const figure_description *figure_find(size_t i); /* NULL past the last one */
page_section figure_section(size_t i);           /* PAGE_SECTIONS past the last one */

/* Draw the shifts with the fitted law, and extend their captions. */
void draw_shift_factors(struct figure_drawing *d);
void caption_shift_factors(struct figure_drawing *d);
void draw_vertical_shifts(struct figure_drawing *d);
void caption_vertical_shifts(struct figure_drawing *d);
void draw_influences(struct figure_drawing *d);

#endif
