/* History of the held segments of one force curve, and their modulations.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/dwell.h"

#include "core/math/students_t.h"

#include "core/data/force_curve.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846; /* double precision */
/* Relative difference of two frequencies of one drive in contact and in air. Largest amplitude over
 * indentation: at a fifth, a force ~ depth^(3/2) changes the sine by 0.1 %. */
static const double same_drive_frequency = 0.01, small_amplitude = 0.2;

typedef struct segment_history {
    double *time, *position, *force, *scratch;
    size_t n;
} segment_history;

bool dwell_is_hold_segment(const wt_segment *s)
{
    return (s->kind == WT_SEGMENT_DWELL || s->kind == WT_SEGMENT_MODULATION) && s->n_points > 1;
}

/* Appends the samples of a segment with continuous times. Returns false if the segment lacks time,
 * height or force. */
static bool append_segment_samples(const wt_segment *s, const wt_cantilever *cantilever,
                                   double direction, segment_history *to)
{
    const double *time = segment_time(s, to->scratch), *height = segment_height(s),
                 *force = segment_force(s, cantilever, to->scratch + s->n_points);
    if (time == NULL || height == NULL || force == NULL || s->n_points < 2)
        return false;
    /* Times of a curve are continuous already. Times of a segment continue one time step after the
     * last sample of the previous segment. */
    double shift = 0;
    if (to->n > 1) {
        const double last = to->time[to->n - 1], step = last - to->time[to->n - 2];
        if (!(time[0] > last && time[0] < last + 100 * step))
            shift = last + step - time[0];
    }
    for (size_t i = 0; i < s->n_points; i++) {
        to->time[to->n] = time[i] + shift;
        to->position[to->n] = direction * height[i];
        to->force[to->n++] = force[i];
    }
    return true;
}

static void reserve_history(segment_history *h, const wt_force_curve *curve)
{
    size_t n = 0, longest = 0;
    for (size_t i = 0; i < curve->n_segments; i++) {
        n += curve->segments[i].n_points;
        longest = curve->segments[i].n_points > longest ? curve->segments[i].n_points : longest;
    }
    double *block = wt_alloc(3 * n + 2 * longest + 1, sizeof *block);
    *h = (segment_history){block, block + n, block + 2 * n, block + 3 * n, 0};
}

/* Fits the sine in the samples from `from` on, at the frequency of the file or else at the
 * strongest one. */
static wt_status fit_segment_sine(const wt_segment *s, const segment_history *h, size_t from,
                                  dwell_modulation *to, wt_error *err)
{
    const size_t n = h->n - from;
    *to = (dwell_modulation){.segment = s, .note = ""};
    wt_status status = wt_modulation_fit(h->time + from, h->position + from, h->force + from, n,
                                         2 * pi * s->frequency, &to->sine, err);
    if (status == WT_OK && !to->sine.found && s->frequency > 0)
        status = wt_modulation_fit(h->time + from, h->position + from, h->force + from, n,
                                   (double)NAN, &to->sine, err);
    if (status != WT_OK || !to->sine.found)
        return status;
    wt_modulation_remove(&to->sine, h->time + from, n, h->position + from, h->force + from);
    return WT_OK;
}

/* Finds modulations out of contact, before the approach or after the retract. */
static wt_status find_air_modulations(const wt_force_curve *curve, const wt_segment *approach,
                                      double direction, segment_history *h, dwell_curve *to,
                                      wt_error *err)
{
    bool is_held = false;
    wt_status status = WT_OK;
    for (const wt_segment *s = curve->segments;
         status == WT_OK && s < curve->segments + curve->n_segments; s++) {
        is_held = s >= approach && (is_held || s->kind == WT_SEGMENT_APPROACH) &&
                  s->kind != WT_SEGMENT_RETRACT;
        if (is_held || s->kind != WT_SEGMENT_MODULATION || to->n_air == DWELL_MAX_MODULATIONS)
            continue;
        h->n = 0;
        if (!append_segment_samples(s, &curve->cantilever, direction, h))
            continue;
        status = fit_segment_sine(s, h, 0, &to->air[to->n_air], err);
        to->n_air += status == WT_OK && to->air[to->n_air].sine.found ? 1 : 0;
    }
    h->n = 0;
    return status;
}

/* Slope of the contact function at a mean depth, over 1 - nu^2. */
static double contact_slope(const wt_contact_table *contact, double depth, double poisson)
{
    double g, slope;
    wt_contact_table_eval(contact, &depth, 1, &g, &slope);
    return slope / (1 - poisson * poisson);
}

bool dwell_is_valid_modulus(const wt_dwell_moduli *m)
{
    return m->storage.value > 0 &&
           (m->loss.value > 0 || m->loss.value > -NORMAL_95 * m->loss.standard_error);
}

static wt_status compute_modulation_moduli(const wt_contact_table *contact, double poisson,
                                           double spring_constant, const wt_indent_fit *fit,
                                           const dwell_curve *c, dwell_modulation *m, wt_error *err)
{
    const wt_dwell *d = &c->dwell;
    const bool has_dwell_fit = d->found;
    const double z =
        m->sine.mean[0] - (has_dwell_fit ? d->contact_point : fit->contact_point.value);
    m->above = m->sine.mean[1] - (has_dwell_fit
                                      ? d->baseline_offset + d->baseline_tilt * z +
                                            d->drift * (m->sine.mean_time - d->drift_start)
                                      : fit->baseline_offset.value + fit->baseline_tilt.value * z);
    m->indentation = tip_position(z, m->above, spring_constant);
    if (!(m->indentation > 0) || !(m->above > 0)) {
        m->note = "not in contact, or it pulls";
        return WT_OK;
    }
    if (!contact_law_is_valid(contact_table_tip(contact), m->indentation)) {
        m->note = "deeper than the contact law of the tip holds";
        return WT_OK;
    }
    const double slope = contact_slope(contact, m->indentation, poisson);
    const double common = has_dwell_fit ? d->indentation_common_error : (double)NAN;
    const bool described = isfinite(common);
    const dwell_modulation *air = NULL;
    for (size_t i = 0; i < c->n_air; i++)
        if (fabs(c->air[i].sine.angular_frequency - m->sine.angular_frequency) <
            same_drive_frequency * m->sine.angular_frequency)
            air = &c->air[i];
    const double *a = m->sine.amplitude;
    m->amplitude = hypot(a[0] - a[2] / spring_constant, a[1] - a[3] / spring_constant);
    m->note = !has_dwell_fit ? "the contact point is that of an elastic fit"
              : !described   ? "the dwell is not described, nor is the contact point"
              : m->amplitude > small_amplitude * m->indentation
                  ? "the amplitude is more than a fifth of the indentation"
              : air == NULL ? "drag and the lag of the instrument are in it: no modulation in air"
                            : "";
    const wt_status status = wt_modulation_moduli(&m->sine, air != NULL ? &air->sine : NULL,
                                                  spring_constant, slope, &m->moduli, err);
    const double share =
        described ? contact_slope(contact, m->indentation + common, poisson) / slope - 1 : common;
    m->moduli.storage_common_error = fabs(share * m->moduli.storage.value);
    m->moduli.loss_common_error = fabs(share * m->moduli.loss.value);
    m->found = dwell_is_valid_modulus(&m->moduli);
    if (!m->found)
        m->note = "E' or E'' is not positive: no modulus; the lag of the instrument may be larger "
                  "than that of the sample (a modulation in air tells)";
    return status;
}

/* Collects the approach and the held segments, without their sines. */
static wt_status collect_history(const wt_force_curve *curve, const wt_segment *approach,
                                 const wt_segment *first, double direction, segment_history *h,
                                 wt_dwell_history *of, dwell_curve *to, wt_error *err)
{
    const wt_segment *const end = curve->segments + curve->n_segments, *s = first;
    wt_status status = WT_OK;
    if (!append_segment_samples(approach, &curve->cantilever, direction, h))
        return WT_OK;
    of->n_approach = h->n;
    for (; s < end && dwell_is_hold_segment(s) && status == WT_OK; s++) {
        const size_t from = h->n;
        if (!append_segment_samples(s, &curve->cantilever, direction, h))
            break;
        if (to->n == DWELL_MAX_MODULATIONS)
            continue;
        status = fit_segment_sine(s, h, from, &to->modulations[to->n], err);
        if (to->modulations[to->n].sine.found || s->kind == WT_SEGMENT_MODULATION)
            to->n++;
    }
    of->n_dwell = h->n - of->n_approach;
    if (status == WT_OK && s < end && s->kind == WT_SEGMENT_RETRACT &&
        append_segment_samples(s, &curve->cantilever, direction, h))
        of->n_retract = h->n - of->n_approach - of->n_dwell;
    return status;
}

wt_status dwell_curve_fit(const wt_contact_table *contact, double poisson,
                          const wt_force_curve *curve, const wt_segment *approach,
                          const wt_segment *first, const wt_indent_fit *fit, dwell_curve *to,
                          wt_error *err)
{
    const double k = curve->cantilever.spring_constant;
    segment_history h = {0};
    *to = (dwell_curve){.dwell.reason = "no time, height or force in it"};
    reserve_history(&h, curve);
    double *const block = h.time;
    wt_dwell_history of = {.time = h.time,
                           .position = h.position,
                           .force = h.force,
                           .spring_constant = k,
                           .poisson_ratio = poisson,
                           .contact_point = fit->contact_point.value,
                           .modulus = fit->modulus.value,
                           .baseline_offset = fit->baseline_offset.value,
                           .baseline_tilt = fit->baseline_tilt};
    wt_status status = find_air_modulations(curve, approach, fit->direction, &h, to, err);
    if (status == WT_OK)
        status = collect_history(curve, approach, first, fit->direction, &h, &of, to, err);
    if (status == WT_OK && of.n_dwell > 0)
        status = wt_dwell_fit(contact, &of, &to->dwell, err);
    for (size_t i = 0; status == WT_OK && i < to->n; i++) {
        if (to->modulations[i].sine.found)
            status =
                compute_modulation_moduli(contact, poisson, k, fit, to, &to->modulations[i], err);
        else
            to->modulations[i].note = to->modulations[i].sine.reason;
    }
    free(block);
    return status;
}
