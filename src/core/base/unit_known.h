/* Built-in conversion factors of the units that most files and commands use. Internal to base.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_UNIT_KNOWN_H
#define WT_CORE_BASE_UNIT_KNOWN_H

#include <stdbool.h>
#include <stddef.h>

/* Reading the database of UDUNITS takes as long as fitting several force curves, and most runs need
 * nothing of it but these. unit_core_units holds each of them against UDUNITS for every quantity,
 * bit by bit. */
typedef struct builtin_unit {
    const char *text, *si;
    double factor, offset;
} builtin_unit;

const builtin_unit *builtin_units(size_t *n);
/* If false, the unit must be converted by UDUNITS. */
bool builtin_unit_exists(const char *text);
/* Finds the conversion of a built-in unit. False if it is not a multiple of `si`. */
bool builtin_unit_find(const char *text, const char *si, double *factor, double *offset);

#endif
