/* What a file turned out to be, for the command to type next and for a new case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_FILE_KIND_H
#define WT_CMD_FILE_KIND_H

#include "cmd/cmd.h"

/* What a file does not say and the user must. */
enum { FOUND_N_MISSING = 6 };
/* The name of the option and of the attribute in a case; a value as an example. */
typedef struct found_missing {
    const char *name, *example;
} found_missing;
extern const found_missing found_missing_rows[FOUND_N_MISSING];

typedef struct found_file {
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
} found_file;

/* Reads a file; its facts are the table of wt_describe. */
wt_status found_look(cmd_session *s, const char *path, const wt_read_options *options,
                     wt_parselog *log, wt_table **facts, found_file *found);
/* Whether the user must say this, and not by the columns that have no unit. */
bool found_asks(const found_file *found, size_t missing);
/* A number as people read it, few digits, the unit with its prefix; anything else as it is. */
void found_value(const char *value, const char *unit, char *out, size_t size);

#endif
