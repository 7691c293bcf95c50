/* Signatures of the binary files of this program. An HDF5 file has it in the first attribute of its
 * root, within the first bytes of the file. A database has it in the application ID of its header.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_FILE_SIGNATURES_H
#define WT_CORE_SYSTEM_FILE_SIGNATURES_H

#include <stddef.h>

#define STORE_FORMAT_ATTRIBUTE "weartrack_format"
/* First attribute of a file with a force map, which identifies the file without HDF5. */
#define STORE_MAP_ATTRIBUTE "weartrack_force_map"
#define STORE_HEADER_SIZE ((size_t)4096) /* number of bytes that contain one of the attributes */
/* An SQLite database begins with this text and a zero byte. The application ID of this program is
 * stored in big-endian order at a fixed offset (SQLite file format, section 1.3). */
#define SQLITE_SIGNATURE "SQLite format 3"
#define SQLITE_APPLICATION_ID "wtrk"
enum { SQLITE_APPLICATION_ID_OFFSET = 68, SQLITE_APPLICATION_ID_SIZE = 4 };

typedef struct embedded_text {
    const char *name; /* file name without its folder; NULL ends the list */
    const char *text; /* followed by a terminating zero that `length` does not count */
    size_t length;
} embedded_text;

#endif
