/* A case file from the files that there are: what they are, and how they stand in it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_NEW_CASE_H
#define WT_CMD_NEW_CASE_H

#include <stdio.h>

#include "cmd/file_kind.h"

/* What is not known stands in the case as these words, which no quantity and no tip is. */
#define FILL_IN "FILL IN"

typedef enum place { BULK, TRACK, DMA, ROUGHNESS, MAPS, RECORD, PROFILE, UNUSED } place;

typedef struct entry {
    char *path, *in_case; /* as given, and as it holds from the folder of the case */
    place place;
    const char *word; /* of its path that says bulk or track; NULL: none does */
    bool of_folder;   /* that word is in the name of a folder */
    bool left_out;    /* it merely lies in a folder that was given, and holds nothing measured */
    file_kind found;  /* its words are the problem of a file that could not be read */
} entry;

typedef struct new_case {
    cmd_session *s;
    const char *tip; /* of the cantilever; NULL if not known */
    entry *entries;
    size_t n;
} new_case;

size_t new_case_count(const new_case *c, place where);
/* What keeps a name from being read back from a case as it is; NULL: nothing. */
const char *new_case_unfit(const char *name);
void new_case_put(FILE *out, const new_case *c);

#endif
