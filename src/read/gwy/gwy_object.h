/* Objects of a Gwyddion file: a name, a size, and components, each a key, a letter for its type and
 * its value. Every length is checked against what is there before it is used.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_GWY_OBJECT_H
#define WT_READ_GWY_OBJECT_H

#include "weartrack/base.h"

#include <stdbool.h>
#include <stddef.h>

/* Bytes that are still to be read. */
typedef struct gwy_bytes {
    const unsigned char *at, *end;
} gwy_bytes;

typedef struct gwy_component {
    const char *key; /* ends with a zero */
    char type;       /* b c i q d s o, and capitals for arrays of them */
    gwy_bytes value; /* of an array: its items, of an object: name, size and components */
    size_t n;        /* items */
} gwy_component;

/* Name and components of the object that begins there, which goes on behind it; false if it is cut.
 */
bool gwy_object(gwy_bytes *from, const char **name, gwy_bytes *components);
/* The next component; false at the end, or where *status becomes WT_E_CORRUPT. */
bool gwy_next(gwy_bytes *components, gwy_component *to, wt_status *status);
/* The component of that key and type; false if there is none. */
bool gwy_find(gwy_bytes components, const char *key, char type, gwy_component *to);
/* The unit at a key: an object with a text; "" if it is not there. */
const char *gwy_unit(gwy_bytes components, const char *key);
double gwy_double(const gwy_component *component);
size_t gwy_count(const gwy_component *component); /* of an int32; 0 if it is negative */

#endif
