/* Translates texts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/language.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static int compare_english(const void *english, const void *sentence)
{
    return strcmp(english, ((const translation *)sentence)->english);
}

const char *translate(const language *l, const char *english)
{
    const translation *found = NULL;
    if (l != NULL && english != NULL)
        found = bsearch(english, l->sentences, l->n, sizeof *l->sentences, compare_english);
    return found != NULL ? found->words : english;
}

const char *translate_count(const language *l, size_t n, const char *one, const char *more)
{
    return translate(l, n == 1 ? one : more);
}

const char *translate_group(const language *l, const char *name)
{
    const bool usual = strcmp(name, "bulk") == 0 || strcmp(name, "track") == 0;
    return usual ? translate(l, name) : name;
}

const char *language_tag(const language *l)
{
    return l != NULL ? l->tag : "en";
}

void language_set_decimal_mark(const language *l, char *number)
{
    for (char *s = number; l != NULL && *s != '\0'; s++)
        if (*s == '.' && s > number && isdigit((unsigned char)s[-1]) &&
            isdigit((unsigned char)s[1]))
            *s = l->decimal_mark;
}
