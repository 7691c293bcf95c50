/* The comparison job: wear track against bulk, all rates together and rate by rate; both against
 * the DMA modulus at the equivalent frequency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/draws.h"

#include "base/array.h"
#include "base/param.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Width of a rate bin [decade]: rates of one nominal piezo rate differ by less, since the softer
 * group indents a little faster. */
#define BIN_DECADES 0.5

static const char *const group_name[2] = {"bulk", "track"};

/* In the place of a bin: a curve whose rate is not known; the curves of all bins. */
#define NO_BIN SIZE_MAX
#define ALL_BINS SIZE_MAX

/* Geometric means over the curves of one bin of one group. */
typedef struct rate_point {
    size_t n;
    double rate, frequency;
    wt_group_summary summary;
} rate_point;

/* The two groups with the bin of every curve. */
typedef struct pair {
    wt_group_data data[2];
    bool present[2];
    size_t *bin[2]; /* [n]; NO_BIN = rate unknown */
    size_t n_bins;
    double *low, *high;   /* [n_bins] smallest and largest rate */
    rate_point *point[2]; /* [n_bins] */
    double *modulus;      /* scratch for a part of a group, one after the other */
    long *spot;
} pair;

static void pair_clear(pair *p)
{
    for (int g = 0; g < 2; g++) {
        wt_group_data_clear(&p->data[g]);
        free(p->bin[g]);
        free(p->point[g]);
    }
    free(p->low);
    free(p->high);
    free(p->modulus);
    free(p->spot);
}

/* Bins start at the lowest rate that is not in one yet, so a nominal rate is never cut in two by a
 * border that happens to lie in its scatter. */
static wt_status make_bins(pair *p, wt_error *err)
{
    size_t total = p->data[0].group.n + p->data[1].group.n, n = 0;
    double *rates = malloc((total + 1) * sizeof *rates);
    p->low = malloc((total + 1) * sizeof *p->low);
    p->high = malloc((total + 1) * sizeof *p->high);
    p->modulus = malloc((total + 1) * sizeof *p->modulus);
    p->spot = malloc((total + 1) * sizeof *p->spot);
    for (int g = 0; g < 2; g++)
        p->bin[g] = malloc((p->data[g].group.n + 1) * sizeof *p->bin[g]);
    if (rates == NULL || p->low == NULL || p->high == NULL || p->modulus == NULL ||
        p->spot == NULL || p->bin[0] == NULL || p->bin[1] == NULL) {
        free(rates);
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    for (int g = 0; g < 2; g++)
        for (size_t i = 0; i < p->data[g].group.n; i++)
            if (p->data[g].indentation_rate[i] > 0)
                rates[n++] = p->data[g].indentation_rate[i];
    numbers_sort(rates, n);
    for (size_t i = 0; i < n; i++) {
        if (p->n_bins == 0 || log10(rates[i] / p->low[p->n_bins - 1]) > BIN_DECADES)
            p->low[p->n_bins++] = rates[i];
        p->high[p->n_bins - 1] = rates[i];
    }
    for (int g = 0; g < 2; g++) {
        for (size_t i = 0; i < p->data[g].group.n; i++) {
            double rate = p->data[g].indentation_rate[i];
            p->bin[g][i] = NO_BIN;
            for (size_t b = 0; rate > 0 && b < p->n_bins; b++)
                if (rate >= p->low[b] && rate <= p->high[b])
                    p->bin[g][i] = b;
        }
    }
    free(rates);
    return WT_OK;
}

/* The part of a group that lies in a bin, copied to scratch from `offset` on. */
static wt_group part_of(const pair *p, int g, size_t bin, size_t offset)
{
    const wt_group_data *data = &p->data[g];
    wt_group part = {.modulus = p->modulus + offset,
                     .spot = data->group.spot == NULL ? NULL : p->spot + offset,
                     .n_rejected = bin == ALL_BINS ? data->group.n_rejected : 0};
    for (size_t i = 0; i < data->group.n; i++) {
        if (bin != ALL_BINS && p->bin[g][i] != bin)
            continue;
        p->modulus[offset + part.n] = data->modulus[i];
        p->spot[offset + part.n] = data->spot[i];
        part.n++;
    }
    return part;
}

/* ---- groups ---------------------------------------------------------------------------------- */

static void group_row(table_writer *t, const char *name, const wt_group *group)
{
    wt_group_summary s = {0};
    if (group->n > 0 && t->status == WT_OK)
        t->status = wt_group_summarise(group, &s, t->err);
    table_row(t);
    modulus_groups_put_text(t, MODULUS_GROUPS_GROUP, name);
    modulus_groups_put(t, MODULUS_GROUPS_N, (double)group->n);
    modulus_groups_put(t, MODULUS_GROUPS_N_REJECTED, (double)group->n_rejected);
    modulus_groups_put(t, MODULUS_GROUPS_N_SPOTS, (double)s.n_spots);
    if (group->n == 0)
        return;
    modulus_groups_put(t, MODULUS_GROUPS_MEAN, s.mean);
    modulus_groups_put(t, MODULUS_GROUPS_STANDARD_DEVIATION, s.standard_deviation);
    modulus_groups_put(t, MODULUS_GROUPS_MEDIAN, s.median);
    modulus_groups_put(t, MODULUS_GROUPS_GEOMETRIC_MEAN, s.geometric_mean);
    modulus_groups_put(t, MODULUS_GROUPS_LOW, s.low);
    modulus_groups_put(t, MODULUS_GROUPS_HIGH, s.high);
}

/* The name of the group of an indentation table. */
static const char *group_of(const wt_table *indentation)
{
    const char *name = wt_table_name(indentation);
    const size_t prefix = strlen(indentation_schema.name);
    return strncmp(name, indentation_schema.name, prefix) == 0 ? name + prefix : name;
}

wt_status wt_modulus_groups(const wt_table *const *indentation, size_t n, wt_table **result,
                            wt_error *err)
{
    if (result == NULL || (n > 0 && indentation == NULL))
        return wt_fail(err, WT_E_ARG, "no indentation tables");
    table_writer t = table_begin(&modulus_groups_schema, err);
    for (size_t i = 0; i < n; i++) {
        wt_group_data data = {0};
        if (t.status == WT_OK)
            t.status = wt_group_from_table(indentation[i], &data, err);
        group_row(&t, group_of(indentation[i]), &data.group);
        wt_group_data_clear(&data);
    }
    return table_end(&t, result);
}

/* Called bulk and track whatever their tables are called. */
static wt_status make_groups(const pair *p, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&modulus_groups_schema, err);
    for (int g = 0; g < 2; g++)
        if (p->present[g])
            group_row(&t, group_name[g], &p->data[g].group);
    return table_end(&t, table);
}

/* ---- comparison ------------------------------------------------------------------------------ */

/* One row of "comparison" before Holm's correction is known. */
typedef struct row {
    double low, high; /* rate; NaN = all */
    size_t n[2];
    bool valid;
    wt_comparison c;
    double holm;
} row;

/* Compares the parts of one bin; fewer than two units leaves the row without numbers. `by_curve`
 * drops the spots. */
static wt_status compare_part(pair *p, size_t bin, bool by_curve, row *r, wt_error *err)
{
    wt_group bulk = part_of(p, 0, bin, 0), track = part_of(p, 1, bin, bulk.n);
    if (by_curve)
        bulk.spot = track.spot = NULL;
    r->n[0] = bulk.n;
    r->n[1] = track.n;
    r->low = bin == ALL_BINS ? (double)NAN : p->low[bin];
    r->high = bin == ALL_BINS ? (double)NAN : p->high[bin];
    r->holm = (double)NAN;
    wt_error ignored = WT_ERROR_INIT;
    wt_status status = wt_compare(&bulk, &track, &r->c, &ignored);
    r->valid = status == WT_OK;
    /* without enough units, or at one rate without scatter, the row stays without numbers */
    if (status == WT_OK || status == WT_E_EMPTY || (status == WT_E_RANGE && bin != ALL_BINS))
        return WT_OK;
    if (err != NULL)
        *err = ignored;
    return status;
}

static void add_rows(table_writer *t, const row *rows, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const wt_comparison *c = &rows[i].c;
        table_row(t);
        comparison_put(t, COMPARISON_RATE_LOW, rows[i].low);
        comparison_put(t, COMPARISON_RATE_HIGH, rows[i].high);
        comparison_put(t, COMPARISON_N_BULK, (double)rows[i].n[0]);
        comparison_put(t, COMPARISON_N_TRACK, (double)rows[i].n[1]);
        if (!rows[i].valid)
            continue;
        comparison_put(t, COMPARISON_RATIO, c->ratio);
        comparison_put(t, COMPARISON_RATIO_LOW, c->ratio_low);
        comparison_put(t, COMPARISON_RATIO_HIGH, c->ratio_high);
        comparison_put(t, COMPARISON_DIFFERENCE, c->difference.value);
        comparison_put(t, COMPARISON_WELCH_T, c->welch_t);
        comparison_put(t, COMPARISON_WELCH_DF, c->welch_df);
        comparison_put(t, COMPARISON_WELCH_P, c->welch_p);
        comparison_put(t, COMPARISON_HOLM_P, rows[i].holm);
        comparison_put(t, COMPARISON_MANN_WHITNEY_P, c->mann_whitney_p);
        comparison_put(t, COMPARISON_EFFECT_SIZE, c->effect_size);
    }
}

static wt_status holm_rows(row *rows, size_t n, wt_error *err)
{
    double *p = malloc((2 * n + 1) * sizeof *p);
    size_t m = 0;
    if (p == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++)
        if (rows[i].valid)
            p[m++] = rows[i].c.welch_p;
    wt_holm(p, m, p + n);
    m = 0;
    for (size_t i = 0; i < n; i++)
        if (rows[i].valid)
            rows[i].holm = p[n + m++];
    free(p);
    return WT_OK;
}

static void set_comparison_keys(table_writer *t, const pair *p, const row *all, bool by_curve)
{
    const char *unit = "curve: no spots in the tables";
    if (by_curve)
        unit = "curve: fewer than two spots in a group; curves of one spot are not independent, so "
               "the interval is too narrow";
    else if (all->valid && all->c.by_spot)
        unit = p->data[0].spots_given && p->data[1].spots_given
                   ? "spot"
                   : "spot, as taken from files or positions because none were named";
    comparison_set_text(t, COMPARISON_KEY_UNIT_OF_ANALYSIS, unit);
    if (all->valid)
        comparison_set_value(t, COMPARISON_KEY_MODULUS_RATIO, all->c.ratio,
                             all->c.ratio * all->c.log_ratio.standard_error, 0);
}

/* All rates together in the first row, then rate by rate. */
static wt_status compare_rows(pair *p, row *rows, size_t n_bins, bool *by_curve, wt_error *err)
{
    wt_status status = compare_part(p, ALL_BINS, false, &rows[0], err);
    *by_curve = status == WT_OK && !rows[0].valid;
    if (*by_curve)
        status = compare_part(p, ALL_BINS, true, &rows[0], err);
    for (size_t b = 0; status == WT_OK && b < n_bins; b++)
        status = compare_part(p, b, *by_curve, &rows[b + 1], err);
    if (status == WT_OK)
        status = holm_rows(rows + 1, n_bins, err);
    if (status == WT_OK && !rows[0].valid) {
        status = wt_fail(err, WT_E_EMPTY, "too few accepted curves to compare");
        wt_error_expected(err, "two or more in each group");
        wt_error_found(err, "bulk %zu, track %zu", rows[0].n[0], rows[0].n[1]);
        wt_error_advice(err, "the column reason of the indentation tables says why curves were "
                             "rejected");
    }
    return status;
}

static wt_status make_comparison(pair *p, bool rates, const wt_job *work, wt_table **table,
                                 wt_error *err)
{
    size_t n_bins = rates ? p->n_bins : 0;
    bool by_curve = false;
    row *rows = calloc(n_bins + 1, sizeof *rows);
    if (rows == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = compare_rows(p, rows, n_bins, &by_curve, err);
    for (size_t b = 1; status == WT_OK && b <= n_bins; b++)
        if ((rows[b].n[0] == 0) != (rows[b].n[1] == 0))
            wt_parselog_add(work->log, WT_WARNING, NULL, NULL,
                            "curves at %.3g to %.3g m/s are in one group only (bulk %zu, track "
                            "%zu); the comparison over all rates includes them",
                            rows[b].low, rows[b].high, rows[b].n[0], rows[b].n[1]);
    if (status == WT_OK) {
        table_writer t = table_begin(&comparison_schema, err);
        add_rows(&t, rows, n_bins + 1);
        set_comparison_keys(&t, p, &rows[0], by_curve);
        status = table_end(&t, table);
    }
    free(rows);
    return status;
}

/* ---- against rate and against DMA ------------------------------------------------------------ */

static wt_status point_of(pair *p, int g, size_t bin, rate_point *point, wt_error *err)
{
    wt_group part = part_of(p, g, bin, 0);
    double log_rate = 0, log_frequency = 0;
    point->n = part.n;
    if (part.n == 0)
        return WT_OK;
    for (size_t i = 0; i < p->data[g].group.n; i++) {
        if (p->bin[g][i] != bin)
            continue;
        log_rate += log(p->data[g].indentation_rate[i]);
        log_frequency += log(p->data[g].equivalent_frequency[i]);
    }
    point->rate = exp(log_rate / (double)part.n);
    point->frequency = exp(log_frequency / (double)part.n);
    return wt_group_summarise(&part, &point->summary, err);
}

static wt_status make_points(pair *p, wt_error *err)
{
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        p->point[g] = calloc(p->n_bins, sizeof *p->point[g]);
        if (p->point[g] == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        for (size_t b = 0; status == WT_OK && b < p->n_bins; b++)
            status = point_of(p, g, b, &p->point[g][b], err);
    }
    return status;
}

static void rate_row(table_writer *t, int g, const rate_point *point)
{
    table_row(t);
    modulus_rate_put_text(t, MODULUS_RATE_GROUP, group_name[g]);
    modulus_rate_put(t, MODULUS_RATE_RATE, point->rate);
    modulus_rate_put(t, MODULUS_RATE_EQUIVALENT_FREQUENCY, point->frequency);
    modulus_rate_put(t, MODULUS_RATE_N, (double)point->n);
    modulus_rate_put(t, MODULUS_RATE_GEOMETRIC_MEAN, point->summary.geometric_mean);
    modulus_rate_put(t, MODULUS_RATE_LOW, point->summary.low);
    modulus_rate_put(t, MODULUS_RATE_HIGH, point->summary.high);
}

static void dma_row(table_writer *t, int g, const rate_point *point, const wt_material *material)
{
    double storage = (double)NAN, loss = (double)NAN;
    table_row(t);
    dma_comparison_put_text(t, DMA_COMPARISON_GROUP, group_name[g]);
    dma_comparison_put(t, DMA_COMPARISON_EQUIVALENT_FREQUENCY, point->frequency);
    dma_comparison_put(t, DMA_COMPARISON_MODULUS, point->summary.geometric_mean);
    dma_comparison_put(t, DMA_COMPARISON_LOW, point->summary.low);
    dma_comparison_put(t, DMA_COMPARISON_HIGH, point->summary.high);
    if (!(point->frequency > 0))
        return;
    material->law->modulus(material, &point->frequency, 1, &storage, &loss);
    bool outside =
        point->frequency < material->frequency_min || point->frequency > material->frequency_max;
    dma_comparison_put(t, DMA_COMPARISON_STORAGE_MODULUS, storage);
    dma_comparison_put(t, DMA_COMPARISON_COMPLEX_MODULUS, hypot(storage, loss));
    dma_comparison_put(t, DMA_COMPARISON_RATIO,
                       point->summary.geometric_mean / hypot(storage, loss));
    dma_comparison_put(t, DMA_COMPARISON_EXTRAPOLATED, outside);
}

/* A block for each group. */
static wt_status make_rate_table(const pair *p, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&modulus_rate_schema, err);
    for (int g = 0; g < 2; g++) {
        table_block(&t);
        for (size_t b = 0; b < p->n_bins; b++)
            if (p->point[g][b].n > 0)
                rate_row(&t, g, &p->point[g][b]);
    }
    return table_end(&t, table);
}

static wt_status make_dma_table(const pair *p, const wt_compare_job *job, const wt_job *work,
                                wt_table **table, wt_error *err)
{
    wt_material *material = NULL;
    char statement[256] = "";
    const double temperature =
        isnan(job->temperature) ? job->rubber->prony.reference_temperature : job->temperature;
    wt_status status = wt_rubber_at(job->rubber, job->temperature, work->seed, WT_NO_REPLICATE,
                                    &material, statement, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&dma_comparison_schema, err);
    for (int g = 0; g < 2; g++)
        for (size_t b = 0; b < p->n_bins; b++)
            if (p->point[g][b].n > 0)
                dma_row(&t, g, &p->point[g][b], material);
    dma_comparison_set_value(&t, DMA_COMPARISON_KEY_TEMPERATURE, temperature, 0, 0);
    dma_comparison_set_text(&t, DMA_COMPARISON_KEY_RATIO_OF,
                            "indentation modulus over |E*| of the DMA");
    if (statement[0] != '\0')
        dma_comparison_set_text(&t, DMA_COMPARISON_KEY_MATERIAL_STATEMENT, statement);
    wt_material_free(material);
    return table_end(&t, table);
}

wt_compare_job wt_compare_job_defaults(void)
{
    return (wt_compare_job){.temperature = (double)NAN, .rates = true};
}

static const wt_param rows[] = {
    {PARAM("indentation-temperature", wt_compare_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "the reference temperature of the DMA",
     .help = "at which the sample was indented, such as 23degC; for the comparison with DMA"},
};
PARAM_TABLE(wt_compare_job_params, wt_compare_job, rows, wt_compare_job_defaults, NO_PARTS)

wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *work,
                            wt_compare_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || (job->bulk == NULL && job->track == NULL))
        return wt_fail(err, WT_E_ARG, "nothing to compare");
    const wt_table *given[2] = {job->bulk, job->track};
    pair p = {0};
    wt_compare_tables t = {0};
    wt_status status = param_check(wt_compare_job_params(), job, err);
    for (int g = 0; status == WT_OK && g < 2; g++) {
        p.present[g] = given[g] != NULL;
        if (p.present[g])
            status = wt_group_from_table(given[g], &p.data[g], err);
    }
    if (status == WT_OK)
        status = make_groups(&p, &t.modulus_groups, err);
    if (status == WT_OK)
        status = make_bins(&p, err);
    if (status == WT_OK && p.present[0] && p.present[1] && !job->groups_only)
        status = make_comparison(&p, job->rates, work, &t.comparison, err);
    if (job->rates && p.n_bins > 0) {
        if (status == WT_OK)
            status = make_points(&p, err);
        if (status == WT_OK)
            status = make_rate_table(&p, &t.modulus_rate, err);
        if (status == WT_OK && job->rubber != NULL)
            status = make_dma_table(&p, job, work, &t.dma_comparison, err);
    }
    if (status == WT_OK) {
        *tables = t;
        t = (wt_compare_tables){0};
    }
    wt_compare_tables_clear(&t);
    pair_clear(&p);
    return status;
}

void wt_compare_tables_clear(wt_compare_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->modulus_groups);
    wt_table_free(tables->comparison);
    wt_table_free(tables->modulus_rate);
    wt_table_free(tables->dma_comparison);
    *tables = (wt_compare_tables){0};
}
