/* Tests the local server of `weartrack view` with a small socket client: responses, refused
 * requests, exit, and numbers that equal those of `weartrack run` to the last digit.
 *
 * Usage: view_server PROGRAM FIXTURES WORK
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { ANSWER_SIZE = 32 << 20 };
static char *answer; /* [ANSWER_SIZE] header and body of the last response */
static unsigned port;
static char token[64];
static const char *program;
static pid_t server;

static _Noreturn void fail(const char *what)
{
    fprintf(stderr, "FAIL %s: %.600s\n", what, answer);
    if (server > 0)
        (void)kill(server, SIGKILL);
    exit(1);
}

static void check(bool holds, const char *what)
{
    if (!holds)
        fail(what);
}

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- client ---------------------------------------------------------------------------------- */

static int connect_to_server(void)
{
    const struct sockaddr_in to = {.sin_family = AF_INET,
                                   .sin_port = htons((uint16_t)port),
                                   .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int s = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const struct timeval limit = {.tv_sec = 60};
    check(s >= 0 && connect(s, (const struct sockaddr *)&to, sizeof to) == 0, "no connection");
    (void)setsockopt(s, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    return s;
}

/* Sends bytes; returns false if the server has closed the connection. */
static bool send_bytes(int s, const char *bytes, size_t n)
{
    while (n > 0) {
        const ssize_t sent = send(s, bytes, n, MSG_NOSIGNAL);
        if (sent <= 0)
            return false;
        bytes += sent;
        n -= (size_t)sent;
    }
    return true;
}

/* Reads until the connection closes and returns the status, 0 without a response. */
static int receive_answer(int s)
{
    size_t n = 0;
    for (ssize_t got;
         n + 1 < ANSWER_SIZE && (got = recv(s, answer + n, ANSWER_SIZE - 1 - n, 0)) > 0;)
        n += (size_t)got;
    answer[n] = '\0';
    close(s);
    return strncmp(answer, "HTTP/1.1 ", 9) == 0 ? atoi(answer + 9) : 0;
}

/* Sends a request; `head` lacks only the length of the body. */
static int send_request(const char *head, const char *body, size_t length)
{
    char lines[2048];
    const int s = connect_to_server();
    (void)snprintf(lines, sizeof lines, "%sConnection: close\r\nContent-Length: %zu\r\n\r\n", head,
                   length);
    if (send_bytes(s, lines, strlen(lines)))
        (void)send_bytes(s, body, length);
    return receive_answer(s);
}

/* Sends a request as the page does. `target` follows the token. */
static int ask(const char *method, const char *target, const char *body)
{
    char head[1024];
    (void)snprintf(head, sizeof head,
                   "%s /%s/%s HTTP/1.1\r\nHost: 127.0.0.1:%u\r\nOrigin: http://127.0.0.1:%u\r\n"
                   "Sec-Fetch-Site: same-origin\r\n",
                   method, token, target, port, port);
    return send_request(head, body, strlen(body));
}

static void expect(int status, const char *method, const char *target, const char *body,
                   const char *part)
{
    const int found = ask(method, target, body);
    if (found != status || strstr(answer, part) == NULL) {
        fprintf(stderr, "%s %s: %d instead of %d, or without \"%s\"\n", method, target, found,
                status, part);
        fail("answer");
    }
}

/* Returns the text after `"name": ` that follows the first `after`, up to a comma or the end. */
static void member(const char *after, const char *name, char *to, size_t size)
{
    char key[64];
    const char *at = strstr(answer, after);
    (void)snprintf(key, sizeof key, "\"%s\":", name);
    at = at != NULL ? strstr(at, key) : NULL;
    check(at != NULL, name);
    at += strlen(key);
    at += strspn(at, " \"");
    (void)snprintf(to, size, "%.*s", (int)strcspn(at, ",}\""), at);
}

/* ---- server ---------------------------------------------------------------------------------- */

static pid_t start_server(char *argument)
{
    char *const words[] = {
        (char *)(size_t)program, "view", "--no-open", "--port", "0", argument, NULL};
    int out[2];
    pid_t child = 0;
    posix_spawn_file_actions_t files;
    check(pipe(out) == 0 && posix_spawn_file_actions_init(&files) == 0, "pipe");
    (void)posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
    (void)posix_spawn_file_actions_addclose(&files, out[0]);
    check(posix_spawn(&child, program, &files, NULL, words, environ) == 0, "start");
    (void)posix_spawn_file_actions_destroy(&files);
    close(out[1]);
    FILE *stream = fdopen(out[0], "r");
    check(stream != NULL && fscanf(stream, "http://127.0.0.1:%u/%63[0-9a-f]/", &port, token) == 2,
          "no address");
    (void)fclose(stream);
    return child;
}

/* Waits for the process and returns the exit status, 128 plus the signal, or -1 on a timeout. */
static int end_of(pid_t child, double limit)
{
    int state = 0;
    for (const double end = now() + limit; now() < end;) {
        if (waitpid(child, &state, WNOHANG) == child)
            return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
        (void)usleep(20000);
    }
    (void)kill(child, SIGKILL);
    return -1;
}

static int run(char *const words[])
{
    pid_t child = 0;
    posix_spawn_file_actions_t files;
    check(posix_spawn_file_actions_init(&files) == 0 &&
              posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) ==
                  0 &&
              posix_spawn(&child, words[0], &files, NULL, words, environ) == 0,
          words[1]);
    (void)posix_spawn_file_actions_destroy(&files);
    return end_of(child, 300);
}

static char *read_file(const char *name)
{
    FILE *file = fopen(name, "r");
    check(file != NULL, name);
    char *text = calloc(1, 1 << 20);
    check(text != NULL && fread(text, 1, (1 << 20) - 1, file) > 0, name);
    (void)fclose(file);
    return text;
}

static void copy(const char *from, const char *to)
{
    char *const words[] = {"/bin/cp", (char *)(size_t)from, (char *)(size_t)to, NULL};
    check(run(words) == 0, from);
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void test_refusals(const char *case_text)
{
    char head[1024];
    (void)snprintf(head, sizeof head, "GET /%s/state HTTP/1.1\r\nHost: evil.example:%u\r\n", token,
                   port);
    check(send_request(head, "", 0) == 403, "another host name");
    (void)snprintf(
        head, sizeof head,
        "GET /%s/state HTTP/1.1\r\nHost: 127.0.0.1:%u\r\nOrigin: http://evil.example\r\n", token,
        port);
    check(send_request(head, "", 0) == 403, "another origin");
    (void)snprintf(head, sizeof head, "GET /state HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n", port);
    check(send_request(head, "", 0) == 403 && strstr(answer, token) == NULL, "no token");
    expect(404, "GET", "../../etc/passwd", "", "");
    expect(405, "GET", "save", "", "");
    expect(422, "GET", "info?number=x", "", "no file has this number");
    expect(422, "GET", "info?number=-1", "", "no file has this number");
    expect(422, "GET", "info?number=1e99", "", "no file has this number");
    expect(422, "GET", "info?number=99999", "", "error");
    expect(422, "POST", "check", "<case", "error");
    expect(422, "POST", "new-case", "", "there is a case already");
    expect(422, "POST", "save?name=case.xml&was=", "<case version=\"1\"><unknown/></case>",
           "error");
    expect(422, "POST", "curve?group=bulk&file=..%2F..%2Fetc%2Fpasswd&number=0", case_text,
           "error");
    /* The server does not read a body above the limit to its end. */
    enum { HUGE = 8 << 20 };
    char *huge = malloc(HUGE);
    check(huge != NULL, "memory");
    memset(huge, 'x', HUGE);
    (void)snprintf(head, sizeof head, "POST /%s/check HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n", token,
                   port);
    check(send_request(head, huge, HUGE) != 200, "a huge body");
    /* Bytes that are not HTTP and a silent client do not stop the server. */
    const int garbage = connect_to_server(), silent = connect_to_server();
    (void)send_bytes(garbage, huge, 100000);
    check(receive_answer(garbage) != 200, "garbage");
    free(huge);
    expect(200, "GET", "state", "", "\"case\":");
    close(silent);
}

/* A file is added once, under a plain name in the folder of the case; no file is replaced. */
static void test_added_files(const char *case_text)
{
    enum { HUGE = 65 << 20 };
    char head[1024];
    struct stat state;
    check(symlink("behind.txt", "link.txt") == 0, "link");
    expect(200, "POST", "save?name=new%20one.txt", "of a\tfile\n", "digest");
    char *text = read_file("new one.txt");
    check(strcmp(text, "of a\tfile\n") == 0, "bytes of an added file");
    free(text);
    expect(200, "GET", "state", "", "/new one.txt");
    expect(422, "POST", "save?name=new%20one.txt", "other", "has a file of this name");
    expect(409, "POST", "save?name=case.xml", case_text, "has changed");
    expect(422, "POST", "save?name=link.txt", "x", "has a file of this name");
    check(stat("behind.txt", &state) != 0, "a link is not followed");
    static const char *const names[] = {"..%2Foutside.txt",
                                        "%2Ftmp%2Foutside.txt",
                                        "..",
                                        ".hidden",
                                        "-o",
                                        "folder%2Ffile.txt",
                                        "",
                                        "."};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char target[128];
        (void)snprintf(target, sizeof target, "save?name=%s", names[i]);
        expect(422, "POST", target, "x", "no plain file name");
    }
    expect(422, "POST", "save?name=a%00b", "x", "no plain file name");
    expect(422, "POST", "save?name=a%0Ab", "x", "no plain file name");
    expect(422, "POST", "save", "x", "no plain file name");
    expect(405, "GET", "save?name=got.txt", "", "");
    check(stat("../outside.txt", &state) != 0 && stat("got.txt", &state) != 0,
          "nothing is written");
    (void)snprintf(head, sizeof head,
                   "POST /%s/save?name=evil.txt HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n"
                   "Origin: http://evil.example\r\n",
                   token, port);
    check(send_request(head, "x", 1) == 403, "a file from another origin");
    (void)snprintf(head, sizeof head,
                   "POST /%.*s/save?name=evil.txt HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n", 31, token,
                   port);
    check(send_request(head, "x", 1) == 403, "a file with a part of the token");
    char *huge = malloc(HUGE);
    check(huge != NULL, "memory");
    memset(huge, 'x', HUGE);
    (void)snprintf(head, sizeof head,
                   "POST /%s/save?name=evil.txt HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n", token, port);
    check(send_request(head, huge, HUGE) != 200, "a file that is too large");
    free(huge);
    check(stat("evil.txt", &state) != 0, "no file of a refused request");
    check(unlink("link.txt") == 0 && unlink("new one.txt") == 0, "added files");
}

/* The fit of one curve has the same digits by the server, by its preview and by `run`. */
static void test_digits(const char *case_text)
{
    char of_curve[64], of_preview[64], of_run[64], contact[64], moved[64], error[64];
    expect(200, "POST", "curve?group=bulk&file=bulk-1.jpk-force-map&number=0", case_text,
           "\"curves\"");
    member("\"rows\"", "modulus", of_curve, sizeof of_curve);
    member("\"rows\"", "contact_point", contact, sizeof contact);
    expect(200, "POST", "preview?name=indentation/bulk&replicates=0", case_text, "bulk-1");
    member("\"rows\"", "modulus", of_preview, sizeof of_preview);
    /* draws are made where the page asks for them, and only there */
    expect(200, "POST", "preview?name=friction&replicates=0", case_text, "friction_at_reference");
    member("\"friction_at_reference\"", "standard_error", error, sizeof error);
    check(strcmp(error, "null") == 0, "no draws");
    expect(200, "POST", "preview?name=friction&replicates=20", case_text, "friction_at_reference");
    member("\"friction_at_reference\"", "standard_error", error, sizeof error);
    check(strtod(error, NULL) > 0, "draws");
    char *const words[] = {(char *)(size_t)program, "run", "-q", "--no-report", "case.xml", NULL};
    check(run(words) == 0, "run");
    expect(200, "GET", "table?name=indentation/bulk", "", "bulk-1");
    member("\"rows\"", "modulus", of_run, sizeof of_run);
    printf("modulus of the curve %s, of the preview %s, of the run %s\n", of_curve, of_preview,
           of_run);
    check(strcmp(of_curve, of_run) == 0 && strcmp(of_preview, of_run) == 0, "digits");
    /* another contact point, as an override that the shell repeats */
    char target[256], overrides[512];
    (void)snprintf(
        target, sizeof target,
        "curve?group=bulk&file=bulk-1.jpk-force-map&number=0&name=fixed-contact-point&value=%.12gm",
        atof(contact) + 5e-9);
    expect(200, "POST", target, case_text, "contact point by hand");
    member("\"rows\"", "modulus", moved, sizeof moved);
    check(strcmp(moved, of_run) != 0, "a moved contact point changes the modulus");
    (void)snprintf(
        overrides, sizeof overrides,
        "## table: choices\n# group[text]\tfile[text]\tcurve[1]\tchoice[text]\tvalue[text]\t"
        "note[text]\nbulk\tbulk-1.jpk-force-map\t0\tcontact-point\t%.12gm\t-\n##\n",
        atof(contact) + 5e-9);
    expect(200, "POST", "save?name=overrides.tsv&was=", overrides, "digest");
    expect(409, "POST", "save?name=overrides.tsv&was=", overrides,
           "error"); /* The file exists now. */
    const char *section = "<indentation>";
    const char *at = strstr(case_text, section);
    char *changed = calloc(1, strlen(case_text) + 256), digest[80];
    check(at != NULL && changed != NULL, section);
    (void)sprintf(changed, "%.*s%s<overrides>overrides.tsv</overrides>%s", (int)(at - case_text),
                  case_text, section, at + strlen(section));
    expect(200, "GET", "state", "", "digest");
    member("\"case\":", "digest", digest, sizeof digest);
    (void)snprintf(target, sizeof target, "save?name=case.xml&was=%s", digest);
    expect(200, "POST", target, changed, "digest");
    check(run(words) == 0, "run with overrides");
    expect(200, "GET", "table?name=indentation/bulk", "", "by hand");
    member("\"rows\"", "modulus", of_run, sizeof of_run);
    printf("with the contact point by hand %s, of the run %s\n", moved, of_run);
    check(strcmp(moved, of_run) == 0, "the override gives the digits of the page");
    free(changed);
}

/* A link in place of the overrides is neither read nor replaced. */
static void test_link(void)
{
    copy("case.xml", "secret.txt");
    check(unlink("overrides.tsv") == 0 && symlink("secret.txt", "overrides.tsv") == 0, "link");
    expect(422, "POST", "save?name=overrides.tsv&was=", "x", "error");
    expect(200, "GET", "state", "", "symbolic links are not followed");
    char *text = read_file("secret.txt");
    check(strncmp(text, "<?xml", 5) == 0, "the file behind a link is unchanged");
    free(text);
    check(unlink("overrides.tsv") == 0, "link");
}

/* A result names its case, also if the name has special characters. */
static void test_result(void)
{
    FILE *const file = fopen("study.xml", "w");
    check(file != NULL && fputs("<case version=\"1\"><dma><poisson-ratio>0.5</poisson-ratio>"
                                "<files>dma.txt</files></dma></case>\n",
                                file) >= 0,
          "study.xml");
    (void)fclose(file);
    char *const words[] = {(char *)(size_t)program, "run", "-q", "--no-report", "study.xml", NULL};
    check(run(words) == 0, "run of study.xml");
    server = start_server("study.h5");
    expect(200, "GET", "state", "", "study.xml");
    check(kill(server, SIGINT) == 0 && end_of(server, 20) == 128 + SIGINT, "Ctrl-C of a result");
}

/* A result of indent has no case: its curves are shown with the digits that it has. */
static void test_result_without_case(void)
{
    char of_result[64], *const words[] = {(char *)(size_t)program,
                                          "indent",
                                          "-q",
                                          "--tip",
                                          "pyramid:half-angle=20deg,radius=20nm",
                                          "--group",
                                          "other",
                                          "--curves",
                                          "bulk-1.jpk-force-map:3",
                                          "bulk-1.jpk-force-map",
                                          "-o",
                                          "alone/curves.h5",
                                          NULL};
    check(mkdir("alone", 0777) == 0 && run(words) == 0, "indent");
    server = start_server("alone/curves.h5");
    expect(200, "GET", "state", "", "indentation/other");
    expect(200, "GET", "table?name=indentation/other", "", "\"curve\": 3");
    expect(200, "POST", "curve?group=other&file=bulk-1.jpk-force-map&number=3", "",
           "\"fitted_force\"");
    member("\"rows\"", "modulus", of_result, sizeof of_result);
    check(atof(of_result) > 0, "the modulus of the row");
    check(strstr(answer, "\"curve\": 4") == NULL, "one curve");
    expect(422, "POST", "curve?group=other&file=bulk-1.jpk-force-map&number=4", "",
           "indent --curves all");
    check(kill(server, SIGINT) == 0 && end_of(server, 20) == 128 + SIGINT, "Ctrl-C of a result");
}

/* Latencies depend on the machine. They are printed; only an extreme value is a failure. */
static void test_latency(const char *case_text)
{
    double start = now();
    for (int i = 0; i < 20; i++)
        expect(200, "POST", "curve?group=track&file=track-2.jpk-force-map&number=3", case_text,
               "curves");
    const double curve = (now() - start) / 20;
    start = now();
    expect(200, "POST", "preview?name=friction&replicates=0", case_text, "friction_at_reference");
    const double friction = now() - start;
    printf("one curve %.1f ms, friction %.0f ms\n", 1e3 * curve, 1e3 * friction);
    check(curve < 5 && friction < 60, "latency");
}

int main(int argc, char **argv)
{
    static const char *const names[] = {"case.xml",
                                        "dma.txt",
                                        "bulk-1.jpk-force-map",
                                        "bulk-2.jpk-force-map",
                                        "bulk-3.jpk-force-map",
                                        "bulk-4.jpk-force-map",
                                        "track-1.jpk-force-map",
                                        "track-2.jpk-force-map",
                                        "track-3.jpk-force-map",
                                        "track-4.jpk-force-map",
                                        "road-1.gsf",
                                        "road-2.gsf",
                                        "road-1-near.gsf",
                                        "road-2-near.gsf"};
    char path[4096];
    answer = calloc(1, ANSWER_SIZE);
    if (argc != 4 || answer == NULL)
        return 2;
    program = argv[1];
    char *const clean[] = {"/bin/rm", "-rf", argv[3], NULL}, *const make[] = {"/bin/mkdir", "-p",
                                                                              argv[3], NULL};
    check(run(clean) == 0 && run(make) == 0 && chdir(argv[3]) == 0, argv[3]);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        (void)snprintf(path, sizeof path, "%s/case/%s", argv[2], names[i]);
        copy(path, names[i]);
    }
    server = start_server("case.xml");
    char *case_text = read_file("case.xml");
    expect(200, "GET", "", "", "Content-Security-Policy");
    expect(200, "GET", "view.js", "", "text/javascript");
    expect(200, "GET", "state", "", "road-1.gsf"); /* numbers the files */
    expect(200, "GET", "info?number=0", "", "gsf");
    test_refusals(case_text);
    test_added_files(case_text);
    test_digits(case_text);
    test_link();
    test_latency(case_text);
    /* Ctrl-C ends the server at once; after the last page closes it ends within a few seconds. */
    check(kill(server, SIGINT) == 0 && end_of(server, 20) == 128 + SIGINT, "Ctrl-C");
    test_result();
    test_result_without_case();
    server = start_server(".");
    expect(200, "POST", "page?name=open", "", "{}");
    expect(200, "POST", "page?name=leave", "", "{}");
    check(end_of(server, 30) == 0, "the end of the last page");
    free(case_text);
    free(answer);
    return 0;
}
