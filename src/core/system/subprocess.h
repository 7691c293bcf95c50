/* Running another program: the one place of the library that does so, but for the door of HDF5.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_SYSTEM_SUBPROCESS_H
#define WT_CORE_SYSTEM_SUBPROCESS_H

#include "weartrack/base.h"

typedef struct program_call {
    const char *program;          /* a name looked up in PATH, or a path */
    const char *const *arguments; /* behind the name, up to NULL */
    const char *folder;           /* where it runs */
    const char *const *hidden;    /* beginnings of what it does not get of the environment; NULL */
    const char *const *added;     /* NAME=VALUE that it gets beside, up to NULL */
    double limit;                 /* seconds it may take */
    size_t file_size;             /* bytes that no file it writes gets beyond */
    size_t memory;                /* bytes of data; 0: as many as there are */
    size_t cpu_time;              /* seconds of processor time; 0: as many as it likes */
    bool (*go_on)(void *user);    /* asked all the while; false ends it at once; NULL */
    void *user;
} program_call;

typedef enum program_ending {
    PROGRAM_EXITED,      /* code: its exit status */
    PROGRAM_SIGNALLED,   /* code: the signal */
    PROGRAM_TOO_LONG,    /* ended at the limit */
    PROGRAM_CANCELLED,   /* ended by go_on */
    PROGRAM_NOT_STARTED, /* code: the error number */
} program_ending;

typedef struct program_end {
    program_ending how;
    int code;
    char words[400]; /* the last line it said that is not blank; "" if it said none */
} program_end;

/* Runs a program without a shell, without standard input, in the C locale. It ends with this
 * process, and what it has started ends with it, unless that has left its process group. WT_OK says
 * that *end is known, whatever it is; WT_E_MEMORY, WT_E_IO or WT_E_TOOL that it is not. */
wt_status program_run(const program_call *call, program_end *end, wt_error *err) WT_NODISCARD;

#endif
