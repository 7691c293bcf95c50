/* Mean and variance as used by all intervals of means.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/math/students_t.h"

static void known(void **state)
{
    (void)state;
    static const double x[] = {3, 5, -2, 10};
    const moments all = sample_moments(x, 4);
    assert_near(all.n, 4, 0);
    assert_near(all.mean, 4, 1e-15);
    assert_near(all.variance, 74.0 / 3, 1e-15); /* (1 + 1 + 36 + 36) / 3 */
    const moments two = sample_moments(x, 2);
    assert_near(two.mean, 4, 1e-15);
    assert_near(two.variance, 2, 1e-15);
}

/* The scatter of one value is unknown, not zero. */
static void few(void **state)
{
    (void)state;
    static const double x[] = {7};
    const moments one = sample_moments(x, 1);
    assert_near(one.mean, 7, 0);
    assert_near(one.variance, (double)NAN, 0);
    const moments none = sample_moments(x, 0);
    assert_near(none.n, 0, 0);
    assert_near(none.mean, (double)NAN, 0);
    assert_near(none.variance, (double)NAN, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(known), cmocka_unit_test(few)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
