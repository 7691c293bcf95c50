/* Drives the page of `weartrack view` in a real browser over the debugging protocol, from the
 * choice of files to an override that the shell repeats. The test is skipped without chromium.
 *
 * Usage: view_browser PROGRAM FIXTURES WORK
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { MESSAGE_SIZE = 4 << 20, SKIPPED = 77, LIMIT = 120 };
static char *message; /* [MESSAGE_SIZE] last message of the browser */
static size_t length; /* number of bytes after the message that are already read */
static int to_browser, from_browser;
static pid_t browser, server;
/* target of the calls; result of the last expression, "" on failure */
static char session[80], value[4096];

static _Noreturn void fail(const char *what)
{
    fprintf(stderr, "FAIL %s: \"%s\" %.500s\n", what, value, message);
    if (browser > 0)
        (void)kill(browser, SIGKILL);
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

/* ---- debugging protocol: messages of JSON that end with a zero byte ----------------------------
 */

static void receive(void)
{
    size_t used = strlen(message) + 1;
    if (length > 0) { /* keeps the bytes after the last message */
        memmove(message, message + used, length);
    }
    for (const double end = now() + LIMIT; memchr(message, '\0', length) == NULL;) {
        struct pollfd input = {from_browser, POLLIN, 0};
        check(now() < end && length < MESSAGE_SIZE - 1, "the browser does not answer");
        if (poll(&input, 1, 1000) <= 0)
            continue;
        const ssize_t got = read(from_browser, message + length, MESSAGE_SIZE - 1 - length);
        check(got > 0, "the browser has ended");
        length += (size_t)got;
    }
    length -= strlen(message) + 1;
}

/* Calls a method and waits for its reply, which replaces the message. */
static void call(const char *method, const char *parameters)
{
    static int number;
    char key[32], text[8192];
    number++;
    const int n = snprintf(text, sizeof text, "{\"id\":%d,%s%s%s\"method\":\"%s\",\"params\":{%s}}",
                           number, session[0] != '\0' ? "\"sessionId\":\"" : "", session,
                           session[0] != '\0' ? "\"," : "", method, parameters);
    check(n > 0 && (size_t)n < sizeof text && write(to_browser, text, (size_t)n + 1) == n + 1,
          method);
    (void)snprintf(key, sizeof key, "{\"id\":%d,", number);
    do
        receive();
    while (strncmp(message, key, strlen(key)) != 0);
    /* A page that is loading cannot evaluate an expression yet. */
    check(strstr(message, "\"error\":{") == NULL || strstr(message, "execution context") != NULL,
          method);
}

static void member(const char *name, char *to, size_t size)
{
    char key[64];
    (void)snprintf(key, sizeof key, "\"%s\":\"", name);
    const char *at = strstr(message, key);
    check(at != NULL, name);
    at += strlen(key);
    (void)snprintf(to, size, "%.*s", (int)strcspn(at, "\""), at);
}

/* Evaluates an expression without double quotes; `value` receives the result as text. */
static const char *js(const char *expression)
{
    char parameters[4096];
    (void)snprintf(parameters, sizeof parameters,
                   "\"expression\":\"(async () => String(%s))()\",\"awaitPromise\":true,"
                   "\"returnByValue\":true",
                   expression);
    call("Runtime.evaluate", parameters);
    value[0] = '\0';
    if (strstr(message, "\"error\":{") == NULL && strstr(message, "\"exceptionDetails\"") == NULL)
        member("value", value, sizeof value);
    return value;
}

/* Waits until an expression has this value. */
static void wait_for(const char *expression, const char *expected)
{
    for (const double end = now() + LIMIT; strcmp(js(expression), expected) != 0;) {
        check(now() < end, expression);
        (void)usleep(50000);
    }
}

static const char *data(const char *name)
{
    char expression[128];
    (void)snprintf(expression, sizeof expression, "document.documentElement.dataset.%s", name);
    return js(expression);
}

static void mouse(const char *type, double x, double y)
{
    char parameters[256];
    (void)snprintf(
        parameters, sizeof parameters,
        "\"type\":\"%s\",\"x\":%.1f,\"y\":%.1f,\"button\":\"left\",\"buttons\":1,\"clickCount\":1",
        type, x, y);
    call("Input.dispatchMouseEvent", parameters);
}

static void key(const char *name, int modifiers)
{
    char parameters[256];
    for (int up = 0; up < 2; up++) {
        (void)snprintf(parameters, sizeof parameters,
                       "\"type\":\"%s\",\"key\":\"%s\",\"modifiers\":%d",
                       up ? "keyUp" : "rawKeyDown", name, modifiers);
        call("Input.dispatchKeyEvent", parameters);
    }
}

/* ---- processes ------------------------------------------------------------------------------- */

static pid_t spawn(char *const words[], const int moves[][2], size_t n)
{
    pid_t child = 0;
    posix_spawn_file_actions_t files;
    check(posix_spawn_file_actions_init(&files) == 0, "spawn");
    for (size_t i = 0; i < n; i++)
        (void)posix_spawn_file_actions_adddup2(&files, moves[i][0], moves[i][1]);
    check(posix_spawnp(&child, words[0], &files, NULL, words, environ) == 0, words[0]);
    (void)posix_spawn_file_actions_destroy(&files);
    return child;
}

static int end_of(pid_t child)
{
    int state = 0;
    while (waitpid(child, &state, 0) < 0)
        check(errno == EINTR, "wait");
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

static void shell(const char *command)
{
    char *const words[] = {"/bin/sh", "-c", (char *)(size_t)command, NULL};
    check(end_of(spawn(words, NULL, 0)) == 0, command);
}

static bool has_chromium(void)
{
    char *const words[] = {"/bin/sh", "-c", "command -v chromium >/dev/null", NULL};
    return end_of(spawn(words, NULL, 0)) == 0;
}

static void start_browser(void)
{
    enum { COMMANDS = 3, ANSWERS = 4 }; /* descriptors of --remote-debugging-pipe */
    char *const words[] = {"chromium",
                           "--headless",
                           "--no-sandbox",
                           "--disable-gpu",
                           "--no-first-run",
                           "--disable-background-networking",
                           "--disable-component-update",
                           "--user-data-dir=profile",
                           "--window-size=1280,1000",
                           "--remote-debugging-pipe",
                           "about:blank",
                           NULL};
    int in[2], out[2], high[2];
    const int words_file = open("browser.txt", O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    check(pipe2(in, O_CLOEXEC) == 0 && pipe2(out, O_CLOEXEC) == 0 && words_file >= 0, "pipe");
    /* above the descriptors of the child, so that none is replaced before its use */
    high[0] = fcntl(in[0], F_DUPFD_CLOEXEC, 20);
    high[1] = fcntl(out[1], F_DUPFD_CLOEXEC, 20);
    const int none = fcntl(words_file, F_DUPFD_CLOEXEC, 20);
    const int moves[][2] = {{high[0], COMMANDS}, {high[1], ANSWERS}, {none, STDERR_FILENO}};
    to_browser = fcntl(in[1], F_DUPFD_CLOEXEC, 20);
    from_browser = fcntl(out[0], F_DUPFD_CLOEXEC, 20);
    browser = spawn(words, moves, 3);
    close(in[0]);
    close(in[1]);
    close(out[0]);
    close(out[1]);
    close(high[0]);
    close(high[1]);
    close(words_file);
    close(none);
}

static void open_page(const char *address)
{
    char parameters[512], target[80];
    session[0] = '\0';
    (void)snprintf(parameters, sizeof parameters, "\"url\":\"%s\"", address);
    call("Target.createTarget", parameters);
    member("targetId", target, sizeof target);
    (void)snprintf(parameters, sizeof parameters, "\"targetId\":\"%s\",\"flatten\":true", target);
    call("Target.attachToTarget", parameters);
    member("sessionId", session, sizeof session);
}

static void start_server(const char *program, const char *path, char *address, size_t size)
{
    char *const words[] = {(char *)(size_t)program, "view", "--no-open", (char *)(size_t)path,
                           NULL};
    int out[2];
    check(pipe2(out, O_CLOEXEC) == 0, "pipe");
    const int moves[][2] = {{out[1], STDOUT_FILENO}};
    server = spawn(words, moves, 1);
    close(out[1]);
    FILE *stream = fdopen(out[0], "r");
    check(stream != NULL && fgets(address, (int)size, stream) != NULL, "address");
    address[strcspn(address, "\n")] = '\0';
    (void)fclose(stream);
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void click(const char *selector)
{
    char expression[256];
    (void)snprintf(expression, sizeof expression, "document.querySelector('%s').click()", selector);
    (void)js(expression);
}

static void open_panel(const char *id)
{
    char selector[64], expression[128];
    (void)snprintf(selector, sizeof selector, "#tab-%s", id);
    click(selector);
    wait_for("document.documentElement.dataset.shown", id);
    (void)snprintf(expression, sizeof expression,
                   "document.querySelector('#%s .problem').textContent", id);
    check(strcmp(js(expression), "") == 0, id);
    check(strcmp(data("error"), "undefined") == 0, "an error of the page");
}

/* Moves a marker of the curve with the mouse. */
static void drag_marker(const char *label, double pixels)
{
    char expression[512];
    double x = 0, y = 0;
    (void)snprintf(expression, sizeof expression,
                   "(() => { const b = [...document.querySelectorAll('#curves .marker')].find((m) "
                   "=> m.getAttribute('aria-label') === '%s').querySelector('.grip')"
                   ".getBoundingClientRect(); "
                   "return b.x + b.width / 2 + ' ' + (b.y + b.height / 2); })()",
                   label);
    check(sscanf(js(expression), "%lf %lf", &x, &y) == 2, label);
    mouse("mousePressed", x, y);
    for (int i = 1; i <= 4; i++)
        mouse("mouseMoved", x + pixels * i / 4, y);
    mouse("mouseReleased", x + pixels, y);
}

static void test_curves(void)
{
    char before[64], moved[64], shorter[64];
    open_panel("curves");
    wait_for("document.documentElement.dataset.curves", "48");
    (void)snprintf(before, sizeof before, "%s", data("modulus"));
    check(atof(before) > 1e6, "a modulus is shown");
    drag_marker("contact point", 20);
    wait_for("document.documentElement.dataset.overrides", "1");
    wait_for("document.querySelector('#curves .soft').closest('section').textContent.includes("
             "'contact point by hand')",
             "true");
    (void)snprintf(moved, sizeof moved, "%s", data("modulus"));
    check(strcmp(moved, before) != 0, "dragging changes E");
    drag_marker("baseline to contact", -60);
    wait_for("document.documentElement.dataset.overrides", "2");
    wait_for("document.querySelector('#curves').textContent.includes("
             "'contact point and baseline by hand')",
             "true");
    (void)snprintf(shorter, sizeof shorter, "%s", data("modulus"));
    check(strcmp(shorter, moved) != 0, "another baseline changes E");
    (void)js("document.querySelector('#curves .list').focus()");
    key("ArrowDown", 0);
    wait_for(
        "document.querySelector('#curves .list [aria-selected=true]').textContent.startsWith('1:')",
        "true");
    key("x", 0);
    wait_for("document.documentElement.dataset.overrides", "3");
    key("u", 0);
    wait_for("document.documentElement.dataset.overrides", "2");
    key("x", 0);
    wait_for("document.documentElement.dataset.overrides", "3");
    printf("E %s, with the contact point dragged %s, and the baseline %s\n", before, moved,
           shorter);
}

/* The case and the overrides of the page give the same digits in the shell. */
static void test_shell(const char *program)
{
    char shown[64], command[8192];
    (void)js("document.querySelector('#curves .list').focus()");
    key("ArrowUp", 0);
    wait_for(
        "document.querySelector('#curves .list [aria-selected=true]').textContent.startsWith('0:')",
        "true");
    wait_for("document.querySelector('#curves h2').textContent.endsWith('curve 0')", "true");
    wait_for("document.querySelector('#curves').textContent.includes("
             "'contact point and baseline by hand')",
             "true");
    (void)snprintf(shown, sizeof shown, "%s", data("modulus"));
    key("s", 2 /* control */);
    wait_for("document.documentElement.dataset.changed", "false");
    (void)snprintf(
        command, sizeof command,
        "'%s' run -q --no-report case.xml >answer.txt && '%s' table case.h5 indentation/bulk "
        ">rows.txt && grep -q 'contact point and baseline by hand' rows.txt && "
        "sed -n 2p rows.txt | cut -f8 >modulus.txt && grep -q 'left out by hand' rows.txt",
        program, program);
    shell(command);
    FILE *file = fopen("modulus.txt", "r");
    double of_shell = 0;
    check(file != NULL && fscanf(file, "%lf", &of_shell) == 1, "the table of the shell");
    (void)fclose(file);
    printf("E of the page %s, of the shell %.17g\n", shown, of_shell);
    check(of_shell == atof(shown), "the shell gives the digits of the page");
}

/* Returns the screen position where the handle of the 60 degC isotherm lies above the others. */
static void find_isotherm(double *x, double *y)
{
    (void)js("(() => { const g = document.querySelector('#master .handle[aria-label^=`Isotherm of "
             "60`] .grip'.replaceAll('`', String.fromCharCode(34))), m = g.getScreenCTM(); "
             "for (let s = 1; s < g.getTotalLength(); s += 2) { "
             "const p = g.getPointAtLength(s).matrixTransform(m); "
             "if (document.elementFromPoint(p.x, p.y) === g) return p.x + ' ' + p.y; } "
             "return 'hidden'; })()");
    check(sscanf(value, "%lf %lf", x, y) == 2, "the isotherm of 60 degC");
}

/* Compares the shifts on the page with a table of the shell, digit by digit. */
static void compare_shifts(const char *shown, const char *name)
{
    char kind[32];
    double of_page, of_shell;
    int n = 0, by_hand = 0;
    FILE *file = fopen(name, "r");
    check(file != NULL, name);
    for (const char *at = shown; at != NULL; n++) {
        check(sscanf(at, "%31[a-z ] %lf", kind, &of_page) == 2 &&
                  fscanf(file, "%lf", &of_shell) == 1 && of_page == of_shell,
              "the shell gives the shifts of the page");
        by_hand += strncmp(kind, "by hand", 7) == 0;
        const char *const comma = strchr(at, ',');
        at = comma != NULL ? comma + 2 : NULL;
    }
    (void)fclose(file);
    check(n == 12 && by_hand == 1, "12 shifts, one of them by hand");
}

/* Drags an isotherm with the mouse, undoes it, and moves it with a key. The case and the command
 * line of the panel give the same shifts. */
static void test_hand_shift(const char *program)
{
    char fitted[2048], dragged[2048], command[8192], line[1024];
    double x, y;
    open_panel("master");
    (void)snprintf(fitted, sizeof fitted, "%s", data("shifts"));
    check(strstr(fitted, "by hand") == NULL, "no shift by hand yet");
    find_isotherm(&x, &y);
    mouse("mousePressed", x, y);
    for (int i = 1; i <= 4; i++)
        mouse("mouseMoved", x + 5 * i, y);
    mouse("mouseReleased", x + 20, y);
    wait_for("document.documentElement.dataset.shifts.includes('by hand')", "true");
    (void)snprintf(dragged, sizeof dragged, "%s", data("shifts"));
    click("#undo");
    wait_for("document.documentElement.dataset.shifts.includes('by hand')", "false");
    check(strcmp(data("shifts"), fitted) == 0, "undo takes the shift back");
    click("#redo");
    wait_for("document.documentElement.dataset.shifts.includes('by hand')", "true");
    check(strcmp(data("shifts"), dragged) == 0, "redo");
    (void)js("document.querySelector('#master .handle[aria-label*=`60.`]'.replaceAll('`', "
             "String.fromCharCode(34))).focus()");
    key("ArrowLeft", 0);
    for (const double end = now() + LIMIT; strcmp(data("shifts"), dragged) == 0;)
        check(now() < end, "a key moves the isotherm");
    (void)snprintf(dragged, sizeof dragged, "%s", data("shifts"));
    key("s", 2 /* control */);
    wait_for("document.documentElement.dataset.changed", "false");
    (void)snprintf(
        line, sizeof line, "%s",
        js("document.querySelector('#command').textContent.split(String.fromCharCode(10))"
           ".find((l) => l.startsWith('weartrack master')).slice(10)"));
    check(strstr(line, "--shift 60.") != NULL, "the command line of the shift");
    (void)snprintf(command, sizeof command,
                   "'%s' run -q --no-report case.xml >answer.txt && '%s' %s -q && "
                   "for f in case master; do '%s' table $f.h5 shift_factors | grep -v '^[#t]' | "
                   "cut -f2 >$f.txt; done",
                   program, program, line, program);
    shell(command);
    compare_shifts(dragged, "case.txt");
    compare_shifts(dragged, "master.txt");
    printf("by hand: weartrack %s\n", line);
}

static void test_sliders(void)
{
    open_panel("master");
    check(strcmp(data("isotherms"), "12") == 0, "12 isotherms");
    click("#master input[type=checkbox]");
    wait_for("document.documentElement.dataset.isotherms", "11");
    (void)js("document.querySelector('#undo').click()");
    wait_for("document.documentElement.dataset.isotherms", "12");
    (void)js(
        "(() => { const s = document.querySelector('#master input[type=range]'); s.value = 40; "
        "s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); })()");
    wait_for("document.documentElement.dataset.reference", "40");
    open_panel("surface");
    check(atof(data("slope")) > 0.9, "slope");
    open_panel("sliding");
    char before[64];
    (void)snprintf(before, sizeof before, "%s", data("mu"));
    check(atof(before) > 0.5, "friction");
    (void)js("(() => { const s = document.querySelector('#slider-sliding-shear-stress'); s.value = "
             "s.max; "
             "s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); })()");
    for (const double end = now() + LIMIT; strcmp(data("mu"), before) == 0;)
        check(now() < end, "friction follows the slider");
    printf("mu %s, with more shear stress %s\n", before, value);
    (void)snprintf(before, sizeof before, "%s", data("mu"));
    (void)js("(() => { const s = document.querySelector('#slider-sliding-reference-velocity'); "
             "s.value = s.min; "
             "s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); })()");
    for (const double end = now() + LIMIT; strcmp(data("mu"), before) == 0;)
        check(now() < end, "friction follows the velocity");
    wait_for(
        "document.querySelector('#sliding .form').textContent.includes('Velocity: 0.0001 m/s')",
        "true");
}

/* Saves a plot as an SVG file of the requested width, without colours of the page. */
static void test_saved_plot(void)
{
    (void)js("(() => { URL.createObjectURL = (blob) => { blob.text().then((text) => { "
             "const svg = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement; "
             "document.documentElement.dataset.saved = [svg.localName, svg.getAttribute('width'), "
             "svg.textContent.includes('velocity (m/s)'), text.includes('#0b4f8a'), "
             "text.includes('var(')].join(' '); }); "
             "return 'data:,'; }; "
             "document.querySelector('#sliding .saving button').click(); })()");
    wait_for("document.documentElement.dataset.saved", "svg 85mm true true false");
}

/* Drops a file of the work folder on the panel Start. */
static void drop_file(const char *name)
{
    static const char *const types[] = {"dragEnter", "dragOver", "drop"};
    char path[PATH_MAX], parameters[PATH_MAX + 256];
    check(realpath(name, path) != NULL, name);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        (void)snprintf(parameters, sizeof parameters,
                       "\"type\":\"%s\",\"x\":300,\"y\":300,\"data\":{\"items\":[],\"files\":"
                       "[\"%s\"],\"dragOperationsMask\":1}",
                       types[i], path);
        call("Input.dispatchDragEvent", parameters);
        (void)usleep(300000); /* the page has to accept the drag before the drop */
    }
}

/* A folder of data: the page adds a file, writes a case, names missing inputs, runs the case and
 * shows the result. */
static void test_new_case(const char *program)
{
    char address[256];
    shell("mkdir new && cp bulk-1.jpk-force-map dma.txt new && mkdir outside && "
          "cp track-1.jpk-force-map outside");
    check(chdir("new") == 0, "new");
    start_server(program, ".", address, sizeof address);
    open_page(address);
    wait_for("document.documentElement.dataset.shown", "start");
    wait_for("document.querySelectorAll('#start details').length", "2");
    drop_file("../outside/track-1.jpk-force-map");
    wait_for("document.querySelectorAll('#start details').length", "3");
    shell("cmp track-1.jpk-force-map ../outside/track-1.jpk-force-map");
    check(strcmp(data("error"), "undefined") == 0, "a dropped file");
    drop_file("../outside/track-1.jpk-force-map"); /* No file is replaced. */
    wait_for("document.querySelector('#fault').textContent.includes('has a file of this name')",
             "true");
    (void)js("delete document.documentElement.dataset.error");
    click("#start button.main");
    wait_for("document.documentElement.dataset.missing", "1");
    (void)js(
        "(() => { const i = document.querySelector('#gap-0'); "
        "i.value = 'pyramid:half-angle=20deg,radius=20nm'; i.dispatchEvent(new Event('change')); "
        "})()");
    wait_for("document.documentElement.dataset.missing", "0");
    click("#run"); /* saves the case first */
    wait_for("document.documentElement.dataset.runs", "2");
    wait_for("document.documentElement.dataset.changed", "false");
    open_panel("answer");
    wait_for("document.querySelector('iframe').contentDocument.body.textContent.includes("
             "'Is the track different?')",
             "true");
    check(strcmp(data("error"), "undefined") == 0, "an error of the page");
    shell("test -s case.h5 && test -s case-report/index.html");
    (void)kill(server, SIGTERM);
    (void)end_of(server);
    check(chdir("..") == 0, "..");
}

/* A result without a case: its curves are shown, and what is excluded is for indent. */
static void test_result_without_case(const char *program)
{
    char address[256];
    char command[4096];
    (void)snprintf(command, sizeof command,
                   "mkdir alone && '%s' indent -q --tip pyramid:half-angle=20deg,radius=20nm "
                   "--spring-constant 0.3N/m --curves all bulk-1.jpk-force-map -o alone/curves.h5",
                   program);
    shell(command);
    start_server(program, "alone/curves.h5", address, sizeof address);
    open_page(address);
    wait_for("document.documentElement.dataset.shown", "start");
    open_panel("curves");
    wait_for("document.documentElement.dataset.curves", "12");
    wait_for("document.documentElement.dataset.modulus > 1e6", "true");
    wait_for("document.querySelector('#curves').textContent.includes('as in the result')", "true");
    click("#curves input[type=checkbox]");
    wait_for("document.documentElement.dataset.overrides", "1");
    check(strcmp(data("error"), "undefined") == 0, "an error of the page");
    (void)snprintf(command, sizeof command,
                   "'%s' indent --tip pyramid:half-angle=20deg,radius=20nm --spring-constant "
                   "0.3N/m --overrides alone/overrides.tsv bulk-1.jpk-force-map -o alone/again.h5 "
                   "2>&1 | grep -q 'left out by hand'",
                   program);
    shell(command);
    (void)kill(server, SIGTERM);
    (void)end_of(server);
}

/* A page of another origin is refused and changes nothing. */
static void test_other_origin(const char *address)
{
    char expression[1024];
    open_page("data:text/html,other");
    (void)snprintf(expression, sizeof expression,
                   "await fetch('%sstate').then(() => 'read', () => 'refused')", address);
    check(strcmp(js(expression), "refused") == 0, "another origin reads");
    (void)snprintf(
        expression, sizeof expression,
        "await fetch('%ssave?name=overrides.tsv&was=', {method: 'POST', mode: 'no-cors', body: "
        "'x'}).then(() => 'sent', "
        "() => 'refused')",
        address);
    (void)js(expression);
    shell("grep -q contact-point overrides.tsv");
}

int main(int argc, char **argv)
{
    char address[256], command[8192];
    message = calloc(1, MESSAGE_SIZE);
    if (argc != 4 || message == NULL)
        return 2;
    if (!has_chromium()) {
        puts("skipped: no chromium");
        return SKIPPED;
    }
    /* one more force map, whose name is markup */
    (void)snprintf(
        command, sizeof command,
        "rm -rf '%s' && mkdir -p '%s' && cp '%s'/case/* '%s' && cd '%s' && rm -f truth.txt && "
        "cp bulk-4.jpk-force-map '<img src=x onerror=hacked=1>.jpk-force-map' && "
        "sed -i 's/bulk-4.jpk-force-map/\\&lt;img src=x onerror=hacked=1\\&gt;.jpk-force-map/' "
        "case.xml",
        argv[3], argv[3], argv[2], argv[3], argv[3]);
    shell(command);
    check(chdir(argv[3]) == 0, argv[3]);
    start_server(argv[1], ".", address, sizeof address);
    start_browser();
    open_page(address);
    wait_for("document.documentElement.dataset.opened > 0", "true");
    wait_for("document.documentElement.dataset.shown", "start");
    printf("opened in %s ms\n", data("opened"));
    wait_for("document.querySelectorAll('#start details').length", "13");
    wait_for("[...document.querySelectorAll('#start details summary')].every((s) => "
             "s.querySelector('b'))",
             "true");
    check(strcmp(js("document.querySelector('#start').textContent.includes('<img src=x')"),
                 "true") == 0,
          "a name with markup is text");
    check(strcmp(js("typeof hacked"), "undefined") == 0, "a name with markup runs");
    open_panel("answer");
    test_curves();
    test_shell(argv[1]);
    test_hand_shift(argv[1]);
    test_sliders();
    test_saved_plot();
    check(strcmp(data("error"), "undefined") == 0, "an error of the page");
    test_other_origin(address);
    (void)kill(server, SIGTERM);
    (void)end_of(server);
    test_new_case(argv[1]);
    test_result_without_case(argv[1]);
    (void)kill(browser, SIGTERM);
    (void)end_of(browser);
    free(message);
    return 0;
}
