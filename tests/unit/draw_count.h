/* Draws of which shares are counted. The address sanitizer sees in a tenth of them what it sees in
 * all; shares of so few are then not judged:
 *
 *     enum { DRAWS = DRAW_COUNT(200) };
 *     ... the draws ...
 *     if (!TEST_RATES)
 *         return;
 *     ... what must hold of the shares ...
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_DRAW_COUNT_H
#define WT_TESTS_DRAW_COUNT_H

#include "address_sanitizer.h"

#define TEST_RATES (!WITH_ADDRESS_SANITIZER)
#define DRAW_COUNT(draws) (WITH_ADDRESS_SANITIZER ? ((draws) + 9) / 10 : (draws))

#endif
