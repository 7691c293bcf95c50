/* Runs other programs. This is the only place of the library that does so, except for the sandbox.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SUBPROCESS_H
#define WT_CORE_SYSTEM_SUBPROCESS_H

#include "weartrack/core.h"

typedef struct program_call {
    const char *program;          /* a name looked up in PATH, or a path */
    const char *const *arguments; /* without the name, terminated by NULL */
    const char *folder;           /* working directory */
    const char *const *hidden; /* prefixes of environment variables that the program does not get,
                                  terminated by NULL; or NULL */
    const char *const *added;  /* additional NAME=VALUE, terminated by NULL; or NULL */
    double limit;              /* time limit [s] */
    bool foreign;              /* handles data of others: it is confined (core/system/confinement.h)
                                  with the limits below, and writes in its folder only */
    size_t file_size;          /* limit for the size of a written file [byte] */
    size_t folder_size;        /* limit for all that is added to the folder [byte] */
    size_t memory;             /* limit for the data segment [byte]; 0: none */
    size_t cpu_time;           /* limit for the processor time [s]; 0: none */
    bool (*go_on)(void *user); /* called repeatedly; false ends the program; may be NULL */
    void *user;
} program_call;

typedef enum program_outcome {
    PROGRAM_EXITED,      /* code: its exit status */
    PROGRAM_SIGNALLED,   /* code: the signal */
    PROGRAM_TOO_LONG,    /* ended at the limit */
    PROGRAM_TOO_LARGE,   /* ended because its folder exceeded its limit */
    PROGRAM_CANCELLED,   /* ended by go_on */
    PROGRAM_NOT_STARTED, /* code: the error number */
} program_outcome;

typedef struct program_result {
    program_outcome outcome;
    int code;
    char words[400]; /* last line of the output that is not blank; "" without output */
} program_result;

/* Runs a program without a shell and without standard input, in the C locale. The program ends with
 * this process, and its children end with it unless they leave its process group, which a foreign
 * program cannot do. WT_OK means that *end is set, whatever the result; WT_E_MEMORY, WT_E_IO or
 * WT_E_TOOL mean that it is not. */
wt_status program_run(const program_call *call, program_result *end, wt_error *err) WT_NODISCARD;
/* Starts a program that stays when this process ends, without input and output. False if it cannot
 * be started. */
bool program_detach(const char *program, const char *argument);

#endif
