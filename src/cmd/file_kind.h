/* Kind of a file, for the suggestion of the next command and for a new case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_FILE_KIND_H
#define WT_CMD_FILE_KIND_H

#include "cmd/cmd.h"

/* Number of kinds of information that a file may lack, and the units among them. */
enum { FILE_KIND_UNITS = 3, FILE_KIND_N_MISSING = 6 };
/* Name of the option and of the attribute in a case, with an example value. */
typedef struct file_kind_missing {
    const char *name, *example;
} file_kind_missing;
extern const file_kind_missing file_kind_missing_rows[FILE_KIND_N_MISSING];

typedef struct file_kind {
    unsigned kind;                     /* WT_KIND_*, 0 = no measurement */
    bool is_result;                    /* tables of this program */
    const char *next;                  /* next subcommand, NULL: by its kind; static */
    bool missing[FILE_KIND_N_MISSING]; /* indexed as file_kind_missing_rows */
    char unitless[256];                /* names of columns without a unit, one per line */
    char tip[64];                      /* tip in the form of --tip; "" if not stated */
    bool has_x, has_y, one_row;        /* columns of a table of heights; an image of one row */
    bool has_force, has_load;          /* friction force; normal force or coefficient of friction */
    bool has_torque;                   /* friction as a torque, which needs the track radius */
    bool unread;                       /* a part of it is not readable as it is */
    bool nothing;                      /* it has no readable data, whatever the options */
    uint64_t items;                    /* bits of the fact_items in the description */
    char description[512];             /* "jpk: curves 12, spring constant 300 mN/m" */
} file_kind;

/* Reads a file; `metadata` receives the metadata table of wt_input_describe. */
wt_status file_kind_detect(cmd_session *s, const char *path, const wt_read_options *options,
                           wt_log *log, wt_table **metadata, file_kind *found);
/* True if the user must supply this item, other than by units of columns. */
bool file_kind_is_missing(const file_kind *found, size_t missing);
/* Formats a number with few digits and a prefixed unit; other values are unchanged. */
void format_metadata_value(const char *value, const char *unit, char *out, size_t size);

#endif
