/* Builds force curves from the segments and channels that a reader decodes, for all formats.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/force_assembler.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/data/force_curve.h"
#include "core/table/registry.h"
#include "read/bytes/samples.h"
#include "read/header_values.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES_MIN = 4 };

/* Relative tolerances. Rounded values agree within them; a piezo with creep or hysteresis may
 * exceed them. */
static const double constant_tolerance = 0.02, height_tolerance = 0.05;

/* A ratio above this indicates a wrong unit and not another calibration. */
static const double unit_error_ratio = 3;

/* Minimum share of explained variance for which the slope is used. */
static const double explained_share_min = 0.9;

/* Returns the slope of y over x. *share is the share of the variance of y that it explains. Pairs
 * with a missing sample are skipped. */
static double fitted_slope(const double *x, const double *y, size_t n, double *share)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, m = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i])) {
            sx += x[i];
            sy += y[i];
            m++;
        }
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i])) {
            sxx += (x[i] - sx / m) * (x[i] - sx / m);
            sxy += (x[i] - sx / m) * (y[i] - sy / m);
            syy += (y[i] - sy / m) * (y[i] - sy / m);
        }
    *share = sxx > 0 && syy > 0 ? sxy * sxy / (sxx * syy) : 0;
    return sxy / sxx;
}

static bool is_usable_signal(const force_signal *signal)
{
    return signal != NULL && signal->problem == NULL;
}

/* Warns once per source if stored force and deflection imply another spring constant than the
 * stated one. The file states it, else the user. Either signal may be NULL if it is not stored. */
static wt_status check_spring_constant(wt_force_source *source, const force_metadata *metadata,
                                       const force_signal *force, const force_signal *deflection,
                                       wt_error *err)
{
    const double own = metadata->cantilever.spring_constant;
    const double k = own > 0 ? own : source->options.spring_constant;
    const size_t n = metadata->n_points;
    double share = 0;
    if (source->constant_checked || !is_usable_signal(force) || !is_usable_signal(deflection) ||
        force->channel == deflection->channel || !(k > 0) || n < SAMPLES_MIN)
        return WT_OK;
    double *values = try_alloc(2 * n, sizeof *values);
    if (values == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu samples", n);
    wt_status status =
        source->stream->decode(source, deflection, deflection->to_si, n, values, err);
    if (status == WT_OK)
        status = source->stream->decode(source, force, force->to_si, n, values + n, err);
    const double fitted = status == WT_OK ? fitted_slope(values, values + n, n, &share) : 0;
    free(values);
    if (share < explained_share_min)
        return status;
    source->constant_checked = true;
    if (fabs(fitted / k - 1) > constant_tolerance + 1 - share)
        wt_log_action(source->log, WT_WARNING, WT_CONTRADICTED, 0, "--spring-constant",
                      source->name, metadata->place,
                      "force and deflection of the file mean a spring constant of %.4g N/m, %s "
                      "%.4g N/m",
                      fitted, own > 0 ? "the file says" : "given is", k);
    return status;
}

static void report_override(const wt_force_source *source, const char *what, const char *unit,
                            double given, double own, double scale)
{
    if (!(own > 0) || isnan(given) || fabs(given / own - 1) <= constant_tolerance)
        return;
    const bool is_suspicious = fmax(given / own, own / given) > unit_error_ratio;
    wt_log_add(source->log, is_suspicious ? WT_WARNING : WT_NOTE, source->name, NULL,
               "the %s given, %.4g %s, takes the place of that of the file, %.4g %s%s", what,
               scale * given, unit, scale * own, unit,
               is_suspicious ? ": is its unit the right one?" : "");
}

/* Reports once per source which calibration values of the user replace those of the file. It is a
 * warning if the ratio suggests a wrong unit. */
static void report_overrides(wt_force_source *source, const force_metadata *metadata)
{
    if (source->given_checked)
        return;
    source->given_checked = true;
    report_override(source, "spring constant", "N/m", source->options.spring_constant,
                    metadata->cantilever.spring_constant, 1);
    report_override(source, "deflection sensitivity", "nm/V", source->options.sensitivity,
                    metadata->cantilever.sensitivity, 1e9);
}

static double value_range(const double *values, size_t n)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

/* Notes once per source if the piezo height and the measured height of an approach differ in their
 * range. */
static void check_height_ranges(wt_force_source *source, const force_metadata *metadata,
                                const wt_segment *segment)
{
    if (source->heights_checked || segment->kind != WT_SEGMENT_APPROACH ||
        segment->n_points < SAMPLES_MIN)
        return;
    const wt_channel *const height = wt_segment_channel(segment, WT_Q_HEIGHT),
                            *const measured = wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT);
    if (height == NULL || measured == NULL)
        return;
    const double piezo = value_range(height->values, segment->n_points);
    const double sensor = value_range(measured->values, segment->n_points);
    if (!(piezo > 0) || !(sensor > 0))
        return;
    source->heights_checked = true;
    if (fabs(piezo - sensor) > height_tolerance * sensor)
        wt_log_add(source->log, WT_NOTE, source->name, metadata->place,
                   "the height of the piezo changes by %.4g um, that of its sensor by %.4g "
                   "um; the sensor is used",
                   1e6 * piezo, 1e6 * sensor);
}

wt_status force_open(const force_stream *stream, const struct file_reader *self, wt_input *input,
                     const wt_read_options *options, wt_log *log, wt_force_source **source,
                     wt_error *err)
{
    wt_force_source *s = wt_alloc(1, stream->size);
    s->stream = stream;
    s->name = wt_input_name(input);
    s->options = *options;
    s->log = log;
    wt_status status = stream->open(s, self, input, err);
    if (status == WT_OK)
        *source = s;
    else
        wt_force_close(s);
    return status;
}

wt_status wt_force_next(wt_force_source *source, wt_force_curve *curve, wt_error *err)
{
    wt_force_curve_reset(curve);
    resource_error_clear();
    wt_status status = resource_error_finish(source->stream->next(source, curve, err), err);
    if (status != WT_OK && status != WT_END) {
        const size_t index = curve->index;
        wt_force_curve_reset(curve);
        curve->index = index;
        wt_error_file(err, source->name);
    }
    return status;
}

void force_seek(wt_force_source *source, size_t index)
{
    if (source->stream->seek != NULL)
        source->stream->seek(source, index);
}

void wt_force_close(wt_force_source *source)
{
    if (source == NULL)
        return;
    if (source->stream->close != NULL)
        source->stream->close(source);
    free(source);
}

size_t wt_force_count(const wt_force_source *source)
{
    return source->n_curves;
}

bool force_is_segment_requested(const wt_force_source *source, wt_segment_kind kind)
{
    return (source->options.segments & WT_SEGMENT_BIT(kind)) != 0;
}

/* ---- signals and calibration ----------------------------------------------------------------- */

double force_positive_or_nan(double value)
{
    return value > 0 && isfinite(value) ? value : (double)NAN;
}

const force_signal *force_find_signal(const force_metadata *metadata, wt_quantity quantity)
{
    for (size_t i = 0; i < metadata->n_signals; i++)
        if (metadata->signals[i].quantity == quantity)
            return &metadata->signals[i];
    return NULL;
}

void force_add_signal(force_metadata *metadata, force_signal signal)
{
    if (force_find_signal(metadata, signal.quantity) == NULL)
        metadata->signals[metadata->n_signals++] = signal;
}

void force_add_offer(force_metadata *metadata, wt_quantity quantity)
{
    for (size_t i = 0; i < metadata->n_offers; i++)
        if (metadata->offers[i] == quantity)
            return;
    metadata->offers[metadata->n_offers++] = quantity;
}

/* The conversion chain of the deflection signal. The sensitivity converts the first quantity to the
 * second, the spring constant the second to the third. */
static const wt_quantity chain[] = {WT_Q_DEFLECTION_VOLTAGE, WT_Q_DEFLECTION, WT_Q_FORCE};
enum { CHAIN = sizeof chain / sizeof *chain };

/* Returns the index in the chain, or CHAIN for a quantity that is not in it. */
static size_t chain_index(wt_quantity quantity)
{
    size_t i = 0;
    while (i < CHAIN && chain[i] != quantity)
        i++;
    return i;
}

/* Selects the signal from which a quantity is computed: the signal itself, else the nearest in the
 * chain. A calibration stated by the user replaces a step of the chain. The quantities after this
 * step are then recomputed from those before it. A signal of another channel is not used for this,
 * since it may belong to another measurement. */
static const force_signal *select_signal(const force_metadata *metadata,
                                         const wt_read_options *options, wt_quantity wanted)
{
    const double given[] = {options->sensitivity, options->spring_constant};
    const force_signal *own = force_find_signal(metadata, wanted), *found = NULL;
    const size_t place = chain_index(wanted);
    if (place == CHAIN)
        return own;
    for (size_t i = 0; i < place && found == NULL; i++)
        if (!isnan(given[i]))
            found = force_find_signal(metadata, chain[i]);
    if (found != NULL && (own == NULL || own->channel == found->channel))
        return found;
    found = own;
    for (size_t i = place; i-- > 0 && found == NULL;)
        found = force_find_signal(metadata, chain[i]);
    for (size_t i = place + 1; i < CHAIN && found == NULL; i++)
        found = force_find_signal(metadata, chain[i]);
    return found;
}

static wt_cantilever select_cantilever(const wt_cantilever *file, const wt_read_options *options)
{
    wt_cantilever used = {.spring_constant = options->spring_constant,
                          .sensitivity = options->sensitivity,
                          .spring_constant_is_overridden = !isnan(options->spring_constant),
                          .sensitivity_is_overridden = !isnan(options->sensitivity)};
    if (!used.spring_constant_is_overridden)
        used.spring_constant = file->spring_constant;
    if (!used.sensitivity_is_overridden)
        used.sensitivity = file->sensitivity;
    return used;
}

/* Fails with the calibration options that the user can set. */
static wt_status fail_uncalibrated(const force_signal *signal, const wt_cantilever *used,
                                   const char *place, wt_error *err)
{
    const bool no_constant = isnan(used->spring_constant);
    const bool no_sensitivity =
        isnan(used->sensitivity) && signal->quantity == WT_Q_DEFLECTION_VOLTAGE;
    const bool both = no_constant && no_sensitivity;
    wt_fail(err, WT_E_MISSING, "the file does not say the %s",
            both          ? "spring constant and deflection sensitivity"
            : no_constant ? "spring constant"
                          : "deflection sensitivity");
    wt_error_place(err, "%s", place != NULL ? place : "");
    wt_error_advice(err, "give %s%s%s", no_constant ? "--spring-constant 0.1N/m" : "",
                    both ? " and " : "", no_sensitivity ? "--sensitivity 60nm/V" : "");
    wt_error_options(err, "%s%s%s", no_constant ? "spring-constant" : "", both ? " " : "",
                     no_sensitivity ? "sensitivity" : "");
    return WT_E_MISSING;
}

/* ---- columns ------------------------------------------------------------------------------ */

typedef struct force_column {
    wt_quantity quantity;
    const force_signal *signal; /* NULL if the time is computed from the duration */
    force_linear scaling;       /* from the stored numbers of the channel to the quantity */
} force_column;

/* The columns of a segment. */
typedef struct force_plan {
    force_column columns[WT_Q_COUNT];
    size_t n;
} force_plan;

static wt_status report_missing_quantity(const wt_force_source *source,
                                         const force_metadata *metadata, wt_quantity wanted,
                                         const force_signal *signal, const wt_cantilever *used,
                                         wt_error *err)
{
    if (wanted == WT_Q_DEFLECTION_VOLTAGE) {
        wt_log_add(source->log, WT_NOTE, source->name, metadata->place,
                   "no %s: the file's own calibration is not known", wt_quantity_id(wanted));
        return WT_OK;
    }
    wt_error missing = WT_ERROR_INIT;
    wt_status status = fail_uncalibrated(signal, used, metadata->place, &missing);
    if (source->options.want == WT_Q_ALL) {
        wt_log_add(source->log, WT_WARNING, source->name, metadata->place, "no %s: %s; %s",
                   wt_quantity_id(wanted), missing.message, missing.advice);
        return WT_OK;
    }
    if (err != NULL)
        *err = missing;
    return status;
}

/* Warns if a calibration stated by the user cannot be applied, because the file does not state its
 * own value. */
static void warn_value_not_applied(const wt_force_source *source, const force_metadata *metadata,
                                   const force_signal *signal)
{
    const wt_read_options *o = &source->options;
    const bool force = signal->quantity == WT_Q_FORCE;
    const char *column = wt_quantity_id(signal->quantity);
    if (signal->quantity == WT_Q_DEFLECTION_VOLTAGE)
        return;
    if (!isnan(o->sensitivity) && !(metadata->cantilever.sensitivity > 0))
        wt_log_add(source->log, WT_WARNING, source->name, NULL,
                   "the file does not say its sensitivity, so the given one cannot replace "
                   "it in a column of %s",
                   column);
    if (force && !isnan(o->spring_constant) && !(metadata->cantilever.spring_constant > 0))
        wt_log_add(source->log, WT_WARNING, source->name, NULL,
                   "the file does not say its spring constant, so the given one cannot "
                   "replace it in a column of %s",
                   column);
}

/* Adds the column of a quantity if a signal exists from which it can be computed. */
static wt_status assign_column(const wt_force_source *source, const force_metadata *metadata,
                               wt_quantity wanted, force_plan *plan, wt_error *err)
{
    const force_signal *signal = select_signal(metadata, &source->options, wanted);
    if (signal == NULL &&
        (wanted != WT_Q_TIME || !isfinite(metadata->start + metadata->duration))) {
        if (wanted == WT_Q_TIME)
            wt_log_add(source->log, WT_WARNING, source->name, metadata->place,
                       "no duration: the time is left out");
        return WT_OK;
    }
    if (signal != NULL && signal->problem != NULL) {
        wt_log_add(source->log, WT_WARNING, source->name, metadata->place,
                   "channel %s left out: %s", signal->name, signal->problem);
        return WT_OK;
    }
    force_linear scaling = signal != NULL ? signal->to_si : (force_linear){1, 0};
    if (chain_index(wanted) < CHAIN) {
        const wt_cantilever used = select_cantilever(&metadata->cantilever, &source->options);
        const double factor =
            deflection_factor(signal->quantity, wanted, &metadata->cantilever, &used);
        if (isnan(factor))
            return report_missing_quantity(source, metadata, wanted, signal, &used, err);
        if (wanted != WT_Q_DEFLECTION_VOLTAGE)
            warn_value_not_applied(source, metadata, signal);
        scaling = (force_linear){factor * scaling.multiplier, factor * scaling.offset};
    }
    plan->columns[plan->n].quantity = wanted;
    plan->columns[plan->n].signal = signal;
    plan->columns[plan->n++].scaling = scaling;
    return WT_OK;
}

/* Returns the rank of a quantity in the fixed column order, which is independent of the file. */
static size_t column_rank(wt_quantity quantity)
{
    static const wt_quantity order[] = {WT_Q_TIME,  WT_Q_HEIGHT,     WT_Q_MEASURED_HEIGHT,
                                        WT_Q_FORCE, WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE};
    size_t i = 0;
    while (i < COUNT_OF(order) && order[i] != quantity)
        i++;
    return i < COUNT_OF(order) ? i : COUNT_OF(order) + (size_t)quantity;
}

static void sort_columns(force_plan *plan)
{
    for (size_t i = 1; i < plan->n; i++)
        for (size_t k = i; k > 0 && column_rank(plan->columns[k].quantity) <
                                        column_rank(plan->columns[k - 1].quantity);
             k--) {
            const force_column column = plan->columns[k];
            plan->columns[k] = plan->columns[k - 1];
            plan->columns[k - 1] = column;
        }
}

/* True if a stated sensitivity replaces that of the file or is used to compute a column. */
static bool uses_sensitivity(const force_metadata *metadata, const force_plan *plan)
{
    bool takes = metadata->cantilever.sensitivity > 0;
    for (size_t i = 0; i < plan->n; i++)
        takes = takes || (plan->columns[i].signal != NULL &&
                          plan->columns[i].signal->quantity == WT_Q_DEFLECTION_VOLTAGE);
    return takes;
}

static bool is_quantity_requested(const wt_read_options *options, const force_metadata *metadata,
                                  wt_quantity quantity)
{
    if ((options->want & WT_Q_BIT(quantity)) == 0)
        return false;
    if (!options->sensor_height_only || quantity != WT_Q_HEIGHT)
        return true;
    const force_signal *sensor = force_find_signal(metadata, WT_Q_MEASURED_HEIGHT);
    return (options->want & WT_Q_BIT(WT_Q_MEASURED_HEIGHT)) == 0 || sensor == NULL ||
           sensor->problem != NULL;
}

/* Decodes a channel. A value that is not finite counts as missing. The warning contains no count,
 * so that the log merges the warnings of a map into one line. */
static wt_status fill_channel(wt_force_source *source, const force_metadata *metadata,
                              const force_column *column, size_t n, double *values, wt_error *err)
{
    const wt_status status =
        source->stream->decode(source, column->signal, column->scaling, n, values, err);
    if (status == WT_OK && samples_mark_missing(values, n) > 0)
        wt_log_add(source->log, WT_WARNING, source->name, metadata->place,
                   "samples of %s are missing: not measured, or no finite number",
                   column->signal->name);
    return status;
}

wt_status force_add_segment(wt_force_source *source, const force_metadata *metadata,
                            wt_force_curve *curve, wt_error *err)
{
    const wt_cantilever used = select_cantilever(&metadata->cantilever, &source->options);
    const size_t n = metadata->n_points;
    force_plan plan = {.n = 0};
    wt_status status = WT_OK;
    /* A segment without calibration leaves the calibration of the earlier segments unchanged. */
    const bool was_used = curve->n_segments > 0 && curve->cantilever.sensitivity_is_overridden;
    if (!isnan(used.spring_constant) || !isnan(used.sensitivity))
        curve->cantilever = used;
    if (n == 0)
        return WT_OK;
    report_overrides(source, metadata);
    status = check_spring_constant(source, metadata, force_find_signal(metadata, WT_Q_FORCE),
                                   force_find_signal(metadata, WT_Q_DEFLECTION), err);
    for (size_t i = 0; i < metadata->n_offers && status == WT_OK; i++)
        if (is_quantity_requested(&source->options, metadata, metadata->offers[i]))
            status = assign_column(source, metadata, metadata->offers[i], &plan, err);
    if (status != WT_OK)
        return status;
    sort_columns(&plan);
    if (used.sensitivity_is_overridden && !was_used && !uses_sensitivity(metadata, &plan)) {
        curve->cantilever.sensitivity = (double)NAN;
        curve->cantilever.sensitivity_is_overridden = false;
    }
    wt_segment *segment = wt_force_curve_add_segment(curve, metadata->kind, n, plan.n);
    if (segment == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a segment of %zu samples", n);
    segment->index = metadata->index;
    segment->duration = metadata->duration;
    segment->velocity = metadata->velocity;
    segment->frequency = metadata->frequency > 0 ? metadata->frequency : (double)NAN;
    segment->setpoint =
        metadata->setpoint *
        deflection_factor(metadata->setpoint_quantity, WT_Q_FORCE, &metadata->cantilever, &used);
    (void)samples_mark_missing(&segment->setpoint, 1);
    for (size_t i = 0; i < plan.n && status == WT_OK; i++) {
        const force_signal *signal = plan.columns[i].signal;
        wt_channel *channel = &segment->channels[i];
        channel->quantity = plan.columns[i].quantity;
        snprintf(channel->name, sizeof channel->name, "%s", signal != NULL ? signal->name : "time");
        snprintf(channel->unit, sizeof channel->unit, "%s", signal != NULL ? signal->unit : "s");
        if (signal == NULL)
            sample_times(metadata->start, metadata->duration, n, channel->values);
        else
            status = fill_channel(source, metadata, &plan.columns[i], n, channel->values, err);
    }
    if (status == WT_OK)
        check_height_ranges(source, metadata, segment);
    return status;
}

bool force_set_grid_position(long columns, long rows, bool back_and_forth, size_t number,
                             wt_force_curve *curve)
{
    if (columns == 0 || number / (size_t)columns >= (size_t)rows)
        return false;
    const long row = (long)(number / (size_t)columns), column = (long)(number % (size_t)columns);
    curve->grid_x = back_and_forth && row % 2 == 1 ? columns - 1 - column : column;
    curve->grid_y = row;
    return true;
}

/* ---- for info ----------------------------------------------------------------------------- */

/* Returns the signal from which the quantity is computed; NULL if it cannot be computed. */
static const force_signal *select_convertible_signal(const force_metadata *metadata,
                                                     const wt_read_options *options,
                                                     wt_quantity quantity)
{
    const wt_cantilever used = select_cantilever(&metadata->cantilever, options);
    const force_signal *signal = select_signal(metadata, options, quantity);
    if (signal == NULL || chain_index(quantity) == CHAIN)
        return signal;
    return isnan(deflection_factor(signal->quantity, quantity, &metadata->cantilever, &used))
               ? NULL
               : signal;
}

wt_quantity force_channel_quantity(const force_metadata *metadata, const wt_read_options *options,
                                   const void *channel)
{
    for (size_t i = 0; i < metadata->n_offers; i++) {
        const force_signal *signal =
            select_convertible_signal(metadata, options, metadata->offers[i]);
        if (signal != NULL && signal->channel == channel)
            return metadata->offers[i];
    }
    return WT_Q_NONE;
}

void force_describe_calibration(const force_metadata *metadata, const wt_read_options *options,
                                const char *spring_constant_source, const char *sensitivity_source,
                                table_writer *list)
{
    static const char given[] = "given by the user";
    const wt_cantilever used = select_cantilever(&metadata->cantilever, options);
    const force_signal *signal = select_signal(metadata, options, WT_Q_FORCE);
    wt_error missing = WT_ERROR_INIT;
    metadata_add_number(list, fact_item_text(FACT_SPRING_CONSTANT), used.spring_constant, "N/m",
                        used.spring_constant_is_overridden ? given : spring_constant_source);
    metadata_add_number(list, fact_item_text(FACT_SENSITIVITY), used.sensitivity, "m/V",
                        used.sensitivity_is_overridden ? given : sensitivity_source);
    /* both constants are needed, because the tip position is the height less the deflection */
    if (signal != NULL &&
        (select_convertible_signal(metadata, options, WT_Q_FORCE) == NULL ||
         (isnan(used.spring_constant) && signal->quantity == WT_Q_FORCE &&
          select_convertible_signal(metadata, options, WT_Q_DEFLECTION) == NULL))) {
        fail_uncalibrated(signal, &used, NULL, &missing);
        metadata_add(list, fact_item_text(FACT_MISSING), "", missing.advice, "%s", missing.message);
        facts_put_text(list, FACTS_OPTIONS, missing.options);
    }
}
