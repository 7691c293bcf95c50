/* Declares Java .properties text as a sorted table of keys.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PROPERTIES_H
#define WT_READ_PROPERTIES_H

#include "weartrack/core.h"

typedef struct property_entry {
    const char *key;
    const char *value;
} property_entry;

/* A table of properties; zero-initialised is empty. Parsing again reuses the memory, so one table
 * serves the headers of all segments of a map. */
typedef struct property_list {
    property_entry *items; /* [n] sorted by key; of equal keys the last one in the file */
    size_t n;
    size_t capacity; /* size of the block of items and text [byte] */
    char *text;      /* keys and values, UTF-8 */
} property_list;

/* Parses Latin-1 text with `#` and `!` comments, and `=`, `:` or blank between key and value. It
 * knows the escapes \t \n \r \f \uXXXX and continued lines. Returns WT_E_CORRUPT and an empty table
 * for a zero byte or an invalid \u. */
wt_status properties_parse(property_list *properties, const unsigned char *bytes, size_t length,
                           wt_error *err) WT_NODISCARD;
void properties_clear(
    property_list *properties); /* frees the memory; the table is empty afterwards */

/* Returns the value of a key, or NULL. */
const char *properties_get(const property_list *properties, const char *key);
/* Returns the value of the key prefix + suffix, or NULL; NULL also for a key that is too long. */
const char *properties_find(const property_list *properties, const char *prefix,
                            const char *suffix);
/* Reads the next word of a list and moves *list past it. Returns false if there is none or it does
 * not fit; *list is then the rest. *list may be NULL. */
bool property_next_token(const char **list, char *word, size_t size);
/* Returns the number of the key prefix + suffix; NaN if it is absent or no number. */
double properties_number(const property_list *properties, const char *prefix, const char *suffix);

#endif
