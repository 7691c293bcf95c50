/* The sweeps of a job: reading, selection by sample and amplitude, exclusion, stated shifts.
 * Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_SWEEP_INPUT_H
#define WT_DMA_SWEEP_INPUT_H

#include "job/inputs.h"
#include "weartrack/dma.h"

/* Returns "shear" or "tension" for a table key. */
const char *flow_deformation_name(wt_deformation deformation);

/* Reads all sweeps of the files, sorted and without duplicates, for the sample that the first
 * set names. The caller clears `sweep`, also on failure. */
wt_status flow_sweeps_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                           wt_sweep *sweep, wt_error *err) WT_NODISCARD;
/* Returns WT_E_UNSUPPORTED for step experiments. `what` names the data that need an oscillation. */
wt_status flow_require_oscillation(const wt_sweep *sweep, const char *what,
                                   wt_error *err) WT_NODISCARD;
/* Lists the samples of isotherms and temperature sweeps. The caller clears the list. */
wt_sample_names flow_samples_find(const wt_sweep *sweep);
/* Removes the sweeps of other samples, unless `name` is NULL or "all". Returns WT_E_NOT_FOUND if
 * no sweep has this sample. */
wt_status flow_select_sample(wt_sweep *sweep, const char *name, wt_error *err) WT_NODISCARD;
/* Returns WT_E_AMBIGUOUS if the sweeps have several samples and the first set names none. */
wt_status flow_require_one_sample(const wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                                  wt_log *log, wt_error *err) WT_NODISCARD;
/* If sweeps at one temperature and frequency have several strain amplitudes, this selects the
 * one nearest to the amplitude of the first set. Without a stated amplitude it returns
 * WT_E_AMBIGUOUS. */
wt_status flow_select_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                                wt_log *log, wt_error *err) WT_NODISCARD;

/* Excludes the isotherms, temperature sweeps and points that the texts describe. */
wt_status flow_sweep_exclude(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                             wt_error *err) WT_NODISCARD;

/* Checks the syntax of the texts. */
wt_status flow_exclusions_check(const char *const *texts, size_t n, wt_error *err) WT_NODISCARD;

/* Parses a shift law. NULL gives kind NONE. */
wt_status flow_parse_shift_law(const char *text, wt_shift_law *law, wt_error *err) WT_NODISCARD;
/* Sets the shifts of the isotherms from the law (unless its kind is NONE) or from the table
 * (unless NULL). Vertical shifts of the table are fixed, too. They are an error if `vertical` is
 * NONE. */
wt_status flow_set_stated_shifts(const wt_shift_law *law, const wt_table *table,
                                 wt_vertical_shift vertical, wt_sweep *sweep, wt_log *log,
                                 wt_error *err) WT_NODISCARD;
/* Sets the shifts of isotherms that texts "T=LOG_AT" state, also in place of those of a law or a
 * table. Returns WT_E_NOT_FOUND for a temperature that was not measured. */
wt_status flow_set_hand_shifts(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                               wt_error *err) WT_NODISCARD;
/* Checks the syntax of the texts. */
wt_status flow_hand_shifts_check(const char *const *texts, size_t n, wt_error *err) WT_NODISCARD;

#endif
