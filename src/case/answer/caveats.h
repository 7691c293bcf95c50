/* Caveats of an answer. Internal to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_CAVEATS_H
#define WT_CASE_ANSWER_CAVEATS_H

#include "case/answer/answer_context.h"

/* Stores all caveats of the run in the context. */
void answer_caveats(answer_context *context);

#endif
