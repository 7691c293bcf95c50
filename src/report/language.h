/* Language of figures and page. The source has English texts, which are the keys of the
 * translations. A text without a translation stays English.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_LANGUAGE_H
#define WT_REPORT_LANGUAGE_H

#include "weartrack/core.h"

typedef struct translation {
    const char *english, *words;
} translation;

/* A language; a NULL pointer means English. */
typedef struct language {
    char tag[8];            /* HTML tag: "de" */
    char decimal_mark;      /* for displayed numbers; data files have a point */
    char *bytes;            /* memory of the translations; owned */
    translation *sentences; /* [n], sorted by the English texts; owned */
    size_t n;
} language;

/* Returns the translation of a text, borrowed from the language or the text. The compiler checks
 * format arguments against the English text; a test checks the translations against it. */
#if defined(__GNUC__)
__attribute__((format_arg(2)))
#endif
const char *
translate(const language *l, const char *english);
/* Variant with a singular and a plural text, which have the same placeholders. */
#if defined(__GNUC__)
__attribute__((format_arg(3), format_arg(4)))
#endif
const char *
translate_count(const language *l, size_t n, const char *one, const char *more);

/* Returns the name of a group; bulk and track are translated. */
const char *translate_group(const language *l, const char *name);

const char *language_tag(const language *l);
/* Replaces decimal points in a text of one or several numbers with units. */
void language_set_decimal_mark(const language *l, char *number);

#endif
