/* Temporary files and folders, the signature of files of this program, and embedded files.
 * Temporary files have the name ".weartrack-PROCESS-RANDOM". They are in the folder of
 * the final output, so that the next run can remove those of a killed run. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_TEMPORARY_H
#define WT_CORE_SYSTEM_TEMPORARY_H

#include "weartrack/core.h"

#include <stddef.h>

/* Returns the folder for files that are not part of an output: TMPDIR or /tmp; borrowed. */
const char *temporary_directory(void);
/* Returns a new name in `folder`. It begins with a dot, so that no pattern matches it. NULL with
 * errno. */
char *temporary_name(const char *folder);
/* Creates a folder with such a name. *descriptor marks it as used until it is closed. NULL with
 * errno. */
char *temporary_folder_create(const char *folder, int *descriptor);
/* Marks an open file as used. */
void temporary_lock(int descriptor);
/* Removes a file, or a folder with its contents up to eight levels deep; links are not followed. */
void temporary_remove(const char *path);
/* Returns the space that the files of a folder take [byte]; more than `most` if they take more, or
 * are more than eight levels deep. Links are not followed. */
size_t temporary_folder_size(const char *path, size_t most);
/* Removes the temporary files in `folder` whose processes no longer exist. */
void temporary_remove_abandoned(const char *folder);

/* Copies the bytes [from, from + n) of the data. */
typedef wt_status digest_source(void *user, size_t from, void *to, size_t n, wt_error *err);

/* Computes the SHA-256 (omitted if hex is NULL) and a 64-bit fingerprint that identifies copies.
 * The fingerprint is a hash of the SHA-256. Without SHA-256 it is a hash of the data, in a fifth of
 * the time. */
wt_status digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                        uint64_t *fingerprint, wt_error *err) WT_NODISCARD;
/* Computes the MD5, which some file formats store to detect changes. */
void digest_md5(const void *bytes, size_t length, char hex[33]);

/* First attribute of the root of an HDF5 file of this program, within its first bytes. */
#define STORE_FORMAT_ATTRIBUTE "weartrack_format"
#define STORE_HEADER_SIZE ((size_t)4096) /* number of bytes that contain the attribute */

typedef struct embedded_text {
    const char *name; /* file name without its folder; NULL ends the list */
    const char *text; /* followed by a terminating zero that `length` does not count */
    size_t length;
} embedded_text;

#endif
