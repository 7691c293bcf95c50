/* Java .properties text as a sorted table of keys.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PROPERTIES_H
#define WT_READ_PROPERTIES_H

#include "weartrack/base.h"

typedef struct property_entry {
    const char *key;
    const char *value;
} property_entry;

/* Zero-initialised is empty. Parsing again reuses the memory, so one object serves for the headers
 * of all segments of a map. */
typedef struct property_list {
    property_entry *items; /* [n] by rising key; of equal keys the last one of the file is kept */
    size_t n;
    size_t capacity; /* of the block of items and text [byte] */
    char *text;      /* keys and values, UTF-8 */
} property_list;

/* Latin-1 bytes with `#` and `!` comments, `=`, `:` or blank between key and value, the escapes
 * \t \n \r \f \uXXXX and continued lines. WT_E_CORRUPT for a zero byte or a broken \u; then the
 * table is empty. */
wt_status properties_parse(property_list *properties, const unsigned char *bytes, size_t length,
                           wt_error *err) WT_NODISCARD;
void properties_clear(property_list *properties); /* frees all; empty again */

/* NULL if there is no such key. */
const char *properties_get(const property_list *properties, const char *key);
/* The key is the texts put together; NULL also if it would be longer than any key here can be. */
const char *properties_find(const property_list *properties, const char *prefix,
                            const char *suffix);
/* The next word of a list, and *list behind it; false, and *list at what is left, if there is none
 * or it finds no room. *list may be NULL. */
bool property_word(const char **list, char *word, size_t size);
/* The value of a key. */
double properties_number(const property_list *properties, const char *prefix, const char *suffix);

#endif
