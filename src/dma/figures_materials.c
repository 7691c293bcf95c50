/* Figures that compare materials: their moduli and the ratios of their moduli.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <string.h>

/* Draws the area between two data columns (counted from 1) in the tint of a group. Draws nothing
 * if the columns have no values. */
static void plot_interval(figure_drawing *d, int section, const char *x, size_t column,
                          size_t group)
{
    value_span span = EMPTY_SPAN;
    span_add_section(&span, d, section, column - 1, true);
    if (!span_is_empty(&span))
        plot_item(d, section, "%s:($%zu*y_unit):($%zu*y_unit) with filledcurves ls %zu notitle", x,
                  column, column + 1, 81 + group);
}

/* ---- moduli ---------------------------------------------------------------------------------- */

enum { ROLES = 3 };

/* The data columns are the frequency, then each quantity with its lower and upper limit. */
static void plot_materials(figure_drawing *d, size_t column, bool titled, const char *dash)
{
    for (size_t i = 0; i < d->n_groups; i++) {
        plot_item(d, d->data[i], "($1*x_unit):($%zu*y_unit) with lines ls %zu%s", column, i + 1,
                  dash);
        if (titled)
            plot_title(d, d->groups[i]);
        else
            text_add(&d->script, " notitle");
    }
}

static void draw_materials(figure_drawing *d)
{
    enum { STORAGE = 2, LOSS = 5, FACTOR = 8 };
    if (!drawing_build_data(d))
        return;
    d->height = 1.6;
    text_add(&d->script, "set multiplot layout 2,1\n");
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    for (size_t i = 0; i < d->n_groups; i++) {
        plot_interval(d, d->data[i], "($1*x_unit)", STORAGE + 1, i);
        plot_interval(d, d->data[i], "($1*x_unit)", LOSS + 1, i);
    }
    plot_materials(d, STORAGE, true, "");
    plot_materials(d, LOSS, false, " dt (6,4)");
    plot_expression(d, "keyentry with lines ls 11 title 'storage modulus'");
    plot_expression(d, "keyentry with lines ls 11 dt (6,4) title 'loss modulus'");
    plot_end(d);
    drawing_axis(d, "y", &d->figure->y[1], NULL, d->y[1]);
    text_add(&d->script, "unset key\n");
    for (size_t i = 0; i < d->n_groups; i++)
        plot_interval(d, d->data[i], "($1*x_unit)", FACTOR + 1, i);
    plot_materials(d, FACTOR, false, "");
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

static void caption_materials(figure_drawing *d)
{
    const double at = materials_value(d->table, MATERIALS_KEY_TEMPERATURE).value;
    if (isfinite(at))
        text_format(&d->caption, " All at %s, each over the frequencies that were measured of it.",
                    VALUE(WT_Q_TEMPERATURE, NULL, at));
}

/* ---- ratios ---------------------------------------------------------------------------------- */

/* One column of panels, over frequency or over temperature. */
typedef struct ratio_panel_column {
    const char *over;
    material_ratio_column column;
    axis_scale scale;
    const char *label, *x;
    int section[DRAWING_GROUPS];
    value_span span;
} ratio_panel_column;

static const unsigned ratio_columns[ROLES] = {MATERIAL_RATIO_STORAGE, MATERIAL_RATIO_LOSS,
                                              MATERIAL_RATIO_FACTOR};

static bool load_ratio_side(figure_drawing *d, ratio_panel_column *side, value_span y[ROLES])
{
    const schema_field *of = material_ratio_schema.columns;
    unsigned columns[1 + 3 * ROLES] = {side->column};
    for (size_t q = 0; q < ROLES; q++) {
        columns[1 + 3 * q] = ratio_columns[q];
        columns[2 + 3 * q] = of[ratio_columns[q]].low;
        columns[3 + 3 * q] = of[ratio_columns[q]].high;
    }
    side->span = EMPTY_SPAN;
    for (size_t i = 0; i < d->n_groups; i++) {
        const row_filter rows = {
            {MATERIAL_RATIO_MATERIAL, MATERIAL_RATIO_OVER}, {d->groups[i], side->over}, NULL};
        side->section[i] = drawing_section(d, d->table, side->over, &rows, columns,
                                           sizeof columns / sizeof *columns, 2);
        span_add_section(&side->span, d, side->section[i], 0, side->scale == AXIS_LOG);
        for (size_t q = 0; q < ROLES; q++)
            for (size_t k = 1; k <= 3; k++)
                span_add_section(&y[q], d, side->section[i], 3 * q + k, true);
    }
    return !span_is_empty(&side->span);
}

static void draw_ratio(figure_drawing *d, const ratio_panel_column *side, size_t q, value_span y,
                       bool titled)
{
    static const char *const labels[ROLES] = {"Ratio of E′", "Ratio of E″", "Ratio of tan δ"};
    const size_t column = 2 + 3 * q;
    const schema_field *of = &material_ratio_schema.columns[side->column];
    if (side->scale == AXIS_LOG) {
        axis_log(d, "x", side->label, of, side->span);
    } else {
        text_add(&d->script, "unset mxtics\n");
        axis_linear(d, "x", side->label, of, side->span);
    }
    span_add(&y, 1, true);
    axis_log(d, "y", labels[q], &material_ratio_schema.columns[ratio_columns[q]], y);
    if (!titled)
        text_add(&d->script, "unset key\n");
    for (size_t i = 0; i < d->n_groups; i++)
        plot_interval(d, side->section[i], side->x, column + 1, i + 1);
    plot_expression(d, "1 with lines ls 12 notitle");
    for (size_t i = 0; i < d->n_groups; i++) {
        plot_item(d, side->section[i], "%s:($%zu*y_unit) with lines ls %zu", side->x, column,
                  i + 2);
        if (side->section[i] >= 0 && titled)
            plot_title(d, d->groups[i]);
        else if (side->section[i] >= 0)
            text_add(&d->script, " notitle");
    }
    plot_end(d);
}

/* The rows are E', E'' and tan delta. The left column is over frequency. A right column over
 * temperature exists if there are several temperatures. */
static void draw_material_ratio(figure_drawing *d)
{
    ratio_panel_column sides[] = {{.over = "frequency",
                                   .column = MATERIAL_RATIO_ANGULAR_FREQUENCY,
                                   .scale = AXIS_LOG,
                                   .label = "Angular frequency",
                                   .x = "($1*x_unit)"},
                                  {.over = "temperature",
                                   .column = MATERIAL_RATIO_TEMPERATURE,
                                   .scale = AXIS_LINEAR,
                                   .label = "Temperature",
                                   .x = "($1+x_offset)"}};
    value_span y[ROLES] = {EMPTY_SPAN, EMPTY_SPAN, EMPTY_SPAN};
    const bool left = load_ratio_side(d, &sides[0], y), right = load_ratio_side(d, &sides[1], y);
    if (!left || d->status != WT_OK)
        return;
    d->width = right ? 1.6 : 1;
    d->height = 2.2;
    text_format(&d->script, "set tmargin 2.2\nset multiplot layout 3,%d\n", right ? 2 : 1);
    for (size_t q = 0; q < ROLES; q++) {
        draw_ratio(d, &sides[0], q, y[q], q == 0);
        if (right)
            draw_ratio(d, &sides[1], q, y[q], false);
    }
    text_add(&d->script, "unset multiplot\n");
}

static void caption_material_ratio(figure_drawing *d)
{
    const char *settled = material_ratio_key_text(d->table, MATERIAL_RATIO_KEY_SETTLED_BY);
    const double at = material_ratio_value(d->table, MATERIAL_RATIO_KEY_TEMPERATURE).value;
    const wt_estimate frequency = material_ratio_value(d->table, MATERIAL_RATIO_KEY_FREQUENCY);
    text_format(&d->caption, " Divided by %s.",
                material_ratio_key_text(d->table, MATERIAL_RATIO_KEY_FIRST));
    if (isfinite(at))
        text_format(&d->caption, " Over frequency: at %s.", VALUE(WT_Q_TEMPERATURE, NULL, at));
    if (d->width > 1 && isfinite(frequency.value)) /* there is a second column */
        text_format(&d->caption, " Over temperature: at %s.", ESTIMATE(&frequency));
    text_format(&d->caption, " Do they differ? %s.",
                material_ratio_key_text(d->table, MATERIAL_RATIO_KEY_DIFFERS));
    if (settled != NULL)
        text_format(&d->caption, " How to decide it: %s.", settled);
}

/* ---- one law for samples --------------------------------------------------------------------- */

/* The upper panel shows the shifts with the shared law. The lower panel shows the difference of
 * each sample's separate law. Data columns: temperature, shift, its error, then law and
 * difference with their limits. */
static void draw_shared_shift_law(figure_drawing *d)
{
    enum { SHIFT = 2, LAW = 4, DIFFERENCE = 7 };
    if (!drawing_build_data(d))
        return;
    d->height = 1.6;
    text_add(&d->script, "set multiplot layout 2,1\n");
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    text_add(&d->script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n");
    for (size_t i = 0; i < d->n_groups; i++) {
        plot_item(d, d->data[i], "($1+x_offset):($%d):($%d) with filledcurves ls %zu notitle",
                  LAW + 1, LAW + 2, 81 + i);
        plot_item(d, d->data[i], "($1+x_offset):($%d) with lines ls %zu notitle", LAW, i + 1);
        plot_item(d, d->data[i], "($1+x_offset):($%d):($%d) with yerrorbars ls %zu", SHIFT,
                  SHIFT + 1, 41 + i);
        plot_title(d, d->groups[i]);
    }
    plot_end(d);
    value_span span = d->y[1];
    if (!span_is_empty(&span)) {
        span_add(&span, 0, false);
        text_add(&d->script, "unset key\n");
        drawing_axis(d, "y", &d->figure->y[1], NULL, span);
        text_add(&d->script, "set ylabel 'Own law against it (decades)'\n");
        plot_expression(d, "0 with lines ls 12 notitle");
        for (size_t i = 0; i < d->n_groups; i++)
            plot_item(d, d->data[i],
                      "($1+x_offset):($%d):($%d):($%d) with yerrorbars ls %zu notitle", DIFFERENCE,
                      DIFFERENCE + 1, DIFFERENCE + 2, 41 + i);
        plot_end(d);
    }
    text_add(&d->script, "unset multiplot\n");
}

static void caption_shared_shift_law(figure_drawing *d)
{
    const char *settled = shared_shift_law_key_text(d->table, SHARED_SHIFT_LAW_KEY_SETTLED_BY);
    text_format(&d->caption, " Reference temperatures: %s. One law? %s.",
                shared_shift_law_key_text(d->table, SHARED_SHIFT_LAW_KEY_MOVED),
                shared_shift_law_key_text(d->table, SHARED_SHIFT_LAW_KEY_AGREE));
    if (settled != NULL)
        text_format(&d->caption, " How to decide it: %s.", settled);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_materials[] = {
    {.name = "materials",
     .title = "Materials side by side",
     .table = &materials_schema,
     .by_group = true,
     .group = MATERIALS_MATERIAL,
     .x = {MATERIALS_ANGULAR_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .y = {{MATERIALS_STORAGE, AXIS_LOG, "E′, E″"}, {MATERIALS_FACTOR, AXIS_LOG, "tan δ"}},
     .curves = {CURVE(MATERIALS_STORAGE, OWN, .with_errors = true),
                CURVE(MATERIALS_LOSS, OWN, .with_errors = true),
                CURVE(MATERIALS_FACTOR, OWN, .with_errors = true, .panel = 1)},
     .empty_reason = "no material has moduli over a known range of frequencies",
     .caption_text =
         "Storage modulus (full lines), loss modulus (broken lines) and, below, tan δ of the "
         "materials; bands: 95 % intervals.",
     .draw = draw_materials,
     .caption = caption_materials},
    {.name = "material_ratio",
     .title = "Ratio of the moduli of materials",
     .table = &material_ratio_schema,
     .by_group = true,
     .group = MATERIAL_RATIO_MATERIAL,
     .x = {MATERIAL_RATIO_ANGULAR_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .y = {{MATERIAL_RATIO_STORAGE, AXIS_LOG, "Ratio of E′"}},
     .curves = {CURVE(MATERIAL_RATIO_STORAGE, OWN, .with_errors = true),
                CURVE(MATERIAL_RATIO_LOSS, OWN, .with_errors = true),
                CURVE(MATERIAL_RATIO_FACTOR, OWN, .with_errors = true)},
     .empty_reason = "no ratio of moduli is known",
     .caption_text =
         "E′, E″ and tan δ of materials, each divided by those of the first, where both were "
         "measured (bands: 95 % intervals).",
     .draw = draw_material_ratio,
     .caption = caption_material_ratio},
    {.name = "shared_shift_law",
     .title = "One law for several samples",
     .table = &shared_shift_law_schema,
     .by_group = true,
     .group = SHARED_SHIFT_LAW_SAMPLE,
     .x = {SHARED_SHIFT_LAW_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{SHARED_SHIFT_LAW_LOG_A, AXIS_LINEAR, "Shift factor"},
           {SHARED_SHIFT_LAW_DIFFERENCE, AXIS_LINEAR, "Own law against it"}},
     .curves = {CURVE(SHARED_SHIFT_LAW_LOG_A, OWN, .with_errors = true),
                CURVE(SHARED_SHIFT_LAW_LAW_LOG_A, OWN, .with_errors = true),
                CURVE(SHARED_SHIFT_LAW_DIFFERENCE, OWN, .with_errors = true, .panel = 1)},
     .empty_reason = "no sample has shift factors about a shared shift law",
     .caption_text =
         "Shift factors of the samples (bars: standard error without that of the temperature) "
         "about the one law fitted to all (lines; bands: 95 % intervals) and, below, what the "
         "law of each alone has more, from the middle of its isotherms on (bars: limits on "
         "the safe side of 95 %).",
     .draw = draw_shared_shift_law,
     .caption = caption_shared_shift_law},
    {.name = NULL},
};
