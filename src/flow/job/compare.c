/* The comparison job: wear track against bulk, all rates together and rate by rate; both against
 * the DMA modulus at the equivalent frequency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/param.h"
#include "flow/job/tables.h"
#include "weartrack/flow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Width of a rate bin [decade]: rates of one nominal piezo rate differ by less, since the softer
 * group indents a little faster. */
#define BIN_DECADES 0.5

static const char *const group_name[2] = {"bulk", "track"};

/* The two groups with the bin of every curve. */
typedef struct pair {
    wt_group_data data[2];
    bool present[2];
    size_t *bin[2]; /* [n]; SIZE_MAX = rate unknown */
    size_t n_bins;
    double *low, *high; /* [n_bins] smallest and largest rate */
    double *modulus;    /* scratch for a part of a group, one after the other */
    long *spot;
} pair;

static void pair_clear(pair *p)
{
    for (int g = 0; g < 2; g++) {
        wt_group_data_clear(&p->data[g]);
        free(p->bin[g]);
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
    flow_sort(rates, n);
    for (size_t i = 0; i < n; i++) {
        if (p->n_bins == 0 || log10(rates[i] / p->low[p->n_bins - 1]) > BIN_DECADES)
            p->low[p->n_bins++] = rates[i];
        p->high[p->n_bins - 1] = rates[i];
    }
    for (int g = 0; g < 2; g++) {
        for (size_t i = 0; i < p->data[g].group.n; i++) {
            double rate = p->data[g].indentation_rate[i];
            p->bin[g][i] = SIZE_MAX;
            for (size_t b = 0; rate > 0 && b < p->n_bins; b++)
                if (rate >= p->low[b] && rate <= p->high[b])
                    p->bin[g][i] = b;
        }
    }
    free(rates);
    return WT_OK;
}

/* The part of a group that lies in a bin, copied to scratch from `offset` on; SIZE_MAX = all. */
static wt_group part_of(const pair *p, int g, size_t bin, size_t offset)
{
    const wt_group_data *data = &p->data[g];
    wt_group part = {.modulus = p->modulus + offset,
                     .spot = data->group.spot == NULL ? NULL : p->spot + offset,
                     .n_rejected = bin == SIZE_MAX ? data->group.n_rejected : 0};
    for (size_t i = 0; i < data->group.n; i++) {
        if (bin != SIZE_MAX && p->bin[g][i] != bin)
            continue;
        p->modulus[offset + part.n] = data->modulus[i];
        p->spot[offset + part.n] = data->spot[i];
        part.n++;
    }
    return part;
}

/* ---- groups -----------------------------------------------------------------------------------
 */

static wt_status group_row(wt_table *table, const char *name, const wt_group *group, wt_error *err)
{
    enum { GROUP, N, N_REJECTED, N_SPOTS, MEAN, SD, MEDIAN, GEOMETRIC, LOW, HIGH };
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, GROUP, name, err);
    if (status != WT_OK)
        return status;
    wt_table_put(table, N, (double)group->n);
    wt_table_put(table, N_REJECTED, (double)group->n_rejected);
    wt_table_put(table, N_SPOTS, 0);
    if (group->n == 0)
        return WT_OK;
    wt_group_summary s;
    status = wt_group_summarise(group, &s, err);
    if (status != WT_OK)
        return status;
    wt_table_put(table, N_SPOTS, (double)s.n_spots);
    wt_table_put(table, MEAN, s.mean);
    wt_table_put(table, SD, s.standard_deviation);
    wt_table_put(table, MEDIAN, s.median);
    wt_table_put(table, GEOMETRIC, s.geometric_mean);
    wt_table_put(table, LOW, s.low);
    wt_table_put(table, HIGH, s.high);
    return WT_OK;
}

/* names NULL: those of the tables. */
static wt_status groups_table(const wt_table *const *indentation, const char *const *names,
                              size_t n, wt_table **result, wt_error *err)
{
    static const flow_column columns[] = {
        {"group", NULL, "group of curves"},
        {"n", "1", "accepted curves"},
        {"n_rejected", "1", "rejected curves"},
        {"n_spots", "1", "places on the sample"},
        {"mean", "Pa", "mean modulus of the curves"},
        {"standard_deviation", "Pa", "standard deviation of the curves"},
        {"median", "Pa", "median modulus of the curves"},
        {"geometric_mean", "Pa", "geometric mean of the spots"},
        {"low", "Pa", "lower end of its 95 % interval"},
        {"high", "Pa", "upper end of its 95 % interval"},
    };
    wt_table *table = NULL;
    wt_status status = flow_table_new("modulus_groups", "Modulus of the groups", columns,
                                      FLOW_COUNT(columns), &table, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        wt_group_data data = {0};
        status = wt_group_from_table(indentation[i], &data, err);
        if (status == WT_OK) {
            const char *name = names != NULL ? names[i] : wt_table_name(indentation[i]);
            name = strncmp(name, "indentation/", 12) == 0 ? name + 12 : name;
            status = group_row(table, name, &data.group, err);
        }
        wt_group_data_clear(&data);
    }
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *result = table;
    return WT_OK;
}

wt_status wt_modulus_groups(const wt_table *const *indentation, size_t n, wt_table **result,
                            wt_error *err)
{
    if (result == NULL || (n > 0 && indentation == NULL))
        return wt_fail(err, WT_E_ARG, "no indentation tables");
    return groups_table(indentation, NULL, n, result, err);
}

/* ---- comparison -------------------------------------------------------------------------------
 */

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
    r->low = bin == SIZE_MAX ? (double)NAN : p->low[bin];
    r->high = bin == SIZE_MAX ? (double)NAN : p->high[bin];
    r->holm = (double)NAN;
    wt_error ignored = WT_ERROR_INIT;
    wt_status status = wt_compare(&bulk, &track, &r->c, &ignored);
    r->valid = status == WT_OK;
    /* without enough units, or at one rate without scatter, the row stays without numbers */
    if (status == WT_OK || status == WT_E_EMPTY || (status == WT_E_RANGE && bin != SIZE_MAX))
        return WT_OK;
    if (err != NULL)
        *err = ignored;
    return status;
}

static wt_status add_rows(wt_table *table, const row *rows, size_t n, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        status = wt_table_add_row(table, err);
        if (status != WT_OK)
            break;
        size_t column = 0;
        wt_table_put(table, column++, rows[i].low);
        wt_table_put(table, column++, rows[i].high);
        wt_table_put(table, column++, (double)rows[i].n[0]);
        wt_table_put(table, column++, (double)rows[i].n[1]);
        if (!rows[i].valid)
            continue;
        const wt_comparison *c = &rows[i].c;
        const double values[] = {
            c->ratio,    c->ratio_low, c->ratio_high, c->difference.value, c->welch_t,
            c->welch_df, c->welch_p,   rows[i].holm,  c->mann_whitney_p,   c->effect_size};
        for (size_t k = 0; k < FLOW_COUNT(values); k++)
            wt_table_put(table, column++, values[k]);
    }
    return status;
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

static wt_status comparison_keys(wt_table *table, const pair *p, const row *all, bool by_curve,
                                 wt_error *err)
{
    const char *unit = "curve: no spots in the tables";
    if (by_curve)
        unit = "curve: fewer than two spots in a group; curves of one spot are not independent, so "
               "the interval is too narrow";
    else if (all->valid && all->c.by_spot)
        unit = p->data[0].spots_given && p->data[1].spots_given
                   ? "spot"
                   : "spot, as taken from files or positions because none were named";
    wt_status status = wt_table_set_key(table, "unit_of_analysis", unit, err);
    if (status == WT_OK && all->valid)
        status = flow_table_value(table, "modulus_ratio", all->c.ratio,
                                  all->c.ratio * all->c.log_ratio.standard_error, 0, "1", err);
    return status;
}

static wt_status make_comparison(pair *p, bool rates, const wt_job *common, wt_table **result,
                                 wt_error *err)
{
    static const flow_column columns[] = {
        {"rate_low", "m/s", "smallest indentation rate of the row; nan = all rates"},
        {"rate_high", "m/s", "largest indentation rate of the row; nan = all rates"},
        {"n_bulk", "1", "accepted bulk curves"},
        {"n_track", "1", "accepted wear-track curves"},
        {"ratio", "1", "modulus of the track over that of the bulk"},
        {"ratio_low", "1", "lower end of its 95 % interval"},
        {"ratio_high", "1", "upper end of its 95 % interval"},
        {"difference", "Pa", "difference of the mean moduli, track minus bulk"},
        {"welch_t", "1", "Welch's t of the means"},
        {"welch_df", "1", "its degrees of freedom"},
        {"welch_p", "1", "its two-sided p"},
        {"holm_p", "1", "p after Holm's correction for the number of rates"},
        {"mann_whitney_p", "1", "two-sided p of the Mann-Whitney test"},
        {"effect_size", "1", "Hedges' g of ln E"},
    };
    size_t n_bins = rates ? p->n_bins : 0;
    wt_table *table = NULL;
    bool by_curve = false;
    row *rows = calloc(n_bins + 1, sizeof *rows);
    if (rows == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = compare_part(p, SIZE_MAX, false, &rows[0], err);
    if (status == WT_OK && !rows[0].valid) {
        by_curve = true;
        status = compare_part(p, SIZE_MAX, true, &rows[0], err);
    }
    for (size_t b = 0; status == WT_OK && b < n_bins; b++)
        status = compare_part(p, b, by_curve, &rows[b + 1], err);
    if (status == WT_OK)
        status = holm_rows(rows + 1, n_bins, err);
    if (status == WT_OK && !rows[0].valid) {
        status = wt_fail(err, WT_E_EMPTY, "too few accepted curves to compare");
        wt_error_expected(err, "two or more in each group");
        wt_error_found(err, "bulk %zu, track %zu", rows[0].n[0], rows[0].n[1]);
        wt_error_advice(err, "the column reason of the indentation tables says why curves were "
                             "rejected");
    }
    for (size_t b = 1; status == WT_OK && b <= n_bins; b++)
        if ((rows[b].n[0] == 0) != (rows[b].n[1] == 0))
            wt_parselog_add(common->log, WT_WARNING, NULL, NULL,
                            "curves at %.3g to %.3g m/s are in one group only (bulk %zu, track "
                            "%zu); the comparison over all rates includes them",
                            rows[b].low, rows[b].high, rows[b].n[0], rows[b].n[1]);
    if (status == WT_OK)
        status = flow_table_new("comparison", "Wear track against bulk", columns,
                                FLOW_COUNT(columns), &table, err);
    if (status == WT_OK)
        status = add_rows(table, rows, n_bins + 1, err);
    if (status == WT_OK)
        status = comparison_keys(table, p, &rows[0], by_curve, err);
    free(rows);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *result = table;
    return WT_OK;
}

/* ---- against rate and against DMA -------------------------------------------------------------
 */

/* Geometric means over the curves of one bin of one group. */
typedef struct rate_point {
    size_t n;
    double rate, frequency;
    wt_group_summary summary;
} rate_point;

static wt_status rate_point_of(pair *p, int g, size_t bin, rate_point *point, wt_error *err)
{
    wt_group part = part_of(p, g, bin, 0);
    double log_rate = 0, log_frequency = 0;
    *point = (rate_point){.n = part.n};
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

static wt_status rate_row(wt_table *table, int g, const rate_point *point, wt_error *err)
{
    enum { GROUP, RATE, FREQUENCY, N, MEAN, LOW, HIGH };
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, GROUP, group_name[g], err);
    if (status != WT_OK)
        return status;
    wt_table_put(table, RATE, point->rate);
    wt_table_put(table, FREQUENCY, point->frequency);
    wt_table_put(table, N, (double)point->n);
    wt_table_put(table, MEAN, point->summary.geometric_mean);
    wt_table_put(table, LOW, point->summary.low);
    wt_table_put(table, HIGH, point->summary.high);
    return WT_OK;
}

static wt_status dma_row(wt_table *table, int g, const rate_point *point,
                         const wt_material *material, wt_error *err)
{
    enum { GROUP, FREQUENCY, MODULUS, LOW, HIGH, STORAGE, COMPLEX, RATIO, EXTRAPOLATED };
    double storage = (double)NAN, loss = (double)NAN;
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, GROUP, group_name[g], err);
    if (status != WT_OK)
        return status;
    wt_table_put(table, FREQUENCY, point->frequency);
    wt_table_put(table, MODULUS, point->summary.geometric_mean);
    wt_table_put(table, LOW, point->summary.low);
    wt_table_put(table, HIGH, point->summary.high);
    if (!(point->frequency > 0))
        return WT_OK;
    material->law->modulus(material, &point->frequency, 1, &storage, &loss);
    bool outside =
        point->frequency < material->frequency_min || point->frequency > material->frequency_max;
    wt_table_put(table, STORAGE, storage);
    wt_table_put(table, COMPLEX, hypot(storage, loss));
    wt_table_put(table, RATIO, point->summary.geometric_mean / hypot(storage, loss));
    wt_table_put(table, EXTRAPOLATED, outside);
    return WT_OK;
}

static wt_status make_rate_tables(pair *p, const wt_material *material, wt_table **rate_table,
                                  wt_table **dma_table, wt_error *err)
{
    static const flow_column rate_columns[] = {
        {"group", NULL, "bulk or track"},
        {"indentation_rate", "m/s", "geometric mean of the indentation rate"},
        {"equivalent_frequency", "rad/s", "angular frequency of equal loading"},
        {"n", "1", "accepted curves"},
        {"geometric_mean", "Pa", "geometric mean of the modulus"},
        {"low", "Pa", "lower end of its 95 % interval"},
        {"high", "Pa", "upper end of its 95 % interval"},
    };
    static const flow_column dma_columns[] = {
        {"group", NULL, "bulk or track"},
        {"equivalent_frequency", "rad/s", "angular frequency of equal loading"},
        {"indentation_modulus", "Pa", "geometric mean of the modulus"},
        {"low", "Pa", "lower end of its 95 % interval"},
        {"high", "Pa", "upper end of its 95 % interval"},
        {"dma_storage_modulus", "Pa", "E' of the DMA at this frequency"},
        {"dma_complex_modulus", "Pa", "|E*| of the DMA at this frequency"},
        {"ratio", "1", "indentation modulus over |E*|"},
        {"extrapolated", "1", "1: outside the frequencies measured by DMA"},
    };
    wt_status status = flow_table_new("modulus_rate", "Modulus against indentation rate",
                                      rate_columns, FLOW_COUNT(rate_columns), rate_table, err);
    if (status == WT_OK && material != NULL)
        status = flow_table_new("dma_comparison", "Indentation against DMA", dma_columns,
                                FLOW_COUNT(dma_columns), dma_table, err);
    for (int g = 0; status == WT_OK && g < 2; g++) {
        if (!p->present[g])
            continue;
        if (wt_table_n_rows(*rate_table) > 0)
            status = wt_table_new_block(*rate_table, err);
        for (size_t b = 0; status == WT_OK && b < p->n_bins; b++) {
            rate_point point;
            status = rate_point_of(p, g, b, &point, err);
            if (status == WT_OK && point.n > 0)
                status = rate_row(*rate_table, g, &point, err);
            if (status == WT_OK && point.n > 0 && material != NULL)
                status = dma_row(*dma_table, g, &point, material, err);
        }
    }
    return status;
}

static wt_status dma_keys(wt_table *table, const wt_compare_job *job, const char *statement,
                          wt_error *err)
{
    double temperature =
        isnan(job->temperature) ? job->rubber->prony.reference_temperature : job->temperature;
    wt_status status = flow_table_value(table, "temperature", temperature, 0, 0, "K", err);
    if (status == WT_OK)
        status =
            wt_table_set_key(table, "ratio_of", "indentation modulus over |E*| of the DMA", err);
    if (status == WT_OK && statement[0] != '\0')
        status = wt_table_set_key(table, "material_statement", statement, err);
    return status;
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

wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *common,
                            wt_compare_tables *tables, wt_error *err)
{
    if (job == NULL || common == NULL || tables == NULL ||
        (job->bulk == NULL && job->track == NULL))
        return wt_fail(err, WT_E_ARG, "nothing to compare");
    const wt_table *given[2] = {job->bulk, job->track};
    const wt_table *listed[2];
    const char *names[2]; /* by their place, whatever the tables are called */
    size_t n = 0;
    pair p = {0};
    wt_compare_tables t = {0};
    wt_material *material = NULL;
    char statement[256] = "";
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        if (given[g] == NULL)
            continue;
        names[n] = group_name[g];
        listed[n++] = given[g];
        p.present[g] = true;
        status = wt_group_from_table(given[g], &p.data[g], err);
    }
    if (status == WT_OK)
        status = groups_table(listed, names, n, &t.modulus_groups, err);
    if (status == WT_OK)
        status = make_bins(&p, err);
    if (status == WT_OK && n == 2 && !job->groups_only)
        status = make_comparison(&p, job->rates, common, &t.comparison, err);
    if (status == WT_OK && job->rates && p.n_bins > 0) {
        if (job->rubber != NULL)
            status = wt_rubber_at(job->rubber, job->temperature, common->seed, SIZE_MAX, &material,
                                  statement, err);
        if (status == WT_OK)
            status = make_rate_tables(&p, material, &t.modulus_rate, &t.dma_comparison, err);
        if (status == WT_OK && material != NULL)
            status = dma_keys(t.dma_comparison, job, statement, err);
    }
    if (status == WT_OK) {
        *tables = t;
        t = (wt_compare_tables){0};
    }
    wt_material_free(material);
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
