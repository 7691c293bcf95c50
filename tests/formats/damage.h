/* Structured damage of a file, drawn by a seed; in an archive that of one entry, packed anew with
 * its check sum and without a central directory, or that of the archive as it lies there.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_FORMATS_DAMAGE_H
#define TESTS_FORMATS_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum damage {
    FIELD,      /* a whole number of 2, 4 or 8 bytes, or the digits of one in text */
    TEXT,       /* letters for digits */
    DELETED,    /* bytes, or lines of a text */
    DOUBLED,    /* the same */
    SWAPPED,    /* two blocks, or two lines */
    ZEROED,     /* bytes, or the cells of a line made empty */
    ENTRY_GONE, /* of an archive, or a block of another file */
    CUT,        /* at any place */
    EXTREME,    /* a whole number, in text too, set to nothing, one or the largest */
    BITS,       /* one to eight of them */
    VALUE,      /* of an attribute, an element or a key set to that of another */
    PACKED,     /* any of these, of an archive as it is packed; else as CUT */
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
    byte_block
        whole; /* of an archive, as damaged ones are packed: the damage is the only difference */
    byte_block original;    /* an archive as it was */
    archive_entry *entries; /* of an archive */
    size_t n_entries;
} damageable;

/* Of a file; no bytes if there is none. */
damageable damageable_load(const char *path);
void damageable_free(damageable *d);

/* Number `trial` of the seed: new bytes, and of which kind the damage is. */
byte_block damage_draw(const damageable *d, uint64_t seed, size_t trial, damage *kind);

#endif
