/* A ZIP archive, also one whose end is missing.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_BYTES_ZIP_H
#define WT_READ_BYTES_ZIP_H

#include "read/bytes/window.h"

/* A buffer that grows and is used again; zero-initialised is empty; free with free(data). */
typedef struct byte_buffer {
    unsigned char *data;
    size_t length;
    size_t capacity;
} byte_buffer;

typedef struct zip_entry zip_entry;
typedef struct zip_archive {
    wt_input *input;
    size_t length;      /* of the file */
    zip_entry *entries; /* [n] */
    size_t n;
    const char *odd; /* why the entries are those that are complete; or NULL */
    char *names;     /* one behind the other, each with its zero */
    size_t names_length, names_room;
    uint64_t seed;
    uint32_t *places; /* [n_places] entry + 1 by the hash of its name and the seed */
    size_t n_places;
    input_window window;
    struct libdeflate_decompressor *unpacker; /* NULL before anything is unpacked */
} zip_archive;

/* Borrows the input until closed. An archive without its directory (the end of the file is
 * missing), or with one that lies, is opened with the entries that are complete. WT_E_CORRUPT if
 * there is none. */
wt_status archive_open(wt_input *input, zip_archive **archive, wt_error *err) WT_NODISCARD;
void archive_close(zip_archive *archive);
/* Borrowed until closed; "" for an entry without a usable name. */
const char *archive_name(const zip_archive *archive, size_t i);
bool archive_find(const zip_archive *archive, const char *name, size_t *i);
/* Size as declared, after checking that so many bytes can come out of the packed ones. */
wt_status archive_size(const zip_archive *archive, size_t i, size_t *size,
                       wt_error *err) WT_NODISCARD;
/* Unpacks a whole entry of at most `limit` bytes. Its size and check sum must agree. */
wt_status archive_read(zip_archive *archive, size_t i, size_t limit, byte_buffer *buffer,
                       wt_error *err) WT_NODISCARD;

/* The directory of the complete entries at the beginning of `bytes`, as it would stand behind
 * them. *n = 0: none is complete. The caller frees *directory. */
wt_status archive_rebuild(const unsigned char *bytes, size_t length, unsigned char **directory,
                          uint64_t *directory_length, uint64_t *n, wt_error *err) WT_NODISCARD;

#endif
