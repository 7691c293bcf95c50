/* Runs a fuzz target without a fuzzer: each seed unchanged, then with a fixed set of
 * pseudo-random changes. Arguments are files and folders of seeds; no argument is one empty
 * seed. An error ends the program; the file WT_FUZZ_LAST then holds the input.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <dirent.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define MAX_SEED ((size_t)1 << 20)
#define TRUNCATIONS 64
#define CHANGES 400

typedef struct run {
    const char *last; /* file for the last input, or NULL */
    double start;
    uint64_t state; /* state of the generator */
    size_t n;
} run;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* SplitMix64 (Steele, Lea, Flood 2014). */
static uint64_t draw(run *r)
{
    uint64_t z = r->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static size_t below(run *r, size_t n)
{
    return n == 0 ? 0 : (size_t)(draw(r) % n);
}

/* The buffer has the exact size, so that a sanitizer detects a read of one byte too many. */
static void try_bytes(run *r, const uint8_t *bytes, size_t n)
{
    uint8_t *exact = malloc(n > 0 ? n : 1);
    if (exact == NULL)
        abort();
    if (n > 0)
        memcpy(exact, bytes, n);
    if (r->last != NULL) {
        FILE *out = fopen(r->last, "wb");
        if (out != NULL) {
            fwrite(exact, 1, n, out);
            fclose(out);
        }
    }
    LLVMFuzzerTestOneInput(exact, n);
    free(exact);
    r->n++;
}

static void change(run *r, uint8_t *bytes, size_t n)
{
    static const uint8_t tempting[] = {0, 1, 0x7f, 0x80, 0xff, '-', '9', '.', '=', '\n', '[', '#'};
    size_t times = 1 + below(r, 4);
    for (size_t i = 0; i < times && n > 0; i++) {
        size_t at = below(r, n);
        switch (below(r, 4)) {
        case 0:
            bytes[at] ^= (uint8_t)(1u << below(r, 8));
            break;
        case 1:
            bytes[at] = tempting[below(r, sizeof tempting)];
            break;
        case 2:
            bytes[at] = (uint8_t)(draw(r) & 0xff);
            break;
        default: {
            size_t from = below(r, n), length = 1 + below(r, 16);
            size_t room = n - (from > at ? from : at);
            memmove(bytes + at, bytes + from, length < room ? length : room);
            break;
        }
        }
    }
}

static bool has_time_left(const run *r)
{
    return now() - r->start < SECONDS_PER_PROGRAM;
}

static void try_seed(run *r, const uint8_t *seed, size_t n)
{
    uint8_t *copy = malloc(n > 0 ? n : 1);
    if (copy == NULL)
        abort();
    try_bytes(r, seed, n);
    for (size_t i = 0; i < TRUNCATIONS && i < n && has_time_left(r); i++)
        try_bytes(r, seed, n * i / TRUNCATIONS);
    for (size_t i = 0; i < CHANGES && n > 0 && has_time_left(r); i++) {
        memcpy(copy, seed, n);
        change(r, copy, n);
        try_bytes(r, copy, n);
    }
    free(copy);
}

static int try_file(run *r, const char *path)
{
    static uint8_t seed[MAX_SEED];
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        perror(path);
        return 1;
    }
    size_t n = fread(seed, 1, sizeof seed, in);
    int bad = ferror(in);
    fclose(in);
    if (bad == 0)
        try_seed(r, seed, n);
    return bad != 0;
}

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static int try_path(run *r, const char *path)
{
    struct dirent **entries = NULL;
    int n = scandir(path, &entries, is_visible, alphasort);
    if (n < 0)
        return try_file(r, path);
    int bad = 0;
    for (int i = 0; i < n; i++) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%s", path, entries[i]->d_name);
        bad |= try_file(r, name);
        free(entries[i]);
    }
    free(entries);
    return bad;
}

int main(int argc, char *argv[])
{
    run r = {.last = getenv("WT_FUZZ_LAST"), .start = now(), .state = 20300101};
    int bad = 0;
    if (argc < 2)
        try_seed(&r, (const uint8_t *)"", 0);
    for (int i = 1; i < argc; i++)
        bad |= try_path(&r, argv[i]);
    printf("%zu inputs in %.1f s\n", r.n, now() - r.start);
    return bad;
}
