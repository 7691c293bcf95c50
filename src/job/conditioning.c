/* Plausibility of measured values, agreement of isotherms of one temperature, and conditioning of
 * friction records: outliers, load near zero, zero of the friction force.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/conditioning.h"
#include "core/base/array.h"
#include "core/math/special.h"
#include "job/inputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What rubber, plastics and their instruments can have, with a decade to spare on either side, and
 * the likely cause of a value outside. */
typedef struct plausible_range {
    const char *quantity, *unit;
    double low, high;
    const char *cause_below, *cause_above;
} plausible_range;

enum { MODULUS, SHEAR_MODULUS, FREQUENCY, TEMPERATURE, COEFFICIENT };
static const plausible_range ranges[] = {
    [MODULUS] = {"modulus", "Pa", 1e3, 1e11, "a unit such as mPa for MPa, or Pa for MPa",
                 "a unit such as GPa for MPa, or a decimal separator that is lost"},
    /* Gels have shear moduli of some 100 Pa. */
    [SHEAR_MODULUS] = {"shear modulus", "Pa", 10, 4e10, "a unit such as mPa for MPa, or Pa for MPa",
                       "a unit such as GPa for MPa, or a decimal separator that is lost"},
    /* Instruments reach 200 Hz, some 1 kHz; a day number of a spreadsheet is above 36,000. */
    [FREQUENCY] = {"frequency", "rad/s", 1e-7, 2 * M_PI * 1e4, "a time in place of a frequency",
                   "a cell that a spreadsheet turned into a date, or a wrong unit"},
    [TEMPERATURE] = {"temperature", "K", 70, 900, "degrees Celsius read as kelvin",
                     "a wrong unit or column"},
    /* Clean soft rubber on smooth glass reaches 3 to 4. */
    [COEFFICIENT] = {"friction coefficient", "1", 1e-3, 4, "a wrong unit or column of a force",
                     "percent, or a wrong unit or column of a force"},
};

static void check_value(double value, size_t which, const char *place, wt_log *log)
{
    const plausible_range *const r = &ranges[which];
    const bool below = value < r->low;
    if (isnan(value) || (!below && !(value > r->high)))
        return;
    wt_log_action(log, WT_WARNING, WT_IMPLAUSIBLE, 0, NULL, place, NULL,
                  "a %s of %.4g %s is implausible; the likely cause is %s", r->quantity, value,
                  r->unit, below ? r->cause_below : r->cause_above);
}

void check_friction_coefficient(double typical, const char *file, wt_log *log)
{
    check_value(fabs(typical), COEFFICIENT, file, log);
}

static void add_range(const double *x, size_t n, double *low, double *high)
{
    for (size_t i = 0; i < n; i++) {
        *low = fmin(*low, x[i]); /* NaN is passed over */
        *high = fmax(*high, x[i]);
    }
}

/* Checks that some modulus of the sweep is one that rubber can have. Melts and glasses begin and
 * end beyond that. */
static void check_moduli(const wt_sweep *sweep, wt_log *log)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        add_range(sweep->isotherms[i].storage_modulus, sweep->isotherms[i].n, &low, &high);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        add_range(sweep->ramps[i].storage_modulus, sweep->ramps[i].n, &low, &high);
    if (!(low <= high))
        return;
    const char *const source =
        sweep->n_isotherms > 0 ? sweep->isotherms[0].source : sweep->ramps[0].source;
    const size_t which = sweep->deformation == WT_SHEAR ? SHEAR_MODULUS : MODULUS;
    if (high < ranges[which].low)
        check_value(high, which, source, log);
    else if (low > ranges[which].high)
        check_value(low, which, source, log);
}

/* A date among frequencies stands far from them. The frequencies of a master curve, which may be
 * extrapolated over many decades, follow one another. */
static void check_frequencies(const wt_isotherm *t, wt_log *log)
{
    /* Isotherms have a point in each decade at least; a day number is 450 times 100 Hz. */
    static const double largest_step = 30;
    size_t first = t->n;
    while (first > 0 && t->angular_frequency[first - 1] > ranges[FREQUENCY].high)
        first--;
    if (first == 0 || first == t->n ||
        t->angular_frequency[first] > largest_step * t->angular_frequency[first - 1])
        check_value(t->angular_frequency[t->n - 1], FREQUENCY, t->source, log);
}

/* ---- isotherms of one temperature ------------------------------------------------------------ */

/* Temperatures of one set point differ by less in all instruments of the source formats. */
static const double same_temperature = 0.5; /* [K] */
/* Isotherms may be measured in steps as small as that: two of one temperature are nearer than this
 * share of the mean step, unless all are within the range of one set point [K]. */
static const double same_share = 0.5, one_set_point = 2.5;
/* A clamp that is closed again changes a modulus by 3 to 5 % (ISO 6721-1). */
static const double same_modulus = 0.05;

/* Median of ln E' of b over that of a at the frequencies that both have. NaN if there are none. */
static double modulus_difference(const wt_isotherm *a, const wt_isotherm *b)
{
    const double same_frequency = 1e-3; /* instruments repeat their set values to four digits */
    double *const difference = wt_alloc(a->n + b->n, sizeof *difference);
    size_t n = 0;
    for (size_t i = 0, k = 0; i < a->n && k < b->n;) {
        const double step = b->angular_frequency[k] / a->angular_frequency[i] - 1;
        if (fabs(step) <= same_frequency && a->storage_modulus[i] > 0 && b->storage_modulus[k] > 0)
            difference[n++] = log(b->storage_modulus[k] / a->storage_modulus[i]);
        i += step >= 0 || fabs(step) <= same_frequency;
        k += step < 0 || fabs(step) <= same_frequency;
    }
    const double median = n > 0 ? numbers_median(difference, n) : (double)NAN;
    free(difference);
    return median;
}

static void check_repeated(const wt_sweep *sweep, wt_log *log)
{
    size_t n = 0;
    double largest = 0;
    const wt_isotherm *first = NULL, *const all = sweep->isotherms;
    const size_t steps = sweep->n_isotherms > 0 ? sweep->n_isotherms - 1 : 0;
    const double range = steps > 0 ? fabs(all[steps].temperature - all[0].temperature) : 0;
    double nearest = same_temperature;
    if (range > one_set_point)
        nearest = fmin(nearest, same_share * range / (double)steps);
    for (size_t i = 0; i + 1 < sweep->n_isotherms; i++) {
        const wt_isotherm *const a = &sweep->isotherms[i], *const b = a + 1;
        const double difference = modulus_difference(a, b);
        const bool same_sample =
            a->sample == NULL || b->sample == NULL || strcmp(a->sample, b->sample) == 0;
        if (fabs(b->temperature - a->temperature) > nearest || !same_sample || a->shift_is_stated ||
            !(fabs(difference) > same_modulus))
            continue;
        n++;
        first = first == NULL ? a : first;
        largest = fmax(largest, fabs(difference));
    }
    if (n > 0)
        wt_log_action(
            log, WT_WARNING, WT_CONTRADICTED, n, "--exclude", first->source, NULL,
            "two isotherms of the same temperature differ by %.0f %% in the storage modulus "
            "(at %.4g degC%s): two specimens, or a material that changed between two runs; "
            "separate the runs into files and take one",
            100 * expm1(largest), first->temperature - WT_ZERO_CELSIUS,
            n > 1 ? " and at other temperatures" : "");
}

void check_sweep(const wt_sweep *sweep, wt_log *log)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *const t = &sweep->isotherms[i];
        if (t->n == 0)
            continue;
        const wt_isotherm *const before = i > 0 ? t - 1 : NULL;
        if (before != NULL && strcmp(before->source, t->source) == 0)
            continue; /* one message for a file and step */
        check_value(t->temperature, TEMPERATURE, t->source, log);
        if (sweep->loading == WT_OSCILLATION && !t->shift_is_stated)
            check_frequencies(t, log);
    }
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        const wt_ramp *const r = &sweep->ramps[i];
        check_value(r->angular_frequency, FREQUENCY, r->source, log);
    }
    check_moduli(sweep, log);
    check_repeated(sweep, log);
}

/* A sample is an outlier at ten times what nine of ten samples stay below. A peak of static
 * friction is two to three times the sliding friction, so that no friction is left out. */
static const double outlier_factor = 10, usual_share = 0.9;
/* Longest run of outliers. A longer one is a condition of the experiment, such as another load. */
enum { LONGEST_RUN = 3 };
/* Least number of samples for a share of 0.9 to say anything. */
enum { LEAST_SAMPLES = 20 };
/* A value outside of five standard deviations is no scatter of a normal distribution: once in 1.7
 * million. */
static const double scatter_deviations = 5;
/* Number of samples before loading for a zero with a standard error below a third of the scatter.
 */
enum { LEAST_ZERO_SAMPLES = 10 };
/* A zero below a thousandth of the friction changes no digit that is reported. */
static const double least_zero = 1e-3;

/* The value that nine of ten magnitudes stay below. NaN if there are too few. */
static double usual_magnitude(const double *x, size_t n)
{
    double *const sorted = wt_alloc(n, sizeof *sorted);
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (!isnan(x[i]))
            sorted[m++] = fabs(x[i]);
    numbers_sort(sorted, m);
    const double usual =
        m < LEAST_SAMPLES ? (double)NAN : sorted[(size_t)(usual_share * (double)(m - 1))];
    free(sorted);
    return usual;
}

/* True if a magnitude is above `factor` times the usual one. Counting tells it without sorting. */
static bool exceeds_usual(const double *x, size_t n, double factor)
{
    double largest = 0;
    size_t m = 0, n_below = 0;
    for (size_t i = 0; i < n; i++) {
        largest = fabs(x[i]) > largest ? fabs(x[i]) : largest;
        m += isnan(x[i]) ? 0 : 1;
    }
    for (size_t i = 0; i < n; i++)
        n_below += factor * fabs(x[i]) < largest ? 1 : 0;
    return m >= LEAST_SAMPLES && n_below > (size_t)(usual_share * (double)(m - 1));
}

static void leave_out_outliers(double *x, size_t n, const char *what, const char *file, wt_log *log)
{
    if (x == NULL || !exceeds_usual(x, n, outlier_factor))
        return;
    const double most = outlier_factor * usual_magnitude(x, n);
    size_t count = 0, first = 0;
    double value = 0;
    for (size_t i = 0, to; most > 0 && i < n; i = to) {
        to = i + 1;
        if (!(fabs(x[i]) > most))
            continue;
        while (to < n && fabs(x[to]) > most)
            to++;
        if (to - i > LONGEST_RUN)
            continue;
        first = count == 0 ? i : first;
        value = count == 0 ? x[i] : value;
        count += to - i;
        for (size_t k = i; k < to; k++)
            x[k] = (double)NAN;
    }
    if (count > 0)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, count, WT_KEEP_OPTION, file, NULL,
                      "%zu of %zu samples of the %s left out as outliers, more than %.0f times the "
                      "usual value; the first is %.6g at sample %zu",
                      count, n, what, outlier_factor, value, first + 1);
}

/* An unloaded sensor scatters around zero: as far above it as below. */
static void remove_load_near_zero(double *load, size_t n)
{
    double squares = 0;
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        if (load[i] < 0) {
            squares += load[i] * load[i];
            count++;
        }
    const double most = count > 1 ? scatter_deviations * sqrt(squares / (double)count) : 0;
    const double usual = most > 0 ? usual_magnitude(load, n) : 0;
    for (size_t i = 0; most < usual && i < n; i++)
        if (load[i] > 0 && load[i] < most)
            load[i] = 0;
}

static void subtract_zero(double *force, const double *load, size_t n, const char *file,
                          wt_log *log)
{
    double mean = 0, squares = 0;
    size_t count = 0, first = 0;
    while (first < n && !(load[first] > 0)) {
        const double x = force[first++];
        if (isnan(x))
            continue;
        const double step = x - mean;
        mean += step / (double)++count;
        squares += step * (x - mean);
    }
    if (count < LEAST_ZERO_SAMPLES || first == n)
        return;
    const double scatter = sqrt(squares / (double)(count - 1));
    if (!(fabs(mean) > scatter_deviations * scatter / sqrt((double)count) &&
          fabs(mean) > least_zero * usual_magnitude(force, n)))
        return;
    for (size_t i = 0; i < n; i++)
        force[i] -= mean;
    wt_log_action(
        log, WT_WARNING, WT_CORRECTED, n, WT_KEEP_OPTION, file, NULL,
        "a zero of the friction force of %.4g N is seen in %zu samples before loading, and "
        "is subtracted",
        mean, count);
}

/* ---- hashes of samples ----------------------------------------------------------------------- */

static sample_slot *find_slot(const sample_set *set, uint64_t hash)
{
    size_t i = (size_t)hash & (set->size - 1);
    while (set->slot[i].owner != NULL && set->slot[i].hash != hash)
        i = (i + 1) & (set->size - 1);
    return &set->slot[i];
}

static void grow(sample_set *set)
{
    const sample_set old = *set;
    set->size = old.size > 0 ? 2 * old.size : 16;
    set->slot = wt_alloc(set->size, sizeof *set->slot);
    for (size_t i = 0; i < old.size; i++)
        if (old.slot[i].owner != NULL)
            *find_slot(set, old.slot[i].hash) = old.slot[i];
    free(old.slot);
}

static const void *sample_set_add(sample_set *set, uint64_t hash, const void *owner)
{
    if (2 * set->n >= set->size)
        grow(set);
    sample_slot *const slot = find_slot(set, hash);
    if (slot->owner == NULL) {
        *slot = (sample_slot){hash, owner};
        set->n++;
    }
    return slot->owner;
}

void sample_set_clear(sample_set *set)
{
    free(set->slot);
    *set = (sample_set){0};
}

/* One step is a one-to-one function of the hash, so that one changed sample always changes it. The
 * shift brings the high bits, such as the sign, to the low ones. */
static uint64_t hash_step(uint64_t hash, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ (hash >> 32);
}

uint64_t flow_hash_samples(uint64_t before, const double *x, size_t n)
{
    /* Each step waits for the one before it; the processor computes four chains at once. */
    enum { CHAINS = 4 };
    uint64_t chain[CHAINS], hash = splitmix64(before ^ n);
    size_t i = 0;
    for (size_t k = 0; k < CHAINS; k++)
        chain[k] = splitmix64(before + k);
    for (; i + CHAINS <= n; i += CHAINS)
        for (size_t k = 0; k < CHAINS; k++)
            chain[k] = hash_step(chain[k], x[i + k]);
    for (; i < n; i++)
        hash = hash_step(hash, x[i]);
    for (size_t k = 0; k < CHAINS; k++)
        hash = splitmix64(hash) ^ chain[k]; /* a step alone changes alike where signs change */
    return splitmix64(hash);
}

/* Returns the earlier file with the same samples; NULL if there is none, or if `file` counts as it
 * stands. */
static const flow_file *find_original(const flow_file *file, uint64_t samples)
{
    const flow_file *const first =
        file->seen != NULL ? sample_set_add(file->seen, samples, file) : file;
    const bool counts_again = first == file || file->set->read.conditioning != WT_CONDITIONING_MEND;
    return counts_again ? NULL : first;
}

static void log_copy(flow_file *file, const flow_file *original, const wt_job *work)
{
    file->is_copy = true;
    wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, WT_KEEP_OPTION, file->name, NULL,
                  "the same samples as %s: a copy, left out; both count as one measurement",
                  original->name);
}

wt_status flow_check_copy(flow_file *file, uint64_t samples, const wt_job *work)
{
    const flow_file *const original = find_original(file, samples);
    if (original == NULL)
        return WT_OK;
    log_copy(file, original, work);
    return WT_END;
}

uint64_t condition_hash_curve(const flow_file *file, const wt_force_curve *curve)
{
    uint64_t hash = 0;
    for (size_t i = 0; file->seen != NULL && i < curve->n_segments; i++) {
        const wt_segment *const segment = &curve->segments[i];
        for (size_t c = 0; c < segment->n_channels; c++)
            hash = flow_hash_samples(hash ^ (uint64_t)segment->channels[c].quantity,
                                     segment->channels[c].values, segment->n_points);
    }
    return hash;
}

bool flow_is_copied_curve(flow_file *file, uint64_t samples, copied_curves *copies)
{
    const flow_file *const original = samples != 0 ? find_original(file, samples) : NULL;
    if (original != NULL && copies->n++ == 0)
        copies->original = original;
    return original != NULL;
}

void flow_log_copies(flow_file *file, const copied_curves *copies, size_t n_all, const wt_job *work)
{
    if (copies->n > 0 && copies->n == n_all)
        log_copy(file, copies->original, work);
    else if (copies->n > 0)
        wt_log_action(work->log, WT_WARNING, WT_COPIED, copies->n, WT_KEEP_OPTION, file->name, NULL,
                      "%zu of %zu curves have the same samples as curves of other files, such as "
                      "%s: copies, left out; both count as one measurement",
                      copies->n, n_all, copies->original->name);
}

uint64_t condition_hash_record(const flow_file *file, const wt_record *record)
{
    uint64_t hash = 0;
    for (size_t c = 0; file->seen != NULL && c < WT_RECORD_CHANNELS; c++)
        if (record->channel[c] != NULL)
            hash = flow_hash_samples(hash ^ c, record->channel[c], record->n);
    return hash;
}

void condition_record(wt_record *record, const char *file, wt_log *log)
{
    double *const force = record->channel[WT_RECORD_FRICTION_FORCE],
                  *const load = record->channel[WT_RECORD_NORMAL_FORCE];
    leave_out_outliers(record->channel[WT_RECORD_COEFFICIENT], record->n, "friction coefficient",
                       file, log);
    leave_out_outliers(force, record->n, "friction force", file, log);
    leave_out_outliers(load, record->n, "normal force", file, log);
    if (load != NULL) {
        remove_load_near_zero(load, record->n);
        if (force != NULL)
            subtract_zero(force, load, record->n, file, log);
    }
}

/* Standard deviation of a normal distribution over its median and its mean absolute deviation. */
static const double deviations_per_median = 1.4826, deviations_per_mean = 1.253314137315500;

typical_values flow_typical_values(double *values, size_t n)
{
    const double middle = numbers_median(values, n);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        values[i] = fabs(values[i] - middle);
        sum += values[i];
    }
    const double distance = numbers_median(values, n);
    return (typical_values){middle, scatter_deviations *
                                        (distance > 0 ? deviations_per_median * distance
                                                      : deviations_per_mean * sum / (double)n)};
}
