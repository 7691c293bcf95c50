/* Figures of errors: against run time, by source, and by the choices of the model.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Begins the common legend in a strip at the top. It is drawn last and consists of curves without
 * points. */
static void begin_legend(figure_drawing *d, double height)
{
    text_format(&d->script,
                "set size 1,%s\nset origin 0,%s\nset margins 0,0,0,0\nunset border\n"
                "unset tics\nunset title\nunset xlabel\nunset ylabel\nunset logscale\n"
                "unset arrow\nunset label\nset xrange [0:1]\nset yrange [0:1]\n"
                "set key center center horizontal\n",
                LITERAL(height), LITERAL(1 - height));
}

/* Heights relative to one panel of the style: legend of two lines, legend of four lines for a
 * narrow figure, and a number of the budget with title and axis. */
static const double legend_height = 0.12, narrow_legend = 0.24, number_height = 0.31;

/* Begins the names of the bars: at the left, or above each bar if the panels are stacked. */
static void begin_names(figure_drawing *d)
{
    text_add(&d->script, d->stacked ? "unset ytics\nunset label\nunset arrow\n"
                                    : "set ytics () noenhanced scale 0\nunset arrow\n");
}

/* Adds a line of the name of a bar at y; `above` is its distance if the panels are stacked. */
static void add_name(figure_drawing *d, const char *text, double y, double above)
{
    text_add(&d->script, d->stacked ? "set label " : "set ytics add (");
    if (d->stacked) {
        text_quoted(&d->script, text);
        text_format(&d->script, " at graph 0, first %s noenhanced\n", LITERAL(round(y) + above));
    } else {
        text_tic_label(&d->script, text);
        text_format(&d->script, " %s)\n", LITERAL(y));
    }
}

/* Sets the size of a list of panels of bars below each other, whose names need this width beside
 * them, and the margin for them. */
static void begin_bars(figure_drawing *d, double width, double margin)
{
    d->width = d->stacked ? 1 : width;
    text_format(&d->script, "set lmargin %s\nunset key\nset border 1\nset multiplot\n",
                LITERAL(d->stacked ? 3 : margin));
}

/* ---- error against run time ------------------------------------------------------------------ */

enum { PARTS = 28, METHODS = 3, ACROSS = 3 };

/* Lists the distinct texts of a column of timed rows in their order. */
static size_t list_texts(const table_view *t, work_precision_column column, const char *part,
                         const char *texts[], size_t most)
{
    size_t n = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        const char *text = work_precision_text(t, row, column);
        size_t i = 0;
        if (!(work_precision_get(t, row, WORK_PRECISION_SECONDS) > 0))
            continue;
        if (part != NULL && strcmp(work_precision_text(t, row, WORK_PRECISION_PART), part) != 0)
            continue;
        while (i < n && strcmp(texts[i], text) != 0)
            i++;
        if (i == n && n < most)
            texts[n++] = text;
    }
    return n;
}

static int method_style(const char *method)
{
    const int of = closed_list_read(&precision_method_list, method).value;
    return of == METHOD_OF_PROGRAM ? 1 : of == METHOD_OF_TEXTBOOK ? 2 : 3;
}

static void draw_part(figure_drawing *d, const char *part)
{
    static const unsigned columns[] = {WORK_PRECISION_SECONDS, WORK_PRECISION_TRUE_ERROR,
                                       WORK_PRECISION_STATED_ERROR, WORK_PRECISION_REFERENCE_ERROR};
    const schema_field *field = d->table->schema->columns;
    const char *methods[METHODS];
    int section[METHODS];
    const size_t n = list_texts(d->table, WORK_PRECISION_METHOD, part, methods, METHODS);
    value_span time = EMPTY_SPAN, error = EMPTY_SPAN;
    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {
            {WORK_PRECISION_PART, WORK_PRECISION_METHOD}, {part, methods[i]}, NULL};
        section[i] = drawing_section(d, d->table, methods[i], &rows, columns, 4, 2);
        if (section[i] == NO_SECTION)
            continue;
        span_add_section(&time, d, section[i], 0, true);
        span_add_section(&error, d, section[i], 1, true);
        span_add_section(&error, d, section[i], 2, true);
        span_add_section(&error, d, section[i], 3, true);
    }
    if (span_is_empty(&time) || span_is_empty(&error))
        return;
    axis_log(d, AXIS_X, "Processor time", &field[WORK_PRECISION_SECONDS], time);
    axis_log(d, AXIS_Y, "Relative error", &field[WORK_PRECISION_TRUE_ERROR], error);
    plot_heading(d, part);
    for (size_t i = 0; i < n; i++) {
        const int style = method_style(methods[i]);
        plot_item(d, section[i], "($1*x_unit):($4*y_unit) with lines ls 12");
        plot_item(d, section[i], "($1*x_unit):($2*y_unit) with linespoints ls %d", style);
        plot_item(d, section[i], "($1*x_unit):($3>0 ? $3*y_unit : NaN) with linespoints ls %d pt 6",
                  30 + style);
    }
    plot_end(d);
}

static void draw_work_precision(figure_drawing *d)
{
    const char *parts[PARTS], *methods[METHODS];
    const size_t n = list_texts(d->table, WORK_PRECISION_PART, NULL, parts, PARTS),
                 n_methods = list_texts(d->table, WORK_PRECISION_METHOD, NULL, methods, METHODS);
    if (n == 0)
        return;
    const size_t across = drawing_panels(d, n, ACROSS, n > 1 ? 0.9 : 1.1, 0.85);
    const double strip = across > 1 ? legend_height : narrow_legend;
    d->height += strip;
    const double wide = 1 / (double)across, legend = strip / d->height, high = 0.85 / d->height;
    text_add(&d->script, "unset key\nset multiplot\n");
    for (size_t i = 0; i < n; i++) {
        text_format(&d->script, "set size %s,%s\nset origin %s,%s\n", LITERAL(wide), LITERAL(high),
                    LITERAL(wide * (double)(i % across)),
                    LITERAL(1 - legend - high * (double)(i / across + 1)));
        draw_part(d, parts[i]);
    }
    begin_legend(d, legend);
    for (size_t i = 0; i < n_methods; i++) {
        plot_expression(d, "NaN with linespoints ls %d", method_style(methods[i]));
        plot_title(d, methods[i]);
    }
    plot_expression(d, "NaN with linespoints ls 31 pt 6 title 'what it states'");
    plot_expression(d, "NaN with lines ls 12 title 'what the reference is good to'");
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

/* ---- error sources --------------------------------------------------------------------------- */

enum { NUMBERS = 6 };
/* Smallest shown relative error, which is negligible for a measurement. */
static const double least_error = 1e-5;

/* Adjacent rows of one number. */
typedef struct number_panel {
    const char *number;
    size_t first, n;
    value_span span;
} number_panel;

static size_t find_numbers(const table_view *t, number_panel panels[NUMBERS])
{
    size_t n = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        const char *number = error_budget_text(t, row, ERROR_BUDGET_NUMBER);
        const double error = error_budget_get(t, row, ERROR_BUDGET_RELATIVE_ERROR);
        if (n == 0 || strcmp(panels[n - 1].number, number) != 0) {
            if (n == NUMBERS)
                break;
            panels[n++] = (number_panel){number, row, 0, {least_error, least_error}};
        }
        panels[n - 1].n++;
        if (error > least_error)
            span_add(&panels[n - 1].span, error, true);
    }
    return n;
}

static int kind_style(error_kind kind)
{
    return kind == ERROR_MEASURED ? 1 : kind == ERROR_MODEL ? 2 : 5;
}

static void draw_bars(figure_drawing *d, const number_panel *p, size_t from, error_kind kind)
{
    static const unsigned columns[] = {ERROR_BUDGET_RELATIVE_ERROR, ERROR_BUDGET_SHARE};
    const row_filter rows = {
        {ERROR_BUDGET_NUMBER, ERROR_BUDGET_KIND}, {p->number, error_kind_text(kind)}, NULL};
    const size_t top = p->first + p->n - 1 - from;
    const char *const half = d->stacked ? "0.17" : "0.3"; /* of the height of a bar */
    plot_item(d, drawing_section(d, d->table, error_kind_text(kind), &rows, columns, 2, 1),
              "($1>%s ? %s*x_unit : NaN):(%zu-$0):(%s*x_unit):($1*x_unit):(%zu-$0-%s):(%zu-$0+%s) "
              "with boxxyerror ls %d",
              LITERAL(least_error), LITERAL(least_error), top, LITERAL(least_error), top, half, top,
              half, kind_style(kind));
}

/* Draws a line at the largest error of a kind, which improvements of other kinds cannot reduce. */
static void draw_floor(figure_drawing *d, const number_panel *p, error_kind kind)
{
    double largest = 0;
    for (size_t row = p->first; row < p->first + p->n; row++)
        if (error_budget_enum(d->table, row, ERROR_BUDGET_KIND) == (int)kind)
            largest = fmax(largest, error_budget_get(d->table, row, ERROR_BUDGET_RELATIVE_ERROR));
    if (largest > least_error)
        text_format(&d->script,
                    "set arrow from %s*x_unit, graph 0 to %s*x_unit, graph 1 nohead ls %d dt 3 "
                    "back\n",
                    LITERAL(largest), LITERAL(largest), kind_style(kind));
}

/* Adds the name of a source with its computation time, if known. */
static void add_source_name(figure_drawing *d, size_t row, size_t y)
{
    const double seconds = error_budget_get(d->table, row, ERROR_BUDGET_SECONDS);
    char words[96], time[32] = "";
    if (seconds > 0)
        wt_format_si(seconds, "s", 2, time, sizeof time);
    snprintf(words, sizeof words, "%s%s%s", error_budget_text(d->table, row, ERROR_BUDGET_SOURCE),
             time[0] != '\0' ? ", " : "", time);
    add_name(d, words, (double)y, 0.5);
}

static void draw_number(figure_drawing *d, const number_panel *p)
{
    const table_view *t = d->table;
    axis_log(d, AXIS_X, "Relative error", &t->schema->columns[ERROR_BUDGET_RELATIVE_ERROR],
             p->span);
    text_format(&d->script, "set yrange [-0.7:%zu.7]\n", p->n - 1);
    begin_names(d);
    for (size_t i = 0; i < p->n; i++)
        add_source_name(d, p->first + i, p->n - 1 - i);
    draw_floor(d, p, ERROR_TOGETHER);
    draw_floor(d, p, ERROR_MODEL);
    plot_heading(d, p->number);
    error_kind last = ERROR_KIND_UNKNOWN;
    for (size_t row = p->first; row < p->first + p->n; row++) {
        const error_kind kind = (error_kind)error_budget_enum(t, row, ERROR_BUDGET_KIND);
        if (kind != last)
            draw_bars(d, p, row, kind);
        last = kind;
    }
    plot_end(d);
}

static void draw_error_budget(figure_drawing *d)
{
    number_panel panels[NUMBERS];
    const size_t all = find_numbers(d->table, panels);
    size_t n = 0;
    double top = 0;
    for (size_t i = 0; i < all; i++)
        if (panels[i].span.high > least_error)
            panels[n++] = panels[i];
    const double legend = d->stacked ? narrow_legend : legend_height,
                 bar_height = d->stacked ? 0.09 : 0.055;
    d->height = legend;
    for (size_t i = 0; i < n; i++)
        d->height += number_height + bar_height * (double)panels[i].n;
    top = legend / d->height;
    if (n > 0)
        begin_bars(d, 1.3, 42);
    for (size_t i = 0; i < n; i++) {
        const double height = (number_height + bar_height * (double)panels[i].n) / d->height;
        top += height;
        text_format(&d->script, "set size 1,%s\nset origin 0,%s\n", LITERAL(height),
                    LITERAL(1 - top));
        draw_number(d, &panels[i]);
    }
    if (n == 0)
        return;
    begin_legend(d, legend / d->height);
    plot_expression(d, "NaN with boxes ls 1 title 'measured or stated'");
    plot_expression(d, "NaN with boxes ls 2 title 'choice of the model'");
    plot_expression(d, "NaN with boxes ls 5 title 'together, draws, arithmetic'");
    plot_expression(d, "NaN with lines ls %d dt 3 title 'floor of what is measured'",
                    kind_style(ERROR_TOGETHER));
    plot_expression(d, "NaN with lines ls %d dt 3 title 'floor of the model'",
                    kind_style(ERROR_MODEL));
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

/* ---- time and error of each stage ------------------------------------------------------------ */

static size_t name_stages(figure_drawing *d)
{
    const table_view *t = d->table;
    size_t n = 0;
    text_add(&d->script, "set ytics (");
    for (size_t row = 0; row < t->n_rows; row++) {
        if (!(cost_get(t, row, COST_RUNS) > 0))
            continue;
        text_add(&d->script, n > 0 ? ", " : "");
        char words[96];
        snprintf(words, sizeof words, "%s", cost_text(t, row, COST_STAGE));
        for (char *c = words; (c = strchr(c, '_')) != NULL;)
            *c = ' ';
        text_tic_label(&d->script, words);
        text_format(&d->script, " -%zu", ++n);
    }
    text_format(&d->script, ") noenhanced scale 0\nset yrange [-%zu.7:-0.3]\n", n);
    return n;
}

/* Position of a stage: -k for the k-th stage that ran. Other stages have no line. */
#define STAGE_POSITION "($2>0 ? -(k=k+1) : NaN)"

static void draw_cost(figure_drawing *d)
{
    static const unsigned columns[] = {COST_CPU_TIME, COST_RUNS, COST_STANDARD_ERROR,
                                       COST_ERROR_ESTIMATED};
    const table_view *t = d->table;
    const row_filter all = {{0, 0}, {NULL, NULL}, NULL};
    value_span time = EMPTY_SPAN, error = EMPTY_SPAN;
    span_add_column(&time, t, COST_CPU_TIME, true);
    span_add_column(&error, t, COST_STANDARD_ERROR, true);
    span_add_column(&error, t, COST_ERROR_ESTIMATED, true);
    const int section =
        span_is_empty(&time) ? NO_SECTION : drawing_section(d, t, "cost", &all, columns, 4, 2);
    if (section == NO_SECTION)
        return;
    time.low = 0;
    d->width = 1.6;
    text_add(&d->script, "set border 1\nset multiplot\nset size 0.62,1\nset lmargin 34\n"
                         "set tmargin 3\nunset key\n");
    d->height = 0.3 + 0.08 * (double)name_stages(d);
    d->narrow = true;
    axis_linear(d, AXIS_X, "Processor time", &t->schema->columns[COST_CPU_TIME], time);
    text_add(&d->script, "k=0\n");
    plot_item(d, section,
              "(0):" STAGE_POSITION ":(0):($1*x_unit):(-k-0.35):(-k+0.35) "
              "with boxxyerror ls 1");
    plot_end(d);
    if (!span_is_empty(&error)) {
        text_add(&d->script, "set origin 0.62,0\nset size 0.38,1\nset lmargin 2\n"
                             "unset ytics\nset key outside top center horizontal\n");
        axis_log(d, AXIS_X, "Relative error", &t->schema->columns[COST_STANDARD_ERROR], error);
        text_add(&d->script, "k=0\nj=0\n");
        plot_item(d, section,
                  "($3>0 ? $3*x_unit : NaN):" STAGE_POSITION
                  " with points ls 1 title 'standard error'");
        plot_item(d, section,
                  "($4>0 ? $4*x_unit : NaN):($2>0 ? -(j=j+1) : NaN)"
                  " with points ls 2 pt 6 title 'numerical error'");
        plot_end(d);
    }
    text_add(&d->script, "unset multiplot\n");
}

const figure_description figures_accuracy[] = {
    {.name = "work_precision",
     .title = "Error against run time",
     .table = &work_precision_schema,
     .empty_reason = "no numerical part was timed",
     .caption_text =
         "True error of each numerical part against its processor time as the setting is swept "
         "(full marks), and the error that the method states (open marks, dashed): for the "
         "arithmetic a bound, which should lie on or above the true error; for noise and draws "
         "a standard error, which is of the size of the true error. Lower and further left is "
         "better. Grey line: error of the reference; smaller errors are drawn there.",
     .draw = draw_work_precision},
    {.name = "error_budget",
     .title = "Where the errors come from",
     .table = &error_budget_schema,
     .empty_reason = "no error of these numbers is known",
     .caption_text =
         "What each source alone does to the numbers at the reference velocity, relative, on a "
         "logarithmic scale from 10^-5, with the elapsed time that it takes to know it: one "
         "standard error of what is measured or stated "
         "(blue), half the range of a choice of the model (orange), and (grey) all that is "
         "measured together, the scatter of that by the number of replicates, and the "
         "arithmetic, which is left out where it is smaller. The dotted lines are the floors: all "
         "that is measured (grey) and the widest choice of the model (orange); a smaller error of "
         "another source does not take the number below them.",
     .draw = draw_error_budget},
    {.name = "cost",
     .in_depth = true,
     .title = "Time and error of each stage",
     .table = &cost_schema,
     .empty_reason = "no stage was timed",
     .caption_text =
         "Processor time of each stage that ran (left), and the relative errors it leaves "
         "(right): the standard error of its main number (full marks) and its numerical error "
         "(open marks), of a fit the change by a further iteration. A tighter tolerance does "
         "not help where the open mark lies left of the full one.",
     .draw = draw_cost},
    {.name = NULL},
};

/* ---- choices of the model -------------------------------------------------------------------- */

enum { MOST_BARS = 16, TRIED = 256, PANELS = 3 };

/* Range of a number over a choice. */
typedef struct bar {
    int choice;
    const char *words;
    char tried[TRIED];
    double low, high;
} bar;

typedef struct panel {
    what_if_column column;
    const char *label;
    wt_estimate used; /* with its standard error */
    bar bars[MOST_BARS];
    size_t n;
} panel;

static int compare_widths(const void *a, const void *b)
{
    const bar *p = a, *q = b;
    const double more = (p->high - p->low) - (q->high - q->low);
    return more > 0 ? 1 : more < 0 ? -1 : q->choice - p->choice;
}

/* Appends "2e5; 2e7 rad/m": the unit appears once. */
static void append_tried(bar *b, const char *tried)
{
    size_t length = strlen(b->tried);
    const char *unit = strrchr(tried, ' ');
    const size_t of_unit = unit != NULL ? strlen(unit) : 0;
    if (of_unit > 0 && of_unit < length && strcmp(b->tried + length - of_unit, unit) == 0)
        length -= of_unit;
    (void)snprintf(b->tried + length, TRIED - length, "%s%s", length > 0 ? "; " : "", tried);
}

/* Collects the adjacent rows of each choice. A choice without an effect has no bar. The widest bar
 * comes last, at the top. */
static void fill_panel(panel *p, const table_view *table)
{
    for (size_t row = 1; row < table->n_rows; row++) {
        const int choice = what_if_enum(table, row, WHAT_IF_CHOICE);
        const double value = what_if_get(table, row, p->column);
        const bool same = p->n > 0 && p->bars[p->n - 1].choice == choice;
        if (!isfinite(value) || (!same && p->n == MOST_BARS))
            continue;
        if (!same)
            p->bars[p->n++] = (bar){.choice = choice,
                                    .words = what_if_text(table, row, WHAT_IF_CHOICE),
                                    .low = p->used.value,
                                    .high = p->used.value};
        bar *b = &p->bars[p->n - 1];
        b->low = fmin(b->low, value);
        b->high = fmax(b->high, value);
        append_tried(b, what_if_text(table, row, WHAT_IF_TRIED));
    }
    qsort(p->bars, p->n, sizeof *p->bars, compare_widths);
    size_t still = 0;
    while (still < p->n && !(p->bars[still].high > p->bars[still].low))
        still++;
    memmove(p->bars, p->bars + still, (p->n - still) * sizeof *p->bars);
    p->n -= still;
}

/* Finds the panels: friction, or its hysteresis part if friction is unknown, and the effects of the
 * layer. */
static size_t find_choice_panels(const figure_drawing *d, panel panels[PANELS])
{
    const table_view *friction = &d->tables->friction, *layer = &d->tables->layer;
    const bool total = isfinite(what_if_get(d->table, 0, WHAT_IF_FRICTION));
    const panel possible[PANELS] = {
        {.column = total ? WHAT_IF_FRICTION : WHAT_IF_HYSTERESIS,
         .label = total ? "Friction coefficient μ" : "Hysteresis friction coefficient",
         .used = friction_value(friction, total ? FRICTION_KEY_FRICTION : FRICTION_KEY_HYSTERESIS)},
        {.column = WHAT_IF_WITH_LAYER,
         .label = "Friction coefficient μ with layer",
         .used = friction_value(friction, FRICTION_KEY_WITH_LAYER)},
        {.column = WHAT_IF_THICKNESS,
         .label = "Layer thickness",
         .used = layer_value(layer, LAYER_KEY_BALANCE_THICKNESS)}};
    size_t n = 0;
    for (size_t i = 0; i < PANELS; i++) {
        panels[n] = possible[i];
        panels[n].used.value = what_if_get(d->table, 0, possible[i].column);
        if (isfinite(panels[n].used.value))
            fill_panel(&panels[n], d->table);
        n += panels[n].n > 0;
    }
    return n;
}

/* Adds the two lines of the name of a bar. The second may be empty. */
static void add_bar_name(figure_drawing *d, size_t place, const char *first, const char *second)
{
    add_name(d, first, (double)place + 0.2, 0.72);
    add_name(d, second, (double)place - 0.2, 0.36);
}

static int add_bar_section(figure_drawing *d, const panel *p, const char *title, double low,
                           double high)
{
    static const char *const columns[] = {"used", "low", "high", NULL};
    const char *unit = schema_unit(&d->table->schema->columns[p->column]);
    const char *const units[] = {unit, unit, unit, NULL};
    const double values[] = {p->used.value, low, high};
    return drawing_number_section(d, title, columns, units, values, 1);
}

static void draw_choice_panel(figure_drawing *d, const panel *p)
{
    const double two_sided = 1.959964 * p->used.standard_error;
    const bool chance = two_sided > 0 && isfinite(two_sided);
    value_span span = EMPTY_SPAN;
    const char *const half = d->stacked ? "0.11" : "0.26"; /* of the height of a bar */
    span_add(&span, 0, false);
    span_add(&span, p->used.value, false);
    span_add(&span, p->used.value + (chance ? two_sided : 0), false);
    for (size_t i = 0; i < p->n; i++) {
        span_add(&span, p->bars[i].low, false);
        span_add(&span, p->bars[i].high, false);
    }
    axis_linear(d, AXIS_X, p->label, &d->table->schema->columns[p->column], span);
    text_format(&d->script, "set yrange [%s:%zu.%d]\n", d->stacked ? "-0.3" : "-0.6",
                p->n - 1 + chance, d->stacked ? 9 : 6);
    begin_names(d);
    for (size_t i = 0; i < p->n; i++)
        add_bar_name(d, i, p->bars[i].words, p->bars[i].tried);
    if (chance)
        add_bar_name(d, p->n, "errors that are known", "95 % interval");
    text_format(&d->script,
                "set arrow from %s*x_unit, graph 0 to %s*x_unit, graph 1 nohead ls 12 back\n",
                LITERAL(p->used.value), LITERAL(p->used.value));
    for (size_t i = 0; i < p->n; i++)
        plot_item(d, add_bar_section(d, p, p->bars[i].words, p->bars[i].low, p->bars[i].high),
                  "($1*x_unit):(%zu):($2*x_unit):($3*x_unit):(%zu-%s):(%zu+%s) with "
                  "boxxyerror ls 1",
                  i, i, half, i, half);
    if (chance)
        plot_item(d,
                  add_bar_section(d, p, "errors that are known", p->used.value - two_sided,
                                  p->used.value + two_sided),
                  "($1*x_unit):(%zu):($2*x_unit):($3*x_unit) with xerrorbars ls 13", p->n);
    plot_end(d);
}

/* Height relative to one panel of the style. */
static double panel_height(const figure_drawing *d, const panel *p)
{
    return 0.25 + (d->stacked ? 0.135 : 0.11) * (double)(p->n + 1);
}

static void draw_what_if(figure_drawing *d)
{
    panel *panels = wt_alloc(PANELS, sizeof *panels);
    const size_t n = find_choice_panels(d, panels);
    double margin = 26, top = 0; /* the margin is in character cells, which are wider than an
                                    average letter */
    d->height = 0;
    for (size_t i = 0; i < n; i++) {
        d->height += panel_height(d, &panels[i]);
        for (size_t k = 0; k < panels[i].n; k++)
            margin = fmax(margin, 2 + 0.83 * (double)strlen(panels[i].bars[k].tried));
    }
    if (n > 0)
        begin_bars(d, 0.8 + 0.017 * margin, margin);
    for (size_t i = 0; i < n; i++) {
        const double height = panel_height(d, &panels[i]) / d->height;
        top += height;
        text_format(&d->script, "set size 1,%s\nset origin 0,%s\n", LITERAL(height),
                    LITERAL(1 - top));
        draw_choice_panel(d, &panels[i]);
    }
    if (n > 0)
        text_add(&d->script, "unset multiplot\n");
    free(panels);
}

const figure_description figures_what_if[] = {
    {.name = "what_if",
     .title = "What if a choice of the model were another",
     .table = &what_if_schema,
     .other_tables = "friction layer",
     .empty_reason = "no choice of the model moves a number",
     .caption_text =
         "How far each choice of the model moves the numbers at the reference velocity: a bar "
         "goes from the lowest to the highest one, with everything else as used (dashed "
         "line); below its name is what was tried. On top: the 95 % interval of the errors "
         "that are measured or stated.",
     .draw = draw_what_if},
    {.name = NULL},
};
