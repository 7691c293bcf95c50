/* Java .properties text as a sorted table of keys.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PROPERTIES_H
#define WT_READ_PROPERTIES_H

#include "weartrack/base.h"

typedef struct wt_property {
    const char *key;
    const char *value;
} wt_property;

/* Zero-initialised is empty. Parsing again reuses the memory, so one object serves for the headers
 * of all segments of a map. */
typedef struct wt_properties {
    wt_property *items; /* [n] by rising key; of equal keys the last one of the file is kept */
    size_t n;
    size_t capacity;
    char *text; /* keys and values, UTF-8 */
    size_t text_capacity;
} wt_properties;

/* Latin-1 bytes with `#` and `!` comments, `=`, `:` or blank between key and value, the escapes
 * \t \n \r \f \uXXXX and continued lines. WT_E_CORRUPT for a zero byte or a broken \u; then the
 * table is empty. */
wt_status wt_properties_parse(wt_properties *properties, const unsigned char *bytes, size_t length,
                              wt_error *err) WT_NODISCARD;
void wt_properties_clear(wt_properties *properties); /* frees all; empty again */

/* NULL if there is no such key. */
const char *wt_properties_get(const wt_properties *properties, const char *key);
/* The key is the texts put together; NULL also if it would be longer than any key here can be. */
const char *wt_properties_find(const wt_properties *properties, const char *prefix,
                               const char *suffix);
/* NaN if there is no such key or it is not one finite number. */
double wt_properties_number(const wt_properties *properties, const char *prefix,
                            const char *suffix);

#endif
