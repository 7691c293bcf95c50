/* The fit of a sweep from start to verdict, and what is made of it (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_SWEEPS_MASTER_H
#define WEARTRACK_FIT_SWEEPS_MASTER_H

#include "fit/sweeps/posterior.h"
#include "fit/sweeps/superposition.h"

typedef struct master_work {
    pool memory;
    wt_master_options options;
    shift_set set;
    double reference; /* [K] */
    size_t anchor;
    bool measured_reference; /* the anchor is the reference */
    double terms_per_decade; /* of the spectrum, as asked or as it needs */
    bool lines;              /* it needs more, for it is one of sharp lines */
    bool *placed;            /* [set.n] */
    double *a, *b;           /* [set.n] decades */
    double *physical;        /* [set.n] decades */
    double *overlap;         /* [set.n] decades */
    size_t *curve;           /* [set.n] in the spectrum; of the posterior */
    wt_posterior *posterior;
    spectrum *s; /* that of the posterior */
    vertical vertical;
    spectrum_prior prior;
    spectrum_within within; /* noise within the isotherms */
    lack_of_fit lack;
} master_work;

/* For the reference of the options. *better: where the fit failed for want of overlap, NaN or the
 * temperature of an isotherm that changes much more than the one it was started from. */
wt_status master_fit_once(const wt_sweep *sweep, const wt_master_options *options, wt_parselog *log,
                          wt_master *master, double *better, wt_error *err) WT_NODISCARD;
/* Fills `master` (without the posterior, which it takes over). */
wt_status master_report(master_work *work, const wt_sweep *sweep, wt_parselog *log,
                        wt_master *master, wt_error *err) WT_NODISCARD;
/* The shifts with their notes. */
wt_status master_fill_shifts(const master_work *work, wt_master *m, wt_error *err) WT_NODISCARD;
/* WT_E_RANGE: none can be given for the reference temperature. */
wt_status master_check_reference(const master_work *work, const wt_master *m,
                                 wt_error *err) WT_NODISCARD;
/* WT_E_NO_OVERLAP: no isotherm is shifted onto the reference. */
wt_status master_check_shifts(const master_work *work, const wt_master *m,
                              wt_error *err) WT_NODISCARD;
/* Adds a remark to the note of a shift, parted by "; ". */
void master_note(wt_master_shift *shift, const char *format, ...) WT_PRINTF(2, 3);
/* What is odd about the isotherms, into their notes and the log. */
void master_notes(const master_work *work, const wt_sweep *sweep, wt_master *m, wt_parselog *log);
/* The verdict on superposition; shifts and test are in `master`. */
void master_judge(const master_work *work, wt_master *master);

#endif
