/* A part of a synthetic surface as Gwyddion Simple Field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_GENERATE_GENERATE_FIELD_H
#define TESTS_GENERATE_GENERATE_FIELD_H

#include "study/synthetic_surface.h"

/* Writes n columns and `rows` rows from column x and row y. Returns 0, or 1 if the file cannot be
 * written. */
int write_field(const char *folder, const char *name, const synthetic_surface *s, size_t n,
                size_t rows, size_t x, size_t y);

#endif
