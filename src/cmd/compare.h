/* What weartrack compare was given. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_COMPARE_H
#define WT_CMD_COMPARE_H

#include "cmd/table_output.h"

/* A file: its tables, or why it has none. */
typedef struct compare_input {
    const char *path;
    wt_result *tables;
    wt_error failure;
    /* of a material: */
    wt_rubber rubber;
    wt_table *shift_factors; /* of isotherms that were fitted here */
} compare_input;

/* Both comparisons. */
typedef struct compare_call {
    cmd_session s;
    wt_compare_job groups;
    wt_materials_job materials;
    wt_master_job master;
    wt_file_set set;      /* how isotherms are read */
    compare_input *input; /* [s.n_files] */
} compare_call;

/* Whether the files are materials: some say so, or are no tables, and none holds curves of an
 * indentation. */
bool compare_takes_materials(const compare_call *call);
/* Whether one of them is measured isotherms, which are read and fitted here. */
bool compare_reads_isotherms(const compare_call *call);
/* Compares them and writes the tables. */
void compare_materials(compare_call *call);

#endif
