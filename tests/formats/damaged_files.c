/* Structured damage, drawn by a seed: fields changed, blocks deleted, doubled, swapped or set to
 * zero, rows swapped, text for numbers; in an archive that of one entry, packed anew with its check
 * sum. Each file is read in a process of its own: none may crash or take more than ten seconds.
 * What came of each kind of damage is counted, and those where numbers changed without a word are
 * named. Of the kinds named by the word "refuse" none may be read with other numbers and without a
 * word.
 *
 *   damaged_files SEED TRIALS [-v] [refuse=KIND,KIND...] FILE...
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "../fuzz/pack_list.h"
#include "read_numbers.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zip.h>

enum { SECONDS = 10, ENTRIES_MAX = 256 };

typedef enum damage {
    FIELD,      /* a whole number of 2, 4 or 8 bytes, or the digits of one in text */
    TEXT,       /* letters for digits */
    DELETED,    /* bytes, or lines of a text */
    DOUBLED,    /* the same */
    SWAPPED,    /* two blocks, or two lines */
    ZEROED,     /* bytes, or the cells of a line made empty */
    ENTRY_GONE, /* of an archive, or the second half of another file */
    N_DAMAGES
} damage;
static const char *const damage_names[] = {"field",   "text",   "deleted", "doubled",
                                           "swapped", "zeroed", "entry"};

typedef enum outcome { REFUSED, WARNED, SAME, CHANGED, CRASHED, TOO_LONG, N_OUTCOMES } outcome;
static const char *const outcome_names[] = {"refused", "warned",  "same numbers",
                                            "changed", "crashed", "too long"};

typedef struct bytes {
    unsigned char *at;
    size_t n;
} bytes;

typedef struct entry {
    char name[256];
    bytes content;
} entry;

typedef struct file {
    bytes whole;
    bool text;
    entry *entries; /* of an archive */
    size_t n_entries;
    numbers values;
    wt_parselog *log;
} file;

/* ---- archives -------------------------------------------------------------------------------- */

static bytes pack(const entry *entries, size_t n)
{
    size_t room = 0;
    for (size_t i = 0; i < n; i++)
        room += 30 + strlen(entries[i].name) + entries[i].content.n;
    bytes packed = {malloc(room + 1), 0};
    if (packed.at == NULL)
        abort();
    uint8_t *to = packed.at;
    for (size_t i = 0; i < n; i++)
        to = put_entry(to, (const uint8_t *)entries[i].name, strlen(entries[i].name),
                       entries[i].content.at, entries[i].content.n);
    packed.n = (size_t)(to - packed.at);
    return packed;
}

static void unpack(file *f)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *const source = zip_source_buffer_create(f->whole.at, f->whole.n, 0, &error);
    zip_t *const zip = source != NULL ? zip_open_from_source(source, ZIP_RDONLY, &error) : NULL;
    const zip_int64_t n = zip != NULL ? zip_get_num_entries(zip, 0) : 0;
    f->entries = calloc(ENTRIES_MAX, sizeof *f->entries);
    for (zip_int64_t i = 0; f->entries != NULL && i < n && f->n_entries < ENTRIES_MAX; i++) {
        zip_stat_t stat;
        zip_file_t *const in = zip_fopen_index(zip, (zip_uint64_t)i, 0);
        if (in == NULL || zip_stat_index(zip, (zip_uint64_t)i, 0, &stat) != 0)
            continue;
        entry *const e = &f->entries[f->n_entries++];
        (void)snprintf(e->name, sizeof e->name, "%s", stat.name);
        e->content = (bytes){calloc(stat.size + 1, 1), stat.size};
        if (e->content.at == NULL ||
            zip_fread(in, e->content.at, stat.size) != (zip_int64_t)stat.size)
            abort();
        (void)zip_fclose(in);
    }
    if (zip != NULL)
        zip_discard(zip);
    else if (source != NULL)
        zip_source_free(source);
    zip_error_fini(&error);
    if (f->n_entries > 0) { /* as it will be packed, so that the damage is the only difference */
        free(f->whole.at);
        f->whole = pack(f->entries, f->n_entries);
    }
}

/* ---- damage ---------------------------------------------------------------------------------- */

static bool is_text(bytes b)
{
    size_t odd = 0;
    for (size_t i = 0; i < b.n && i < 4096; i++)
        odd += b.at[i] < ' ' && b.at[i] != '\t' && b.at[i] != '\n' && b.at[i] != '\r';
    return b.n > 0 && odd == 0;
}

static bytes copy(bytes b)
{
    bytes c = {malloc(2 * b.n + 64), b.n}; /* room for one block twice */
    if (c.at == NULL)
        abort();
    memcpy(c.at, b.at, b.n);
    return c;
}

/* From where to where the line goes in which the place is; its end belongs to it. */
static void find_line(bytes b, size_t place, size_t *from, size_t *to)
{
    for (*from = place; *from > 0 && b.at[*from - 1] != '\n'; --*from)
        ;
    for (*to = place; *to < b.n && b.at[*to] != '\n'; ++*to)
        ;
    *to += *to < b.n;
}

/* A block: lines of a text, else bytes. Half of them are in the first 4096 bytes, where headers
 * are. */
static void draw_block(bytes b, bool text, uint64_t *seed, size_t *from, size_t *to)
{
    static const size_t sizes[] = {1, 2, 4, 8, 32, 96, 512, 4096};
    const size_t room = draw(seed, 2) == 0 && b.n > 4096 ? 4096 : b.n;
    size_t lines = draw(seed, 4);
    *from = draw(seed, room);
    if (!text) {
        const size_t size = sizes[draw(seed, sizeof sizes / sizeof *sizes)];
        *to = *from + size < b.n ? *from + size : b.n;
        return;
    }
    find_line(b, *from, from, to);
    for (size_t begin = 0; lines > 0 && *to < b.n; lines--)
        find_line(b, *to, &begin, to);
}

static void change_digits(bytes b, uint64_t *seed, bool letters)
{
    size_t from = draw(seed, b.n), looked = 0;
    while (looked++ < b.n && (b.at[from] < '0' || b.at[from] > '9'))
        from = (from + 1) % b.n;
    for (size_t i = from; i < b.n && b.at[i] >= '0' && b.at[i] <= '9'; i++) {
        b.at[i] = letters ? 'x' : (unsigned char)('0' + draw(seed, 10));
        if (draw(seed, 2) == 0)
            break;
    }
}

static void change_field(bytes b, uint64_t *seed)
{
    const size_t width = (size_t)2 << draw(seed, 3),
                 room = b.n > 2048 && draw(seed, 4) > 0 ? 2048 : b.n;
    if (b.n < 8)
        return;
    size_t at = draw(seed, room - 7);
    at -= at % 2;
    uint64_t value = 0;
    memcpy(&value, b.at + at, width);
    const uint64_t values[] = {0,
                               value + 1,
                               value - 1,
                               2 * value,
                               value / 2,
                               ~(uint64_t)0,
                               (uint64_t)1 << (8 * width - 1),
                               value ^ 0x100};
    value = values[draw(seed, sizeof values / sizeof *values)];
    memcpy(b.at + at, &value, width);
}

static void delete (bytes *b, size_t from, size_t to)
{
    memmove(b->at + from, b->at + to, b->n - to);
    b->n -= to - from;
}

static void swap(bytes b, bool text, uint64_t *seed, size_t from, size_t to)
{
    size_t other = 0, end = 0;
    draw_block(b, text, seed, &other, &end);
    if (text && (other >= to || end <= from)) { /* the first line of each */
        const bytes old = copy(b);
        const size_t a = from < other ? from : other, a_end = from < other ? to : end;
        const size_t c = from < other ? other : from, c_end = from < other ? end : to;
        unsigned char *at = b.at + a;
        memcpy(at, old.at + c, c_end - c);
        at += c_end - c;
        memcpy(at, old.at + a_end, c - a_end);
        at += c - a_end;
        memcpy(at, old.at + a, a_end - a);
        free(old.at);
    } else if (!text && (other >= to || end <= from)) {
        for (size_t i = 0; i < to - from && other + i < b.n; i++) {
            const unsigned char kept = b.at[from + i];
            b.at[from + i] = b.at[other + i];
            b.at[other + i] = kept;
        }
    }
}

static void spoil(bytes *b, damage d, uint64_t *seed)
{
    const bool text = is_text(*b);
    size_t from = 0, to = 0;
    if (b->n < 2)
        return;
    draw_block(*b, text, seed, &from, &to);
    if (d == FIELD && !text && draw(seed, 3) > 0) {
        change_field(*b, seed);
    } else if (d == FIELD || d == TEXT) {
        change_digits(*b, seed, d == TEXT);
    } else if (d == DELETED) {
        delete (b, from, to);
    } else if (d == DOUBLED) {
        memmove(b->at + to + (to - from), b->at + to, b->n - to);
        memcpy(b->at + to, b->at + from, to - from);
        b->n += to - from;
    } else if (d == SWAPPED) {
        swap(*b, text, seed, from, to);
    } else {
        for (size_t i = from; i < to; i++)
            if (!text)
                b->at[i] = 0;
            else if (b->at[i] >= '0' && b->at[i] <= '9')
                b->at[i] = ' ';
    }
}

/* The file, damaged. */
static bytes damage_file(const file *f, damage d, uint64_t *seed)
{
    if (f->n_entries == 0) {
        bytes b = copy(f->whole);
        spoil(&b, d == ENTRY_GONE ? DELETED : d, seed);
        return b;
    }
    entry *const entries = calloc(f->n_entries, sizeof *entries);
    if (entries == NULL)
        abort();
    memcpy(entries, f->entries, f->n_entries * sizeof *entries);
    size_t n = f->n_entries;
    const size_t which = draw(seed, n);
    bytes changed = copy(entries[which].content);
    if (d == ENTRY_GONE) {
        memmove(entries + which, entries + which + 1, (n - which - 1) * sizeof *entries);
        n--;
    } else {
        spoil(&changed, d, seed);
        entries[which].content = changed;
    }
    const bytes packed = pack(entries, n);
    free(changed.at);
    free(entries);
    return packed;
}

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

/* Whether a warning of the damaged file is none of the whole one. */
static bool has_news(const wt_parselog *log, const wt_parselog *before)
{
    for (size_t i = 0; i < wt_parselog_count(log); i++) {
        const wt_log_entry e = wt_parselog_get(log, i);
        bool old = e.severity == WT_NOTE;
        for (size_t k = 0; k < wt_parselog_count(before) && !old; k++) {
            const wt_log_entry o = wt_parselog_get(before, k);
            old = strcmp(o.text, e.text) == 0 && o.count == e.count;
        }
        if (!old)
            return true;
    }
    return false;
}

static outcome read_damaged(const wt_formats *formats, const file *f, bytes b)
{
    numbers values = {.n = 0};
    wt_parselog *const log = wt_parselog_new();
    const wt_status status = read_any(formats, b.at, b.n, log, &values);
    outcome o = REFUSED;
    if (status == WT_OK)
        o = has_news(log, f->log) || values.n_failed > f->values.n_failed ? WARNED
            : same_numbers(&values, &f->values)                           ? SAME
                                                                          : CHANGED;
    free(values.values);
    wt_parselog_free(log);
    return o;
}

static outcome try_damage(const wt_formats *formats, const file *f, bytes b)
{
    int status = 0;
    (void)fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit limit = {SECONDS, SECONDS};
        (void)setrlimit(RLIMIT_CPU, &limit);
        (void)alarm(6 * SECONDS); /* a machine that is busy */
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

/* ---- the call -------------------------------------------------------------------------------- */

typedef struct call {
    uint64_t seed;
    size_t trials;
    bool verbose;
    const char *refuse, *folder;
    wt_formats *formats;
    size_t counts[N_DAMAGES][N_OUTCOMES], failures;
} call;

static void load(const wt_formats *formats, const char *path, file *f)
{
    *f = (file){.log = wt_parselog_new()};
    f->whole.at = load_bytes(path, &f->whole.n);
    if (f->whole.n > 4 && memcmp(f->whole.at, "PK\3\4", 4) == 0)
        unpack(f);
    if (f->whole.n == 0 || read_any(formats, f->whole.at, f->whole.n, f->log, &f->values) != WT_OK)
        f->whole.n = 0;
}

static void release(file *f)
{
    for (size_t i = 0; i < f->n_entries; i++)
        free(f->entries[i].content.at);
    free(f->entries);
    free(f->whole.at);
    free(f->values.values);
    wt_parselog_free(f->log);
}

/* One damage by the number of the trial. */
static bytes draw_damage(const call *c, const file *f, size_t trial, damage *d)
{
    uint64_t seed = 88172645463325252u + 1000003 * c->seed + 7919 * trial;
    (void)draw(&seed, 2);
    *d = (damage)(trial % N_DAMAGES);
    return damage_file(f, *d, &seed);
}

static void write_file(const char *path, bytes b)
{
    FILE *const out = fopen(path, "wb");
    if (out == NULL || fwrite(b.at, 1, b.n, out) != b.n || fclose(out) != 0)
        abort();
}

/* FOLDER/NUMBER-KIND-NAME, so that a reader that goes by the name finds it. */
static void write_damaged(call *c, const char *path)
{
    const char *const slash = strrchr(path, '/');
    file f;
    load(c->formats, path, &f);
    for (size_t i = 0; i < c->trials && f.whole.n > 0; i++) {
        char name[1024];
        damage d = FIELD;
        const bytes b = draw_damage(c, &f, i, &d);
        (void)snprintf(name, sizeof name, "%s/%03zu-%s-%s", c->folder, i, damage_names[d],
                       slash != NULL ? slash + 1 : path);
        write_file(name, b);
        free(b.at);
    }
    c->failures += f.whole.n == 0;
    release(&f);
}

static void try_file(call *c, const char *path)
{
    file f;
    size_t counts[N_OUTCOMES] = {0};
    load(c->formats, path, &f);
    for (size_t i = 0; i < c->trials && f.whole.n > 0; i++) {
        damage d = FIELD;
        const bytes b = draw_damage(c, &f, i, &d);
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
    printf("%s\n", f.whole.n == 0 ? " (not read at all)" : "");
    release(&f);
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
