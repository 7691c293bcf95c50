/* Possible changes in a function: one operator, number, argument, status or statement.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_MUTANTS_PLACES_H
#define TESTS_MUTANTS_PLACES_H

#include "source.h"

/* `put` replaces the tokens first..end. */
typedef struct place {
    size_t first, end;
    char put[256];
} place;

/* All changes of a function, grouped by token; *changes is allocated. Preprocessor lines, static
 * assertions, text other than keys, buffer sizes and statements that only free memory are excluded.
 * The leak check of the sanitizers covers the last. */
size_t places_of(const source *s, const function *f, place **changes);

#endif
