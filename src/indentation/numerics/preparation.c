/* Preparation of a force curve before the fit: missing and repeated samples, direction of the
 * piezo, limit of the force, saturated detector, and samples too stiff for the cantilever.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve.h"

#include "core/base/array.h"
#include "core/base/text.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Thresholds of plausibility tests; the reason of a verdict states them. */
static const double missing_share =
    0.1; /* share of missing samples; with more the file is damaged */
static const double travel_share = 0.5; /* net travel over the range of the height */
/* Smallest advance of the tip over the deflection of the cantilever; 1 % of sensitivity is half of
 * it. */
static const double rigid_share = 0.02;
static const double plateau_ratio =
    5.0; /* force gained before a plateau over the band of the plateau */
static const size_t plateau_samples = 5; /* fewer samples are a turning point */
/* Smallest spike over its neighbours in noise. It exceeds the 6 of a pull, which must not count as
 * a spike. */
static const double spike_noise = 8.0;
static const double spike_step = 3.0;  /* for a downward spike, in steps between its two sides */
static const double end_step = 3.0;    /* for the last sample, in steps before it */
static const double spike_share = 0.2; /* largest share of spikes; with more the data are invalid */
enum {
    SPIKE_SIDE = 7, /* neighbours on each side */
    CLASSES = 512,  /* size classes for a median */
};

void curve_reserve(wt_indent_workspace *w, size_t n)
{
    enum { N_ARRAYS = 25 }; /* number of the arrays below */
    if (n <= w->capacity)
        return;
    size_t capacity = n + n / 4;
    double *block = wt_alloc(capacity, N_ARRAYS * sizeof *block);
    free(w->block);
    w->block = block;
    w->capacity = capacity;
    double **const arrays[N_ARRAYS] = {&w->position,
                                       &w->force,
                                       &w->tip,
                                       &w->delta,
                                       &w->g,
                                       &w->slope,
                                       &w->residual,
                                       &w->scratch,
                                       &w->weight,
                                       &w->input_force,
                                       &w->input_time,
                                       &w->input_retract,
                                       &w->by_work,
                                       &w->by_modulus,
                                       &w->retract_position,
                                       &w->retract_force,
                                       &w->start_position,
                                       &w->start_force,
                                       &w->by_contact,
                                       &w->time,
                                       &w->without_wave,
                                       &w->wave_column[WAVE_COSINE],
                                       &w->wave_column[WAVE_SINE],
                                       &w->wave_column[WAVE_NUMBER],
                                       &w->wave_response};
    for (size_t i = 0; i < N_ARRAYS; i++)
        *arrays[i] = block + i * capacity;
}

WIDE_REGISTERS static double sample_mean(const double *x, size_t n)
{
    return curve_sum(x, n) / (double)n;
}

WIDE_REGISTERS
curve_span curve_find_span(const double *x, size_t n)
{
    wide low = x[0] - (wide){0.0}, high = low, low2 = low, high2 = low, now;
    double rest[2 * WIDE];
    size_t i = 0;
    for (; i + 2 * WIDE <= n; i += 2 * WIDE) { /* two of each avoid the latency */
        simd_load(&now, x + i);
        wide_minimum(&low, &now);
        wide_maximum(&high, &now);
        simd_load(&now, x + i + WIDE);
        wide_minimum(&low2, &now);
        wide_maximum(&high2, &now);
    }
    wide_minimum(&low, &low2);
    wide_maximum(&high, &high2);
    simd_store(rest, &low);
    simd_store(rest + WIDE, &high);
    curve_span span = {x[0], x[0]};
    for (size_t j = 0; j < WIDE; j++) {
        span.low = rest[j] < span.low ? rest[j] : span.low;
        span.high = rest[WIDE + j] > span.high ? rest[WIDE + j] : span.high;
    }
    for (; i < n; i++) {
        span.low = x[i] < span.low ? x[i] : span.low;
        span.high = x[i] > span.high ? x[i] : span.high;
    }
    return span;
}

/* 32 classes for each power of two below `largest`. */
static size_t size_class(double x, double largest)
{
    enum { LEADING_BITS = 52 - 5 }; /* the first 5 of the 52 bits of the fraction: 32 classes */
    uint64_t bits, most;
    memcpy(&bits, &x, sizeof bits);
    memcpy(&most, &largest, sizeof most);
    const uint64_t below = (most >> LEADING_BITS) - (bits >> LEADING_BITS);
    return below < CLASSES ? (size_t)below : CLASSES - 1;
}

/* Counts all values by size class. Only those of the class of the k-th are compared. */
double curve_select(double *x, size_t n, size_t k, double largest)
{
    size_t count[CLASSES] = {0}, class = CLASSES - 1, n_kept = 0;
    for (size_t i = 0; i < n; i++)
        count[size_class(x[i], largest)]++;
    for (; k >= count[class]; class --)
        k -= count[class];
    for (size_t i = 0; i < n; i++) {
        const double now = x[i];
        x[n_kept] = now;
        n_kept += size_class(now, largest) == class;
    }
    return gsl_stats_select(x, 1, n_kept, k);
}

/* Standard deviation of white noise from the median of the absolute successive differences.
 * `resolution` receives the smallest step, which is the resolution of a converter. */
WIDE_REGISTERS static double difference_noise(const curve_samples *s, double *restrict scratch,
                                              double *resolution)
{
    const size_t n = s->n - 1;
    for (size_t i = 0; i < n; i++)
        scratch[i] = fabs(s->force[i + 1] - s->force[i]);
    const curve_span all = curve_find_span(scratch, n);
    double smallest = all.low > 0.0 ? all.low : (double)INFINITY;
    for (size_t i = 0; i < n && !(all.low > 0.0); i++)
        smallest = scratch[i] > 0.0 && scratch[i] < smallest ? scratch[i] : smallest;
    *resolution = isfinite(smallest) ? smallest : 0.0;
    return curve_select(scratch, n, n / 2, all.high) / (0.6744897501960817 * M_SQRT2);
}

/* True if the force has a plateau at its top. `first` receives its first sample. The test compares
 * the force gained over an equal travel before it. */
static bool has_flat_top(const curve_samples *s, double noise, double resolution, size_t *first)
{
    const curve_span all = curve_find_span(s->force, s->n);
    const double band = fmax(fmax(8.0 * noise, 1.5 * resolution), 1e-6 * (all.high - all.low));
    size_t i = s->n;
    while (i > 0 && s->force[i - 1] >= all.high - band)
        i--;
    *first = i;
    if (i == 0 || s->n - i < plateau_samples)
        return false;
    double travel = s->position[s->n - 1] - s->position[i];
    size_t j = i;
    while (j > 0 && s->position[i] - s->position[j] < travel)
        j--;
    return travel > 0.0 && s->force[i] - s->force[j] > plateau_ratio * band;
}

/* Slope of the position against the deflection in the upper half of the force. It is 1 for a rigid
 * sample. The result is NaN if the force does not rise enough. */
static double advance_per_bending(const curve_samples *s, double noise)
{
    size_t n_start = s->n / 10;
    const double start = sample_mean(s->force, n_start), max = curve_find_span(s->force, s->n).high;
    if (!(max - start > 40.0 * noise))
        return (double)NAN;
    double n = 0.0, sz = 0.0, sf = 0.0, sff = 0.0, szf = 0.0;
    for (size_t i = n_start; i < s->n; i++) {
        double f = s->force[i] - start, z = s->position[i];
        if (f < 0.5 * (max - start))
            continue;
        n += 1.0;
        sz += z;
        sf += f;
        sff += f * f;
        szf += z * f;
    }
    double variance = sff - sf * sf / n;
    if (n < 5.0 || !(variance > 0.0))
        return (double)NAN;
    return (szf - sz * sf / n) / variance * s->spring_constant;
}

/* True if all samples are finite and none repeats the previous one. */
WIDE_REGISTERS static bool has_only_good_samples(const double *height, const double *force,
                                                 size_t n)
{
    wide sum = {0.0}; /* of zeros, or NaN */
    wide_bits same = {0};
    size_t i = 1;
    for (; i + WIDE <= n; i += WIDE) {
        wide z, f, z_before, f_before;
        simd_load(&z, height + i);
        simd_load(&f, force + i);
        simd_load(&z_before, height + i - 1);
        simd_load(&f_before, force + i - 1);
        sum += 0.0 * z + 0.0 * f;
        same |= (z == z_before) & (f == f_before);
    }
    bool good = !isnan(simd_sum(&sum)) && isfinite(height[0]) && isfinite(force[0]) &&
                (same[0] | same[1] | same[2] | same[3]) == 0;
    for (; i < n && good; i++)
        good = isfinite(height[i]) && isfinite(force[i]) &&
               (height[i] != height[i - 1] || force[i] != force[i - 1]);
    return good;
}

/* Copies the valid samples. The direction is not yet known. */
static size_t copy_good_samples(const double *height, const double *force, size_t n,
                                curve_input *input)
{
    size_t n_kept = 0;
    if (has_only_good_samples(height, force, n)) {
        memcpy(input->samples.position, height, n * sizeof *height);
        memcpy(input->samples.force, force, n * sizeof *force);
        return n;
    }
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(height[i]) || !isfinite(force[i])) {
            input->n_missing++;
        } else if (n_kept > 0 && height[i] == input->samples.position[n_kept - 1] &&
                   force[i] == input->samples.force[n_kept - 1]) {
            input->n_repeated++;
        } else {
            input->samples.position[n_kept] = height[i];
            input->samples.force[n_kept++] = force[i];
        }
    }
    return n_kept;
}

static double small_median(const double *x, size_t n)
{
    double sorted[SPIKE_SIDE];
    for (size_t i = 0; i < n; i++) { /* insertion sort of a few values */
        size_t j = i;
        for (; j > 0 && sorted[j - 1] > x[i]; j--)
            sorted[j] = sorted[j - 1];
        sorted[j] = x[i];
    }
    return n % 2 == 1 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

static bool exceeds_majority(const double side[SPIKE_SIDE], double x)
{
    int n = 0;
    for (size_t i = 0; i < SPIKE_SIDE; i++)
        n += side[i] < x;
    return 2 * n > SPIKE_SIDE;
}

/* True if the force continues from sample i like a contact at its end. Most of the following
 * samples are not below it, and the last step grows by less than a factor of 3 (the second step of
 * a quadratic force). */
static bool continues_contact(const curve_samples *s, size_t i, size_t n_kept,
                              double spike_threshold)
{
    const double x = s->force[i], step = s->force[n_kept - 1] - s->force[n_kept - 2];
    size_t above = 0;
    for (size_t j = i + 1; j < s->n; j++)
        above += s->force[j] > x - 0.5 * spike_threshold;
    return i + 1 < s->n ? 2 * above > s->n - i - 1
                        : x - s->force[n_kept - 1] < spike_threshold + end_step * fabs(step);
}

/* True if sample i lies far outside the samples before and after it. Earlier spikes are removed
 * already. A step agrees with one side, and a snap-in has a step or a neighbour. At an end only one
 * side and its trend exist. */
static bool is_spike(const curve_samples *s, size_t i, size_t n_kept, double spike_threshold)
{
    const double x = s->force[i], *right = s->force + i + 1;
    const bool start = n_kept < SPIKE_SIDE;
    const double *left = start ? NULL : s->force + n_kept - SPIKE_SIDE;
    if (start ? i + 2 * SPIKE_SIDE >= s->n : n_kept < 2 * SPIKE_SIDE)
        return false;
    if (start || i + SPIKE_SIDE >= s->n) {
        const double level = small_median(start ? right : left, SPIKE_SIDE);
        const double next =
            small_median(start ? right + SPIKE_SIDE : left - SPIKE_SIDE, SPIKE_SIDE);
        return x - level > spike_threshold + 2.0 * fabs(level - next) &&
               (start || !continues_contact(s, i, n_kept, spike_threshold));
    }
    const double last = s->force[n_kept - 1], next = s->force[i + 1];
    const double neighbour_excess = (last < next ? last : next) - x;
    if (!(neighbour_excess > spike_threshold) && /* a contact fails with the right side already */
        !(exceeds_majority(right, x - 0.5 * spike_threshold) &&
          exceeds_majority(left, x - 0.5 * spike_threshold)))
        return false; /* this test avoids the slower medians */
    const double before = small_median(left, SPIKE_SIDE), after = small_median(right, SPIKE_SIDE);
    const double above = x - fmax(before, after), below = fmin(before, after) - x;
    return above > spike_threshold ||
           (neighbour_excess > spike_threshold &&
            below > fmax(spike_threshold, spike_step * fabs(before - after)));
}

/* Returns the first sample from i > 0 on that differs much from the previous one or is near the
 * end. */
WIDE_REGISTERS static size_t skip_quiet_samples(const curve_samples *s, size_t i,
                                                double spike_threshold)
{
    const double *force = s->force;
    while (i >= SPIKE_SIDE && i + SPIKE_SIDE + WIDE < s->n) {
        wide now, before;
        simd_load(&now, force + i);
        simd_load(&before, force + i - 1);
        const wide step = now - before;
        const wide_bits any = (step > spike_threshold) | (-step > spike_threshold);
        if ((any[0] | any[1] | any[2] | any[3]) != 0)
            break;
        i += WIDE;
    }
    return i;
}

/* Removes spikes and returns their number. */
static size_t remove_spikes(curve_samples *s, double spike_threshold)
{
    size_t n_kept = 0;
    bool after_spike = true; /* also true at an end */
    for (size_t i = 0; i < s->n; i++) {
        if (n_kept == i && !after_spike)
            i = n_kept = skip_quiet_samples(s, i, 0.5 * spike_threshold);
        const bool end = n_kept < SPIKE_SIDE || i + SPIKE_SIDE >= s->n;
        const bool spike = (end || after_spike ||
                            fabs(s->force[i] - s->force[n_kept - 1]) > 0.5 * spike_threshold) &&
                           is_spike(s, i, n_kept, spike_threshold);
        after_spike = spike;
        if (spike)
            continue;
        s->position[n_kept] = s->position[i];
        s->force[n_kept++] = s->force[i];
    }
    const size_t spikes = s->n - n_kept;
    s->n = n_kept;
    return spikes;
}

/* Number of samples below the limit of the force above its start. It is halfway between the first
 * sample above and the last below. */
static size_t count_below_limit(const curve_samples *s, const wt_indent_options *o)
{
    const double start = sample_mean(s->force, s->n / 10),
                 max = curve_find_span(s->force, s->n).high;
    double limit = start + o->fit_force_fraction * (max - start);
    if (o->fit_force > 0.0)
        limit = fmin(limit, start + o->fit_force);
    size_t first_above = s->n, last_below = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (s->force[i] > limit && i < first_above)
            first_above = i;
        if (s->force[i] <= limit)
            last_below = i;
    }
    return (first_above + last_below + 1) / 2;
}

void curve_set_reason(char reason[160], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    clocale_vprint(reason, 160, format, arguments);
    va_end(arguments);
}

si_text curve_format_si(double value, const char *unit)
{
    si_text text;
    wt_format_si(value, unit, 3, text.buffer, sizeof text.buffer);
    return text;
}

/* Orients the positions and subtracts the means, which preserves digits in sums. */
WIDE_REGISTERS static wt_curve_verdict orient_and_centre(curve_input *input, char reason[160])
{
    curve_samples *s = &input->samples;
    const size_t end = s->n / 20 + 1;
    const curve_span all = curve_find_span(s->position, s->n);
    const double travel =
        sample_mean(s->position + s->n - end, end) - sample_mean(s->position, end);
    if (!(fabs(travel) > travel_share * (all.high - all.low))) {
        curve_set_reason(
            reason, "the height does not go one way: from start to end %s in a range of %s",
            curve_format_si(travel, "m").buffer, curve_format_si(all.high - all.low, "m").buffer);
        return WT_CURVE_NO_APPROACH;
    }
    input->direction = travel > 0.0 ? 1.0 : -1.0;
    const double direction = input->direction,
                 position_origin = input->position_origin =
                     direction * sample_mean(s->position, s->n),
                 force_origin = input->force_origin = sample_mean(s->force, s->n);
    double *restrict position = s->position, *restrict force = s->force;
    for (size_t i = 0; i < s->n; i++) {
        position[i] = direction * position[i] - position_origin;
        force[i] -= force_origin;
    }
    return WT_CURVE_ACCEPTED;
}

/* Leaves out the samples before the chosen baseline, and those between its end and contact but for
 * the last, from which the loading time counts. */
static void keep_baseline(const wt_indent_options *options, double contact, curve_input *input)
{
    curve_samples *s = &input->samples;
    size_t n_kept = 0;
    if (isnan(options->baseline_from) && isnan(options->baseline_to))
        return;
    for (size_t i = 0; i < s->n; i++) {
        const double at = s->position[i] + input->position_origin;
        const bool is_last_before =
            i + 1 == s->n || s->position[i + 1] + input->position_origin >= contact;
        if (at < options->baseline_from ||
            (at > options->baseline_to && at < contact && !is_last_before))
            continue;
        s->position[n_kept] = s->position[i];
        s->force[n_kept++] = s->force[i];
    }
    s->n = n_kept;
}

/* Rejects a tip that hardly advances or moves backwards. */
static wt_curve_verdict advance_verdict(const curve_input *input, char reason[160])
{
    const double advance = advance_per_bending(&input->samples, input->step_noise) - 1.0;
    if (advance > -1.0 && advance < -rigid_share) { /* below -1 the force has the wrong sign */
        curve_set_reason(
            reason,
            "the cantilever bends %.3g times as far as the piezo moves: deflection sensitivity, "
            "spring constant or a unit is wrong",
            1.0 / (1.0 + advance));
        return WT_CURVE_RIGID;
    }
    if (fabs(advance) < rigid_share) {
        curve_set_reason(reason,
                         "the tip advances %.1f %% of the bending of the cantilever, %g %% "
                         "needed for a modulus",
                         100.0 * advance, 100.0 * rigid_share);
        return WT_CURVE_RIGID;
    }
    return WT_CURVE_ACCEPTED;
}

wt_curve_verdict curve_prepare(const double *height, const double *force, size_t n,
                               double spring_constant, const wt_indent_options *options,
                               double contact, wt_indent_workspace *w, curve_input *input,
                               char reason[160])
{
    *input = (curve_input){.samples = {.position = w->position,
                                       .force = w->force,
                                       .spring_constant = spring_constant}};
    curve_samples *s = &input->samples;
    s->n = copy_good_samples(height, force, n, input);
    if ((double)input->n_missing > missing_share * (double)n) {
        curve_set_reason(reason, "%zu of %zu samples are not numbers, %g %% allowed",
                         input->n_missing, n, 100.0 * missing_share);
        return WT_CURVE_NOT_FINITE;
    }
    if (s->n < CURVE_MIN_SAMPLES) {
        curve_set_reason(reason, "%zu different samples, %d needed", s->n, CURVE_MIN_SAMPLES);
        return WT_CURVE_TOO_SHORT;
    }

    double resolution = 0.0;
    input->step_noise = difference_noise(s, w->scratch, &resolution);
    const double spike_threshold = spike_noise * fmax(input->step_noise, resolution);
    if (spike_threshold > 0.0) /* one pass only; further passes would remove samples of a contact
                      noisier than the baseline */
        input->n_spikes = remove_spikes(s, spike_threshold);
    if ((double)input->n_spikes > spike_share * (double)n) {
        curve_set_reason(reason, "%zu of %zu samples are spikes, %g %% allowed", input->n_spikes, n,
                         100.0 * spike_share);
        return WT_CURVE_NOT_FINITE;
    }

    const wt_curve_verdict verdict = orient_and_centre(input, reason);
    if (verdict != WT_CURVE_ACCEPTED)
        return verdict;
    keep_baseline(options, contact, input);
    if (s->n < CURVE_MIN_SAMPLES) {
        curve_set_reason(reason, "%zu samples with the chosen baseline, %d needed", s->n,
                         CURVE_MIN_SAMPLES);
        return WT_CURVE_TOO_SHORT;
    }

    input->n_all = s->n;
    size_t top = 0;
    if (options->fit_force_fraction < 1.0 || options->fit_force > 0.0) {
        input->saturated = has_flat_top(s, input->step_noise, resolution, &top);
        s->n = count_below_limit(s, options);
    }
    if (s->n < CURVE_MIN_SAMPLES) {
        curve_set_reason(reason, "%zu samples below the limit of the force, %d needed", s->n,
                         CURVE_MIN_SAMPLES);
        return WT_CURVE_TOO_SHORT;
    }

    if (has_flat_top(s, input->step_noise, resolution, &top)) {
        const double level = s->force[top] - sample_mean(s->force, s->n / 10);
        const double travel_at_top = s->position[s->n - 1] - s->position[top];
        input->flat_level = level;
        curve_set_reason(
            reason,
            "force stands still at %s above its start over the last %zu samples (%s of travel)",
            curve_format_si(level, "N").buffer, s->n - top,
            curve_format_si(travel_at_top, "m").buffer);
        return WT_CURVE_SATURATED;
    }
    return advance_verdict(input, reason);
}

void curve_reverse(curve_samples *s)
{
    numbers_reverse(s->position, s->n);
    numbers_reverse(s->force, s->n);
    for (size_t i = 0; i < s->n; i++)
        s->position[i] = -s->position[i];
}
