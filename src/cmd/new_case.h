/* New case: the files with their kinds, and their sections in the case file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_NEW_CASE_H
#define WT_CMD_NEW_CASE_H

#include "cmd/file_kind.h"

#define FILL_IN WT_CASE_FILL_IN

typedef enum case_section {
    BULK,
    TRACK,
    DMA,
    ROUGHNESS,
    MAPS,
    RECORD,
    PROFILE,
    UNUSED
} case_section;

typedef struct case_entry {
    char *path, *in_case; /* as given, and relative to the folder of the case */
    case_section case_section;
    const char *word; /* word in its path for bulk or track; NULL: none */
    bool from_folder; /* the word is in the name of a folder */
    bool left_out;    /* file of a given folder without measured data */
    file_kind found;  /* its `words` are the error of a file that could not be read */
} case_entry;

typedef struct new_case {
    cmd_session *s;
    const char *tip; /* tip of the cantilever; NULL if unknown */
    case_entry *entries;
    size_t n;
} new_case;

size_t new_case_count(const new_case *c, case_section where);
/* Returns the reason why a name cannot be read back from a case unchanged; NULL: none. */
const char *new_case_name_problem(const char *name);
void new_case_write(FILE *out, const new_case *c);

#endif
