/* Force curves, whose memory is reused from curve to curve. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/data/force_curve.h"
#include "core/base/array.h"
#include "core/math/simd.h"

#include <math.h>
#include <stdlib.h>

void wt_record_clear(wt_record *record)
{
    if (record == NULL)
        return;
    for (int c = 0; c < WT_RECORD_CHANNELS; c++)
        free(record->channel[c]);
    free(record->step);
    *record = (wt_record){.n = 0};
}

void wt_record_torque_to_force(wt_record *record, double radius)
{
    double *const torque = record->channel[WT_RECORD_TORQUE];
    if (torque == NULL || record->channel[WT_RECORD_FRICTION_FORCE] != NULL || !(radius > 0))
        return;
    for (size_t i = 0; i < record->n; i++)
        torque[i] /= radius;
    record->channel[WT_RECORD_FRICTION_FORCE] = torque;
    record->channel[WT_RECORD_TORQUE] = NULL;
}

void wt_power_spectrum_clear(wt_power_spectrum *spectrum)
{
    if (spectrum == NULL)
        return;
    free(spectrum->wavenumber);
    free(spectrum->density);
    *spectrum = (wt_power_spectrum){0};
}

void wt_image_clear(wt_image *image)
{
    if (image == NULL)
        return;
    free(image->values);
    *image = (wt_image){0};
}

wt_height_map wt_image_height_map(const wt_image *image)
{
    return (wt_height_map){image->values,
                           image->n_columns,
                           image->n_rows,
                           image->width / (double)(image->n_columns - 1),
                           image->n_rows > 1 ? image->height / (double)(image->n_rows - 1)
                                             : (double)NAN,
                           false};
}

const char *wt_segment_kind_name(wt_segment_kind kind)
{
#define SEGMENT_NAME(value, name) [value] = name,
    static const char *const names[] = {WT_SEGMENT_KIND_LIST(SEGMENT_NAME)};
#undef SEGMENT_NAME
    return names[(size_t)kind < COUNT_OF(names) ? kind : WT_SEGMENT_OTHER];
}

static void free_channels(wt_segment *segment, size_t from)
{
    for (size_t i = from; i < segment->n_channels; i++)
        free(segment->channels[i].values);
    if (segment->n_channels > from)
        segment->n_channels = from;
}

void wt_force_curve_clear(wt_force_curve *curve)
{
    if (curve == NULL)
        return;
    for (size_t i = 0; i < curve->capacity; i++) {
        free_channels(&curve->segments[i], 0);
        free(curve->segments[i].channels);
    }
    free(curve->segments);
    *curve = (wt_force_curve){0};
}

void wt_force_curve_reset(wt_force_curve *curve)
{
    curve->index = 0;
    curve->x = curve->y = (double)NAN;
    curve->grid_x = curve->grid_y = -1;
    curve->cantilever = (wt_cantilever){.spring_constant = (double)NAN, .sensitivity = (double)NAN};
    curve->n_segments = 0;
}

/* A segment beyond n_segments keeps its arrays. The next curve only resizes them. */
static bool resize_channels(wt_segment *segment, size_t n_points, size_t n_channels)
{
    if (n_points > SIZE_MAX / sizeof(double) || n_channels > SIZE_MAX / sizeof(wt_channel))
        return false;
    free_channels(segment, n_channels);
    segment->channels = wt_realloc(segment->channels, n_channels, sizeof *segment->channels);
    for (size_t i = segment->n_channels; i < n_channels; i++)
        segment->channels[i] = (wt_channel){.values = NULL};
    segment->n_channels = n_channels;
    for (size_t i = 0; i < n_channels; i++) {
        wt_channel *const channel = &segment->channels[i];
        double *const values =
            realloc(channel->values, (n_points > 0 ? n_points : 1) * sizeof *values);
        if (values == NULL)
            return false;
        *channel = (wt_channel){.quantity = WT_Q_NONE, .values = values};
    }
    return true;
}

wt_segment *wt_force_curve_add_segment(wt_force_curve *curve, wt_segment_kind kind, size_t n_points,
                                       size_t n_channels)
{
    if (curve->n_segments == curve->capacity) {
        const size_t capacity = curve->capacity > 0 ? 2 * curve->capacity : 4;
        curve->segments = wt_realloc(curve->segments, capacity, sizeof *curve->segments);
        for (; curve->capacity < capacity; curve->capacity++)
            curve->segments[curve->capacity] = (wt_segment){.channels = NULL};
    }
    wt_segment *const segment = &curve->segments[curve->n_segments];
    if (!resize_channels(segment, n_points, n_channels))
        return NULL;
    segment->kind = kind;
    segment->index = curve->n_segments;
    segment->n_points = n_points;
    segment->duration = segment->setpoint = segment->velocity = segment->frequency = (double)NAN;
    curve->n_segments++;
    return segment;
}

const wt_channel *wt_segment_channel(const wt_segment *segment, wt_quantity quantity)
{
    for (size_t i = 0; i < segment->n_channels; i++) {
        if (segment->channels[i].quantity == quantity)
            return &segment->channels[i];
    }
    return NULL;
}

const wt_segment *wt_force_curve_segment(const wt_force_curve *curve, wt_segment_kind kind)
{
    for (size_t i = 0; i < curve->n_segments; i++) {
        if (curve->segments[i].kind == kind)
            return &curve->segments[i];
    }
    return NULL;
}

/* Returns the factor by which a stated calibration value replaces that of the file; 1 without a
 * replacement. */
static double replacement_ratio(bool given, double own, double value)
{
    return given && own > 0 ? value / own : 1;
}

double deflection_factor(wt_quantity from, wt_quantity to, const wt_cantilever *file,
                         const wt_cantilever *used)
{
    const double s = used->sensitivity, k = used->spring_constant;
    const double new_s = replacement_ratio(used->sensitivity_is_overridden, file->sensitivity, s);
    const double new_k =
        replacement_ratio(used->spring_constant_is_overridden, file->spring_constant, k);
    const bool volts = to == WT_Q_DEFLECTION_VOLTAGE, metres = to == WT_Q_DEFLECTION;
    switch (from) {
    case WT_Q_DEFLECTION_VOLTAGE:
        return volts ? 1 : metres ? s : k * s;
    case WT_Q_DEFLECTION:
        return volts ? 1 / file->sensitivity : metres ? new_s : k * new_s;
    default:
        return volts    ? 1 / (file->spring_constant * file->sensitivity)
               : metres ? new_k * new_s / k
                        : new_k * new_s;
    }
}

WIDE_REGISTERS void sample_times(double start, double duration, size_t n, double *times)
{
    const double all = (double)n;
    wide at = {0.0, 1.0, 2.0, 3.0};
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        const wide now = start + duration * (at / all);
        simd_store(times + i, &now);
        at += (double)WIDE;
    }
    for (; i < n; i++)
        times[i] = start + duration * ((double)i / all);
}

const double *segment_force(const wt_segment *segment, const wt_cantilever *cantilever,
                            double *scratch)
{
    static const wt_quantity sources[] = {WT_Q_FORCE, WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE};
    const wt_channel *channel = NULL;
    for (size_t i = 0; i < COUNT_OF(sources) && channel == NULL; i++)
        channel = wt_segment_channel(segment, sources[i]);
    if (channel == NULL || channel->quantity == WT_Q_FORCE)
        return channel != NULL ? channel->values : NULL;
    const double factor = deflection_factor(channel->quantity, WT_Q_FORCE, cantilever, cantilever);
    if (isnan(factor))
        return NULL;
    for (size_t i = 0; i < segment->n_points; i++)
        scratch[i] = factor * channel->values[i];
    return scratch;
}

const double *segment_height(const wt_segment *segment)
{
    const wt_channel *channel = wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT);
    if (channel == NULL)
        channel = wt_segment_channel(segment, WT_Q_HEIGHT);
    return channel != NULL ? channel->values : NULL;
}

const double *segment_time(const wt_segment *segment, double *scratch)
{
    const wt_channel *time = wt_segment_channel(segment, WT_Q_TIME);
    if (time != NULL)
        return time->values;
    if (!(segment->duration > 0))
        return NULL;
    sample_times(0, segment->duration, segment->n_points, scratch);
    return scratch;
}

void wt_prony_clear(wt_prony *prony)
{
    if (prony == NULL)
        return;
    free(prony->relaxation_time);
    free(prony->modulus);
    *prony = (wt_prony){0};
}

void wt_prony_alloc(wt_prony *prony, size_t n)
{
    double *const relaxation_time = wt_alloc(n, sizeof *relaxation_time);
    double *const modulus = wt_alloc(n, sizeof *modulus);
    *prony = (wt_prony){.deformation = WT_TENSION,
                        .reference_temperature = (double)NAN,
                        .n = n,
                        .relaxation_time = relaxation_time,
                        .modulus = modulus,
                        .frequency_min = (double)NAN,
                        .frequency_max = (double)NAN};
}
