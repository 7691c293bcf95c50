/* Confines foreign code with Landlock, seccomp and resource limits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/confinement.h"
#include "core/base/array.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* ---- files ----------------------------------------------------------------------------------- */

/* Interface of Landlock, which the headers of older systems lack. The numbers of the calls are the
 * same on all machines. Bits are rights; a version of the interface adds some. */
enum { LANDLOCK_CREATE = 444, LANDLOCK_ADD_RULE = 445, LANDLOCK_RESTRICT = 446, PATH_BENEATH = 1 };
enum {
    READ_FILES = 1 << 0 | 1 << 2 | 1 << 3,                                 /* execute, read, list */
    WRITE_FILE = 1 << 1 | 1 << 14,                                         /* write, truncate */
    CHANGE_FOLDER = 1 << 4 | 1 << 5 | 1 << 7 | 1 << 8 | 1 << 12 | 1 << 13, /* remove, make, move */
    FILE_RIGHTS = 1 << 0 | 1 << 1 | 1 << 2 | 1 << 14, /* those that a file has */
    NO_CONTROL_OF_DEVICES = 5,                        /* version that adds the right 1 << 15 */
    NO_TCP = 4,                                       /* and two for TCP ports */
    NO_SIGNALS = 6                                    /* and two for signals and sockets */
};

typedef struct file_rules {
    int set;
    uint64_t handled;
} file_rules;

static void allow_path(const file_rules *rules, const char *path, unsigned rights)
{
    struct __attribute__((packed)) {
        uint64_t rights;
        int32_t parent;
    } rule = {rules->handled & rights, open(path, O_PATH | O_CLOEXEC)};
    struct stat info;
    if (rule.parent < 0)
        return;
    if (fstat(rule.parent, &info) == 0 && !S_ISDIR(info.st_mode))
        rule.rights &= FILE_RIGHTS;
    (void)syscall(LANDLOCK_ADD_RULE, rules->set, PATH_BENEATH, &rule, 0);
    (void)close(rule.parent);
}

/* Files that programs need: libraries, their data, fonts, devices. */
static const char readable[] =
    "usr lib lib32 lib64 bin sbin opt nix/store gnu/store etc/ld.so.cache etc/ld.so.preload "
    "etc/alternatives etc/fonts etc/gtk-2.0 etc/gtk-3.0 etc/pango etc/localtime "
    "var/cache/fontconfig proc/self proc/cpuinfo proc/meminfo sys/devices/system/cpu dev/zero "
    "dev/random dev/urandom";
static const char readable_at_home[] =
    ".fonts .local/share/fonts .config/fontconfig .cache/fontconfig";
/* Beside the folder of the program, which may be in the home of the user. */
static const char readable_beside[] = "lib lib64 libexec etc/fonts share/fonts share/gnuplot "
                                      "share/gwyddion";

static void allow_beneath(const file_rules *rules, const char *folder, const char *names)
{
    char path[PATH_MAX], name[32];
    for (int length = 0; sscanf(names, "%31s%n", name, &length) == 1; names += length)
        if ((size_t)snprintf(path, sizeof path, "%s/%s", folder, name) < sizeof path)
            allow_path(rules, path, READ_FILES);
}

/* A program that is not installed in the system folders, with its libraries and data. */
static void allow_program(const file_rules *rules, const char *program)
{
    char path[PATH_MAX], file[PATH_MAX];
    if (realpath(program, file) == NULL)
        return;
    allow_path(rules, file, READ_FILES);
    const char *at = getenv("LD_LIBRARY_PATH");
    for (size_t length; at != NULL; at = at[length] != '\0' ? at + length + 1 : NULL) {
        length = strcspn(at, ":");
        if (length > 0 && length < sizeof path) {
            (void)snprintf(path, sizeof path, "%.*s", (int)length, at);
            allow_path(rules, path, READ_FILES);
        }
    }
    const int folder = (int)(strrchr(file, '/') - file);
    if ((size_t)snprintf(path, sizeof path, "%.*s/..", folder, file) < sizeof path)
        allow_beneath(rules, path, readable_beside);
}

/* False if the system has no Landlock. */
static bool restrict_files(const confinement *c)
{
    const long version = syscall(LANDLOCK_CREATE, NULL, 0, 1);
    const unsigned n_rights = version < 2                       ? 13
                              : version < 3                     ? 14
                              : version < NO_CONTROL_OF_DEVICES ? 15
                                                                : 16;
    const uint64_t handled[3] = {((uint64_t)1 << n_rights) - 1, version < NO_TCP ? 0 : 3,
                                 version < NO_SIGNALS ? 0 : 3};
    if (version < 1)
        return false;
    const int set = (int)syscall(LANDLOCK_CREATE, handled, sizeof handled, 0);
    const file_rules rules = {set, handled[0]};
    const char *const home = getenv("HOME");
    if (set < 0)
        return false;
    if (c->program != NULL) {
        allow_beneath(&rules, "", readable);
        if (home != NULL)
            allow_beneath(&rules, home, readable_at_home);
        allow_program(&rules, c->program);
        allow_path(&rules, "/dev/null", READ_FILES | WRITE_FILE);
        allow_path(&rules, ".", (READ_FILES & ~1) | WRITE_FILE | CHANGE_FOLDER);
    }
    const bool done = syscall(LANDLOCK_RESTRICT, set, 0) == 0;
    (void)close(set);
    return done;
}

/* ---- system calls ---------------------------------------------------------------------------- */

/* Calls for memory, time, locks, own signals and the exit, as the various C libraries use them. */
static const char basic_calls[] =
    "read readv pread64 lseek _llseek close fstat fstat64 brk mmap mmap2 munmap mremap mprotect "
    "madvise futex futex_time64 sched_yield sched_getaffinity rt_sigaction rt_sigprocmask "
    "rt_sigreturn sigreturn sigaltstack restart_syscall clock_gettime clock_gettime64 "
    "clock_getres clock_nanosleep clock_nanosleep_time64 nanosleep gettimeofday time times "
    "getrusage getrlimit ugetrlimit sysinfo uname getpid getppid gettid getuid geteuid getrandom "
    "getcwd exit exit_group";

/* Calls that a library may try without harm and can do without. */
static const char process_denied[] =
    "access faccessat faccessat2 stat stat64 lstat lstat64 statfs getdents64 readlink readlinkat "
    "openat2 prctl open openat";

/* Calls of a program: files, which Landlock limits, and processes. */
static const char program_calls[] =
    "open openat creat stat stat64 lstat lstat64 newfstatat fstatat64 statx statfs statfs64 "
    "fstatfs "
    "fstatfs64 access faccessat faccessat2 getdents getdents64 readlink readlinkat chdir fchdir "
    "write writev pwrite64 pwritev preadv sendfile sendfile64 copy_file_range fadvise64 "
    "fadvise64_64 readahead ftruncate ftruncate64 fallocate fsync fdatasync flock mkdir mkdirat "
    "rmdir unlink unlinkat rename renameat renameat2 symlink symlinkat umask dup dup2 dup3 fcntl "
    "fcntl64 close_range pipe pipe2 poll ppoll ppoll_time64 select _newselect pselect6 "
    "pselect6_time64 epoll_create epoll_create1 epoll_ctl epoll_wait epoll_pwait eventfd eventfd2 "
    "execve fork vfork wait4 waitpid waitid getpgrp getpgid getsid getgid getegid getgroups "
    "getresuid getresgid getuid32 geteuid32 getgid32 getegid32 capget arch_prctl set_tls "
    "set_thread_area set_tid_address set_robust_list get_robust_list rseq sched_getparam "
    "sched_getscheduler sched_setaffinity sched_get_priority_max sched_get_priority_min getcpu "
    "getpriority membarrier mincore msync alarm setitimer getitimer timer_create timer_settime "
    "timer_gettime timer_delete rt_sigtimedwait rt_sigsuspend rt_sigpending pause setrlimit";

/* Calls whose refusal a program may report. Unknown calls fail as in an older system. */
static const char program_denied[] =
    "socket socketpair connect bind setsid setpgid ptrace process_vm_readv process_vm_writev "
    "chmod fchmod fchmodat chown fchown lchown fchownat link linkat truncate truncate64 utime "
    "utimes futimesat utimensat mknod mknodat mount unshare setns tkill";

static int add_rules(scmp_filter_ctx filter, uint32_t action, const char *names)
{
    char name[32];
    int length = 0, failed = 0;
    for (; failed == 0 && sscanf(names, "%31s%n", name, &length) == 1; names += length) {
        const int call = seccomp_syscall_resolve_name(name);
        if (call != __NR_SCMP_ERROR)
            failed = seccomp_rule_add(filter, action, call, 0);
    }
    return failed;
}

typedef struct conditional_rule {
    uint32_t action;
    int call;
    struct scmp_arg_cmp condition;
} conditional_rule;

static int add_conditional_rules(scmp_filter_ctx filter, const conditional_rule *rules, size_t n)
{
    int failed = 0;
    for (size_t i = 0; failed == 0 && i < n; i++)
        failed =
            seccomp_rule_add_array(filter, rules[i].action, rules[i].call, 1, &rules[i].condition);
    return failed;
}

#define DENIED SCMP_ACT_ERRNO(EACCES)

static int add_process_rules(scmp_filter_ctx filter, int answer)
{
    const scmp_datum_t itself = (scmp_datum_t)getpid(), to = (scmp_datum_t)answer,
                       empty = AT_EMPTY_PATH;
    const conditional_rule rules[] = {
        {SCMP_ACT_ALLOW, SCMP_SYS(write), SCMP_A0(SCMP_CMP_EQ, to, 0)},
        /* Messages of a sanitizer are discarded. */
        {SCMP_ACT_ERRNO(EBADF), SCMP_SYS(write), SCMP_A0(SCMP_CMP_NE, to, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(writev), SCMP_A0(SCMP_CMP_EQ, to, 0)},
        /* Without a name they return the size of an open file. */
        {SCMP_ACT_ALLOW, SCMP_SYS(newfstatat), SCMP_A3(SCMP_CMP_MASKED_EQ, empty, empty)},
        {DENIED, SCMP_SYS(newfstatat), SCMP_A3(SCMP_CMP_MASKED_EQ, empty, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(statx), SCMP_A2(SCMP_CMP_MASKED_EQ, empty, empty)},
        {DENIED, SCMP_SYS(statx), SCMP_A2(SCMP_CMP_MASKED_EQ, empty, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, F_GETFL, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(fcntl), SCMP_A1(SCMP_CMP_EQ, F_GETFD, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(fcntl64), SCMP_A1(SCMP_CMP_EQ, F_GETFL, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(fcntl64), SCMP_A1(SCMP_CMP_EQ, F_GETFD, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), SCMP_A2(SCMP_CMP_EQ, 0, 0)}, /* only reads */
        {SCMP_ACT_ALLOW, SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, itself, 0)},
    };
    const int failed = add_conditional_rules(filter, rules, COUNT_OF(rules));
    return failed != 0 ? failed : add_rules(filter, DENIED, process_denied);
}

static int add_program_rules(scmp_filter_ctx filter)
{
    const scmp_datum_t itself = (scmp_datum_t)getpid(), low = UINT32_MAX;
    const scmp_datum_t namespaces = CLONE_NEWCGROUP | CLONE_NEWIPC | CLONE_NEWNET | CLONE_NEWNS |
                                    CLONE_NEWPID | CLONE_NEWUSER | CLONE_NEWUTS;
    const conditional_rule rules[] = {
        {SCMP_ACT_ALLOW, SCMP_SYS(clone), SCMP_A0(SCMP_CMP_MASKED_EQ, namespaces, 0)},
        {SCMP_ACT_ALLOW, SCMP_SYS(kill), SCMP_A0(SCMP_CMP_MASKED_EQ, low, itself)},
        {SCMP_ACT_ALLOW, SCMP_SYS(kill), SCMP_A0(SCMP_CMP_MASKED_EQ, low, 0)}, /* its group */
        {SCMP_ACT_ALLOW, SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_MASKED_EQ, low, itself)},
        {SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), SCMP_A0(SCMP_CMP_EQ, 0, 0)},
        /* gnuplot gives up privileges that it does not have, which succeeds without a call. */
        {SCMP_ACT_ERRNO(0), SCMP_SYS(setuid), SCMP_A0(SCMP_CMP_MASKED_EQ, low, getuid())},
        {SCMP_ACT_ALLOW, SCMP_SYS(prctl), SCMP_A0(SCMP_CMP_MASKED_EQ, low, PR_SET_NAME)},
        {SCMP_ACT_ALLOW, SCMP_SYS(prctl), SCMP_A0(SCMP_CMP_MASKED_EQ, low, PR_GET_NAME)},
    };
    int failed = add_conditional_rules(filter, rules, COUNT_OF(rules));
    if (failed == 0)
        failed = add_rules(filter, SCMP_ACT_ALLOW, program_calls);
    return failed != 0 ? failed : add_rules(filter, SCMP_ACT_ERRNO(EPERM), program_denied);
}

static int report_descriptor;

static void report_forbidden_call(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)context;
    const int call = info->si_syscall;
    (void)!write(report_descriptor, &call, sizeof call);
    _exit(FORBIDDEN_CALL_EXIT);
}

/* Installs the filter permanently. Returns 0 or a negative error number. */
static int restrict_calls(const confinement *c)
{
    const bool program = c->program != NULL;
    const struct sigaction reporter = {.sa_sigaction = report_forbidden_call,
                                       .sa_flags = SA_SIGINFO};
    report_descriptor = c->answer;
    scmp_filter_ctx filter = seccomp_init(program ? SCMP_ACT_ERRNO(ENOSYS) : SCMP_ACT_TRAP);
    if (filter == NULL)
        return -ENOMEM;
    int failed = program ? 0 : sigaction(SIGSYS, &reporter, NULL);
    if (failed == 0)
        failed = add_rules(filter, SCMP_ACT_ALLOW, basic_calls);
    if (failed == 0) /* called for a possible terminal */
        failed = seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOTTY), SCMP_SYS(ioctl), 0);
    if (failed == 0)
        failed = program ? add_program_rules(filter) : add_process_rules(filter, c->answer);
    if (failed == 0)
        failed = seccomp_load(filter);
    seccomp_release(filter);
    return failed;
}

void system_call_name(int call, char *name, size_t size)
{
    char *const known = seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, call);
    if (known != NULL)
        (void)snprintf(name, size, "%s", known);
    else
        (void)snprintf(name, size, "number %d", call);
    free(known);
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* Sets a limit that never exceeds the current one. */
static bool lower_resource_limit(unsigned resource, size_t most)
{
    struct rlimit both;
    if (getrlimit(resource, &both) != 0)
        return false;
    /* The hard limit has one more second of processor time, so that SIGXCPU is distinguished from
     * SIGKILL. */
    const rlim_t last = most + (resource == RLIMIT_CPU ? 1 : 0);
    both.rlim_max = last < both.rlim_max ? last : both.rlim_max;
    both.rlim_cur = most < both.rlim_max ? most : both.rlim_max;
    return setrlimit(resource, &both) == 0;
}

static bool lower_memory_limit(const confinement *c)
{
    return c->memory == 0 || lower_resource_limit(RLIMIT_DATA, c->memory);
}

static bool has_own_network(void)
{
    return unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0 || unshare(CLONE_NEWNET) == 0;
}

char confine(const confinement *c, pid_t parent)
{
    const bool process = c->program == NULL;
    bool network = process || !has_own_network();
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent ||
        prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || (process && prctl(PR_SET_DUMPABLE, 0) != 0))
        return CONFINEMENT_FAILED;
    const bool files = !restrict_files(c); /* before descriptors are limited */
    if (!lower_resource_limit(RLIMIT_FSIZE, c->file_size) ||
        !lower_resource_limit(RLIMIT_CORE, 0) ||
        (process &&
         (!lower_resource_limit(RLIMIT_NOFILE, 0) || !lower_resource_limit(RLIMIT_NPROC, 0))) ||
        (c->cpu_time != 0 && !lower_resource_limit(RLIMIT_CPU, c->cpu_time)) ||
        (process && !lower_memory_limit(c)))
        return CONFINEMENT_FAILED;
    const int failed = restrict_calls(c);
    /* The data of this process may exceed the limit of the program, and the filter takes memory. */
    if (!process && !lower_memory_limit(c))
        return CONFINEMENT_FAILED;
    if (failed == -ENOMEM)
        return CONFINEMENT_NO_MEMORY;
    if (failed != 0 && process)
        network = !has_own_network();
    /* The filter of a process refuses files, and both filters refuse sockets. */
    return (char)(CONFINED + (failed != 0 ? NO_FILTER : 0) +
                  (files && (!process || failed != 0) ? NO_FILE_RULES : 0) +
                  (network && failed != 0 ? NETWORK_REACHABLE : 0));
}

/* Protections that were missing in any process so far. */
static atomic_uint missing_protections;

int confinement_error(char report)
{
    if (report >= CONFINED && report <= CONFINED + ALL_MISSING)
        return 0;
    return report == CONFINEMENT_NO_DESCRIPTORS ? EMFILE
           : report == CONFINEMENT_NO_MEMORY    ? ENOMEM
                                                : EPERM;
}

int confinement_note(char report)
{
    const int number = confinement_error(report);
    if (number == 0)
        atomic_fetch_or(&missing_protections, (unsigned)(report - CONFINED));
    return number;
}

const char *wt_sandbox_limitations(void)
{
    static const char *const names[] = {
        "a filter of system calls (seccomp)", "access rules for files (Landlock)",
        "a network of its own for a process", "/proc, by which memory is limited"};
    static _Thread_local char text[400];
    const unsigned missing = atomic_load(&missing_protections);
    size_t length = (size_t)snprintf(text, sizeof text, "this system does not offer ");
    for (size_t i = 0, n = 0; i < COUNT_OF(names); i++)
        if ((missing >> i & 1) != 0)
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%s",
                                       n++ > 0 ? "; " : "", names[i]);
    (void)snprintf(
        text + length, sizeof text - length,
        ", by which the readers of HDF5 files, Gwyddion and gnuplot are confined: a file "
        "made to do harm could do what you may; take files that you trust only");
    return missing != 0 ? text : NULL;
}
