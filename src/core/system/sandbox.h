/* Sandbox: a separate process for a library that a malicious file may crash. Any end of the process
 * is an error for the caller and nothing more.
 *
 * The process is a fork of the caller without exec. It needs no helper program, sees the bytes as
 * they were checked, and has the library loaded. In a program with threads only the calling thread
 * is copied. The process may use memory (glibc keeps it consistent across a fork) and the library,
 * if the locks of the library are held during the fork (enter, leave).
 *
 * The process has default signal handlers and no open file except its output and one optional
 * input. It is confined (core/system/confinement.h). The signal handlers of the caller stay
 * unchanged. A handler that waits for every child may reap this process, and then only the cause of
 * a failure is unknown. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SANDBOX_H
#define WT_CORE_SYSTEM_SANDBOX_H

#include "weartrack/core.h"

typedef struct sandbox_limits {
    size_t memory, answer;        /* bytes */
    unsigned cpu_time, wall_time; /* s */
} sandbox_limits;
/* Returns limits for a file of this size, several times the needs of a valid file. */
sandbox_limits sandbox_limits_for(size_t size);

/* Descriptor of the input file in the process. */
enum { SANDBOX_FILE_FD = 4 };

typedef struct sandbox_call {
    const char *what; /* for messages: "HDF5" */
    /* Runs in the sandbox. It reads the required data and prints them. */
    wt_status (*reading)(const struct sandbox_call *request, FILE *answer, wt_error *err);
    const void *bytes;
    size_t size;
    const void *with;          /* argument for `reading` */
    int file;                  /* descriptor of the input, -1 without one */
    void (*enter)(void *hold); /* called before and after the fork; may be NULL */
    void (*leave)(void *hold);
    void *hold;
} sandbox_call;

/* Returns the output of `reading` in new memory, freed with free(). The output is not trustworthy,
 * because the file may have controlled the process. The error has no file name. */
wt_status sandbox_read(const sandbox_call *request, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err) WT_NODISCARD;

/* Variant that returns the output as a stream. */
typedef struct sandbox_stream sandbox_stream;
wt_status sandbox_start(const sandbox_call *request, const sandbox_limits *limits,
                        sandbox_stream **stream, wt_error *err) WT_NODISCARD;
/* Passes the output to `sink`, piece by piece, and ends the process. */
typedef wt_status sandbox_sink(void *user, const void *piece, size_t n, wt_error *err);
wt_status sandbox_drain(sandbox_stream *stream, sandbox_sink *sink, void *user,
                        wt_error *err) WT_NODISCARD;
void sandbox_close(sandbox_stream *stream); /* also before the end of the output; accepts NULL */

#endif
