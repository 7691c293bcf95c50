/* Built-in conversion factors of the units that most files and commands use. Internal to base.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_UNIT_H
#define WT_CORE_BASE_UNIT_H

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

#endif
