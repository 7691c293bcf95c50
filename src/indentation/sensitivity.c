/* Job of the deflection sensitivity from curves on a hard surface. It uses approach and retract,
 * computes their scatter, and tests the stiffness of the surface and the linearity of the
 * detector.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/math/students_t.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "weartrack/indentation.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/data/force_curve.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of directions (approach, retract) and of table rows (these and their mean). */
enum { DIRECTIONS = 2, ROWS = 3 };
/* Smallest number of curves of a file for the exclusion of outliers. Of eight normal values the
 * exclusion rejects one by chance in 5 % of the files, of five in 11 %. */
enum { OUTLIER_MIN_CURVES = 8 };
static const wt_segment_kind kinds[DIRECTIONS] = {WT_SEGMENT_APPROACH, WT_SEGMENT_RETRACT};

wt_sensitivity_job wt_sensitivity_job_defaults(void)
{
    /* Changes of 5 % bias the mean slope by less than half of that, which is less than the error
     * that is assumed for a sensitivity of unknown error, 3 %. */
    return (wt_sensitivity_job){.options = wt_slope_defaults(), .max_slope_change = 0.05};
}

static const wt_param job_rows[] = {
    {PARAM_CHOICE_OF("direction", wt_sensitivity_job, directions, "both|approach|retract"),
     .flags = PARAM_NO_CASE,
     .help = "which parts of the curves the result uses; the mean of both is free of friction "
             "of the tip and of the piezo's hysteresis to first order"},
    {PARAM("max-slope-change", wt_sensitivity_job, max_slope_change, WT_Q_NONE, ABOVE(0)),
     .former = "most-bend", .value = "X", .flags = PARAM_NO_CASE,
     .help = "largest change of the slope within the part, of the slope, that is still straight"},
};
PARAM_TABLE(wt_sensitivity_job_params, wt_sensitivity_job, job_rows, wt_sensitivity_job_defaults,
            PARAM_PART(wt_slope_params, wt_sensitivity_job, options))

/* ---- reading --------------------------------------------------------------------------------- */

/* Slopes of the two branches of a curve. A force is divided by the spring constant to obtain the
 * deflection. */
typedef struct curve_slopes {
    const flow_file *file;
    long unit;
    size_t curve;
    bool has_segment[DIRECTIONS], outlier;
    bool volts;              /* if false, the signal is a deflection in metres */
    double file_sensitivity; /* sensitivity [m/V]; NaN if not stated */
    wt_contact_slope direction[DIRECTIONS];
} curve_slopes;

typedef struct sensitivity_task {
    const wt_sensitivity_job *job;
    const wt_job *work;
    curve_slopes *items; /* [n] */
    size_t n;
} sensitivity_task;

static wt_status measure_slopes(const sensitivity_task *task, const wt_force_curve *curve,
                                wt_quantity signal, curve_slopes *it, wt_error *err)
{
    wt_status status = WT_OK;
    it->file_sensitivity = curve->cantilever.sensitivity;
    it->volts = signal == WT_Q_DEFLECTION_VOLTAGE;
    it->curve = curve->index;
    for (size_t w = 0; w < DIRECTIONS && status == WT_OK; w++) {
        const wt_segment *segment = wt_force_curve_segment(curve, kinds[w]);
        if (segment == NULL)
            continue;
        const double *height = segment_height(segment);
        const wt_channel *channel = wt_segment_channel(segment, signal);
        it->has_segment[w] = true;
        if (height != NULL && channel != NULL)
            status = wt_contact_slope_fit(height, channel->values, segment->n_points,
                                          &task->job->options, &it->direction[w], err);
        else
            snprintf(it->direction[w].reason, sizeof it->direction[w].reason, "no %s in the curve",
                     height == NULL ? "height" : "deflection");
    }
    for (size_t w = 0; w < DIRECTIONS && signal == WT_Q_FORCE; w++) {
        it->direction[w].slope /= curve->cantilever.spring_constant;
        it->direction[w].slope_error /= curve->cantilever.spring_constant;
        it->direction[w].found = it->direction[w].found && isfinite(it->direction[w].slope);
        if (isnan(curve->cantilever.spring_constant))
            snprintf(it->direction[w].reason, sizeof it->direction[w].reason,
                     "a force without a spring constant: give --spring-constant 0.1N/m");
    }
    return status;
}

/* Reads all curves of a file with one signal. *no_signal is true if the first curve lacks it; then
 * no curve is read. */
static wt_status read_sensitivity_curves(sensitivity_task *task, flow_file *file, long unit,
                                         wt_input *input, wt_quantity signal, bool *no_signal,
                                         wt_error *err)
{
    wt_read_options options = flow_read_options(file);
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    bool first = true;
    copied_curves copies = {0};
    size_t n_read = 0;
    options.want = WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) | WT_Q_BIT(signal);
    options.sensor_height_only = true;
    options.segments = WT_SEGMENT_BIT(WT_SEGMENT_APPROACH) | WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
    wt_status status =
        wt_force_open(task->work->formats, input, &options, task->work->log, &source, err);
    *no_signal = false;
    while (status == WT_OK) {
        status = wt_force_next(source, &curve, err);
        if (status != WT_OK)
            break;
        if (first && curve.n_segments > 0) {
            first = false;
            *no_signal = wt_segment_channel(&curve.segments[0], signal) == NULL;
            if (*no_signal)
                break;
        }
        n_read++;
        task->items = array_grow(task->items, task->n, sizeof *task->items);
        curve_slopes *const it = &task->items[task->n];
        *it = (curve_slopes){.file = file, .unit = unit};
        status = measure_slopes(task, &curve, signal, it, err);
        const bool has_slope = it->direction[0].found || it->direction[1].found;
        if (!has_slope || !flow_is_copied_curve(file, condition_hash_curve(file, &curve), &copies))
            task->n++;
    }
    flow_log_copies(file, &copies, n_read, task->work);
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    return status == WT_END ? WT_OK : status;
}

/* Reads the detector signal in volts, or the deflection in metres if the file has no volts. */
static wt_status read_sensitivity_file(void *user, flow_file *file, size_t unit, wt_error *err)
{
    sensitivity_task *task = user;
    static const wt_quantity signals[] = {WT_Q_DEFLECTION_VOLTAGE, WT_Q_DEFLECTION, WT_Q_FORCE};
    wt_input *input = NULL;
    bool no_signal = true;
    wt_status status = flow_open(task->work, file, WT_ROLE_SENSITIVITY, WT_KIND_FORCE, &input, err);
    for (size_t i = 0; i < COUNT_OF(signals) && status == WT_OK && no_signal; i++)
        status =
            read_sensitivity_curves(task, file, (long)unit, input, signals[i], &no_signal, err);
    if (status == WT_OK && no_signal) {
        status = wt_fail(err, WT_E_MISSING, "the curves have no deflection");
        wt_error_expected(err, "a channel of deflection in volts or metres, or of force");
        wt_error_advice(err, "`weartrack info FILE` shows what a file holds");
    }
    wt_input_close(input);
    return status;
}

/* ---- curves ---------------------------------------------------------------------------------- */

static bool has_found_slope(const curve_slopes *it, size_t direction)
{
    return it->has_segment[direction] && it->direction[direction].found;
}

static double travel_per_signal(const curve_slopes *it, size_t direction)
{
    return 1 / it->direction[direction].slope;
}

static double curve_sensitivity(const curve_slopes *it, size_t direction)
{
    return it->volts ? travel_per_signal(it, direction) : (double)NAN;
}

static double sensitivity_factor(const curve_slopes *it, size_t direction)
{
    return travel_per_signal(it, direction) / (it->volts ? it->file_sensitivity : 1);
}

/* Marks curves of one file whose slope in one direction is an outlier. */
static void mark_file_outliers(curve_slopes *items, size_t n, size_t direction, double *values)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (has_found_slope(&items[i], direction))
            values[m++] = travel_per_signal(&items[i], direction);
    if (m < OUTLIER_MIN_CURVES)
        return;
    const typical_values typical = flow_typical_values(values, m);
    for (size_t i = 0; i < n; i++)
        if (has_found_slope(&items[i], direction) &&
            fabs(travel_per_signal(&items[i], direction) - typical.middle) > typical.most)
            items[i].outlier = true;
}

static void mark_outliers(sensitivity_task *task)
{
    double *values = wt_alloc(task->n, sizeof *values);
    for (size_t first = 0, end; first < task->n; first = end) {
        for (end = first + 1; end < task->n && task->items[end].unit == task->items[first].unit;)
            end++;
        for (size_t w = 0; w < DIRECTIONS; w++)
            mark_file_outliers(task->items + first, end - first, w, values);
    }
    free(values);
}

/* Checks that all curves use the same unit. Volts yield the sensitivity and metres its correction
 * factor, so a common mean has no meaning. */
static wt_status check_signals(const sensitivity_task *task, wt_error *err)
{
    const curve_slopes *volts = NULL, *metres = NULL;
    for (size_t i = 0; i < task->n; i++) {
        const curve_slopes *it = &task->items[i];
        const curve_slopes **const of = it->volts ? &volts : &metres;
        *of = *of == NULL ? it : *of;
    }
    if (volts == NULL || metres == NULL)
        return WT_OK;
    wt_fail(err, WT_E_AMBIGUOUS, "curves in volts of the detector and curves in metres");
    wt_error_expected(err, "those of one of them");
    wt_error_found(err, "%s in volts, %s in metres", volts->file->name, metres->file->name);
    wt_error_advice(err, "give each in a call of its own: a deflection in volts gives the "
                         "sensitivity, one in metres the factor on that of the file");
    return WT_E_AMBIGUOUS;
}

static wt_status create_curve_table(const sensitivity_task *task, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&sensitivity_curves_schema, err);
    sensitivity_curves_set_print(&t, SENSITIVITY_CURVES_KEY_FROM, "%g", task->job->options.from);
    sensitivity_curves_set_print(&t, SENSITIVITY_CURVES_KEY_TO, "%g", task->job->options.to);
    for (size_t i = 0; i < task->n; i++)
        for (size_t w = 0; w < DIRECTIONS; w++) {
            const curve_slopes *it = &task->items[i];
            const wt_contact_slope *c = &it->direction[w];
            if (!it->has_segment[w])
                continue;
            table_row(&t);
            sensitivity_curves_put_text(&t, SENSITIVITY_CURVES_FILE, it->file->name);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_CURVE, (double)it->curve);
            sensitivity_curves_put_text(&t, SENSITIVITY_CURVES_DIRECTION,
                                        wt_segment_kind_name(kinds[w]));
            sensitivity_curves_put_text(&t, SENSITIVITY_CURVES_VERDICT,
                                        !c->found     ? c->reason
                                        : it->outlier ? "left out: far from the other curves"
                                                      : "used");
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_POINTS, (double)c->n);
            if (!c->found)
                continue;
            const double s = curve_sensitivity(it, w);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_SENSITIVITY, s);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_SENSITIVITY_STANDARD_ERROR,
                                   s * c->slope_error / c->slope);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_FACTOR, sensitivity_factor(it, w));
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_CHANGE, c->change);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_CHANGE_STANDARD_ERROR, c->change_error);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_TILT, c->tilt);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_MISFIT, c->misfit);
            sensitivity_curves_put(&t, SENSITIVITY_CURVES_TRAVEL, c->travel);
        }
    return table_end(&t, table);
}

/* ---- all curves combined --------------------------------------------------------------------- */

/* Results of the curves that have the directions of a row. */
typedef struct direction_group {
    size_t n, n_units;
    wt_interval sensitivity, factor, change, difference; /* difference: retract over approach */
    double tilt, curve_error; /* of one curve alone, of the sensitivity */
    double scatter;           /* of a unit, of the sensitivity */
    double surface_share;     /* of the sensitivity, that a soft surface may add */
    double direction_error;   /* error of the sensitivity due to the difference of the directions;
                                 NaN: unknown */
    slope_verdict verdict;
    bool refused;
} direction_group;

typedef struct collected_values {
    double *values; /* [n] */
    long *units;
    size_t n;
    const curve_slopes *last;
} collected_values;

static bool is_usable_curve(const curve_slopes *it, size_t row)
{
    return !it->outlier && (row < DIRECTIONS ? has_found_slope(it, row)
                                             : has_found_slope(it, 0) && has_found_slope(it, 1));
}

/* Sets the interval of the slope change and the error of the sensitivity of one curve from the
 * scatter within it. */
static void use_scatter_within(direction_group *g, const curve_slopes *it, size_t row)
{
    const bool both = row == DIRECTIONS;
    const wt_contact_slope *const a = &it->direction[both ? 0 : row], *const b = &it->direction[1];
    const double error = both ? hypot(a->change_error, b->change_error) / 2 : a->change_error,
                 half = wt_student_quantile(both ? fmin(a->df, b->df) : a->df) * error,
                 value = g->change.value, of_a = a->slope_error / a->slope;
    g->change = (wt_interval){value, error, value - half, value + half};
    g->curve_error = both ? hypot(of_a, b->slope_error / b->slope) / 2 : of_a;
}

static void assess_linearity(direction_group *g, double most)
{
    const wt_interval *c = &g->change;
    const bool rises = c->value > most && c->low > 0, falls = c->value < -most && c->high < 0;
    g->refused = rises || falls;
    g->verdict = rises                                ? SLOPE_RISES
                 : falls                              ? SLOPE_FALLS
                 : c->low >= -most && c->high <= most ? SLOPE_STRAIGHT
                                                      : SLOPE_INCONCLUSIVE;
}

static double slope_change(const curve_slopes *it, size_t direction)
{
    return it->direction[direction].change;
}

static double baseline_tilt_ratio(const curve_slopes *it, size_t direction)
{
    return it->direction[direction].tilt;
}

static double retract_over_approach_ratio(const curve_slopes *it, size_t direction)
{
    (void)direction;
    return travel_per_signal(it, 1) / travel_per_signal(it, 0);
}

/* Returns the mean over the curves of the mean of `of` over the directions of a row. */
static wt_interval curve_mean(const sensitivity_task *task, size_t row, collected_values *c,
                              size_t *n_units,
                              double (*of)(const curve_slopes *it, size_t direction))
{
    c->n = 0;
    for (size_t i = 0; i < task->n; i++) {
        const curve_slopes *it = &task->items[i];
        const double value = !is_usable_curve(it, row) ? (double)NAN
                             : row < DIRECTIONS        ? of(it, row)
                                                       : 0.5 * (of(it, 0) + of(it, 1));
        if (isnan(value))
            continue;
        c->values[c->n] = value;
        c->units[c->n++] = it->unit;
        c->last = it;
    }
    return wt_student_mean(c->values, c->units, c->n, n_units);
}

/* What parts the ways (friction of the tip, hysteresis and creep of the piezo) is in both, and no
 * curve tells how much in each: the sensitivity lies anywhere between them. The standard deviation
 * of that about their mean is the difference over sqrt(12), about one of them over sqrt(3); an
 * interval of 95 % about the mean then holds both ways. */
static double direction_error(size_t row, double retract_over_approach)
{
    const double of[ROWS] = {1, retract_over_approach, (1 + retract_over_approach) / 2};
    return fabs(retract_over_approach - 1) / of[row] / sqrt(row < DIRECTIONS ? 3 : 12);
}

static void widen_interval(wt_interval *i, double relative)
{
    const double low = hypot(i->value - i->low, NORMAL_95 * relative * i->value),
                 high = hypot(i->high - i->value, NORMAL_95 * relative * i->value);
    i->standard_error = hypot(i->standard_error, relative * i->value);
    i->low = i->value - low;
    i->high = i->value + high;
}

/* Relative bias of the sensitivity per slope change. On an elastic surface a sphere adds a travel ~
 * deflection^(2/3) to that of the cantilever. The function compares a linear and a quadratic fit to
 * the part. */
static double sphere_share(const wt_slope_options *o)
{
    enum { NODES = 200 }; /* Chebyshev nodes of the smooth integrand */
    double line = 0, parabola = 0;
    for (int i = 0; i < NODES; i++) {
        const double x = (2.0 * i + 1) / NODES - 1;
        const double u = pow(o->from + 0.5 * (o->to - o->from) * (1 + x), 2.0 / 3);
        line += 1.5 * u * x;
        parabola += 2.5 * u * (1.5 * x * x - 0.5);
    }
    return line / (-6 * parabola);
}

/* Adds the errors that no scatter shows: of the directions, if a curve has both, and of a surface
 * like a sphere's contact, so that the interval holds a rigid one and one of the largest change. */
static void add_systematic_errors(direction_group groups[ROWS], const wt_slope_options *options)
{
    const double difference =
        groups[DIRECTIONS].n > 0 ? groups[DIRECTIONS].difference.value : (double)NAN;
    for (size_t row = 0; row < ROWS; row++) {
        direction_group *g = &groups[row];
        const wt_interval *of = isnan(g->sensitivity.value) ? &g->factor : &g->sensitivity;
        g->scatter = of->standard_error * sqrt((double)g->n_units) / of->value;
        g->direction_error = direction_error(row, difference);
        g->surface_share =
            isnan(g->change.high) ? (double)NAN : sphere_share(options) * fmax(0, g->change.high);
        const double error = hypot(isnan(g->direction_error) ? 0 : g->direction_error,
                                   isnan(g->surface_share) ? 0 : g->surface_share / NORMAL_95);
        widen_interval(&g->sensitivity, error);
        widen_interval(&g->factor, error);
    }
}

static void compute_groups(const sensitivity_task *task, direction_group groups[ROWS])
{
    collected_values c = {wt_alloc(task->n, sizeof *c.values), wt_alloc(task->n, sizeof *c.units),
                          0, NULL};
    for (size_t row = 0; row < ROWS; row++) {
        direction_group *g = &groups[row];
        size_t ignored;
        g->sensitivity = curve_mean(task, row, &c, &ignored, curve_sensitivity);
        g->factor = curve_mean(task, row, &c, &ignored, sensitivity_factor);
        g->tilt = curve_mean(task, row, &c, &ignored, baseline_tilt_ratio).value;
        g->change = curve_mean(task, row, &c, &g->n_units, slope_change);
        g->n = c.n;
        if (g->n == 0)
            continue;
        if (g->n == 1)
            use_scatter_within(g, c.last, row);
        if (row == DIRECTIONS)
            g->difference = curve_mean(task, row, &c, &ignored, retract_over_approach_ratio);
        assess_linearity(g, task->job->max_slope_change);
    }
    add_systematic_errors(groups, &task->job->options);
    free(c.values);
    free(c.units);
}

/* Sets a number, its error and the limits of its interval. Their columns must be consecutive. */
static void set_interval_columns(table_writer *t, sensitivity_column first, wt_interval i)
{
    sensitivity_put(t, first, i.value);
    sensitivity_put(t, first + 1, i.standard_error);
    sensitivity_put(t, first + 2, i.low);
    sensitivity_put(t, first + 3, i.high);
}

/* Continues the text of a verdict. */
static const char *const verdict_reasons[] = {
    [SLOPE_STRAIGHT] = "",
    [SLOPE_RISES] = ": the slope rises with the deflection",
    [SLOPE_FALLS] = ": the slope falls with the deflection",
    [SLOPE_INCONCLUSIVE] = ": the slope scatters too much to show whether the surface is hard"};

/* The first two rows are the directions. */
static void add_group_row(table_writer *t, slope_direction row, const direction_group *g)
{
    char note[160] = "", verdict[96];
    snprintf(verdict, sizeof verdict, "%s%s", slope_verdict_text(g->verdict),
             verdict_reasons[g->verdict]);
    if (g->n == 1)
        snprintf(note, sizeof note,
                 "one curve: the scatter between curves is not known; standard error within the "
                 "curve %s",
                 format_percent(g->curve_error).text);
    table_row(t);
    sensitivity_put_text(t, SENSITIVITY_DIRECTION, slope_direction_text((slope_direction)row));
    sensitivity_put(t, SENSITIVITY_N, (double)g->n);
    sensitivity_put(t, SENSITIVITY_UNITS, (double)g->n_units);
    sensitivity_put_text(t, SENSITIVITY_VERDICT, verdict);
    sensitivity_put_text(t, SENSITIVITY_NOTE, note);
    sensitivity_put(t, SENSITIVITY_TILT, g->tilt);
    set_interval_columns(t, SENSITIVITY_CHANGE, g->change);
    sensitivity_put(t, SENSITIVITY_SHARE, g->surface_share);
    if (g->refused)
        return;
    set_interval_columns(t, SENSITIVITY_VALUE, g->sensitivity);
    set_interval_columns(t, SENSITIVITY_FACTOR, g->factor);
    sensitivity_put(t, SENSITIVITY_SCATTER, g->scatter);
    sensitivity_put(t, SENSITIVITY_WAYS_ERROR, g->direction_error);
}

/* Writes options for other subcommands. */
static void set_option_keys(table_writer *t, const direction_group *g)
{
    const double share = g->sensitivity.standard_error / g->sensitivity.value;
    if (!isnan(g->sensitivity.value))
        sensitivity_set_print(t, SENSITIVITY_KEY_INDENT, "--sensitivity %.6gnm/V",
                              1e9 * g->sensitivity.value);
    if (share > 0)
        sensitivity_set_print(t, SENSITIVITY_KEY_COMPARE, "--sensitivity-error %.2g", share);
    if (!isnan(g->factor.value))
        sensitivity_set_print(t, SENSITIVITY_KEY_SPRING, "%.4g",
                              1 / (g->factor.value * g->factor.value));
}

static void set_sensitivity_keys(table_writer *t, const sensitivity_task *task, size_t row,
                                 const direction_group *g)
{
    size_t n_excluded = 0;
    for (size_t i = 0; i < task->n; i++)
        n_excluded += task->items[i].outlier ||
                      !(has_found_slope(&task->items[i], 0) || has_found_slope(&task->items[i], 1));
    sensitivity_set_text(t, SENSITIVITY_KEY_DIRECTION, slope_direction_text((slope_direction)row));
    sensitivity_set_print(t, SENSITIVITY_KEY_VERDICT, "%s%s", slope_verdict_text(g->verdict),
                          verdict_reasons[g->verdict]);
    sensitivity_set_print(t, SENSITIVITY_KEY_N_CURVES, "%zu", task->n);
    sensitivity_set_print(t, SENSITIVITY_KEY_N_LEFT_OUT, "%zu", n_excluded);
    if (row == DIRECTIONS)
        sensitivity_set_value(t, SENSITIVITY_KEY_DIFFERENCE, g->difference.value,
                              g->difference.standard_error, 0);
    if (g->refused)
        return;
    if (!isnan(g->sensitivity.value))
        sensitivity_set_value(t, SENSITIVITY_KEY_SENSITIVITY, g->sensitivity.value,
                              g->sensitivity.standard_error, 0);
    if (!isnan(g->factor.value))
        sensitivity_set_value(t, SENSITIVITY_KEY_FACTOR, g->factor.value, g->factor.standard_error,
                              0);
    set_option_keys(t, g);
}

/* Returns the row of the result: the requested direction. If no curve has both directions, an
 * available one is used. */
static size_t reported_row(const sensitivity_task *task, const direction_group groups[ROWS])
{
    static const size_t requested[] = {
        [WT_DIRECTION_BOTH] = DIRECTIONS, [WT_DIRECTION_APPROACH] = 0, [WT_DIRECTION_RETRACT] = 1};
    const size_t row = requested[task->job->directions];
    if (row < DIRECTIONS || groups[row].n > 0)
        return row;
    return groups[0].n > 0 ? 0 : 1;
}

static wt_status create_group_table(const sensitivity_task *task, wt_table **table, wt_error *err)
{
    direction_group groups[ROWS] = {{0}};
    compute_groups(task, groups);
    const size_t answer = reported_row(task, groups);
    if (groups[answer].n == 0) {
        const wt_status status = wt_fail(err, WT_E_RANGE, "no curve has a slope in contact");
        wt_error_place(err, "%s", task->items[0].file->name);
        for (size_t w = DIRECTIONS; w-- > 0;)
            if (task->items[0].has_segment[w] && !task->items[0].direction[w].found)
                wt_error_found(err, "%s: %s", wt_segment_kind_name(kinds[w]),
                               task->items[0].direction[w].reason);
        return status;
    }
    table_writer t = table_begin(&sensitivity_schema, err);
    for (size_t row = 0; row < ROWS; row++)
        if (groups[row].n > 0)
            add_group_row(&t, (slope_direction)row, &groups[row]);
    set_sensitivity_keys(&t, task, answer, &groups[answer]);
    cost_report(task->work, (cost_summary){.items = (double)task->n});
    return table_end(&t, table);
}

wt_status wt_sensitivity_compute(const wt_sensitivity_job *job, const wt_job *work,
                                 wt_sensitivity_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of sensitivity");
    sensitivity_task task = {.job = job, .work = work};
    wt_sensitivity_tables result = {0};
    flow_files files = {0};
    size_t n_failed = 0;
    wt_status status = param_check(wt_sensitivity_job_params(), job, err);
    if (status == WT_OK && !(job->options.from < job->options.to))
        status = range_error("contact-to", job->options.to, "more than contact-from", err);
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK)
        status = flow_files_process(&files, work, read_sensitivity_file, &task, &n_failed, err);
    if (status == WT_OK && task.n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no force curve could be read");
        flow_error_add_files(&files, n_failed, err);
    }
    if (status == WT_OK)
        status = check_signals(&task, err);
    if (status == WT_OK)
        mark_outliers(&task);
    if (status == WT_OK)
        status = create_curve_table(&task, &result.sensitivity_curves, err);
    if (status == WT_OK)
        status = create_group_table(&task, &result.sensitivity, err);
    if (status == WT_OK) {
        *tables = result;
        result = (wt_sensitivity_tables){0};
    }
    wt_tables_clear(&result, sizeof result);
    free(task.items);
    flow_files_clear(&files);
    return status;
}
