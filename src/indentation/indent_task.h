/* Inside the indentation job: what its parts share. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_INDENT_TASK_H
#define WT_INDENTATION_INDENT_TASK_H

#include "indentation/calibration_errors.h"
#include "indentation/curve_selection.h"
#include "indentation/indent.h"
#include "indentation/manual_overrides.h"

#include <pthread.h>

typedef enum item_state { ITEM_FREE, ITEM_TAKEN, ITEM_DONE } item_state;

typedef struct item {
    item_state state;
    size_t order; /* of all curves of the file */
    size_t samples;
    wt_force_curve curve;
    curve_choice choice;
    wt_status status;
    wt_error error;
    wt_indent_fit fit;
} item;

typedef struct accepted {
    double modulus;
    const flow_file *file;
    size_t curve, order;
    curve_choice choice;
} accepted;

typedef struct indent_task {
    const wt_indent_job *job;
    wt_indent_options options; /* of the job, with the spectrum */
    wt_prony spectrum;
    const wt_job *work;
    flow_file *file;
    const char *spot; /* of the set, or the file */
    wt_contact_table *contact;
    manual_overrides choices;
    const wt_contact_table *file_contact; /* of the file, whose tip may be chosen for it */
    const wt_tip *file_tip;
    curve_selection shown;
    wt_indent_workspace **scratch; /* [n_workers] */
    unsigned n_workers;
    /* Each thread takes a curve, fits it, and writes what is done and next in order; all but the
     * fit under the lock. */
    pthread_mutex_t lock;
    pthread_cond_t written;
    wt_force_source *source; /* NULL: nothing is left to read */
    wt_input *beside; /* the file for its digest, which one of them makes first; NULL: made */
    wt_error *beside_err;
    item *items;              /* [n_items] */
    size_t n_items, n_taken;  /* of them, those that are not free */
    size_t n_samples;         /* in those */
    size_t n_read, n_written; /* curves of the file */
    size_t n_of_file;         /* as many as it says, 0 if it does not */
    size_t n_files, file_number;
    wt_status status;
    wt_error *err;
    table_writer rows;
    size_t n_curves, n_accepted, n_doubtful, n_failed; /* accepted: doubtful ones, too */
    /* equal failures of one file make one row */
    wt_error failure;
    size_t n_equal, first_equal;
    /* accepted moduli with the curve they are of, for the representative curve */
    accepted *moduli;
    size_t n_moduli;
    indent_summary together;
    calibration_errors common;
    indent_depths depths;
    /* what the accepted curves had: spring constants [N/m], sensitivities [m/V], and tips, a
     * pointer to each that is described otherwise */
    double k_low, k_high, s_low, s_high;
    const wt_tip **tips;
    size_t n_tips;
    bool by_sensitivity; /* one that was given made a force */
    double squares;      /* of relative standard errors of their moduli */
} indent_task;

/* What the fit uses of a file, and nothing else, with what is chosen for the file, which is then
 * the one of the task. */
wt_read_options indent_read_options(indent_task *task, const flow_file *file, bool time);
/* The options of the fit of one curve. */
wt_indent_options indent_curve_options(const indent_task *task, const curve_choice *choice);
/* Every curve of every file, a row for each. */
wt_status indent_read_files(indent_task *task, const flow_files *files, wt_error *err) WT_NODISCARD;

#endif
