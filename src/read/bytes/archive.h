/* A ZIP archive in memory, also one whose end is missing.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_ARCHIVE_H
#define WT_READ_ARCHIVE_H

#include "weartrack/read.h"

typedef struct zip_archive {
    struct zip *zip;
    size_t n;                 /* entries */
    bool truncated;           /* the end is missing */
    unsigned char *directory; /* rebuilt, or NULL; lives as long as `zip` */
} zip_archive;

/* A buffer that grows and is used again; zero-initialised is empty; free with free(data). */
typedef struct byte_buffer {
    unsigned char *data;
    size_t length;
    size_t capacity;
} byte_buffer;

/* Borrows the bytes of the input until closed. An archive without its directory (the end of the
 * file is missing) is opened with the entries that are complete. WT_E_CORRUPT if there is none. */
wt_status archive_open(wt_input *input, zip_archive **archive, wt_error *err) WT_NODISCARD;
void archive_close(zip_archive *archive);
/* Borrowed until closed; "" for an entry without a usable name. */
const char *archive_name(const zip_archive *archive, size_t i);
bool archive_find(const zip_archive *archive, const char *name, size_t *i);
/* Size as declared, after checking that so many bytes can come out of the packed ones. */
wt_status archive_size(const zip_archive *archive, size_t i, size_t *size,
                       wt_error *err) WT_NODISCARD;
/* Unpacks a whole entry of at most `limit` bytes. Its size and check sum must agree. */
wt_status archive_read(const zip_archive *archive, size_t i, size_t limit, byte_buffer *buffer,
                       wt_error *err) WT_NODISCARD;

/* The directory of the complete entries at the beginning of `bytes`, as it would stand behind
 * *end. *n = 0: none is complete. The caller frees *directory. */
wt_status archive_rebuild(const unsigned char *bytes, size_t length, unsigned char **directory,
                          size_t *directory_length, size_t *end, size_t *n,
                          wt_error *err) WT_NODISCARD;

#endif
