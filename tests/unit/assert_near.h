/* Comparison of floating-point numbers, because assert_float_equal of cmocka casts to float. NaN
 * and infinities match themselves only; a failure prints 17 digits. */
#ifndef WT_TESTS_ASSERT_NEAR_H
#define WT_TESTS_ASSERT_NEAR_H

/* cmocka.h needs these headers first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

static inline void near_check(double actual, double expected, double tolerance, const char *kind,
                              const char *text, const char *file, int line)
{
    int good;
    if (isnan(expected) || isnan(actual))
        good = isnan(expected) && isnan(actual);
    else if (isinf(expected) || isinf(actual))
        good = actual == expected; // NOLINT: infinities compare exactly
    else
        good = fabs(actual - expected) <= tolerance;
    if (!good) {
        print_error("%s: %.17g is not %.17g (difference %.3g, %s %.3g)\n", text, actual, expected,
                    actual - expected, kind, tolerance);
        _fail(file, line);
    }
}

/* |actual - expected| <= rtol |expected| */
#define assert_near(actual, expected, rtol)                                                        \
    near_check((actual), (expected), (rtol)*fabs((double)(expected)), "allowed", #actual,          \
               __FILE__, __LINE__)
/* |actual - expected| <= atol */
#define assert_near_abs(actual, expected, atol)                                                    \
    near_check((actual), (expected), (atol), "allowed", #actual, __FILE__, __LINE__)

#endif
