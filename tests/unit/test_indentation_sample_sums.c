/* Sums, ranges and order statistics of samples, computed several numbers at a time: against one
 * number at a time, for every length near that.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "indentation/numerics/curve.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 70 };

static double x[MOST], y[MOST];

static void draw(unsigned seed, size_t n)
{
    srand(seed);
    for (size_t i = 0; i < n; i++) {
        x[i] = rand() / (double)RAND_MAX - 0.4;
        y[i] = rand() % 5 - 2; /* some equal */
    }
}

static int by_size(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static void sums(void **state)
{
    (void)state;
    for (size_t n = 1; n < MOST; n++) {
        double sum = 0, product = 0;
        draw((unsigned)n, n);
        for (size_t i = 0; i < n; i++) {
            sum += x[i];
            product += x[i] * y[i];
        }
        assert_near_abs(curve_sum(x, n), sum, 1e-14);
        assert_near_abs(curve_dot(x, y, n), product, 1e-14);
    }
}

static void spans(void **state)
{
    (void)state;
    for (size_t n = 1; n < MOST; n++)
        for (int which = 0; which < 2; which++) {
            const double *of = which == 0 ? x : y;
            double sorted[MOST];
            draw((unsigned)n, n);
            memcpy(sorted, of, n * sizeof *sorted);
            qsort(sorted, n, sizeof *sorted, by_size);
            const curve_span all = curve_find_span(of, n);
            assert_true(!(all.low < sorted[0]) && !(all.low > sorted[0]));
            assert_true(!(all.high < sorted[n - 1]) && !(all.high > sorted[n - 1]));
        }
}

static void order(void **state)
{
    (void)state;
    for (size_t n = 1; n < MOST; n++)
        for (size_t k = 0; k < n; k++) {
            double sorted[MOST], lost[MOST];
            draw((unsigned)n, n);
            for (size_t i = 0; i < n; i++) /* from 0 over many powers of two, some equal */
                sorted[i] = lost[i] = i % 7 == 0 ? fabs(y[i]) : exp2(40 * (x[i] - 0.6));
            qsort(sorted, n, sizeof *sorted, by_size);
            const double found = curve_select(lost, n, k, sorted[n - 1]);
            assert_true(!(found < sorted[k]) && !(found > sorted[k]));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums),
        cmocka_unit_test(spans),
        cmocka_unit_test(order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
