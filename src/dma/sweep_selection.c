/* Selects sweeps: by sample, by strain amplitude, and by excluded temperatures, frequencies or
 * times. A filled rubber softens with strain, so a master curve belongs to one amplitude.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"

#include "core/base/array.h"
#include "core/data/sweep_points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- sample ---------------------------------------------------------------------------------- */

static const char unnamed_label[] = "(without a name)";

/* Isotherms within 0.5 K have the same temperature. */
static const double repeat_tolerance = 0.5;

static bool has_sample_name(const char *sample, const char *name)
{
    return strcmp(sample != NULL ? sample : "", name) == 0;
}

/* ---- list of samples ------------------------------------------------------------------------- */

static void add_sample_name(wt_sample_names *samples, const char *sample)
{
    const char *name = sample != NULL ? sample : "";
    for (size_t i = 0; i < samples->n; i++)
        if (strcmp(samples->name[i], name) == 0)
            return;
    samples->name = array_grow(samples->name, samples->n, sizeof *samples->name);
    samples->name[samples->n++] = wt_strdup(name);
}

static int compare_sample_names(const void *a, const void *b)
{
    return strverscmp(*(char *const *)a, *(char *const *)b);
}

wt_sample_names flow_samples_find(const wt_sweep *sweep)
{
    wt_sample_names samples = {0, NULL};
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        add_sample_name(&samples, sweep->isotherms[i].sample);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        add_sample_name(&samples, sweep->ramps[i].sample);
    if (samples.n > 1)
        qsort(samples.name, samples.n, sizeof *samples.name, compare_sample_names);
    return samples;
}

void wt_sample_names_clear(wt_sample_names *samples)
{
    if (samples == NULL)
        return;
    for (size_t i = 0; i < samples->n; i++)
        free(samples->name[i]);
    free(samples->name);
    *samples = (wt_sample_names){0, NULL};
}

/* ---- selection of one sample ----------------------------------------------------------------- */

static void list_sample_names(const wt_sample_names *samples, char *text, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < samples->n && used < size; i++) {
        const char *name = samples->name[i][0] != '\0' ? samples->name[i] : unnamed_label;
        if (used + strlen(name) + 8 > size) {
            snprintf(text + used, size - used, ", ...");
            return;
        }
        used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "", name);
    }
}

static wt_status fail_sample_missing(const wt_sweep *sweep, const char *name, wt_error *err)
{
    char found[256] = "";
    wt_sample_names samples = flow_samples_find(sweep);
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        add_sample_name(&samples, sweep->strain_sweeps[i].sample);
    list_sample_names(&samples, found, sizeof found);
    wt_sample_names_clear(&samples);
    wt_fail(err, WT_E_NOT_FOUND, "no sweep is of the sample \"%s\"", name);
    wt_error_found(err, "%s", found);
    return WT_E_NOT_FOUND;
}

wt_status flow_select_sample(wt_sweep *sweep, const char *name, wt_error *err)
{
    if (name == NULL || strcmp(name, "all") == 0)
        return WT_OK;
    bool is_found = false;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        is_found = is_found || has_sample_name(sweep->isotherms[i].sample, name);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        is_found = is_found || has_sample_name(sweep->ramps[i].sample, name);
    for (size_t i = 0; i < sweep->n_strain_sweeps; i++)
        is_found = is_found || has_sample_name(sweep->strain_sweeps[i].sample, name);
    return is_found ? wt_sweep_select_sample(sweep, name) : fail_sample_missing(sweep, name, err);
}

/* Warns if two files measured at one temperature and neither names a sample. */
static void warn_repeated_temperature(const wt_sweep *sweep, wt_log *log)
{
    for (size_t i = 1; i < sweep->n_isotherms; i++) {
        const wt_isotherm *a = &sweep->isotherms[i - 1], *b = &sweep->isotherms[i];
        const size_t length = strcspn(a->source, ",");
        if (a->sample != NULL || b->sample != NULL ||
            !(fabs(a->temperature - b->temperature) <= repeat_tolerance) ||
            (strcspn(b->source, ",") == length && strncmp(a->source, b->source, length) == 0))
            continue;
        wt_log_add(log, WT_WARNING, b->source, NULL,
                   "measured at %.1f degC like %.*s: taken as one material measured again; if "
                   "each file is of a material, give --sample-by file",
                   b->temperature - WT_ZERO_CELSIUS, (int)length, a->source);
        return;
    }
}

wt_status flow_require_one_sample(const wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                                  wt_log *log, wt_error *err)
{
    char found[256] = "";
    wt_status status = WT_OK;
    if (n_sets > 0 && sets[0].read.sample != NULL)
        return WT_OK;
    warn_repeated_temperature(sweep, log);
    wt_sample_names samples = flow_samples_find(sweep);
    if (samples.n > 1) {
        list_sample_names(&samples, found, sizeof found);
        status = wt_fail(err, WT_E_AMBIGUOUS, "sweeps of several samples");
        wt_error_expected(err, "those of one");
        wt_error_found(err, "%s", found);
        wt_error_advice(err,
                        "choose one with --sample NAME; --sample all if they are of one material");
        wt_error_options(err, "sample");
    }
    wt_sample_names_clear(&samples);
    return status;
}

/* ---- stated exclusions ----------------------------------------------------------------------- */

/* A single value excludes the data within 0.5 K (stability of a chamber) or within 1 % of a
 * frequency. */
static const double same_temperature = 0.5, same_frequency = 0.01;

typedef struct exclusion_range {
    bool by_frequency; /* frequency, or time, which isotherms store as its inverse */
    bool by_time;
    double low, high; /* limits [K] or [rad/s] */
} exclusion_range;

/* ---- option values --------------------------------------------------------------------------- */

static wt_status fail_exclusion_text(const char *text, wt_error *err)
{
    wt_fail(err, WT_E_ARG, "\"%s\" does not say what to leave out", text);
    wt_error_expected(err,
                      "temperature:-40degC..-20degC, temperature:..-20degC, temperature:25degC, "
                      "or frequency: and hertz, or time: and seconds, in the same way");
    return WT_E_ARG;
}

static wt_status parse_limit(const exclusion_range *c, const char *text, double *value,
                             wt_error *err)
{
    const wt_quantity quantity = c->by_time        ? WT_Q_TIME
                                 : c->by_frequency ? WT_Q_FREQUENCY
                                                   : WT_Q_TEMPERATURE;
    const wt_status status = wt_quantity_parse(text, quantity, value, err);
    if (status == WT_OK && c->by_time)
        *value = 1 / *value;
    else if (status == WT_OK && c->by_frequency)
        *value *= 2 * M_PI;
    return status;
}

static wt_status parse_range(const char *text, exclusion_range *c, wt_error *err)
{
    const char *dots = strstr(text, "..");
    if (dots == NULL) {
        double at;
        const wt_status status = parse_limit(c, text, &at, err);
        c->low = c->by_frequency ? at / (1 + same_frequency) : at - same_temperature;
        c->high = c->by_frequency ? at * (1 + same_frequency) : at + same_temperature;
        return status;
    }
    char *low = wt_strndup(text, (size_t)(dots - text));
    wt_status status = WT_OK;
    double *const from = c->by_time ? &c->high : &c->low, *const to =
                                                              c->by_time ? &c->low : &c->high;
    c->low = -HUGE_VAL;
    c->high = HUGE_VAL;
    if (low[0] != '\0')
        status = parse_limit(c, low, from, err);
    if (status == WT_OK && dots[2] != '\0')
        status = parse_limit(c, dots + 2, to, err);
    free(low);
    return status == WT_OK && !(c->low < c->high) ? fail_exclusion_text(text, err) : status;
}

static wt_status parse_exclusion(const char *text, exclusion_range *c, wt_error *err)
{
    static const char temperature[] = "temperature:", frequency[] = "frequency:", time[] = "time:";
    *c = (exclusion_range){.by_time = strncmp(text, time, strlen(time)) == 0};
    c->by_frequency = c->by_time || strncmp(text, frequency, strlen(frequency)) == 0;
    const char *range = strchr(text, ':');
    if ((!c->by_frequency && strncmp(text, temperature, strlen(temperature)) != 0) ||
        strcmp(range, ":") == 0 || strcmp(range, ":..") == 0)
        return fail_exclusion_text(text, err);
    return parse_range(range + 1, c, err);
}

/* ---- exclusion ------------------------------------------------------------------------------- */

static bool is_excluded(const exclusion_range *c, double x)
{
    return x >= c->low && x <= c->high;
}

/* Moves the remaining points to the front and returns their number. */
static size_t compact_points(const exclusion_range *c, sweep_points p)
{
    size_t n_left = 0;
    for (size_t i = 0; i < p.n; i++) {
        if (is_excluded(c, p.array[SWEEP_VARIABLE][i]))
            continue;
        for (size_t k = 0; k < SWEEP_ARRAYS; k++)
            if (p.array[k] != NULL)
                p.array[k][n_left] = p.array[k][i];
        n_left++;
    }
    return n_left;
}

/* Frees the isotherms and then the temperature sweeps that `drop` marks [n_isotherms + n_ramps].
 * removed: their numbers. */
static void remove_sweeps(wt_sweep *sweep, const bool *drop, size_t removed[2])
{
    wt_sweep excluded = {.isotherms = wt_alloc(sweep->n_isotherms, sizeof *sweep->isotherms),
                         .ramps = wt_alloc(sweep->n_ramps, sizeof *sweep->ramps)};
    size_t isotherms = 0, ramps = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        if (*drop++)
            excluded.isotherms[excluded.n_isotherms++] = sweep->isotherms[i];
        else
            sweep->isotherms[isotherms++] = sweep->isotherms[i];
    for (size_t i = 0; i < sweep->n_ramps; i++)
        if (*drop++)
            excluded.ramps[excluded.n_ramps++] = sweep->ramps[i];
        else
            sweep->ramps[ramps++] = sweep->ramps[i];
    sweep->n_isotherms = isotherms;
    sweep->n_ramps = ramps;
    removed[0] = excluded.n_isotherms;
    removed[1] = excluded.n_ramps;
    wt_sweep_clear(&excluded);
}

/* Removes the excluded points and marks what is excluded as a whole. Returns the number of single
 * points. */
static size_t exclude_points(const exclusion_range *c, wt_sweep *sweep, bool *drop)
{
    size_t points = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++, drop++) {
        wt_isotherm *t = &sweep->isotherms[i];
        const size_t before = t->n;
        if (c->by_frequency)
            t->n = compact_points(c, isotherm_points(t));
        *drop = t->n == 0 || (!c->by_frequency && is_excluded(c, t->temperature));
        points += *drop ? 0 : before - t->n;
    }
    for (size_t i = 0; i < sweep->n_ramps; i++, drop++) {
        wt_ramp *t = &sweep->ramps[i];
        const size_t before = t->n;
        if (!c->by_frequency)
            t->n = compact_points(c, ramp_points(t));
        *drop = t->n == 0 || (c->by_frequency && is_excluded(c, t->angular_frequency));
        points += *drop ? 0 : before - t->n;
    }
    return points;
}

static wt_status apply_exclusion(const char *text, wt_sweep *sweep, wt_log *log, wt_error *err)
{
    exclusion_range c;
    wt_status status = parse_exclusion(text, &c, err);
    if (status == WT_OK && c.by_frequency && c.by_time != (sweep->loading != WT_OSCILLATION)) {
        status = wt_fail(err, WT_E_ARG, "\"%s\" is of no point of this DMA", text);
        wt_error_expected(err, c.by_time ? "frequency: for an oscillation"
                                         : "time: for relaxation and creep");
    }
    if (status != WT_OK)
        return status;
    bool *drop = wt_alloc(sweep->n_isotherms + sweep->n_ramps, sizeof *drop);
    size_t removed[2];
    const size_t points = exclude_points(&c, sweep, drop);
    remove_sweeps(sweep, drop, removed);
    const bool none = removed[0] + removed[1] + points == 0;
    wt_log_action(log, none ? WT_WARNING : WT_NOTE, WT_LEFT_OUT, 0, "--exclude", NULL, NULL,
                  "left out by %s: %zu isotherms, %zu temperature sweeps, %zu points of others%s",
                  text, removed[0], removed[1], points, none ? "; nothing lies there" : "");
    free(drop);
    return WT_OK;
}

wt_status flow_exclusions_check(const char *const *texts, size_t n, wt_error *err)
{
    wt_status status = WT_OK;
    exclusion_range c;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = parse_exclusion(texts[i], &c, err);
    return status;
}

wt_status flow_sweep_exclude(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                             wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = apply_exclusion(texts[i], sweep, log, err);
    if (status == WT_OK && n > 0 && sweep->n_isotherms + sweep->n_ramps == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no isotherm is left");
        wt_error_place(err, "exclude");
        wt_error_advice(err, "leave out less");
    }
    return status;
}

/* ---- strain amplitude ------------------------------------------------------------------------ */

/* Two runs of one chamber agree within 1.5 K. Exports with four digits differ by 5e-4 in
 * frequency. Two amplitudes are different if their ratio exceeds 2, as in
 * dma/numerics/master_verdict.c. */
static const double chamber_tolerance = 1.5, frequency_tolerance = 1e-3, amplitude_ratio_limit = 2;

/* Amplitude of an isotherm or a temperature sweep (NaN if unmeasured) with its ranges of
 * temperature [K] and angular frequency [rad/s]. */
typedef struct sweep_entry {
    const char *source;
    bool is_ramp;
    double amplitude, temperature[2], frequency[2];
} sweep_entry;

/* Returns the geometric mean of the positive amplitudes, or NaN if there is none. */
static double mean_amplitude(const double *strain, size_t n)
{
    double sum = 0;
    size_t n_positive = 0;
    for (size_t i = 0; i < n && strain != NULL; i++)
        if (strain[i] > 0) {
            sum += log(strain[i]);
            n_positive++;
        }
    return n_positive > 0 ? exp(sum / (double)n_positive) : (double)NAN;
}

/* Lists the isotherms first, then the temperature sweeps. An entry without points overlaps no
 * other entry. */
static void list_sweep_entries(const wt_sweep *sweep, sweep_entry *entries)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *t = &sweep->isotherms[i];
        *entries++ =
            (sweep_entry){.source = t->source,
                          .amplitude = mean_amplitude(t->strain, t->n),
                          .temperature = {t->temperature, t->temperature},
                          .frequency = {t->n > 0 ? t->angular_frequency[0] : (double)NAN,
                                        t->n > 0 ? t->angular_frequency[t->n - 1] : (double)NAN}};
    }
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        const wt_ramp *r = &sweep->ramps[i];
        *entries++ =
            (sweep_entry){.source = r->source,
                          .is_ramp = true,
                          .amplitude = mean_amplitude(r->strain, r->n),
                          .temperature = {r->n > 0 ? r->temperature[0] : (double)NAN,
                                          r->n > 0 ? r->temperature[r->n - 1] : (double)NAN},
                          .frequency = {r->angular_frequency * (1 - frequency_tolerance),
                                        r->angular_frequency * (1 + frequency_tolerance)}};
    }
}

/* Returns true if both share temperatures and frequencies and differ in amplitude. */
static bool amplitudes_differ(const sweep_entry *a, const sweep_entry *b)
{
    const double ratio = a->amplitude / b->amplitude;
    return a->temperature[0] <= b->temperature[1] + chamber_tolerance &&
           b->temperature[0] <= a->temperature[1] + chamber_tolerance &&
           a->frequency[0] < b->frequency[1] && b->frequency[0] < a->frequency[1] &&
           (ratio > amplitude_ratio_limit || ratio < 1 / amplitude_ratio_limit);
}

static wt_status fail_mixed_amplitudes(const sweep_entry *a, const sweep_entry *b, wt_error *err)
{
    const double low = 100 * fmin(a->amplitude, b->amplitude),
                 high = 100 * fmax(a->amplitude, b->amplitude);
    const char *const sweep_kind = !a->is_ramp && !b->is_ramp ? "isotherms"
                                   : a->is_ramp && b->is_ramp ? "temperature sweeps"
                                                              : "isotherms and temperature sweeps";
    wt_fail(err, WT_E_AMBIGUOUS, "%s of several strain amplitudes at one temperature", sweep_kind);
    wt_error_place(err, "%s", a->source);
    wt_error_expected(err, "those of one amplitude, because a filled rubber softens with strain");
    wt_error_found(err, "%.3g %% and %.3g %% at %.1f degC", low, high,
                   fmax(a->temperature[0], b->temperature[0]) - WT_ZERO_CELSIUS);
    wt_error_advice(err, "choose one with --strain %.3g%%", low);
    wt_error_options(err, "strain");
    return WT_E_AMBIGUOUS;
}

static bool is_closer_to_target(const sweep_entry *a, const sweep_entry *b, double target)
{
    return fabs(log2(a->amplitude / target)) <= fabs(log2(b->amplitude / target));
}

/* Warns if the requested amplitude differs by more than a factor of 2 from every measured
 * amplitude. */
static void warn_unmatched_strain(const sweep_entry *entries, size_t n, double target, wt_log *log)
{
    const sweep_entry *nearest = NULL;
    for (size_t i = 0; i < n; i++)
        if (!isnan(entries[i].amplitude) &&
            (nearest == NULL || !is_closer_to_target(nearest, &entries[i], target)))
            nearest = &entries[i];
    if (n > 0 && nearest == NULL)
        wt_log_add(log, WT_WARNING, entries[0].source, NULL,
                   "sweeps of one strain are asked for, but no strain amplitude was read");
    else if (n > 0 && (nearest->amplitude / target > amplitude_ratio_limit ||
                       target / nearest->amplitude > amplitude_ratio_limit))
        wt_log_add(log, WT_WARNING, nearest->source, NULL,
                   "sweeps at a strain of %.3g %% are asked for; the nearest were measured "
                   "at %.3g %%",
                   100 * target, 100 * nearest->amplitude);
}

/* Removes the sweeps of other amplitudes and logs their numbers. */
static void remove_other_amplitudes(wt_sweep *sweep, const sweep_entry *entries, const bool *drop,
                                    wt_log *log)
{
    static const char *const kinds[] = {"isotherm", "temperature sweep"};
    const char *first[2] = {NULL, NULL};
    size_t removed[2] = {0, 0};
    for (size_t i = sweep->n_isotherms + sweep->n_ramps; i-- > 0;)
        if (drop[i]) {
            first[entries[i].is_ramp] = entries[i].source;
            removed[entries[i].is_ramp]++;
        }
    for (size_t k = 0; k < 2; k++)
        if (removed[k] > 0)
            wt_log_action(log, WT_WARNING, WT_LEFT_OUT, removed[k], "--strain", first[k], NULL,
                          "%zu %s%s of other strain amplitudes left out", removed[k], kinds[k],
                          removed[k] > 1 ? "s" : "");
    remove_sweeps(sweep, drop, removed);
}

wt_status flow_select_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                                wt_log *log, wt_error *err)
{
    const double target = n_sets > 0 ? sets[0].read.strain : (double)NAN;
    const size_t n = sweep->n_isotherms + sweep->n_ramps;
    sweep_entry *entries = wt_alloc(n, sizeof *entries);
    bool *drop = wt_alloc(n, sizeof *drop);
    wt_status status = WT_OK;
    list_sweep_entries(sweep, entries);
    for (size_t i = 0; i < n && status == WT_OK; i++)
        for (size_t k = i + 1; k < n && status == WT_OK; k++) {
            if (!amplitudes_differ(&entries[i], &entries[k]))
                continue;
            if (isnan(target))
                status = fail_mixed_amplitudes(&entries[i], &entries[k], err);
            else if (is_closer_to_target(&entries[i], &entries[k], target))
                drop[k] = true;
            else
                drop[i] = true;
        }
    if (status == WT_OK && !isnan(target))
        warn_unmatched_strain(entries, n, target, log);
    if (status == WT_OK)
        remove_other_amplitudes(sweep, entries, drop, log);
    free(drop);
    free(entries);
    return status;
}
