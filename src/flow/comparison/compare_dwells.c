/* Moduli of dwells against those of the DMA, at the same frequency and temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/comparison/compare.h"
#include "flow/dwell/dwell.h"
#include "flow/materials/rubber.h"
#include "flow/work/inputs.h"

#include "base/clocale.h"
#include "base/normal.h"
#include "base/param.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>

/* Draws of the material behind its errors, which are good to 9 % then. */
enum { DRAWS = 64 };

/* Of the DMA at the frequencies of a group: values and variances. */
typedef struct dma_moduli {
    double storage, loss, storage_variance, loss_variance;
} dma_moduli;

/* Of one replicate, or as fitted. */
static wt_status add_draw(const wt_rubber *rubber, double temperature, const wt_job *work,
                          size_t replicate, const dwell_mean *at, size_t n, dma_moduli *to,
                          double frequencies[2], char statement[256], wt_error *err)
{
    wt_material *material = NULL;
    const wt_status status =
        wt_rubber_at(rubber, temperature, work->seed, replicate, &material, statement, err);
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
    return temperature > 0 && flow_rubber_reaches(rubber, temperature, &why);
}

/* Adds half of what lies between both ends of the error of the temperature; *lacks where no law
 * takes the DMA to one of them. */
static wt_status add_temperature(const wt_rubber *rubber, wt_estimate at, const wt_job *work,
                                 const dwell_mean *means, size_t n, dma_moduli *to, bool *lacks,
                                 wt_error *err)
{
    const double ends[2] = {at.value - at.standard_error, at.value + at.standard_error};
    if (!(at.standard_error > 0))
        return WT_OK;
    if (!is_reached(rubber, ends[0]) || !is_reached(rubber, ends[1])) {
        *lacks = true;
        return WT_OK;
    }
    wt_status status = WT_OK;
    dma_moduli *end[2] = {calloc(n + 1, sizeof **end), calloc(n + 1, sizeof **end)};
    if (end[0] == NULL || end[1] == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory for the moduli of the DMA");
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

/* The interval of a ratio of two numbers with errors. */
static void put_ratio(table_writer *t, dwell_dma_column ratio, dwell_dma_column low,
                      dwell_dma_column high, const wt_interval *of, double by, double by_variance)
{
    const double value = of->value / by,
                 half = fabs(value) * hypot((of->high - of->value) / of->value,
                                            NORMAL_95 * sqrt(by_variance) / by);
    dwell_dma_put(t, ratio, value);
    dwell_dma_put(t, low, value - half);
    dwell_dma_put(t, high, value + half);
}

static void put_row(table_writer *t, int g, const dwell_mean *m, const dma_moduli *dma, bool errors,
                    bool outside)
{
    table_row(t);
    dwell_dma_put_text(t, DWELL_DMA_GROUP, compare_group_name[g]);
    dwell_dma_put(t, DWELL_DMA_ANGULAR_FREQUENCY, m->angular_frequency);
    dwell_dma_put(t, DWELL_DMA_N, (double)m->n);
    dwell_dma_put(t, DWELL_DMA_STORAGE, m->storage.value);
    dwell_dma_put(t, DWELL_DMA_STORAGE_LOW, m->storage.low);
    dwell_dma_put(t, DWELL_DMA_STORAGE_HIGH, m->storage.high);
    dwell_dma_put(t, DWELL_DMA_LOSS, m->loss.value);
    dwell_dma_put(t, DWELL_DMA_LOSS_LOW, m->loss.low);
    dwell_dma_put(t, DWELL_DMA_LOSS_HIGH, m->loss.high);
    if (dma == NULL)
        return;
    const double unknown = errors ? 0 : (double)NAN;
    dwell_dma_put(t, DWELL_DMA_DMA_STORAGE, dma->storage);
    dwell_dma_put(t, DWELL_DMA_DMA_STORAGE_STANDARD_ERROR, sqrt(dma->storage_variance) + unknown);
    dwell_dma_put(t, DWELL_DMA_DMA_LOSS, dma->loss);
    dwell_dma_put(t, DWELL_DMA_DMA_LOSS_STANDARD_ERROR, sqrt(dma->loss_variance) + unknown);
    put_ratio(t, DWELL_DMA_STORAGE_RATIO, DWELL_DMA_STORAGE_RATIO_LOW, DWELL_DMA_STORAGE_RATIO_HIGH,
              &m->storage, dma->storage, dma->storage_variance);
    put_ratio(t, DWELL_DMA_LOSS_RATIO, DWELL_DMA_LOSS_RATIO_LOW, DWELL_DMA_LOSS_RATIO_HIGH,
              &m->loss, dma->loss, dma->loss_variance);
    dwell_dma_put(t, DWELL_DMA_EXTRAPOLATED, outside);
}

/* The rows of a group, at its temperature. */
static wt_status put_group(table_writer *t, int g, const wt_table *moduli, const wt_rubber *rubber,
                           wt_estimate at, const wt_job *work, char statement[256], bool *lacks,
                           wt_error *err)
{
    const double temperature = at.value;
    dwell_mean *means = NULL;
    size_t n = 0;
    wt_error why = WT_ERROR_INIT;
    double measured[2] = {0, 0};
    wt_status status = dwell_means(moduli, &means, &n, err);
    dma_moduli *dma = calloc(n + 1, sizeof *dma);
    if (status == WT_OK && dma == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory for the moduli of the DMA");
    const bool reaches = flow_rubber_reaches(rubber, temperature, &why);
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
        status = add_temperature(rubber, at, work, means, n, dma, &unknown, err);
    *lacks = *lacks || unknown;
    for (size_t i = 0; status == WT_OK && i < n; i++)
        put_row(t, g, &means[i], reaches ? &dma[i] : NULL, rubber->n_draws > 0 && !unknown,
                means[i].angular_frequency < measured[0] ||
                    means[i].angular_frequency > measured[1]);
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
            t.status = put_group(&t, g, given[g], job->rubber, compare_temperature(job, g), work,
                                 statement[g], &lacks, err);
        }
    dwell_dma_set(&t, DWELL_DMA_KEY_TEMPERATURE, compare_temperature(job, 0));
    if (job->track != NULL)
        dwell_dma_set(&t, DWELL_DMA_KEY_TRACK_TEMPERATURE, compare_temperature(job, 1));
    if (job->rubber->n_draws == 0 || lacks)
        dwell_dma_set_text(&t, DWELL_DMA_KEY_ERROR_LACKS,
                           compare_lacks(job->rubber->n_draws == 0, lacks));
    if (statement[0][0] != '\0')
        dwell_dma_set_text(&t, DWELL_DMA_KEY_MATERIAL_STATEMENT, statement[0]);
    if (statement[1][0] != '\0')
        dwell_dma_set_text(&t, DWELL_DMA_KEY_TRACK_STATEMENT, statement[1]);
    return table_end(&t, table);
}
