/* Runs Gwyddion on a file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/utf8.h"
#include "core/system/subprocess.h"
#include "core/system/temporary.h"
#include "read/bytes/input.h"
#include "read/bytes/scratch.h"
#include "read/gwyddion/gwyddion.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define CONVERTED_NAME "converted.gwy"

/* A map of 4000 x 4000 points takes 2 s. An upper bound of 2^27 points is 1 GiB as written by
 * Gwyddion, and Gwyddion holds up to four copies. */
const gwyddion_limits gwyddion_default_limits = {
    .time = 60, .cpu_time = 60, .file_size = (size_t)1 << 30, .memory = (size_t)4 << 30};
/* limit for the version query, which is fast [s] */
static const double VERSION_TIME = 10;

/* Builds the name of the copy. Gwyddion uses only the suffix of the name. */
static void build_copy_name(const char *file, char name[32])
{
    const char *const dot = strrchr(file, '.');
    char ending[16] = "";
    if (dot != NULL && strlen(dot) < sizeof ending)
        snprintf(ending, sizeof ending, "%s", dot);
    for (char *p = ending; *p != '\0'; p++)
        if (p > ending && !isalnum((unsigned char)*p))
            ending[0] = '\0';
    snprintf(name, 32, "surface%s", ending);
}

static wt_status write_copy(wt_input *input, const char *folder, const char *name, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    char *const path = wt_path_join(folder, name);
    if (path == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0)
        status = wt_fail(err, WT_E_IO, "no copy for Gwyddion: %s", strerror(errno));
    else
        status = scratch_write(file, bytes, length, wt_input_name(input), err);
    if (file >= 0)
        close(file);
    free(path);
    return status;
}

static wt_status add_export_advice(wt_error *err)
{
    wt_error_advice(err,
                    "see whether Gwyddion opens the file, and save it there as .gwy; or export "
                    "it as .x3p, .gwy or .gsf");
    return WT_E_TOOL;
}

static wt_status fail_tool(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_TOOL, "%s", what);
    return add_export_advice(err);
}

static wt_status check_program_end(const program_result *end, double limit, wt_error *err)
{
    switch (end->outcome) {
    case PROGRAM_NOT_STARTED:
        if (end->code == ENOENT)
            wt_fail(err, WT_E_TOOL,
                    "such a file is read by the program Gwyddion, which is missing");
        else
            wt_fail(err, WT_E_TOOL, "the program Gwyddion cannot be started: %s",
                    strerror(end->code));
        wt_error_advice(err, "install Gwyddion (apt-get install gwyddion), or export the file as "
                             ".x3p, .gwy or .gsf");
        return WT_E_TOOL;
    case PROGRAM_SIGNALLED:
        wt_fail(err, WT_E_TOOL, "Gwyddion failed on the file: it was ended by signal %d",
                end->code);
        return add_export_advice(err);
    case PROGRAM_EXITED:
        if (end->code == 0)
            return WT_OK;
        wt_fail(err, WT_E_TOOL, "Gwyddion cannot read the file: it ended with exit status %d",
                end->code);
        return add_export_advice(err);
    case PROGRAM_TOO_LONG:
    case PROGRAM_CANCELLED:
    default:
        wt_fail(err, WT_E_TOOL, "Gwyddion did not end within %g s", limit);
        return add_export_advice(err);
    }
}

static wt_status run_gwyddion(const char *folder, const char *const *arguments,
                              const gwyddion_limits *limits, program_result *end, wt_error *err)
{
    /* Gwyddion must not see settings of the user or a display. */
    static const char *const hidden[] = {"HOME=", "XDG_",     "DISPLAY=", "WAYLAND_", "DBUS_",
                                         "GTK",   "GWYDDION", "G_",       "TMPDIR=",  NULL};
    char *home = NULL;
    if (asprintf(&home, "HOME=%s", folder) < 0)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    const char *const added[] = {home, NULL};
    const program_call call = {.program = "gwyddion",
                               .arguments = arguments,
                               .folder = folder,
                               .hidden = hidden,
                               .added = added,
                               .limit = limits->time,
                               .file_size = limits->file_size,
                               .memory = limits->memory,
                               .cpu_time = limits->cpu_time};
    const wt_status status = program_run(&call, end, err);
    free(home);
    return status;
}

/* Reads the converted bytes, so that the folder can be removed. Only a regular file is accepted. */
static wt_status read_converted(const char *folder, const char *name, size_t max_size,
                                wt_input **converted, wt_error *err)
{
    struct stat known;
    char *const path = wt_path_join(folder, CONVERTED_NAME), *bytes = NULL;
    if (path == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = WT_OK;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    free(path);
    if (file < 0 || fstat(file, &known) != 0 || !S_ISREG(known.st_mode) || known.st_size == 0) {
        status = fail_tool("Gwyddion made nothing of the file", err);
    } else if ((size_t)known.st_size >= max_size) { /* it was truncated at the limit */
        status = fail_tool("Gwyddion made more of the file than is read", err);
    } else {
        const size_t length = (size_t)known.st_size;
        size_t done = 0;
        ssize_t got = 1;
        bytes = malloc(length + 1);
        while (bytes != NULL && done < length && got > 0) {
            got = read(file, bytes + done, length - done);
            done += got > 0 ? (size_t)got : 0;
        }
        if (bytes == NULL)
            status = wt_fail(err, WT_E_MEMORY, "no memory for what Gwyddion wrote");
        else if (done < length)
            status = fail_tool("what Gwyddion wrote cannot be read", err);
        if (status == WT_OK) {
            bytes[length] = '\0';
            status = input_from_bytes(bytes, length, name, converted, err);
            bytes = NULL;
        }
    }
    free(bytes);
    if (file >= 0)
        close(file);
    return status;
}

static void read_version(const char *folder, const gwyddion_limits *limits, char version[64])
{
    static const char *const arguments[] = {"--version", NULL};
    gwyddion_limits short_time = *limits;
    program_result end;
    if (short_time.time > VERSION_TIME)
        short_time.time = VERSION_TIME;
    const bool known = run_gwyddion(folder, arguments, &short_time, &end, NULL) == WT_OK &&
                       end.outcome == PROGRAM_EXITED && end.code == 0 && end.words[0] != '\0';
    if (known)
        end.words[utf8_truncated_length(end.words, strlen(end.words), 63)] = '\0';
    snprintf(version, 64, "%.63s", known ? end.words : "Gwyddion of an unknown version");
    utf8_sanitize(version);
}

wt_status gwyddion_convert(wt_input *input, const gwyddion_limits *limits, wt_input **converted,
                           char version[64], wt_error *err)
{
    int held = -1;
    char name[32];
    program_result end;
    char *const place = realpath(temporary_directory(), NULL);
    if (place != NULL)
        temporary_remove_abandoned(place);
    char *const folder = place != NULL ? temporary_folder_create(place, &held) : NULL;
    if (folder == NULL || fchmod(held, 0700) != 0) {
        wt_fail(err, WT_E_IO, "no temporary folder for Gwyddion: %s", strerror(errno));
        wt_error_advice(err, "set TMPDIR to a folder with room for the height map");
        free(place);
        free(folder);
        return WT_E_IO;
    }
    free(place);
    build_copy_name(wt_input_name(input), name);
    const char *const arguments[] = {"--convert-to-gwy=" CONVERTED_NAME, name, NULL};
    wt_status status = write_copy(input, folder, name, err);
    if (status == WT_OK)
        status = run_gwyddion(folder, arguments, limits, &end, err);
    if (status == WT_OK)
        status = check_program_end(&end, limits->time, err);
    if (status == WT_OK)
        status = read_converted(folder, wt_input_name(input), limits->file_size, converted, err);
    if (status == WT_OK)
        read_version(folder, limits, version);
    temporary_remove(folder);
    close(held);
    free(folder);
    return status;
}
