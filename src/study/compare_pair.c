/* The two groups of a comparison and the bins of their rates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>

/* Width of a rate bin [decade]. Rates of one nominal piezo rate differ by less, because the softer
 * group indents slightly faster; see indentation/numerics/group_units.c. */
#define BIN_DECADES 0.5

const char *const compare_group_name[2] = {"bulk", "track"};

void compare_pair_clear(compare_pair *p)
{
    for (int g = 0; g < 2; g++) {
        wt_group_data_clear(&p->data[g]);
        free(p->bin[g]);
        free(p->point[g]);
    }
    free(p->low);
    free(p->high);
    free(p->modulus);
    free(p->rate);
    free(p->spot);
    free(p->rate_class);
}

/* A bin starts at the lowest rate outside the previous bin. The border therefore never divides a
 * nominal rate. */
void compare_assign_bins(compare_pair *p)
{
    size_t total = p->data[0].group.n + p->data[1].group.n, n = 0;
    double *rates = wt_alloc(total, sizeof *rates);
    p->low = wt_alloc(total, sizeof *p->low);
    p->high = wt_alloc(total, sizeof *p->high);
    p->modulus = wt_alloc(total, sizeof *p->modulus);
    p->rate = wt_alloc(total, sizeof *p->rate);
    p->spot = wt_alloc(total, sizeof *p->spot);
    p->rate_class = wt_alloc(total, sizeof *p->rate_class);
    for (int g = 0; g < 2; g++)
        p->bin[g] = wt_alloc(p->data[g].group.n, sizeof *p->bin[g]);
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
    bool known[2] = {false, false};
    for (int g = 0; g < 2; g++) {
        for (size_t i = 0; i < p->data[g].group.n; i++) {
            double rate = p->data[g].indentation_rate[i];
            p->bin[g][i] = COMPARE_NO_BIN;
            for (size_t b = 0; rate > 0 && b < p->n_bins; b++)
                if (rate >= p->low[b] && rate <= p->high[b])
                    p->bin[g][i] = b;
            known[g] = known[g] || p->bin[g][i] != COMPARE_NO_BIN;
        }
    }
    p->by_rate = known[0] && known[1];
    free(rates);
}

wt_group compare_select_curves(const compare_pair *p, int g, size_t bin, size_t offset,
                               bool factors)
{
    const wt_group_data *data = &p->data[g];
    const bool all = bin == COMPARE_ALL_BINS;
    wt_group part = {.modulus = p->modulus + offset,
                     .spot = data->group.spot == NULL ? NULL : p->spot + offset,
                     .rate = all && p->by_rate ? p->rate + offset : NULL,
                     .rate_class = p->rate_class + offset,
                     .n_rejected = all ? data->group.n_rejected : 0,
                     .spot_scatter = data->group.spot_scatter};
    for (size_t i = 0; i < data->group.n; i++) {
        const size_t at = p->bin[g][i];
        if (all ? p->by_rate && at == COMPARE_NO_BIN : at != bin)
            continue;
        p->modulus[offset + part.n] = factors ? data->spectrum_factor[i] : data->modulus[i];
        p->rate[offset + part.n] = data->indentation_rate[i];
        p->spot[offset + part.n] = data->spot[i];
        p->rate_class[offset + part.n] = (long)at;
        part.n++;
    }
    return part;
}

/* ---- both groups ----------------------------------------------------------------------------- */

/* A curve in both groups comes from a file that was given twice. */
static wt_status check_copies(const compare_pair *p, wt_error *err)
{
    const wt_group_data *a = &p->data[0], *b = &p->data[1];
    size_t n = 0;
    for (size_t i = 0, k = 0; i < a->n_digests && k < b->n_digests;) {
        const uint64_t x = a->digest[i].digest, y = b->digest[k].digest;
        n += x == y && x != 0 ? 1 : 0;
        i += x <= y ? 1 : 0;
        k += y <= x ? 1 : 0;
    }
    if (n == 0)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "bulk and track hold the same curves");
    wt_error_expected(err, "curves of the bulk and others of the track");
    wt_error_found(err, "%zu curves of the same content in both", n);
    wt_error_advice(err, "a file was given for both, perhaps under two names: leave it out of one");
    return WT_E_RANGE;
}

/* True if all curves have a factor on the spectrum, which does not depend on the rate, and no
 * temperature slope is stated. */
static bool compares_factors(const wt_compare_job *job, const compare_pair *p)
{
    bool all = p->present[0] && p->present[1] && isnan(job->temperature_slope.value);
    all = all && p->data[0].group.n > 0 && p->data[1].group.n > 0;
    for (int g = 0; all && g < 2; g++)
        for (size_t i = 0; i < p->data[g].group.n; i++)
            all = all && p->data[g].spectrum_factor[i] > 0;
    return all;
}

wt_status compare_read_groups(const wt_compare_job *job, compare_pair *p, wt_error *err)
{
    const wt_table *given[2] = {job->bulk, job->track};
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        p->present[g] = given[g] != NULL;
        if (p->present[g])
            status = wt_group_from_table(given[g], job->map_spots, &p->data[g], err);
        p->data[g].group.spot_scatter = sqrt(log1p(job->spot_scatter * job->spot_scatter));
    }
    if (status == WT_OK)
        status = check_copies(p, err);
    p->by_factor = status == WT_OK && compares_factors(job, p);
    if (status == WT_OK)
        compare_assign_bins(p);
    return status;
}
