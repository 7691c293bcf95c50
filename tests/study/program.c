/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"

#include <fcntl.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define ARGUMENTS_MAX 60
#define SECONDS_MAX 120

/* Runs in the child: only async-signal-safe functions. */
static void exec_program(const char *program, const char *const *arguments, const char *errors)
{
    const char *all[ARGUMENTS_MAX + 2] = {program};
    const struct rlimit limit = {SECONDS_MAX, SECONDS_MAX};
    const int nothing = open("/dev/null", O_RDWR);
    const int words = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    for (int i = 0; arguments[i] != NULL && i < ARGUMENTS_MAX; i++)
        all[i + 1] = arguments[i];
    setrlimit(RLIMIT_CPU, &limit);
    if (nothing < 0 || words < 0 || dup2(nothing, 0) < 0 || dup2(nothing, 1) < 0 ||
        dup2(words, 2) < 0)
        _exit(127);
    execv(program, (char *const *)all);
    _exit(127);
}

int program_run(const char *program, const char *const *arguments, const char *errors)
{
    int status;
    const pid_t child = fork();
    if (child == 0)
        exec_program(program, arguments, errors);
    if (child < 0 || waitpid(child, &status, 0) != child)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
