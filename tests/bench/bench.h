/* The benchmark program: each number paired with the plain textbook method, in the same run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_BENCH_H
#define WT_TESTS_BENCH_H

#include "weartrack/weartrack.h"

/* Number of timed runs, whose median counts. */
enum { BENCH_RUNS = 5 };
/* Calls `work` until half a second has gone by, five times; returns the median seconds per call, of
 * the processor, which the other work of a machine changes less than those by the clock. */
double bench_time(void (*work)(void *), void *data);
double bench_time_by_the_clock(void (*work)(void *), void *data); /* of several threads */
/* Prints one row: what, how many per second (or per call), the textbook's, the ratio. */
void bench_row(const char *what, double seconds, double textbook_seconds, double items,
               const char *unit, const char *agreement);
/* Prints the error and ends the program. */
void bench_check(wt_status status, const wt_error *err);
/* Uniform in (0, 1) and standard normal numbers from a fixed seed. */
typedef struct bench_random {
    uint64_t state;
} bench_random;
double bench_uniform(bench_random *random);
double bench_normal(bench_random *random);

/* Returns the seconds of the textbook fit of one curve. */
double bench_curves(void);
void bench_detect(void);
/* textbook: seconds of its fit of one curve. */
void bench_indent(double textbook);
void bench_friction(void);
void bench_layer(void);
void bench_shift(void);
void bench_summary(void);

#endif
