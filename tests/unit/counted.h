/* Draws of which shares are counted. The address sanitizer sees in a tenth of them what it sees in
 * all; shares of so few are then not judged:
 *
 *     enum { DRAWS = COUNTED(200) };
 *     ... the draws ...
 *     if (!SHARES_COUNT)
 *         return;
 *     ... what must hold of the shares ...
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_COUNTED_H
#define WT_TESTS_COUNTED_H

#include "watched.h"

#define SHARES_COUNT (!WATCHED)
#define COUNTED(draws) (WATCHED ? ((draws) + 9) / 10 : (draws))

#endif
