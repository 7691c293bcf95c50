/* Random surfaces with a known spectrum, as a sum of modes. The phases are from splitmix64, so that
 * any program can reproduce them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_SYNTHETIC_SURFACE_H
#define TESTS_SYNTHETIC_SURFACE_H

#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static inline uint64_t surface_random(uint64_t seed, uint64_t i)
{
    uint64_t z = seed + (i + 1) * UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

static inline double surface_uniform(uint64_t seed, uint64_t i)
{
    return (double)(surface_random(seed, i) >> 11) * 0x1p-53;
}

/* CMPLX and I differ between compilers. */
static inline double complex surface_complex(double real, double imaginary)
{
    const double parts[] = {real, imaginary};
    double complex z;
    memcpy(&z, parts, sizeof z);
    return z;
}

typedef struct synthetic_surface {
    size_t n;      /* points per side */
    double length; /* length of the side [m] */
    uint64_t seed;
    int modes; /* number of modes, in all directions */
    double c0, roll_off, hurst;
    double stretch;   /* C(phi) = C (1 + stretch cos 2 (phi - texture)) */
    bool exponential; /* squared amplitudes are exponentially distributed, as on a random surface */
    double texture;   /* [rad] */
} synthetic_surface;

static inline double surface_density(const synthetic_surface *s, double q)
{
    return s->c0 * (q > s->roll_off ? pow(q / s->roll_off, -2 * (1 + s->hurst)) : 1);
}

static inline double complex surface_amplitude(const synthetic_surface *s, int mx, int my)
{
    const double step = 2 * M_PI / s->length, q = step * sqrt((double)(mx * mx + my * my));
    const uint64_t i = (uint64_t)((mx + 32768) * 65536L + my + 32768);
    const double phase = 2 * M_PI * surface_uniform(s->seed, i);
    const double c2 = s->texture == 0 ? (double)(mx * mx - my * my) / (double)(mx * mx + my * my)
                                      : cos(2 * (atan2((double)my, (double)mx) - s->texture));
    double square = 4 * surface_density(s, q) * step * step * (1 + s->stretch * c2);
    if (s->exponential)
        square *= -log1p(-surface_uniform(s->seed + 1, i));
    return sqrt(square) * surface_complex(cos(phase), sin(phase));
}

/* h(x_i, y_j) at z[j * n + i], as a sum over lines of modes. */
static inline double *surface_create(const synthetic_surface *s)
{
    const size_t n = s->n;
    double *z = calloc(n * n, sizeof *z);
    double complex *turn = malloc(2 * n * sizeof *turn), *row = turn + n;
    if (z == NULL || turn == NULL)
        abort();
    for (size_t k = 0; k < n; k++)
        turn[k] = surface_complex(cos(2 * M_PI * (double)k / (double)n),
                                  sin(2 * M_PI * (double)k / (double)n));
    for (int my = 0; my <= s->modes; my++) {
        for (size_t i = 0; i < n; i++)
            row[i] = 0;
        for (int mx = my == 0 ? 1 : -s->modes; mx <= s->modes; mx++) {
            if (mx * mx + my * my > s->modes * s->modes)
                continue;
            const double complex a = surface_amplitude(s, mx, my);
            const size_t step = (size_t)((mx % (int)n + (int)n) % (int)n);
            for (size_t i = 0, at = 0; i < n; i++, at = (at + step) % n)
                row[i] += a * turn[at];
        }
        for (size_t j = 0; j < n; j++) {
            const double complex t = turn[(size_t)my * j % n];
            for (size_t i = 0; i < n; i++)
                z[j * n + i] += creal(row[i]) * creal(t) - cimag(row[i]) * cimag(t);
        }
    }
    free(turn);
    return z;
}

#endif
