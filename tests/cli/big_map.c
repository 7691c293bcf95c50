/* Peak memory of a large map of force curves. A small and a large map are read, fitted and
 * converted in every format. The peak, extrapolated to 65,536 curves, must be below 100 MB; moduli
 * and files must be identical in all formats.
 *
 * Usage: big_map PROGRAM WORK NAME [CURVES [SAMPLES]]. NAME is one of the runs. With CURVES one map
 * of this size, with SAMPLES in each of two segments, is used instead and its peaks are printed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "big_map_files.h"

#include <fcntl.h>
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

#define BARE "-q", "--no-provenance"
#define MAP "map.jpk-force-map"
enum { ASKED = 65536, MOST_MB = 100, MOST_CALLS = 12, RUNS = 3 };

extern char **environ;

static size_t n_bad;

/* Starts a process that writes a file into a pipe and returns the other end of the pipe. */
static int start_feeder(const char *path, pid_t *writer)
{
    int ends[2];
    if (pipe(ends) != 0 || (*writer = fork()) < 0)
        abort();
    if (*writer > 0) {
        (void)close(ends[1]);
        return ends[0];
    }
    static char piece[1 << 16];
    const int from = open(path, O_RDONLY);
    (void)close(ends[0]);
    for (ssize_t got; (got = read(from, piece, sizeof piece)) > 0;)
        /* The pipe takes all bytes, or a signal ends this process. */
        if (write(ends[1], piece, (size_t)got) != got)
            _exit(EXIT_FAILURE);
    _exit(EXIT_SUCCESS);
}

/* Returns the peak memory of a call [MB], with the processes that it waited for. The call must
 * succeed. Its standard input is map.tsv through a pipe. */
static double peak(const char *program, const char *const *arguments)
{
    const char *line[20] = {"weartrack"};
    pid_t child = 0, writer = 0;
    int state = 0, input = -1;
    struct rusage used;
    posix_spawn_file_actions_t actions;
    (void)posix_spawn_file_actions_init(&actions);
    (void)posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
    for (size_t i = 0; arguments[i] != NULL; i++) {
        line[i + 1] = arguments[i];
        if (strcmp(arguments[i], "-") != 0)
            continue;
        input = start_feeder("map.tsv", &writer);
        (void)posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        (void)posix_spawn_file_actions_addclose(&actions, input);
    }
    if (posix_spawn(&child, program, &actions, NULL, (char *const *)line, environ) != 0)
        abort();
    if (input >= 0)
        (void)close(input);
    if (wait4(child, &state, 0, &used) != child)
        abort();
    if (writer > 0)
        (void)waitpid(writer, NULL, 0);
    (void)posix_spawn_file_actions_destroy(&actions);
    if (state != 0) {
        (void)fprintf(stderr, "%s %s: state %x\n", arguments[0], arguments[1], (unsigned)state);
        n_bad++;
    }
    return (double)used.ru_maxrss / 1024;
}

#define INDENT "indent", BARE, "--tip", "paraboloid:radius=1um", "--threads", "1"
#define CONVERT "convert", BARE
/* Some formats store no spring constant. */
#define FIT INDENT, "--spring-constant", "2N/m"
/* Calls in their order, and the files that must be identical afterwards. */
typedef struct big_map_run {
    const char *name;
    void (*write)(size_t n, size_t samples); /* writes the map or maps */
    size_t small, large, samples;
    const char *calls[MOST_CALLS][14];
    const char *moduli[4];   /* files with the moduli of moduli.txt */
    const char *files[2][2]; /* pairs of identical files */
} big_map_run;

/* One file of a format, read and converted. */
#define ONE_FILE(map, n)                                                                           \
    .small = 1536, .large = 4096, .samples = (n),                                                  \
    .calls = {{FIT, map, "-o", "moduli.txt"},                                                      \
              {"info", map},                                                                       \
              {CONVERT, map, "-o", "map.tsv"},                                                     \
              {FIT, "map.tsv", "-o", "text.txt"}},                                                 \
    .moduli = {"text.txt"}

static const big_map_run big_map_runs[] = {
    {.name = "files",
     .write = write_map,
     .small = 1024,
     .large = 8192,
     .samples = 200,
     .calls = {{"info", MAP}, {INDENT, MAP, "-o", "moduli.txt"}, {INDENT, MAP, "-o", "rows.h5"}},
     .moduli = {"moduli.txt"}},
    {.name = "text",
     .write = write_map,
     .small = 512,
     .large = 4096,
     .samples = 50,
     .calls = {{INDENT, MAP, "-o", "moduli.txt"},
               {CONVERT, MAP, "-o", "map.tsv"},
               {"info", "map.tsv"},
               {INDENT, "map.tsv", "-o", "text.txt"},
               {CONVERT, "map.tsv", "-o", "again.tsv"},
               {CONVERT, "-", "-o", "pipe.tsv"}},
     .moduli = {"text.txt"},
     .files = {{"again.tsv", "pipe.tsv"}}},
    {.name = "blocks",
     .write = write_blocks,
     .small = 1024,
     .large = 4096,
     .samples = 200,
     .calls = {{INDENT, "map.spm", "-o", "moduli.txt"},
               {"info", "map.spm"},
               {CONVERT, "map.spm", "-o", "map.tsv"},
               {INDENT, "map.tsv", "-o", "text.txt"},
               {INDENT, "map.nid", "-o", "nid.txt"},
               {"info", "map.nid"}},
     .moduli = {"text.txt"}},
    {.name = "lines", .write = write_lines, ONE_FILE("map.nid", 200)},
    {.name = "studio_1", .write = write_studio_1, ONE_FILE("map.nhf", 100)},
    {.name = "studio_2", .write = write_studio_2, ONE_FILE("map.nhf", 100)},
    {.name = "park", .write = write_park, ONE_FILE("map.tiff", 200)},
    {.name = "waves",
     .write = write_waves,
     .small = 2048,
     .large = 8192,
     .samples = 200,
     .calls = {{INDENT, "map.waves", "-o", "moduli.txt"}},
     .moduli = {"moduli.txt"}},
};
enum { BIG_MAP_RUNS = sizeof big_map_runs / sizeof *big_map_runs };

static bool next_row(FILE *in, char *row, size_t size)
{
    while (fgets(row, (int)size, in) != NULL)
        if (row[0] != '#' && row[0] != '\n')
            return true;
    return false;
}

/* Returns the index of a column, which must exist. */
static size_t find_column(FILE *in, const char *name)
{
    static char line[4096];
    size_t n = 0;
    while (fgets(line, sizeof line, in) != NULL)
        if (strncmp(line, "# ", 2) == 0) {
            char *rest = line + 2, *cell = NULL;
            while ((cell = strsep(&rest, "\t")) != NULL && strcmp(cell, name) != 0)
                n++;
            if (cell != NULL)
                return n;
        }
    abort();
}

/* Compares the moduli of two results. The file name and columns of one format only may differ. */
static void compare(const char *name, size_t n)
{
    static char a[4096], b[4096];
    FILE *const x = fopen("moduli.txt", "r"), *const y = fopen(name, "r");
    size_t same = 0;
    if (x == NULL || y == NULL)
        abort();
    const size_t modulus_column = find_column(x, "modulus[Pa]");
    for (size_t i = 0; i < n && next_row(x, a, sizeof a) && next_row(y, b, sizeof b); i++) {
        char *p = a, *q = b;
        bool agree = true;
        for (size_t column = 0; p != NULL && q != NULL; column++) {
            char *const u = strsep(&p, "\t"), *const v = strsep(&q, "\t");
            if (column == modulus_column)
                agree = agree && fabs(strtod(u, NULL) - MAP_MODULUS) < 0.2 * MAP_MODULUS;
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

static void compare_bytes(const char *const names[2])
{
    static char pieces[2][1 << 16];
    FILE *const a = fopen(names[0], "r"), *const b = fopen(names[1], "r");
    size_t n = 0, m = 0;
    bool same = true;
    if (a == NULL || b == NULL)
        abort();
    do {
        n = fread(pieces[0], 1, sizeof pieces[0], a);
        m = fread(pieces[1], 1, sizeof pieces[1], b);
        same = n == m && memcmp(pieces[0], pieces[1], n) == 0;
    } while (same && n > 0);
    (void)fclose(a);
    (void)fclose(b);
    if (!same) {
        (void)fprintf(stderr, "%s and %s differ\n", names[0], names[1]);
        n_bad++;
    }
}

static void run(const char *program, const big_map_run *t, size_t n, double peaks[MOST_CALLS])
{
    /* Runs in its own process, because the peak of a program includes that of its parent. */
    const pid_t writer = fork();
    int state = 0;
    if (writer == 0) {
        t->write(n, t->samples);
        _exit(EXIT_SUCCESS);
    }
    if (waitpid(writer, &state, 0) != writer || state != 0)
        abort();
    for (size_t i = 0; i < MOST_CALLS && t->calls[i][0] != NULL; i++) {
        const double found = peak(program, t->calls[i]);
        peaks[i] = peaks[i] > 0 ? fmin(peaks[i], found) : found;
    }
    for (size_t i = 0; t->moduli[i] != NULL; i++)
        compare(t->moduli[i], n);
    for (size_t i = 0; i < 2 && t->files[i][0] != NULL; i++)
        compare_bytes(t->files[i]);
}

static void print_call(const char *const *call)
{
    for (; *call != NULL; call++)
        if (strcmp(*call, "-q") == 0 || strcmp(*call, "--no-provenance") == 0)
            continue;
        else if (strcmp(*call, "--tip") == 0 || strcmp(*call, "--threads") == 0 ||
                 strcmp(*call, "--spring-constant") == 0)
            call++;
        else if (strcmp(*call, "-o") != 0)
            (void)printf("%s ", *call);
}

/* Returns the number of calls that exceed the limit. */
static size_t count_above(const big_map_run *t, size_t only, const double *small,
                          const double *large)
{
    size_t n = 0;
    for (size_t i = 0; i < MOST_CALLS && t->calls[i][0] != NULL; i++) {
        const double at_most = only > 0
                                   ? large[i]
                                   : large[i] + (large[i] - small[i]) * (double)(ASKED - t->large) /
                                                    (double)(t->large - t->small);
        print_call(t->calls[i]);
        (void)printf("%.1f MB, of %zu curves %.0f MB\n", large[i], only > 0 ? only : (size_t)ASKED,
                     at_most);
        n += !(at_most < MOST_MB);
    }
    return n;
}

int main(int argc, char **argv)
{
    double small[MOST_CALLS] = {0}, large[MOST_CALLS] = {0};
    size_t which = 0, n_above = 0;
    while (which < BIG_MAP_RUNS && (argc < 4 || strcmp(argv[3], big_map_runs[which].name) != 0))
        which++;
    if (which == BIG_MAP_RUNS || (mkdir(argv[2], 0777) != 0 && access(argv[2], W_OK) != 0) ||
        chdir(argv[2]) != 0)
        return 2;
    big_map_run t = big_map_runs[which];
    const size_t only = argc > 4 ? strtoul(argv[4], NULL, 10) : 0;
    const size_t samples = argc > 5 ? strtoul(argv[5], NULL, 10) : 0;
    if (samples > 1 && samples <= MOST_SAMPLES)
        t.samples = samples;
    make_kinds(t.samples);
    /* The peak differs by a megabyte between runs, and the extrapolation multiplies it by 24. A
     * program that keeps its input exceeds the limit in every run. */
    for (size_t i = 0; i < RUNS && (i == 0 || n_above > 0); i++) {
        if (only == 0)
            run(argv[1], &t, t.small, small);
        run(argv[1], &t, only > 0 ? only : t.large, large);
        n_above = count_above(&t, only, small, large);
    }
    n_bad += n_above;
    return n_bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
