/* Groups of moduli: numeric cases, groups without a result, invariances, Holm's correction,
 * equivalent frequency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/study.h"

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
        {"welch_t", c->t},
        {"welch_df", c->df},
        {"welch_p", c->p},
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
            assert_int_equal(wt_compare_moduli(&a, &b, NULL, &c, NULL), WT_OK);
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
    assert_int_equal(wt_compare_moduli(&bulk, &track, NULL, &c, NULL), WT_OK);
    assert_int_equal(wt_compare_moduli(&bulk2, &track2, NULL, &d, NULL), WT_OK);
    assert_true(c.log_ratio.value == d.log_ratio.value && c.p == d.p &&
                c.bulk.mean == d.bulk.mean && c.mann_whitney_p == d.mann_whitney_p);
    assert_int_equal(c.bulk.n_rejected, 2);
    /* Exchanged groups: the reciprocal ratio, the same p value. */
    assert_int_equal(wt_compare_moduli(&track, &bulk, NULL, &d, NULL), WT_OK);
    assert_near(c.ratio * d.ratio, 1.0, 1e-14);
    assert_near(c.ratio_low * d.ratio_high, 1.0, 1e-13);
    assert_near(c.t, -d.t, 1e-14);
    assert_near(c.mann_whitney_p, d.mann_whitney_p, 1e-14);
    assert_near(c.mann_whitney_u + d.mann_whitney_u, 20.0, 1e-14);
    assert_near(c.effect_size, -d.effect_size, 1e-14);
    /* Another unit of the modulus changes no ratio and no p value. */
    double a3[5], b3[4];
    for (int i = 0; i < 5; i++)
        a3[i] = 1e-3 * a[i];
    for (int i = 0; i < 4; i++)
        b3[i] = 1e-3 * b[i];
    wt_group bulk3 = {.modulus = a3, .n = 5}, track3 = {.modulus = b3, .n = 4};
    assert_int_equal(wt_compare_moduli(&bulk3, &track3, NULL, &d, NULL), WT_OK);
    assert_near(d.ratio, c.ratio, 1e-13);
    assert_near(d.ratio_high, c.ratio_high, 1e-12);
    assert_near(d.p, c.p, 1e-10);
    assert_near(d.mann_whitney_p, c.mann_whitney_p, 1e-14);
}

/* The exact distribution against an enumeration of all rankings, and the approximation near it. */
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
    assert_int_equal(wt_compare_moduli(&a, &b, NULL, &c, NULL), WT_OK);
    double tail = 0.0;
    assert_near(c.mann_whitney_u, 9.0, 0.0);
    for (int u = 0; u <= 9; u++)
        tail += count[u];
    assert_true(c.mann_whitney_exact);
    assert_near(c.mann_whitney_p, 2.0 * tail / total, 1e-14);

    /* 26 and 26 units are too many for exact counts, 25 and 25 are not. Both find the same
     * shift. */
    double x[26], y[26];
    for (int i = 0; i < 26; i++) {
        x[i] = 10.0 + i + 0.01 * (i * 7 % 26);
        y[i] = 14.3 + i + 0.01 * (i * 11 % 26);
    }
    wt_group p = {.modulus = x, .n = 25}, q = {.modulus = y, .n = 25};
    assert_int_equal(wt_compare_moduli(&p, &q, NULL, &c, NULL), WT_OK);
    assert_true(c.mann_whitney_exact);
    double exact = c.mann_whitney_p;
    double mean = 312.5, sd = sqrt(25.0 * 25.0 * 51.0 / 12.0);
    assert_near(exact, erfc((c.mann_whitney_u - mean - 0.5) / sd / M_SQRT2), 0.05);
    p.n = q.n = 26;
    assert_int_equal(wt_compare_moduli(&p, &q, NULL, &c, NULL), WT_OK);
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
    /* t with 2 degrees of freedom: 4.302652729749462 */
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

/* Pull-offs and lack of fit by position; p values of two tests; a tip of another radius. */
static void signs(void **state)
{
    (void)state;
    const double bulk[] = {1, 3, 2, 2, (double)NAN, 1.5, 2.5, 2}, none[] = {0, 0, 0},
                 some[] = {1, 1, 1};
    const double track[] = {5, 7, 5.5, 6.5, 6, 6.1};
    const long at[] = {1, 1, 2, 2, 2, 3, 3, 4}, of[] = {1, 1, 2, 2, 3, 3};
    wt_mean_comparison c;
    const double *const values[2] = {bulk, track};
    const long *const spots[2] = {at, of};
    const size_t n[2] = {8, 6};
    c = wt_compare_means(values, spots, n);
    assert_near(c.mean[0], 2, 1e-12);
    assert_near(c.mean[1], (6 + 6 + 6.05) / 3, 1e-12);
    assert_true(c.larger_p[1] < 1e-4 && c.larger_p[0] > 0.999);
    const double *const flat[2] = {none, some};
    const long *const no_spots[2] = {NULL, NULL};
    const size_t three[2] = {3, 3}, one[2] = {1, 3};
    c = wt_compare_means(flat, no_spots, three);
    assert_true(c.larger_p[1] == 0 && c.larger_p[0] == 1);
    c = wt_compare_means(flat, no_spots, one);
    assert_true(isnan(c.larger_p[1]) && c.mean[0] == 0 && c.mean[1] == 1);
    /* -2 ln(0.05^2) = 11.98 of chi^2 with 4 degrees */
    assert_near(wt_combined_p_value(0.05, 0.05), 0.0174786613677699, 1e-12);
    assert_near(wt_combined_p_value(0.3, (double)NAN), 0.3, 0);
    /* By an independent fit with baseline and cantilever (0.5 N/m, 5 MPa, 70 nm deep): 0.238,
     * 0.661. */
    wt_tip tip;
    wt_tip_wear worn;
    assert_int_equal(wt_tip_parse("pyramid:half-angle=35deg,radius=20nm", &tip, NULL), WT_OK);
    assert_int_equal(wt_tip_wear_fit(&tip, 40e-9, 70e-9, 0, &worn, NULL), WT_OK);
    assert_near(worn.log_modulus, 0.238, 0.05);
    assert_near(worn.misfit, 0.0112, 0.06);
    assert_int_equal(wt_tip_wear_fit(&tip, 80e-9, 70e-9, 0, &worn, NULL), WT_OK);
    assert_near(worn.log_modulus, 0.661, 0.02);
    assert_int_equal(wt_tip_wear_fit(&tip, 20e-9, 70e-9, 50e-9, &worn, NULL), WT_OK);
    assert_true(fabs(worn.log_modulus) < 1e-5 && worn.misfit < 1e-5);
}

static void groups_without_result(void **state)
{
    (void)state;
    const double good[] = {1e6, 2e6, 3e6}, bad[] = {1e6, -2e6}, equal[] = {1e6, 1e6};
    const double gap[] = {1e6, (double)NAN};
    const long one_spot[] = {4, 4, 4}, spots[] = {1, 2, 2};
    wt_error err = WT_ERROR_INIT;
    wt_comparison c;
    wt_group_summary s;
    wt_group a = {.modulus = good, .n = 3}, empty = {.modulus = NULL, .n = 0, .n_rejected = 5},
             single = {.modulus = good, .n = 1}, pair = {.modulus = good, .n = 2};
    wt_group negative = {.modulus = bad, .n = 2}, missing = {.modulus = gap, .n = 2},
             same = {.modulus = equal, .n = 2};
    wt_group spot = {.modulus = good, .spot = one_spot, .n = 3},
             two = {.modulus = good, .spot = spots, .n = 3};
    assert_int_equal(wt_group_summarise(&empty, &s, NULL), WT_E_EMPTY);
    assert_int_equal(wt_compare_moduli(&a, &empty, NULL, &c, NULL), WT_E_EMPTY);
    /* One unit in one group and two in the other: a ratio, but no interval. */
    const wt_group *const alone[][2] = {{&pair, &single}, {&spot, &two}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(wt_compare_moduli(alone[i][0], alone[i][1], NULL, &c, NULL), WT_OK);
        assert_int_equal(c.undecided_reason, WT_UNDECIDED_ONE_SPOT);
        assert_true(isfinite(c.ratio) && isnan(c.ratio_low) && isnan(c.ratio_high) && isnan(c.p));
    }
    /* Exception with a stated scatter of positions: a normal interval of one position and of
     * two. */
    wt_group lone = single, other[] = {single, pair};
    lone.spot_scatter = other[0].spot_scatter = other[1].spot_scatter = 0.2;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(wt_compare_moduli(&other[i], &lone, NULL, &c, NULL), WT_OK);
        assert_int_equal(c.undecided_reason, WT_UNDECIDED_NOT);
        assert_true(c.scatter_is_stated);
        assert_near(c.log_ratio.standard_error, 0.2 * sqrt(1 + (i == 0 ? 1 : 0.5)), 1e-12);
        assert_near(log(c.ratio_high / c.ratio), 1.959963984540054 * c.log_ratio.standard_error,
                    1e-9);
        assert_near(c.p, erfc(fabs(c.t) / sqrt(2)), 1e-12);
    }
    assert_int_equal(wt_group_summarise(&lone, &s, NULL), WT_OK);
    assert_near(log(s.high / s.low), 2 * 1.959963984540054 * 0.2, 1e-9);
    /* of both groups, */
    assert_int_equal(wt_compare_moduli(&single, &lone, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_ONE_SPOT);
    /* in addition to the scatter of the curves at a position */
    const double mean_3 = log(6) / 3;
    const double of_mean =
        (mean_3 * mean_3 + pow(log(2) - mean_3, 2) + pow(log(3) - mean_3, 2)) / 2 / 3;
    lone = (wt_group){.modulus = good, .spot = one_spot, .n = 1, .spot_scatter = 0.2};
    wt_group curves = spot;
    curves.spot_scatter = 0.1;
    assert_int_equal(wt_compare_moduli(&curves, &lone, NULL, &c, NULL), WT_OK);
    assert_near(c.log_ratio.standard_error, sqrt(0.01 + 0.04 + of_mean), 1e-12);
    /* which three positions determine themselves. */
    lone = a;
    lone.spot_scatter = 0.2;
    assert_int_equal(wt_compare_moduli(&lone, &single, NULL, &c, NULL), WT_OK);
    assert_false(c.scatter_is_stated);
    /* The scatter of three is known, by Student's t with two degrees of freedom; that of the single
     * one may be twice as large. */
    const double mean = log(6) / 3,
                 scatter = sqrt((mean * mean + pow(log(2) - mean, 2) + pow(log(3) - mean, 2)) / 2);
    assert_int_equal(wt_compare_moduli(&a, &single, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_NOT);
    assert_near(log(c.ratio), -mean, 1e-12);
    assert_near(log(c.ratio_high / c.ratio_low),
                2 * 4.302652729911275 * scatter * sqrt(1.0 / 3 + 4), 1e-9);
    assert_int_equal(wt_compare_moduli(&negative, &a, NULL, &c, &err), WT_E_RANGE);
    assert_non_null(strstr(err.place, "2 of 2"));
    assert_int_equal(wt_compare_moduli(&missing, &a, NULL, &c, NULL), WT_E_RANGE);
    assert_int_equal(wt_compare_moduli(&same, &same, NULL, &c, NULL), WT_E_RANGE);
    /* Positions in one group only: curves are compared, and the result states it. */
    assert_int_equal(wt_compare_moduli(&spot, &a, NULL, &c, NULL), WT_OK);
    assert_false(c.by_spot);
}

/* ---- rates ----------------------------------------------------------------------------------- */

enum { SPOTS = 4 };

/* Two rates per position in each group; ln E = level + slope ln rate + position + a small effect of
 * the cell. */
typedef struct two_rates {
    double modulus[2 * SPOTS], rate[2 * SPOTS];
    long spot[2 * SPOTS], rate_class[2 * SPOTS];
    wt_group group;
} two_rates;

static const double at[] = {1e-7, 1e-6, 1e-5, 1e-4};
static const double place[SPOTS] = {-0.05, 0.02, 0.06, -0.03}; /* their mean is 0 */
static const double own[SPOTS] = {0.004, -0.003, 0.001, -0.002};

static void make_rates(two_rates *g, double level, double slope, int first)
{
    for (int i = 0; i < 2 * SPOTS; i++) {
        const int spot = i / 2, r = first + i % 2;
        g->spot[i] = spot;
        g->rate_class[i] = r;
        g->rate[i] = at[r];
        g->modulus[i] = 1e6 * exp(level + slope * log(at[r] / 1e-6) + place[spot] +
                                  (i % 2 == 0 ? own[spot] : -own[spot]));
    }
    g->group = (wt_group){.modulus = g->modulus,
                          .spot = g->spot,
                          .rate = g->rate,
                          .rate_class = g->rate_class,
                          .n = 2 * SPOTS};
}

/* A rate in one group only is excluded; the slope cancels for common rates. */
static void rates_in_common(void **state)
{
    (void)state;
    two_rates a, b;
    wt_comparison c;
    make_rates(&a, 0, 0.3, 0);
    make_rates(&b, log(0.5), 0.3, 1);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.rate_matching, WT_RATES_COMMON);
    assert_int_equal(c.curves_bulk, SPOTS);
    assert_int_equal(c.curves_track, SPOTS);
    assert_near(c.ratio, 0.5, 1e-12);
    /* without the rates the ratio is the change over a decade of rate, too */
    a.group.rate = b.group.rate = NULL;
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_near(c.ratio, 0.5 * exp(0.3 * log(10)), 1e-12);
}

/* Without a common rate the comparison uses the slope within the positions; its error enters with
 * the square of the distance of the rates. */
static void rates_by_slope(void **state)
{
    (void)state;
    two_rates a, b;
    wt_comparison c;
    make_rates(&a, 0, 0.15, 0);
    make_rates(&b, log(0.7), 0.15, 2);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_NOT);
    assert_int_equal(c.rate_matching, WT_RATES_WITHIN);
    assert_near(c.rate_slope.value, 0.15, 1e-9);
    assert_near(c.ratio, 0.7, 1e-9);
    double rest = 0, spots = 0;
    for (int i = 0; i < SPOTS; i++) {
        rest += 2 * 2 * own[i] * own[i]; /* two cells in each of two groups */
        spots += place[i] * place[i] / (SPOTS - 1);
    }
    const double step = log(10), df = 2 * SPOTS - 1;
    const double slope_error = sqrt(rest / df / (2 * SPOTS * step * step / 2));
    assert_near(c.rate_slope.standard_error, slope_error, 1e-9);
    assert_near(c.log_ratio.standard_error,
                sqrt(2 * spots / SPOTS + pow(2 * step * slope_error, 2)), 1e-9);
}

static void rates_without_information(void **state)
{
    (void)state;
    two_rates a, b;
    wt_comparison c;
    /* slopes that differ, and no common rate */
    make_rates(&a, 0, 0.15, 0);
    make_rates(&b, log(0.7), 0.25, 2);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_SLOPES_DIFFER);
    assert_true(c.interaction_p < 1e-4 && isnan(c.ratio_low));
    /* with common rates the ratio states the slopes, too */
    make_rates(&b, log(0.7), 0.25, 0);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_NOT);
    assert_true(c.interaction_p < 1e-4);
    make_rates(&b, log(0.7), 0.15, 0);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_true(c.interaction_p > 0.5);
    /* one rate in each group: the effect of the rate is unknown */
    make_rates(&b, log(0.7), 0.15, 2);
    for (int i = 0; i < 2 * SPOTS; i++) {
        a.rate_class[i] = 0;
        b.rate_class[i] = 3;
    }
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(c.undecided_reason, WT_UNDECIDED_NO_COMMON_RATE);
    assert_true(isnan(c.ratio) && isnan(c.p));
}

/* Each position has one rate: a line through the positions of each group, with one slope for
 * both. */
static void rates_between_spots(void **state)
{
    (void)state;
    enum { N = 6 };
    static const double y[2][N] = {{0.01, -0.02, 0.01, 0.31, 0.28, 0.31},
                                   {0.61, 0.58, 0.61, 0.91, 0.88, 0.91}};
    double modulus[2][N], rate[2][N];
    long spot[2][N], rate_class[2][N];
    wt_group g[2];
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < N; i++) {
            spot[k][i] = i;
            rate_class[k][i] = 2 * k + i / 3;
            rate[k][i] = exp((double)rate_class[k][i] * 2);
            modulus[k][i] = exp(y[k][i]);
        }
        g[k] = (wt_group){.modulus = modulus[k],
                          .spot = spot[k],
                          .rate = rate[k],
                          .rate_class = rate_class[k],
                          .n = N};
    }
    wt_comparison c;
    assert_int_equal(wt_compare_moduli(&g[0], &g[1], NULL, &c, NULL), WT_OK);
    assert_int_equal(c.rate_matching, WT_RATES_BETWEEN);
    /* slope 0.3/2 and 4 between the groups: nothing remains of the 0.6 */
    assert_near(c.log_ratio.value + 1, 1, 1e-12);
    assert_near(c.df, 2 * N - 3, 1e-12);
    const double variance = 4 * 6e-4 / (2 * N - 3), xx = 2 * N;
    assert_near(c.log_ratio.standard_error, sqrt(variance * (2.0 / N + 16 / xx)), 1e-9);
}

/* A known difference is subtracted, with a normal error. */
static void known_offset(void **state)
{
    (void)state;
    two_rates a, b;
    wt_comparison c, d;
    make_rates(&a, 0, 0.1, 0);
    make_rates(&b, log(0.8), 0.1, 0);
    const wt_estimate offset = {log(0.9), 0.2, 0, "1"};
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, NULL, &c, NULL), WT_OK);
    assert_int_equal(wt_compare_moduli(&a.group, &b.group, &offset, &d, NULL), WT_OK);
    assert_near(d.ratio, c.ratio / 0.9, 1e-12);
    assert_near(d.log_ratio.standard_error, hypot(c.log_ratio.standard_error, 0.2), 1e-12);
    assert_near(d.df, c.df * pow(d.log_ratio.standard_error / c.log_ratio.standard_error, 4), 1e-9);
    assert_near(d.offset_variance_share, pow(0.2 / d.log_ratio.standard_error, 2), 1e-12);
}

/* Two units that agree by chance do not make the interval narrow. */
static void two_units_and_more(void **state)
{
    (void)state;
    const double two[] = {1.0e6, 1.0001e6}, more[] = {0.9e6, 1.0e6, 1.1e6, 0.95e6, 1.05e6, 1.0e6};
    wt_group a = {.modulus = two, .n = 2}, b = {.modulus = more, .n = 6};
    wt_comparison c;
    assert_int_equal(wt_compare_moduli(&a, &b, NULL, &c, NULL), WT_OK);
    double mean = 0, sum = 0;
    for (int i = 0; i < 6; i++)
        mean += log(more[i]) / 6;
    for (int i = 0; i < 6; i++)
        sum += pow(log(more[i]) - mean, 2);
    sum += pow(log(1.0001), 2) / 2;
    assert_near(c.log_ratio.standard_error, sqrt(sum / 6 * (1.0 / 2 + 1.0 / 6)), 1e-9);
    assert_near(c.df, 6, 1e-9);
    /* 2 of the 28 rankings of 2 among 8 are as extreme as possible */
    assert_near(c.mann_whitney_smallest_p, 2.0 / 28, 1e-12);
}

/* As in the theory text: scatter 6 %, ratio 0.8: 3 positions; 15 %: 8 or 9; none if the ratio is
 * nearly 1. */
static void spots_needed(void **state)
{
    (void)state;
    assert_int_equal(wt_required_spots(log(0.8), 0.06), 3);
    assert_in_range(wt_required_spots(log(0.8), 0.15), 8, 9);
    assert_int_equal(wt_required_spots(-log(0.8), 0.15), wt_required_spots(log(0.8), 0.15));
    assert_int_equal(wt_required_spots(1e-3, 0.15), 0);
}

static void holm(void **state)
{
    (void)state;
    /* Ordered: 0.01 * 4, 0.02 * 3, 0.03 * 2, 0.04 * 1 -> 0.04, 0.06, 0.06, 0.06. */
    const double p[] = {0.04, 0.01, (double)NAN, 0.03, 0.02};
    double adjusted[5];
    wt_holm_adjust(p, 5, adjusted);
    const double expected[] = {0.06, 0.04, (double)NAN, 0.06, 0.06};
    for (int i = 0; i < 5; i++)
        assert_near(adjusted[i], expected[i], 1e-14);
    const double large[] = {0.5, 0.5, 0.9};
    wt_holm_adjust(large, 3, adjusted);
    for (int i = 0; i < 3; i++)
        assert_near(adjusted[i], 1.0, 0.0);
    wt_holm_adjust(NULL, 0, NULL);
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
        cmocka_unit_test(groups_without_result),
        cmocka_unit_test(signs),
        cmocka_unit_test(rates_in_common),
        cmocka_unit_test(rates_by_slope),
        cmocka_unit_test(rates_without_information),
        cmocka_unit_test(rates_between_spots),
        cmocka_unit_test(known_offset),
        cmocka_unit_test(two_units_and_more),
        cmocka_unit_test(spots_needed),
        cmocka_unit_test(holm),
        cmocka_unit_test(equivalent_frequency),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
