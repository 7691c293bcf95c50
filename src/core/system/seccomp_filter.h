/* What the process behind a door may ask of the system, held by the kernel (seccomp): memory, time,
 * locks, the end, and what lies behind its open descriptors. Who looks for a file finds none. All
 * else, a process, a signal to another one, a name, a socket, ends the process before it is done.
 *
 * A handler of signals, so that the call can be named: what it writes comes from a process in which
 * nothing may be trusted. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_SECCOMP_FILTER_H
#define WT_CORE_SYSTEM_SECCOMP_FILTER_H

#include <stddef.h>

typedef enum door_filter { FILTER_SET, FILTER_REFUSED, FILTER_NO_MEMORY } door_filter;

/* For good, for the calling thread, which is the only one. It may write to `answer` alone. A
 * forbidden call ends the process with FILTER_EXIT, and its number, an int, is the last thing in
 * `answer`. */
enum { FILTER_EXIT = 99 };
door_filter seccomp_filter_install(int answer);
/* The name of a call by that number, or the number. */
void seccomp_syscall_name(int call, char *name, size_t size);

#endif
