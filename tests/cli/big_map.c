/* What a map costs in memory: a small and a large one, told, fitted and converted in every
 * direction. Peak memory, carried on to 65,536 curves, must stay below 100 MB, and the moduli of
 * the converted maps must be those of the map to the last digit.
 * Usage: big_map PROGRAM WORK [CURVES]: one map of so many instead, whose peaks are printed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/jpk_writer.h"

#include <math.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SMALL = 1024, LARGE = 8192, ASKED = 65536, MOST_MB = 100, KINDS = 64, N = 200 };

extern char **environ;

static const double modulus = 4e6, radius = 1e-6, contact = 0.8e-6, spring_constant = 2;

static double height[2][KINDS][N], force[2][KINDS][N];
static size_t n_bad;

static double noise(void)
{
    static unsigned long long state = 2026;
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        sum += (double)(state >> 11) / 9007199254740992.0;
    }
    return sum - 6;
}

/* Curves of a paraboloid on a half space. */
static void make_kinds(void)
{
    for (size_t c = 0; c < KINDS; c++)
        for (size_t way = 0; way < 2; way++)
            for (size_t i = 0; i < N; i++) {
                const double at = (double)(way == 0 ? i : N - 1 - i) / (N - 1);
                const double position = 1e-6 * at, depth = fmax(position - contact, 0);
                const double pushed = 4. / 3 * modulus / 0.75 * sqrt(radius) * pow(depth, 1.5);
                force[way][c][i] = pushed + 1e-9 * noise();
                height[way][c][i] = -(position + pushed / spring_constant);
            }
}

static void write_map(const char *path, size_t n)
{
    static jpk_writer_segment segments[KINDS][2];
    jpk_writer_curve *const curves = calloc(n, sizeof *curves);
    jpk_writer_file file = jpk_writer_defaults();
    const long side = (long)ceil(sqrt((double)n));
    if (curves == NULL)
        abort();
    for (size_t i = 0; i < 2 * (size_t)KINDS; i++)
        segments[i / 2][i % 2] = (jpk_writer_segment){.style = i % 2 == 0 ? "extend" : "retract",
                                                      .n = N,
                                                      .duration = 0.5,
                                                      .height = height[i % 2][i / 2],
                                                      .force = force[i % 2][i / 2]};
    for (size_t i = 0; i < n; i++)
        curves[i] = (jpk_writer_curve){i, 1e-6 * (double)(i % (size_t)side),
                                       1e-6 * (double)(i / (size_t)side), 2, segments[i % KINDS]};
    file.path = path;
    file.map = true;
    file.n_curves = n;
    file.curves = curves;
    file.columns = file.rows = side;
    file.spring_constant = spring_constant;
    file.sensitivity = 60e-9;
    file.stored = true;
    if (jpk_write(&file) != 0)
        abort();
    free(curves);
}

/* Peak memory of a call, which must succeed [MB]; that of processes which it waited for counts. */
static double peak(const char *program, const char *const *arguments)
{
    const char *line[16] = {"weartrack"};
    pid_t child = 0;
    int state = 0;
    struct rusage used;
    posix_spawn_file_actions_t actions;
    for (size_t i = 0; arguments[i] != NULL; i++)
        line[i + 1] = arguments[i];
    (void)posix_spawn_file_actions_init(&actions);
    (void)posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
    if (posix_spawn(&child, program, &actions, NULL, (char *const *)line, environ) != 0 ||
        wait4(child, &state, 0, &used) != child)
        abort();
    (void)posix_spawn_file_actions_destroy(&actions);
    if (state != 0) {
        (void)fprintf(stderr, "%s %s: state %x\n", arguments[0], arguments[1], (unsigned)state);
        n_bad++;
    }
    return (double)used.ru_maxrss / 1024;
}

#define TIP "--tip", "paraboloid:radius=1um", "-q", "--no-provenance", "--threads", "1"
static const char *const calls[][12] = {
    {"info", "map.jpk-force-map"},
    {"indent", "map.jpk-force-map", TIP, "-o", "jpk.tsv"},
    {"convert", "-q", "map.jpk-force-map", "-o", "map.h5"},
    {"info", "map.h5"},
    {"indent", "map.h5", TIP, "-o", "h5.tsv"},
    {"convert", "-q", "map.h5", "-o", "again.h5"},
    {"convert", "-q", "map.h5", "-o", "map.tsv"},
    {"indent", "map.jpk-force-map", TIP, "-o", "rows.h5"},
};
enum { CALLS = sizeof calls / sizeof *calls };

static bool next_row(FILE *in, char *row, size_t size)
{
    while (fgets(row, (int)size, in) != NULL)
        if (row[0] != '#' && row[0] != '\n')
            return true;
    return false;
}

/* The rows of moduli agree, apart from the name of the file and what only one format says. */
static void compare(const char *name, size_t n)
{
    static char a[4096], b[4096];
    FILE *const x = fopen("jpk.tsv", "r"), *const y = fopen(name, "r");
    size_t same = 0;
    if (x == NULL || y == NULL)
        abort();
    for (size_t i = 0; i < n && next_row(x, a, sizeof a) && next_row(y, b, sizeof b); i++) {
        char *p = a, *q = b;
        bool agree = true;
        /* file, curve, ..., the modulus with its errors: columns found by their names would need a
         * reader; all numbers of the row must agree instead */
        for (size_t column = 0; p != NULL && q != NULL; column++) {
            char *const u = strsep(&p, "\t"), *const v = strsep(&q, "\t");
            if (strstr(u, "map.") == NULL && strcmp(u, v) != 0) {
                if (agree && n_bad < 5)
                    (void)fprintf(stderr, "%s, row %zu, column %zu: %s, not %s\n", name, i, column,
                                  v, u);
                agree = false;
            }
        }
        same += agree;
    }
    (void)fclose(x);
    (void)fclose(y);
    if (same != n) {
        (void)fprintf(stderr, "%s: %zu of %zu rows are those of the map\n", name, same, n);
        n_bad++;
    }
}

static void run(const char *program, size_t n, double peaks[CALLS])
{
    /* In a process of its own: a program counts the peak of the one that started it as its own. */
    const pid_t writer = fork();
    int state = 0;
    if (writer == 0) {
        write_map("map.jpk-force-map", n);
        _exit(EXIT_SUCCESS);
    }
    if (waitpid(writer, &state, 0) != writer || state != 0)
        abort();
    for (size_t i = 0; i < CALLS; i++)
        peaks[i] = peak(program, calls[i]);
    compare("h5.tsv", n);
}

int main(int argc, char **argv)
{
    double small[CALLS], large[CALLS];
    if (argc < 3 || (mkdir(argv[2], 0777) != 0 && access(argv[2], W_OK) != 0) ||
        chdir(argv[2]) != 0)
        return 2;
    make_kinds();
    const size_t only = argc > 3 ? strtoul(argv[3], NULL, 10) : 0;
    if (only == 0)
        run(argv[1], SMALL, small);
    run(argv[1], only > 0 ? only : LARGE, large);
    for (size_t i = 0; i < CALLS; i++) {
        const double at_most =
            only > 0 ? large[i]
                     : large[i] + (large[i] - small[i]) * (ASKED - LARGE) / (LARGE - SMALL);
        (void)printf("%s %s %s: %.1f MB, of %d curves %.0f MB\n", calls[i][0],
                     calls[i][1][0] == '-' ? calls[i][2] : calls[i][1],
                     strcmp(calls[i][0], "convert") == 0 ? calls[i][4] : "", large[i],
                     only > 0 ? (int)only : ASKED, at_most);
        if (!(at_most < MOST_MB))
            n_bad++;
    }
    return n_bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
