/* Crafted result files that crash the HDF5 library. Every call of the command exits with status 0
 * or 1, prints a message on failure and leaves no partial result.
 *
 * Usage: crafted PROGRAM RESULT.h5 WORK
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/hdf5_damage.h"

#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FILES = 120, MAX_SOUND = 1 << 18 };

extern char **environ;

static const char *program;
static size_t n_good, n_refused, n_crashed, n_wrong;

/* Returns true if the file contains the word. Sets *empty if the file is empty. */
static bool file_contains(const char *path, const char *word, bool *empty)
{
    char text[4096];
    FILE *const in = fopen(path, "r");
    const size_t n = in != NULL ? fread(text, 1, sizeof text - 1, in) : 0;
    if (in != NULL)
        (void)fclose(in);
    text[n] = '\0';
    *empty = n == 0;
    return strstr(text, word) != NULL;
}

static void call(const char *what, char *const arguments[], const char *result)
{
    posix_spawn_file_actions_t actions;
    pid_t child = 0;
    int state = 0;
    bool silent = false;
    (void)posix_spawn_file_actions_init(&actions);
    (void)posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "words",
                                           O_CREAT | O_WRONLY | O_TRUNC, 0666);
    if (posix_spawn(&child, program, &actions, NULL, arguments, environ) != 0 ||
        waitpid(child, &state, 0) != child)
        abort();
    (void)posix_spawn_file_actions_destroy(&actions);
    const int status = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
    n_crashed += file_contains("words", "fails on this file", &silent);
    n_good += status == 0;
    n_refused += status == 1;
    const bool left = access(result, F_OK) == 0;
    if ((status != 0 && status != 1) || (status == 1 && silent) || left != (status == 0)) {
        (void)fprintf(stderr, "%s, %s: state %x, %s, %s\n", what, arguments[1], (unsigned)state,
                      silent ? "no words" : "words", left ? "a result" : "no result");
        n_wrong++;
    }
}

static int take_away(const char *path, const struct stat *info, int type, struct FTW *place)
{
    (void)info;
    (void)type;
    (void)place;
    return remove(path);
}

static void try(void *user, const char *what, const uint8_t *bytes, size_t size)
{
    (void)user;
    char *const convert[] = {"weartrack", "convert", "-q", "made.h5", "-o", "out.tsv", NULL};
    char *const report[] = {"weartrack", "report", "-q", "made.h5", "-o", "out", NULL};
    FILE *const out = fopen("made.h5", "wb");
    if (out == NULL || fwrite(bytes, 1, size, out) != size || fclose(out) != 0)
        abort();
    (void)unlink("out.tsv");
    (void)nftw("out", take_away, 8, FTW_DEPTH | FTW_PHYS);
    call(what, convert, "out.tsv");
    call(what, report, "out/index.html");
}

int main(int argc, char *argv[])
{
    static uint8_t sound[MAX_SOUND];
    FILE *const in = argc == 4 ? fopen(argv[2], "rb") : NULL;
    const size_t size = in != NULL ? fread(sound, 1, sizeof sound, in) : 0;
    if (in == NULL || fclose(in) != 0 ||
        (mkdir(argv[3], 0777) != 0 && access(argv[3], W_OK) != 0) || chdir(argv[3]) != 0)
        return EXIT_FAILURE;
    program = argv[1];
    try(NULL, "as it is", sound, size);
    if (n_good != 2)
        n_wrong++;
    n_wrong += hdf5_damage(sound, size, FILES, try, NULL) != FILES;
    (void)printf("%zu calls good, %zu refused, of which HDF5 crashed in %zu; %zu wrong\n", n_good,
                 n_refused, n_crashed, n_wrong);
    return n_wrong == 0 && n_crashed > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
