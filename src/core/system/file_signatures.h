/* Signatures of the binary files of this program: the first attribute of the root of an HDF5 file,
 * within the first bytes of the file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_FILE_SIGNATURES_H
#define WT_CORE_SYSTEM_FILE_SIGNATURES_H

#include <stddef.h>

#define STORE_FORMAT_ATTRIBUTE "weartrack_format"
#define STORE_HEADER_SIZE ((size_t)4096) /* number of bytes that contain the attribute */
typedef struct embedded_text {
    const char *name; /* file name without its folder; NULL ends the list */
    const char *text; /* followed by a terminating zero that `length` does not count */
    size_t length;
} embedded_text;

#endif
