/* A figure, described once: what it is drawn from, its axes, its curves, the words below it. What
 * no description can say (marks, maps, panels) is a function.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FIGURE_H
#define WT_REPORT_FIGURE_H

#include "core/table/schema.h"

struct figure_drawing;

typedef enum axis_scale {
    AXIS_NONE,
    AXIS_LINEAR,
    AXIS_FROM_ZERO, /* linear with its zero */
    AXIS_NUMBER,    /* linear, of numbers that need no lab unit */
    AXIS_LOG
} axis_scale;

/* The unit is that of the column. */
typedef struct figure_axis {
    unsigned column;
    axis_scale scale;
    const char *label;
} figure_axis;

typedef enum curve_form {
    CURVE_NONE,
    CURVE_LINE,
    CURVE_POINTS,
    CURVE_BARS,        /* points with an interval, or a standard error where it has none */
    CURVE_JOINED_BARS, /* the same, joined by a line */
    CURVE_FIT,         /* a fitted law over the data: does not widen the axis */
    CURVE_OWN,         /* the function of the figure draws it */
    CURVE_DATA         /* in the data of the figure only */
} curve_form;

/* A column against that of the x axis. One without a number is not drawn. */
typedef struct figure_curve {
    unsigned column;
    curve_form form;
    int style;         /* line of the style file; of a figure by groups, what is added to theirs */
    const char *title; /* in the key; of a figure by groups, theirs; NULL = none */
    bool with_errors;  /* the data have its standard error and interval, too */
    int band;          /* style of a band of one standard error, 0 = none */
    bool above_zero;   /* not drawn where it is not above zero */
    size_t points;     /* draw every n-th only, so that about so many are left; 0 = all */
    size_t panel;      /* whose y axis it has */
} figure_curve;
/* CURVE(LAYER_WEAR_RATE, LINE, .style = 23): column, form, what else there is to say. */
#define CURVE(which, ...)                                                                          \
    {                                                                                              \
        .column = which, .form = CURVE_##__VA_ARGS__                                               \
    }

enum { FIGURE_PANELS = 2, FIGURE_CURVES = 8, FIGURE_COLUMNS = 16 };

typedef struct figure_description {
    const char *name, *title;
    const table_schema *table; /* drawn if this has a row */
    const char *beside;        /* names of others that it shows something of; NULL: none */
    const char *data_title;    /* of its data; of groups, theirs */
    bool by_group;             /* a curve for each text in the column `group` */
    unsigned group;
    figure_axis x, y[FIGURE_PANELS], colour;
    bool in_depth;                      /* the page folds it, behind those that answer */
    bool of_several;                    /* one value of x alone is nothing to see */
    figure_curve curves[FIGURE_CURVES]; /* ends with CURVE_NONE */
    const char *nothing; /* said where nothing can be drawn; NULL = not worth a word */
    const char *words;   /* the caption */
    void (*prepare)(struct figure_drawing *d); /* changes what is spanned, a label; NULL: nothing */
    void (*draw)(struct figure_drawing *d);    /* NULL: as described */
    void (*caption)(struct figure_drawing *d); /* goes on with the caption; NULL: no more of it */
} figure_description;

/* In the order of the page; each ends with a row without a name. */
extern const figure_description figures_indentation[], figures_curves[], figures_spot[],
    figures_surface[], figures_materials[], figures_master[], figures_dma[], figures_payne[],
    figures_friction[], figures_friction_maps[], figures_record[], figures_validation[],
    figures_layer[], figures_existence[], figures_what_if[], figures_accuracy[],
    figures_collection[], figures_constants[];
const figure_description *figure_find(size_t i); /* NULL past the last one */

/* Of each group whose curves lie on a grid. */
void draw_modulus_map(struct figure_drawing *d);

/* Shifts and the law through them. */
void draw_shift_factors(struct figure_drawing *d);
void caption_shift_factors(struct figure_drawing *d);
void draw_vertical_shifts(struct figure_drawing *d);
void caption_vertical_shifts(struct figure_drawing *d);

#endif
