/* Possible changes in a function.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "places.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct list {
    const source *s;
    const function *f;
    place *places;
    size_t n;
} list;

static const token *at(const list *l, size_t i)
{
    return &l->s->tokens[i];
}

static void add(list *l, size_t first, size_t end, const char *put)
{
    if (strlen(put) >= sizeof l->places->put)
        return;
    place *grown = realloc(l->places, (l->n + 1) * sizeof *grown);
    if (grown == NULL)
        exit(2);
    l->places = grown;
    place *p = &grown[l->n++];
    p->first = first;
    p->end = end;
    snprintf(p->put, sizeof p->put, "%s", put);
}

static bool is_one_of(const token *t, const char *const *words)
{
    for (; *words != NULL; words++)
        if (token_is(t, *words))
            return true;
    return false;
}

/* True if an operand ends at this token, so that a following sign is a binary operator. */
static bool ends_operand(const token *t)
{
    static const char *const words[] = {"return", "case", "sizeof", "else", "do", NULL};
    if (t->kind == TOKEN_SIGN)
        return token_is(t, ")") || token_is(t, "]");
    return t->kind != TOKEN_NAME || !is_one_of(t, words);
}

/* ---- signs ----------------------------------------------------------------------------------- */

static void change_signs(list *l, size_t i)
{
    static const struct {
        const char *sign, *put;
        bool between; /* binary operator only */
    } changes[] = {
        {"<", "<=", true},   {"<", ">", true},    {"<=", "<", true},   {"<=", ">=", true},
        {">", ">=", true},   {">", "<", true},    {">=", ">", true},   {">=", "<=", true},
        {"==", "!=", true},  {"!=", "==", true},  {"&&", "||", true},  {"||", "&&", true},
        {"+", "-", true},    {"-", "+", true},    {"*", "/", true},    {"/", "*", true},
        {"+=", "-=", false}, {"-=", "+=", false}, {"*=", "/=", false}, {"/=", "*=", false},
        {"++", "--", false}, {"--", "++", false},
    };
    const token *t = at(l, i);
    bool between = i > l->f->first && ends_operand(at(l, i - 1));
    for (size_t k = 0; k < sizeof changes / sizeof *changes; k++)
        if (token_is(t, changes[k].sign) && (between || !changes[k].between))
            add(l, i, i + 1, changes[k].put);
    if (!between && (token_is(t, "!") || token_is(t, "-")))
        add(l, i, i + 1, "");
    /* n - 1 to n */
    if (between && (token_is(t, "-") || token_is(t, "+")) && token_is(at(l, i + 1), "1"))
        add(l, i, i + 2, "");
}

/* ---- numbers, keys, statuses ----------------------------------------------------------------- */

/* sizeof x[0], sizeof(x[0]): the index has no effect. */
static bool in_sizeof(const list *l, size_t i)
{
    for (size_t back = 3; back <= 4 && i >= l->f->first + back; back++)
        if (token_is(at(l, i - back), "sizeof"))
            return true;
    return false;
}

static void change_number(list *l, size_t i)
{
    const token *t = at(l, i);
    char text[64], put[96];
    if (in_sizeof(l, i))
        return;
    snprintf(text, sizeof text, "%.*s", (int)t->length, t->text);
    if (strpbrk(text, ".eEpP") != NULL && strncmp(text, "0x", 2) != 0) {
        snprintf(put, sizeof put, strtod(text, NULL) > 0 ? "(2 * %s)" : "(1 + %s)", text);
        add(l, i, i + 1, put);
        return;
    }
    char *end;
    unsigned long value = strtoul(text, &end, 0);
    bool buffer = value >= 16 && token_is(at(l, i - 1), "[") && token_is(at(l, i + 1), "]");
    if (buffer)
        return;
    snprintf(put, sizeof put, "%lu%s", value + 1, end);
    add(l, i, i + 1, put);
    snprintf(put, sizeof put, "%lu%s", value - 1, end);
    if (value > 0)
        add(l, i, i + 1, put);
}

/* Keys and names of columns have lower case letters, digits and '_' only. */
static void change_key(list *l, size_t i)
{
    const token *t = at(l, i);
    char put[128];
    if (*t->text != '"' || t->length < 5 || t->length > 100 ||
        memchr(t->text, '_', t->length) == NULL)
        return;
    for (size_t k = 1; k + 1 < t->length; k++)
        if (!islower((unsigned char)t->text[k]) && !isdigit((unsigned char)t->text[k]) &&
            t->text[k] != '_')
            return;
    snprintf(put, sizeof put, "\"x%.*s", (int)t->length - 1, t->text + 1);
    add(l, i, i + 1, put);
}

static void change_name(list *l, size_t i)
{
    const token *t = at(l, i);
    if (t->length > 5 && strncmp(t->text, "WT_E_", 5) == 0) {
        if (!token_is(t, "WT_E_INTERNAL"))
            add(l, i, i + 1, "WT_E_INTERNAL");
        if (i > l->f->first && token_is(at(l, i - 1), "return"))
            add(l, i, i + 1, "WT_OK");
    }
    if (i == l->f->first || !token_is(at(l, i - 1), "return"))
        return;
    if (token_is(t, "WT_OK"))
        add(l, i, i + 1, "WT_E_INTERNAL");
    if (token_is(t, "true") || token_is(t, "false"))
        add(l, i, i + 1, token_is(t, "true") ? "false" : "true");
}

/* ---- arguments ------------------------------------------------------------------------------- */

/* Returns the end of an argument that starts at i: the comma or bracket after it. *simple: the
 * argument is a name, a number, a member or an element, which may be exchanged with another one. */
static size_t argument_end(const list *l, size_t i, bool *simple)
{
    int depth = 0;
    *simple = true;
    for (; i < l->f->end; i++) {
        const token *t = at(l, i);
        if (t->kind == TOKEN_STRING)
            *simple = false;
        if (t->kind != TOKEN_SIGN)
            continue;
        if (depth == 0 && (token_is(t, ",") || token_is(t, ")")))
            break;
        if (strchr("([{", *t->text) != NULL)
            depth++;
        if (strchr(")]}", *t->text) != NULL)
            depth--;
        static const char *const allowed[] = {".", "->", "[", "]", "&", NULL};
        if (!is_one_of(t, allowed))
            *simple = false;
    }
    return i;
}

static void change_arguments(list *l, size_t i)
{
    if (at(l, i)->kind != TOKEN_NAME || i + 2 >= l->f->end || !token_is(at(l, i + 1), "("))
        return;
    bool simple, next_simple;
    for (size_t first = i + 2; first < l->f->end;) {
        size_t comma = argument_end(l, first, &simple);
        if (comma >= l->f->end || !token_is(at(l, comma), ","))
            return;
        size_t end = argument_end(l, comma + 1, &next_simple);
        const char *a = at(l, first)->text, *b = at(l, comma + 1)->text;
        const token *last_a = at(l, comma - 1), *last_b = at(l, end - 1);
        int length_a = (int)(last_a->text + last_a->length - a);
        int length_b = (int)(last_b->text + last_b->length - b);
        bool same = length_a == length_b && memcmp(a, b, (size_t)length_a) == 0;
        char put[256];
        if (simple && next_simple && !same && length_a + length_b < 200) {
            snprintf(put, sizeof put, "%.*s, %.*s", length_b, b, length_a, a);
            add(l, first, end, put);
        }
        first = comma + 1;
    }
}

/* ---- statements ------------------------------------------------------------------------------ */

static bool only_frees(const token *t)
{
    static const char *const ends[] = {"free", "_clear", "_close", "fclose", "_Free", "release"};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        size_t n = strlen(ends[k]);
        if (t->length >= n && memcmp(t->text + t->length - n, ends[k], n) == 0)
            return true;
    }
    return false;
}

/* A call or an assignment as a separate statement. */
static void delete_statement(list *l, size_t i)
{
    static const char *const starts[] = {";", "{", "}", ")", "else", NULL};
    static const char *const words[] = {
        "return",        "if",       "for",    "while", "do",     "else",    "goto",
        "break",         "continue", "switch", "case",  "sizeof", "default", "_Static_assert",
        "static_assert", "assert",   NULL};
    static const char *const behind[] = {"(", "=", "+=", "-=", "*=", "/=", "->", ".", "[", NULL};
    const token *t = at(l, i);
    if (t->kind != TOKEN_NAME || is_one_of(t, words) || i + 1 >= l->f->end)
        return;
    if (i > l->f->first && !is_one_of(at(l, i - 1), starts))
        return;
    if (!is_one_of(at(l, i + 1), behind) || (token_is(at(l, i + 1), "(") && only_frees(t)))
        return;
    int depth = 0;
    for (size_t k = i; k < l->f->end; k++) {
        const token *u = at(l, k);
        if (u->kind != TOKEN_SIGN)
            continue;
        depth += strchr("([{", *u->text) != NULL ? 1 : strchr(")]}", *u->text) != NULL ? -1 : 0;
        if (depth < 0)
            return; /* loop header */
        if (depth == 0 && token_is(u, ";")) {
            add(l, i, k + 1, ";");
            return;
        }
    }
}

size_t places_of(const source *s, const function *f, place **changes)
{
    list l = {s, f, NULL, 0};
    for (size_t i = f->first; i < f->end; i++) {
        const token *t = &s->tokens[i];
        if (t->directive)
            continue;
        if (token_is(t, "static_assert") || token_is(t, "_Static_assert") ||
            token_is(t, "assert")) {
            while (i < f->end && !token_is(&s->tokens[i], ";"))
                i++;
            continue;
        }
        if (t->kind == TOKEN_SIGN)
            change_signs(&l, i);
        else if (t->kind == TOKEN_NUMBER)
            change_number(&l, i);
        else if (t->kind == TOKEN_STRING)
            change_key(&l, i);
        else
            change_name(&l, i);
        change_arguments(&l, i);
        delete_statement(&l, i);
    }
    *changes = l.places;
    return l.n;
}
