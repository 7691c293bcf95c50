/* Delivers the force curves of a NanoScope file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/nanoscope/nanoscope.h"

#include <math.h>

typedef struct nanoscope_source {
    wt_force_source base;
    nanoscope_file file;
    size_t curve;
    size_t from; /* first sample of the current segment */
} nanoscope_source;

static const double pi = 3.14159265358979323846;

/* The ramp is a computed channel; it is not stored. */
static const char ramp_name[] = "Ramp";

force_metadata nanoscope_metadata(const nanoscope_file *f, size_t s)
{
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_RETRACT};
    const size_t points[] = {f->n_in, f->n_hold, f->n_out};
    const double times[] = {f->time_in, f->time_hold, f->time_out};
    const double velocities[] = {f->velocity_in, (double)NAN, f->velocity_out};
    force_metadata metadata = {.kind = kinds[s],
                               .index = s == 2 && f->n_hold == 0 ? 1 : s,
                               .n_points = points[s],
                               .duration = times[s],
                               .velocity = velocities[s],
                               .setpoint = s == 0 ? f->trigger : (double)NAN,
                               .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
                               .cantilever = f->cantilever,
                               .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE,
                                          WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE},
                               .n_offers = 6};
    for (size_t i = 0; i < s; i++)
        metadata.start += points[i] > 0 ? times[i] : 0;
    if (isfinite(f->ramp))
        force_add_signal(&metadata, (force_signal){.quantity = WT_Q_HEIGHT,
                                                   .name = ramp_name,
                                                   .unit = "m",
                                                   .to_si = {1, 0},
                                                   .channel = ramp_name});
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const bool voltage = c->quantity == WT_Q_DEFLECTION_VOLTAGE;
        if (c->quantity != WT_Q_NONE)
            force_add_signal(&metadata, (force_signal){.quantity = c->quantity,
                                                       .name = c->name,
                                                       .unit = voltage ? "V" : "m",
                                                       .to_si = {c->scale, 0},
                                                       .channel = c});
    }
    return metadata;
}

/* Returns the piezo height of sample i in temporal order: a linear ramp from the turning point, or
 * a sinusoid. */
static double ramp_height(const nanoscope_file *f, size_t i)
{
    const double n = (double)(f->n_in + f->n_out);
    if (f->sinusoid)
        return f->ramp / 2 * (1 + cos(2 * pi * (double)i / n));
    if (i < f->n_in)
        return f->ramp * (double)(f->n_in - 1 - i) / (double)f->n_in;
    const size_t out = i - f->n_in;
    return out < f->n_hold ? 0 : f->ramp * (double)(out - f->n_hold) / (double)f->n_out;
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const nanoscope_source *source = (const nanoscope_source *)base;
    const nanoscope_file *f = &source->file;
    const bool is_ramp = signal->channel == ramp_name;
    const unsigned char *stored = NULL;
    const wt_status status =
        is_ramp ? WT_OK : nanoscope_read_curve(f, signal->channel, source->curve, &stored, err);
    if (status != WT_OK)
        return status;
    /* these signals have no offset */
    for (size_t i = 0; i < n; i++) {
        const size_t at = source->from + i;
        values[i] =
            scaling.multiplier *
            (is_ramp ? ramp_height(f, at) : nanoscope_sample(f, signal->channel, stored, at));
    }
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    nanoscope_source *source = (nanoscope_source *)base;
    const nanoscope_file *f = &source->file;
    wt_status status = WT_OK;
    if (source->curve == f->n_curves)
        return WT_END;
    curve->index = source->curve;
    if (force_set_grid_position(f->columns, f->rows, false, source->curve, curve)) {
        curve->x = f->pitch * (double)curve->grid_x;
        curve->y = f->pitch * (double)curve->grid_y;
    }
    source->from = 0;
    for (size_t s = 0; s < 3 && status == WT_OK; s++) {
        const force_metadata metadata = nanoscope_metadata(f, s);
        if (force_is_segment_requested(base, metadata.kind))
            status = force_add_segment(base, &metadata, curve, err);
        source->from += metadata.n_points;
    }
    source->curve++;
    return status;
}

static void close_source(wt_force_source *base)
{
    nanoscope_file_close(&((nanoscope_source *)base)->file);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    nanoscope_file *f = &((nanoscope_source *)base)->file;
    (void)self;
    wt_status status = nanoscope_file_open(input, base->log, f, err);
    if (status == WT_OK && f->sinusoid)
        wt_log_add(base->log, WT_NOTE, base->name, NULL,
                   "PeakForce captures were not verified on a genuine file: compare one with "
                   "the instrument's own software");
    base->n_curves = f->n_curves;
    base->grid_columns = f->columns;
    base->grid_rows = f->rows;
    return status;
}

const force_stream nanoscope_force = {.size = sizeof(nanoscope_source),
                                      .open = open_source,
                                      .next = next_curve,
                                      .decode = decode,
                                      .close = close_source};
