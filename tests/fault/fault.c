/* Failures of the system: of every allocation and every call that writes, and a signal at every
 * such call. Without options the program tries all of them; --allocations and --calls select one
 * in N, --start the first one:
 *
 *     fault COMMAND SHIM FIXTURES WORK [--allocations N] [--calls N] [--start K] [--only JOB]
 *
 * The library SHIM (shim.c) lets allocations fail, one for each call stack: once only this one, and
 * once this one with all later ones. seccomp stops system calls, also those of libraries and stdio,
 * and this program returns the error. The requirements are:
 *   - the command exits, or ends by the signal that was sent;
 *   - the exit status is 0 with the usual bytes, or there is a message and another status;
 *   - a file with its final name is complete or absent;
 *   - the next run, without a failure, gives the usual bytes and files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAX_ARGUMENTS = 24, TIME_LIMIT = 120, LINE = 4096, SAID = 400 };

typedef struct job {
    const char *name;
    const char *arguments[MAX_ARGUMENTS]; /* '@' stands for FIXTURES/. */
} job;

/* Each job has a folder with its name; a job may read the output of an earlier one. */
static const job jobs[] = {
    {"convert", {"convert", "--no-provenance", "@formats/tidy/two-runs.csv", "-o", "out.tsv"}},
    {"stdout", {"convert", "--no-provenance", "@formats/jpk-text/curve.txt"}},
    {"store", {"convert", "--no-provenance", "@case/dma.txt", "-o", "out.h5"}},
    {"indent",
     {"indent", "--no-provenance", "--threads", "1", "--tip",
      "pyramid:half-angle=20deg,radius=20nm", "--spring-constant", "0.3N/m",
      "@case/bulk-1.jpk-force-map", "-o", "out.tsv"}},
    {"map", {"convert", "--no-provenance", "@case/bulk-1.jpk-force-map", "-o", "out.h5"}},
    {"of_map",
     {"indent", "--no-provenance", "--threads", "1", "--tip",
      "pyramid:half-angle=20deg,radius=20nm", "../map/out.h5", "-o", "out.tsv"}},
    {"spool", {"info", "../unpacks.tsv.gz"}}, /* a file without a name */
    {"studio", {"convert", "--no-provenance", "@fuzz/nhf/new.nhf", "-o", "out.tsv"}},
    {"master", {"master", "--no-provenance", "@case/dma.txt", "-o", "out.h5"}},
    {"summary", {"summary", "../master/out.h5", "-o", "out.csv"}},
    {"friction",
     {"friction", "--no-provenance", "--threads", "1", "--replicates", "0", "-m",
      "../master/out.h5", "--roughness",
      "self-affine:q0=2e3rad/m,q1=1e6rad/m,hurst=0.8,c0=2e-17m^4", "-v", "1mm/s", "-p", "0.4MPa",
      "-o", "out.tsv"}},
    {"run",
     {"run", "--no-provenance", "--threads", "1", "--replicates", "0", "--no-report",
      "@case/case.xml", "-o", "out.h5"}},
    {"report", {"report", "--no-provenance", "--gnuplot", "../plot", "../run/out.h5", "-o", "out"}},
};

/* Failure in one run. */
typedef struct fault {
    size_t allocation; /* 0 = none */
    bool for_good;
    size_t call; /* 0 = none */
    int error, signal;
} fault;

/* Outcome of the run. */
typedef struct outcome {
    int state; /* status of waitpid */
    char messages[SAID];
    size_t n_calls;
    bool injected;
} outcome;

static const char *command, *shim, *fixtures;
static char work[LINE];
static size_t n_injected, n_survivors;

_Noreturn static void give_up(const char *what)
{
    fprintf(stderr, "fault: %s: %s\n", what, strerror(errno));
    exit(2);
}

__attribute__((format(printf, 1, 2))) static char *print(const char *format, ...)
{
    char *text = NULL;
    va_list list;
    va_start(list, format);
    if (vasprintf(&text, format, list) < 0)
        give_up("memory");
    va_end(list);
    return text;
}

/* ---- one run --------------------------------------------------------------------------------- */

/* System calls that change something outside the process. */
static const int calls[] = {
    SYS_write,    SYS_pwrite64, SYS_writev,    SYS_fsync,   SYS_fdatasync, SYS_ftruncate,
    SYS_linkat,   SYS_unlinkat, SYS_renameat2, SYS_mkdirat, SYS_pipe2,
#ifdef SYS_rename /* Newer systems only have the "at" variants. */
    SYS_renameat, SYS_rename,   SYS_unlink,    SYS_mkdir,
#endif
};
enum { N_CALLS = sizeof calls / sizeof *calls };

/* From now on these calls of this process and its children wait for an answer through the returned
 * descriptor. */
static int hand_over_calls(void)
{
    struct sock_filter filter[N_CALLS + 3];
    size_t n = 0;
    filter[n++] =
        (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    for (size_t i = 0; i < N_CALLS; i++)
        filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)calls[i],
                                                   (unsigned char)(N_CALLS - i), 0);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF);
    struct sock_fprog program = {(unsigned short)n, filter};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return -1;
    return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER,
                        &program);
}

static bool send_descriptor(int channel, int descriptor)
{
    char byte = 0, control[CMSG_SPACE(sizeof descriptor)] = {0};
    struct iovec part = {&byte, 1};
    struct msghdr message = {.msg_iov = &part,
                             .msg_iovlen = 1,
                             .msg_control = control,
                             .msg_controllen = sizeof control};
    struct cmsghdr *header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptor);
    memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
    return sendmsg(channel, &message, 0) == 1;
}

static int receive_descriptor(int channel)
{
    int descriptor = -1;
    char byte, control[CMSG_SPACE(sizeof descriptor)];
    struct iovec part = {&byte, 1};
    struct msghdr message = {.msg_iov = &part,
                             .msg_iovlen = 1,
                             .msg_control = control,
                             .msg_controllen = sizeof control};
    if (recvmsg(channel, &message, MSG_CMSG_CLOEXEC) == 1 && CMSG_FIRSTHDR(&message) != NULL)
        memcpy(&descriptor, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof descriptor);
    return descriptor;
}

_Noreturn static void become_command(const job *j, const char *folder, const fault *f,
                                     const char *places, int channel, bool stopped)
{
    char *arguments[MAX_ARGUMENTS + 2] = {(char *)(uintptr_t)command};
    for (size_t i = 0; j->arguments[i] != NULL; i++)
        arguments[i + 1] = *j->arguments[i] == '@' ? print("%s/%s", fixtures, j->arguments[i] + 1)
                                                   : (char *)(uintptr_t)j->arguments[i];
    const int none = open("/dev/null", O_RDONLY);
    if (chdir(folder) != 0)
        _exit(99);
    const int out = open("standard-output", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int messages = open("../messages", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(none, 0);
    dup2(out, 1);
    dup2(messages, 2);
    setenv("FAULT_PROGRAM", "weartrack", 1);
    if (f->allocation > 0)
        setenv("FAULT_ALLOC", print("%zu", f->allocation), 1);
    if (f->for_good)
        setenv("FAULT_FOR_GOOD", "1", 1);
    if (places != NULL)
        setenv("FAULT_PLACES", places, 1);
    if (f->allocation > 0 || places != NULL)
        setenv("LD_PRELOAD", shim, 1);
    setpgid(0, 0);
    if (stopped) {
        const int descriptor = hand_over_calls();
        if (descriptor < 0 || !send_descriptor(channel, descriptor))
            _exit(99);
        close(descriptor);
    }
    close(channel);
    execv(command, arguments);
    _exit(99);
}

/* Answers the calls of the program until it ends. */
static void answer_calls(int channel, pid_t child, const fault *f, outcome *o)
{
    struct seccomp_notif call;
    struct seccomp_notif_resp answer;
    const int descriptor = receive_descriptor(channel);
    if (descriptor < 0)
        return;
    for (struct pollfd ready = {descriptor, POLLIN, 0}; poll(&ready, 1, TIME_LIMIT * 1000) > 0;) {
        if ((ready.revents & POLLIN) == 0)
            break;
        memset(&call, 0, sizeof call);
        if (ioctl(descriptor, SECCOMP_IOCTL_NOTIF_RECV, &call) != 0)
            continue;
        memset(&answer, 0, sizeof answer);
        answer.id = call.id;
        answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
        /* The message about the failure is not blocked. */
        const bool words = call.data.nr == SYS_write && call.data.args[0] == 2;
        if (!words && (pid_t)call.pid == child && ++o->n_calls == f->call) {
            o->injected = true;
            if (f->signal != 0) {
                kill(child, f->signal);
            } else {
                answer.flags = 0;
                answer.error = -f->error;
            }
        }
        (void)ioctl(descriptor, SECCOMP_IOCTL_NOTIF_SEND, &answer);
    }
    close(descriptor);
}

static outcome run(const job *j, const char *folder, const fault *f, const char *places,
                   bool stopped)
{
    int channel[2];
    outcome o = {0};
    fflush(NULL);
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channel) != 0)
        give_up("socketpair");
    const pid_t child = fork();
    if (child < 0)
        give_up("fork");
    if (child == 0) {
        alarm(TIME_LIMIT); /* exec keeps it. */
        become_command(j, folder, f, places, channel[1], stopped);
    }
    close(channel[1]);
    if (stopped)
        answer_calls(channel[0], child, f, &o);
    close(channel[0]);
    while (waitpid(child, &o.state, 0) < 0 && errno == EINTR)
        ;
    o.injected = o.injected || f->allocation > 0;
    char *messages = print("%s/messages", work);
    FILE *in = fopen(messages, "r");
    if (in != NULL) {
        o.messages[fread(o.messages, 1, sizeof o.messages - 1, in)] = '\0';
        fclose(in);
    }
    free(messages);
    return o;
}

/* ---- contents of a folder -------------------------------------------------------------------- */

static uint64_t mix_hash(uint64_t hash, const void *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t content(const char *path)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    char bytes[LINE];
    size_t n;
    FILE *in = fopen(path, "r");
    if (in == NULL)
        return 0;
    while ((n = fread(bytes, 1, sizeof bytes, in)) > 0)
        hash = mix_hash(hash, bytes, n);
    fclose(in);
    return hash;
}

/* Hashes the names and contents of a folder and its subfolders; the files have a separate hash. */
static uint64_t look(const char *folder, size_t *n_files)
{
    uint64_t all = 0; /* The order of directory entries does not matter. */
    DIR *d = opendir(folder);
    for (struct dirent *e; d != NULL && (e = readdir(d)) != NULL;) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0)
            continue;
        char *path = print("%s/%s", folder, e->d_name);
        struct stat info;
        if (lstat(path, &info) != 0)
            memset(&info, 0, sizeof info);
        const uint64_t inner = S_ISDIR(info.st_mode) ? look(path, n_files) : content(path);
        all += mix_hash(inner, e->d_name, strlen(e->d_name));
        *n_files += 1;
        free(path);
    }
    if (d != NULL)
        closedir(d);
    return all;
}

static void empty(const char *folder)
{
    char *line = print("rm -rf '%s' && mkdir '%s'", folder, folder);
    if (system(line) != 0)
        give_up(folder);
    free(line);
}

/* ---- assessment ------------------------------------------------------------------------------ */

/* Result of a run without a failure. */
typedef struct truth {
    uint64_t all, output, printed;
    size_t n_files;
} truth;

static uint64_t of_output(const char *folder)
{
    static const char *const names[] = {"out.tsv", "out.h5", "out"};
    uint64_t hash = 0;
    size_t n = 0;
    struct stat info;
    for (size_t i = 0; i < 3; i++) {
        char *path = print("%s/%s", folder, names[i]);
        if (stat(path, &info) == 0)
            hash = S_ISDIR(info.st_mode) ? look(path, &n) : content(path);
        free(path);
    }
    return hash;
}

static truth hash_folder(const char *folder)
{
    truth t = {0};
    char *printed = print("%s/standard-output", folder);
    t.all = look(folder, &t.n_files);
    t.output = of_output(folder);
    t.printed = content(printed);
    free(printed);
    return t;
}

static const char *fault_name(const fault *f)
{
    static char name[128];
    if (f->allocation > 0)
        snprintf(name, sizeof name, "allocation %zu%s", f->allocation,
                 f->for_good ? " and all after it" : "");
    else
        snprintf(name, sizeof name, "call %zu: %s", f->call,
                 f->signal != 0 ? strsignal(f->signal) : strerror(f->error));
    return name;
}

static void survivor(const job *j, const fault *f, const outcome *o, const char *what)
{
    n_survivors++;
    printf("SURVIVOR %s, %s: %s (state %d); messages: %.*s\n", j->name, fault_name(f), what,
           o->state, (int)strcspn(o->messages, "\n"), o->messages);
    fflush(stdout);
}

/* Contents of a folder from which the next run recovered. They need no second test. */
static uint64_t *cleared;
static size_t n_cleared;

static bool is_cleared(uint64_t all)
{
    for (size_t i = 0; i < n_cleared; i++)
        if (cleared[i] == all)
            return true;
    return false;
}

static void add_cleared(uint64_t all)
{
    cleared = reallocarray(cleared, n_cleared + 1, sizeof *cleared);
    if (cleared == NULL)
        give_up("memory");
    cleared[n_cleared++] = all;
}

static void assess_outcome(const job *j, const char *folder, const fault *f, const truth *good)
{
    empty(folder);
    outcome o = run(j, folder, f, NULL, f->call > 0);
    if (!o.injected)
        return;
    n_injected++;
    const truth now = hash_folder(folder);
    if (WIFEXITED(o.state) && WEXITSTATUS(o.state) == 99) {
        give_up("the command could not be started");
    } else if (WIFSIGNALED(o.state)) {
        if (WTERMSIG(o.state) != f->signal) {
            survivor(j, f, &o, WTERMSIG(o.state) == SIGALRM ? "did not end" : "ended by a signal");
            return;
        }
    } else if (WEXITSTATUS(o.state) == 0) {
        if (now.all != good->all) {
            survivor(j, f, &o, "exit status 0 and other bytes or files");
            return;
        }
    } else if (o.messages[0] == '\0') {
        survivor(j, f, &o, "no message");
        return;
    }
    if (now.output != 0 && now.output != good->output) {
        survivor(j, f, &o, "half a file");
        return;
    }
    if (now.all == good->all || is_cleared(now.all))
        return;
    const fault none = {0};
    const outcome again = run(j, folder, &none, NULL, false);
    if (again.state != 0)
        survivor(j, f, &again, "the next run fails");
    else if (hash_folder(folder).all != good->all)
        survivor(j, f, &o, "left something that the next run does not clear");
    else
        add_cleared(now.all);
}

/* ---- all failures ---------------------------------------------------------------------------- */

/* Selects one in N, with an offset. */
typedef struct sampling {
    size_t allocations, calls, start;
} sampling;

static void sweep_allocations(const job *j, const char *folder, const truth *good,
                              const sampling *how)
{
    const fault none = {0};
    char *list = print("%s/places", work);
    size_t number = 0, n = 0;
    empty(folder);
    unlink(list);
    (void)run(j, folder, &none, list, false);
    FILE *in = fopen(list, "r");
    if (in == NULL)
        give_up(list);
    for (; fscanf(in, "%zu", &number) == 1; n++)
        if (n % how->allocations == how->start % how->allocations) {
            fault f = {.allocation = number};
            assess_outcome(j, folder, &f, good);
            f.for_good = true;
            assess_outcome(j, folder, &f, good);
        }
    fclose(in);
    printf("%s: allocations: %zu in all, at %zu places\n", j->name, number, n - 1);
    free(list);
}

static void sweep_calls(const job *j, const char *folder, const truth *good, const sampling *how)
{
    static const fault kinds[] = {
        {.error = ENOSPC}, {.error = EIO}, {.signal = SIGKILL}, {.signal = SIGTERM}};
    const fault none = {0};
    empty(folder);
    const size_t n = run(j, folder, &none, NULL, true).n_calls;
    for (size_t i = 1; i <= n; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
            if ((4 * i + k) % how->calls == how->start % how->calls) {
                fault f = kinds[k];
                f.call = i;
                assess_outcome(j, folder, &f, good);
            }
    printf("%s: %zu calls that write\n", j->name, n);
}

static void sweep(const job *j, const sampling *how, bool wanted)
{
    const fault none = {0};
    char *folder = print("%s/%s", work, j->name);
    empty(folder);
    const outcome o = run(j, folder, &none, NULL, false);
    if (o.state != 0) {
        fprintf(stderr, "fault: %s fails as it is: %s\n", j->name, o.messages);
        exit(2);
    }
    const truth good = hash_folder(folder);
    n_cleared = 0;
    if (wanted) {
        const size_t injected = n_injected, survivors = n_survivors;
        sweep_allocations(j, folder, &good, how);
        sweep_calls(j, folder, &good, how);
        printf("%s: %zu injected, %zu survivors\n", j->name, n_injected - injected,
               n_survivors - survivors);
        empty(folder);
        (void)run(j, folder, &none, NULL, false); /* for the jobs that read it */
    }
    free(folder);
}

/* A force curve that is too long to be unpacked in memory. */
static void write_long(void)
{
    char *line = print("gzip -n1 >'%s/unpacks.tsv.gz'", work);
    FILE *out = popen(line, "w");
    if (out == NULL)
        give_up(line);
    fputs("## table: force_curve/0\n# segment[text]\theight[m]\tforce[N]\n", out);
    for (int i = 0; i < 1 << 17; i++)
        fprintf(out, "approach\t%.12e\t%.12e\n", -1e-9 * i, 1e-12 * (i % 7));
    if (pclose(out) != 0)
        give_up(line);
    free(line);
}

int main(int argc, char **argv)
{
    sampling how = {1, 1, 0};
    const char *only = NULL;
    for (int i = 5; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--allocations") == 0)
            how.allocations = strtoull(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--calls") == 0)
            how.calls = strtoull(argv[i + 1], NULL, 10);
        else if (strcmp(argv[i], "--start") == 0)
            how.start = strtoull(argv[i + 1], NULL, 10);
        else
            only = argv[i + 1];
    }
    if (argc < 5 || argc % 2 == 0 || how.allocations == 0 || how.calls == 0) {
        fputs("usage: fault COMMAND SHIM FIXTURES WORK [--allocations N] [--calls N] [--start K] "
              "[--only JOB]\n",
              stderr);
        return 2;
    }
    command = realpath(argv[1], NULL);
    shim = realpath(argv[2], NULL);
    fixtures = realpath(argv[3], NULL);
    empty(argv[4]);
    if (command == NULL || shim == NULL || fixtures == NULL || realpath(argv[4], work) == NULL)
        give_up("arguments");
    /* Replaces gnuplot. */
    char *plot = print("%s/plot", work);
    FILE *out = fopen(plot, "w");
    if (out == NULL)
        give_up(plot);
    fputs(
        "#!/bin/sh\nfor f; do case $f in *.gp) "
        "echo '<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>' >\"${f%.gp}.svg\";; esac; done\n",
        out);
    if (fclose(out) != 0 || chmod(plot, 0700) != 0)
        give_up(plot);
    write_long();
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++)
        sweep(&jobs[i], &how, only == NULL || strcmp(only, jobs[i].name) == 0);
    printf("%zu faults injected, %zu survivors\n", n_injected, n_survivors);
    return n_survivors > 0 ? 1 : 0;
}
