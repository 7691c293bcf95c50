/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "random.h"

#include <math.h>

static uint64_t scramble(uint64_t *x)
{
    uint64_t z = (*x += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

random_source random_for(uint64_t seed, const char *name, uint64_t number)
{
    uint64_t x = seed;
    for (; *name != '\0'; name++)
        x = scramble(&x) ^ (unsigned char)*name;
    x = scramble(&x) ^ number;
    random_source source;
    for (int i = 0; i < 4; i++)
        source.state[i] = scramble(&x);
    return source;
}

static uint64_t rotate(uint64_t x, int by)
{
    return x << by | x >> (64 - by);
}

static uint64_t next(random_source *source)
{
    uint64_t *s = source->state;
    const uint64_t result = rotate(s[1] * 5, 7) * 9, t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate(s[3], 45);
    return result;
}

double random_uniform(random_source *source)
{
    return ((double)(next(source) >> 11) + 0.5) * 0x1p-53;
}

/* Polar method; its second number is discarded, so that the state of the generator is complete. */
double random_normal(random_source *source)
{
    for (;;) {
        const double x = 2 * random_uniform(source) - 1, y = 2 * random_uniform(source) - 1;
        const double square = x * x + y * y;
        if (square < 1 && square > 0)
            return x * sqrt(-2 * log(square) / square);
    }
}

double random_about(double value, double error, random_source *source)
{
    return value * exp(error * random_normal(source));
}
