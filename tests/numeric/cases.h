/* Reads numeric cases from plain text, so that a domain expert can add one without C:
 *
 *   case NAME
 *   given KEY VALUE...
 *   expect KEY VALUE...
 *
 * Lines that start with # and empty lines are skipped. A value is a number or a word. */
#ifndef WT_TESTS_CASES_H
#define WT_TESTS_CASES_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CASE_LINES = 64, CASE_VALUES = 64, CASE_NAME = 48 };

typedef struct case_line {
    bool expected; /* expect line; false: given line */
    char key[CASE_NAME];
    char word[CASE_NAME]; /* first value as text */
    size_t n;             /* number of values */
    double value[CASE_VALUES];
} case_line;

typedef struct numeric_case {
    char name[CASE_NAME];
    size_t n;
    case_line lines[CASE_LINES];
} numeric_case;

static inline void case_split(char *text, case_line *line)
{
    char *rest = NULL;
    const char *key = strtok_r(text, " \t\n", &rest);
    snprintf(line->key, sizeof line->key, "%s", key ? key : "");
    line->n = 0;
    line->word[0] = '\0';
    for (char *item = strtok_r(NULL, " \t\n", &rest); item; item = strtok_r(NULL, " \t\n", &rest)) {
        if (!line->word[0])
            snprintf(line->word, sizeof line->word, "%s", item);
        char *end = NULL;
        const double value = strtod(item, &end);
        if (*end == '\0' && line->n < CASE_VALUES)
            line->value[line->n++] = value;
    }
}

/* Reads the next case of a file; returns false at its end. An invalid line or too many values end
 * the program, so that no case is skipped. */
static inline bool case_read(FILE *in, numeric_case *c)
{
    char text[4096];
    bool open = false;
    c->n = 0;
    for (;;) {
        const long start = ftell(in);
        if (!fgets(text, sizeof text, in))
            return open;
        if (text[0] == '#' || text[strspn(text, " \t\n")] == '\0')
            continue;
        if (strncmp(text, "case ", 5) == 0) {
            if (open)
                return fseek(in, start, SEEK_SET) == 0;
            open = true;
            text[strcspn(text, "\n")] = '\0';
            snprintf(c->name, sizeof c->name, "%.*s", CASE_NAME - 1, text + 5);
            continue;
        }
        const bool given = strncmp(text, "given ", 6) == 0;
        const bool expected = strncmp(text, "expect ", 7) == 0;
        if (!open || c->n == CASE_LINES || (!given && !expected)) {
            fprintf(stderr, "numeric case: line not understood: %s", text);
            exit(1);
        }
        c->lines[c->n].expected = expected;
        case_split(text + (given ? 6 : 7), &c->lines[c->n]);
        c->n++;
    }
}

/* Returns the line with a key, or NULL. */
static inline const case_line *case_find(const numeric_case *c, bool expected, const char *key)
{
    for (size_t i = 0; i < c->n; i++)
        if (c->lines[i].expected == expected && strcmp(c->lines[i].key, key) == 0)
            return &c->lines[i];
    return NULL;
}

/* Returns the word after a key, or "". */
static inline const char *case_word(const numeric_case *c, bool expected, const char *key)
{
    const case_line *line = case_find(c, expected, key);
    return line ? line->word : "";
}

/* Returns a single number, or `missing`. */
static inline double case_number(const numeric_case *c, bool expected, const char *key,
                                 double missing)
{
    const case_line *line = case_find(c, expected, key);
    return line && line->n ? line->value[0] : missing;
}

#endif
