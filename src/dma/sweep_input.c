/* Reads the sweeps of a job. Each file is read once in a run, and each stage gets a copy.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"
#include "job/conditioning.h"

#include "core/data/sweep_points.h"

#include <stdlib.h>
#include <string.h>

const char *flow_deformation_name(wt_deformation deformation)
{
    return deformation == WT_SHEAR ? "shear" : "tension";
}

static unsigned optional_arrays(sweep_points p)
{
    return (p.array[SWEEP_STRAIN] != NULL ? (unsigned)WT_SWEEP_HAS_STRAIN : 0) |
           (p.array[SWEEP_LOSS_FACTOR] != NULL ? (unsigned)WT_SWEEP_HAS_LOSS_FACTOR : 0) |
           (p.array[SWEEP_TEMPERATURE] != NULL ? (unsigned)WT_SWEEP_HAS_TEMPERATURE : 0);
}

/* Copies the arrays and the sample name. */
static void copy_points(sweep_points to, sweep_points from, char **sample)
{
    for (size_t j = 0; j < SWEEP_ARRAYS; j++)
        if (to.array[j] != NULL)
            memcpy(to.array[j], from.array[j], from.n * sizeof(double));
    *sample = from.sample != NULL ? wt_strdup(from.sample) : NULL;
}

static void copy_isotherm(wt_sweep *to, const wt_isotherm *s)
{
    const sweep_points from = isotherm_points(s);
    wt_isotherm *t = wt_sweep_add(to, s->n, optional_arrays(from));
    t->temperature = s->temperature;
    t->temperature_spread = s->temperature_spread;
    memcpy(t->source, s->source, sizeof t->source);
    copy_points(isotherm_points(t), from, &t->sample);
}

static void copy_ramp(wt_sweep *to, const wt_ramp *s)
{
    const sweep_points from = ramp_points(s);
    wt_ramp *t = wt_sweep_add_ramp(to, s->n, optional_arrays(from));
    t->angular_frequency = s->angular_frequency;
    memcpy(t->source, s->source, sizeof t->source);
    copy_points(ramp_points(t), from, &t->sample);
}

static void copy_strain_sweep(wt_sweep *to, const wt_strain_sweep *s)
{
    wt_strain_sweep *t = wt_sweep_add_strain_sweep(to, s->n);
    t->angular_frequency = s->angular_frequency;
    t->temperature = s->temperature;
    memcpy(t->source, s->source, sizeof t->source);
    copy_points(strain_sweep_points(t), strain_sweep_points(s), &t->sample);
}

/* Copies all sweeps to `to`, which must be empty. */
static void copy_sweep(wt_sweep *to, const wt_sweep *from)
{
    to->deformation = from->deformation;
    to->loading = from->loading;
    for (size_t i = 0; i < from->n_isotherms; i++)
        copy_isotherm(to, &from->isotherms[i]);
    for (size_t i = 0; i < from->n_ramps; i++)
        copy_ramp(to, &from->ramps[i]);
    for (size_t i = 0; i < from->n_strain_sweeps; i++)
        copy_strain_sweep(to, &from->strain_sweeps[i]);
}

static size_t count_sweeps(const wt_sweep *sweep)
{
    return sweep->n_isotherms + sweep->n_ramps + sweep->n_strain_sweeps;
}

/* All points of an isotherm count at its temperature. */
static void ignore_drift(wt_sweep *sweep)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        free(sweep->isotherms[i].point_temperature);
        sweep->isotherms[i].point_temperature = NULL;
    }
}

static wt_status read_sweeps(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                             wt_sweep *sweep, wt_error *err)
{
    if (work->dma != NULL && count_sweeps(work->dma) > 0) {
        copy_sweep(sweep, work->dma);
        return WT_OK;
    }
    flow_files files = {0};
    wt_status status = flow_files_list(sets, n_sets, work, &files, err);
    for (size_t i = 0; status == WT_OK && i < files.n; i++) {
        wt_input *input = NULL;
        wt_error failure = WT_ERROR_INIT;
        const wt_progress *progress = &work->progress;
        if (progress->report != NULL &&
            !progress->report(progress->user, "DMA file", i + 1, files.n)) {
            status = wt_fail(err, WT_E_CANCELLED, "cancelled");
            continue;
        }
        status = flow_open(work, &files.file[i], WT_ROLE_DMA, WT_KIND_SWEEP, &input, &failure);
        if (status == WT_OK) {
            const wt_read_options options = flow_read_options(&files.file[i]);
            status = wt_sweep_read(work->formats, input, &options, work->log, sweep, &failure);
        }
        wt_input_close(input);
        if (status != WT_OK)
            status = flow_skip_file(work, &files.file[i], &failure)
                         ? WT_OK
                         : wt_job_add_failure(work, files.file[i].name, status, &failure, err);
    }
    if (status == WT_OK && count_sweeps(sweep) == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no DMA sweep could be read");
        flow_error_add_files(&files, 0, err);
    }
    if (status == WT_OK) {
        wt_sweep_sort(sweep);
        if (n_sets > 0 && sets[0].read.conditioning == WT_CONDITIONING_KEEP)
            ignore_drift(sweep);
        else
            wt_sweep_remove_duplicates(sweep, work->log);
        check_sweep(sweep, work->log);
        if (work->dma != NULL)
            copy_sweep(work->dma, sweep);
    }
    flow_files_clear(&files);
    return status;
}

wt_status flow_sweeps_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                           wt_sweep *sweep, wt_error *err)
{
    const wt_status status = read_sweeps(sets, n_sets, work, sweep, err);
    return status == WT_OK && n_sets > 0 ? flow_select_sample(sweep, sets[0].read.sample, err)
                                         : status;
}

wt_status flow_require_oscillation(const wt_sweep *sweep, const char *what, wt_error *err)
{
    if (sweep->loading == WT_OSCILLATION)
        return WT_OK;
    wt_fail(err, WT_E_UNSUPPORTED, "%s needs an oscillation", what);
    wt_error_found(err, "isotherms of %s",
                   sweep->loading == WT_CREEP ? "creep" : "stress relaxation");
    wt_error_advice(err, "`weartrack master` makes storage and loss modulus of them");
    return WT_E_UNSUPPORTED;
}

wt_status wt_sample_names_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                               wt_sample_names *samples, wt_error *err)
{
    wt_sweep sweep = {0};
    *samples = (wt_sample_names){0, NULL};
    const wt_status status = flow_sweeps_read(sets, n_sets, work, &sweep, err);
    if (status == WT_OK)
        *samples = flow_samples_find(&sweep);
    wt_sweep_clear(&sweep);
    return status;
}
