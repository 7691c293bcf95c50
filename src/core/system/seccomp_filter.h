/* System-call filter of the sandbox (seccomp). It allows memory, time, locks, the exit, and access
 * to open descriptors. Attempts to find a file fail. Every other call, for example to create a
 * process, signal another process or open a socket, ends the process before it is executed.
 *
 * A signal handler reports the number of the forbidden call. The report is not trustworthy, because
 * it comes from the process itself. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SECCOMP_FILTER_H
#define WT_CORE_SYSTEM_SECCOMP_FILTER_H

#include <stddef.h>

typedef enum sandbox_filter_state {
    FILTER_SET,
    FILTER_REFUSED,
    FILTER_NO_MEMORY
} sandbox_filter_state;

/* Installs the filter permanently for the calling thread, which is the only one. The process may
 * write to `answer` only. A forbidden call ends the process with FILTER_EXIT, and its number, an
 * int, is the last output. */
enum { FILTER_EXIT = 99 };
sandbox_filter_state seccomp_filter_install(int answer);
/* Writes the name of a system call, or its number if the name is unknown. */
void seccomp_syscall_name(int call, char *name, size_t size);

#endif
