/* Inside the base room: what UDUNITS-2 answers on the units that most files and commands name.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_UNIT_KNOWN_H
#define WT_CORE_BASE_UNIT_KNOWN_H

#include <stdbool.h>
#include <stddef.h>

/* Reading the database of UDUNITS takes as long as fitting several force curves, and most runs need
 * nothing of it but these. unit_core_units holds each of them against UDUNITS for every quantity,
 * bit by bit. */
typedef struct known_unit {
    const char *text, *si;
    double factor, offset;
} known_unit;

const known_unit *known_units(size_t *n);
/* Else UDUNITS is to be asked. */
bool known_unit_is(const char *text);
/* Of a unit that is known: false if it is no multiple of `si`. */
bool known_unit_find(const char *text, const char *si, double *factor, double *offset);

#endif
