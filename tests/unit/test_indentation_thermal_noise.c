/* Thermal noise: the truth is recovered and covered by the intervals, for sharp and broad peaks,
 * few and many averages, with and without a window. A spectrum that is not an oscillator is
 * detected.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "weartrack/indentation.h"

#include "dma_data.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = 4000, DRAWS = DRAW_COUNT(400) };
static const double pi = 3.14159265358979323846;

typedef struct scene {
    double f0, q, floor; /* of the peak */
    size_t n, averages;
    double step;
    bool window;  /* a Hann window correlates neighbours */
    double other; /* height of a second peak, relative to the first */
} scene;

static double truth(const scene *s, double f)
{
    const double x = f / s->f0, y = f / (1.05 * s->f0), q2 = s->q * s->q;
    const double peak = 2 / (pi * s->f0 * s->q);
    return peak / ((1 - x * x) * (1 - x * x) + x * x / q2) +
           s->other * peak / ((1 - y * y) * (1 - y * y) + y * y / q2) + s->floor * peak * q2;
}

/* Means of squared complex normal amplitudes; a window mixes these before. */
static wt_thermal drawn(const scene *s, uint64_t *seed)
{
    static double f[MOST], p[MOST], re[MOST + 2], im[MOST + 2];
    const size_t n = s->n < MOST ? s->n : MOST;
    wt_thermal t;
    for (size_t i = 0; i < n; i++) {
        f[i] = s->step * (double)i;
        p[i] = 0;
    }
    for (size_t k = 0; k < s->averages; k++) {
        for (size_t i = 0; i < n + 2; i++) {
            re[i] = dma_normal(seed);
            im[i] = dma_normal(seed);
        }
        for (size_t i = 0; i < n; i++) {
            const double a =
                s->window ? (re[i + 1] - 0.5 * (re[i] + re[i + 2])) / sqrt(1.5) : re[i + 1];
            const double b =
                s->window ? (im[i + 1] - 0.5 * (im[i] + im[i + 2])) / sqrt(1.5) : im[i + 1];
            p[i] += truth(s, f[i]) * (a * a + b * b) / (2 * (double)s->averages);
        }
    }
    assert_int_equal(wt_thermal_fit(f, p, n, (double)NAN, (double)NAN, &t, NULL), WT_OK);
    return t;
}

static void test_truth(void **state)
{
    (void)state;
    static double f[MOST], p[MOST];
    const scene s = {.f0 = 30e3, .q = 80, .floor = 1e-4, .n = 4000, .step = 25};
    wt_thermal t;
    for (size_t i = 0; i < s.n; i++) {
        f[i] = s.step * (double)i;
        p[i] = truth(&s, f[i]);
    }
    assert_int_equal(wt_thermal_fit(f, p, s.n, (double)NAN, (double)NAN, &t, NULL), WT_OK);
    assert_true(t.found);
    assert_near(t.mean_square.value, 1, 1e-6);
    assert_near(t.resonance.value, 30e3, 1e-9);
    assert_near(t.quality.value, 80, 1e-6);
    assert_near(t.floor, truth(&s, 1e9), 1e-4);
    /* the mean square is the area of the peak: sums of the law without its floor */
    double sum = 0;
    for (double x = 0.5; x < 4e6; x++) {
        const double y = x / 30e3;
        sum += 2 / (pi * 30e3 * 80) / ((1 - y * y) * (1 - y * y) + y * y / 6400);
    }
    assert_near(sum, 1, 1e-4);
    assert_int_equal(wt_thermal_fit(f, p, s.n, 20e3, 40e3, &t, NULL), WT_OK);
    assert_near(t.mean_square.value, 1, 1e-6);
    assert_near(t.from, 20e3, 0);
    assert_int_equal(wt_thermal_fit(f, p, s.n, 40e3, 60e3, &t, NULL), WT_OK);
    assert_false(t.found);
    assert_string_equal(t.reason, "the largest peak lies outside of the range of the fit");
    assert_int_equal(wt_thermal_fit(f, p, 10, (double)NAN, (double)NAN, &t, NULL), WT_OK);
    assert_string_equal(t.reason, "too few points");
}

static void test_coverage(void **state)
{
    (void)state;
    static const scene scenes[] = {
        {.f0 = 70e3, .q = 200, .floor = 1e-4, .n = 1200, .averages = 100, .step = 100},
        {.f0 = 70e3,
         .q = 200,
         .floor = 1e-4,
         .n = 1200,
         .averages = 20,
         .step = 100,
         .window = true},
        {.f0 = 12e3, .q = 3, .floor = 0.02, .n = 800, .averages = 50, .step = 60},
        {.f0 = 12e3, .q = 3, .floor = 0.02, .n = 800, .averages = 10, .step = 60, .window = true}};
    uint64_t seed = 21;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        const scene *s = &scenes[k];
        int square = 0, quality = 0, resonance = 0, alarms = 0;
        for (int i = 0; i < DRAWS; i++) {
            const wt_thermal t = drawn(s, &seed);
            assert_true(t.found);
            square += t.mean_square.low < 1 && t.mean_square.high > 1;
            quality += t.quality.low < s->q && t.quality.high > s->q;
            resonance += t.resonance.low < s->f0 && t.resonance.high > s->f0;
            alarms += t.misfit_p < 0.01;
        }
        print_message("Q %g, %zu averages%s: mean square %.3f, Q %.3f, f0 %.3f, alarms %.3f\n",
                      s->q, s->averages, s->window ? ", window" : "", square / (double)DRAWS,
                      quality / (double)DRAWS, resonance / (double)DRAWS, alarms / (double)DRAWS);
        if (!TEST_RATES)
            continue;
        assert_in_range(square, 0.92 * DRAWS, 0.98 * DRAWS);
        assert_in_range(quality, 0.92 * DRAWS, 0.98 * DRAWS);
        assert_in_range(resonance, 0.92 * DRAWS, 0.98 * DRAWS);
        assert_true(alarms < 0.05 * DRAWS);
    }
}

/* The scatter determines the number of averages, and a second peak shows that this is not a single
 * oscillator. */
static void test_misfit(void **state)
{
    (void)state;
    scene s = {.f0 = 70e3, .q = 200, .floor = 1e-4, .n = 1200, .averages = 100, .step = 100};
    uint64_t seed = 22;
    assert_near(drawn(&s, &seed).averages, 100, 0.2);
    s.other = 0.3;
    assert_true(drawn(&s, &seed).misfit_p < 1e-6);
}

/* Values by the power series of the Bessel functions; cantilevers of table 1 of Sader, Chon and
 * Mulvaney 1999, the first with 0.157 N/m. */
static void test_sader(void **state)
{
    (void)state;
    static const double gamma[][3] = {{0.01, 41.643048409891676, 140.65737551031637},
                                      {0.1, 10.484879689242149, 21.827531221369203},
                                      {1, 3.7339594930468185, 4.074610833672525},
                                      {10, 1.9183181062502703, 0.981621970168545},
                                      {30, 1.5585699550440055, 0.5424380465733218}};
    static const double levers[][5] = {{397e-6, 29e-6, 17.36e3, 55.5, 0.1573065202661381},
                                       {197e-6, 29e-6, 69.87e3, 136, 1.3034645388562758},
                                       {77e-6, 20e-6, 64.26e3, 60.3, 0.15014736040721197}};
    const wt_fluid air = {1.18, 1.86e-5};
    for (size_t i = 0; i < sizeof gamma / sizeof *gamma; i++) {
        double real, imaginary;
        wt_hydrodynamic_function(gamma[i][0], &real, &imaginary);
        assert_near(real, gamma[i][1], 1e-11);
        assert_near(imaginary, gamma[i][2], 1e-11);
    }
    for (size_t i = 0; i < sizeof levers / sizeof *levers; i++) {
        const double *l = levers[i];
        const wt_estimate length = {l[0], 0, 0, "m"}, width = {l[1], 0, 0, "m"},
                          f = {l[2], 0, 0, "Hz"}, q = {l[3], 0, 0, "1"};
        assert_near(wt_sader_spring_constant(length, width, f, q, air).value, l[4], 1e-10);
    }
    /* Errors: those of length and quality directly, that of the width by its effect. */
    const wt_estimate length = {397e-6, 397e-8, 0, "m"}, width = {29e-6, 29e-8, 0, "m"},
                      wider = {29.29e-6, 0, 0, "m"}, f = {17.36e3, 0, 0, "Hz"},
                      q = {55.5, 0.555, 0, "1"};
    const wt_estimate k = wt_sader_spring_constant(length, width, f, q, air),
                      other = wt_sader_spring_constant(length, wider, f, q, air);
    const double compare_widths = other.value / k.value - 1;
    assert_near(k.standard_error / k.value, sqrt(2e-4 + compare_widths * compare_widths), 0.01);
    /* air and water of the tables */
    assert_near(wt_medium_properties(WT_MEDIUM_AIR, 298.15).density, 1.184, 0.002);
    assert_near(wt_medium_properties(WT_MEDIUM_AIR, 298.15).viscosity, 1.845e-5, 0.01);
    assert_near(wt_medium_properties(WT_MEDIUM_WATER, 298.15).density, 997.047, 1e-5);
    assert_near(wt_medium_properties(WT_MEDIUM_WATER, 298.15).viscosity, 890.0e-6, 1e-3);
    assert_true(isnan(wt_medium_properties(WT_MEDIUM_WATER, 260).density));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_truth),
                                       cmocka_unit_test(test_coverage),
                                       cmocka_unit_test(test_misfit), cmocka_unit_test(test_sader)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
