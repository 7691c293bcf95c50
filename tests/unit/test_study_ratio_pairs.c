/* Pairs of cases whose modulus ratios depend on the rate, from draws created here.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "table_cells.h"

#include "core/table/registry.h"
#include "weartrack/case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMPOUNDS = 4, SEVERITIES = 2, RATES = 3, SPOTS = 5, CURVES = SPOTS * RATES };
static const char *const compound[COMPOUNDS] = {"HC", "LC", "HS", "LS"};
static const char *const severity[SEVERITIES] = {"mild", "severe"};
static const double true_ratio[SEVERITIES] = {0.80, 0.55};

static uint64_t random_state;

static double normal(void)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        random_state = random_state * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(random_state >> 11) * 0x1p-53;
    }
    return sum;
}

typedef struct drawn_group {
    double modulus[CURVES], rate[CURVES];
    long spot[CURVES], class[CURVES];
} drawn_group;

/* ln E is linear in ln rate with `slope`; positions scatter by 4 %, curves by 2 %. Rate by rate. */
static void draw_group(double modulus, double slope, drawn_group *g)
{
    double spot[SPOTS];
    for (int i = 0; i < SPOTS; i++)
        spot[i] = 0.04 * normal();
    for (int i = 0; i < CURVES; i++) {
        const int r = i / SPOTS;
        g->rate[i] = 1e-6 * pow(30, r);
        g->spot[i] = i % SPOTS;
        g->class[i] = r;
        g->modulus[i] =
            modulus * exp(slope * log(30) * (r - 1) + spot[i % SPOTS] + 0.02 * normal());
    }
}

static wt_comparison compare_drawn(const drawn_group g[2], int r)
{
    wt_group of[2];
    wt_comparison c;
    for (int k = 0; k < 2; k++)
        of[k] = r < 0 ? (wt_group){.modulus = g[k].modulus,
                                   .spot = g[k].spot,
                                   .rate = g[k].rate,
                                   .rate_class = g[k].class,
                                   .n = CURVES}
                      : (wt_group){.modulus = g[k].modulus + SPOTS * r,
                                   .spot = g[k].spot + SPOTS * r,
                                   .n = SPOTS};
    assert_int_equal(wt_compare_moduli(&of[0], &of[1], NULL, &c, NULL), WT_OK);
    return c;
}

/* Result of `weartrack compare` for two such groups with a rate-dependent ratio. */
static wt_result *drawn_case(int a, int b, double slope)
{
    drawn_group g[2];
    wt_result *to = wt_result_new();
    wt_table *made = NULL;
    wt_error err = WT_ERROR_INIT;
    double low = (double)INFINITY, high = 0;
    draw_group(8e6, 0.1, &g[0]);
    draw_group(8e6 * true_ratio[b], 0.1 + slope, &g[1]);
    table_writer w = table_begin(&answer_schema, NULL);
    answer_set_text(&w, ANSWER_KEY_CASE_SAMPLE, compound[a]);
    answer_set_text(&w, ANSWER_KEY_CASE_CONDITION, severity[b]);
    assert_int_equal(table_end(&w, &made), WT_OK);
    assert_int_equal(wt_result_add(to, made, NULL), WT_OK);
    w = table_begin(&comparison_schema, &err);
    for (int r = -1; r < RATES; r++) {
        const wt_comparison c = compare_drawn(g, r);
        table_row(&w);
        const double rate = r < 0 ? (double)NAN : g[0].rate[SPOTS * r];
        const struct {
            comparison_column column;
            double value;
        } put[] = {{COMPARISON_RATE_LOW, rate},           {COMPARISON_RATE_HIGH, rate},
                   {COMPARISON_RATIO, c.ratio},           {COMPARISON_RATIO_LOW, c.ratio_low},
                   {COMPARISON_RATIO_HIGH, c.ratio_high}, {COMPARISON_WELCH_DF, c.df}};
        enum { PUT = sizeof put / sizeof *put };
        for (comparison_column k = 0; k <= COMPARISON_EFFECT_SIZE; k++) {
            double value = (double)NAN;
            for (size_t i = 0; i < PUT; i++)
                value = put[i].column == k ? put[i].value : value;
            comparison_put(&w, k, value);
        }
        if (r >= 0) {
            low = fmin(low, c.ratio);
            high = fmax(high, c.ratio);
        }
    }
    const wt_comparison all = compare_drawn(g, -1);
    const double spread = log(high / low) / 2;
    comparison_set_text(&w, COMPARISON_KEY_DIFFERS, "yes");
    comparison_set_text(&w, COMPARISON_KEY_UNIT_OF_ANALYSIS, "spot");
    comparison_set_text(&w, COMPARISON_KEY_RATES, "those that both groups have");
    comparison_set_text(&w, COMPARISON_KEY_CANTILEVERS, "one");
    comparison_set_text(&w, COMPARISON_KEY_MARGIN, "0.2");
    comparison_set_value(&w, COMPARISON_KEY_MODULUS_RATIO, all.ratio,
                         all.ratio * hypot(all.log_ratio.standard_error, spread), 0);
    comparison_set_value(&w, COMPARISON_KEY_MODULUS_RATIO_DF, all.df, 0, 0);
    comparison_set_value(&w, COMPARISON_KEY_RATE_SPREAD, spread, 0, 0);
    if (table_end(&w, &made) != WT_OK)
        fail_msg("%s; %s; %s", err.message, err.place, err.found);
    assert_int_equal(wt_result_add(to, made, NULL), WT_OK);
    return to;
}

/* Pairs of eight cases; the ratio has the same `slope` in all, and another one in the severe
 * ones. */
static wt_table *drawn_pairs(double slope, double severe_slope)
{
    const wt_collect_job job = wt_collect_job_defaults();
    wt_collection_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    wt_collected_result cases[COMPOUNDS * SEVERITIES];
    wt_result *results[COMPOUNDS * SEVERITIES];
    for (int i = 0; i < COMPOUNDS * SEVERITIES; i++) {
        const int b = i % SEVERITIES;
        results[i] = drawn_case(i / SEVERITIES, b, b == 0 ? slope : severe_slope);
        cases[i] = (wt_collected_result){results[i], "drawn.h5"};
    }
    if (wt_collection_compute(cases, COMPOUNDS * SEVERITIES, &job, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    wt_table *pairs = tables.ratio_pairs;
    tables.ratio_pairs = NULL;
    wt_tables_clear(&tables, sizeof tables);
    for (int i = 0; i < COMPOUNDS * SEVERITIES; i++)
        wt_result_free(results[i]);
    return pairs;
}

/* Four compounds, mild and severe, at three rates, with rate-dependent ratios: severe wear softens
 * more in each compound, and the compounds do not differ. The rate dependence is common to all and
 * not an error of a pair. The intervals cover the truth; fixed seed. */
static void pairs_at_equal_rates(void **state)
{
    (void)state;
    enum { DRAWS = 40, PAIRS = COMPOUNDS + SEVERITIES * COMPOUNDS * (COMPOUNDS - 1) / 2 };
    size_t held = 0, undecided = 0, of_rate = 0;
    random_state = 20261129;
    for (int k = 0; k < DRAWS; k++) {
        wt_table *pairs = drawn_pairs(0.06, 0.06);
        assert_int_equal(wt_table_n_rows(pairs), PAIRS);
        for (size_t i = 0; i < PAIRS; i++) {
            const bool between = strcmp(text_cell(pairs, i, "first"), "mild") == 0;
            const double truth = between ? true_ratio[0] / true_ratio[1] : 1;
            const char *const said = text_cell(pairs, i, "differ");
            held += number_cell(pairs, i, "ratio_low") <= truth &&
                    truth <= number_cell(pairs, i, "ratio_high");
            undecided += strcmp(said, between ? "yes" : "no") != 0;
            of_rate += number_cell(pairs, i, "interaction_p") < 0.05;
            assert_true(number_cell(pairs, i, "rates") == RATES);
        }
        wt_table_free(pairs);
    }
    print_message("held %zu, not decided %zu, by the rate %zu of %d\n", held, undecided, of_rate,
                  DRAWS * PAIRS);
    assert_true((double)held >= 0.92 * DRAWS * PAIRS && (double)held <= 0.99 * DRAWS * PAIRS);
    assert_true((double)undecided <= 0.02 * DRAWS * PAIRS);
    assert_true((double)of_rate <= 0.05 * DRAWS * PAIRS);
}

/* A difference that depends on the rate is detected, and the interval includes its range. */
static void pairs_that_depend_on_the_rate(void **state)
{
    (void)state;
    random_state = 20261130;
    wt_table *pairs = drawn_pairs(0.0, 0.1);
    for (size_t i = 0; i < wt_table_n_rows(pairs); i++) {
        const double width = log(number_cell(pairs, i, "ratio_high") /
                                 number_cell(pairs, i, "ratio_low")),
                     p = number_cell(pairs, i, "interaction_p");
        if (strcmp(text_cell(pairs, i, "first"), "mild") == 0)
            assert_true(p < 0.05 && width > 1.96 * 0.1 * log(30) * 2);
        else
            assert_true(p > 0.001 && width < 0.5);
    }
    wt_table_free(pairs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pairs_at_equal_rates),
                                       cmocka_unit_test(pairs_that_depend_on_the_rate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
