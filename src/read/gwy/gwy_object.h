/* Declares the objects of a Gwyddion file. An object has a name, a size and components; a
 * component has a key, a type letter and a value. Every length is checked before it is used.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_GWY_OBJECT_H
#define WT_READ_GWY_OBJECT_H

#include "weartrack/core.h"

#include <stdbool.h>
#include <stddef.h>

/* The bytes that are not read yet. */
typedef struct gwy_bytes {
    const unsigned char *at, *end;
} gwy_bytes;

typedef struct gwy_component {
    const char *key; /* zero-terminated */
    char type;       /* b, c, i, q, d, s or o; capitals for arrays */
    gwy_bytes value; /* items of an array; name, size and components of an object */
    size_t n;        /* number of items */
} gwy_component;

/* Reads the name and the components of the object at *from and moves *from to its end; false if it
 * is truncated. */
bool gwy_read_object(gwy_bytes *from, const char **name, gwy_bytes *components);
/* Reads the next component; false at the end, or on damage with *status = WT_E_CORRUPT. */
bool gwy_next_component(gwy_bytes *components, gwy_component *to, wt_status *status);
/* Finds the component with this key and type; false if there is none. */
bool gwy_find_component(gwy_bytes components, const char *key, char type, gwy_component *to);
/* Returns the unit stored at a key, an object with a text; "" if it is absent. */
const char *gwy_unit(gwy_bytes components, const char *key);
double gwy_double(const gwy_component *component);
size_t gwy_count(const gwy_component *component); /* value of an int32; 0 if it is negative */

#endif
