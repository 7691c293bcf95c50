/* What a map costs in memory: a small and a large one, told, fitted and converted in every
 * direction. Peak memory, carried on to 65,536 curves, must stay below 100 MB, and moduli and files
 * must be the same to the last digit whichever way they came.
 * Usage: big_map PROGRAM WORK files|text|blocks [CURVES [SAMPLES]]: one map of so many curves, of
 * so many samples in each of two segments, instead, whose peaks are printed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/jpk_writer.h"
#include "writers/nanoscope_writer.h"
#include "writers/nid_writer.h"

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
enum { ASKED = 65536, MOST_MB = 100, KINDS = 64, MOST_SAMPLES = 200, MOST_CALLS = 12 };

extern char **environ;

static const double modulus = 4e6, radius = 1e-6, contact = 0.6e-6, spring_constant = 2;

static double height[2][KINDS][MOST_SAMPLES], force[2][KINDS][MOST_SAMPLES];
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
static void make_kinds(size_t n)
{
    for (size_t c = 0; c < KINDS; c++)
        for (size_t way = 0; way < 2; way++)
            for (size_t i = 0; i < n; i++) {
                const double at = (double)(way == 0 ? i : n - 1 - i) / (double)(n - 1);
                const double position = 1e-6 * at, depth = fmax(position - contact, 0);
                const double pushed = 4. / 3 * modulus / 0.75 * sqrt(radius) * pow(depth, 1.5);
                force[way][c][i] = pushed + 1e-9 * noise();
                height[way][c][i] = -(position + pushed / spring_constant);
            }
}

static void write_map(size_t n, size_t samples)
{
    static jpk_writer_segment segments[KINDS][2];
    jpk_writer_curve *const curves = calloc(n, sizeof *curves);
    jpk_writer_file file = jpk_writer_defaults();
    const long side = (long)ceil(sqrt((double)n));
    if (curves == NULL)
        abort();
    for (size_t i = 0; i < 2 * (size_t)KINDS; i++)
        segments[i / 2][i % 2] = (jpk_writer_segment){.style = i % 2 == 0 ? "extend" : "retract",
                                                      .n = samples,
                                                      .duration = 0.5,
                                                      .height = height[i % 2][i / 2],
                                                      .force = force[i % 2][i / 2]};
    for (size_t i = 0; i < n; i++)
        curves[i] = (jpk_writer_curve){i, 1e-6 * (double)(i % (size_t)side),
                                       1e-6 * (double)(i / (size_t)side), 2, segments[i % KINDS]};
    file.path = MAP;
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

/* The values of all curves, way in and way out one behind the other, or `way` alone. */
static double *all_values(size_t n, size_t samples, int way,
                          double value(size_t kind, size_t way, size_t i, size_t samples))
{
    const size_t ways = way < 0 ? 2 : 1;
    double *const values = calloc(n * ways * samples, sizeof *values);
    if (values == NULL)
        abort();
    for (size_t c = 0, at = 0; c < n; c++)
        for (size_t w = 0; w < ways; w++)
            for (size_t i = 0; i < samples; i++)
                values[at++] = value(c % KINDS, way < 0 ? w : (size_t)way, i, samples);
    return values;
}

static double height_of(size_t kind, size_t way, size_t i, size_t samples)
{
    (void)samples;
    return height[way][kind][i];
}

static double force_of(size_t kind, size_t way, size_t i, size_t samples)
{
    (void)samples;
    return force[way][kind][i];
}

/* Where the piezo and not the tip moves evenly: the depth that balances the lever, by bisection,
 * and the noise of the kind. */
static double volts_of(size_t kind, size_t way, size_t i, size_t samples)
{
    const double at = (double)(way == 0 ? i + 1 : samples - i) / (double)samples;
    const double pressed = 1e-6 * at - contact;
    double low = 0, high = fmax(pressed, 0);
    for (int k = 0; k < 60; k++) {
        const double depth = (low + high) / 2;
        const double pushed = 4. / 3 * modulus / 0.75 * sqrt(radius) * pow(depth, 1.5);
        *(depth + pushed / spring_constant < pressed ? &low : &high) = depth;
    }
    const double still = force[0][kind][i * 37 % (samples / 2)];
    return (fmax(pressed, 0) - low + still / spring_constant) / 60e-9;
}

static void write_blocks(size_t n, size_t samples)
{
    double *const volts = all_values(n, samples, -1, volts_of);
    const nanoscope_writer_channel channel = {"Deflection Error", "Sens. DeflSens", 3e-4, volts};
    const nanoscope_writer_file spm = {.path = "map.spm",
                                       .volume = true,
                                       .side = (size_t)lrint(sqrt((double)n)),
                                       .n_in = samples,
                                       .n_out = samples,
                                       .width = 4,
                                       .ramp_volts = 100,
                                       .z_sensitivity = 10,
                                       .deflection_sensitivity = 60,
                                       .spring_constant = spring_constant,
                                       .rate = 200,
                                       .n_channels = 1,
                                       .channels = &channel};
    if (nanoscope_write(&spm) != 0)
        abort();
    free(volts);
    static const char *const names[] = {"Spec forward", "Spec backward"};
    nid_writer_channel channels[2][2];
    nid_writer_group groups[2];
    nid_writer_file nid = nid_writer_defaults();
    for (int way = 0; way < 2; way++) {
        channels[way][0] = (nid_writer_channel){
            0, "Deflection", "N", -1e-5, 2e-5, 32, all_values(n, samples, way, force_of)};
        channels[way][1] = (nid_writer_channel){
            1, "Z-Axis", "m", -1e-5, 2e-5, 32, all_values(n, samples, way, height_of)};
        groups[way] = (nid_writer_group){.name = names[way],
                                         .points = samples,
                                         .lines = n,
                                         .x_name = "Z",
                                         .x_unit = "m",
                                         .y_name = "Curve",
                                         .y_unit = "",
                                         .x_range = 1e-6,
                                         .y_range = 1,
                                         .n_channels = 2,
                                         .channels = channels[way]};
    }
    nid.path = "map.nid";
    nid.n_groups = 2;
    nid.groups = groups;
    nid.spring_constant = spring_constant;
    nid.forward_time = nid.backward_time = 0.5;
    nid.forward_points = nid.backward_points = samples;
    nid.forward_range = 1e-6;
    if (nid_write(&nid) != 0)
        abort();
    for (size_t i = 0; i < 4; i++)
        free((void *)channels[i / 2][i % 2].values);
}

/* A process that writes what is in a file into a pipe, whose other end is returned. */
static int feed(const char *path, pid_t *writer)
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
        if (write(ends[1], piece, (size_t)got) != got) /* a pipe takes all, or ends this process */
            _exit(EXIT_FAILURE);
    _exit(EXIT_SUCCESS);
}

/* Peak memory of a call, which must succeed [MB]; that of processes which it waited for counts.
 * What it reads of standard input is map.tsv, through a pipe. */
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
        input = feed("map.tsv", &writer);
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
/* What is done one after the other, and which files must be alike afterwards. */
typedef struct trial {
    const char *name;
    void (*write)(size_t n, size_t samples); /* the map or the maps */
    size_t small, large, samples;
    const char *calls[MOST_CALLS][12];
    const char *moduli[3];   /* that are those of moduli.tsv */
    const char *files[2][2]; /* byte for byte */
} trial;

static const trial trials[] = {
    {.name = "files",
     .write = write_map,
     .small = 1024,
     .large = 8192,
     .samples = 200,
     .calls = {{"info", MAP},
               {INDENT, MAP, "-o", "moduli.tsv"},
               {CONVERT, MAP, "-o", "map.h5"},
               {"info", "map.h5"},
               {INDENT, "map.h5", "-o", "h5.tsv"},
               {CONVERT, "map.h5", "-o", "again.h5"},
               {INDENT, MAP, "-o", "rows.h5"}},
     .moduli = {"h5.tsv"},
     .files = {{"map.h5", "again.h5"}}},
    {.name = "text",
     .write = write_map,
     .small = 512,
     .large = 4096,
     .samples = 50,
     .calls = {{INDENT, MAP, "-o", "moduli.tsv"},
               {CONVERT, MAP, "-o", "map.tsv"},
               {"info", "map.tsv"},
               {INDENT, "map.tsv", "-o", "text.tsv"},
               {CONVERT, "map.tsv", "-o", "again.tsv"},
               {CONVERT, "-", "-o", "text.h5"},
               {INDENT, "text.h5", "-o", "h5.tsv"},
               {CONVERT, "text.h5", "-o", "back.tsv"},
               {CONVERT, MAP, "-o", "map.h5"},
               {CONVERT, "map.h5", "-o", "direct.tsv"}},
     .moduli = {"text.tsv", "h5.tsv"},
     .files = {{"again.tsv", "back.tsv"}, {"map.tsv", "direct.tsv"}}},
    {.name = "blocks",
     .write = write_blocks,
     .small = 1024,
     .large = 4096,
     .samples = 200,
     .calls = {{INDENT, "map.spm", "-o", "moduli.tsv"},
               {"info", "map.spm"},
               {CONVERT, "map.spm", "-o", "map.h5"},
               {INDENT, "map.h5", "-o", "h5.tsv"},
               {INDENT, "map.nid", "-o", "nid.tsv"},
               {"info", "map.nid"},
               {CONVERT, "map.nid", "-o", "nid.h5"},
               {INDENT, "nid.h5", "-o", "nid-h5.tsv"}},
     .moduli = {"h5.tsv"}},
};
enum { TRIALS = sizeof trials / sizeof *trials };

static bool next_row(FILE *in, char *row, size_t size)
{
    while (fgets(row, (int)size, in) != NULL)
        if (row[0] != '#' && row[0] != '\n')
            return true;
    return false;
}

/* The number of a column of the table, which must be there. */
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

/* The rows of moduli agree, and are moduli, apart from the name of the file and what only one
 * format says. */
static void compare(const char *name, size_t n)
{
    static char a[4096], b[4096];
    FILE *const x = fopen("moduli.tsv", "r"), *const y = fopen(name, "r");
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
                agree = agree && fabs(strtod(u, NULL) - modulus) < 0.2 * modulus;
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

static void run(const char *program, const trial *t, size_t n, double peaks[MOST_CALLS])
{
    /* In a process of its own: a program counts the peak of the one that started it as its own. */
    const pid_t writer = fork();
    int state = 0;
    if (writer == 0) {
        t->write(n, t->samples);
        _exit(EXIT_SUCCESS);
    }
    if (waitpid(writer, &state, 0) != writer || state != 0)
        abort();
    for (size_t i = 0; i < MOST_CALLS && t->calls[i][0] != NULL; i++)
        peaks[i] = peak(program, t->calls[i]);
    for (size_t i = 0; t->moduli[i] != NULL; i++)
        compare(t->moduli[i], n);
    for (size_t i = 0; i < 2 && t->files[i][0] != NULL; i++)
        compare_bytes(t->files[i]);
}

static void tell(const char *const *call)
{
    for (; *call != NULL; call++)
        if (strcmp(*call, "-q") == 0 || strcmp(*call, "--no-provenance") == 0)
            continue;
        else if (strcmp(*call, "--tip") == 0 || strcmp(*call, "--threads") == 0)
            call++;
        else if (strcmp(*call, "-o") != 0)
            (void)printf("%s ", *call);
}

int main(int argc, char **argv)
{
    double small[MOST_CALLS] = {0}, large[MOST_CALLS] = {0};
    size_t which = 0;
    while (which < TRIALS && (argc < 4 || strcmp(argv[3], trials[which].name) != 0))
        which++;
    if (which == TRIALS || (mkdir(argv[2], 0777) != 0 && access(argv[2], W_OK) != 0) ||
        chdir(argv[2]) != 0)
        return 2;
    trial t = trials[which];
    const size_t only = argc > 4 ? strtoul(argv[4], NULL, 10) : 0;
    const size_t samples = argc > 5 ? strtoul(argv[5], NULL, 10) : 0;
    if (samples > 1 && samples <= MOST_SAMPLES)
        t.samples = samples;
    make_kinds(t.samples);
    if (only == 0)
        run(argv[1], &t, t.small, small);
    run(argv[1], &t, only > 0 ? only : t.large, large);
    for (size_t i = 0; i < MOST_CALLS && t.calls[i][0] != NULL; i++) {
        const double at_most = only > 0
                                   ? large[i]
                                   : large[i] + (large[i] - small[i]) * (double)(ASKED - t.large) /
                                                    (double)(t.large - t.small);
        tell(t.calls[i]);
        (void)printf("%.1f MB, of %zu curves %.0f MB\n", large[i], only > 0 ? only : (size_t)ASKED,
                     at_most);
        if (!(at_most < MOST_MB))
            n_bad++;
    }
    return n_bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
