/* Structured damage (damage.h) of files that the library reads. Each file is read in its own
 * process, which may not crash or take more than ten seconds.
 *
 * The program counts the outcomes for each kind of damage and lists the files whose numbers
 * changed without a warning. For the kinds after "refuse" such a file is a failure. With a
 * folder the program only writes the files: FOLDER/whole-NAME is the undamaged file, packed as
 * the damaged ones are, and FOLDER/NUMBER-KIND-NAME a damaged one.
 *
 * damaged_files SEED TRIALS [-v] [refuse=KIND,KIND...] [write=FOLDER] FILE...
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "damage.h"
#include "read_numbers.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SECONDS = 10 };

typedef enum outcome { REFUSED, WARNED, SAME, CHANGED, CRASHED, TOO_LONG, N_OUTCOMES } outcome;
static const char *const outcome_names[] = {"refused", "warned",  "same numbers",
                                            "changed", "crashed", "too long"};

typedef struct file {
    damageable bytes;
    numbers values;
    wt_log *log;
} file;

/* ---- reading --------------------------------------------------------------------------------- */

static bool same_numbers(const numbers *a, const numbers *b)
{
    if (a->n != b->n)
        return false;
    for (size_t i = 0; i < a->n; i++)
        if (memcmp(&a->values[i], &b->values[i], sizeof(double)) != 0 &&
            !(isnan(a->values[i]) && isnan(b->values[i])))
            return false;
    return true;
}

/* Returns true if the damaged file has a warning that the whole one lacks. */
static bool has_new_warning(const wt_log *log, const wt_log *before)
{
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry e = wt_log_get(log, i);
        bool old = e.severity == WT_NOTE;
        for (size_t k = 0; k < wt_log_count(before) && !old; k++) {
            const wt_log_entry o = wt_log_get(before, k);
            old = strcmp(o.text, e.text) == 0 && o.count == e.count;
        }
        if (!old)
            return true;
    }
    return false;
}

static outcome read_damaged(const wt_formats *formats, const file *f, byte_block b)
{
    numbers values = {.n = 0};
    wt_log *const log = wt_log_new();
    const wt_status status = read_any(formats, b.at, b.n, log, &values);
    outcome o = REFUSED;
    if (status == WT_OK)
        o = has_new_warning(log, f->log) || values.n_failed > f->values.n_failed ? WARNED
            : same_numbers(&values, &f->values)                                  ? SAME
                                                                                 : CHANGED;
    free(values.values);
    wt_log_free(log);
    return o;
}

static outcome try_damage(const wt_formats *formats, const file *f, byte_block b)
{
    int status = 0;
    (void)fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit limit = {SECONDS, SECONDS};
        (void)setrlimit(RLIMIT_CPU, &limit);
        (void)alarm(6 * SECONDS); /* The limit allows for a busy machine. */
        _exit((int)read_damaged(formats, f, b));
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
        abort();
    if (WIFEXITED(status) && WEXITSTATUS(status) < CRASHED)
        return (outcome)WEXITSTATUS(status);
    return WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM ||
                                   WTERMSIG(status) == SIGKILL)
               ? TOO_LONG
               : CRASHED;
}

/* ---- options and report ---------------------------------------------------------------------- */

typedef struct call {
    uint64_t seed;
    size_t trials;
    bool verbose;
    const char *refuse, *folder;
    wt_formats *formats;
    size_t counts[N_DAMAGES][N_OUTCOMES], failures;
} call;

static bool load(const wt_formats *formats, const char *path, file *f)
{
    *f = (file){.bytes = damageable_load(path), .log = wt_log_new()};
    return f->bytes.whole.n > 0 &&
           read_any(formats, f->bytes.whole.at, f->bytes.whole.n, f->log, &f->values) == WT_OK;
}

static void free_file(file *f)
{
    damageable_free(&f->bytes);
    free(f->values.values);
    wt_log_free(f->log);
}

static void write_file(const char *path, byte_block b)
{
    FILE *const out = fopen(path, "wb");
    if (out == NULL || fwrite(b.at, 1, b.n, out) != b.n || fclose(out) != 0)
        abort();
}

/* The name ends as before, for a reader that uses the file extension. */
static void write_damaged(call *c, const char *path)
{
    const char *const slash = strrchr(path, '/'), *const own = slash != NULL ? slash + 1 : path;
    char name[1024];
    file f;
    const bool read = load(c->formats, path, &f);
    for (size_t i = 0; i < c->trials && read; i++) {
        damage d = FIELD;
        const byte_block b = damage_draw(&f.bytes, c->seed, i, &d);
        (void)snprintf(name, sizeof name, "%s/%03zu-%s-%s", c->folder, i, damage_names[d], own);
        write_file(name, b);
        free(b.at);
    }
    (void)snprintf(name, sizeof name, "%s/whole-%s", c->folder, own);
    write_file(name, f.bytes.whole);
    c->failures += !read;
    free_file(&f);
}

static void try_file(call *c, const char *path)
{
    file f;
    size_t counts[N_OUTCOMES] = {0};
    const bool read = load(c->formats, path, &f);
    for (size_t i = 0; i < c->trials && read; i++) {
        damage d = FIELD;
        const byte_block b = damage_draw(&f.bytes, c->seed, i, &d);
        const outcome o = try_damage(c->formats, &f, b);
        const bool bad = o >= CRASHED || (o == CHANGED && c->refuse != NULL &&
                                          strstr(c->refuse, damage_names[d]) != NULL);
        counts[o]++;
        c->counts[d][o]++;
        c->failures += bad;
        if (bad || (o == CHANGED && c->verbose)) {
            char name[64];
            (void)snprintf(name, sizeof name, "damaged-%zu-%zu", (size_t)c->seed, i);
            printf("%s: %s %zu: %s\n", path, damage_names[d], i, outcome_names[o]);
            if (c->verbose)
                write_file(name, b);
        }
        free(b.at);
    }
    printf("%-60.60s", strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path);
    for (size_t o = 0; o < N_OUTCOMES; o++)
        printf(" %4zu %s", counts[o], outcome_names[o]);
    printf("%s\n", !read ? " (not read at all)" : "");
    free_file(&f);
}

int main(int argc, char **argv)
{
    call c = {.trials = 0};
    if (argc < 4 || wt_formats_new(NULL, &c.formats, NULL, NULL) != WT_OK)
        return 2;
    c.seed = strtoull(argv[1], NULL, 10);
    c.trials = strtoull(argv[2], NULL, 10);
    for (int i = 3; i < argc; i++) {
        if (strcmp(argv[i], "-v") == 0)
            c.verbose = true;
        else if (strncmp(argv[i], "refuse=", 7) == 0)
            c.refuse = argv[i];
        else if (strncmp(argv[i], "write=", 6) == 0)
            c.folder = argv[i] + 6;
        else if (c.folder != NULL)
            write_damaged(&c, argv[i]);
        else
            try_file(&c, argv[i]);
    }
    for (size_t d = 0; d < N_DAMAGES && c.folder == NULL; d++) {
        printf("%-10s", damage_names[d]);
        for (size_t o = 0; o < N_OUTCOMES; o++)
            printf(" %5zu %s", c.counts[d][o], outcome_names[o]);
        printf("\n");
    }
    wt_formats_free(c.formats);
    return c.failures > 0;
}
