/* Structured damage of a file, drawn by a seed. In an archive it changes one entry, which is
 * packed again with its checksum and without a central directory, or the bytes of the archive
 * itself.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_FORMATS_DAMAGE_H
#define TESTS_FORMATS_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum damage {
    FIELD,      /* an integer of 2, 4 or 8 bytes, or the digits of a number in text */
    TEXT,       /* letters in place of digits */
    DELETED,    /* bytes, or lines of a text, removed */
    DOUBLED,    /* bytes or lines repeated */
    SWAPPED,    /* two blocks or two lines exchanged */
    ZEROED,     /* bytes set to zero, or the cells of a line emptied */
    ENTRY_GONE, /* entry of an archive, or a block of another file */
    CUT,        /* file truncated at any position */
    EXTREME,    /* an integer, also in text, set to zero, one or the largest value */
    BITS,       /* one to eight bits */
    VALUE,      /* value of an attribute, element or key replaced with that of another */
    PACKED,     /* one of these, applied to the packed archive; other files as CUT */
    N_DAMAGES
} damage;
extern const char *const damage_names[N_DAMAGES];

typedef struct byte_block {
    unsigned char *at;
    size_t n;
} byte_block;

typedef struct archive_entry {
    char name[256];
    byte_block content;
} archive_entry;

typedef struct damageable {
    byte_block whole;       /* the undamaged file, packed as the damaged ones are */
    byte_block original;    /* True if the file was an archive. */
    archive_entry *entries; /* name of the entry */
    size_t n_entries;
} damageable;

/* Reads a file; no bytes if there is none. */
damageable damageable_load(const char *path);
void damageable_free(damageable *d);

/* Damage `number` of the seed: returns new bytes and the kind of damage. */
byte_block damage_draw(const damageable *d, uint64_t seed, size_t number, damage *kind);

#endif
