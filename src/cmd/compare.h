/* Inputs of weartrack compare. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_COMPARE_H
#define WT_CMD_COMPARE_H

#include "cmd/table_output.h"

/* A file: its tables, or the error that it has none. */
typedef struct compare_input {
    const char *path;
    wt_result *tables;
    wt_error failure;
    /* for a material: */
    wt_rubber rubber;
    wt_table *shift_factors; /* of isotherms that this call fits */
} compare_input;

/* One call, for comparisons of groups and of materials. */
typedef struct compare_call {
    cmd_session s;
    wt_compare_job groups;
    wt_materials_job materials;
    wt_master_job master;
    wt_file_set set;      /* how isotherms are read */
    compare_input *input; /* [s.n_files] */
} compare_call;

/* True if the files are materials: at least one is or may be one, and none has indentation tables.
 */
bool compare_has_materials(const compare_call *call);
/* True if one of them has measured isotherms, which this call fits. */
bool compare_has_isotherms(const compare_call *call);
/* Compares the materials and writes the tables. */
void compare_materials(compare_call *call);

#endif
