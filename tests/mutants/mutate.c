/* Changes one position of the source, and draws positions to change.
 *   mutate check ROOT LIST           checks that every position of the list is found once
 *   mutate lines LIST                prints a line for each record, separated by tabs: file,
 *                                    function, find, put, tests, equivalent, slow
 *   mutate apply ROOT LIST N         applies change N (from 1) to the file under ROOT
 *   mutate draw ROOT SEED N FILE...  draws N changes and prints them as a list: first a function,
 *                                    then a position in it, then a change
 * The head of the list describes a record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "places.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 1024 };

typedef struct record {
    char file[TEXT], in[TEXT], find[TEXT], put[TEXT], tests[TEXT], equivalent[TEXT], slow[TEXT];
    size_t line;
} record;

/* ---- the list -------------------------------------------------------------------------------- */

static void fail_at(const char *path, size_t line, const char *what)
{
    fprintf(stderr, "%s:%zu: %s\n", path, line, what);
    exit(2);
}

/* Each line is a key and its text; a blank line ends a record, '#' starts a comment. */
static bool next_record(FILE *in, const char *path, size_t *line, record *r)
{
    char text[TEXT];
    bool any = false;
    *r = (record){.in = "-"};
    while (fgets(text, sizeof text, in) != NULL) {
        ++*line;
        text[strcspn(text, "\n")] = '\0';
        if (text[0] == '#')
            continue;
        if (text[0] == '\0' && any)
            break;
        if (text[0] == '\0')
            continue;
        if (!any)
            r->line = *line;
        any = true;
        const struct {
            const char *word;
            char *to;
        } fields[] = {{"file", r->file}, {"in", r->in},       {"find", r->find},
                      {"put", r->put},   {"tests", r->tests}, {"equivalent", r->equivalent},
                      {"slow", r->slow}};
        enum { N = sizeof fields / sizeof *fields };
        size_t n = strcspn(text, " "), i = 0;
        while (i < N && (strlen(fields[i].word) != n || strncmp(text, fields[i].word, n) != 0))
            i++;
        if (i == N)
            fail_at(path, *line, "not one of file, in, find, put, tests, equivalent, slow");
        snprintf(fields[i].to, TEXT, "%s", text + n + (text[n] == ' '));
    }
    if (any && (r->file[0] == '\0' || r->find[0] == '\0'))
        fail_at(path, r->line, "a change needs a file and what to find");
    return any;
}

static FILE *open_list(const char *path)
{
    FILE *in = fopen(path, "r");
    if (in == NULL) {
        perror(path);
        exit(2);
    }
    return in;
}

/* ---- finding and changing -------------------------------------------------------------------- */

/* Returns the first token of the position and its number of tokens; prints the reason on
 * failure. */
static bool locate(const source *s, const record *r, size_t *first, size_t *n)
{
    source part = source_of_text(r->find);
    size_t from = 0, end = s->n_tokens, found = 0;
    const bool bounded = strcmp(r->in, "-") != 0;
    const function *f = bounded ? source_function(s, r->in) : NULL;
    if (f != NULL) {
        from = f->first;
        end = f->end;
    }
    if (bounded && f == NULL)
        fprintf(stderr, "%s: no function %s\n", r->file, r->in);
    else
        found = source_find(s, from, end, &part, first);
    if (found != 1 && (!bounded || f != NULL))
        fprintf(stderr, "%s: %s: found %zu times, not once: %s\n", r->file, r->in, found, r->find);
    *n = part.n_tokens;
    source_free(&part);
    return found == 1;
}

static char *path_of(const char *root, const char *file)
{
    size_t n = strlen(root) + strlen(file) + 2;
    char *path = malloc(n);
    if (path == NULL)
        exit(2);
    snprintf(path, n, "%s/%s", root, file);
    return path;
}

static int check(const char *root, const char *list)
{
    FILE *in = open_list(list);
    record r;
    size_t line = 0, n = 0, stale = 0;
    while (next_record(in, list, &line, &r)) {
        char *path = path_of(root, r.file);
        source s = source_read(path);
        size_t first = 0, length = 0;
        n++;
        if (!locate(&s, &r, &first, &length)) {
            fprintf(stderr, "%s:%zu: this change has lost its place\n", list, r.line);
            stale++;
        }
        source_free(&s);
        free(path);
    }
    fclose(in);
    printf("%zu changes, %zu of them have lost their place\n", n, stale);
    return stale > 0 || n == 0;
}

static int lines(const char *list)
{
    FILE *in = open_list(list);
    record r;
    size_t line = 0;
    while (next_record(in, list, &line, &r))
        printf("%s\t%s\t%s\t%s\t%s\t%s\t%s\n", r.file, r.in, r.find, r.put, r.tests, r.equivalent,
               r.slow);
    fclose(in);
    return 0;
}

static int apply(const char *root, const char *list, long number)
{
    FILE *in = open_list(list);
    record r;
    size_t line = 0;
    bool found = false;
    for (long i = 0; i < number && (found = next_record(in, list, &line, &r)); i++)
        ;
    fclose(in);
    if (!found)
        return 2;
    char *path = path_of(root, r.file);
    source s = source_read(path);
    size_t first = 0, n = 0;
    if (!locate(&s, &r, &first, &n))
        return 1;
    const token *last = &s.tokens[first + n - 1];
    const char *begin = s.tokens[first].text, *end = last->text + last->length;
    FILE *out = fopen(path, "wb");
    if (out == NULL) {
        perror(path);
        return 2;
    }
    fprintf(out, "%.*s %s %s", (int)(begin - s.text), s.text, r.put, end);
    bool good = fclose(out) == 0;
    source_free(&s);
    free(path);
    return good ? 0 : 2;
}

/* ---- drawing --------------------------------------------------------------------------------- */

/* splitmix64, which draws the same positions on every machine. */
static uint64_t random_below(uint64_t *state, uint64_t n)
{
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (z ^ (z >> 31)) % n; /* n is small, so that the bias is negligible. */
}

/* Prints the tokens first..end on one line; white space becomes one blank. */
static void print_tokens(const source *s, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++) {
        const token *t = &s->tokens[i];
        if (i > first && s->tokens[i - 1].text + s->tokens[i - 1].length != t->text)
            putchar(' ');
        printf("%.*s", (int)t->length, t->text);
    }
}

/* Prints the change with enough tokens around it to be unique in its function. */
static bool print_change(const char *file, const source *s, const function *f, const place *p)
{
    size_t first = p->first, end = p->end;
    for (;;) {
        source part = {.tokens = s->tokens + first, .n_tokens = end - first};
        size_t at;
        if (source_find(s, f->first, f->end, &part, &at) == 1 && end - first > 2)
            break;
        if (first == f->first && end == f->end)
            return false;
        if (first > f->first)
            first--;
        if (end < f->end)
            end++;
    }
    if (s->tokens[end - 1].text + s->tokens[end - 1].length - s->tokens[first].text > TEXT / 2)
        return false;
    printf("file %s\nin %s\nfind ", file, f->name);
    print_tokens(s, first, end);
    printf("\nput ");
    print_tokens(s, first, p->first);
    printf(" %s ", p->put);
    print_tokens(s, p->end, end);
    printf("\n\n");
    return true;
}

/* Draws a position of the function, then one of its changes. */
static const place *draw_place(const place *places, size_t n, uint64_t *state)
{
    size_t n_name_slots = 0, chosen, i = 0;
    for (size_t k = 0; k < n; k++)
        n_name_slots += k == 0 || places[k].first != places[k - 1].first;
    chosen = random_below(state, n_name_slots);
    for (; i + 1 < n; i++)
        if (i + 1 < n && places[i + 1].first != places[i].first && chosen-- == 0)
            break;
    size_t first = i;
    while (first > 0 && places[first - 1].first == places[i].first)
        first--;
    return &places[first + random_below(state, i - first + 1)];
}

static int draw(const char *root, uint64_t seed, long wanted, char **files, int n_files)
{
    source *sources = calloc((size_t)n_files, sizeof *sources);
    size_t n_functions = 0;
    uint64_t state = seed;
    if (sources == NULL)
        return 2;
    for (int i = 0; i < n_files; i++) {
        char *path = path_of(root, files[i]);
        sources[i] = source_read(path);
        n_functions += sources[i].n_functions;
        free(path);
    }
    printf("# seed %" PRIu64 ", %zu functions\n\n", seed, n_functions);
    for (long tries = 0; wanted > 0 && n_functions > 0 && tries < 100000; tries++) {
        size_t k = random_below(&state, n_functions), i = 0;
        for (; k >= sources[i].n_functions; i++)
            k -= sources[i].n_functions;
        const function *f = &sources[i].functions[k];
        place *places = NULL;
        size_t n = places_of(&sources[i], f, &places);
        if (n > 0 && print_change(files[i], &sources[i], f, draw_place(places, n, &state)))
            wanted--;
        free(places);
    }
    for (int i = 0; i < n_files; i++)
        source_free(&sources[i]);
    free(sources);
    return wanted > 0;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "check") == 0)
        return check(argv[2], argv[3]);
    if (argc == 3 && strcmp(argv[1], "lines") == 0)
        return lines(argv[2]);
    if (argc == 5 && strcmp(argv[1], "apply") == 0)
        return apply(argv[2], argv[3], atol(argv[4]));
    if (argc > 5 && strcmp(argv[1], "draw") == 0)
        return draw(argv[2], strtoull(argv[3], NULL, 10), atol(argv[4]), argv + 5, argc - 5);
    fprintf(stderr,
            "usage: %s check ROOT LIST | lines LIST | apply ROOT LIST N | "
            "draw ROOT SEED N FILE...\n",
            argv[0]);
    return 2;
}
