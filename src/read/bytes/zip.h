/* Declares access to ZIP archives, also to one whose end is missing. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_BYTES_ZIP_H
#define WT_READ_BYTES_ZIP_H

#include "read/bytes/samples.h"

/* A growing buffer that is reused; zero-initialised is empty; free with free(data). */
typedef struct byte_buffer {
    unsigned char *data;
    size_t length;
    size_t capacity;
} byte_buffer;

typedef struct zip_entry zip_entry;

typedef struct zip_archive {
    wt_input *input;
    size_t length;      /* size of the file */
    zip_entry *entries; /* [n] */
    size_t n;
    const char *defect; /* reason why only complete entries are listed, or NULL */
    char *names;        /* concatenated names, each with its terminating zero */
    size_t names_length, names_capacity;
    uint64_t seed;
    uint32_t *slots; /* [n_name_slots] hash table of the names: entry + 1 */
    size_t n_name_slots;
    input_window window;
    struct libdeflate_decompressor *unpacker; /* NULL before the first entry is unpacked */
} zip_archive;

/* Opens an archive and borrows the input until it is closed. If the directory is missing or wrong,
 * the complete entries are opened. WT_E_CORRUPT if there is none. */
wt_status archive_open(wt_input *input, zip_archive **archive, wt_error *err) WT_NODISCARD;
void archive_close(zip_archive *archive);
/* Returns the name, borrowed until the archive is closed; "" for an entry without a usable name. */
const char *archive_name(const zip_archive *archive, size_t i);
bool archive_find(const zip_archive *archive, const char *name, size_t *i);
/* Returns the declared size, after a check that the packed bytes can expand to it. */
wt_status archive_size(const zip_archive *archive, size_t i, size_t *size,
                       wt_error *err) WT_NODISCARD;
/* Unpacks an entry of at most `limit` bytes and checks its size and checksum. */
wt_status archive_read(zip_archive *archive, size_t i, size_t limit, byte_buffer *buffer,
                       wt_error *err) WT_NODISCARD;

#endif
