/* A separate folder for each test that writes reports, and functions that examine it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_REPORT_FOLDER_H
#define WT_TESTS_REPORT_FOLDER_H

#include "assert_near.h"
#include "weartrack/report.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Each test has its own folder, so that tests are independent. */
static inline int create_work_folder(void **state)
{
    char *folder = strdup("/tmp/weartrack-report-XXXXXX");
    if (folder == NULL || mkdtemp(folder) == NULL || chdir(folder) != 0)
        return -1;
    *state = folder;
    return 0;
}

static inline void remove_all(const char *path)
{
    DIR *folder = unlink(path) == 0 ? NULL : opendir(path); // a link is removed, not followed
    if (folder == NULL)
        return;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        char *inner = wt_path_join(path, entry->d_name);
        remove_all(inner);
        free(inner);
    }
    closedir(folder);
    (void)rmdir(path);
}

static inline int remove_work_folder(void **state)
{
    int status = chdir("/");
    remove_all(*state);
    free(*state);
    return status;
}

static inline char *read_all(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        fail_msg("%s is not there", path);
    (void)fseek(file, 0, SEEK_END);
    long size = ftell(file);
    assert_true(size >= 0);
    rewind(file);
    char *bytes = malloc((size_t)size + 1);
    assert_non_null(bytes);
    *length = fread(bytes, 1, (size_t)size, file);
    bytes[*length] = '\0';
    (void)fclose(file);
    return bytes;
}

static inline void write_all(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static inline bool exists(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0;
}

static inline size_t count_files(const char *path)
{
    size_t n = 0;
    DIR *folder = opendir(path);
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        n += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return n;
}

/* Programs inherit this variable, which identifies them. */
#define PROGRAM_MARK "WEARTRACK_TEST_PROGRAM"

static inline bool has_program_mark(const char *process)
{
    char path[300], line[64], bytes[1 << 16];
    (void)snprintf(path, sizeof path, "/proc/%.250s/environ", process);
    (void)snprintf(line, sizeof line, PROGRAM_MARK "=%ld", (long)getpid());
    FILE *file = fopen(path, "rb");
    const size_t n = file != NULL ? fread(bytes, 1, sizeof bytes, file) : 0; // none of a zombie
    if (file != NULL)
        (void)fclose(file);
    return memmem(bytes, n, line, strlen(line) + 1) != NULL;
}

static inline pid_t find_program(void)
{
    pid_t found = 0;
    DIR *all = opendir("/proc");
    assert_non_null(all);
    for (const struct dirent *entry; found == 0 && (entry = readdir(all)) != NULL;)
        if (entry->d_name[0] >= '1' && entry->d_name[0] <= '9' && has_program_mark(entry->d_name))
            found = (pid_t)atol(entry->d_name);
    closedir(all);
    return found;
}

static inline void mark_programs(void)
{
    char number[32];
    (void)snprintf(number, sizeof number, "%ld", (long)getpid());
    assert_int_equal(setenv(PROGRAM_MARK, number, 1), 0);
}

/* Returns true if every program and its children end within five seconds, because a kill takes a
 * moment. */
static inline bool all_programs_end(void)
{
    for (int i = 0; i < 500 && find_program() != 0; i++)
        (void)usleep(10000);
    return find_program() == 0;
}

static inline bool gnuplot_is_installed(void)
{
    const char *path = getenv("PATH");
    char *copy = strdup(path != NULL ? path : ""), *rest = NULL;
    bool found = false;
    for (char *part = strtok_r(copy, ":", &rest); part != NULL && !found;
         part = strtok_r(NULL, ":", &rest)) {
        char *program = wt_path_join(part, "gnuplot");
        found = program != NULL && access(program, X_OK) == 0;
        free(program);
    }
    free(copy);
    return found;
}

#define NEED_GNUPLOT()                                                                             \
    do {                                                                                           \
        if (!gnuplot_is_installed())                                                               \
            skip();                                                                                \
    } while (0)

static inline void write_report(const wt_result *result, const char *folder,
                                const wt_report_options *options)
{
    wt_error err = WT_ERROR_INIT;
    if (wt_report_write(result, folder, options, NULL, &err) != WT_OK) {
        char line[1600];
        (void)wt_error_format(&err, line, sizeof line);
        fail_msg("%s", line);
    }
}

#endif
