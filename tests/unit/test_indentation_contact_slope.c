/* Slope in contact: known hard surfaces, coverage of the intervals, detection of soft surfaces.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "weartrack/indentation.h"

#include "dma_data.h"

#include <gsl/gsl_cdf.h>
#include <locale.h>
#include <math.h>

enum { MOST = 4000, DRAWS = DRAW_COUNT(600) };

/* Independent of the library: a cantilever of sensitivity s on a surface into which a sphere sinks
 * by `give` times deflection^(2/3). */
typedef struct drawn_curve {
    double sensitivity; /* m/V */
    double give;        /* indentation over deflection at the end */
    double tilt, noise, memory, saturation;
    double free; /* travel before contact [m]; 0: 300 nm */
    size_t n;
    bool out, falling; /* retract; heights fall towards the sample */
} drawn_curve;

static const double end_volts = 1.5;

static double volts_at(const drawn_curve *c, double travel)
{
    double low = 0, high = 4 * end_volts;
    for (int i = 0; i < 80; i++) {
        const double v = 0.5 * (low + high);
        const double sinks = c->give * end_volts * pow(v / end_volts, 2.0 / 3);
        if (c->sensitivity * (v + sinks) < travel)
            low = v;
        else
            high = v;
    }
    return low * (1 - c->saturation * low / end_volts);
}

static wt_contact_slope measured(const drawn_curve *c, uint64_t *state)
{
    static double z[MOST], v[MOST];
    const double press = c->sensitivity * end_volts * (1 + c->give);
    const double free_travel = c->free > 0 ? c->free : 300e-9;
    double noise = c->noise * dma_normal(state);
    wt_contact_slope slope;
    for (size_t i = 0; i < c->n; i++) {
        const double share = (double)i / (double)(c->n - 1);
        const double at = (c->out ? 1 - share : share) * (free_travel + press);
        noise = c->memory * noise + c->noise * sqrt(1 - c->memory * c->memory) * dma_normal(state);
        z[i] = c->falling ? 7e-6 - at : at;
        v[i] = 0.3 + c->tilt * at + noise;
        if (at > free_travel)
            v[i] += volts_at(c, at - free_travel);
    }
    assert_int_equal(wt_contact_slope_fit(z, v, c->n, NULL, &slope, NULL), WT_OK);
    return slope;
}

static void test_truth(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 8; i++) {
        const drawn_curve c = {.sensitivity = 45e-9,
                               .tilt = 1e5 * (i % 2),
                               .n = 2000,
                               .out = i / 2 % 2,
                               .falling = i / 4};
        const wt_contact_slope s = measured(&c, &seed);
        assert_true(s.found);
        assert_near(1 / s.slope, 45e-9, 1e-9);
        assert_near_abs(s.change, 0, 1e-9);
        assert_near(s.signal_to - s.signal_from, 0.7 * (end_volts + c.tilt * 367.5e-9), 0.02);
    }
}

/* The contact of a sphere adds 2.42 times the change of the slope to the sensitivity, and more
 * where it is not small. */
static void test_soft(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (double give = 0.01; give < 0.3; give *= 2) {
        const drawn_curve c = {.sensitivity = 45e-9, .give = give, .n = 4000};
        const wt_contact_slope s = measured(&c, &seed);
        const double share = 1 / s.slope / c.sensitivity - 1;
        assert_true(share > 0.7 * give);
        print_message("give %g: share %g of the change\n", give, share / s.change);
        assert_near(share / s.change, 2.42 * (1 + 0.75 * give), 0.01);
    }
    const drawn_curve dull = {.sensitivity = 45e-9, .saturation = 0.1, .n = 2000};
    assert_true(measured(&dull, &seed).change < -0.1);
}

/* Interval of a single curve, with noise that is correlated over less than a block. */
static void test_within(void **state)
{
    (void)state;
    static const struct {
        double memory;
        size_t n;
        /* 90 nm: a baseline hardly longer than the part, with an equally uncertain tilt */
        double free;
    } cases[] = {{0, 400, 0}, {0, 4000, 0}, {0.8, 4000, 0}, {0, 4000, 90e-9}};
    uint64_t seed = 7;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double slope = 0, change = 0;
        for (int i = 0; i < DRAWS; i++) {
            const drawn_curve c = {.sensitivity = 45e-9,
                                   .noise = 0.01,
                                   .memory = cases[k].memory,
                                   .n = cases[k].n,
                                   .free = cases[k].free,
                                   .out = i % 2};
            const wt_contact_slope s = measured(&c, &seed);
            const double t = gsl_cdf_tdist_Pinv(0.975, s.df);
            assert_true(s.found);
            change += fabs(s.change) < t * s.change_error;
            slope += fabs(s.slope - 1 / 45e-9) < t * s.slope_error;
        }
        print_message("memory %g, %zu samples, %g m free: slope %.3f, change %.3f\n",
                      cases[k].memory, cases[k].n, cases[k].free, slope / DRAWS, change / DRAWS);
        if (!TEST_RATES)
            continue;
        assert_in_range((long)(1000 * change / DRAWS), 920, 980);
        assert_in_range((long)(1000 * slope / DRAWS), 920, 980);
    }
}

/* Curves that scatter, and files that scatter more: the interval of the mean contains the truth. */
static void test_between(void **state)
{
    (void)state;
    uint64_t seed = 11;
    static const struct {
        size_t files, curves;
        double between;
    } cases[] = {{1, 5, 0}, {1, 20, 0}, {4, 6, 0.01}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double held = 0;
        for (int i = 0; i < DRAWS; i++) {
            double values[64];
            long units[64];
            size_t n = 0, n_units = 0;
            for (size_t f = 0; f < cases[k].files; f++) {
                const double shift = cases[k].between * dma_normal(&seed);
                for (size_t j = 0; j < cases[k].curves; j++) {
                    const drawn_curve c = {.sensitivity =
                                               45e-9 * (1 + shift + 0.005 * dma_normal(&seed)),
                                           .tilt = 1e4 * dma_normal(&seed),
                                           .noise = 0.005,
                                           .n = 200};
                    values[n] = 1 / measured(&c, &seed).slope;
                    units[n++] = (long)f;
                }
            }
            const wt_interval mean = wt_student_mean(values, units, n, &n_units);
            assert_int_equal(n_units, cases[k].files < 3 ? n : cases[k].files);
            held += mean.low < 45e-9 && 45e-9 < mean.high;
        }
        print_message("%zu files of %zu curves: %.3f\n", cases[k].files, cases[k].curves,
                      held / DRAWS);
        if (!TEST_RATES)
            continue;
        assert_in_range((long)(1000 * held / DRAWS), 920, 980);
    }
}

static void test_nothing(void **state)
{
    (void)state;
    uint64_t seed = 5;
    double z[100], v[100];
    wt_contact_slope s;
    for (int i = 0; i < 100; i++) {
        z[i] = 1e-9 * i;
        v[i] = 0.01 * dma_normal(&seed);
    }
    assert_int_equal(wt_contact_slope_fit(z, v, 100, NULL, &s, NULL), WT_OK);
    assert_false(s.found);
    assert_string_equal(s.reason, "no contact: the signal rises by less than 20 times its noise");
    assert_int_equal(wt_contact_slope_fit(z, v, 10, NULL, &s, NULL), WT_OK);
    assert_string_equal(s.reason, "10 samples, at least 40 are needed");
    for (int i = 0; i < 100; i++)
        v[i] = i < 98 ? 0 : 1;
    assert_int_equal(wt_contact_slope_fit(z, v, 100, NULL, &s, NULL), WT_OK);
    assert_false(s.found);
    for (int i = 0; i < 100; i++)
        v[i] = i < 93 ? 0 : fmin(1, 0.3 + 0.15 * (i - 93));
    const bool german = setlocale(LC_NUMERIC, "de_DE.UTF-8") != NULL;
    assert_int_equal(wt_contact_slope_fit(z, v, 100, NULL, &s, NULL), WT_OK);
    assert_string_equal(s.reason,
                        "5 samples between 0.25 and 0.95 of the rise, at least 6 are needed");
    if (german)
        (void)setlocale(LC_NUMERIC, "C");
    double still[100] = {0};
    for (int i = 0; i < 100; i++)
        v[i] = i < 80 ? 0 : 0.05 * (i - 80);
    assert_int_equal(wt_contact_slope_fit(still, v, 100, NULL, &s, NULL), WT_OK);
    assert_string_equal(s.reason, "the signal does not rise with the piezo");
    for (int i = 0; i < 100; i++)
        v[i] = (double)NAN;
    assert_int_equal(wt_contact_slope_fit(z, v, 100, NULL, &s, NULL), WT_OK);
    assert_string_equal(s.reason, "0 samples, at least 40 are needed");
    wt_slope_options wrong = wt_slope_defaults();
    wrong.to = 0.1;
    assert_int_equal(wt_contact_slope_fit(z, v, 100, &wrong, &s, NULL), WT_E_RANGE);
    size_t n_units = 9;
    assert_true(isnan(wt_student_mean(z, NULL, 0, &n_units).value));
    assert_int_equal(n_units, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_truth), cmocka_unit_test(test_soft), cmocka_unit_test(test_within),
        cmocka_unit_test(test_between), cmocka_unit_test(test_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
