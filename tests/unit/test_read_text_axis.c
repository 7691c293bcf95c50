/* Positions at equal steps, rounded by exports.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/base/array.h"
#include "read/text/text.h"

#include <math.h>

enum { POINTS = 400 };

static void test_equal(void **state)
{
    (void)state;
    double places[POINTS];
    text_axis axis;
    size_t worst;
    for (size_t i = 0; i < POINTS; i++)
        places[i] = -3e-4 + 8.333333e-8 * (double)i;
    assert_true(axis_find(places, POINTS, 1e-6, false, &axis, &worst));
    assert_int_equal(axis.n, POINTS);
    assert_near(axis.step, 8.333333e-8, 1e-9);
    assert_near_abs(axis.rounded, 0, 0);
    assert_int_equal(axis_index(&axis, places[17]), 17);
}

/* Rounded to a tenth of a micrometre, two thirds of a step: the steps are those of the end
 * points. */
static void test_rounded(void **state)
{
    (void)state;
    double places[POINTS];
    text_axis axis;
    size_t worst;
    for (size_t i = 0; i < POINTS; i++)
        places[i] = 1e-6 * round(10 * 0.15624 * (double)i) / 10;
    assert_true(axis_find(places, POINTS, 1e-6, false, &axis, &worst));
    assert_near(axis.step, 0.15624e-6, 1e-3);
    assert_near(axis.rounded, 1e-7, 1e-9);
}

static void test_unequal(void **state)
{
    (void)state;
    double places[POINTS];
    text_axis axis;
    size_t worst;
    for (size_t i = 0; i < POINTS; i++)
        places[i] = 1e-7 * (double)i;
    places[200] += 2e-8;
    assert_false(axis_find(places, POINTS, 1e-6, false, &axis, &worst));
    assert_int_equal(worst, 200);
    assert_false(axis_find(places, 1, 1e-6, false, &axis, &worst));
    /* a drift of the drive is not rounding */
    for (size_t i = 0; i < POINTS; i++)
        places[i] = 1e-6 * (0.1 * (double)i + 1e-4 * (double)(i * i));
    assert_false(axis_find(places, POINTS, 1e-6, true, &axis, &worst));
}

/* A map may lack lines; an almost empty line is excluded. */
static void test_holes(void **state)
{
    (void)state;
    const double some[] = {0, 1, 3, 4, 6}, few[] = {0, 1, 50, 99};
    text_axis axis;
    size_t worst;
    assert_false(axis_find(some, COUNT_OF(some), 1, false, &axis, &worst));
    assert_true(axis_find(some, COUNT_OF(some), 1, true, &axis, &worst));
    assert_int_equal(axis.n, 7);
    assert_int_equal(axis_index(&axis, 4), 4);
    assert_false(axis_find(few, COUNT_OF(few), 1, true, &axis, &worst));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_equal), cmocka_unit_test(test_rounded),
                                       cmocka_unit_test(test_unequal),
                                       cmocka_unit_test(test_holes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
