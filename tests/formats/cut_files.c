/* Text files that were cut off, at places drawn by a seed: every one is refused, or read with a
 * warning that says so, and no number is read that the whole file does not have, but for the last
 * one of a row that was kept with a warning, and where a curve then begins. A cut behind a line end
 * cannot be known where the format has neither a count nor an end mark; how many there were is
 * printed.
 *
 *   cut_files SEED CUTS FILE...
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/read.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct numbers {
    double *values;
    size_t n, room;
} numbers;

static void keep(numbers *all, const double *values, size_t n)
{
    for (size_t i = 0; values != NULL && i < n; i++) {
        if (all->n == all->room) {
            all->room = 2 * all->room + 1024;
            all->values = realloc(all->values, all->room * sizeof *all->values);
            if (all->values == NULL)
                abort();
        }
        all->values[all->n++] = values[i];
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static wt_status read_curves(const wt_formats *formats, wt_input *input, wt_parselog *log,
                             numbers *all)
{
    const wt_read_options options = wt_read_defaults();
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_status status = wt_force_open(formats, input, &options, log, &source, NULL);
    while (status == WT_OK) {
        status = wt_force_next(source, &curve, NULL);
        for (size_t s = 0; status == WT_OK && s < curve.n_segments; s++)
            for (size_t c = 0; c < curve.segments[s].n_channels; c++)
                keep(all, curve.segments[s].channels[c].values, curve.segments[s].n_points);
    }
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    return status == WT_END ? WT_OK : status;
}

static wt_status read_sweep(const wt_formats *formats, wt_input *input, wt_parselog *log,
                            numbers *all)
{
    wt_read_options options = wt_read_defaults();
    options.any_temperature = true;
    wt_sweep sweep = {.n_isotherms = 0};
    const wt_status status = wt_sweep_read(formats, input, &options, log, &sweep, NULL);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        const wt_isotherm *const t = &sweep.isotherms[i];
        keep(all, t->angular_frequency, t->n);
        keep(all, t->storage_modulus, t->n);
        keep(all, t->loss_modulus, t->n);
    }
    wt_sweep_clear(&sweep);
    return status;
}

static wt_status read_spectra(const wt_formats *formats, wt_input *input, unsigned kind,
                              wt_parselog *log, numbers *all)
{
    const wt_read_options options = wt_read_defaults();
    wt_power_spectrum spectrum = {.n = 0};
    wt_noise_spectrum noise = {.n = 0};
    wt_status status = WT_OK;
    if (kind == WT_KIND_NOISE)
        status = wt_noise_read(formats, input, &options, log, &noise, NULL);
    else
        status = wt_power_spectrum_read(formats, input, &options, log, &spectrum, NULL);
    keep(all, noise.frequency, noise.n);
    keep(all, spectrum.wavenumber, spectrum.n);
    wt_power_spectrum_clear(&spectrum);
    wt_noise_spectrum_clear(&noise);
    return status;
}

/* Reads the bytes as the first kind that they are; WT_E_FORMAT if they are none. */
static wt_status read_any(const wt_formats *formats, const char *bytes, size_t n, wt_parselog *log,
                          numbers *all)
{
    static const unsigned kinds[] = {WT_KIND_FORCE, WT_KIND_SWEEP, WT_KIND_SPECTRUM, WT_KIND_NOISE};
    wt_status status = WT_E_FORMAT;
    for (size_t k = 0; k < 4 && status != WT_OK; k++) {
        wt_input *input = NULL;
        if (wt_input_open_memory(bytes, n, "cut", &input, NULL) != WT_OK)
            abort();
        all->n = 0;
        if (kinds[k] == WT_KIND_FORCE)
            status = read_curves(formats, input, log, all);
        else if (kinds[k] == WT_KIND_SWEEP)
            status = read_sweep(formats, input, log, all);
        else
            status = read_spectra(formats, input, kinds[k], log, all);
        wt_input_close(input);
    }
    return status;
}

static bool says(const wt_parselog *log, const char *words)
{
    for (size_t i = 0; i < wt_parselog_count(log); i++) {
        const wt_log_entry e = wt_parselog_get(log, i);
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
    FILE *const in = fopen(path, "rb");
    if (in == NULL)
        return;
    (void)fseek(in, 0, SEEK_END);
    f->n = (size_t)ftell(in);
    rewind(in);
    f->bytes = malloc(f->n + 1);
    if (f->bytes == NULL || fread(f->bytes, 1, f->n, in) != f->n)
        abort();
    (void)fclose(in);
    wt_parselog *const log = wt_parselog_new();
    f->read = read_any(formats, f->bytes, f->n, log, &f->whole) == WT_OK && f->n > 2;
    if (f->read && says(log, "no line end")) {
        fprintf(stderr, "%s: the whole file is said to be cut\n", path);
        exit(1);
    }
    wt_parselog_free(log);
    if (f->whole.n > 0)
        qsort(f->whole.values, f->whole.n, sizeof(double), by_value);
}

/* Numbers that the whole file does not have. */
static size_t count_strange(const file *f, const numbers *some)
{
    size_t strange = 0;
    for (size_t i = 0; i < some->n; i++)
        strange += !isnan(some->values[i]) && bsearch(&some->values[i], f->whole.values, f->whole.n,
                                                      sizeof(double), by_value) == NULL;
    return strange;
}

static bool behind_line(const file *f, size_t cut)
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
    wt_parselog *const log = wt_parselog_new();
    numbers some = {.n = 0};
    char *const bytes = malloc(cut);
    if (bytes == NULL)
        abort();
    memcpy(bytes, f->bytes, cut);
    const wt_status status = read_any(formats, bytes, cut, log, &some);
    const bool kept = says(log, "no line end: if") || says(log, "half a line end");
    const bool dropped = says(log, "no whole row") || says(log, "fewer cells than all");
    const bool counted =
        says(log, "rows, but only") || says(log, "that ends a table") || says(log, "the ramp ends");
    const size_t strange = status == WT_OK ? count_strange(f, &some) : 0;
    if (status != WT_OK)
        t->refused++;
    else if (dropped)
        t->dropped++;
    else if (kept)
        t->kept++;
    else if (counted)
        t->counted++;
    else if (behind_line(f, cut))
        t->at_line++;
    else
        t->failures++;
    /* Of a row that was kept the last number may have lost decimals, and what follows from it. */
    const bool wrong = strange > 0 && !((kept || counted) && strange <= 2);
    t->failures += wrong;
    if (wrong || (status == WT_OK && !dropped && !kept && !counted && !behind_line(f, cut)))
        fprintf(stderr, "%s: cut at byte %zu of %zu: %zu numbers that it does not have, %s\n",
                f->path, cut, f->n, strange, wrong ? "wrong" : "no word of the cut");
    free(bytes);
    free(some.values);
    wt_parselog_free(log);
}

/* xorshift64* */
static size_t draw(uint64_t *state, size_t n)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (size_t)((*state * 2685821657736338717u) >> 11) % n;
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
