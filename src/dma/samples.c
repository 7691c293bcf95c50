/* Lists the samples of DMA sweeps and selects one of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"

#include "core/base/array.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char unnamed_label[] = "(without a name)";
/* Isotherms within 0.5 K have the same temperature. */
static const double same_temperature = 0.5;

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
            !(fabs(a->temperature - b->temperature) <= same_temperature) ||
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
    }
    wt_sample_names_clear(&samples);
    return status;
}
