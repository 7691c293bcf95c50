/* Groups of moduli: the numeric cases, what has no answer, invariances, Holm, equivalent frequency.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "near.h"

#include "weartrack/fit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUES = 64 };

typedef struct group_text {
    double modulus[MAX_VALUES];
    long spot[MAX_VALUES];
    size_t n;
    bool spots;
} group_text;

static group_text read_group(char *words)
{
    group_text g = {.n = 0};
    long spot = 0;
    for (char *word = strtok(words, " \n"); word != NULL; word = strtok(NULL, " \n")) {
        if (sscanf(word, "spot=%ld", &spot) == 1) {
            g.spots = true;
            continue;
        }
        assert_true(g.n < MAX_VALUES);
        g.spot[g.n] = spot;
        g.modulus[g.n++] = strtod(word, NULL) * 1e6;
    }
    return g;
}

static wt_group group_of(const group_text *g)
{
    return (wt_group){.modulus = g->modulus, .spot = g->spots ? g->spot : NULL, .n = g->n};
}

static double field(const wt_comparison *c, const char *name)
{
    const struct {
        const char *name;
        double value;
    } fields[] = {
        {"bulk_mean", c->bulk.mean},
        {"track_mean", c->track.mean},
        {"bulk_standard_deviation", c->bulk.standard_deviation},
        {"track_standard_deviation", c->track.standard_deviation},
        {"bulk_n", (double)c->bulk.n},
        {"bulk_n_spots", (double)c->bulk.n_spots},
        {"track_n_spots", (double)c->track.n_spots},
        {"bulk_geometric_mean", c->bulk.geometric_mean},
        {"track_geometric_mean", c->track.geometric_mean},
        {"median_bulk", c->bulk.median},
        {"median_track", c->track.median},
        {"by_spot", c->by_spot},
        {"log_ratio_standard_error", c->log_ratio.standard_error},
        {"ratio", c->ratio},
        {"ratio_low", c->ratio_low},
        {"ratio_high", c->ratio_high},
        {"difference", c->difference.value},
        {"welch_t", c->welch_t},
        {"welch_df", c->welch_df},
        {"welch_p", c->welch_p},
        {"mann_whitney_u", c->mann_whitney_u},
        {"mann_whitney_p", c->mann_whitney_p},
        {"mann_whitney_exact", c->mann_whitney_exact},
        {"effect_size", c->effect_size},
    };
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
        if (strcmp(fields[i].name, name) == 0)
            return fields[i].value;
    fail_msg("no field %s", name);
    return (double)NAN;
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/group_comparison.txt", "r");
    assert_non_null(in);
    char line[1024], name[64], case_name[64] = "";
    group_text bulk = {.n = 0}, track = {.n = 0};
    double value = 0.0, tolerance = 0.0;
    int n = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        if (sscanf(line, "case %63s", case_name) == 1)
            continue;
        if (strncmp(line, "bulk ", 5) == 0) {
            bulk = read_group(line + 5);
        } else if (strncmp(line, "track ", 6) == 0) {
            track = read_group(line + 6);
        } else if (sscanf(line, "expect %63s %lf %lf", name, &value, &tolerance) == 3) {
            wt_group a = group_of(&bulk), b = group_of(&track);
            wt_comparison c;
            assert_int_equal(wt_compare(&a, &b, &c, NULL), WT_OK);
            double got = field(&c, name);
            if (!(fabs(got - value) <= tolerance * fabs(value)))
                fail_msg("%s: %s is %.17g, expected %.17g", case_name, name, got, value);
            n++;
        } else if (line[0] != '#' && line[0] != '\n') {
            fail_msg("not understood: %s", line);
        }
    }
    fclose(in);
    assert_true(n > 25);
}

static void order_does_not_matter(void **state)
{
    (void)state;
    const double a[] = {3.1e6, 2.2e6, 7.7e6, 2.9e6, 3.3e6}, b[] = {1.1e6, 2.4e6, 0.7e6, 1.9e6};
    const double a2[] = {2.9e6, 7.7e6, 3.3e6, 3.1e6, 2.2e6}, b2[] = {0.7e6, 1.9e6, 2.4e6, 1.1e6};
    wt_group bulk = {.modulus = a, .n = 5, .n_rejected = 2},
             track = {.modulus = b, .n = 4, .n_rejected = 1};
    wt_group bulk2 = {.modulus = a2, .n = 5, .n_rejected = 2},
             track2 = {.modulus = b2, .n = 4, .n_rejected = 1};
    wt_comparison c, d;
    assert_int_equal(wt_compare(&bulk, &track, &c, NULL), WT_OK);
    assert_int_equal(wt_compare(&bulk2, &track2, &d, NULL), WT_OK);
    assert_true(c.log_ratio.value == d.log_ratio.value && c.welch_p == d.welch_p &&
                c.bulk.mean == d.bulk.mean && c.mann_whitney_p == d.mann_whitney_p);
    assert_int_equal(c.bulk.n_rejected, 2);
    /* Exchanged groups: the reciprocal ratio, the same p. */
    assert_int_equal(wt_compare(&track, &bulk, &d, NULL), WT_OK);
    assert_near(c.ratio * d.ratio, 1.0, 1e-14);
    assert_near(c.ratio_low * d.ratio_high, 1.0, 1e-13);
    assert_near(c.welch_t, -d.welch_t, 1e-14);
    assert_near(c.mann_whitney_p, d.mann_whitney_p, 1e-14);
    assert_near(c.mann_whitney_u + d.mann_whitney_u, 20.0, 1e-14);
    assert_near(c.effect_size, -d.effect_size, 1e-14);
    /* Another unit of the modulus changes no ratio and no p. */
    double a3[5], b3[4];
    for (int i = 0; i < 5; i++)
        a3[i] = 1e-3 * a[i];
    for (int i = 0; i < 4; i++)
        b3[i] = 1e-3 * b[i];
    wt_group bulk3 = {.modulus = a3, .n = 5}, track3 = {.modulus = b3, .n = 4};
    assert_int_equal(wt_compare(&bulk3, &track3, &d, NULL), WT_OK);
    assert_near(d.ratio, c.ratio, 1e-13);
    assert_near(d.ratio_high, c.ratio_high, 1e-12);
    assert_near(d.welch_p, c.welch_p, 1e-10);
    assert_near(d.mann_whitney_p, c.mann_whitney_p, 1e-14);
}

/* The exact distribution against all rankings counted one by one, and the approximation near it. */
static void mann_whitney_agrees_with_enumeration(void **state)
{
    (void)state;
    enum { M = 5, N = 6, ALL = M + N };
    double count[M * N + 1] = {0.0}, total = 0.0;
    for (unsigned bits = 0; bits < 1u << ALL; bits++) {
        if (__builtin_popcount(bits) != M)
            continue;
        int u = 0, below = 0;
        for (int i = 0; i < ALL; i++) {
            if (bits >> i & 1u)
                u += below;
            else
                below++;
        }
        count[u] += 1.0;
        total += 1.0;
    }
    const double track[M] = {2.0, 3.5, 4.5, 1.0, 8.5}, bulk[N] = {3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
    wt_group a = {.modulus = bulk, .n = N}, b = {.modulus = track, .n = M};
    wt_comparison c;
    assert_int_equal(wt_compare(&a, &b, &c, NULL), WT_OK);
    double tail = 0.0;
    assert_near(c.mann_whitney_u, 9.0, 0.0);
    for (int u = 0; u <= 9; u++)
        tail += count[u];
    assert_true(c.mann_whitney_exact);
    assert_near(c.mann_whitney_p, 2.0 * tail / total, 1e-14);

    /* 26 and 26 units: too many for exact counts; 25 and 25 are not. Both see the same shift. */
    double x[26], y[26];
    for (int i = 0; i < 26; i++) {
        x[i] = 10.0 + i + 0.01 * (i * 7 % 26);
        y[i] = 14.3 + i + 0.01 * (i * 11 % 26);
    }
    wt_group p = {.modulus = x, .n = 25}, q = {.modulus = y, .n = 25};
    assert_int_equal(wt_compare(&p, &q, &c, NULL), WT_OK);
    assert_true(c.mann_whitney_exact);
    double exact = c.mann_whitney_p;
    double mean = 312.5, sd = sqrt(25.0 * 25.0 * 51.0 / 12.0);
    assert_near(exact, erfc((c.mann_whitney_u - mean - 0.5) / sd / M_SQRT2), 0.05);
    p.n = q.n = 26;
    assert_int_equal(wt_compare(&p, &q, &c, NULL), WT_OK);
    assert_false(c.mann_whitney_exact);
    assert_near(c.mann_whitney_p,
                erfc((c.mann_whitney_u - 338.0 - 0.5) / sqrt(26.0 * 26.0 * 53.0 / 12.0) / M_SQRT2),
                1e-12);
}

static void summary_of_one_group(void **state)
{
    (void)state;
    const double e[] = {1e6, 4e6, 2e6};
    const long spot[] = {3, 3, 9};
    wt_group g = {.modulus = e, .n = 3, .n_rejected = 7};
    wt_group_summary s;
    assert_int_equal(wt_group_summarise(&g, &s, NULL), WT_OK);
    assert_int_equal(s.n, 3);
    assert_int_equal(s.n_spots, 3);
    assert_int_equal(s.n_rejected, 7);
    assert_near(s.geometric_mean, 2e6, 1e-14);
    assert_near(s.median, 2e6, 1e-14);
    assert_near(s.mean, 7e6 / 3, 1e-14);
    assert_near(s.log_standard_error, log(2.0) / sqrt(3.0), 1e-12);
    /* t of 2 degrees of freedom: 4.302652729749462 */
    assert_near(s.high, 2e6 * exp(4.302652729749462 * log(2.0) / sqrt(3.0)), 1e-10);
    assert_near(s.low * s.high, 4e12, 1e-12);
    g.spot = spot;
    assert_int_equal(wt_group_summarise(&g, &s, NULL), WT_OK);
    assert_int_equal(s.n_spots, 2);
    assert_near(s.geometric_mean, 2e6, 1e-14);
    assert_near(s.log_standard_error, 0.0, 0.0);
    g.n = 1;
    assert_int_equal(wt_group_summarise(&g, &s, NULL), WT_OK);
    assert_near(s.geometric_mean, 1e6, 1e-14);
    assert_true(isnan(s.low) && isnan(s.high) && isnan(s.log_standard_error));
    assert_true(isnan(s.standard_deviation));
}

static void no_answer(void **state)
{
    (void)state;
    const double good[] = {1e6, 2e6, 3e6}, bad[] = {1e6, -2e6}, equal[] = {1e6, 1e6};
    const double gap[] = {1e6, (double)NAN};
    const long one_spot[] = {4, 4, 4}, spots[] = {1, 2, 3};
    wt_error err = WT_ERROR_INIT;
    wt_comparison c;
    wt_group_summary s;
    wt_group a = {.modulus = good, .n = 3}, empty = {.modulus = NULL, .n = 0, .n_rejected = 5},
             single = {.modulus = good, .n = 1};
    wt_group negative = {.modulus = bad, .n = 2}, missing = {.modulus = gap, .n = 2},
             same = {.modulus = equal, .n = 2};
    wt_group spot = {.modulus = good, .spot = one_spot, .n = 3},
             three = {.modulus = good, .spot = spots, .n = 3};
    assert_int_equal(wt_group_summarise(&empty, &s, NULL), WT_E_EMPTY);
    assert_int_equal(wt_compare(&a, &empty, &c, NULL), WT_E_EMPTY);
    assert_int_equal(wt_compare(&a, &single, &c, &err), WT_E_EMPTY);
    assert_non_null(strstr(err.message, "track"));
    assert_int_equal(wt_compare(&spot, &three, &c, &err), WT_E_EMPTY);
    assert_non_null(strstr(err.message, "bulk"));
    assert_non_null(strstr(err.expected, "spots"));
    assert_int_equal(wt_compare(&negative, &a, &c, &err), WT_E_RANGE);
    assert_non_null(strstr(err.place, "2 of 2"));
    assert_int_equal(wt_compare(&missing, &a, &c, NULL), WT_E_RANGE);
    assert_int_equal(wt_compare(&same, &same, &c, NULL), WT_E_RANGE);
    /* Spots of one group only: curves are compared, and the result says so. */
    assert_int_equal(wt_compare(&spot, &a, &c, NULL), WT_OK);
    assert_false(c.by_spot);
}

static void holm(void **state)
{
    (void)state;
    /* Ordered: 0.01 * 4, 0.02 * 3, 0.03 * 2, 0.04 * 1 -> 0.04, 0.06, 0.06, 0.06. */
    const double p[] = {0.04, 0.01, (double)NAN, 0.03, 0.02};
    double adjusted[5];
    wt_holm(p, 5, adjusted);
    const double expected[] = {0.06, 0.04, (double)NAN, 0.06, 0.06};
    for (int i = 0; i < 5; i++)
        assert_near(adjusted[i], expected[i], 1e-14);
    const double large[] = {0.5, 0.5, 0.9};
    wt_holm(large, 3, adjusted);
    for (int i = 0; i < 3; i++)
        assert_near(adjusted[i], 1.0, 0.0);
    wt_holm(NULL, 0, NULL);
}

static void equivalent_frequency(void **state)
{
    (void)state;
    /* exp(psi(3)) = exp(3/2 - gamma), exp(psi(5/2)) = exp(8/3 - gamma)/4. */
    const double euler = 0.57721566490153286;
    assert_near(wt_equivalent_frequency(0.1, 2.0), 10 * exp(1.5 - euler), 1e-13);
    assert_near(wt_equivalent_frequency(2.0, 1.5), 0.125 * exp(8.0 / 3.0 - euler), 1e-13);
    assert_near(wt_equivalent_frequency(1.0, 2.0), 2.52, 2e-3);
    assert_near(wt_equivalent_frequency(1.0, 1.5), 2.02, 2e-3);
    assert_true(isnan(wt_equivalent_frequency(0.0, 2.0)));
    assert_true(isnan(wt_equivalent_frequency((double)NAN, 2.0)));
    assert_true(isnan(wt_equivalent_frequency(1.0, -1.5)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(order_does_not_matter),
        cmocka_unit_test(mann_whitney_agrees_with_enumeration),
        cmocka_unit_test(summary_of_one_group),
        cmocka_unit_test(no_answer),
        cmocka_unit_test(holm),
        cmocka_unit_test(equivalent_frequency),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
