/* System-call filter of the sandbox. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/seccomp_filter.h"
#include "core/base/array.h"

#include <errno.h>
#include <fcntl.h>
#include <seccomp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

/* Calls that the various C libraries use for memory, time, locks, their own signals and the exit.
 * libseccomp skips calls that other machines lack. */
static const int allowed_calls[] = {
    SCMP_SYS(read),
    SCMP_SYS(readv),
    SCMP_SYS(pread64),
    SCMP_SYS(lseek),
    SCMP_SYS(_llseek),
    SCMP_SYS(close),
    SCMP_SYS(fstat),
    SCMP_SYS(fstat64),
    SCMP_SYS(brk),
    SCMP_SYS(mmap),
    SCMP_SYS(mmap2),
    SCMP_SYS(munmap),
    SCMP_SYS(mremap),
    SCMP_SYS(mprotect),
    SCMP_SYS(madvise),
    SCMP_SYS(futex),
    SCMP_SYS(futex_time64),
    SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(sigreturn),
    SCMP_SYS(sigaltstack),
    SCMP_SYS(restart_syscall),
    SCMP_SYS(clock_gettime),
    SCMP_SYS(clock_gettime64),
    SCMP_SYS(clock_getres),
    SCMP_SYS(clock_nanosleep),
    SCMP_SYS(clock_nanosleep_time64),
    SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(time),
    SCMP_SYS(times),
    SCMP_SYS(getrusage),
    SCMP_SYS(getrlimit),
    SCMP_SYS(ugetrlimit),
    SCMP_SYS(sysinfo),
    SCMP_SYS(uname),
    SCMP_SYS(getpid),
    SCMP_SYS(getppid),
    SCMP_SYS(gettid),
    SCMP_SYS(getuid),
    SCMP_SYS(geteuid),
    SCMP_SYS(getrandom),
    SCMP_SYS(getcwd),
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
};

/* Calls that a library may try without harm and can do without. They fail with EACCES. */
static const int denied_calls[] = {
    SCMP_SYS(access),     SCMP_SYS(faccessat), SCMP_SYS(faccessat2), SCMP_SYS(stat),
    SCMP_SYS(stat64),     SCMP_SYS(lstat),     SCMP_SYS(lstat64),    SCMP_SYS(statfs),
    SCMP_SYS(getdents64), SCMP_SYS(readlink),  SCMP_SYS(readlinkat), SCMP_SYS(openat2),
    SCMP_SYS(prctl),      SCMP_SYS(open),      SCMP_SYS(openat),
};

static int deny_unneeded_calls(scmp_filter_ctx filter)
{
    const uint32_t denied = SCMP_ACT_ERRNO(EACCES);
    int failed = 0;
    for (size_t i = 0; failed == 0 && i < COUNT_OF(denied_calls); i++)
        failed = seccomp_rule_add(filter, denied, denied_calls[i], 0);
    /* These calls are forbidden with a name. Without a name they return the size of an open
     * file. */
    const struct scmp_arg_cmp named[] = {SCMP_A3(SCMP_CMP_MASKED_EQ, AT_EMPTY_PATH, 0),
                                         SCMP_A2(SCMP_CMP_MASKED_EQ, AT_EMPTY_PATH, 0)};
    if (failed == 0)
        failed = seccomp_rule_add_array(filter, denied, SCMP_SYS(newfstatat), 1, &named[0]);
    if (failed == 0)
        failed = seccomp_rule_add_array(filter, denied, SCMP_SYS(statx), 1, &named[1]);
    /* Called only for a possible terminal. */
    return failed != 0 ? failed
                       : seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOTTY), SCMP_SYS(ioctl), 0);
}

/* Allows calls that are harmless with certain arguments. */
static int allow_conditional_calls(scmp_filter_ctx filter, int answer)
{
    const scmp_datum_t itself = (scmp_datum_t)getpid(), to = (scmp_datum_t)answer;
    const struct {
        int call;
        struct scmp_arg_cmp if_so;
    } conditional[] = {
        {SCMP_SYS(write), SCMP_A0(SCMP_CMP_EQ, to, 0)},
        {SCMP_SYS(writev), SCMP_A0(SCMP_CMP_EQ, to, 0)},
        {SCMP_SYS(newfstatat), SCMP_A3(SCMP_CMP_MASKED_EQ, AT_EMPTY_PATH, AT_EMPTY_PATH)},
        {SCMP_SYS(statx), SCMP_A2(SCMP_CMP_MASKED_EQ, AT_EMPTY_PATH, AT_EMPTY_PATH)},
        {SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, F_GETFL, 0)},
        {SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, F_GETFD, 0)},
        {SCMP_SYS(fcntl64), SCMP_A1(SCMP_CMP_EQ, F_GETFL, 0)},
        {SCMP_SYS(fcntl64), SCMP_A1(SCMP_CMP_EQ, F_GETFD, 0)},
        {SCMP_SYS(prlimit64), SCMP_A2(SCMP_CMP_EQ, 0, 0)}, /* only reads the limits */
        {SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, itself, 0)},
    };
    int failed = 0;
    for (size_t i = 0; failed == 0 && i < COUNT_OF(conditional); i++)
        failed = seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, conditional[i].call, 1,
                                        &conditional[i].if_so);
    /* Messages of a sanitizer are discarded. */
    return failed != 0 ? failed
                       : seccomp_rule_add(filter, SCMP_ACT_ERRNO(EBADF), SCMP_SYS(write), 1,
                                          SCMP_A0(SCMP_CMP_NE, to, 0));
}

static int report_descriptor;

static void report_forbidden_call(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)context;
    const int call = info->si_syscall;
    (void)!write(report_descriptor, &call, sizeof call);
    _exit(FILTER_EXIT);
}

sandbox_filter_state seccomp_filter_install(int answer)
{
    const struct sigaction reporter = {.sa_sigaction = report_forbidden_call,
                                       .sa_flags = SA_SIGINFO};
    report_descriptor = answer;
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_TRAP);
    if (filter == NULL)
        return FILTER_NO_MEMORY;
    int failed = sigaction(SIGSYS, &reporter, NULL);
    for (size_t i = 0; failed == 0 && i < COUNT_OF(allowed_calls); i++)
        failed = seccomp_rule_add(filter, SCMP_ACT_ALLOW, allowed_calls[i], 0);
    if (failed == 0)
        failed = allow_conditional_calls(filter, answer);
    if (failed == 0)
        failed = deny_unneeded_calls(filter);
    if (failed == 0)
        failed = seccomp_load(filter);
    seccomp_release(filter);
    return failed == -ENOMEM ? FILTER_NO_MEMORY : failed != 0 ? FILTER_REFUSED : FILTER_SET;
}

void seccomp_syscall_name(int call, char *name, size_t size)
{
    char *const known = seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, call);
    if (known != NULL)
        (void)snprintf(name, size, "%s", known);
    else
        (void)snprintf(name, size, "number %d", call);
    free(known);
}
