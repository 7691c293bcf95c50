/* Limits of a result: what its numbers leave out, assume, or make doubtful. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_LIMITS_H
#define WT_CASE_ANSWER_LIMITS_H

#include "case/answer/answer_context.h"

/* Creates the table "limits", the most serious limits first. *table is NULL without limits. */
wt_status limits_table(const answer_context *context, wt_table **table, wt_error *err) WT_NODISCARD;

#endif
