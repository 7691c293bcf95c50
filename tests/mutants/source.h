/* A C file as tokens and functions: enough of the language to find a place and to change it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_MUTANTS_SOURCE_H
#define TESTS_MUTANTS_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum token_kind { TOKEN_NAME, TOKEN_NUMBER, TOKEN_STRING, TOKEN_SIGN } token_kind;

typedef struct token {
    token_kind kind;
    const char *text; /* in the text of the source */
    size_t length;
    bool directive; /* of a preprocessor line */
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

/* Both end the program on a failure of the system. */
source source_read(const char *path);
source source_of_text(const char *text); /* a part of a file: tokens only */
void source_free(source *s);

bool token_is(const token *t, const char *text);
/* Number of places in tokens first..end where the tokens of `part` follow one another, comments and
 * blanks apart; *at is the last one. */
size_t source_find(const source *s, size_t first, size_t end, const source *part, size_t *at);
/* NULL if there is none of this name. */
const function *source_function(const source *s, const char *name);

#endif
