/* An exponential running-in with another time and height in a series of cycles; its intervals are
 * tested against the truth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "truth_fixture.h"

#include "record/numerics/running_in_curve.h"

#include <math.h>

enum { TIMES = 200, CYCLES = 200, WITHIN = 400 };
static const double first = 1e-3, last = 1e3, fraction = 0.05;
static double values[TIMES];

/* From `height` to 0 by exp(-t). */
static running_in_curve exponential(double height)
{
    const double step = log(last / first) / (TIMES - 1);
    for (int i = 0; i < TIMES; i++)
        values[i] = height * exp(-first * exp(step * i));
    return (running_in_curve){TIMES, log(first), step, values};
}

/* Cycles of `each` times the time constant, with white and slow scatter. */
typedef struct scene {
    double factor, ratio, each, white, slow;
} scene;

static running_in_series series_of(const scene *s, const running_in_curve *c, uint64_t *seed)
{
    const double memory = exp(-1 / 8.0);
    running_in_series made = running_in_series_alloc(CYCLES);
    double slow = truth_normal(seed);
    for (size_t i = 0; i < CYCLES; i++)
        made.end[i] = s->each * (double)(i + 1);
    for (size_t i = 0; i < CYCLES; i++) {
        double mean = 0;
        for (int k = 0; k < WITHIN; k++) {
            const double time = s->each * ((double)i + (k + 0.5) / WITHIN);
            mean += running_in_curve_at(c, log(time / s->factor)) / WITHIN;
        }
        slow = memory * slow + sqrt(1 - memory * memory) * truth_normal(seed);
        made.friction[i] = 0.5 + s->ratio * mean + s->white * truth_normal(seed) + s->slow * slow;
    }
    return made;
}

static running_in_curve_fit fitted(const scene *s, double height, uint64_t *seed)
{
    const running_in_curve c = exponential(height);
    running_in_series made = series_of(s, &c, seed);
    running_in_curve_fit fit;
    assert_int_equal(running_in_curve_fit_compute(&(running_in_curve_pair){&made, &c}, 1, fraction,
                                                  0.1, &fit, NULL),
                     WT_OK);
    running_in_series_clear(&made);
    return fit;
}

/* e^-3 = 0.05. */
static void test_running_in_curve(void **state)
{
    (void)state;
    const running_in_curve c = exponential(-0.2);
    assert_near(running_in_curve_settling_time(&c, fraction), log(1 / fraction), 5e-3);
    assert_near(running_in_curve_height(&c), 0.2, 1e-3);
    assert_near(running_in_curve_at(&c, 0), -0.2 * exp(-1), 1e-3);
    assert_true(running_in_curve_at(&c, log(2 * last)) == 0);
    assert_true(isnan(running_in_curve_settling_time(&c, 0)));
}

/* Without scatter the factor and the ratio are the true ones. */
static void test_exact(void **state)
{
    (void)state;
    static const scene scenes[] = {
        {1, 1, 0.05, 1e-6, 0}, {2.5, 0.4, 0.1, 1e-6, 0}, {0.3, -1.5, 0.05, 1e-6, 0}};
    uint64_t seed = 11;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        const running_in_curve_fit fit = fitted(&scenes[i], 0.2, &seed);
        assert_true(fit.seen);
        assert_near(exp(fit.log_factor), scenes[i].factor, 2e-3);
        assert_near(fit.ratio, scenes[i].ratio, 2e-3);
    }
}

/* Result of one law for a running-in that is twice as slow: half the factor. */
static void test_slower_running_in(void **state)
{
    (void)state;
    const scene s = {2, 1, 0.1, 1e-5, 0};
    uint64_t seed = 5;
    const running_in_curve c = exponential(0.2);
    running_in_series made = series_of(&s, &c, &seed);
    running_in_curve slower = c;
    slower.log_first += log(2);
    const scatter_law law = {0.5, 0.2};
    const running_in_optimum place = running_in_optimum_find(&made, &slower, law, 0.1, 0.5),
                             held = running_in_optimum_find(&made, &c, law, log(2), 0);
    assert_near_abs(place.log_factor, 0, 1e-2);
    assert_near(place.ratio, 1, 1e-2);
    assert_true(held.log_factor == log(2));
    assert_near(held.ratio, 1, 1e-2);
    running_in_series_clear(&made);
}

/* A running-in at a third of the time only fits outside a margin of 2, one at 0.7 of it within. */
static void test_within_margin(void **state)
{
    (void)state;
    static const double factors[2] = {3, 0.7};
    const running_in_curve c = exponential(0.2);
    for (int i = 0; i < 2; i++) {
        const scene s = {factors[i], 1.2, 0.05, 0.01, 0};
        uint64_t seed = 8;
        running_in_series made = series_of(&s, &c, &seed);
        const running_in_likelihoods l =
            running_in_likelihoods_find(&made, &c, (scatter_law){0.5, 0}, log(factors[i]), 2);
        assert_true(isfinite(l.any));
        assert_true(i == 0 ? l.within < l.any - 20 : l.within > l.any - 1);
        running_in_series_clear(&made);
    }
}

/* All of the change is within the first cycle, whose mean still counts. */
static void test_first_cycle(void **state)
{
    (void)state;
    const scene s = {1, 1, 10, 1e-7, 0};
    uint64_t seed = 6;
    const running_in_curve c = exponential(0.2);
    running_in_series made = series_of(&s, &c, &seed);
    const running_in_optimum held =
        running_in_optimum_find(&made, &c, (scatter_law){0.5, 0.2}, 0, 0);
    assert_near(held.ratio, 1, 2e-4);
    running_in_series_clear(&made);
}

static void test_short_records(void **state)
{
    (void)state;
    uint64_t seed = 3;
    const scene flat = {1, 0, 0.05, 0.01, 0}, brief = {1, 1, 0.004, 0.01, 0},
                quick = {1, 1, 20, 0.002, 0};
    running_in_curve_fit fit = fitted(&flat, 0.2, &seed);
    assert_false(fit.seen);
    assert_true(isnan(fit.log_factor));
    assert_true(fabs(fit.ratio) < 3 * fit.ratio_error && fit.ratio_error < 0.1);
    fit = fitted(&brief, 0.2, &seed); /* a quarter of the way alone */
    assert_true(!fit.seen || isnan(fit.high));
    fit = fitted(&quick, 0.2, &seed); /* over in the first cycle */
    assert_true(!fit.seen || isnan(fit.low));
}

/* Number of 95 % intervals that contain the truth, within chance (1 in 10000). */
static void test_coverage(void **state)
{
    (void)state;
    enum { DRAWS = DRAW_COUNT(60), LEAST = 50 };
    const scene s = {1.7, 0.8, 0.08, 0.02, 0.01};
    uint64_t seed = 20;
    int factor = 0, ratio = 0;
    for (int i = 0; i < DRAWS; i++) {
        const running_in_curve_fit fit = fitted(&s, 0.2, &seed);
        assert_true(fit.seen);
        factor += fit.low < log(s.factor) && log(s.factor) < fit.high;
        ratio += fabs(fit.ratio - s.ratio) < 1.96 * fit.ratio_error;
    }
    if (!TEST_RATES)
        return;
    assert_in_range(factor, LEAST, DRAWS);
    assert_in_range(ratio, LEAST, DRAWS);
}

/* ---- growth after an incubation, in rows of every kind --------------------------------------- */

/* Kind of a row: the mean of the time after its label, about it or before it, or an instant. */
typedef enum row_kind { ROW_FROM, ROW_ABOUT, ROW_UNTIL, ROW_AT, ROW_KINDS } row_kind;

/* The bare surface until the end of the incubation, then a layer with an exponential effect. */
typedef struct growing {
    double incubation, drop, bare, time;
} growing;

static double growing_at(const growing *g, double t)
{
    return t < g->incubation ? g->bare : g->drop * exp(-(t - g->incubation) / g->time);
}

static double growing_mean(const growing *g, double from, double to)
{
    double sum = 0;
    for (int k = 0; k < WITHIN; k++)
        sum += growing_at(g, from + (to - from) * (k + 0.5) / WITHIN);
    return sum / WITHIN;
}

static running_in_curve growing_curve(const growing *g)
{
    static double grown[3 * TIMES];
    const double step = log(1e5) / (3 * TIMES - 1);
    for (int i = 0; i < 3 * TIMES; i++)
        grown[i] = growing_at(g, 1e-2 * exp(step * i));
    return (running_in_curve){3 * TIMES, log(1e-2), step, grown};
}

/* Rows as assumed: means about their labels, but the first of instants is excluded. `each`: time of
 * a row; `noise`: that of its friction. */
static running_in_series rows_of(const growing *g, row_kind kind, double each, double noise,
                                 uint64_t *seed)
{
    running_in_series made = running_in_series_alloc(CYCLES);
    const size_t skipped = kind == ROW_FROM || kind == ROW_AT;
    made.unsure = 0.5 * each;
    made.begin = skipped ? 0.5 * each : 0;
    for (size_t i = 0; i < CYCLES; i++) {
        const double from = each * (double)(i + skipped),
                     at = from + (kind == ROW_UNTIL ? each : 0);
        made.end[i] = made.begin + each * (double)(i + 1);
        made.friction[i] =
            0.5 + noise * truth_normal(seed) +
            (kind == ROW_AT ? growing_at(g, at) : growing_mean(g, from, from + each));
    }
    return made;
}

static double uniform(uint64_t *seed)
{
    return 0.5 * erfc(truth_normal(seed) / sqrt(2.0));
}

/* The interval contains the true factor of the time in 92 to 98 % of draws, within chance, for
 * every kind of rows, with and without incubation. The seeds are printed. */
static void test_rows(void **state)
{
    (void)state;
    enum { DRAWS = DRAW_COUNT(14), ALL = 2 * ROW_KINDS * DRAWS, LEAST = ALL * 90 / 100 };
    uint64_t seed = 77;
    int held = 0, seen = 0;
    for (int i = 0; i < ALL; i++) {
        const bool incubates = i % 2;
        const growing truth = {incubates ? 3 + 20 * uniform(&seed) : 0, -0.3, 0.05,
                               30 + 60 * uniform(&seed)};
        const double factor = 0.7 + uniform(&seed);
        const growing theory = {truth.incubation / factor, truth.drop, truth.bare,
                                truth.time / factor};
        const running_in_curve c = growing_curve(&theory);
        running_in_series made = rows_of(&truth, (row_kind)(i / 2 % ROW_KINDS), 10, 0.02, &seed);
        running_in_curve_fit fit;
        assert_int_equal(running_in_curve_fit_compute(&(running_in_curve_pair){&made, &c}, 1,
                                                      fraction, 0.1, &fit, NULL),
                         WT_OK);
        running_in_series_clear(&made);
        seen += fit.seen;
        const bool holds = !(fit.low > log(factor)) && !(fit.high < log(factor));
        held += holds;
        if (!holds)
            print_message("rows %d, draw %d of seed 77: factor %.3g, found %.3g (%.3g to %.3g)\n",
                          i / 2 % ROW_KINDS, i, factor, exp(fit.log_factor), exp(fit.low),
                          exp(fit.high));
    }
    print_message("seed 77: %d of %d held, %d seen\n", held, (int)ALL, seen);
    if (!TEST_RATES)
        return;
    assert_in_range(held, LEAST, ALL);
    assert_in_range(seen, ALL * 95 / 100, ALL);
}

static void test_refused(void **state)
{
    (void)state;
    const running_in_curve c = exponential(0.2), none = exponential(0);
    running_in_series made = running_in_series_alloc(RUNNING_IN_CURVE_MIN_MEANS - 1);
    running_in_curve_fit fit;
    assert_int_equal(running_in_curve_fit_compute(&(running_in_curve_pair){&made, &c}, 1, fraction,
                                                  0.1, &fit, NULL),
                     WT_E_RANGE);
    running_in_series_clear(&made);
    uint64_t seed = 1;
    const scene s = {1, 1, 0.05, 0.01, 0};
    made = series_of(&s, &none, &seed);
    assert_int_equal(running_in_curve_fit_compute(&(running_in_curve_pair){&made, &none}, 1,
                                                  fraction, 0.1, &fit, NULL),
                     WT_E_RANGE);
    running_in_series_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_running_in_curve),  cmocka_unit_test(test_exact),
        cmocka_unit_test(test_slower_running_in), cmocka_unit_test(test_first_cycle),
        cmocka_unit_test(test_within_margin),     cmocka_unit_test(test_short_records),
        cmocka_unit_test(test_coverage),          cmocka_unit_test(test_rows),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests_name("fit course", tests, NULL, NULL);
}
