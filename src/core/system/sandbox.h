/* A process of its own for a library that hostile bytes may crash: its end, however it comes, is an
 * error here and nothing more.
 *
 * The process is a fork of the caller, without an exec: it needs no helper program that would have
 * to be found, it sees the bytes as they were checked, and it begins with the library loaded. In a
 * program with threads it has the calling one alone. What it uses is safe then: memory (glibc keeps
 * it whole across a fork) and the library, if its locks are held while the process is made (enter,
 * leave).
 *
 * The process has the signals of a new one, no open file but its answer and one that it may be
 * given, can open and write none, leaves no core file and does not outlive the caller. What it may
 * take is limited. The caller's signal handlers are left alone: one that waits for every child may
 * take this one too, and then only the cause of a failure stays unknown.
 *
 * Not promised: that a made file cannot run code in that process; but that code has nothing to do
 * there but give a wrong answer. Where the system has no such filter or no /proc,
 * wt_sandbox_limitations (weartrack/base.h) says what then is open. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SANDBOX_H
#define WT_CORE_SYSTEM_SANDBOX_H

#include "weartrack/base.h"

#include <stdio.h>

typedef struct sandbox_limits {
    size_t memory, answer;        /* bytes */
    unsigned cpu_time, wall_time; /* s */
} sandbox_limits;
/* What a file of this size may take: several times what a sound one does. */
sandbox_limits sandbox_limits_for(size_t size);

/* The number of the file that the process is given. */
enum { DOOR_FILE = 4 };

typedef struct sandbox_call {
    const char *what; /* for messages: "HDF5" */
    /* Runs behind the door: reads of the bytes what is wanted and prints it. */
    wt_status (*reading)(const struct sandbox_call *door, FILE *answer, wt_error *err);
    const void *bytes;
    size_t size;
    const void *with;          /* for `reading` */
    int file;                  /* -1: none */
    void (*enter)(void *hold); /* around the making of the process; or NULL */
    void (*leave)(void *hold);
    void *hold;
} sandbox_call;

/* Gives what `reading` printed, new, freed with free(). It comes from where the file had its way:
 * nothing in it may be trusted. The error has no file name. */
wt_status sandbox_read(const sandbox_call *door, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err) WT_NODISCARD;

/* The same, taken as it comes. */
typedef struct sandbox_stream sandbox_stream;
wt_status sandbox_start(const sandbox_call *door, const sandbox_limits *limits,
                        sandbox_stream **flow, wt_error *err) WT_NODISCARD;
/* The next n bytes; WT_E_CORRUPT if there are not so many. After a failure there is nothing more.
 */
wt_status sandbox_receive(sandbox_stream *flow, void *to, size_t n, wt_error *err) WT_NODISCARD;
/* Hands on what is left to say, piece by piece, up to its end. */
typedef wt_status sandbox_sink(void *user, const void *piece, size_t n, wt_error *err);
wt_status sandbox_drain(sandbox_stream *flow, sandbox_sink *sink, void *user,
                        wt_error *err) WT_NODISCARD;
/* Fails if what was left to say is more than nothing, or an error. */
wt_status sandbox_finish(sandbox_stream *flow, wt_error *err) WT_NODISCARD;
void sandbox_close(sandbox_stream *flow); /* also before the end; accepts NULL */

#endif
