/* Text files truncated at positions that a seed draws. Each is refused, or read with a warning,
 * and no number is read that the whole file lacks. Exceptions are the last number of a row that
 * is kept with a warning, and the start of a curve. A truncation after a line end cannot be
 * detected if the format has neither a count nor an end mark; the program prints their number.
 *
 * truncated_files SEED CUTS FILE...
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_numbers.h"

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool has_warning(const wt_log *log, const char *words)
{
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry e = wt_log_get(log, i);
        if (e.severity != WT_NOTE && strstr(e.text, words) != NULL)
            return true;
    }
    return false;
}

typedef struct file {
    const char *path;
    char *bytes;
    size_t n;
    numbers whole;
    bool read;
} file;

static void load(const wt_formats *formats, const char *path, file *f)
{
    *f = (file){.path = path};
    f->bytes = (char *)load_bytes(path, &f->n);
    if (f->bytes == NULL)
        return;
    wt_log *const log = wt_log_new();
    f->read = read_any(formats, f->bytes, f->n, log, &f->whole) == WT_OK && f->n > 2;
    if (f->read && has_warning(log, "no line end")) {
        fprintf(stderr, "%s: the whole file is said to be cut\n", path);
        exit(1);
    }
    wt_log_free(log);
    if (f->whole.n > 0)
        qsort(f->whole.values, f->whole.n, sizeof(double), by_value);
}

/* Returns the number of values that the whole file does not have. */
static size_t count_new_numbers(const file *f, const numbers *some)
{
    size_t strange = 0;
    for (size_t i = 0; i < some->n; i++)
        strange += !isnan(some->values[i]) && bsearch(&some->values[i], f->whole.values, f->whole.n,
                                                      sizeof(double), by_value) == NULL;
    return strange;
}

static bool is_after_line_end(const file *f, size_t cut)
{
    const char *const end = f->bytes + cut;
    return end[-1] == '\n' || (end[-1] == '\r' && *end != '\n') ||
           (cut > 1 && end[-1] == '\0' && end[-2] == '\n') ||
           (cut > 1 && end[-1] == '\n' && !end[-2]);
}

typedef struct tally {
    size_t refused, kept, dropped, counted, at_line, failures;
} tally;

static void try_cut(const wt_formats *formats, const file *f, size_t cut, tally *t)
{
    wt_log *const log = wt_log_new();
    numbers some = {.n = 0};
    char *const bytes = malloc(cut);
    if (bytes == NULL)
        abort();
    memcpy(bytes, f->bytes, cut);
    const wt_status status = read_any(formats, bytes, cut, log, &some);
    const bool kept = has_warning(log, "no line end: if") || has_warning(log, "half a line end");
    const bool dropped =
        has_warning(log, "no whole row") || has_warning(log, "fewer cells than all");
    const bool counted = has_warning(log, "rows, but only") ||
                         has_warning(log, "that ends a table") || has_warning(log, "the ramp ends");
    const size_t strange = status == WT_OK ? count_new_numbers(f, &some) : 0;
    if (status != WT_OK)
        t->refused++;
    else if (dropped)
        t->dropped++;
    else if (kept)
        t->kept++;
    else if (counted)
        t->counted++;
    else if (is_after_line_end(f, cut))
        t->at_line++;
    else
        t->failures++;
    /* The last number of a kept row may have lost decimals, which changes the values derived
     * from it. */
    const bool wrong = strange > 0 && !((kept || counted) && strange <= 2);
    t->failures += wrong;
    if (wrong || (status == WT_OK && !dropped && !kept && !counted && !is_after_line_end(f, cut)))
        fprintf(stderr, "%s: cut at byte %zu of %zu: %zu numbers that it does not have, %s\n",
                f->path, cut, f->n, strange, wrong ? "wrong" : "no word of the cut");
    free(bytes);
    free(some.values);
    wt_log_free(log);
}

int main(int argc, char **argv)
{
    wt_formats *formats = NULL;
    if (argc < 4 || wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
        return 2;
    const size_t n_files = (size_t)argc - 3;
    const long n_cuts = atol(argv[2]);
    uint64_t state = 88172645463325252u + strtoull(argv[1], NULL, 10);
    file *const files = calloc(n_files, sizeof *files);
    tally t = {0};
    size_t n_read = 0;
    for (size_t i = 0; files != NULL && i < n_files; i++) {
        load(formats, argv[i + 3], &files[i]);
        n_read += files[i].read;
    }
    for (long i = 0; i < n_cuts && n_read > 0;) {
        const file *const f = &files[draw(&state, n_files)];
        if (!f->read)
            continue;
        try_cut(formats, f, 1 + draw(&state, f->n - 2), &t);
        i++;
    }
    printf("%zu files, %ld cuts: %zu refused, %zu with the last row left out, %zu with a warning, "
           "%zu by count or end mark, %zu behind a line end and not known, %zu failures\n",
           n_read, n_cuts, t.refused, t.dropped, t.kept, t.counted, t.at_line, t.failures);
    for (size_t i = 0; files != NULL && i < n_files; i++) {
        free(files[i].bytes);
        free(files[i].whole.values);
    }
    free(files);
    wt_formats_free(formats);
    return t.failures > 0 || n_read == 0 || t.dropped == 0 || t.kept == 0;
}
