/* Signals while gnuplot hangs: the command ends at once by the signal and leaves neither a process
 * nor a file.
 *
 * Usage: interrupts PROGRAM FIXTURES WORK
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <glob.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

static pid_t start(char *const words[])
{
    pid_t pid = -1;
    if (posix_spawn(&pid, words[0], NULL, NULL, words, environ) != 0)
        abort();
    return pid;
}

/* Returns the exit status, or 128 plus the signal number. */
static int end_of(pid_t pid)
{
    int state = 0;
    while (waitpid(pid, &state, 0) < 0)
        if (errno != EINTR)
            abort();
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Returns the process id that the gnuplot of this test writes at its start. The next run removes a
 * folder that is left. */
static pid_t wait_for_gnuplot(pid_t report)
{
    char pattern[64];
    long number = 0;
    (void)snprintf(pattern, sizeof pattern, ".weartrack-%ld-*/plots/pid", (long)report);
    for (int i = 0; i < 1000 && number == 0; i++) {
        glob_t found = {0};
        FILE *file = glob(pattern, 0, NULL, &found) == 0 ? fopen(found.gl_pathv[0], "r") : NULL;
        if (file == NULL || fscanf(file, "%ld", &number) != 1)
            (void)usleep(10000);
        if (file != NULL)
            (void)fclose(file);
        globfree(&found);
    }
    return (pid_t)number;
}

static bool has_ended(pid_t pid)
{
    for (int i = 0; i < 200; i++) {
        char path[64], state = 'Z';
        (void)snprintf(path, sizeof path, "/proc/%ld/stat", (long)pid);
        FILE *file = fopen(path, "r");
        if (file == NULL || fscanf(file, "%*d (%*[^)]) %c", &state) != 1)
            state = 'Z';
        if (file != NULL)
            (void)fclose(file);
        if (state == 'Z')
            return true;
        (void)usleep(10000);
    }
    return false;
}

static bool try_signal(char *const report[], int number)
{
    const pid_t pid = start(report);
    const pid_t gnuplot = wait_for_gnuplot(pid);
    const double begin = now();
    (void)kill(pid, number);
    const int end = end_of(pid);
    const double took = now() - begin;
    struct stat info;
    const bool left = number != SIGKILL && system("ls -d .weartrack-* >left 2>/dev/null") == 0;
    const bool good = gnuplot > 0 && end == 128 + number && took < 3 && has_ended(gnuplot) &&
                      !left && stat("report", &info) != 0;
    printf("%s signal %d: ended with %d after %.2f s%s\n", good ? "ok  " : "FAIL", number, end,
           took, left ? ", something is left" : "");
    return good;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: %s PROGRAM FIXTURES WORK\n", argv[0]);
        return 2;
    }
    char command[4096], fake[4096];
    (void)snprintf(command, sizeof command, "rm -rf '%s' && mkdir -p '%s'", argv[3], argv[3]);
    if (system(command) != 0 || chdir(argv[3]) != 0)
        return 2;
    (void)snprintf(command, sizeof command,
                   "'%s' run -q --no-report -o case.h5 '%s/case/case.xml' >answer", argv[1],
                   argv[2]);
    if (system(command) != 0)
        return 2;
    (void)snprintf(fake, sizeof fake, "%s/fake", argv[3]);
    FILE *file = fopen(fake, "w");
    if (file == NULL)
        return 2;
    fprintf(file, "#!/bin/sh\ntrap '' TERM INT HUP\necho $$ >pid\nexec sleep 100\n");
    if (fclose(file) != 0 || chmod(fake, 0755) != 0)
        return 2;
    char *const report[] = {argv[1], "report", "case.h5", "-o", "report", "--gnuplot", fake, NULL};
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGKILL, SIGINT};
    bool good = true; /* The last run removes the files that the previous one left. */
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        good = try_signal(report, signals[i]) && good;
    return good ? 0 : 1;
}
