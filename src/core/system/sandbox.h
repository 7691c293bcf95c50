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
 * there but give a wrong answer. Where the system has no such filter or no /proc, wt_door_gaps
 * (weartrack/base.h) says what then is open. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SANDBOX_H
#define WT_CORE_SYSTEM_SANDBOX_H

#include "weartrack/base.h"

#include <stdio.h>

typedef struct door_limits {
    size_t memory, answer;        /* bytes */
    unsigned cpu_time, wall_time; /* s */
} door_limits;
/* What a file of this size may take: several times what a sound one does. */
door_limits door_limits_of(size_t size);

/* The number of the file that the process is given. */
enum { DOOR_FILE = 4 };

typedef struct door_call {
    const char *what; /* for messages: "HDF5" */
    /* Runs behind the door: reads of the bytes what is wanted and prints it. */
    wt_status (*reading)(const struct door_call *door, FILE *answer, wt_error *err);
    const void *bytes;
    size_t size;
    const void *with;          /* for `reading` */
    int file;                  /* -1: none */
    void (*enter)(void *hold); /* around the making of the process; or NULL */
    void (*leave)(void *hold);
    void *hold;
} door_call;

/* Gives what `reading` printed, new, freed with free(). It comes from where the file had its way:
 * nothing in it may be trusted. The error has no file name. */
wt_status door_read(const door_call *door, const door_limits *limits, char **answer, size_t *length,
                    wt_error *err) WT_NODISCARD;

/* The same, taken as it comes. */
typedef struct door_flow door_flow;
wt_status door_begin(const door_call *door, const door_limits *limits, door_flow **flow,
                     wt_error *err) WT_NODISCARD;
/* The next n bytes; WT_E_CORRUPT if there are not so many. After a failure there is nothing more.
 */
wt_status door_take(door_flow *flow, void *to, size_t n, wt_error *err) WT_NODISCARD;
/* Hands on what is left to say, piece by piece, up to its end. */
typedef wt_status door_sink(void *user, const void *piece, size_t n, wt_error *err);
wt_status door_pour(door_flow *flow, door_sink *sink, void *user, wt_error *err) WT_NODISCARD;
/* Fails if what was left to say is more than nothing, or an error. */
wt_status door_end(door_flow *flow, wt_error *err) WT_NODISCARD;
void door_close(door_flow *flow); /* also before the end; accepts NULL */

#endif
