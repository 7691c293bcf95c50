/* Benchmark of weartrack, run by hand. The tests only build it and run it briefly.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "../status_name.h"
#include "bench/bench.h"
#include "bench/precision.h"

static double run_seconds = 0.5;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Processor time of this process and of its finished children, such as the sandbox. */
static double processor_seconds(void)
{
    struct rusage door;
    (void)getrusage(RUSAGE_CHILDREN, &door);
    return wt_time_cpu() + (double)(door.ru_utime.tv_sec + door.ru_stime.tv_sec) +
           1e-6 * (double)(door.ru_utime.tv_usec + door.ru_stime.tv_usec);
}

/* The duration is by the clock, independent of the load of the machine. */
static double median_of(void (*work)(void *), void *data, double (*seconds_now)(void))
{
    double seconds[BENCH_RUNS];
    work(data); /* warm-up */
    for (int r = 0; r < BENCH_RUNS; r++) {
        size_t calls = 0;
        const double end = wt_time_wall() + run_seconds, start = seconds_now();
        do {
            work(data);
            calls++;
        } while (wt_time_wall() < end);
        seconds[r] = (seconds_now() - start) / (double)calls;
    }
    qsort(seconds, BENCH_RUNS, sizeof *seconds, compare);
    return seconds[BENCH_RUNS / 2];
}

double bench_time(void (*work)(void *), void *data)
{
    return median_of(work, data, processor_seconds);
}

double bench_time_by_the_clock(void (*work)(void *), void *data)
{
    return median_of(work, data, wt_time_wall);
}

void bench_row(const char *what, double seconds, double textbook_seconds, double items,
               const char *unit, const char *agreement)
{
    printf("%-34s %10.4g %-14s %10.4g  %8.1f x  %s\n", what, items / seconds, unit,
           items / textbook_seconds, textbook_seconds / seconds, agreement);
    fflush(stdout);
}

void bench_check(wt_status status, const wt_error *err)
{
    if (status == WT_OK)
        return;
    char line[1024] = "";
    if (err != NULL)
        wt_error_format(err, line, sizeof line);
    fprintf(stderr, "bench: %s: %s\n", status_name(status), line);
    exit(1);
}

double bench_uniform(bench_random *random)
{
    /* splitmix64 */
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

double bench_normal(bench_random *random)
{
    const double u = bench_uniform(random), v = bench_uniform(random);
    return sqrt(-2 * log(u)) * cos(6.283185307179586 * v);
}

int main(int argc, char **argv)
{
    const bool precision = argc >= 2 && argc <= 3 && strcmp(argv[1], "--precision") == 0;
    if (precision || (argc == 2 && strcmp(argv[1], "--short") == 0))
        run_seconds = 0.01;
    else if (argc > 1) {
        fprintf(stderr, "usage: bench [--short | --precision [PART]]\n");
        return 2;
    }
    if (precision)
        return bench_precision(argc == 3 ? argv[2] : NULL) > 0;
    printf("weartrack %s, one thread; processor time, median of five\n\n", wt_version());
    printf("%-34s %10s %-14s %10s  %10s  %s\n", "what", "weartrack", "", "textbook", "ratio",
           "largest difference");
    const double textbook = bench_curves();
    bench_indent(textbook);
    bench_detect();
    bench_friction();
    bench_layer();
    bench_shift();
    return 0;
}
