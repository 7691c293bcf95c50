/* Comparison of dwell moduli with those of the DMA at the same frequency and temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"
#include "indentation/dwell.h"
#include "study/compare.h"

#include "core/base/clocale.h"
#include "core/base/param.h"
#include "core/math/normal_quantile.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>

/* Draws of the material for its errors, which are then known to 9 %. */
enum { DRAWS = 64 };

/* Moduli of the DMA at the frequencies of a group, with their variances. */
typedef struct dma_moduli {
    double storage, loss, storage_variance, loss_variance;
} dma_moduli;

/* Adds one replicate, or sets the fitted moduli. */
static wt_status add_draw(const wt_rubber *rubber, double temperature, const wt_job *work,
                          size_t replicate, const dwell_mean *at, size_t n, dma_moduli *to,
                          double frequencies[2], char statement[256], wt_error *err)
{
    wt_material *material = NULL;
    const wt_status status =
        wt_rubber_material(rubber, temperature, work->seed, replicate, &material, statement, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < n; i++) {
        double storage, loss;
        material->law->modulus(material, &at[i].angular_frequency, 1, &storage, &loss);
        if (replicate == WT_NO_REPLICATE) {
            to[i] = (dma_moduli){.storage = storage, .loss = loss};
            continue;
        }
        to[i].storage_variance += pow(storage - to[i].storage, 2) / DRAWS;
        to[i].loss_variance += pow(loss - to[i].loss, 2) / DRAWS;
    }
    if (frequencies != NULL) {
        frequencies[0] = material->frequency_min;
        frequencies[1] = material->frequency_max;
    }
    wt_material_free(material);
    return WT_OK;
}

static bool is_reached(const wt_rubber *rubber, double temperature)
{
    wt_error why = WT_ERROR_INIT;
    return temperature > 0 && flow_rubber_can_shift(rubber, temperature, &why);
}

/* Adds half of the difference between the limits of the temperature. Sets *lacks if no shift law
 * reaches a limit. */
static wt_status add_temperature_variance(const wt_rubber *rubber, wt_estimate at,
                                          const wt_job *work, const dwell_mean *means, size_t n,
                                          dma_moduli *to, bool *lacks, wt_error *err)
{
    const double ends[2] = {at.value - at.standard_error, at.value + at.standard_error};
    if (!(at.standard_error > 0))
        return WT_OK;
    if (!is_reached(rubber, ends[0]) || !is_reached(rubber, ends[1])) {
        *lacks = true;
        return WT_OK;
    }
    wt_status status = WT_OK;
    dma_moduli *end[2] = {wt_alloc(n, sizeof **end), wt_alloc(n, sizeof **end)};
    for (int i = 0; status == WT_OK && i < 2; i++)
        status =
            add_draw(rubber, ends[i], work, WT_NO_REPLICATE, means, n, end[i], NULL, NULL, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        to[i].storage_variance += pow((end[1][i].storage - end[0][i].storage) / 2, 2);
        to[i].loss_variance += pow((end[1][i].loss - end[0][i].loss) / 2, 2);
    }
    free(end[0]);
    free(end[1]);
    return status;
}

TABLE_ROW(dwell_dma, DWELL_DMA, const char *group; dwell_mean mean; double extrapolated;
          wt_estimate dma_storage, dma_loss; wt_interval storage_ratio, loss_ratio;)

TABLE_KEYS(dwell_dma, DWELL_DMA, wt_estimate temperature, track_temperature;
           const char *lacks, *material_statement, *track_statement;)

/* Interval of a ratio of two numbers with errors. */
static wt_interval ratio_interval(const wt_interval *of, double by, double compare_variances)
{
    const double value = of->value / by,
                 half = fabs(value) * hypot((of->high - of->value) / of->value,
                                            NORMAL_95 * sqrt(compare_variances) / by);
    return (wt_interval){value, (double)NAN, value - half, value + half};
}

static void add_dwell_dma_row(table_writer *t, int g, const dwell_mean *m, const dma_moduli *dma,
                              bool errors, bool outside)
{
    const double none = (double)NAN, unknown = errors ? 0 : none;
    const wt_interval no_ratio = {none, none, none, none};
    dwell_dma_row row = {compare_group_name[g], *m,       none,    {none, none, 0, NULL},
                         {none, none, 0, NULL}, no_ratio, no_ratio};
    if (dma != NULL) {
        row.extrapolated = outside;
        row.dma_storage.value = dma->storage;
        row.dma_storage.standard_error = sqrt(dma->storage_variance) + unknown;
        row.dma_loss.value = dma->loss;
        row.dma_loss.standard_error = sqrt(dma->loss_variance) + unknown;
        row.storage_ratio = ratio_interval(&m->storage, dma->storage, dma->storage_variance);
        row.loss_ratio = ratio_interval(&m->loss, dma->loss, dma->loss_variance);
    }
    dwell_dma_add_row(t, &row);
}

/* Adds the rows of a group at its temperature. */
static wt_status add_dwell_rows(table_writer *t, int g, const wt_table *moduli,
                                const wt_rubber *rubber, wt_estimate at, const wt_job *work,
                                char statement[256], bool *lacks, wt_error *err)
{
    const double temperature = at.value;
    dwell_mean *means = NULL;
    size_t n = 0;
    wt_error why = WT_ERROR_INIT;
    double measured[2] = {0, 0};
    wt_status status = dwell_means(moduli, &means, &n, err);
    dma_moduli *dma = wt_alloc(n, sizeof *dma);
    const bool reaches = flow_rubber_can_shift(rubber, temperature, &why);
    if (!reaches)
        clocale_print(statement, 256, "none at %.2f °C: %s", temperature - WT_ZERO_CELSIUS,
                      why.message);
    if (status == WT_OK && reaches)
        status = add_draw(rubber, temperature, work, WT_NO_REPLICATE, means, n, dma, measured,
                          statement, err);
    for (size_t i = 0; status == WT_OK && reaches && rubber->n_draws > 0 && i < DRAWS; i++)
        status = add_draw(rubber, temperature, work, i, means, n, dma, NULL, NULL, err);
    bool unknown = false;
    if (status == WT_OK && reaches)
        status = add_temperature_variance(rubber, at, work, means, n, dma, &unknown, err);
    *lacks = *lacks || unknown;
    for (size_t i = 0; status == WT_OK && i < n; i++)
        add_dwell_dma_row(
            t, g, &means[i], reaches ? &dma[i] : NULL, rubber->n_draws > 0 && !unknown,
            means[i].angular_frequency < measured[0] || means[i].angular_frequency > measured[1]);
    free(means);
    free(dma);
    return status;
}

wt_status wt_compare_dwells(const wt_compare_job *job, const wt_job *work, wt_table **table,
                            wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL || job->bulk == NULL || job->rubber == NULL)
        return wt_fail(err, WT_E_ARG, "no dwells, or no DMA to compare them with");
    wt_status status = param_check(wt_compare_job_params(), job, err);
    if (status != WT_OK)
        return status;
    const wt_table *given[2] = {job->bulk, job->track};
    bool lacks = false;
    char statement[2][256] = {"", ""};
    table_writer t = table_begin(&dwell_dma_schema, err);
    for (int g = 0; t.status == WT_OK && g < 2; g++)
        if (given[g] != NULL) {
            table_block(&t);
            t.status = add_dwell_rows(&t, g, given[g], job->rubber, compare_temperature(job, g),
                                      work, statement[g], &lacks, err);
        }
    const bool no_draws = job->rubber->n_draws == 0;
    wt_estimate track = compare_temperature(job, 1);
    if (job->track == NULL)
        track.value = (double)NAN;
    TABLE_SET(dwell_dma, &t, compare_temperature(job, 0), track,
              no_draws || lacks ? compare_missing_errors(no_draws, lacks) : NULL, statement[0],
              statement[1]);
    return table_end(&t, table);
}
