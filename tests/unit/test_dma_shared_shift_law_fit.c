/* One law for several samples, on isotherms of known truth: a fractional Zener solid in closed
 * form, moved along frequency by its law, with noise in the moduli and errors of the temperatures.
 * The truth shares no code with the fit. SPDX-License-Identifier: GPL-3.0-or-later */
#include "counted.h"
#include "near.h"

#include "dma_data.h"
#include "weartrack/dma.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 3, ISOTHERMS = 6, POINTS = 12, DRAWS = COUNTED(200) };
static const double coldest = 263.15, apart = 8, reference = 293.15;

typedef struct truth {
    double c1, c2, moved[SAMPLES]; /* moved: of the reference temperature [K] */
    double odd_c1;                 /* of the last sample */
    double noise, oven;            /* relative; [K] */
} truth;
static const truth same = {8, 110, {0, 0, 0}, 8, 0.01, 0.2},
                   moved = {8, 110, {0, 9, -6}, 8, 0.01, 0.2},
                   other = {8, 110, {0, 0, 0}, 9.5, 0.01, 0.2},
                   rough = {8, 110, {0, 0, 0}, 8, 0.03, 0.7};

/* Sample k has a modulus and a time of its own. */
static void draw_sample(const truth *t, size_t k, uint64_t *seed, wt_sweep *sweep)
{
    const double c1 = k + 1 == SAMPLES ? t->odd_c1 : t->c1;
    for (size_t i = 0; i < ISOTHERMS; i++) {
        wt_isotherm *iso = wt_sweep_add(sweep, POINTS, 0);
        assert_non_null(iso);
        iso->temperature = coldest + apart * (double)i + t->moved[k];
        const double real = iso->temperature + t->oven * dma_normal(seed) - t->moved[k];
        const double log_a = -c1 * (real - reference) / (t->c2 + real - reference);
        for (size_t j = 0; j < POINTS; j++) {
            const double omega = pow(10, -1 + 3.0 * (double)j / (POINTS - 1));
            /* (i w tau)^0.5 = m (1 + i) / sqrt 2 */
            const double m = sqrt(omega * pow(10, log_a) * 1e-5 * pow(3, (double)k)),
                         part = m / sqrt(2), square = (1 + part) * (1 + part) + part * part;
            iso->angular_frequency[j] = omega;
            iso->storage_modulus[j] = (1e6 * (1 + (double)k) + 8e8 * (part + m * m) / square) *
                                      exp(t->noise * dma_normal(seed));
            iso->loss_modulus[j] = 8e8 * part / square * exp(t->noise * dma_normal(seed));
        }
    }
    wt_sweep_sort(sweep);
}

static wt_status find(const truth *t, wt_shared_law_mode how, uint64_t seed,
                      wt_shared_shift_law *law, wt_error *err)
{
    wt_master fit[SAMPLES] = {{0}};
    const wt_master *of[SAMPLES];
    wt_master_options options = wt_master_options_defaults();
    options.vertical = WT_VERTICAL_NONE;
    for (size_t k = 0; k < SAMPLES; k++) {
        wt_sweep sweep = {0};
        draw_sample(t, k, &seed, &sweep);
        if (wt_master_fit(&sweep, &options, NULL, &fit[k], err) != WT_OK)
            fail_msg("%s %s", err->message, err->found);
        of[k] = &fit[k];
        wt_sweep_clear(&sweep);
    }
    const wt_status status = wt_shared_shift_law_fit(of, SAMPLES, how, reference, law, err);
    for (size_t k = 0; k < SAMPLES; k++)
        wt_master_clear(&fit[k]);
    return status;
}

typedef struct shares {
    double c1, c2, law, moved, difference, alarms, n;
} shares;

static double held(wt_interval x, double truth_)
{
    return x.low <= truth_ && truth_ <= x.high ? 1 : 0;
}

static shares count(const truth *t, wt_shared_law_mode how)
{
    shares s = {0};
    for (uint64_t i = 0; i < DRAWS; i++) {
        wt_shared_shift_law law = {0};
        wt_error err = WT_ERROR_INIT;
        if (find(t, how, 1000 + 7919 * i, &law, &err) != WT_OK)
            continue; /* a sample whose own law is not WLF by chance may leave too few */
        s.n++;
        s.c1 += held(law.c1, t->c1);
        s.c2 += held(law.c2, t->c2);
        s.alarms += law.p < 0.05;
        s.moved += held(law.members[1].reference_offset, t->moved[1]);
        double of_law = 0, of_difference = 0, n = 0;
        for (size_t p = 0; p < law.n; p++) {
            const wt_shared_law_point *point = &law.points[p];
            const double real = point->temperature - t->moved[point->sample];
            of_law += held(point->law, -t->c1 * (real - reference) / (t->c2 + real - reference));
            of_difference += held(point->difference, 0);
            n++;
        }
        s.law += of_law / n;
        s.difference += of_difference / n;
        wt_shared_shift_law_clear(&law);
    }
    double *const all[] = {&s.c1, &s.c2, &s.law, &s.moved, &s.difference, &s.alarms};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        *all[i] /= s.n;
    print_message("%g draws: C1 %.3f, C2 %.3f, law %.3f, moved %.3f, difference %.3f, alarms "
                  "%.3f\n",
                  s.n, s.c1, s.c2, s.law, s.moved, s.difference, s.alarms);
    return s;
}

static void assert_covers(double share)
{
    if (!(share >= 0.92 && share <= 0.98))
        fail_msg("%g", share);
}

static void test_same(void **state)
{
    (void)state;
    const shares s = count(&same, WT_SHARED_LAW_SAME);
    assert_near(s.n, DRAWS, 0);
    if (!SHARES_COUNT)
        return;
    assert_covers(s.c1);
    assert_covers(s.c2);
    assert_covers(s.law);
    assert_true(s.difference >= 0.95);
    assert_true(s.alarms <= 0.1);
}

static void test_moved(void **state)
{
    (void)state;
    const shares s = count(&moved, WT_SHARED_LAW_SHIFTED);
    assert_near(s.n, DRAWS, 0);
    if (!SHARES_COUNT)
        return;
    assert_covers(s.c1);
    assert_covers(s.c2);
    assert_covers(s.moved);
    assert_true(s.difference >= 0.95);
    assert_true(s.alarms <= 0.1);
}

/* A sample with another constant is told apart. */
static void test_other(void **state)
{
    (void)state;
    wt_shared_shift_law law = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(find(&other, WT_SHARED_LAW_SAME, 5, &law, &err), WT_OK);
    assert_true(law.p < 1e-3);
    wt_shared_shift_law_clear(&law);
}

/* Few and rough: no alarm, and intervals as wide as that is. */
static void test_rough(void **state)
{
    (void)state;
    const shares s = count(&rough, WT_SHARED_LAW_SAME);
    if (!SHARES_COUNT)
        return;
    assert_true(s.n > 0.9 * DRAWS);
    assert_covers(s.law);
    assert_true(s.difference >= 0.95);
    assert_true(s.alarms <= 0.1);
}

/* Two samples or more with a law are needed. */
static void test_too_few(void **state)
{
    (void)state;
    const wt_master *none[2] = {NULL, NULL};
    wt_shared_shift_law law = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_shared_shift_law_fit(none, 2, WT_SHARED_LAW_SAME, reference, &law, &err),
                     WT_E_RANGE);
    assert_int_equal(wt_shared_shift_law_fit(none, 2, WT_SHARED_LAW_NONE, reference, &law, &err),
                     WT_E_ARG);
    assert_null(law.members);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same), cmocka_unit_test(test_moved),
                                       cmocka_unit_test(test_other), cmocka_unit_test(test_rough),
                                       cmocka_unit_test(test_too_few)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
