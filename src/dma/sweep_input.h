/* The sweeps of a job: reading, which sample and amplitude, what is left out and given beside them.
 * Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_SWEEP_INPUT_H
#define WT_DMA_SWEEP_INPUT_H

#include "job/inputs.h"

/* "shear" and the like, for tables. */
const char *flow_deformation_name(wt_deformation deformation);

/* All isotherms and temperature sweeps of the files, sorted, without copies, of the sample that the
 * first set names; cleared by the caller, also on failure. */
wt_status flow_sweeps_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                           wt_sweep *sweep, wt_error *err) WT_NODISCARD;
/* WT_E_UNSUPPORTED for isotherms after a step: `what` is of an oscillation. */
wt_status flow_needs_oscillation(const wt_sweep *sweep, const char *what,
                                 wt_error *err) WT_NODISCARD;
/* The samples of isotherms and temperature sweeps; `samples` is empty, and to be cleared. */
wt_status flow_samples_find(const wt_sweep *sweep, wt_samples *samples, wt_error *err) WT_NODISCARD;
/* Takes out the sweeps of other samples than `name`, unless NULL or "all". WT_E_NOT_FOUND if there
 * are no others. */
wt_status flow_sample_take(wt_sweep *sweep, const char *name, wt_error *err) WT_NODISCARD;
/* Isotherms and temperature sweeps of several samples are WT_E_AMBIGUOUS unless the first set says
 * which. */
wt_status flow_one_sample(const wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                          wt_log *log, wt_error *err) WT_NODISCARD;
/* Of isotherms and temperature sweeps of several strain amplitudes at one temperature and frequency
 * keeps those nearest to the one that the first set names; without one they are WT_E_AMBIGUOUS. */
wt_status flow_one_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets, wt_log *log,
                             wt_error *err) WT_NODISCARD;

/* Takes out the isotherms, temperature sweeps and points that the texts name. */
wt_status flow_sweep_cut(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                         wt_error *err) WT_NODISCARD;

/* Whether the texts are understood. */
wt_status flow_cuts_check(const char *const *texts, size_t n, wt_error *err) WT_NODISCARD;

/* The law in words as a law; kind NONE for NULL. */
wt_status flow_shift_law(const char *text, wt_shift_law *law, wt_error *err) WT_NODISCARD;
/* Sets the shifts of the isotherms that the law tells (unless its kind is NONE), or the table
 * (unless NULL), whose vertical shifts, if it has any, are held, too: they must not be with
 * `vertical` NONE. */
wt_status flow_shifts_give(const wt_shift_law *law, const wt_table *table,
                           wt_vertical_shift vertical, wt_sweep *sweep, wt_log *log,
                           wt_error *err) WT_NODISCARD;

#endif
