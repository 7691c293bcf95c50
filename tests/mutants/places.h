/* What can be changed in a function: one operator, number, argument, status or statement.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_MUTANTS_PLACES_H
#define TESTS_MUTANTS_PLACES_H

#include "source.h"

/* Tokens first..end become `put`. */
typedef struct place {
    size_t first, end;
    char put[256];
} place;

/* All changes of a function, those of one token together; *changes is allocated. Left alone:
 * preprocessor lines, static assertions, text that is not a key, sizes of buffers, and statements
 * that only free memory (the leak check of the sanitizers sees those). */
size_t places_of(const source *s, const function *f, place **changes);

#endif
