/* Fixtures with known truth: cells of tables by the name of a column, which must exist, and force
 * curves of a sphere on an elastic solid by the formula of Hertz.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_TRUTH_FIXTURE_H
#define WT_TESTS_TRUTH_FIXTURE_H

#include "assert_near.h"

#include "weartrack/core.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static inline size_t truth_column(const wt_table *table, size_t row, const char *name)
{
    assert_non_null(table);
    long column = wt_table_find(table, name);
    if (column < 0 || row >= wt_table_n_rows(table))
        fail_msg("table %s has no column %s or no row %zu", wt_table_name(table), name, row);
    return (size_t)column;
}

static inline double cell(const wt_table *table, size_t row, const char *name)
{
    return wt_table_number(table, row, truth_column(table, row, name));
}

static inline const char *cell_text(const wt_table *table, size_t row, const char *name)
{
    return wt_table_text(table, row, truth_column(table, row, name));
}

static inline wt_estimate key_estimate(const wt_table *table, const char *key)
{
    wt_estimate e = {0};
    assert_non_null(table);
    if (!wt_table_estimate(table, key, &e))
        fail_msg("table %s has no estimate %s", wt_table_name(table), key);
    return e;
}

/* Normal deviates from a counter, the same on every machine. */
static inline double truth_normal(uint64_t *state)
{
    double u[2];
    for (int i = 0; i < 2; i++) {
        *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        uint64_t z = *state;
        z = (z ^ (z >> 31)) * UINT64_C(0xbf58476d1ce4e5b9);
        u[i] = ((double)((z ^ (z >> 27)) >> 11) + 0.5) / 9007199254740992.0;
    }
    return sqrt(-2.0 * log(u[0])) * cos(6.283185307179586 * u[1]);
}

/* ---- force curves of a sphere of 5 um (paraboloid), Poisson's ratio 0.5 ---------------------- */

#define HERTZ_RADIUS 5e-6
#define HERTZ_TIP "paraboloid:radius=5um"

typedef struct hertz {
    double modulus, spring_constant; /* [Pa], [N/m] */
    double depth;                    /* depth of the deepest point [m] */
    double velocity;                 /* rate of the piezo [m/s] */
    double snap;                     /* attraction in the last samples before contact [N] */
    uint64_t seed;                   /* of the noise */
} hertz;

/* 3 MPa with a stiff cantilever, 1 um/s. */
static inline hertz hertz_standard(void)
{
    return (hertz){3e6, 10, 150e-9, 1e-6, 0, 7};
}

#define HERTZ_FREE 400e-9    /* travel before contact [m] */
#define HERTZ_TOP 2e-6       /* height at the start, from which it decreases [m] */
#define HERTZ_OFFSET 3e-9    /* force of the baseline at contact [N] */
#define HERTZ_TILT 2e-3      /* [N/m] */
#define HERTZ_NOISE 0.5e-9   /* [N] */
#define HERTZ_SNAP_SAMPLES 4 /* before contact */
#define HERTZ_N 600

static inline double hertz_force(const hertz *h, double depth)
{
    return depth > 0 ? 4.0 / 3.0 * h->modulus / 0.75 * sqrt(HERTZ_RADIUS) * pow(depth, 1.5) : 0;
}

/* Travel of the piezo from contact to the deepest point. */
static inline double hertz_travel(const hertz *h)
{
    return h->depth + hertz_force(h, h->depth) / h->spring_constant;
}

/* Indentation at a travel beyond contact: k (travel - depth) = F(depth). */
static inline double hertz_depth(const hertz *h, double travel)
{
    double low = 0, high = travel > 0 ? travel : 0;
    for (int i = 0; i < 100; i++) {
        double middle = (low + high) / 2;
        if (h->spring_constant * (travel - middle) > hertz_force(h, middle))
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

/* Appends the approach to a weartrack-stream(5) file as curve `index`. */
static inline void hertz_write(FILE *out, const hertz *h, int index)
{
    uint64_t seed = h->seed;
    double end = HERTZ_FREE + hertz_travel(h);
    fprintf(out,
            "## table: force_curve/%d\n"
            "## position_x: %.9g standard_error=0 numerical_error=0 unit=m\n"
            "## position_y: %.9g standard_error=0 numerical_error=0 unit=m\n"
            "## spring_constant: %.9g standard_error=0 numerical_error=0 unit=N/m\n"
            "## curve: %d\n# segment[text]\theight[m]\tforce[N]\ttime[s]\n",
            index, 1e-6 * (index + 1), 2e-6 * (index + 1), h->spring_constant, index);
    for (int i = 0; i < HERTZ_N; i++) {
        double z = end * i / (HERTZ_N - 1), beyond = z - HERTZ_FREE;
        double force = HERTZ_OFFSET + HERTZ_TILT * beyond + hertz_force(h, hertz_depth(h, beyond)) +
                       HERTZ_NOISE * truth_normal(&seed);
        if (beyond < 0 && beyond > -HERTZ_SNAP_SAMPLES * end / (HERTZ_N - 1))
            force -= h->snap;
        fprintf(out, "approach\t%.17g\t%.17g\t%.17g\n", HERTZ_TOP - z, force, z / h->velocity);
    }
    fputs("##\n", out);
}

/* Opens a new temporary file for writing; path: "...-XXXXXX". */
static inline FILE *truth_file(char *path)
{
    int file = mkstemp(path);
    assert_true(file >= 0);
    FILE *out = fdopen(file, "w");
    assert_non_null(out);
    return out;
}

#endif
