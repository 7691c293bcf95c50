/* Runs command-line cases from plain text files: arguments, standard input, expected output and
 * exit status. Usage: run_cases PROGRAM FIXTURES SHARED WORK CASES.txt
 *
 * A case file has one directive per line:
 *   case NAME                     begins a case
 *   needs PATH                    the case is skipped where PATH is absent
 *   copy FROM TO                  a file is copied before the run
 *   cut N FROM TO                 its first N bytes are
 *   write TO TEXT                 a file with this text (\n, \t, \\ and \xHH are understood)
 *   run ARGUMENT ...              one call of the program; "..." holds blanks together
 *   pipe ARGUMENT ...             a further call that reads what the one before it printed
 *   stdin PATH                    standard input of the first call
 *   exit N                        expected exit status of the last call, 0 without this line; 0
 *                                 is expected of those before it in a pipe too
 *   stdout ~ REGEX                some line matches (extended regular expression); also stderr
 *   stdout ! REGEX                no line matches
 *   stdout empty
 *   file PATH, nofile PATH        exists or not after the run
 *   same PATH PATH                two files are byte-identical
 *   differ PATH PATH              both files are there and are not
 * $FIXTURES, $SHARED and $WORK stand for folders; the case runs in a fresh $WORK.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <regex.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAX_WORDS = 64, MAX_CALLS = 8, MAX_LINES = 64, LINE = 4096 };

extern char **environ;

static const char *program, *folders[3];
static const char *const variables[3] = {"$FIXTURES", "$SHARED", "$WORK"};

static void expand(const char *in, char *out, size_t size)
{
    size_t n = 0;
    while (*in != '\0' && n + 1 < size) {
        int v = 0;
        while (v < 3 && strncmp(in, variables[v], strlen(variables[v])) != 0)
            v++;
        if (v < 3) {
            n += (size_t)snprintf(out + n, size - n, "%s", folders[v]);
            in += strlen(variables[v]);
        } else {
            out[n++] = *in++;
        }
        if (n >= size)
            n = size - 1;
    }
    out[n] = '\0';
}

/* Splits the line in place; "..." is one argument. */
static int split(char *text, char **words)
{
    int n = 0;
    char *to = text;
    while (n < MAX_WORDS - 1) {
        while (*text == ' ')
            text++;
        if (*text == '\0')
            break;
        words[n++] = to;
        bool quoted = false;
        for (; *text != '\0' && (quoted || *text != ' '); text++) {
            if (*text == '"')
                quoted = !quoted;
            else
                *to++ = *text;
        }
        const bool end = *text == '\0';
        if (!end)
            text++;
        *to++ = '\0';
        if (end)
            break;
    }
    words[n] = NULL;
    return n;
}

static char *slurp(const char *path, size_t *length)
{
    FILE *f = fopen(path, "rb");
    if (f == NULL)
        return NULL;
    size_t n = 0, size = 65536;
    char *text = malloc(size);
    for (size_t got; text != NULL && (got = fread(text + n, 1, size - n - 1, f)) > 0;) {
        n += got;
        if (size - n < 2) {
            size *= 2;
            text = realloc(text, size);
        }
    }
    fclose(f);
    if (text != NULL)
        text[n] = '\0';
    if (length != NULL)
        *length = n;
    return text;
}

static bool write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    if (f == NULL)
        return false;
    for (const char *p = text; *p != '\0'; p++) {
        if (*p != '\\' || p[1] == '\0') {
            fputc(*p, f);
            continue;
        }
        p++;
        unsigned byte = 0;
        if (*p == 'n')
            fputc('\n', f);
        else if (*p == 't')
            fputc('\t', f);
        else if (*p == 'x' && sscanf(p + 1, "%2x", &byte) == 1) {
            fputc((int)byte, f);
            p += 2;
        } else
            fputc(*p, f);
    }
    return fclose(f) == 0;
}

static int call(char **words, const char *in, const char *out, const char *err, bool append)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, in, O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&actions, 2, err,
                                     O_WRONLY | O_CREAT | (append ? O_APPEND : O_TRUNC), 0644);
    pid_t pid;
    const int failed = posix_spawn(&pid, program, &actions, NULL, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        return -1;
    int status = 0;
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* ---- one case ----------------------------------------------------------------------------- */

typedef struct {
    char name[256];
    char lines[MAX_LINES][LINE];
    int n;
} cli_case;

static bool matches(const char *text, const char *pattern, bool *bad)
{
    regex_t regex;
    *bad = regcomp(&regex, pattern, REG_EXTENDED | REG_NEWLINE | REG_NOSUB) != 0;
    if (*bad)
        return false;
    const bool found = regexec(&regex, text, 0, NULL, 0) == 0;
    regfree(&regex);
    return found;
}

static bool check_text(const char *what, const char *text, const char *rule)
{
    if (strcmp(rule, "empty") == 0) {
        if (*text == '\0')
            return true;
        printf("  %s is not empty\n", what);
        return false;
    }
    if ((rule[0] != '~' && rule[0] != '!') || rule[1] != ' ') {
        printf("  unknown rule: %s %s\n", what, rule);
        return false;
    }
    bool bad = false;
    const bool found = matches(text, rule + 2, &bad);
    if (bad) {
        printf("  not a regular expression: %s\n", rule + 2);
        return false;
    }
    if (found == (rule[0] == '~'))
        return true;
    printf("  %s %s: %s\n", what, found ? "has what it must not have" : "does not match", rule + 2);
    return false;
}

static bool compare_files(char *rest, bool wanted)
{
    char *words[MAX_WORDS + 1];
    if (split(rest, words) != 2)
        return false;
    size_t n[2] = {0, 0};
    char *a = slurp(words[0], &n[0]), *b = slurp(words[1], &n[1]);
    const bool same = a != NULL && b != NULL && n[0] == n[1] && memcmp(a, b, n[0]) == 0;
    const bool read = a != NULL && b != NULL;
    if (!read || same != wanted)
        printf("  %s and %s %s\n", words[0], words[1],
               !read  ? "cannot be read"
               : same ? "are the same"
                      : "differ");
    free(a);
    free(b);
    return read && same == wanted;
}

static bool starts(const char *line, const char *word, char **rest)
{
    const size_t n = strlen(word);
    if (strncmp(line, word, n) != 0 || (line[n] != ' ' && line[n] != '\0'))
        return false;
    *rest = (char *)line + n + (line[n] == ' ');
    return true;
}

static void fresh_work(void)
{
    char command[LINE];
    snprintf(command, sizeof command, "rm -rf '%s' && mkdir -p '%s'", folders[2], folders[2]);
    if (system(command) != 0 || chdir(folders[2]) != 0)
        abort();
}

/* Returns 1 if the case passed, 0 if it failed and -1 if it was skipped. */
static int run_case(cli_case *c)
{
    char out[2][LINE], err[LINE], first_in[LINE] = "/dev/null", *rest;
    struct stat st;
    fresh_work();
    snprintf(out[0], LINE, "%s/.out0", folders[2]);
    snprintf(out[1], LINE, "%s/.out1", folders[2]);
    snprintf(err, LINE, "%s/.err", folders[2]);
    int status = -1, expected = 0, calls = 0, upstream = 0;
    bool good = true;

    for (int i = 0; i < c->n; i++) {
        char *words[MAX_WORDS + 1];
        if (starts(c->lines[i], "needs", &rest)) {
            if (stat(rest, &st) != 0)
                return -1;
        } else if (starts(c->lines[i], "stdin", &rest)) {
            snprintf(first_in, sizeof first_in, "%s", rest);
        } else if (starts(c->lines[i], "copy", &rest)) {
            char command[2 * LINE];
            snprintf(command, sizeof command, "cp -r %s", rest);
            if (system(command) != 0)
                good = false;
        } else if (starts(c->lines[i], "cut", &rest)) {
            char command[2 * LINE];
            snprintf(command, sizeof command, "set -- %s; head -c $1 \"$2\" > \"$3\"", rest);
            if (system(command) != 0)
                good = false;
        } else if (starts(c->lines[i], "write", &rest)) {
            char *blank = strchr(rest, ' ');
            if (blank == NULL)
                continue;
            *blank = '\0';
            if (!write_file(rest, blank + 1))
                good = false;
        } else if (starts(c->lines[i], "run", &rest) || starts(c->lines[i], "pipe", &rest)) {
            const bool piped = c->lines[i][0] == 'p';
            if (piped && status != 0)
                upstream = status;
            char name[] = "weartrack";
            words[0] = name;
            split(rest, words + 1);
            const char *in = piped ? out[(calls + 1) % 2] : first_in;
            status = call(words, in, out[calls % 2], err, piped);
            calls++;
        } else if (starts(c->lines[i], "exit", &rest)) {
            expected = atoi(rest);
        }
    }
    if (calls == 0) {
        printf("  nothing is run\n");
        return 0;
    }
    if (expected == 0 && upstream != 0)
        status = upstream;
    if (status != expected) {
        printf("  exit status %d, expected %d\n", status, expected);
        good = false;
    }
    char *text_out = slurp(out[(calls + 1) % 2], NULL), *text_err = slurp(err, NULL);
    for (int i = 0; i < c->n && text_out != NULL && text_err != NULL; i++) {
        if (starts(c->lines[i], "stdout", &rest))
            good = check_text("stdout", text_out, rest) && good;
        else if (starts(c->lines[i], "stderr", &rest))
            good = check_text("stderr", text_err, rest) && good;
        else if (starts(c->lines[i], "file", &rest) && stat(rest, &st) != 0) {
            printf("  %s is missing\n", rest);
            good = false;
        } else if (starts(c->lines[i], "nofile", &rest) && stat(rest, &st) == 0) {
            printf("  %s must not be there\n", rest);
            good = false;
        } else if (starts(c->lines[i], "same", &rest))
            good = compare_files(rest, true) && good;
        else if (starts(c->lines[i], "differ", &rest))
            good = compare_files(rest, false) && good;
    }
    if (!good && text_out != NULL && text_err != NULL)
        printf("  --- stdout\n%.2000s\n  --- stderr\n%.2000s\n", text_out, text_err);
    free(text_out);
    free(text_err);
    return good ? 1 : 0;
}

int main(int argc, char **argv)
{
    if (argc != 6) {
        fprintf(stderr, "usage: %s PROGRAM FIXTURES SHARED WORK CASES.txt\n", argv[0]);
        return 2;
    }
    program = argv[1];
    for (int i = 0; i < 3; i++)
        folders[i] = argv[2 + i];
    FILE *in = fopen(argv[5], "r");
    cli_case *c = calloc(1, sizeof *c);
    if (in == NULL || c == NULL) {
        fprintf(stderr, "%s: %s\n", argv[5], strerror(errno));
        return 2;
    }
    int passed = 0, failed = 0, skipped = 0;
    char line[LINE], *rest;
    for (bool more = true; more;) {
        more = fgets(line, sizeof line, in) != NULL;
        if (more)
            line[strcspn(line, "\n")] = '\0';
        if (!more || starts(line, "case", &rest)) {
            if (c->n > 0) {
                const int result = run_case(c);
                printf("%s %s\n", result > 0 ? "ok  " : result < 0 ? "skip" : "FAIL", c->name);
                fflush(stdout);
                *(result > 0 ? &passed : result < 0 ? &skipped : &failed) += 1;
            }
            memset(c, 0, sizeof *c);
            if (more)
                snprintf(c->name, sizeof c->name, "%.250s", rest);
        } else if (*line != '\0' && *line != '#' && c->n < MAX_LINES) {
            expand(line, c->lines[c->n++], LINE);
        }
    }
    fclose(in);
    free(c);
    printf("%d passed, %d failed, %d skipped\n", passed, failed, skipped);
    if (passed + failed == 0)
        return skipped > 0 ? 77 : 1;
    return failed > 0;
}
