/* What a file turned out to be, for the command to type next and for a new case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_FILE_KIND_H
#define WT_CMD_FILE_KIND_H

#include "cmd/cmd.h"

/* What a file does not say and the user must. */
enum { FOUND_N_MISSING = 6 };
/* The name of the option and of the attribute in a case; a value as an example. */
typedef struct file_kind_missing {
    const char *name, *example;
} file_kind_missing;
extern const file_kind_missing found_missing_rows[FOUND_N_MISSING];

typedef struct file_kind {
    unsigned kind;                 /* WT_KIND_*, 0 = no measurement */
    bool is_result;                /* tables of this program */
    const char *next;              /* subcommand, NULL: by its kind; static */
    bool missing[FOUND_N_MISSING]; /* see above */
    char unitless[256];            /* names of columns that carry no unit, a line each */
    char tip[64];                  /* that the file says, as --tip takes it; "" if it says none */
    bool has_x, has_y, one_row;    /* columns of a table of heights; an image of one row */
    bool has_force, has_load;      /* friction force; normal force or coefficient of friction */
    bool nothing;                  /* it holds nothing that is read, whatever one says */
    char words[512];               /* "jpk: curves 12, spring constant 300 mN/m" */
} file_kind;

/* Reads a file; its facts are the table of wt_describe. */
wt_status file_kind_detect(cmd_session *s, const char *path, const wt_read_options *options,
                           wt_log *log, wt_table **facts, file_kind *found);
/* Whether the user must say this, and not by the columns that have no unit. */
bool file_kind_lacks(const file_kind *found, size_t missing);
/* A number as people read it, few digits, the unit with its prefix; anything else as it is. */
void file_kind_value(const char *value, const char *unit, char *out, size_t size);

#endif
