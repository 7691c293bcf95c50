/* A process in the sandbox can read and answer. Every other system call of a malicious file is
 * stopped before its execution and named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/base/memory.h"
#include "core/system/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

static const sandbox_limits usual = {(size_t)64 << 20, (size_t)1 << 20, 20, 60};
static char victim[] = "/tmp/weartrack-door-XXXXXX";
static char *const words[] = {"true", NULL};

static int set_up(void **state)
{
    (void)state;
    const int fd = mkstemp(victim);
    return fd >= 0 && write(fd, "dear", 4) == 4 ? close(fd) : -1;
}

static int clean(void **state)
{
    (void)state;
    return unlink(victim);
}

/* ---- forbidden calls ------------------------------------------------------------------------- */

static long forks(void)
{
    return fork();
}

static long makes_a_thread(void)
{
    return syscall(SYS_clone, CLONE_VM | CLONE_THREAD | CLONE_SIGHAND, NULL, NULL, NULL, NULL);
}

static long starts_a_program(void)
{
    return execv("/bin/true", words);
}

static long spawns_one(void)
{
    pid_t child;
    return posix_spawn(&child, "/bin/true", NULL, NULL, words, NULL) == 0 ? 0 : -1;
}

static long kills_its_parent(void)
{
    return kill(getppid(), SIGUSR1);
}

static long kills_a_thread_of_it(void)
{
    return syscall(SYS_tgkill, getppid(), getppid(), SIGUSR1);
}

static long traces_it(void)
{
    return ptrace(PTRACE_ATTACH, getppid(), NULL, NULL);
}

static long reads_its_memory(void)
{
    char here[8];
    struct iovec to = {here, sizeof here}, from = {victim, sizeof here};
    return process_vm_readv(getppid(), &to, 1, &from, 1, 0);
}

static long removes_a_file(void)
{
    return unlink(victim);
}

static long removes_it_at(void)
{
    return unlinkat(AT_FDCWD, victim, 0);
}

static long renames_it(void)
{
    return rename(victim, "/tmp/weartrack-door-gone");
}

static long links_it(void)
{
    return symlink(victim, "/tmp/weartrack-door-gone");
}

static long cuts_it(void)
{
    return truncate(victim, 0);
}

static long changes_its_mode(void)
{
    return chmod(victim, 0777);
}

static long makes_a_folder(void)
{
    return mkdir("/tmp/weartrack-door-gone", 0700);
}

static long cuts_its_file(void)
{
    return ftruncate(SANDBOX_FILE_FD, 0);
}

static long writes_into_it(void)
{
    return pwrite(SANDBOX_FILE_FD, "evil", 4, 0);
}

static long asks_for_a_socket(void)
{
    return socket(AF_INET, SOCK_STREAM, 0);
}

static long asks_for_a_pipe(void)
{
    int both[2];
    return pipe(both);
}

static long waits_for_itself(void)
{
    return syscall(SYS_io_uring_setup, 1, NULL);
}

static long raises_a_limit(void)
{
    const struct rlimit more = {64, 64};
    return setrlimit(RLIMIT_NOFILE, &more);
}

static long takes_another_filter(void)
{
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_STRICT, 0, NULL);
}

/* Each call has its name in the message, in one of the variants of C libraries. The library blocks
 * all signals while it creates a process. */
static const struct {
    long (*deed)(void);
    const char *calls[3];
} forbidden[] = {
    {forks, {"not known", "clone", "fork"}},
    {makes_a_thread, {"clone"}},
    {starts_a_program, {"execve"}},
    {spawns_one, {"not known", "clone", "vfork"}},
    {kills_its_parent, {"kill"}},
    {kills_a_thread_of_it, {"tgkill"}},
    {traces_it, {"ptrace"}},
    {reads_its_memory, {"process_vm_readv"}},
    {removes_a_file, {"unlink"}},
    {removes_it_at, {"unlinkat"}},
    {renames_it, {"rename"}},
    {links_it, {"symlink"}},
    {cuts_it, {"truncate"}},
    {changes_its_mode, {"chmod"}},
    {makes_a_folder, {"mkdir"}},
    {cuts_its_file, {"ftruncate"}},
    {writes_into_it, {"pwrite64"}},
    {asks_for_a_socket, {"socket"}},
    {asks_for_a_pipe, {"pipe"}},
    {waits_for_itself, {"io_uring_setup"}},
    {raises_a_limit, {"prlimit64", "setrlimit"}},
    {takes_another_filter, {"seccomp"}},
};

static wt_status attempts(const sandbox_call *call, FILE *answer, wt_error *err)
{
    long (*const *deed)(void) = call->with;
    (void)err;
    (void)fprintf(answer, "%ld", (*deed)());
    return WT_OK;
}

/* A sandbox with a writable file, as an error might leave it. */
static sandbox_call sandbox_call_for(wt_status (*reading)(const sandbox_call *, FILE *, wt_error *),
                                     const void *with, int file)
{
    return (sandbox_call){.what = "made", .reading = reading, .with = with, .file = file};
}

static volatile sig_atomic_t signalled;

static void note_signal(int number)
{
    (void)number;
    signalled = 1;
}

static bool names_one(const char *message, const char *const calls[3])
{
    for (size_t i = 0; i < 3; i++)
        if (calls[i] != NULL && strstr(message, calls[i]) != NULL)
            return true;
    return false;
}

static void other_system_calls_are_stopped(void **state)
{
    (void)state;
    (void)signal(SIGUSR1, note_signal);
    for (size_t which = 0; which < sizeof forbidden / sizeof *forbidden; which++) {
        char *answer = NULL;
        size_t length = 0;
        struct stat after;
        wt_error err = WT_ERROR_INIT;
        const int fd = open(victim, O_RDWR | O_CLOEXEC);
        const sandbox_call call = sandbox_call_for(attempts, &forbidden[which].deed, fd);
        const wt_status status = sandbox_read(&call, &usual, &answer, &length, &err);
        if (status != WT_E_CORRUPT || !names_one(err.message, forbidden[which].calls))
            fail_msg("%s: %d, \"%s\", answer \"%.*s\"", forbidden[which].calls[0], (int)status,
                     err.message, (int)length, answer != NULL ? answer : "");
        assert_non_null(strstr(err.message, "stopped before it"));
        assert_int_equal(fstat(fd, &after), 0);
        assert_true(after.st_size == 4 && after.st_nlink == 1 && (after.st_mode & 0777) == 0600);
        assert_int_equal(access(victim, F_OK), 0);
        assert_int_equal(access("/tmp/weartrack-door-gone", F_OK), -1);
        assert_int_equal(close(fd), 0);
    }
    assert_int_equal(signalled, 0);
    (void)signal(SIGUSR1, SIG_DFL);
}

/* ---- permitted calls ------------------------------------------------------------------------- */

static wt_status reads_only(const sandbox_call *call, FILE *answer, wt_error *err)
{
    struct stat there;
    (void)call;
    (void)err;
    const int got = open("/etc/passwd", O_RDONLY), number = errno;
    (void)fprintf(answer, "%d %d %d %d %d.", got < 0, number == EACCES, access(victim, F_OK) < 0,
                  stat(victim, &there) < 0,
                  fstat(SANDBOX_FILE_FD, &there) == 0 && there.st_size == 4);
    return WT_OK;
}

static wt_status aborts(const sandbox_call *call, FILE *answer, wt_error *err)
{
    (void)call;
    (void)answer;
    (void)err;
    abort();
}

/* Like the scanner of UDUNITS when an allocation fails. */
static wt_status exits(const sandbox_call *call, FILE *answer, wt_error *err)
{
    (void)call;
    (void)answer;
    (void)err;
    _exit(2);
}

/* For lack of memory a unit is treated as unknown, and the reading continues without it. */
static wt_status continues_without_memory(const sandbox_call *call, FILE *answer, wt_error *err)
{
    (void)call;
    (void)answer;
    (void)err;
    resource_error_note(ENOMEM);
    return WT_OK;
}

/* The error is not of the file, and no part of it is silently omitted. */
static void memory_runs_out(void **state)
{
    (void)state;
    wt_status (*const readings[])(const sandbox_call *, FILE *,
                                  wt_error *) = {exits, continues_without_memory};
    for (size_t i = 0; i < sizeof readings / sizeof *readings; i++) {
        char *answer = NULL;
        size_t length = 0;
        wt_error err = WT_ERROR_INIT;
        const sandbox_call call = sandbox_call_for(readings[i], NULL, -1);
        assert_int_equal(sandbox_read(&call, &usual, &answer, &length, &err), WT_E_MEMORY);
        assert_string_equal(err.message, "reading the made file takes more than 64 MiB of memory");
        assert_null(answer);
    }
}

static void reading_continues(void **state)
{
    (void)state;
    char *answer = NULL;
    size_t length = 0;
    wt_error err = WT_ERROR_INIT;
    const int fd = open(victim, O_RDONLY | O_CLOEXEC);
    sandbox_call call = sandbox_call_for(reads_only, NULL, fd);
    assert_int_equal(sandbox_read(&call, &usual, &answer, &length, &err), WT_OK);
    assert_memory_equal(answer, "1 1 1 1 1.", length);
    free(answer);
    answer = NULL;
    call = sandbox_call_for(aborts, NULL, fd);
    assert_int_equal(sandbox_read(&call, &usual, &answer, &length, &err), WT_E_CORRUPT);
    assert_non_null(strstr(err.message, "SIGABRT"));
    assert_int_equal(close(fd), 0);
    assert_null(wt_sandbox_limitations());
}

/* ---- systems without filters ----------------------------------------------------------------- */

/* Like a container that refuses filters: errno of every attempt is EPERM. */
static bool refuse_filters(void)
{
    struct sock_filter steps[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_seccomp, 3, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_prctl, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[0])),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PR_SET_SECCOMP, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const struct sock_fprog program = {sizeof steps / sizeof *steps, steps};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/* Runs in its own process, which it changes; returns 0 on success there. */
static int apart(bool (*holds)(int file))
{
    int state = -1;
    const int file = open(victim, O_RDONLY | O_CLOEXEC);
    const pid_t child = fork();
    if (child == 0)
        _exit(holds(file) ? 0 : 1);
    assert_true(child > 0 && waitpid(child, &state, 0) == child && close(file) == 0);
    return state;
}

static bool without_filter(int file)
{
    char *answer = NULL;
    size_t length = 0;
    const sandbox_call call = sandbox_call_for(reads_only, NULL, file);
    return refuse_filters() && sandbox_read(&call, &usual, &answer, &length, NULL) == WT_OK &&
           answer[0] == '1' && wt_sandbox_limitations() != NULL &&
           strstr(wt_sandbox_limitations(), "seccomp") != NULL;
}

/* The file is read, or the message states that too few files may be open; never that the file is
 * corrupted. */
static bool with_few_files(int file)
{
    bool good = true, read_once = false, refused_once = false;
    for (rlim_t most = 16; most > 2 && good; most--) {
        const struct rlimit few = {most, 16};
        char *answer = NULL;
        size_t length = 0;
        wt_error err = WT_ERROR_INIT;
        const sandbox_call call = sandbox_call_for(reads_only, NULL, file);
        good = setrlimit(RLIMIT_NOFILE, &few) == 0;
        const wt_status status = sandbox_read(&call, &usual, &answer, &length, &err);
        read_once |= status == WT_OK;
        refused_once |= status == WT_E_IO;
        good = good &&
               (status == WT_OK || (status == WT_E_IO && strstr(err.advice, "ulimit -n") != NULL));
        free(answer);
    }
    return good && read_once && refused_once;
}

static void filter_refused_by_system(void **state)
{
    (void)state;
    assert_int_equal(apart(without_filter), 0);
    assert_int_equal(apart(with_few_files), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_system_calls_are_stopped),
        cmocka_unit_test(reading_continues),
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(filter_refused_by_system),
    };
    return cmocka_run_group_tests_name("door", tests, set_up, clean);
}
