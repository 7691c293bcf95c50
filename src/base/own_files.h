/* How what this program writes and is no text says whose it is: HDF5 in the first attribute of its
 * root, which stands in the first bytes of the file, a PDF in its last. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_BASE_OWN_FILES_H
#define WT_BASE_OWN_FILES_H

#define STORE_FORMAT_ATTRIBUTE "weartrack_format"
/* Marks a file with a map, by which it is known before HDF5 opens it: its first attribute. */
#define STORE_MAP_ATTRIBUTE "weartrack_force_map"
#define STORE_START ((size_t)4096) /* bytes that hold one of them */
/* A comment behind the end of a PDF, where readers of it look no more. */
#define PDF_MARK "%weartrack sheets\n"

#endif
