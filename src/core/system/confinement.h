/* Confines foreign code: a process of this program that calls a library (sandbox.h), or another
 * program (subprocess.h). Such code handles data that may be made to do harm.
 *
 * - No new privileges, no core file, limits of processor time, memory and file size.
 * - Landlock: a program reads system files and fonts, and writes its folder only. A process opens
 *   no file.
 * - A system-call filter (seccomp). A process may use memory, time, locks and its open descriptors.
 *   Every other call ends it, and its number is the last output. A program may also use files and
 *   start processes of its own process group. Sockets, other process groups, tracing, signals to
 *   other processes, and modes and owners of files are refused.
 * - A program has a network namespace of its own where the system allows it.
 *
 * Code that a malicious file runs in a process can only produce wrong output; in a program it can
 * also read system files. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_CONFINEMENT_H
#define WT_CORE_SYSTEM_CONFINEMENT_H

#include "weartrack/core.h"

#include <sys/types.h>

typedef struct confinement {
    const char *program; /* absolute path of a program that is started next; NULL for a process.
                            The working folder is that of the program */
    int answer;          /* the only descriptor that a process writes */
    size_t memory;       /* limit of the data segment [byte]; 0: none */
    size_t file_size;    /* limit of each written file [byte] */
    size_t cpu_time;     /* limit of the processor time [s]; 0: none */
} confinement;

/* Exit status of a process after a forbidden system call. The last output is its number, an int.
 * It is not trustworthy, because it comes from the process itself. */
enum { FORBIDDEN_CALL_EXIT = 99 };

/* Report of a confined process to its parent, one byte: CONFINED with the flags of the protections
 * that this system refuses, or the reason of a failure. */
typedef enum confinement_report {
    CONFINED = 'P',
    NO_FILTER = 1,
    NO_FILE_RULES = 2,
    NETWORK_REACHABLE = 4,
    MEMORY_UNLIMITED = 8,
    ALL_MISSING = 15,
    CONFINEMENT_NO_DESCRIPTORS = 'f',
    CONFINEMENT_NO_MEMORY = 'm',
    CONFINEMENT_FAILED = 'x'
} confinement_report;

/* Confines the calling process, which has one thread. It does not outlive `parent`. */
char confine(const confinement *c, pid_t parent);
/* Returns 0, or the error number if the process is not confined. */
int confinement_error(char report);
/* The same in the parent, which records the missing protections. */
int confinement_note(char report);
/* Writes the name of a system call, or its number if the name is unknown. */
void system_call_name(int call, char *name, size_t size);

#endif
