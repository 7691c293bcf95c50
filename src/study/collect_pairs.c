/* Differences between the modulus ratios of cases of one sample or condition, at the rates that
 * both have. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "study/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Significance level of the tests and of the intervals. */
static const double level = 0.05;

TABLE_ROW(ratio_pairs, RATIO_PAIRS, const char *of, *first, *second; wt_interval ratio;
          double df, p, holm_p; stated_verdict differ; double rates, interaction_p;)

TABLE_KEYS(ratio_pairs, RATIO_PAIRS, double pairs, different, undecided;
           const char *includes, *settled_by; double margin;)

typedef struct ratio_pair {
    const char *of;
    const collected_case *a, *b;
    bool of_sample; /* true if both share the sample, and the conditions differ */
    wt_log_ratio_difference difference;
    double holm_p;
    stated_verdict differ;
    double rates,
        interaction_p; /* rates that both have; test whether the difference depends on it */
} ratio_pair;

typedef struct pair_list {
    ratio_pair *pairs;
    size_t n;
} pair_list;

/* ---- rates that both cases have -------------------------------------------------------------- */

/* Largest distance of the centres of one rate in two cases [decade]: half the width of a bin of
 * `weartrack compare`, whose bins are further apart. */
static const double same_rate = 0.25;

/* Reads ln(ratio) at a rate: a row of the table "comparison". False without an interval. */
static bool read_rate_ratio(const collected_case *c, size_t row, wt_log_ratio *ratio)
{
    const table_view *v = &c->tables.comparison;
    const double df = comparison_get(v, row, COMPARISON_WELCH_DF),
                 half = log(comparison_get(v, row, COMPARISON_RATIO_HIGH) /
                            comparison_get(v, row, COMPARISON_RATIO_LOW)) /
                        2;
    *ratio = (wt_log_ratio){log(comparison_get(v, row, COMPARISON_RATIO)),
                            half / students_t_quantile(isnan(df) ? (double)INFINITY : df), df};
    return isfinite(ratio->value) && half > 0;
}

static double rate_centre(const collected_case *c, size_t row)
{
    const table_view *v = &c->tables.comparison;
    return log10(comparison_get(v, row, COMPARISON_RATE_LOW) *
                 comparison_get(v, row, COMPARISON_RATE_HIGH)) /
           2;
}

static size_t count_rates(const collected_case *c)
{
    size_t n = 0;
    wt_log_ratio ratio;
    for (size_t row = 1; row < c->tables.comparison.n_rows; row++)
        n += read_rate_ratio(c, row, &ratio);
    return n;
}

/* Differences of ln(ratio) at the rates that both have; to: a number for each row of `a`. */
static size_t find_rate_differences(const collected_case *a, const collected_case *b,
                                    wt_log_ratio *to)
{
    size_t n = 0;
    wt_log_ratio of[2];
    for (size_t i = 1; i < a->tables.comparison.n_rows; i++)
        for (size_t k = 1; k < b->tables.comparison.n_rows; k++) {
            if (!(fabs(rate_centre(a, i) - rate_centre(b, k)) <= same_rate) ||
                !read_rate_ratio(a, i, &of[0]) || !read_rate_ratio(b, k, &of[1]))
                continue;
            const wt_log_ratio_difference d = wt_log_ratio_compare(&of[0], &of[1]);
            to[n++] =
                (wt_log_ratio){d.value, hypot(of[0].standard_error, of[1].standard_error), d.df};
            break;
        }
    return n;
}

/* Ratio of all rates without the error that one ratio has where it depends on the rate: at equal
 * rates that is no error of the difference. */
static wt_log_ratio ratio_at_equal_rates(const collected_case *c)
{
    wt_log_ratio ratio = c->ratio;
    const double spread = comparison_value(&c->tables.comparison, COMPARISON_KEY_RATE_SPREAD).value;
    if (spread < ratio.standard_error)
        ratio.standard_error = sqrt(pow(ratio.standard_error, 2) - pow(spread, 2));
    return ratio;
}

/* Difference of the common rates. Their errors may be one, as the spots are the same. */
static wt_log_ratio mean_difference(const wt_log_ratio *of, size_t n)
{
    wt_log_ratio mean = {0, 0, (double)NAN};
    for (size_t i = 0; i < n; i++) {
        mean.value += of[i].value / (double)n;
        mean.standard_error += of[i].standard_error / (double)n;
        mean.df = fmin(mean.df, of[i].df); /* fmin skips NaN */
    }
    return mean;
}

/* Compares two cases at the rates that both have, or of all rates if there is none. Where the
 * difference itself depends on the rate, half its range is an error of the one difference. The test
 * of that takes the errors of the rates as independent, which is on the safe side. */
static void compare_at_common_rates(ratio_pair *q)
{
    static const wt_log_ratio none = {0, 0, (double)NAN};
    wt_log_ratio *const of = wt_alloc(q->a->tables.comparison.n_rows + 1, sizeof *of);
    const size_t n = find_rate_differences(q->a, q->b, of);
    const bool all = n == count_rates(q->a) && n == count_rates(q->b);
    const wt_log_ratio first = n > 0 ? ratio_at_equal_rates(q->a) : q->a->ratio,
                       second = n > 0 ? ratio_at_equal_rates(q->b) : q->b->ratio;
    wt_log_ratio difference = all || n == 0
                                  ? (wt_log_ratio){first.value - second.value, 0, (double)NAN}
                                  : mean_difference(of, n);
    q->rates = n > 0 ? (double)n : (double)NAN;
    q->interaction_p = (double)NAN;
    q->difference = all || n == 0 ? wt_log_ratio_compare(&first, &second)
                                  : wt_log_ratio_compare(&difference, &none);
    if (n > 1) {
        double low = of[0].value, high = low;
        for (size_t i = 1; i < n; i++) {
            low = fmin(low, of[i].value);
            high = fmax(high, of[i].value);
        }
        q->interaction_p = wt_log_ratio_test(of, n);
        if (q->interaction_p < level) {
            const double df = q->difference.df, half = (q->difference.high - q->difference.low) / 2;
            difference =
                (wt_log_ratio){q->difference.value,
                               hypot(half / students_t_quantile(isnan(df) ? (double)INFINITY : df),
                                     (high - low) / 2),
                               df};
            q->difference = wt_log_ratio_compare(&difference, &none);
        }
    }
    free(of);
}

static void add_ratio_pair(pair_list *list, const collected_case *a, const collected_case *b)
{
    const bool sample = strcmp(a->sample, b->sample) == 0;
    const bool condition = a->condition[0] != '\0' && strcmp(a->condition, b->condition) == 0;
    if (sample == condition || isnan(a->ratio.value) || isnan(b->ratio.value))
        return;
    list->pairs = array_grow(list->pairs, list->n, sizeof *list->pairs);
    list->pairs[list->n] =
        (ratio_pair){.of = sample ? a->sample : a->condition, .a = a, .b = b, .of_sample = sample};
    compare_at_common_rates(&list->pairs[list->n++]);
}

/* ---- all pairs ------------------------------------------------------------------------------- */

/* Assesses all pairs. "yes" requires significance after Holm's correction; "no" requires the whole
 * interval within the margin. */
static void assess_pairs(pair_list *list, double margin)
{
    double *p = wt_alloc(2 * list->n, sizeof *p);
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
}

static const char *differing_name(const ratio_pair *q, const collected_case *c)
{
    return q->of_sample ? c->condition : c->sample;
}

/* Advises a multiple of the present number of spots, for the pair whose interval must shrink least,
 * with the same centre, to lie within the margin or to exclude 0. */
static void advise_pair(const pair_list *list, double margin, char *text, size_t size)
{
    const ratio_pair *nearest = NULL;
    double least = (double)INFINITY;
    for (size_t i = 0; i < list->n; i++) {
        const ratio_pair *q = &list->pairs[i];
        const double half = (q->difference.high - q->difference.low) / 2,
                     off = fabs(q->difference.value), room = log1p(margin) - off,
                     needed = fmin(room > 0 ? half / room : (double)INFINITY, half / off);
        if (q->differ == VERDICT_INCONCLUSIVE && needed * needed < least) {
            least = needed * needed;
            nearest = q;
        }
    }
    if (nearest != NULL)
        clocale_print(text, size,
                      "about %.0f times as many spots in every group, or smaller errors that the "
                      "groups do not share, would decide the nearest of them, %s: %s against %s",
                      fmax(2, ceil(least)), nearest->of, differing_name(nearest, nearest->a),
                      differing_name(nearest, nearest->b));
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
                  {exp(q->difference.value), (double)NAN, exp(q->difference.low),
                   exp(q->difference.high)},
                  q->difference.df, q->difference.p, q->holm_p, q->differ, q->rates,
                  q->interaction_p);
    }
    advise_pair(list, margin, settled_by, sizeof settled_by);
    TABLE_SET(ratio_pairs, &w, (double)list->n, (double)different, (double)undecided,
              "what the two ratios include at the rates that both have; half the range of the "
              "difference over these rates where it depends on them (p below 0.05); an error that "
              "both share, such as one bulk, counts twice, which is on the safe side",
              settled_by, margin);
    return table_end(&w, table);
}

wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err)
{
    pair_list list = {0};
    wt_status status = WT_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 1; k < n; k++)
            add_ratio_pair(&list, &cases[i], &cases[k]);
    if (list.n > 0) {
        assess_pairs(&list, margin);
        status = make_pairs_table(&list, margin, table, err);
    }
    free(list.pairs);
    return status;
}
