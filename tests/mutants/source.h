/* A C file as tokens and functions, as far as a change needs them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_MUTANTS_SOURCE_H
#define TESTS_MUTANTS_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum token_kind { TOKEN_NAME, TOKEN_NUMBER, TOKEN_STRING, TOKEN_SIGN } token_kind;

typedef struct token {
    token_kind kind;
    const char *text; /* position in the source text */
    size_t length;
    bool directive; /* token of a preprocessor line */
} token;

typedef struct function {
    char name[96];
    size_t first, end; /* tokens of the body, without the braces */
} function;

typedef struct source {
    char *text;
    size_t length;
    token *tokens;
    size_t n_tokens;
    function *functions;
    size_t n_functions;
} source;

/* Both end the program if the system fails. */
source source_read(const char *path);
source source_of_text(const char *text); /* splits a part of a file into tokens */
void source_free(source *s);

bool token_is(const token *t, const char *text);
/* Counts the matches of the tokens of `part` in the tokens first..end, ignoring white space and
 * comments. *at is the last match. */
size_t source_find(const source *s, size_t first, size_t end, const source *part, size_t *at);
/* Returns NULL if there is no function of this name. */
const function *source_function(const source *s, const char *name);

#endif
