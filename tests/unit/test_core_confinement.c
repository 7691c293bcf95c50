/* This test acts as a program that a malicious file has taken over. Started as gnuplot and as
 * Gwyddion, it tries forbidden actions, and only its own folder may change. test_core_sandbox.c
 * tests libraries in a process (HDF5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_folder.h"

#include "core/system/subprocess.h"
#include "read/bytes/input.h"
#include "read/gwyddion/gwyddion.h"
#include "report/gnuplot.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>

/* ---- the program ----------------------------------------------------------------------------- */

/* Environment variables of the program: the folder of the test and the listening port. */
#define PLACE "WEARTRACK_TEST_PLACE"
#define PORT "WEARTRACK_TEST_PORT"
#define FILL "WEARTRACK_TEST_FILL"

enum {
    ALL_REFUSED = 40,
    OWN_FOLDER_REFUSED = 39
}; /* exit status; a value above the first is the number of the action */

static const char *outside(const char *name)
{
    static char path[512];
    (void)snprintf(path, sizeof path, "%s/%s", getenv(PLACE), name);
    return path;
}

static bool reads(void)
{
    return open(outside("secret"), O_RDONLY) >= 0;
}

static bool lists(void)
{
    return opendir(outside("")) != NULL;
}

static bool writes(void)
{
    return open(outside("secret"), O_WRONLY) >= 0;
}

static bool makes_a_file(void)
{
    return open(outside("new"), O_WRONLY | O_CREAT, 0600) >= 0;
}

static bool makes_a_folder(void)
{
    return mkdir(outside("new"), 0700) == 0;
}

static bool cuts(void)
{
    return truncate(outside("secret"), 0) == 0;
}

static bool removes(void)
{
    return unlink(outside("secret")) == 0;
}

static bool takes(void)
{
    return rename(outside("secret"), "mine") == 0 || link(outside("secret"), "mine") == 0;
}

static bool follows_its_link(void)
{
    return symlink(outside("secret"), "path") == 0 && open("path", O_RDONLY) >= 0;
}

static bool changes_the_mode(void)
{
    return chmod(outside("secret"), 0777) == 0;
}

static bool connects(void)
{
    const struct sockaddr_in to = {.sin_family = AF_INET,
                                   .sin_port = htons((uint16_t)atoi(getenv(PORT))),
                                   .sin_addr = {htonl(INADDR_LOOPBACK)}};
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    return fd >= 0 && connect(fd, (const struct sockaddr *)&to, sizeof to) == 0;
}

static bool connects_locally(void)
{
    int both[2];
    return socket(AF_UNIX, SOCK_STREAM, 0) >= 0 || socketpair(AF_UNIX, SOCK_STREAM, 0, both) == 0;
}

static bool traces(void)
{
    return ptrace(PTRACE_ATTACH, getppid(), NULL, NULL) == 0;
}

static bool reads_memory(void)
{
    char here[8];
    const struct iovec to = {here, sizeof here}, from = {here, sizeof here};
    return process_vm_readv(getppid(), &to, 1, &from, 1, 0) > 0;
}

static bool signals(void)
{
    return kill(getppid(), 0) == 0 || kill(-getpgid(getppid()), 0) == 0 || kill(-1, 0) == 0;
}

static bool outlives_the_parent(void)
{
    return prctl(PR_SET_PDEATHSIG, 0) == 0;
}

static bool takes_namespaces(void)
{
    return unshare(CLONE_NEWUSER) == 0 || unshare(CLONE_NEWNS) == 0;
}

static bool raises_a_limit(void)
{
    const struct rlimit more = {RLIM_INFINITY, RLIM_INFINITY};
    return setrlimit(RLIMIT_FSIZE, &more) == 0;
}

/* Runs in a child, which may leave its process group if anything may. */
static bool leaves_the_group(void)
{
    int state = 0;
    const pid_t child = fork();
    if (child == 0)
        _exit(setsid() >= 0 || setpgid(0, 0) == 0 ? 1 : 0);
    return waitpid(child, &state, 0) != child || state != 0;
}

static bool (*const deeds[])(void) = {reads,
                                      lists,
                                      writes,
                                      makes_a_file,
                                      makes_a_folder,
                                      cuts,
                                      removes,
                                      takes,
                                      follows_its_link,
                                      connects,
                                      changes_the_mode,
                                      connects_locally,
                                      traces,
                                      reads_memory,
                                      signals,
                                      outlives_the_parent,
                                      takes_namespaces,
                                      raises_a_limit,
                                      leaves_the_group};

/* Required access: its folder, system files, other processes, devices. */
static bool has_its_own(void)
{
    int state = -1;
    const pid_t child = fork();
    if (child == 0)
        _exit(execl("/bin/sh", "sh", "-c",
                    "echo words > words && mkdir in && mv words in/file && "
                    "cat in/file > /dev/null && rm -r in",
                    NULL));
    return waitpid(child, &state, 0) == child && state == 0;
}

/* Each file is below the size limit. */
_Noreturn static void fill_the_disk(void)
{
    static const char words[1 << 18];
    char name[32];
    for (int i = 0;; i++) {
        (void)snprintf(name, sizeof name, "%d", i);
        const int fd = open(name, O_WRONLY | O_CREAT, 0600);
        (void)!write(fd, words, sizeof words);
        (void)close(fd);
    }
}

/* The program ignores signals, and a child stays behind. */
static int act(void)
{
    if (getenv(FILL) != NULL)
        fill_the_disk();
    if (!has_its_own())
        return OWN_FOLDER_REFUSED;
    for (size_t i = 0; i < sizeof deeds / sizeof *deeds; i++)
        if (deeds[i]())
            return ALL_REFUSED + 1 + (int)i;
    for (int i = 1; i < NSIG; i++)
        (void)signal(i, SIG_IGN);
    if (fork() == 0)
        for (;;)
            (void)sleep(1);
    return ALL_REFUSED;
}

/* ---- the test -------------------------------------------------------------------------------- */

static char *path_before;

/* The program is this test under other names. */
static int make_place(void **state)
{
    char own[4096], path[8192];
    if (create_work_folder(state) != 0 || mkdir("folder", 0700) != 0 || mkdir("bin", 0700) != 0 ||
        mkdir("tmp", 0700) != 0 || setenv(PLACE, *state, 1) != 0)
        return -1;
    const ssize_t n = readlink("/proc/self/exe", own, sizeof own - 1);
    if (n <= 0)
        return -1;
    own[n] = '\0';
    write_all("secret", "dear");
    path_before = strdup(getenv("PATH"));
    (void)snprintf(path, sizeof path, "%s:%s", outside("bin"), path_before);
    mark_programs();
    return symlink(own, "bin/gwyddion") + symlink(own, "bin/gnuplot") + setenv("PATH", path, 1) +
           setenv("TMPDIR", outside("tmp"), 1);
}

static int remove_place(void **state)
{
    assert_int_equal(setenv("PATH", path_before, 1), 0);
    assert_int_equal(unsetenv("TMPDIR") + unsetenv(FILL) + unsetenv(PLACE), 0);
    free(path_before);
    return remove_work_folder(state);
}

static int listen_somewhere(void)
{
    struct sockaddr_in own = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    socklen_t size = sizeof own;
    char text[16];
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    assert_true(fd >= 0 && bind(fd, (const struct sockaddr *)&own, sizeof own) == 0);
    assert_true(listen(fd, 1) == 0 && getsockname(fd, (struct sockaddr *)&own, &size) == 0);
    (void)snprintf(text, sizeof text, "%d", ntohs(own.sin_port));
    assert_int_equal(setenv(PORT, text, 1), 0);
    return fd;
}

static bool go_on(void *user)
{
    (void)user;
    return true;
}

static void run_as_gnuplot(wt_error *err)
{
    static const char *const arguments[] = {NULL};
    const bool timed_out = false;
    const gnuplot_call call = {.program = "gnuplot",
                               .folder = "folder",
                               .arguments = arguments,
                               .size = (size_t)1 << 20,
                               .limit = 60,
                               .timed_out = &timed_out,
                               .go_on = go_on};
    assert_int_equal(gnuplot_run(&call, err), WT_E_TOOL);
}

static void run_as_gwyddion(wt_error *err)
{
    const gwyddion_limits limits = {.time = 60, .cpu_time = 60, .file_size = (size_t)1 << 20};
    wt_input *input = NULL, *converted = NULL;
    char version[64];
    assert_int_equal(wt_input_open_memory("height", 6, "a.sur", &input, NULL), WT_OK);
    assert_int_equal(gwyddion_convert(input, &limits, &converted, version, err), WT_E_TOOL);
    assert_null(converted);
    wt_input_close(input);
}

static void (*const run_as[])(wt_error *) = {run_as_gnuplot, run_as_gwyddion};

static void test_everything_is_refused(void **state)
{
    (void)state;
    const int listening = listen_somewhere();
    for (size_t i = 0; i < 2; i++) {
        wt_error err = WT_ERROR_INIT;
        char refused[32];
        struct stat info;
        (void)snprintf(refused, sizeof refused, "exit status %d", ALL_REFUSED);
        run_as[i](&err);
        if (strstr(err.message, refused) == NULL)
            fail_msg("%s", err.message); // 41 + the number of the deed that was done
        assert_true(all_programs_end());
        assert_int_equal(stat("secret", &info), 0);
        assert_true(info.st_size == 4 && info.st_nlink == 1);
        assert_false(exists("new"));
        assert_int_equal(count_files("tmp"), 0);
    }
    assert_int_equal(close(listening), 0);
    assert_null(wt_sandbox_limitations());
}

/* Gwyddion may write twice its largest file. */
static void test_folder_has_a_limit(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(setenv(FILL, "1", 1), 0);
    run_as_gwyddion(&err);
    assert_non_null(strstr(err.message, "wrote more than 2 MiB"));
    assert_true(all_programs_end());
    assert_int_equal(count_files("tmp"), 0);
    static const char *const arguments[] = {NULL};
    const program_call call = {.program = "gnuplot",
                               .arguments = arguments,
                               .folder = "folder",
                               .limit = 60,
                               .foreign = true,
                               .file_size = (size_t)1 << 20,
                               .folder_size = (size_t)8 << 20};
    program_result end;
    assert_int_equal(program_run(&call, &end, &err), WT_OK);
    assert_int_equal(end.outcome, PROGRAM_TOO_LARGE);
}

int main(int argc, char **argv)
{
    (void)argc;
    const char *const name = strrchr(argv[0], '/');
    if (getenv(PLACE) != NULL && name != NULL && strncmp(name, "/g", 2) == 0)
        _exit(act());
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_everything_is_refused, make_place, remove_place),
        cmocka_unit_test_setup_teardown(test_folder_has_a_limit, make_place, remove_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
