/* weartrack master of several samples: a master curve for each, and their comparison.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/master.h"

#include <string.h>

enum { TABLES = 7, NAME_SIZE = 48 };

typedef struct sample_fit {
    wt_master_tables tables;
    wt_table *named[TABLES]; /* owned after renaming */
    wt_rubber rubber;
    char name[NAME_SIZE]; /* suffix of its tables */
    bool fitted;
} sample_fit;

static bool is_duplicate_name(const sample_fit *fits, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (strcmp(fits[k].name, fits[i].name) == 0)
            return true;
    return false;
}

/* Sets a suffix with the characters allowed in table names; a duplicate has a number appended. */
static void set_table_suffix(sample_fit *fits, size_t i, const char *sample)
{
    char *const name = fits[i].name;
    size_t n = 0;
    for (; *sample != '\0' && n < NAME_SIZE - 8; sample++) {
        const char c = *sample >= 'A' && *sample <= 'Z' ? (char)(*sample - 'A' + 'a') : *sample;
        const bool good = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (good || (n > 0 && name[n - 1] != '_'))
            name[n++] = good ? c : '_';
    }
    while (n > 0 && name[n - 1] == '_')
        n--;
    if (n == 0)
        n = (size_t)snprintf(name, NAME_SIZE, "unnamed");
    name[n] = '\0';
    for (size_t number = 2; is_duplicate_name(fits, i); number++)
        snprintf(name + n, NAME_SIZE - n, "_%zu", number);
}

static const char *display_name(const char *sample)
{
    return sample[0] != '\0' ? sample : "sweeps without a sample";
}

static wt_status rename_sample_tables(sample_fit *f, wt_error *err)
{
    wt_table **const made[TABLES] = {
        &f->tables.prony,         &f->tables.prony_reduced, &f->tables.relaxation_spectrum,
        &f->tables.shift_factors, &f->tables.master_curve,  &f->tables.material_draws,
        &f->tables.series_draws};
    wt_status status = WT_OK;
    for (size_t k = 0; k < TABLES && status == WT_OK; k++) {
        char name[NAME_SIZE + 32];
        if (*made[k] == NULL)
            continue;
        snprintf(name, sizeof name, "%s/%s", wt_table_name(*made[k]), f->name);
        status = wt_table_rename(*made[k], name, err);
        f->named[k] = *made[k];
        *made[k] = NULL;
    }
    return status;
}

static wt_status fit_sample(cmd_session *s, wt_master_job *job, wt_file_set *set,
                            const char *sample, sample_fit *f)
{
    wt_log *const log = wt_log_new();
    wt_error failure = WT_ERROR_INIT;
    wt_job work = s->work;
    set->read.sample = sample;
    work.log = log;
    wt_status status = wt_master_compute(job, &work, &f->tables, NULL, &failure);
    if (status == WT_OK && f->tables.prony != NULL) {
        const wt_rubber_tables of = {.prony = f->tables.prony,
                                     .shift_factors = f->tables.shift_factors,
                                     .material_draws = f->tables.material_draws,
                                     .series_draws = f->tables.series_draws};
        status = wt_rubber_from_tables(&of, job->poisson_ratio, &f->rubber, &failure);
    }
    f->fitted = status == WT_OK;
    wt_log_append(s->work.log, log, display_name(sample));
    wt_log_free(log);
    return status == WT_OK
               ? WT_OK
               : wt_job_add_failure(&s->work, display_name(sample), status, &failure, &s->err);
}

/* Fits each sample. One that cannot be fitted is listed as a failure; it is an error only if no
 * sample can. */
static wt_status fit_all_samples(cmd_session *s, wt_master_job *job, wt_file_set *set,
                                 const wt_sample_names *samples, sample_fit *fits)
{
    size_t n_fitted = 0;
    for (size_t i = 0; i < samples->n; i++) {
        const wt_status status = fit_sample(s, job, set, samples->name[i], &fits[i]);
        if (status != WT_OK)
            return status;
        set_table_suffix(fits, i, samples->name[i]);
        n_fitted += fits[i].fitted;
    }
    return n_fitted > 0 ? WT_OK : wt_fail(&s->err, WT_E_EMPTY, "no sample has a master curve");
}

/* Compares the samples that have a series; a warning states if they have no common range. */
static void compare_samples(cmd_session *s, const wt_sample_names *samples, const sample_fit *fits,
                            wt_compared_material *of, wt_materials_tables *tables)
{
    wt_error failure = WT_ERROR_INIT;
    wt_materials_job job = wt_materials_job_defaults();
    char message[1024];
    for (size_t i = 0; i < samples->n; i++)
        if (fits[i].tables.prony != NULL)
            of[job.n_materials++] =
                (wt_compared_material){.name = display_name(samples->name[i]),
                                       .rubber = &fits[i].rubber,
                                       .shift_factors = fits[i].tables.shift_factors};
    job.materials = of;
    if (job.n_materials < 2 || wt_compare_materials(&job, &s->work, tables, &failure) == WT_OK)
        return;
    (void)wt_error_format(&failure, message, sizeof message);
    wt_log_add(s->work.log, WT_WARNING, NULL, NULL, "not compared: %s", message);
}

/* Fits a shared law if requested; a failure is listed like that of a sample. */
static wt_status fit_common_law(cmd_session *s, wt_shared_shift_law_job *job,
                                const wt_sample_names *samples, const sample_fit *fits,
                                wt_table **table)
{
    wt_error failure = WT_ERROR_INIT;
    if (job->common == WT_SHARED_LAW_NONE)
        return WT_OK;
    const char **names = wt_alloc(samples->n, sizeof *names);
    const wt_master **of = wt_alloc(samples->n, sizeof *of);
    for (size_t i = 0; i < samples->n; i++) {
        names[i] = display_name(samples->name[i]);
        of[i] = fits[i].tables.fit;
    }
    job->names = names;
    job->fits = of;
    job->n = samples->n;
    const wt_status status = wt_shared_shift_law_compute(job, table, &failure);
    free(names);
    free(of);
    return status == WT_OK
               ? WT_OK
               : wt_job_add_failure(&s->work, "shared shift law", status, &failure, &s->err);
}

void fit_sample_masters(cmd_session *s, wt_master_job *job, wt_shared_shift_law_job *common,
                        wt_file_set *set, const wt_sample_names *samples)
{
    wt_materials_tables materials = {0};
    wt_table *common_law = NULL;
    sample_fit *fits = wt_alloc(samples->n, sizeof *fits);
    wt_compared_material *of = wt_alloc(samples->n, sizeof *of);
    wt_table ***made_tables = wt_alloc(samples->n * TABLES + 3, sizeof *made_tables);
    const char *const chosen = set->read.sample;
    size_t n = 0;
    wt_status status = fit_all_samples(s, job, set, samples, fits);
    set->read.sample = chosen;
    if (status == WT_OK)
        compare_samples(s, samples, fits, of, &materials);
    common->reference = job->fit.reference_temperature;
    if (status == WT_OK)
        status = fit_common_law(s, common, samples, fits, &common_law);
    for (size_t i = 0; status == WT_OK && i < samples->n; i++) {
        status = rename_sample_tables(&fits[i], &s->err);
        for (size_t k = 0; k < TABLES; k++)
            made_tables[n++] = &fits[i].named[k];
    }
    if (status == WT_OK) {
        made_tables[n++] = &materials.material_ratio;
        made_tables[n++] = &materials.materials;
        made_tables[n++] = &common_law;
    }
    cmd_finish(s, status, made_tables, n);
    for (size_t i = 0; i < samples->n; i++) {
        wt_master_tables_clear(&fits[i].tables);
        wt_rubber_clear(&fits[i].rubber);
        for (size_t k = 0; k < TABLES; k++)
            wt_table_free(fits[i].named[k]);
    }
    wt_materials_tables_clear(&materials);
    wt_table_free(common_law);
    free(made_tables);
    free(of);
    free(fits);
}
