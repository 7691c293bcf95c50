/* A C file as tokens and functions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "source.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *more(void *array, size_t n, size_t size)
{
    if (n > 0 && (n & (n - 1)) != 0)
        return array; /* grows at powers of two */
    array = realloc(array, (n == 0 ? 1 : 2 * n) * size);
    if (array == NULL) {
        fputs("out of memory\n", stderr);
        exit(2);
    }
    return array;
}

static char *read_all(const char *path, size_t *length)
{
    FILE *in = fopen(path, "rb");
    char *text = NULL;
    size_t n = 0;
    if (in == NULL) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        exit(2);
    }
    for (int c; (c = fgetc(in)) != EOF;) {
        text = more(text, n, 1);
        text[n++] = (char)c;
    }
    fclose(in);
    text = more(text, n, 1);
    text[n] = '\0';
    *length = n;
    return text;
}

/* ---- tokens ---------------------------------------------------------------------------------- */

static size_t string_length(const char *p)
{
    size_t n = 1;
    while (p[n] != '\0' && p[n] != p[0])
        n += p[n] == '\\' && p[n + 1] != '\0' ? 2 : 1;
    return n + (p[n] != '\0');
}

static size_t sign_length(const char *p)
{
    static const char *const signs[] = {
        "<<=", ">>=", "...", "->", "++", "--", "<=", ">=", "==", "!=", "&&", "||",
        "+=",  "-=",  "*=",  "/=", "%=", "&=", "|=", "^=", "<<", ">>", "##"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strncmp(p, signs[i], strlen(signs[i])) == 0)
            return strlen(signs[i]);
    return 1;
}

static token next_token(const char *p)
{
    token t = {TOKEN_SIGN, p, 0, false};
    if (*p == '"' || *p == '\'') {
        t.kind = TOKEN_STRING;
        t.length = string_length(p);
    } else if (isdigit((unsigned char)*p) || (*p == '.' && isdigit((unsigned char)p[1]))) {
        t.kind = TOKEN_NUMBER;
        while (isalnum((unsigned char)p[t.length]) || p[t.length] == '.' ||
               ((p[t.length] == '+' || p[t.length] == '-') &&
                strchr("eEpP", p[t.length - 1]) != NULL &&
                (tolower((unsigned char)p[t.length - 1]) == 'p' || strncmp(p, "0x", 2) != 0)))
            t.length++;
    } else if (isalpha((unsigned char)*p) || *p == '_') {
        t.kind = TOKEN_NAME;
        while (isalnum((unsigned char)p[t.length]) || p[t.length] == '_')
            t.length++;
    } else {
        t.length = sign_length(p);
    }
    return t;
}

static void find_tokens(source *s)
{
    bool directive = false, line_start = true;
    for (const char *p = s->text; *p != '\0';) {
        if (*p == '\n') {
            directive = false;
            line_start = true;
            p++;
        } else if (*p == '\\' && p[1] == '\n') {
            p += 2;
        } else if (isspace((unsigned char)*p)) {
            p++;
        } else if (strncmp(p, "/*", 2) == 0) {
            const char *end = strstr(p + 2, "*/");
            p = end == NULL ? p + strlen(p) : end + 2;
        } else if (strncmp(p, "//", 2) == 0) {
            p += strcspn(p, "\n");
        } else {
            directive = directive || (line_start && *p == '#');
            line_start = false;
            token t = next_token(p);
            t.directive = directive;
            s->tokens = more(s->tokens, s->n_tokens, sizeof *s->tokens);
            s->tokens[s->n_tokens++] = t;
            p += t.length;
        }
    }
}

bool token_is(const token *t, const char *text)
{
    return strlen(text) == t->length && memcmp(t->text, text, t->length) == 0;
}

/* ---- functions ------------------------------------------------------------------------------- */

/* Returns the token after the one that closes the bracket at token i. */
static size_t after_closing(const source *s, size_t i)
{
    const char open = *s->tokens[i].text, close = open == '(' ? ')' : '}';
    int depth = 0;
    for (; i < s->n_tokens; i++) {
        const token *t = &s->tokens[i];
        if (t->kind != TOKEN_SIGN || t->directive)
            continue;
        depth += *t->text == open ? 1 : *t->text == close ? -1 : 0;
        if (depth == 0)
            return i + 1;
    }
    return i;
}

/* NAME ( ... ) { ... } outside all braces. */
static void find_functions(source *s)
{
    for (size_t i = 0; i + 1 < s->n_tokens;) {
        const token *t = &s->tokens[i];
        if (t->directive) {
            i++;
            /* braces of a type or a table; 'extern "C" {' is not skipped */
        } else if (token_is(t, "{")) {
            const bool linkage = i > 0 && s->tokens[i - 1].kind == TOKEN_STRING;
            i = linkage ? i + 1 : after_closing(s, i);
        } else if (t->kind == TOKEN_NAME && token_is(&s->tokens[i + 1], "(")) {
            size_t body = after_closing(s, i + 1);
            if (body >= s->n_tokens || !token_is(&s->tokens[body], "{")) {
                i = body;
                continue;
            }
            function f = {.first = body + 1, .end = after_closing(s, body) - 1};
            snprintf(f.name, sizeof f.name, "%.*s", (int)t->length, t->text);
            s->functions = more(s->functions, s->n_functions, sizeof *s->functions);
            s->functions[s->n_functions++] = f;
            i = f.end + 1;
        } else {
            i++;
        }
    }
}

const function *source_function(const source *s, const char *name)
{
    for (size_t i = 0; i < s->n_functions; i++)
        if (strcmp(s->functions[i].name, name) == 0)
            return &s->functions[i];
    return NULL;
}

source source_read(const char *path)
{
    source s = {0};
    s.text = read_all(path, &s.length);
    find_tokens(&s);
    find_functions(&s);
    return s;
}

source source_of_text(const char *text)
{
    source s = {.length = strlen(text)};
    s.text = strdup(text);
    if (s.text == NULL)
        exit(2);
    find_tokens(&s);
    return s;
}

void source_free(source *s)
{
    free(s->text);
    free(s->tokens);
    free(s->functions);
    *s = (source){0};
}

size_t source_find(const source *s, size_t first, size_t end, const source *part, size_t *at)
{
    size_t found = 0;
    for (size_t i = first; part->n_tokens > 0 && i + part->n_tokens <= end; i++) {
        size_t k = 0;
        while (k < part->n_tokens && s->tokens[i + k].length == part->tokens[k].length &&
               memcmp(s->tokens[i + k].text, part->tokens[k].text, part->tokens[k].length) == 0)
            k++;
        if (k < part->n_tokens)
            continue;
        found++;
        *at = i;
    }
    return found;
}
