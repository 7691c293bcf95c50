/* Test of the difference between the modulus ratios of two conditions or of two samples.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Significance level of the tests and of the intervals. */
static const double level = 0.05;

TABLE_ROW(ratio_pairs, RATIO_PAIRS, const char *of, *first, *second; wt_interval ratio;
          double df, p, holm_p; stated_verdict differ;)
TABLE_KEYS(ratio_pairs, RATIO_PAIRS, double pairs, different, undecided;
           const char *includes, *settled_by; double margin;)

typedef struct ratio_pair {
    const char *of;
    const collected_case *a, *b;
    bool of_sample; /* true if both share the sample, and the conditions differ */
    wt_log_ratio_difference difference;
    double holm_p;
    stated_verdict differ;
} ratio_pair;

typedef struct pair_list {
    ratio_pair *pairs;
    size_t n;
} pair_list;

static wt_status add_ratio_pair(pair_list *list, const collected_case *a, const collected_case *b,
                                wt_error *err)
{
    const bool sample = strcmp(a->sample, b->sample) == 0;
    const bool condition = a->condition[0] != '\0' && strcmp(a->condition, b->condition) == 0;
    if (sample == condition || isnan(a->ratio.value) || isnan(b->ratio.value))
        return WT_OK;
    ratio_pair *grown = array_grow(list->pairs, list->n, sizeof *grown);
    if (grown == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    list->pairs = grown;
    grown[list->n++] = (ratio_pair){.of = sample ? a->sample : a->condition,
                                    .a = a,
                                    .b = b,
                                    .of_sample = sample,
                                    .difference = wt_log_ratio_compare(&a->ratio, &b->ratio)};
    return WT_OK;
}

/* Assesses all pairs. "yes" requires significance after Holm's correction; "no" requires the whole
 * interval within the margin. */
static wt_status assess_pairs(pair_list *list, double margin, wt_error *err)
{
    double *p = malloc(2 * list->n * sizeof *p);
    if (p == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < list->n; i++)
        p[i] = list->pairs[i].difference.p;
    wt_holm_adjust(p, list->n, p + list->n);
    for (size_t i = 0; i < list->n; i++) {
        ratio_pair *q = &list->pairs[i];
        const double least = log1p(margin);
        q->holm_p = p[list->n + i];
        q->differ = q->holm_p < level ? VERDICT_YES
                    : q->difference.low > -least && q->difference.high < least
                        ? VERDICT_NO
                        : VERDICT_INCONCLUSIVE;
    }
    free(p);
    return WT_OK;
}

static const char *differing_name(const ratio_pair *q, const collected_case *c)
{
    return q->of_sample ? c->condition : c->sample;
}

/* Factor by which the interval of a pair must shrink, with the same centre, to lie within the
 * margin or to exclude 0. */
static double required_narrowing(const ratio_pair *q, double margin)
{
    const double half = (q->difference.high - q->difference.low) / 2,
                 off = fabs(q->difference.value), room = log1p(margin) - off;
    return fmin(room > 0 ? half / room : (double)INFINITY, half / off);
}

/* Advises a multiple of the present number of spots. */
static void advise_pair(const pair_list *list, double margin, char *text, size_t size)
{
    const ratio_pair *nearest = NULL;
    double least = (double)INFINITY;
    for (size_t i = 0; i < list->n; i++) {
        const ratio_pair *q = &list->pairs[i];
        const double needed = required_narrowing(q, margin);
        if (q->differ == VERDICT_INCONCLUSIVE && needed * needed < least) {
            least = needed * needed;
            nearest = q;
        }
    }
    if (nearest != NULL)
        clocale_print(text, size,
                      "about %.0f times as many spots in every group, or smaller errors that the "
                      "groups do not share, would settle the nearest of them, %s: %s against %s",
                      fmax(2, ceil(least)), nearest->of, differing_name(nearest, nearest->a),
                      differing_name(nearest, nearest->b));
}

static wt_interval difference_ratio(const wt_log_ratio_difference *d)
{
    return (wt_interval){exp(d->value), (double)NAN, exp(d->low), exp(d->high)};
}

static wt_status make_pairs_table(const pair_list *list, double margin, wt_table **table,
                                  wt_error *err)
{
    char settled_by[256] = "";
    size_t different = 0, undecided = 0;
    table_writer w = table_begin(&ratio_pairs_schema, err);
    for (size_t i = 0; i < list->n; i++) {
        const ratio_pair *q = &list->pairs[i];
        different += q->differ == VERDICT_YES;
        undecided += q->differ == VERDICT_INCONCLUSIVE;
        TABLE_ADD(ratio_pairs, &w, q->of, differing_name(q, q->a), differing_name(q, q->b),
                  difference_ratio(&q->difference), q->difference.df, q->difference.p, q->holm_p,
                  q->differ);
    }
    advise_pair(list, margin, settled_by, sizeof settled_by);
    TABLE_SET(ratio_pairs, &w, (double)list->n, (double)different, (double)undecided,
              "what the two ratios include; an error that both share, such as one bulk, counts "
              "twice, which is on the safe side",
              settled_by, margin);
    return table_end(&w, table);
}

wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err)
{
    pair_list list = {0};
    wt_status status = WT_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 1; status == WT_OK && k < n; k++)
            status = add_ratio_pair(&list, &cases[i], &cases[k], err);
    if (status == WT_OK && list.n > 0)
        status = assess_pairs(&list, margin, err);
    if (status == WT_OK && list.n > 0)
        status = make_pairs_table(&list, margin, table, err);
    free(list.pairs);
    return status;
}
