/* Random numbers from a seed, for tests that draw friction scenes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_NUMERIC_DRAWN_NUMBERS_H
#define WT_TESTS_NUMERIC_DRAWN_NUMBERS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

static uint64_t drawn_state;

static inline double uniform(double low, double high)
{
    drawn_state += 0x9e3779b97f4a7c15u;
    uint64_t z = (drawn_state ^ (drawn_state >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return low + (high - low) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline double decades(double low, double high)
{
    return pow(10, uniform(low, high));
}

#endif
