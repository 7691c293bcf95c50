/* The language of figures and page. English texts stand where they are used; what they are in
 * another language is looked up by them, and a text that has no translation stays English.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_LANGUAGE_H
#define WT_REPORT_LANGUAGE_H

#include "weartrack/base.h"

typedef struct translation {
    const char *english, *words;
} translation;

/* A NULL pointer to it is English. */
typedef struct language {
    char tag[8];            /* of HTML: "de" */
    char decimal_mark;      /* of numbers that are read; those of files have a point */
    char *bytes;            /* owned: what the translations point to */
    translation *sentences; /* [n], owned, in the order of the English texts */
    size_t n;
} language;

/* What says the same in the language: borrowed, for as long as it and the text are there. The
 * compiler holds arguments against the English text, a test the translations against that. */
#if defined(__GNUC__)
__attribute__((format_arg(2)))
#endif
const char *
translate(const language *l, const char *english);
/* Of the same length for one and for more. */
#if defined(__GNUC__)
__attribute__((format_arg(3), format_arg(4)))
#endif
const char *
translate_count(const language *l, size_t n, const char *one, const char *more);

/* A group by its name, of which bulk and track have words. */
const char *say_group(const language *l, const char *name);

const char *language_tag(const language *l);
/* Puts the decimal mark in a text that is one number, or several, with units. */
void language_decimals(const language *l, char *number);

#endif
