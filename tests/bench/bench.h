/* Benchmark program: each number is compared with the plain textbook method in the same run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_BENCH_H
#define WT_TESTS_BENCH_H

#include "weartrack/weartrack.h"

/* Number of timed runs; the result is their median. */
enum { BENCH_RUNS = 5 };
/* Calls `work` for half a second, five times. Returns the median of the processor time per call
 * [s], which depends less on other jobs than the time by the clock. */
double bench_time(void (*work)(void *), void *data);
double bench_time_by_the_clock(void (*work)(void *), void *data); /* the same for several threads */
/* Prints one row: subject, calls per second (or duration), that of the textbook method, ratio. */
void bench_row(const char *what, double seconds, double textbook_seconds, double items,
               const char *unit, const char *agreement);
/* Prints the error and exits. */
void bench_check(wt_status status, const wt_error *err);
/* Uniform numbers in (0, 1) and standard normal numbers with a fixed seed. */
typedef struct bench_random {
    uint64_t state;
} bench_random;
double bench_uniform(bench_random *random);
double bench_normal(bench_random *random);

/* Returns the time of the textbook fit of one curve [s]. */
double bench_curves(void);
void bench_detect(void);
/* textbook: time of its fit of one curve [s]. */
void bench_indent(double textbook);
void bench_friction(void);
void bench_layer(void);
void bench_shift(void);

#endif
