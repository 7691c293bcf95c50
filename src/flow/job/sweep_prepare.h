/* What is taken from the sweeps before they are fitted, and what is given beside them. Internal to
 * flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SWEEP_PREPARE_H
#define WEARTRACK_FLOW_SWEEP_PREPARE_H

#include "weartrack/flow.h"

/* Takes out the isotherms, temperature sweeps and points that the texts name. */
wt_status flow_sweep_cut(const char *const *texts, size_t n, wt_sweep *sweep, wt_parselog *log,
                         wt_error *err) WT_NODISCARD;

/* Whether the texts are understood. */
wt_status flow_cuts_check(const char *const *texts, size_t n, wt_error *err) WT_NODISCARD;

/* The law in words as a law; kind NONE for NULL. */
wt_status flow_shift_law(const char *text, wt_shift_law *law, wt_error *err) WT_NODISCARD;
/* Sets the shifts of the isotherms that the law tells (unless its kind is NONE), or the table
 * (unless NULL), whose vertical shifts, if it has any, are held, too: they must not be with
 * `vertical` NONE. */
wt_status flow_shifts_give(const wt_shift_law *law, const wt_table *table,
                           wt_vertical_shift vertical, wt_sweep *sweep, wt_parselog *log,
                           wt_error *err) WT_NODISCARD;

#endif
