/* Number of draws for a test of a rate. With the address sanitizer, which needs no more, a tenth of
 * the draws run, and their rates are not tested:
 *
 *     enum { DRAWS = DRAW_COUNT(200) };
 *     ... draws ...
 *     if (!TEST_RATES)
 *         return;
 *     ... tests of the rates ...
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_DRAW_COUNT_H
#define WT_TESTS_DRAW_COUNT_H

#include "address_sanitizer.h"

#define TEST_RATES (!WITH_ADDRESS_SANITIZER)
#define DRAW_COUNT(draws) (WITH_ADDRESS_SANITIZER ? ((draws) + 9) / 10 : (draws))

#endif
