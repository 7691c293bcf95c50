/* How what this program writes and is no text says whose it is: HDF5 in the first attribute of its
 * root, which stands in the first bytes of the file, a database in the word of its header that is
 * for that, a PDF in its last bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_FILE_SIGNATURES_H
#define WT_CORE_SYSTEM_FILE_SIGNATURES_H

#define STORE_FORMAT_ATTRIBUTE "weartrack_format"
/* Marks a file with a map, by which it is known before HDF5 opens it: its first attribute. */
#define STORE_MAP_ATTRIBUTE "weartrack_force_map"
#define STORE_START ((size_t)4096) /* bytes that hold one of them */
/* A comment behind the end of a PDF, where readers of it look no more. */
#define PDF_MARK "%weartrack sheets\n"
/* An SQLite database begins with this and a zero; the application ID of those of this program, high
 * byte first, and where it stands (file format of SQLite, 1.3). */
#define DATABASE_START "SQLite format 3"
#define DATABASE_ID "wtrk"
enum { DATABASE_ID_AT = 68, DATABASE_ID_SIZE = 4 };

#endif
