/* State of an indentation job that its files share. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_INDENT_TASK_H
#define WT_INDENTATION_INDENT_TASK_H

#include "indentation/calibration_errors.h"
#include "indentation/curve_selection.h"
#include "indentation/indent.h"
#include "indentation/manual_overrides.h"
#include "job/conditioning.h"

#include <pthread.h>

typedef enum item_state { ITEM_FREE, ITEM_BUSY, ITEM_DONE } item_state;

typedef struct queued_curve {
    item_state state;
    size_t order; /* index among all curves of the file */
    size_t samples;
    wt_force_curve curve;
    curve_choice choice;
    wt_status status;
    wt_error error;
    wt_indent_fit fit;
    uint64_t hash; /* of the samples; 0 if no modulus follows from them */
} queued_curve;

typedef struct accepted_modulus {
    double modulus;
    const flow_file *file;
    size_t curve, order;
    curve_choice choice;
} accepted_modulus;

typedef struct indent_task {
    const wt_indent_job *job;
    wt_indent_options options; /* options of the job, with the spectrum */
    wt_prony spectrum;
    const wt_job *work;
    flow_file *file;
    const char *spot; /* spot of the set, or the file */
    wt_contact_table *contact;
    manual_overrides choices;
    const wt_contact_table
        *file_contact; /* contact table of the file, which may have its own tip */
    const wt_tip *file_tip;
    curve_selection shown;
    wt_indent_workspace **scratch; /* [n_workers] */
    unsigned n_workers;
    /* Each thread reads a curve, fits it and writes the finished curves in order. The lock protects
     * everything except the fit. */
    pthread_mutex_t lock;
    pthread_cond_t written;
    wt_force_source *source; /* NULL after the last curve */
    wt_input
        *paired_input; /* file for its digest, which one thread computes first; NULL after that */
    wt_error *paired_err;
    queued_curve *items;      /* [n_items] queue */
    size_t n_items, n_busy;   /* size of the queue; items in use */
    size_t n_samples;         /* samples in the items in use */
    size_t n_read, n_written; /* curves of the file */
    size_t n_expected;        /* number of curves that the file states; 0 if unknown */
    size_t n_files, file_number;
    wt_status status;
    wt_error *err;
    table_writer rows;
    size_t n_curves, n_failed;
    size_t n_accepted, n_wide, n_doubtful; /* n_accepted includes wide and doubtful curves */
    copied_curves copies;                  /* among the curves of the file */
    /* Equal failures of one file make one row. */
    wt_error failure;
    size_t n_equal, first_equal;
    /* Accepted moduli with their curves, for the representative curve. */
    accepted_modulus *moduli;
    size_t n_moduli;
    indent_summary summary;
    calibration_errors calibration;
    indent_depths depths;
    /* Range of the spring constants [N/m] and sensitivities [m/V] of the accepted curves, and their
     * different tips. */
    double k_low, k_high, s_low, s_high;
    const wt_tip **tips;
    size_t n_tips;
    bool has_given_sensitivity; /* a given sensitivity determined a force */
    double sum_squared_errors;  /* sum of the squared relative errors of the moduli */
} indent_task;

/* Returns the quantities that the fit reads from a file, with the manual overrides for the file.
 * The overrides also set the tip of the task. */
wt_read_options indent_read_options(indent_task *task, const flow_file *file, bool time);
/* Returns the fit options of one curve. */
wt_indent_options indent_curve_options(const indent_task *task, const curve_choice *choice);
/* Processes every curve of every file and adds a row for each. */
wt_status indent_read_files(indent_task *task, const flow_files *files, wt_error *err) WT_NODISCARD;

#endif
